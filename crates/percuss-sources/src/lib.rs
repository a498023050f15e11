//! Hash of a crate's sources for its build script: builds of one version from different sources have different identifiers.

use std::path::{Path, PathBuf};
use std::{env, fs};

/// Sets the environment variable `PERCUSS_BUILD` for the compilation of the crate: its version, `+`, and a hash of all files below its `src`
/// in 32 hexadecimal digits, the same on every system.
///
/// # Panics
/// If a source file cannot be read, or outside a build script.
pub fn set_build() {
    println!("cargo::rerun-if-changed=src");
    let mut files = Vec::new();
    collect(Path::new("src"), &mut files);
    files.sort();
    // FNV-1a in 128 bits (Fowler, Noll, Vo): no dependency, the same on every system.
    let mut hash: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    let mut enter = |bytes: &[u8]| {
        for byte in bytes {
            hash = (hash ^ u128::from(*byte)).wrapping_mul(0x0100_0000_0000_0000_0000_013b);
        }
    };
    for file in &files {
        // Neither the separators of the system nor its line ends.
        let name: Vec<_> = file.iter().map(|part| part.to_string_lossy()).collect();
        enter(name.join("/").as_bytes());
        let text = fs::read_to_string(file).expect("a source file");
        text.lines().for_each(|line| enter(line.as_bytes()));
    }
    let version = env::var("CARGO_PKG_VERSION").expect("set by Cargo");
    println!("cargo::rustc-env=PERCUSS_BUILD={version}+{hash:032x}");
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a source folder").flatten() {
        let path = entry.path();
        match path.is_dir() {
            true => collect(&path, files),
            false => files.push(path),
        }
    }
}
