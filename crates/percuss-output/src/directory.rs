//! The directory of a run, put in place in one piece.

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::Error;

/// What a directory of results holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Results {
    /// A run.
    Run,
    /// Natural modes.
    Modes,
    /// An equilibrium path.
    Path,
}

impl Results {
    /// What may be left in the directory; everything else found there is somebody's own and is kept.
    fn ours(self) -> &'static [&'static str] {
        match self {
            Self::Run => &[
                "scenario.toml",
                "summary.json",
                "history.parquet",
                "history.csv",
                "history.units.json",
                "comparison.csv",
                "envelopes.csv",
                "impacts.csv",
                "report.html",
                "figures",
                "fields",
            ],
            Self::Modes => &["modes.json", "shapes.csv", "modes.svg", "modes.png", "modes.html"],
            Self::Path => &["path.json", "path.csv", "path.svg", "path.png"],
        }
    }

    /// The file by which such a directory is known; put in place last.
    fn marker(self) -> &'static str {
        match self {
            Self::Run => "summary.json",
            Self::Modes => "modes.json",
            Self::Path => "path.json",
        }
    }

    /// What it looks like, in words.
    fn words(self) -> &'static str {
        match self {
            Self::Run => "a run",
            Self::Modes => "the modes of a scenario",
            Self::Path => "an equilibrium path",
        }
    }
}

/// A directory being filled, out of sight until [`RunDirectory::commit`].
///
/// Files are written to a staging directory, `.<name>.partial-<pid>` beside the final one; where the
/// final directory exists already and is empty or a mount point, the staging directory lies in it.
/// Dropped without a commit, the staging directory is removed and nothing has happened.
#[derive(Debug)]
pub struct RunDirectory {
    target: PathBuf,
    staging: PathBuf,
    results: Results,
    within: bool,
    committed: bool,
}

impl RunDirectory {
    /// Prepares the staging directory for `target`.
    ///
    /// # Errors
    /// If `target` is a file, or a directory that is neither empty nor holds a run, or if the staging
    /// directory cannot be made.
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
        let exists = target.exists();
        if exists {
            refuse_foreign(results, given, &target)?;
        }
        let within = exists && (is_empty(&target)? || is_mount_point(&target));
        let staging = staging_path(&target, "partial", within)?;
        if !exists && let Some(parent) = target.parent() {
            fs::create_dir_all(parent).map_err(|e| Error::io(parent, "create", e))?;
        }
        let _ = fs::remove_dir_all(&staging);
        fs::create_dir(&staging).map_err(|e| Error::io(&staging, "create", e))?;
        Ok(Self { target, staging, results, within, committed: false })
    }

    /// Where to write until the commit.
    pub fn path(&self) -> &Path {
        &self.staging
    }

    /// Where everything will be after the commit.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Puts the new directory in the place of the old one, of which only foreign files survive.
    ///
    /// # Errors
    /// If something cannot be moved; the new files then remain in the staging directory, which the
    /// error names.
    pub fn commit(mut self) -> Result<PathBuf, Error> {
        self.committed = true; // whatever happens now, the results are not to be removed
        let done = if self.within { self.swap_entries() } else { self.swap_directory() };
        done.map_err(|e| {
            let staging = self.staging.display();
            Error::io(&self.target, "replace", format!("{e}; the results are in {staging}"))
        })?;
        Ok(self.target.clone())
    }

    /// Old directory away, new one in, foreign files over, old one deleted.
    fn swap_directory(&self) -> Result<(), Error> {
        if !self.target.exists() {
            return rename(&self.staging, &self.target);
        }
        let old = staging_path(&self.target, "old", false)?;
        let _ = fs::remove_dir_all(&old);
        rename(&self.target, &old)?;
        if let Err(error) = rename(&self.staging, &self.target) {
            let _ = fs::rename(&old, &self.target);
            return Err(error);
        }
        for name in entries(&old)? {
            if !self.results.ours().contains(&name.as_str()) && !self.target.join(&name).exists() {
                rename(&old.join(&name), &self.target.join(&name))?;
            }
        }
        fs::remove_dir_all(&old).map_err(|e| Error::io(&old, "remove", e))
    }

    /// The same entry by entry, its marker last, for a directory that cannot itself be moved.
    fn swap_entries(&self) -> Result<(), Error> {
        for name in self.results.ours() {
            remove(&self.target.join(name))?;
        }
        let mut names = entries(&self.staging)?;
        names.sort_by_key(|name| name == self.results.marker());
        for name in names {
            rename(&self.staging.join(&name), &self.target.join(&name))?;
        }
        fs::remove_dir(&self.staging).map_err(|e| Error::io(&self.staging, "remove", e))
    }
}

impl Drop for RunDirectory {
    fn drop(&mut self) {
        if !self.committed {
            let _ = fs::remove_dir_all(&self.staging);
        }
    }
}

/// The real place of `path`, links followed where it exists.
fn resolve(path: &Path) -> Result<PathBuf, Error> {
    let resolved = if path.exists() { path.canonicalize() } else { std::path::absolute(path) };
    let resolved = resolved.map_err(|e| Error::io(path, "resolve", e))?;
    if resolved.file_name().is_none() {
        return Err(Error::refused(path, "this cannot be the directory of a run"));
    }
    Ok(resolved)
}

fn refuse_foreign(results: Results, given: &Path, target: &Path) -> Result<(), Error> {
    if !target.is_dir() {
        return Err(Error::refused(given, "exists and is not a directory; give another --out"));
    }
    let (marker, words) = (results.marker(), results.words());
    if !is_empty(target)? && !target.join(marker).is_file() {
        let reason = format!(
            "is not empty and does not look like {words} (it has no {marker}), so it is left alone; \
             give another --out or remove it yourself"
        );
        return Err(Error::refused(given, reason));
    }
    Ok(())
}

/// `.<name>.<word>-<pid>` beside `target`, or `.<word>-<pid>` within it.
fn staging_path(target: &Path, word: &str, within: bool) -> Result<PathBuf, Error> {
    let pid = std::process::id();
    if within {
        return Ok(target.join(format!(".{word}-{pid}")));
    }
    let name = target.file_name().ok_or_else(|| Error::refused(target, "has no name"))?;
    Ok(target.with_file_name(format!(".{}.{word}-{pid}", name.to_string_lossy())))
}

fn entries(directory: &Path) -> Result<Vec<String>, Error> {
    let list = fs::read_dir(directory).map_err(|e| Error::io(directory, "list", e))?;
    list.map(|entry| {
        entry
            .map(|e| e.file_name().to_string_lossy().into_owned())
            .map_err(|e| Error::io(directory, "list", e))
    })
    .collect()
}

fn is_empty(directory: &Path) -> Result<bool, Error> {
    Ok(entries(directory)?.is_empty())
}

#[cfg(unix)]
fn is_mount_point(directory: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let device = |path: &Path| fs::metadata(path).map(|m| m.dev()).ok();
    directory.parent().is_some_and(|parent| device(parent) != device(directory))
}

#[cfg(not(unix))]
fn is_mount_point(_directory: &Path) -> bool {
    false
}

fn rename(from: &Path, to: &Path) -> Result<(), Error> {
    fs::rename(from, to).map_err(|e| Error::io(from, &format!("move to {}", to.display()), e))
}

fn remove(path: &Path) -> Result<(), Error> {
    let removed = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
    match removed {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(Error::io(path, "remove", e)),
        _ => Ok(()),
    }
}
