//! `percuss book`.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use percuss_codes::{Caution, FileCode};

use crate::arguments::Book;
use crate::outcome::{Failure, Status};
use crate::{browser, terminal};

/// Names the folder of the book; no other is searched then. The Python package sets it where its wheel has the book.
const FOLDER: &str = "PERCUSS_BOOK";
/// Folders of the book, from that of the program: archives of a release, installations below a prefix, builds of the sources.
const BESIDE: [&str; 3] = ["book", "../share/percuss/book", "../book/html"];

/// Prints the path of the book, and opens it in the browser.
///
/// # Errors
/// There is no book in any of the folders.
pub fn run(arguments: &Book) -> Result<Status, Failure> {
    let folders = folders(std::env::var_os(FOLDER), std::env::current_exe().ok());
    let mut pages = folders.iter().map(|folder| folder.join("index.html"));
    let Some(page) = pages.find(|page| page.is_file()) else {
        return Err(Failure::input(FileCode::NoBook, missing(&folders)));
    };
    let page = page.canonicalize().unwrap_or(page);
    terminal::print(&format!("{}\n", page.display()))?;
    if !arguments.path
        && let Some(text) = browser::open(&page)
    {
        terminal::warning(Caution::Browser, &text);
    }
    Ok(Status::Done)
}

/// Folders in which the book may be, in the order in which they are searched.
fn folders(named: Option<OsString>, program: Option<PathBuf>) -> Vec<PathBuf> {
    if let Some(named) = named.filter(|named| !named.is_empty()) {
        return vec![named.into()];
    }
    // A link to the program does not say where the archive is.
    let program = program.map(|program| program.canonicalize().unwrap_or(program));
    let Some(beside) = program.as_deref().and_then(Path::parent) else { return Vec::new() };
    BESIDE.iter().map(|folder| beside.join(folder)).collect()
}

/// Where the book is missing, and where else it can be read.
fn missing(folders: &[PathBuf]) -> String {
    let searched: Vec<String> =
        folders.iter().map(|folder| format!("`{}`", folder.display())).collect();
    let searched = match searched.is_empty() {
        true => String::new(),
        false => format!(" (no index.html in {})", searched.join(", ")),
    };
    format!(
        "the book is not installed{searched}: archives and wheels of a release contain it; in the sources of Percuss its pages are in \
         docs/book/src, and `scripts/book` builds it"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_named_folder_is_the_only_one_and_an_empty_name_is_none() {
        let program = || Some(PathBuf::from("/nowhere/bin/percuss"));
        assert_eq!(folders(Some("mine".into()), program()), [PathBuf::from("mine")]);
        let beside = BESIDE.map(|folder| Path::new("/nowhere/bin").join(folder));
        assert_eq!(folders(Some(OsString::new()), program()), beside);
        assert_eq!(folders(None, program()), beside);
        assert!(folders(None, None).is_empty());
        assert!(missing(&[]).starts_with("the book is not installed: archives"));
    }
}
