//! Files on their way from one directory to another.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use super::manifest::{self, Manifest};
use super::names::{ADDITION, UNFINISHED, files_in, folders_in};
use crate::error::Error;
use crate::place::Place;
use crate::unfinished::keep;

/// Something that was changed, or came to stand in a place, since it was looked at: where it stood, and where it is kept.
pub(super) type Kept = (PathBuf, PathBuf);

/// Moves a file to its place below a directory. What stands there goes if `may_go`; else it is kept beside.
///
/// With `new`, the list of files that are being moved, a file that is in its place already is known: then what remains under the old
/// name is what it replaced.
pub(super) fn move_file(
    from: &Path,
    (root, file): (&Path, &Path),
    new: Option<&Manifest>,
    may_go: &dyn Fn(&Path) -> Result<bool, Error>,
) -> Result<Option<Kept>, Error> {
    let fault = |e| Error::io(from, &format!("move to {}", root.join(file).display()), e);
    let what = Place::of(from).map_err(fault)?;
    let place = Place::within(root, file).map_err(fault)?;
    let is_there = match new {
        Some(new) if place.is_taken() => new.is_as_written(root, file)?,
        _ => false,
    };
    if !is_there {
        if !place.is_taken() {
            what.rename(&place).map_err(fault)?;
            return Ok(None);
        }
        // Exchanged first and looked at then: nobody comes between.
        if !what.exchange(&place) {
            let kept = match may_go(place.path())? {
                true => None,
                false => Some(keep(&place, &place).map_err(fault)?),
            };
            what.rename(&place).map_err(fault)?;
            return Ok(kept.map(|kept| (root.join(file), kept)));
        }
    }
    if may_go(what.path())? {
        what.remove().map_err(fault)?;
        return Ok(None);
    }
    Ok(Some((root.join(file), keep(&what, &place).map_err(fault)?)))
}

/// Everything staged into the target, the manifest last. Files there go if they are as `earlier` results have them.
pub(super) fn move_entries(
    staged: &Path,
    target: &Path,
    earlier: Option<&Manifest>,
) -> Result<Vec<Kept>, Error> {
    let new = Manifest::read(staged)?;
    let mut all = Vec::new();
    for file in files_in(staged)? {
        let may_go = |there: &Path| -> Result<bool, Error> {
            let known = [earlier, new.as_ref()].into_iter().flatten();
            let description = manifest::described(there)?;
            Ok(known.into_iter().any(|known| known.is_described(&file, &description)))
        };
        all.extend(move_file(&staged.join(&file), (target, &file), new.as_ref(), &may_go)?);
    }
    rename(&staged.join(manifest::NAME), &target.join(manifest::NAME))?;
    remove_folders(staged)?;
    Ok(all)
}

/// Removes earlier results from where they now are. What is not theirs goes to the new place; what was changed, or whose name is taken
/// there, is kept there under another name.
pub(super) fn discard(old: &Path, new: &Path) -> Result<Vec<Kept>, Error> {
    let Some(manifest) = Manifest::read(old)? else { return Ok(Vec::new()) };
    let mut all = Vec::new();
    for file in files_in(old)? {
        let here = old.join(&file);
        if manifest.is_as_written(old, &file)? || is_one_file(&here, &new.join(&file)) {
            fs::remove_file(&here).map_err(|e| Error::io(&here, "remove", e))?;
            continue;
        }
        let fault = |e| Error::io(&here, "keep", e);
        let what = Place::of(&here).map_err(fault)?;
        let place = Place::within(new, &file).map_err(fault)?;
        if !manifest.lists(&file) && !place.is_taken() {
            what.rename(&place).map_err(fault)?;
        } else {
            all.push((new.join(&file), keep(&what, &place).map_err(fault)?));
        }
    }
    remove_folders(old)?;
    Ok(all)
}

/// Removes a directory of this program and the folders in it, if no file is in them but those by which results are put in place; the
/// list of files goes last.
pub(super) fn remove_folders(dir: &Path) -> Result<(), Error> {
    for folder in folders_in(dir)?.iter().rev() {
        let folder = dir.join(folder);
        fs::remove_dir(&folder).map_err(|e| Error::io(&folder, "remove", e))?;
    }
    if files_in(dir)?.is_empty() {
        for name in [UNFINISHED, ADDITION, manifest::NAME] {
            let _ = fs::remove_file(dir.join(name));
        }
    }
    fs::remove_dir(dir).map_err(|e| Error::io(dir, "remove", e))
}

/// Removes a directory of this program and all that is in it. What marks it as that goes last, should this process die meanwhile.
pub(super) fn remove_all(dir: &Path) -> Result<(), Error> {
    for file in files_in(dir)? {
        let file = dir.join(file);
        fs::remove_file(&file).map_err(|e| Error::io(&file, "remove", e))?;
    }
    remove_folders(dir)
}

/// Removes folders that have become empty, of those in which the files of earlier results lay.
pub(super) fn remove_emptied<'f>(dir: &Path, files: impl Iterator<Item = &'f PathBuf>) {
    for file in files {
        for folder in file.ancestors().skip(1).filter(|folder| !folder.as_os_str().is_empty()) {
            let _ = fs::remove_dir(dir.join(folder));
        }
    }
}

pub(super) fn rename(from: &Path, to: &Path) -> Result<(), Error> {
    fs::rename(from, to).map_err(|e| Error::io(from, &format!("move to {}", to.display()), e))
}

/// Waits until a file or a directory has reached the disk; a file system that cannot say so is believed.
pub(super) fn sync(path: &Path) -> Result<(), Error> {
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
