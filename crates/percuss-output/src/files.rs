//! Whole files: written under a temporary name, then renamed, so that no half file bears the final name.

use std::fs::{self, File};
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
