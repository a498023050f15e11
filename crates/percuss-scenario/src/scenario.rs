//! A scenario: its content and the file it came from.

use std::collections::{BTreeSet, HashSet};
use std::path::Path;
use std::sync::Arc;

use toml::de::DeTable;

use crate::compile;
use crate::content::{Content, ProjectileKind};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::files::{FileAccess, Files};
use crate::given::Given;
use crate::node::{About, Body, Raw, Reader};
use crate::source::{Places, Source};
use crate::study::is_study;
use crate::syntax;
use crate::table::{self, Declared, Part};
use crate::write::Writer;

/// A scenario without reading faults, with every default filled in.
#[derive(Clone, Debug)]
pub struct Scenario {
    pub(crate) content: Content,
    pub(crate) source: Arc<Source>,
    pub(crate) places: Arc<Places>,
    pub(crate) given: Arc<Given>,
    /// Whether the file names others, such as tables of values.
    pub(crate) names_files: bool,
}

impl Scenario {
    /// What the file contains.
    pub fn content(&self) -> &Content {
        &self.content
    }

    /// The scenario as a file with every default written out, in SI units.
    pub fn to_toml(&self) -> String {
        let mut out = Writer::default();
        self.content.write(&mut out);
        out.finish()
    }

    /// The same scenario with functions for the places where it says `"given"`.
    pub fn with_given(mut self, given: Given) -> Self {
        self.given = Arc::new(given);
        self
    }

    /// The same scenario with another coefficient of restitution for every rigid projectile.
    pub fn with_restitution(&self, coefficient: f64) -> Self {
        let mut other = self.clone();
        for projectile in &mut other.content.projectile {
            if let ProjectileKind::Rigid { restitution } = &mut projectile.table.kind {
                *restitution = coefficient;
            }
        }
        other
    }
}

/// Reads a scenario from a file.
///
/// # Errors
/// The file cannot be read, is not UTF-8, or has faults.
pub fn load(path: impl AsRef<Path>) -> Result<Scenario, Diagnostics> {
    load_with(path, FileAccess::OwnFolder)
}

/// The same, with a say in which files the scenario may name.
///
/// # Errors
/// As [`load`].
pub fn load_with(path: impl AsRef<Path>, access: FileAccess) -> Result<Scenario, Diagnostics> {
    let path = path.as_ref();
    read_from(Source::load(path)?, Files::named(folder(path), access))
}

/// The same for a scenario that shall need no other files where it is written, because it goes elsewhere: tables from files stand in it as
/// lists, however long they are.
///
/// # Errors
/// As [`load`].
pub fn load_whole(path: impl AsRef<Path>, access: FileAccess) -> Result<Scenario, Diagnostics> {
    let path = path.as_ref();
    read_from(Source::load(path)?, Files::taken_in(folder(path), access))
}

/// Reads a scenario; `name` stands for the file in messages, and files that the text names lie where it lies.
///
/// # Errors
/// Every fault of the text and, as far as the sound part of it goes, of the model it describes.
pub fn read(text: &str, name: &str) -> Result<Scenario, Diagnostics> {
    read_with(text, name, FileAccess::OwnFolder)
}

/// The same, with a say in which files the scenario may name.
///
/// # Errors
/// As [`read`].
pub fn read_with(text: &str, name: &str, access: FileAccess) -> Result<Scenario, Diagnostics> {
    read_text(text, name, Files::named(folder(Path::new(name)), access))
}

/// The same for a scenario that shall need no other files where it is written, as [`load_whole`].
///
/// # Errors
/// As [`read`].
pub fn read_whole(text: &str, name: &str, access: FileAccess) -> Result<Scenario, Diagnostics> {
    read_text(text, name, Files::taken_in(folder(Path::new(name)), access))
}

fn read_text(text: &str, name: &str, files: Files<'_>) -> Result<Scenario, Diagnostics> {
    if is_study(text) {
        let expected = "a scenario; `percuss sweep` runs studies";
        return Err(Diagnostics::of_file(name, "a study, which varies a scenario", expected));
    }
    read_from(Source::new(name, text), files)
}

/// The folder of a file; the working directory for a name alone.
pub(crate) fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// A file as far as it could be read.
pub(crate) struct Parsed<T> {
    pub content: T,
    pub places: Places,
    pub faults: Vec<Raw>,
    pub tainted: BTreeSet<String>,
    pub names_files: bool,
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
    let Reader { faults, tainted, files, .. } = reader;
    match syntax.is_empty() {
        true => Ok(Parsed { content, places, faults, tainted, names_files: files > 0 }),
        false => Err(with_syntax_errors(source.clone(), syntax, faults)),
    }
}

fn read_from(source: Source, files: Files<'_>) -> Result<Scenario, Diagnostics> {
    let expected = "a scenario, with a beam and [time] at least";
    let parsed = parse::<Content>(&source, files, expected)?;
    let Parsed { content, places, faults, tainted, names_files } = parsed;
    if faults.is_empty() {
        let (source, places) = (Arc::new(source), Arc::new(places));
        let given = Arc::default();
        return Ok(Scenario { content, source, places, given, names_files });
    }
    let mut all: Vec<Diagnostic> = faults.into_iter().map(|raw| place(&source, raw)).collect();
    all.extend(compile::sound_part(&content, &tainted, &source, &places));
    Err(Diagnostics::new(source, all))
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
