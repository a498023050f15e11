//! Reads scenarios from files and texts.

use std::path::Path;
use std::sync::Arc;

use crate::compile;
use crate::content::Content;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::file_kind::FileKind;
use crate::files::{FileAccess, Files};
use crate::parse::{Parsed, folder, parse, place};
use crate::scenario::Scenario;
use crate::source::Source;

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
/// Every fault of the text and, as far as the valid part of it goes, of the model it describes.
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
    read_from(Source::new(name, text), files)
}

fn read_from(source: Source, files: Files<'_>) -> Result<Scenario, Diagnostics> {
    FileKind::Scenario.expect(&source.text, &source.name)?;
    let expected = "a scenario, with a beam and [time] at least";
    let parsed = parse::<Content>(&source, files, expected)?;
    let Parsed { content, places, faults, tainted, names_files, accelerations } = parsed;
    if faults.is_empty() {
        let (source, places) = (Arc::new(source), Arc::new(places));
        let given = Arc::default();
        let accelerations = Arc::new(accelerations);
        return Ok(Scenario { content, source, places, given, names_files, accelerations });
    }
    let mut all: Vec<Diagnostic> = faults.into_iter().map(|raw| place(&source, raw)).collect();
    all.extend(compile::valid_part(&content, &tainted, &source, &places));
    Err(Diagnostics::new(source, all))
}
