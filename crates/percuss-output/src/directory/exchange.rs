//! How a staged directory takes the place of an earlier one, and what is done about one left by a process that died.

use std::fs;
use std::path::{Path, PathBuf};

use super::likeness::{make_like, make_readable, stays_itself};
use super::manifest::{self, Manifest};
use super::moves::{
    Kept, discard, move_entries, move_file, remove_all, remove_emptied, remove_folders, rename,
    sync,
};
use super::names::{
    ADDITION, ASIDE, STAGED, UNFINISHED, directory_in, files_in, folders_in, hidden, in_the_way,
    is_empty, is_file, is_folder, left_behind,
};
use crate::error::Error;
use crate::files::create_new;
use crate::place::Place;

/// A directory of a random name in which results are written.
#[derive(Debug)]
pub(super) struct Staging {
    path: PathBuf,
    /// Whether it lies in the target, which cannot itself be moved.
    within: bool,
    kept: bool,
}

impl Staging {
    /// Beside the target; within it where that is empty or must stay itself, or where no other directory is like it.
    pub fn new(target: &Path) -> Result<Self, Error> {
        let parent = target.parent().unwrap_or(target);
        if !target.is_dir() {
            return Self::make(parent, hidden(target, STAGED), false);
        }
        // A disk of its own below it, whoever put it there, cannot be moved either.
        let folders = folders_in(target)?;
        let inside = folders.iter().map(|folder| folder.join("file")).collect::<Vec<_>>();
        let is_one_disk = in_the_way(target, inside.iter().map(PathBuf::as_path)).is_none();
        if is_empty(target)? || stays_itself(target) || !is_one_disk {
            return Self::within(target);
        }
        let staging = Self::make(parent, hidden(target, STAGED), false)?;
        match make_like(&staging.path, target) {
            true => Ok(staging),
            false => Self::within(target),
        }
    }

    /// Within a directory.
    pub fn within(target: &Path) -> Result<Self, Error> {
        Self::make(target, format!(".{STAGED}").into(), true)
    }

    fn make(parent: &Path, prefix: std::ffi::OsString, within: bool) -> Result<Self, Error> {
        let path = directory_in(parent, prefix)?;
        let staging = Self { path, within, kept: false };
        staging.mark(UNFINISHED)?;
        make_readable(&staging.path)?;
        Ok(staging)
    }

