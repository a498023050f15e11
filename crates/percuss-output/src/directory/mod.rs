//! The directory of a run, put in place in one piece.
//!
//! Results are written to a staging directory of a random name beside the final one and exchanged with it in one operation of the
//! system, after everything has reached the disk. A manifest names the files that belong to the results; nothing else is ever
//! replaced or removed. A lock keeps two processes from filling one directory. What a dead process left behind is put in order by
//! the next one that writes there.

mod exchange;
mod likeness;
mod lock;
mod manifest;
mod moves;
mod names;
mod results;

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::thread::{self, JoinHandle};

use percuss_codes::FileCode;
use serde_json::{Map, Value};

use crate::error::Error;
use exchange::Staging;
use lock::Lock;
use manifest::Manifest;
use moves::Kept;
pub use results::{Extent, Results};

/// Where results are, once they are in place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placed {
    /// Their directory: partial results stand beside complete ones.
    pub place: PathBuf,
    /// What was changed since it was looked at, or came to stand in a place meanwhile: that place, and where it is kept,
    /// `NAME.changed-1` beside it, shape (files).
    pub kept: Vec<(PathBuf, PathBuf)>,
}

/// A directory being filled, out of sight until [`RunDirectory::commit`].
///
/// Dropped without a commit, the staging directory is removed and nothing has happened.
#[derive(Debug)]
pub struct RunDirectory {
    given: PathBuf,
    target: PathBuf,
    staging: Staging,
    results: Results,
    lock: Lock,
    /// What earlier processes that died had found changed, shape (files).
    kept: Vec<Kept>,
    /// Files that are described, and put on the disk, while others are written, shape (files).
    finished: Vec<(String, JoinHandle<Result<Value, Error>>)>,
}

impl RunDirectory {
    /// Prepares the staging directory for `target`.
    ///
    /// # Errors
    /// If `target` is a file, a link that leads nowhere, a directory that is neither empty nor holds a run, or one that
    /// another process is filling; if files of the run in it were changed since; if the staging directory cannot be made.
    pub fn create(target: impl AsRef<Path>) -> Result<Self, Error> {
        Self::create_for(Results::Run, target)
    }

    /// The same for results of any kind.
    ///
    /// # Errors
    /// As [`RunDirectory::create`].
    pub fn create_for(results: Results, target: impl AsRef<Path>) -> Result<Self, Error> {
        let given = target.as_ref();
        let target = resolve(given)?;
        if let Some(parent) = target.parent() {
            fs::create_dir_all(parent).map_err(|e| Error::io(parent, "create", e))?;
        }
        let lock = Lock::take(given, &target)?;
        let kept = exchange::recover(&target)?;
        refuse_what_is_not_ours(results, given, &target)?;
        let staging = Staging::new(&target)?;
        let given = given.to_owned();
        Ok(Self { given, target, staging, results, lock, kept, finished: Vec::new() })
    }

    /// Where to write until the commit.
    pub fn path(&self) -> &Path {
        self.staging.path()
    }

    /// Says that nothing more is written to a large file at the top: it goes to the disk, and its checksum is taken, while
    /// others are still written. Nothing happens where there is no such file.
    pub fn finished(&mut self, name: &str) {
        let path = self.staging.path().join(name);
        if path.is_file() {
            let describe = move || {
                let file = File::open(&path).map_err(|e| Error::io(&path, "read", e))?;
                file.sync_all().map_err(|e| Error::io(&path, "write", e))?;
                manifest::described(&path)
            };
            // Without a thread it is described with all others.
            let thread = thread::Builder::new().spawn(describe);
            self.finished.extend(thread.ok().map(|thread| (name.to_owned(), thread)));
        }
    }

    /// The file that keeps other processes out, removed in the end.
    pub fn lock_file(&self) -> &Path {
        self.lock.path()
    }

    /// Where everything will be after the commit, unless it is partial and would replace what is complete.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Puts complete results in the place of earlier ones; whatever is not theirs stays where it is.
    ///
    /// # Errors
    /// If something cannot be moved; the new files then remain in the staging directory, which the
    /// error names.
    pub fn commit(self) -> Result<Placed, Error> {
        self.commit_as(Extent::Complete)
    }

    /// The same for results of any extent; partial results stand beside complete ones.
    ///
    /// # Errors
    /// As [`RunDirectory::commit`].
    pub fn commit_as(mut self, extent: Extent) -> Result<Placed, Error> {
        self.staging.keep();
        let done = self.put_in_place(extent);
        done.map_err(|e| {
            let rescued = self.staging.rescue(&self.target);
            let place = rescued.display();
            Error::io(&self.target, "replace", format!("{e}; the results are in {place}"))
        })
    }

    fn put_in_place(&mut self, extent: Extent) -> Result<Placed, Error> {
        let mut known = Map::new();
        for (name, description) in self.finished.drain(..) {
            // What could not be described there is described here, or says why not.
            known.extend(description.join().ok().and_then(Result::ok).map(|found| (name, found)));
        }
        let staged = self.staging.path();
        let files = names::files_in(staged)?;
        let manifest = Manifest::of(staged, &files, self.results, extent, &known)?;
        manifest.write(staged)?;
        let earlier = Manifest::read(&self.target)?;
        let keeps = extent == Extent::Partial && earlier.is_some_and(|m| m.complete);
        let mut kept = std::mem::take(&mut self.kept);
        let (place, _lock) = match keeps {
            false => (self.target.clone(), None),
            true => self.beside().map(|(place, lock)| (place, Some(lock)))?,
        };
        kept.extend(self.staging.move_to(&place)?);
        Ok(Placed { place, kept })
    }

