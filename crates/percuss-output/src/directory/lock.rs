//! One process fills a directory at a time.

use std::fs::{self, File};
use std::io::{Read as _, Seek as _, Write as _};
use std::path::{Path, PathBuf};

use percuss_codes::FileCode;

use super::likeness::is_mount_point;
use super::names::LOCK;
use crate::error::Error;
use crate::files::{Exclusive, open_exclusively};

/// A lock on a directory of results, which need not exist yet; let go when dropped, or when the process dies.
///
/// The system keeps it, by file and not by process number: two containers that share a disk see each other.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    /// Takes it.
    ///
    /// # Errors
    /// If another process has it, which the error names as far as it said who it is.
    pub fn take(given: &Path, target: &Path) -> Result<Self, Error> {
        let path = place(target);
        let opened = open_exclusively(&path).map_err(|e| Error::io(&path, "lock", e))?;
        let mut file = match opened {
            Exclusive::Ours(file) => file,
            Exclusive::Taken(mut file) => return Err(taken(given, &mut file)),
        };
        let who = format!("process {} on {}", std::process::id(), host());
        let _ = file.write_all(who.as_bytes());
        Ok(Self { path, _file: file })
    }
}

impl Lock {
    /// Its file.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}

/// Beside the directory; in it where it is a disk of its own, whose surroundings others need not share.
fn place(target: &Path) -> PathBuf {
    if target.is_dir() && is_mount_point(target) {
        return target.join(LOCK);
    }
    let name = target.file_name().unwrap_or_default().to_os_string();
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(name);
    hidden.push(".percuss.lock");
    target.with_file_name(hidden)
}

fn taken(given: &Path, file: &mut File) -> Error {
    let mut who = String::new();
    let _ = file.rewind().and_then(|()| file.take(200).read_to_string(&mut who));
    let who = if who.is_empty() { "another process".to_owned() } else { who };
    let reason = format!("locked by {who}; wait, or choose another --out");
    Error::of(FileCode::Busy, given, reason)
}

#[cfg(unix)]
fn host() -> String {
    rustix::system::uname().nodename().to_string_lossy().into_owned()
}

#[cfg(not(unix))]
fn host() -> String {
    std::env::var("COMPUTERNAME").unwrap_or_else(|_| "this machine".to_owned())
}
