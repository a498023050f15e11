//! Names that serve to put results in place, and what else stands in a directory of results.

use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};

use super::manifest::{self, Manifest};
use crate::error::Error;

/// Stands in a staging directory until it is whole: what holds it may be removed by whoever finds it.
pub(super) const UNFINISHED: &str = ".percuss-unfinished";
/// Stands in one whose files are added to earlier results, which stay.
pub(super) const ADDITION: &str = ".percuss-addition";
/// What names of staging directories and of results put aside begin with, after the name of the target.
pub(super) const STAGED: &str = "percuss-staged-";
pub(super) const ASIDE: &str = "percuss-aside-";
/// Random letters and digits behind them.
const RANDOM: usize = 10;
/// The lock of a directory that is a disk of its own.
pub(super) const LOCK: &str = ".percuss.lock";

/// A new directory of a random name.
pub(super) fn directory_in(parent: &Path, prefix: impl AsRef<OsStr>) -> Result<PathBuf, Error> {
    let mut builder = tempfile::Builder::new();
    let made = builder.prefix(&prefix).rand_bytes(RANDOM).tempdir_in(parent);
    Ok(made.map_err(|e| Error::io(parent, "create a directory in", e))?.keep())
}

/// `.<name of the target>.<word>`.
pub(super) fn hidden(target: &Path, word: &str) -> OsString {
    let mut name = OsString::from(".");
    name.push(target.file_name().unwrap_or_default());
    name.push(".");
    name.push(word);
    name
}

/// Whether a name is a prefix and as many random letters and digits as this program puts behind it.
fn is_random(name: &OsStr, prefix: &OsStr) -> bool {
    let rest = name.as_encoded_bytes().strip_prefix(prefix.as_encoded_bytes());
    rest.is_some_and(|rest| rest.len() == RANDOM && rest.iter().all(u8::is_ascii_alphanumeric))
}

/// Whether what bears a name at the top of a directory of results serves to put results in place. All else is a file of the results or
/// the user's, however its name begins.
fn is_own(dir: &Path, name: &OsStr) -> Result<bool, Error> {
    if [manifest::NAME, UNFINISHED, ADDITION, LOCK].iter().any(|own| name == OsStr::new(own)) {
        return Ok(true);
    }
    let path = dir.join(name);
    let is_named = |word: &&str| is_random(name, format!(".{word}").as_ref());
    Ok([STAGED, ASIDE].iter().any(is_named) && is_folder(&path) && is_of_this_program(&path)?)
}

/// Directories of this program's making: `.<word>` and random letters in the target, `.<name of the target>.<word>` and random letters
/// beside it. What only bears such a name is left alone, and so are links.
pub(super) fn left_behind(target: &Path, word: &str) -> Result<Vec<PathBuf>, Error> {
    let here = target.is_dir().then(|| (target, OsString::from(format!(".{word}"))));
    let beside = target.parent().map(|parent| (parent, hidden(target, word)));
    let mut found = Vec::new();
    for (folder, prefix) in here.into_iter().chain(beside) {
        for name in names_in(folder)?.iter().filter(|name| is_random(name, &prefix)) {
            let path = folder.join(name);
            if is_folder(&path) && is_of_this_program(&path)? {
                found.push(path);
            }
        }
    }
    Ok(found)
}

/// Whether what stands in a directory says so: a mark, a list of files, or nothing, as before the first and after the last file.
fn is_of_this_program(directory: &Path) -> Result<bool, Error> {
    let has = |name: &str| is_file(&directory.join(name));
    Ok(has(UNFINISHED)
        || has(ADDITION)
        || Manifest::read(directory)?.is_some()
        || files_in(directory)?.is_empty())
}

/// A folder, not a link to one.
pub(super) fn is_folder(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| found.is_dir())
}

/// A file, not a link to one.
pub(super) fn is_file(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| found.is_file())
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

/// Paths of all files in a directory and below; links are files. What serves to put results in place, the manifest among it,
/// stands at the top under names of its own and is left out.
pub(super) fn files_in(dir: &Path) -> Result<Vec<PathBuf>, Error> {
    Ok(content(dir)?.0)
}

/// Paths of all folders in a directory and below, those within others behind them.
pub(super) fn folders_in(dir: &Path) -> Result<Vec<PathBuf>, Error> {
    Ok(content(dir)?.1)
}

fn content(dir: &Path) -> Result<(Vec<PathBuf>, Vec<PathBuf>), Error> {
    let (mut files, mut folders) = (Vec::new(), Vec::new());
    let mut waiting = vec![PathBuf::new()];
    while let Some(folder) = waiting.pop() {
        let place = dir.join(&folder);
        for entry in fs::read_dir(&place).map_err(|e| Error::io(&place, "list", e))? {
            let entry = entry.map_err(|e| Error::io(&place, "list", e))?;
            let path = folder.join(entry.file_name());
            if is_own(dir, path.as_os_str())? {
                continue;
            }
            let kind = entry.file_type().map_err(|e| Error::io(entry.path(), "look at", e))?;
            if kind.is_dir() {
                folders.push(path.clone());
                waiting.push(path);
            } else {
                files.push(path);
            }
        }
    }
    files.sort();
    folders.sort();
    Ok((files, folders))
}

/// The first folder on the way to one of the files, within a directory, that is none: a link, or a disk of its own. Nothing is moved
/// through it.
pub(super) fn in_the_way<'f>(
    dir: &Path,
    files: impl IntoIterator<Item = &'f Path>,
) -> Option<PathBuf> {
    let is_way = |folder: &&Path| match fs::symlink_metadata(dir.join(folder)) {
        Ok(found) => found.is_dir() && is_on_disk_of(&found, dir),
        Err(_) => true,
    };
    let folders =
        |file: &'f Path| file.ancestors().skip(1).filter(|folder| !folder.as_os_str().is_empty());
    files.into_iter().flat_map(folders).find(|folder| !is_way(folder)).map(Path::to_owned)
}

#[cfg(unix)]
fn is_on_disk_of(found: &fs::Metadata, dir: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    fs::metadata(dir).is_ok_and(|dir| dir.dev() == found.dev())
}

#[cfg(not(unix))]
fn is_on_disk_of(_found: &fs::Metadata, _dir: &Path) -> bool {
    true
}
