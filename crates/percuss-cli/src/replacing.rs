//! Single files, put in place of earlier ones.

use std::path::Path;

use percuss_output::unfinished;

use crate::interrupt;
use crate::modified_files::tell;
use crate::outcome::Failure;

/// Writes a file, entirely or not at all, in place of one that `may_go`; one that may not is kept beside, and reported.
///
/// # Errors
/// If the operating system reports an error, or another process is writing it.
pub fn put(out: &Path, bytes: &[u8], may_go: &dyn Fn(&Path) -> bool) -> Result<(), Failure> {
    interrupt::protect([&unfinished(out)]);
    let kept = percuss_pictures::put(out, bytes, may_go)?;
    kept.iter().for_each(|kept| tell(out, kept));
    Ok(())
}
