//! A single file that is put in place in one piece.

use std::fs::File;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use percuss_codes::FileCode;

use crate::error::Error;
use crate::files::{Exclusive, is_the_same, open_exclusively};
use crate::place::Place;

/// Where a file grows until it is finished: beside its place, under a name of its own.
pub fn unfinished(out: &Path) -> PathBuf {
    let name = out.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    out.with_file_name(format!(".{name}.percuss.partial"))
}

/// A file that is not finished: one process writes it at a time, and what a dead one left is removed.
///
/// Dropped before it is put in place, it is removed.
#[derive(Debug)]
pub struct Unfinished {
    place: Place,
    out: PathBuf,
    file: File,
    placed: bool,
}

impl Unfinished {
    /// An empty one, for a file that will be `out`.
    ///
    /// # Errors
    /// If the operating system reports an error, another process is writing it, or a link stands where it would grow.
    pub fn of(out: &Path) -> Result<Self, Error> {
        let path = unfinished(out);
        match open_exclusively(&path).map_err(|source| Error::io(&path, "write", source))? {
            Exclusive::Taken(_) => {
                Err(Error::of(FileCode::Busy, out, "another process is writing it"))
            }
            Exclusive::Ours(file) => {
                let place = Place::of(&path).map_err(|source| Error::io(out, "write", source))?;
                Ok(Self { place, out: out.to_owned(), file, placed: false })
            }
        }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.place.path()
    }

    /// The file, to write into.
    ///
    /// # Errors
    /// If the operating system reports an error.
    pub fn file(&self) -> std::io::Result<File> {
        self.file.try_clone()
    }

    /// Writes into it.
    ///
    /// # Errors
    /// If the operating system reports an error.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Error> {
        let written = (&self.file).write_all(bytes);
        written.map_err(|source| Error::io(&self.out, "write", source))
    }

    /// Puts it in its place, once all of it is on the disk. What stands there is looked at once more, by `may_go`; if it may not, it is
    /// kept beside under the name that is returned.
    ///
    /// # Errors
    /// If the operating system reports an error; what was there stays.
    pub fn put(mut self, may_go: &dyn Fn(&Path) -> bool) -> Result<Option<PathBuf>, Error> {
        let placed = self.file.sync_all().and_then(|()| self.place_it(may_go));
        placed.map_err(|source| Error::io(&self.out, "write", source))
    }

    fn place_it(&mut self, may_go: &dyn Fn(&Path) -> bool) -> std::io::Result<Option<PathBuf>> {
        let target = self.place.beside(self.out.file_name().unwrap_or_default())?;
        if std::fs::symlink_metadata(target.path()).is_ok_and(|found| found.is_dir()) {
            return Err(std::io::ErrorKind::IsADirectory.into());
        }
        if !is_the_same(&self.file, self.place.path()) {
            self.placed = true;
            return Err(std::io::Error::other("another file exists at this location"));
        }
        // Exchanged first and looked at then: nobody comes between.
        if self.place.exchange(&target) {
            // What has the temporary name now is no longer this program's.
            self.placed = true;
            if may_go(self.place.path()) {
                return self.place.remove().map(|()| None);
            }
            return keep(&self.place, &target).map(Some);
        }
        let kept = match target.is_taken() && !may_go(target.path()) {
            true => Some(keep(&target, &target)?),
            false => None,
        };
        self.place.rename(&target)?;
        self.placed = true;
        Ok(kept)
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if !self.placed {
            let _ = self.place.remove();
        }
    }
}

/// Gives what was changed meanwhile a name of its own beside its place: `NAME.changed-1`.
pub(crate) fn keep(what: &Place, place: &Place) -> std::io::Result<PathBuf> {
    for number in 1..1000 {
        let path = kept_name(place.path(), number);
        let kept = place.beside(path.file_name().unwrap_or_default())?;
        if !kept.is_taken() {
            what.rename(&kept)?;
            return Ok(path);
        }
    }
    Err(std::io::ErrorKind::AlreadyExists.into())
}

/// `NAME.changed-1`, where what was changed meanwhile is kept.
fn kept_name(place: &Path, number: u32) -> PathBuf {
    let mut name = place.file_name().unwrap_or_default().to_owned();
    name.push(format!(".changed-{number}"));
    place.with_file_name(name)
}