    fn mark(&self, name: &str) -> Result<(), Error> {
        let mark = self.path.join(name);
        create_new(&mark).map(drop).map_err(|e| Error::io(&mark, "write", e))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whatever happens now, what is in it is not to be removed.
    pub fn keep(&mut self) {
        self.kept = true;
    }

    /// Gives results that could not be put in place a name by which nobody takes them for something left behind.
    pub fn rescue(&self, target: &Path) -> PathBuf {
        let _ = fs::remove_file(self.path.join(UNFINISHED));
        let name = target.file_name().unwrap_or_default().to_string_lossy().into_owned();
        for k in 1..1000 {
            let place = target.with_file_name(format!("{name}.rescued-{k}"));
            if fs::symlink_metadata(&place).is_err() && fs::rename(&self.path, &place).is_ok() {
                return place;
            }
        }
        self.path.clone()
    }

    /// Puts what is staged, manifest included, in the place of the results of a directory. What was changed meanwhile is kept there.
    pub fn move_to(&mut self, target: &Path) -> Result<Vec<Kept>, Error> {
        if let Some(file) = conflict(&self.path, target)? {
            let reason = format!("{} there is not a file of these results", file.display());
            return Err(Error::refused(target, reason));
        }
        self.finish()?;
        let kept = if self.within && self.path.parent() == Some(target) {
            replace_entries(&self.path, target)?
        } else if is_folder(target) {
            keep_foreign(target, &self.path)?;
            exchange(&self.path, target)?;
            // The new results are in place; what cannot be removed of the old ones is left to the next who writes here.
            discard(&self.path, target).unwrap_or_default()
        } else {
            rename(&self.path, target)?;
            Vec::new()
        };
        sync(target)?;
        target.parent().map_or(Ok(()), sync)?;
        Ok(kept)
    }

    /// Adds what is staged to the results of a directory; files of the same names must be theirs. What was changed is kept there.
    pub fn add_to(&mut self, target: &Path) -> Result<Vec<Kept>, Error> {
        if let Some(file) = conflict(&self.path, target)? {
            return Err(Error::refused(
                target.join(file),
                "is not a file of the run; move it away",
            ));
        }
        let earlier = Manifest::read(target)?
            .ok_or_else(|| Error::refused(target, "is no longer the directory of a run"))?;
        let mut manifest = earlier.clone();
        manifest.add(&self.path, &files_in(&self.path)?)?;
        manifest.write(&self.path)?;
        self.mark(ADDITION)?;
        self.finish()?;
        // Once files are on their way, what is left of them belongs to whoever comes next.
        self.kept = true;
        let kept = move_entries(&self.path, target, Some(&earlier))?;
        sync(target)?;
        Ok(kept)
    }

    /// Everything on the disk, the mark of what is unfinished gone.
    fn finish(&self) -> Result<(), Error> {
        let mark = self.path.join(UNFINISHED);
        fs::remove_file(&mark).map_err(|e| Error::io(&mark, "remove", e))?;
        for file in files_in(&self.path)? {
            sync(&self.path.join(file))?;
        }
        let manifest = self.path.join(manifest::NAME);
        if manifest.exists() {
            sync(&manifest)?;
        }
        sync(&self.path)
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        if !self.kept {
            let _ = remove_all(&self.path);
        }
    }
}

/// A staged file whose name in the target is somebody's own, or a folder on the way to one that is a link or another disk.
fn conflict(staged: &Path, target: &Path) -> Result<Option<PathBuf>, Error> {
    let earlier = Manifest::read(target)?;
    let ours = |file: &Path| earlier.as_ref().is_some_and(|m| m.lists(file));
    let files = files_in(staged)?;
    if let Some(folder) = in_the_way(target, files.iter().map(PathBuf::as_path)) {
        return Ok(Some(folder));
    }
    Ok(files.into_iter().find(|f| fs::symlink_metadata(target.join(f)).is_ok() && !ours(f)))
}

/// Gives what is not the results' in one directory a second name in another, so that it is there from the first instant. Folders in which
/// no file of the results lies are the user's, empty or not.
fn keep_foreign(from: &Path, to: &Path) -> Result<(), Error> {
    let Some(manifest) = Manifest::read(from)? else { return Ok(()) };
    let is_of_results = |folder: &Path| manifest.listed().any(|file| file.starts_with(folder));
    for folder in folders_in(from)?.iter().filter(|folder| !is_of_results(folder)) {
        let within = Place::within(to, &folder.join("file"));
        within.map_err(|e| Error::io(to.join(folder), "create", e))?;
        make_like(&to.join(folder), &from.join(folder));
    }
    for file in files_in(from)?.into_iter().filter(|f| !manifest.lists(f)) {
        Place::within(to, &file).map_err(|e| Error::io(to.join(&file), "create", e))?;
        // Where links cannot be made, it is moved after the exchange.
        let _ = fs::hard_link(from.join(&file), to.join(&file));
    }
    Ok(())
}

/// Entry by entry, for a directory that cannot itself be moved. Should this process die once earlier results are put aside, the
/// next one goes on from there.
fn replace_entries(staged: &Path, target: &Path) -> Result<Vec<Kept>, Error> {
    let Some(earlier) = Manifest::read(target)? else { return move_entries(staged, target, None) };
    let aside = put_aside(&earlier, target)?;
    let mut kept = move_entries(staged, target, None)?;
    kept.extend(discard(&aside, target)?);
    Ok(kept)
}

fn put_aside(earlier: &Manifest, target: &Path) -> Result<PathBuf, Error> {
    let aside = directory_in(target, format!(".{ASIDE}"))?;
    // First the manifest: from here on the results are those put aside.
    rename(&target.join(manifest::NAME), &aside.join(manifest::NAME))?;
    let listed: Vec<PathBuf> = files_in(target)?.into_iter().filter(|f| earlier.lists(f)).collect();
    for file in &listed {
        move_file(&target.join(file), (&aside, file), None, &|_| Ok(true))?;
    }
    remove_emptied(target, listed.iter());
    Ok(aside)
}

/// Puts in order what processes that died have left in and beside a directory, whose lock is held; what was changed and is kept.
pub(super) fn recover(target: &Path) -> Result<Vec<Kept>, Error> {
    let mut kept = Vec::new();
    for left in left_behind(target, STAGED)? {
        // Before the mark is made and after the last file is gone, nothing is in it.
        let bare = Manifest::read(&left)?.is_none() && files_in(&left)?.is_empty();
        if bare || is_file(&left.join(UNFINISHED)) {
            remove_all(&left)?;
        } else if left.parent() == Some(target) {
            kept.extend(go_on(&left, target)?);
        } else if target.exists() {
            kept.extend(discard(&left, target)?);
        } else {
            rename(&left, target)?;
        }
    }
    for left in left_behind(target, ASIDE)? {
        kept.extend(restore(&left, target)?);
    }
    Ok(kept)
}

/// Whole results staged within the target: moved on if that had begun, or if they are additions.
fn go_on(staged: &Path, target: &Path) -> Result<Vec<Kept>, Error> {
    let whole = is_file(&staged.join(manifest::NAME));
    let adds = is_file(&staged.join(ADDITION));
    let earlier = Manifest::read(target)?;
    if whole && (adds || earlier.is_none()) {
        return move_entries(staged, target, earlier.as_ref());
    }
    remove_all(staged)?;
    Ok(Vec::new())
}

/// Results put aside: back where they were if none have taken their place.
fn restore(aside: &Path, target: &Path) -> Result<Vec<Kept>, Error> {
    if Manifest::read(target)?.is_some() {
        return match Manifest::read(aside)? {
            Some(_) => discard(aside, target),
            None => remove_folders(aside).map(|()| Vec::new()),
        };
    }
    if !target.exists() {
        return rename(aside, target).map(|()| Vec::new());
    }
    let (own, mut kept) = (Manifest::read(aside)?, Vec::new());
    for file in files_in(aside)? {
        let from = aside.join(&file);
        kept.extend(move_file(&from, (target, &file), own.as_ref(), &|_| Ok(false))?);
    }
    if own.is_some() {
        rename(&aside.join(manifest::NAME), &target.join(manifest::NAME))?;
    }
    remove_folders(aside)?;
    Ok(kept)
}

/// Exchanges two directories in one operation where the system has it.
fn exchange(staged: &Path, target: &Path) -> Result<(), Error> {
    let places = Place::of(staged).and_then(|a| Place::of(target).map(|b| (a, b)));
    let (a, b) = places.map_err(|e| Error::io(target, "replace", e))?;
    if a.exchange(&b) {
        return Ok(());
    }
    let aside = directory_in(target.parent().unwrap_or(target), hidden(target, ASIDE))?;
    rename(target, &aside)?;
    if let Err(error) = rename(staged, target) {
        let _ = fs::rename(&aside, target);
        return Err(error);
    }
    rename(&aside, staged)
}
