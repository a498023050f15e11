//! Opens pages for the reader.

use std::path::Path;

use crate::terminal;

/// Opens a page in the browser; where nothing can open it, says so: the page is there all the same.
pub fn open(page: &Path) {
    let whole = page.canonicalize().unwrap_or_else(|_| page.to_owned());
    if let Err(error) = open::that_detached(&whole) {
        terminal::warning(&format!("nothing here opens {}: {error}", whole.display()));
    }
}
