//! Files that must not be there yet.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::Path;

use percuss_codes::FileCode;

use crate::outcome::Failure;

/// Writes a text into a new file; `instead` says what to do if there is one.
///
/// # Errors
/// If it exists, or the operating system reports an error; then nothing is left of it.
pub fn write(path: &Path, text: &str, instead: &str) -> Result<(), Failure> {
    let opened = OpenOptions::new().write(true).create_new(true).open(path);
    let mut file = opened.map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => {
            let text = format!("{}: exists already; {instead}", path.display());
            Failure::input(FileCode::Foreign, text)
        }
        _ => Failure::system(path, "create", &error),
    })?;
    file.write_all(text.as_bytes()).map_err(|error| {
        let _ = std::fs::remove_file(path);
        Failure::system(path, "write", &error)
    })
}
