//! Whole files: written under a temporary name, then renamed, so that no half file bears the final name.

use std::fs::{self, File, TryLockError};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::place::Place;

/// A file that grows under a temporary name beside its own, `.summary.json.partial`, until all of it is there.
#[derive(Debug)]
pub(crate) struct Growing {
    temporary: Place,
    path: PathBuf,
}

impl Growing {
    /// An empty one. What an earlier process left under the temporary name is removed, and so is a link.
    ///
    /// # Errors
    /// If the operating system reports an error.
    pub fn new(path: &Path) -> std::io::Result<(Self, File)> {
        let temporary = Place::of(&partial(path))?;
        let file = temporary.create_new()?;
        Ok((Self { temporary, path: path.to_owned() }, file))
    }

    /// Gives it its name, in place of whatever bears that.
    ///
    /// # Errors
    /// If the operating system reports an error.
    pub fn put(&self) -> Result<(), Error> {
        let name = self.path.file_name().unwrap_or_default();
        let renamed = self.temporary.beside(name).and_then(|place| self.temporary.rename(&place));
        renamed.map_err(|source| Error::io(&self.path, "put the finished file in place", source))
    }

    /// Gives it up.
    pub fn remove(&self) {
        let _ = self.temporary.remove();
    }
}

/// Temporary name beside `path` (`.summary.json.partial`).
pub(crate) fn partial(path: &Path) -> PathBuf {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    path.with_file_name(format!(".{name}.partial"))
}

/// Writes `bytes` to `path`, entirely or not at all.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    written(path, bytes, false)
}

/// The same, on the disk before the name is.
pub(crate) fn write_durably(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    written(path, bytes, true)?;
    // A system that cannot do this with a folder keeps its names in order by itself.
    let _ = path.parent().map(File::open).map(|folder| folder.and_then(|f| f.sync_all()));
    Ok(())
}

fn written(path: &Path, bytes: &[u8], durably: bool) -> Result<(), Error> {
    let fault = |source: std::io::Error| Error::io(path, "write", source);
    let (growing, mut file) = Growing::new(path).map_err(fault)?;
    let written = file.write_all(bytes).and_then(|()| match durably {
        true => file.sync_all(),
        false => Ok(()),
    });
    if let Err(source) = written {
        growing.remove();
        return Err(fault(source));
    }
    growing.put()
}

/// Makes an empty file at a name that nothing bears, not even a link.
///
/// # Errors
/// `AlreadyExists` if something does; what the system says.
pub fn create_new(path: &Path) -> std::io::Result<File> {
    Place::of(path)?.create()
}

/// Writes a file at a name that nothing bears, not even a link, such as one in a directory of results being filled.
///
/// # Errors
/// `AlreadyExists` if something does; what the system says.
pub fn write_new(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    create_new(path)?.write_all(bytes)
}

/// Reads a text file.
pub(crate) fn read_text(path: &Path) -> Result<String, Error> {
    fs::read_to_string(path).map_err(|source| Error::io(path, "read", source))
}

/// A file that at most one process has.
#[derive(Debug)]
pub enum Exclusive {
    /// This one has it, until it is closed: an empty file that it has made.
    Ours(File),
    /// Another one has it.
    Taken(File),
}

/// Makes a file that at most one process has, in place of one that a process left which died. Where the system keeps no locks, nothing
/// better can be had: it is ours.
///
/// # Errors
/// If a link stands there, which is never followed; if the operating system reports an error.
pub fn open_exclusively(path: &Path) -> std::io::Result<Exclusive> {
    let place = Place::of(path)?;
    for _ in 0..1000 {
        let (file, is_new) = match place.create() {
            Ok(file) => (file, true),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => match place.open(false) {
                Ok(file) => (file, false),
                Err(error) if error.kind() == ErrorKind::NotFound => continue,
                Err(error) => return Err(error),
            },
            Err(error) => return Err(error),
        };
        let locked = match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Ok(Exclusive::Taken(file)),
            Err(TryLockError::Error(_)) => true,
            // Who had it before may have moved or removed it between opening and locking.
            Ok(()) => is_the_same(&file, path),
        };
        match (locked, is_new) {
            (true, true) => return Ok(Exclusive::Ours(file)),
            // Of a process that died: nothing is written into a file that this one has not made.
            (true, false) => place.remove()?,
            (false, _) => {}
        }
    }
    Err(ErrorKind::AlreadyExists.into())
}

/// Whether a file is the one that bears a name, no link followed.
#[cfg(unix)]
pub(crate) fn is_the_same(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |m: fs::Metadata| (m.dev(), m.ino());
    file.metadata().map(id).ok() == fs::symlink_metadata(path).map(id).ok()
}

#[cfg(not(unix))]
pub(crate) fn is_the_same(_file: &File, _path: &Path) -> bool {
    true
}
