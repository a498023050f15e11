//! Whole files: written under a temporary name, then renamed, so that no half file bears the final name.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::error::Error;

/// Temporary name beside `path` (`.summary.json.partial`).
pub(crate) fn partial(path: &Path) -> PathBuf {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    path.with_file_name(format!(".{name}.partial"))
}

/// Writes `bytes` to `path`, entirely or not at all.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let temporary = partial(path);
    let written = File::create(&temporary).and_then(|mut file| file.write_all(bytes));
    if let Err(source) = written {
        let _ = fs::remove_file(&temporary);
        return Err(Error::io(path, "write", source));
    }
    rename(&temporary, path)
}

/// The same, on the disk before the name is.
pub(crate) fn write_durably(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let temporary = partial(path);
    let written = File::create(&temporary).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    if let Err(source) = written {
        let _ = fs::remove_file(&temporary);
        return Err(Error::io(path, "write", source));
    }
    rename(&temporary, path)?;
    // A system that cannot do this with a folder keeps its names in order by itself.
    let _ = path.parent().map(File::open).map(|folder| folder.and_then(|f| f.sync_all()));
    Ok(())
}

/// Renames `from` to `to`, replacing it.
pub(crate) fn rename(from: &Path, to: &Path) -> Result<(), Error> {
    fs::rename(from, to).map_err(|source| Error::io(to, "put the finished file in place", source))
}

/// Reads a text file.
pub(crate) fn read_text(path: &Path) -> Result<String, Error> {
    fs::read_to_string(path).map_err(|source| Error::io(path, "read", source))
}

/// A file that at most one process has.
#[derive(Debug)]
pub enum Exclusive {
    /// This one has it, until it is closed.
    Ours(File),
    /// Another one has it.
    Taken(File),
}

/// Opens or makes a file that at most one process has; its content stays. Where the system keeps no locks, nothing better can be had: it is
/// ours.
///
/// # Errors
/// If the system refuses.
pub fn open_exclusively(path: &Path) -> std::io::Result<Exclusive> {
    loop {
        let mut options = OpenOptions::new();
        let file = options.read(true).write(true).create(true).truncate(false).open(path)?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Ok(Exclusive::Taken(file)),
            Err(TryLockError::Error(_)) => return Ok(Exclusive::Ours(file)),
            // Who had it before may have moved or removed it between opening and locking.
            Ok(()) if is_the_same(&file, path) => return Ok(Exclusive::Ours(file)),
            Ok(()) => {}
        }
    }
}

#[cfg(unix)]
fn is_the_same(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |m: fs::Metadata| (m.dev(), m.ino());
    file.metadata().map(id).ok() == fs::metadata(path).map(id).ok()
}

#[cfg(not(unix))]
fn is_the_same(_file: &File, _path: &Path) -> bool {
    true
}
