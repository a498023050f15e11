//! How a staged directory takes the place of an earlier one, and what is done about one left by a process that died.

use std::ffi::OsString;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use super::manifest::{self, Manifest, files_in};
use crate::error::Error;

/// Stands in a staging directory until it is whole: what holds it may be removed by whoever finds it.
const UNFINISHED: &str = ".percuss-unfinished";
/// Stands in one whose files are added to earlier results, which stay.
const ADDITION: &str = ".percuss-addition";
/// What names of staging directories and of results put aside begin with, after the name of the target.
const STAGED: &str = "percuss-staged-";
const ASIDE: &str = "percuss-aside-";

/// A directory of a random name in which results are written.
#[derive(Debug)]
pub(super) struct Staging {
    path: PathBuf,
    /// Whether it lies in the target, which cannot itself be moved.
    within: bool,
    kept: bool,
}

impl Staging {
    /// Beside the target; within it where that is empty, or a disk of its own.
    pub fn new(target: &Path) -> Result<Self, Error> {
        if target.is_dir() && (is_mount_point(target) || is_empty(target)?) {
            return Self::within(target);
        }
        Self::make(target.parent().unwrap_or(target), &hidden(target, STAGED), false)
    }

    /// Within a directory.
    pub fn within(target: &Path) -> Result<Self, Error> {
        Self::make(target, &OsString::from(format!(".{STAGED}")), true)
    }

    fn make(parent: &Path, prefix: &OsString, within: bool) -> Result<Self, Error> {
        let made = tempfile::Builder::new().prefix(prefix).rand_bytes(10).tempdir_in(parent);
        let path = made.map_err(|e| Error::io(parent, "create a directory in", e))?.keep();
        let staging = Self { path, within, kept: false };
        let mark = staging.path.join(UNFINISHED);
        fs::write(&mark, "").map_err(|e| Error::io(&mark, "write", e))?;
        readable(&staging.path)?;
        Ok(staging)
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

    /// Puts what is staged, manifest included, in the place of the results of a directory.
    pub fn move_to(&mut self, target: &Path) -> Result<(), Error> {
        let conflict = conflict(&self.path, target)?;
        if let Some(file) = conflict {
            let reason = format!("{} there is not a file of these results", file.display());
            return Err(Error::refused(target, reason));
        }
        self.finish()?;
        if self.within && self.path.parent() == Some(target) {
            replace_entries(&self.path, target)?;
        } else if target.exists() {
            keep_foreign(target, &self.path)?;
            exchange(&self.path, target)?;
            // The new results are in place; what cannot be removed of the old ones is left to the next who writes here.
            let _ = discard(&self.path, target);
        } else {
            rename(&self.path, target)?;
        }
        sync(target)?;
        target.parent().map_or(Ok(()), sync)
    }

    /// Adds what is staged to the results of a directory; files of the same names must be theirs.
    pub fn add_to(&mut self, target: &Path) -> Result<(), Error> {
        if let Some(file) = conflict(&self.path, target)? {
            return Err(Error::refused(
                target.join(file),
                "is not a file of the run; move it away",
            ));
        }
        let mut manifest = Manifest::read(target)?
            .ok_or_else(|| Error::refused(target, "is no longer the directory of a run"))?;
        manifest.add(&self.path, &files_in(&self.path)?)?;
        manifest.write(&self.path)?;
        let mark = self.path.join(ADDITION);
        fs::write(&mark, "").map_err(|e| Error::io(&mark, "write", e))?;
        self.finish()?;
        // Once files are on their way, what is left of them belongs to whoever comes next.
        self.kept = true;
        move_entries(&self.path, target)?;
        sync(target)
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
            let _ = fs::remove_dir_all(&self.path);
        }
    }
}

/// A staged file whose name in the target is somebody's own.
fn conflict(staged: &Path, target: &Path) -> Result<Option<PathBuf>, Error> {
    let earlier = Manifest::read(target)?;
    let ours = |file: &Path| earlier.as_ref().is_some_and(|m| m.lists(file));
    let files = files_in(staged)?;
    Ok(files.into_iter().find(|f| fs::symlink_metadata(target.join(f)).is_ok() && !ours(f)))
}

/// Gives what is not the results' in one directory a second name in another, so that it is there from the first instant.
fn keep_foreign(from: &Path, to: &Path) -> Result<(), Error> {
    let Some(manifest) = Manifest::read(from)? else { return Ok(()) };
    for file in files_in(from)?.into_iter().filter(|f| !manifest.lists(f)) {
        let place = to.join(&file);
        make_parent(&place)?;
        // Where links cannot be made, it is moved after the exchange.
        let _ = fs::hard_link(from.join(&file), &place);
    }
    Ok(())
}

