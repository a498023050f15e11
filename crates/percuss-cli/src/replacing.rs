//! Single files, put in place of earlier ones.

use std::path::{Path, PathBuf};

use percuss_codes::Caution;
use percuss_output::unfinished;

use crate::interrupt;
use crate::outcome::Failure;
use crate::terminal;

/// Writes a file, entirely or not at all, in place of one that `may_go`; one that may not is kept beside, and told.
///
/// # Errors
/// If the system refuses, or another process is writing it.
pub fn put(out: &Path, bytes: &[u8], may_go: &dyn Fn(&Path) -> bool) -> Result<(), Failure> {
    interrupt::protect([&unfinished(out)]);
    let kept = percuss_pictures::put(out, bytes, may_go)?;
    kept.iter().for_each(|kept| tell(out, kept));
    Ok(())
}

/// Tells where something is kept that was changed while the command worked.
pub fn tell(place: &Path, kept: &Path) {
    let (place, kept) = (place.display(), kept.display());
    let text = format!("{place} was changed meanwhile; what stood there is kept as {kept}");
    terminal::warning(Caution::Changed, &text);
}

/// The same of files of results.
pub fn tell_all(kept: &[(PathBuf, PathBuf)]) {
    kept.iter().for_each(|(place, kept)| tell(place, kept));
}
