//! Tells what was kept of files that were changed meanwhile.

use std::path::{Path, PathBuf};

use percuss_codes::Caution;

use crate::terminal;

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
