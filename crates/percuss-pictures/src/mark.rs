//! Files that this program wrote say so, and no others are replaced.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use percuss_output::Unfinished;

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

/// Writes a file, entirely or not at all, in place of one that `may_go`. What may not, since it came to stand there meanwhile, is kept
/// beside; its name is returned.
///
/// # Errors
/// If the system refuses, or another process is writing it.
pub fn put(
    out: &Path,
    bytes: &[u8],
    may_go: &dyn Fn(&Path) -> bool,
) -> Result<Option<PathBuf>, Error> {
    let unfinished = Unfinished::of(out)?;
    unfinished.write(bytes)?;
    Ok(unfinished.put(may_go)?)
}
