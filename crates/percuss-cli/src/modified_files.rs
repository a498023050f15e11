//! Messages on files that were modified while a command ran.

use std::path::{Path, PathBuf};

use percuss_codes::Caution;

use crate::terminal;

/// Prints where a file is kept that was modified while the command ran.
pub fn tell(place: &Path, kept: &Path) {
    let (place, kept) = (place.display(), kept.display());
    let text = format!("{place} was modified meanwhile; the modified file is kept as {kept}");
    terminal::warning(Caution::Changed, &text);
}

/// The same of files of results.
pub fn tell_all(kept: &[(PathBuf, PathBuf)]) {
    kept.iter().for_each(|(place, kept)| tell(place, kept));
}
