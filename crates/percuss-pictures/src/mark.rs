//! Files that this program wrote say so, and no others are replaced.

use std::fs::{self, File};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use percuss_output::{Exclusive, open_exclusively};

use crate::error::Error;

/// What stands in every file, as a comment of its format.
pub(crate) const MARK: &str = concat!("made by percuss ", env!("CARGO_PKG_VERSION"));
/// What it begins with in any version.
const ANY: &[u8] = b"made by percuss ";
/// Bytes at either end of a file in which it is looked for.
const ENDS: u64 = 1 << 17;

/// An SVG text that says who wrote it.
pub fn marked(svg: &str) -> String {
    format!("<!-- {MARK} -->\n{svg}")
}

/// Whether a file says that this program wrote it.
pub fn is_ours(path: &Path) -> bool {
    let look = || -> std::io::Result<bool> {
        let mut file = File::open(path)?;
        let length = file.metadata()?.len();
        let mut bytes = Vec::new();
        Read::by_ref(&mut file).take(ENDS).read_to_end(&mut bytes)?;
        file.seek(SeekFrom::Start(length.saturating_sub(ENDS)))?;
        file.take(ENDS).read_to_end(&mut bytes)?;
        Ok(bytes.windows(ANY.len()).any(|window| window == ANY))
    };
    look().unwrap_or(false)
}

/// Where a file grows until it is finished: beside its place, under a name of its own.
pub fn unfinished(out: &Path) -> PathBuf {
    let name = out.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    out.with_file_name(format!(".{name}.percuss.partial"))
}

/// A file that is not finished: one process writes it at a time, and what a dead one left is written over.
///
/// Dropped before it is put in place, it is removed.
#[derive(Debug)]
pub(crate) struct Unfinished {
    path: PathBuf,
    file: File,
    placed: bool,
}

impl Unfinished {
    /// An empty one, for a file that will be `out`.
    ///
    /// # Errors
    /// If the system refuses, or another process is writing it.
    pub fn of(out: &Path) -> Result<Self, Error> {
        let path = unfinished(out);
        let cannot = |source| Error::io(out, "write", &source);
        match open_exclusively(&path).map_err(cannot)? {
            Exclusive::Taken(_) => Err(Error::busy(out)),
            Exclusive::Ours(file) => {
                file.set_len(0).map_err(cannot)?;
                Ok(Self { path, file, placed: false })
            }
        }
    }

    /// Where it is.
    #[cfg(feature = "drawing")]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Puts it in the place of `out`, once all of it is on the disk.
    ///
    /// # Errors
    /// If the system refuses; what was there stays.
    pub fn put(mut self, out: &Path) -> Result<(), Error> {
        let placed = self.file.sync_all().and_then(|()| fs::rename(&self.path, out));
        self.placed = placed.is_ok();
        placed.map_err(|source| Error::io(out, "write", &source))
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if !self.placed {
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Writes a file, entirely or not at all.
///
/// # Errors
/// If the system refuses, or another process is writing it.
pub fn put(out: &Path, bytes: &[u8]) -> Result<(), Error> {
    let unfinished = Unfinished::of(out)?;
    let written = (&unfinished.file).write_all(bytes);
    written.map_err(|source| Error::io(out, "write", &source))?;
    unfinished.put(out)
}