/// Removes earlier results from where they now are; what is not theirs goes to the new place unless it is there.
fn discard(old: &Path, new: &Path) -> Result<(), Error> {
    let Some(manifest) = Manifest::read(old)? else { return Ok(()) };
    for file in files_in(old)? {
        let (here, there) = (old.join(&file), new.join(&file));
        if manifest.lists(&file) || is_one_file(&here, &there) {
            fs::remove_file(&here).map_err(|e| Error::io(&here, "remove", e))?;
        } else if fs::symlink_metadata(&there).is_err() {
            move_file(&here, &there)?;
        }
    }
    let mark = old.join(manifest::NAME);
    remove_empty(old, &mark)
}

/// Removes folders without files; the manifest goes last.
fn remove_empty(dir: &Path, manifest: &Path) -> Result<(), Error> {
    if files_in(dir)?.is_empty() {
        let _ = fs::remove_file(manifest);
        return fs::remove_dir_all(dir).map_err(|e| Error::io(dir, "remove", e));
    }
    Ok(())
}

/// Entry by entry, for a directory that cannot itself be moved. Should this process die once earlier results are put aside, the
/// next one goes on from there.
fn replace_entries(staged: &Path, target: &Path) -> Result<(), Error> {
    if let Some(earlier) = Manifest::read(target)? {
        let aside = put_aside(&earlier, target)?;
        move_entries(staged, target)?;
        return fs::remove_dir_all(&aside).map_err(|e| Error::io(&aside, "remove", e));
    }
    move_entries(staged, target)
}

/// Everything staged into the target, the manifest last.
fn move_entries(staged: &Path, target: &Path) -> Result<(), Error> {
    for file in files_in(staged)? {
        move_file(&staged.join(&file), &target.join(&file))?;
    }
    rename(&staged.join(manifest::NAME), &target.join(manifest::NAME))?;
    fs::remove_dir_all(staged).map_err(|e| Error::io(staged, "remove", e))
}

fn put_aside(earlier: &Manifest, target: &Path) -> Result<PathBuf, Error> {
    let made =
        tempfile::Builder::new().prefix(&format!(".{ASIDE}")).rand_bytes(10).tempdir_in(target);
    let aside = made.map_err(|e| Error::io(target, "create a directory in", e))?.keep();
    // First the manifest: from here on the results are those put aside.
    rename(&target.join(manifest::NAME), &aside.join(manifest::NAME))?;
    for file in files_in(target)?.into_iter().filter(|f| earlier.lists(f)) {
        move_file(&target.join(&file), &aside.join(&file))?;
    }
    Ok(aside)
}

/// Puts in order what processes that died have left in and beside a directory, whose lock is held.
pub(super) fn recover(target: &Path) -> Result<(), Error> {
    for left in left_behind(target, STAGED)? {
        // Before the mark is made and after the last file is gone, nothing is in it.
        let bare = Manifest::read(&left)?.is_none() && files_in(&left)?.is_empty();
        if bare || left.join(UNFINISHED).exists() {
            fs::remove_dir_all(&left).map_err(|e| Error::io(&left, "remove", e))?;
        } else if left.parent() == Some(target) {
            go_on(&left, target)?;
        } else if target.exists() {
            discard(&left, target)?;
        } else {
            rename(&left, target)?;
        }
    }
    for left in left_behind(target, ASIDE)? {
        put_back(&left, target)?;
    }
    Ok(())
}

/// Directories that begin with `.<word>` in the target, and with `.<name of the target>.<word>` beside it.
fn left_behind(target: &Path, word: &str) -> Result<Vec<PathBuf>, Error> {
    let here = target.is_dir().then(|| (target, format!(".{word}")));
    let beside = target.parent().map(|p| (p, hidden(target, word).to_string_lossy().into_owned()));
    let mut found = Vec::new();
    for (folder, prefix) in here.into_iter().chain(beside) {
        let names = names_in(folder)?;
        let ours = names.iter().filter(|name| name.to_string_lossy().starts_with(&prefix));
        found.extend(ours.map(|name| folder.join(name)).filter(|path| path.is_dir()));
    }
    Ok(found)
}

/// Whole results staged within the target: moved on if that had begun, or if they are additions.
fn go_on(staged: &Path, target: &Path) -> Result<(), Error> {
    let whole = staged.join(manifest::NAME).is_file();
    let adds = staged.join(ADDITION).is_file();
    if whole && (adds || Manifest::read(target)?.is_none()) {
        return move_entries(staged, target);
    }
    fs::remove_dir_all(staged).map_err(|e| Error::io(staged, "remove", e))
}

/// Results put aside: back where they were if none have taken their place.
fn put_back(aside: &Path, target: &Path) -> Result<(), Error> {
    if Manifest::read(target)?.is_some() {
        return fs::remove_dir_all(aside).map_err(|e| Error::io(aside, "remove", e));
    }
    if !target.exists() {
        return rename(aside, target);
    }
    for file in files_in(aside)? {
        move_file(&aside.join(&file), &target.join(&file))?;
    }
    rename(&aside.join(manifest::NAME), &target.join(manifest::NAME))?;
    fs::remove_dir_all(aside).map_err(|e| Error::io(aside, "remove", e))
}

