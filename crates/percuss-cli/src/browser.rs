//! Opens pages for the reader.

use std::path::Path;

/// Opens a page in the browser; what is to be warned of where nothing can open it: the page is there all the same.
pub fn open(page: &Path) -> Option<String> {
    let whole = page.canonicalize().unwrap_or_else(|_| page.to_owned());
    let error = open::that_detached(&whole).err()?;
    Some(format!("cannot open {} in a browser: {error}", whole.display()))
}
