//! From the text of a file to its tables.

use std::collections::{BTreeSet, HashSet};
use std::path::Path;

use toml::de::DeTable;

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::files::Files;
use crate::node::{About, Body, Raw, Reader};
use crate::source::{Places, Source};
use crate::syntax;
use crate::table::{self, Declared};

/// The folder of a file; the working directory for a name alone.
pub(crate) fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// A file as far as it could be read.
pub(crate) struct Parsed<T> {
    pub content: T,
    pub places: Places,
    /// Faults found by reading, shape (faults).
    pub faults: Vec<Raw>,
    pub tainted: BTreeSet<String>,
    pub names_files: bool,
    /// Paths of the keys that name files of accelerations.
    pub accelerations: BTreeSet<String>,
}

/// Reads the tables of a file; `expected` says what an empty one should be.
///
/// # Errors
/// If it is empty or has syntax errors.
pub(crate) fn parse<T: Declared>(
    source: &Source,
    files: Files<'_>,
    expected: &str,
) -> Result<Parsed<T>, Diagnostics> {
    let text = source.text.as_str();
    if text.trim_matches(|c: char| c.is_whitespace() || c == '\u{feff}').is_empty() {
        let empty = Diagnostic::of_file("an empty file", expected);
        return Err(Diagnostics::new(source.clone(), vec![empty]));
    }
    let (root, errors) = DeTable::parse_recoverable(text);
    let syntax = syntax::faults(source, &errors);
    let places = Places::new(root.get_ref());
    let body = Body::root(root.get_ref());
    let mut reader = Reader::new(text, &body, files);
    let content = table::read::<T>(&body, &mut reader).unwrap_or_else(T::placeholder);
    let Reader { faults, tainted, files, accelerations, .. } = reader;
    let names_files = files > 0;
    match syntax.is_empty() {
        true => Ok(Parsed { content, places, faults, tainted, names_files, accelerations }),
        false => Err(with_syntax_errors(source.clone(), syntax, faults)),
    }
}

pub(crate) fn place(source: &Source, raw: Raw) -> Diagnostic {
    Diagnostic::at(raw.code, source, raw.span, raw.path, raw.found, raw.expected)
}

/// With syntax errors, what stands where is uncertain: only values that are wrong in themselves are
/// reported besides, and none if a header is broken or one stands on a broken line.
fn with_syntax_errors(source: Source, syntax: Vec<Diagnostic>, faults: Vec<Raw>) -> Diagnostics {
    let header = |d: &Diagnostic| source.text[source.line(d.line)].trim_start().starts_with('[');
    let uncertain = syntax.iter().any(header);
    let broken: HashSet<usize> = syntax.iter().map(|d| d.line).collect();
    let placed = faults.into_iter().filter(|raw| raw.about == About::Value && !uncertain);
    let mut all: Vec<Diagnostic> = placed.map(|raw| place(&source, raw)).collect();
    all.retain(|d| !broken.contains(&d.line));
    all.extend(syntax);
    Diagnostics::new(source, all)
}