/// `.<name of the target>.<word>`.
fn hidden(target: &Path, word: &str) -> OsString {
    let mut name = OsString::from(".");
    name.push(target.file_name().unwrap_or_default());
    name.push(".");
    name.push(word);
    name
}

fn names_in(folder: &Path) -> Result<Vec<OsString>, Error> {
    let list = fs::read_dir(folder).map_err(|e| Error::io(folder, "list", e))?;
    Ok(list.filter_map(|entry| entry.ok().map(|e| e.file_name())).collect())
}

/// Whether a directory holds nothing, or nothing but a lock.
pub(super) fn is_empty(directory: &Path) -> Result<bool, Error> {
    let lock = |name: &OsString| name.to_string_lossy().ends_with(".percuss.lock");
    Ok(names_in(directory)?.iter().all(lock))
}

#[cfg(unix)]
pub(super) fn is_mount_point(directory: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let device = |path: &Path| fs::metadata(path).map(|m| m.dev()).ok();
    directory.parent().is_some_and(|parent| device(parent) != device(directory))
}

#[cfg(not(unix))]
pub(super) fn is_mount_point(_directory: &Path) -> bool {
    false
}

#[cfg(unix)]
fn is_one_file(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |path: &Path| fs::symlink_metadata(path).map(|m| (m.dev(), m.ino())).ok();
    id(a).is_some() && id(a) == id(b)
}

#[cfg(not(unix))]
fn is_one_file(_a: &Path, _b: &Path) -> bool {
    false
}

/// Exchanges two directories in one operation where the system has it.
fn exchange(staged: &Path, target: &Path) -> Result<(), Error> {
    if exchanged_at_once(staged, target) {
        return Ok(());
    }
    let parent = target.parent().unwrap_or(target);
    let prefix = hidden(target, ASIDE);
    let made = tempfile::Builder::new().prefix(&prefix).rand_bytes(10).tempdir_in(parent);
    let aside = made.map_err(|e| Error::io(parent, "create a directory in", e))?.keep();
    rename(target, &aside)?;
    if let Err(error) = rename(staged, target) {
        let _ = fs::rename(&aside, target);
        return Err(error);
    }
    rename(&aside, staged)
}

#[cfg(target_os = "linux")]
fn exchanged_at_once(a: &Path, b: &Path) -> bool {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    renameat_with(CWD, a, CWD, b, RenameFlags::EXCHANGE).is_ok()
}

#[cfg(not(target_os = "linux"))]
fn exchanged_at_once(_a: &Path, _b: &Path) -> bool {
    false
}

fn rename(from: &Path, to: &Path) -> Result<(), Error> {
    fs::rename(from, to).map_err(|e| Error::io(from, &format!("move to {}", to.display()), e))
}

fn move_file(from: &Path, to: &Path) -> Result<(), Error> {
    make_parent(to)?;
    rename(from, to)
}

fn make_parent(path: &Path) -> Result<(), Error> {
    let parent = path.parent().unwrap_or(path);
    fs::create_dir_all(parent).map_err(|e| Error::io(parent, "create", e))
}

/// Waits until a file or a directory has reached the disk; a file system that cannot say so is believed.
fn sync(path: &Path) -> Result<(), Error> {
    let is_link = fs::symlink_metadata(path).is_ok_and(|m| m.is_symlink());
    if is_link || (path.is_dir() && !cfg!(unix)) {
        return Ok(());
    }
    let done = File::open(path).and_then(|file| file.sync_all());
    match done {
        Err(e) if e.kind() != std::io::ErrorKind::InvalidInput => Err(Error::io(path, "write", e)),
        _ => Ok(()),
    }
}

/// Temporary directories are their owner's alone; results are as readable as other directories.
#[cfg(unix)]
fn readable(dir: &Path) -> Result<(), Error> {
    use std::os::unix::fs::PermissionsExt;
    // What the system gives a new directory, its mask applied.
    let probe = dir.join(".mode");
    fs::create_dir(&probe).map_err(|e| Error::io(&probe, "create", e))?;
    let mode = fs::metadata(&probe).map(|m| m.permissions().mode());
    let _ = fs::remove_dir(&probe);
    let mode = mode.map_err(|e| Error::io(&probe, "look at", e))?;
    let set = fs::set_permissions(dir, fs::Permissions::from_mode(mode));
    set.map_err(|e| Error::io(dir, "set permissions of", e))
}

#[cfg(not(unix))]
fn readable(_dir: &Path) -> Result<(), Error> {
    Ok(())
}