    /// Beside the target: a directory that does not exist, or holds partial results of this kind.
    fn beside(&self) -> Result<(PathBuf, Lock), Error> {
        let name = self.target.file_name().unwrap_or_default().to_string_lossy().into_owned();
        for k in 1..1000 {
            let number = if k == 1 { String::new() } else { format!("-{k}") };
            let place = self.target.with_file_name(format!("{name}.incomplete{number}"));
            let Ok(lock) = Lock::take(&place, &place) else { continue };
            let manifest = Manifest::read(&place)?;
            let ours = manifest.is_some_and(|m| !m.complete && m.kind == self.results.kind());
            let is_link = fs::symlink_metadata(&place).is_ok_and(|found| found.is_symlink());
            if !is_link && (ours || !place.exists()) {
                return Ok((place, lock));
            }
        }
        Err(Error::refused(&self.given, "has too many incomplete results beside it"))
    }
}

/// Files written again into the directory of a finished run, which stays as it is otherwise.
#[derive(Debug)]
pub struct RunUpdate {
    target: PathBuf,
    staging: Staging,
    lock: Lock,
    /// What was kept of files that were changed meanwhile, shape (files).
    kept: Vec<Kept>,
}

impl RunUpdate {
    /// Prepares it.
    ///
    /// # Errors
    /// If the directory holds no run, or another process fills it.
    pub fn open(target: impl AsRef<Path>) -> Result<Self, Error> {
        let given = target.as_ref();
        let target = resolve(given)?;
        let lock = Lock::take(given, &target)?;
        let kept = exchange::recover(&target)?;
        let manifest = Manifest::read(&target)?.filter(|m| m.kind == Results::Run.kind());
        let Some(manifest) = manifest else {
            let reason = format!("is not the directory of a run (it has no {})", manifest::NAME);
            return Err(Error::of(FileCode::NoRun, given, reason));
        };
        refuse_detours(&manifest, given, &target)?;
        let staging = Staging::within(&target)?;
        Ok(Self { target, staging, lock, kept })
    }

    /// Where to write.
    pub fn path(&self) -> &Path {
        self.staging.path()
    }

    /// The file that keeps other processes out, removed in the end.
    pub fn lock_file(&self) -> &Path {
        self.lock.path()
    }

    /// Puts the new files in place of those of the same names, if these are the run's. What was changed since it was written, and where
    /// it is kept, `NAME.changed-1` beside its place.
    ///
    /// # Errors
    /// If a file of the same name is somebody's own, or something cannot be moved.
    pub fn commit(mut self) -> Result<Vec<(PathBuf, PathBuf)>, Error> {
        self.kept.extend(self.staging.add_to(&self.target)?);
        Ok(self.kept)
    }
}

/// The real place of `path`, links followed where it exists.
fn resolve(path: &Path) -> Result<PathBuf, Error> {
    let resolved = match path.try_exists() {
        Ok(true) => path.canonicalize(),
        _ if fs::symlink_metadata(path).is_ok() => {
            return Err(Error::refused(path, "broken link"));
        }
        _ => std::path::absolute(path),
    };
    let resolved = resolved.map_err(|e| Error::io(path, "resolve", e))?;
    if resolved.file_name().is_none() {
        return Err(Error::refused(path, "not a valid directory for a run"));
    }
    Ok(resolved)
}

fn refuse_what_is_not_ours(results: Results, given: &Path, target: &Path) -> Result<(), Error> {
    if !target.exists() {
        return Ok(());
    }
    if !target.is_dir() {
        return Err(Error::refused(given, "exists and is not a directory; choose another --out"));
    }
    let Some(manifest) = Manifest::read(target)? else {
        let words = results.words();
        return match names::is_empty(target)? {
            true => Ok(()),
            false => Err(Error::refused(
                given,
                format!(
                    "not empty and not {words} (no {}); choose another --out or remove it",
                    manifest::NAME
                ),
            )),
        };
    };
    if manifest.kind != results.kind() {
        let reason = format!("contains other results ({}); choose another --out", manifest.kind);
        return Err(Error::refused(given, reason));
    }
    refuse_detours(&manifest, given, target)?;
    match manifest.changed(target)? {
        Some(file) => Err(Error::of(
            FileCode::Changed,
            given,
            format!("{file} was modified after percuss wrote it; choose another --out"),
        )),
        None => Ok(()),
    }
}

/// A folder of the results that the user has made a link, or put on another disk, stays what it is.
fn refuse_detours(manifest: &Manifest, given: &Path, target: &Path) -> Result<(), Error> {
    let Some(folder) = names::in_the_way(target, manifest.listed()) else { return Ok(()) };
    let folder = folder.display();
    let reason = format!(
        "{folder} in it is a link or on another disk, and the results would replace it; choose another --out"
    );
    Err(Error::refused(given, reason))
}
