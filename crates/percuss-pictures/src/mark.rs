//! Mark of files written by this program; files without it are not replaced.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use percuss_output::Unfinished;

use crate::error::Error;

/// Mark in every file, as a comment of its format.
pub(crate) const MARK: &str = concat!("made by percuss ", env!("CARGO_PKG_VERSION"));
/// Its beginning in any version.
const ANY: &[u8] = b"made by percuss ";
/// Number of bytes at both ends of a file that are searched for it.
const ENDS: u64 = 1 << 17;

/// An SVG text with the mark.
pub fn marked(svg: &str) -> String {
    format!("<!-- {MARK} -->\n{svg}")
}

/// Whether a file has the mark of this program.
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

/// Writes a file completely or not at all; it replaces a file for which `may_go` is true. Another file that was created there meanwhile is moved to
/// a name beside it, which is returned.
///
/// # Errors
/// If an I/O error occurs, or another process writes the file.
pub fn put(
    out: &Path,
    bytes: &[u8],
    may_go: &dyn Fn(&Path) -> bool,
) -> Result<Option<PathBuf>, Error> {
    let unfinished = Unfinished::of(out)?;
    unfinished.write(bytes)?;
    Ok(unfinished.put(may_go)?)
}
