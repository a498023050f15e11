//! Files that this program wrote say so, and no others are replaced.

use std::fs::{self, File};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;

/// What stands in every file, as a comment of its format.
pub(crate) const MARK: &str = concat!("made by percuss ", env!("CARGO_PKG_VERSION"));
/// What it begins with in any version.
const ANY: &[u8] = b"made by percuss ";
/// Bytes at either end of a file in which it is looked for.
const ENDS: u64 = 1 << 17;

/// An SVG text that says who wrote it.
pub fn marked(svg: &str) -> String {
    format!("<!-- {MARK} -->\n{svg}")
}

/// Whether a file says that this program wrote it.
pub fn is_ours(path: &Path) -> bool {
    let look = || -> std::io::Result<bool> {
        let mut file = File::open(path)?;
        let length = file.metadata()?.len();
        let mut bytes = Vec::new();
        Read::by_ref(&mut file).take(ENDS).read_to_end(&mut bytes)?;
        file.seek(SeekFrom::Start(length.saturating_sub(ENDS)))?;
        file.take(ENDS).read_to_end(&mut bytes)?;
        Ok(bytes.windows(ANY.len()).any(|window| window == ANY))
    };
    look().unwrap_or(false)
}

/// A name beside a file, for what is not finished.
pub(crate) fn beside(path: &Path) -> PathBuf {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    path.with_file_name(format!(".{name}.{}.partial", std::process::id()))
}

/// Writes a file, entirely or not at all.
///
/// # Errors
/// If the system refuses.
pub fn put(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let temporary = beside(path);
    let written = File::create(&temporary).and_then(|mut file| file.write_all(bytes));
    if let Err(source) = written.and_then(|()| fs::rename(&temporary, path)) {
        let _ = fs::remove_file(&temporary);
        return Err(Error::io(path, "write", &source));
    }
    Ok(())
}
