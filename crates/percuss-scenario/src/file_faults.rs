//! Faults of a file of a study or a fit, and where further ones of it lie.

use std::collections::BTreeSet;
use std::path::Path;

use percuss::Fault;

use crate::code::{FaultCode, of_path};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::files::{FileAccess, WITHIN, is_within};
use crate::parse::{Parsed, place};
use crate::source::{Places, Source};

/// Faults found so far in a file that has been read.
#[derive(Clone, Debug)]
pub(crate) struct FileFaults {
    source: Source,
    places: Places,
    /// Faults found by reading, shape (faults).
    found: Vec<Diagnostic>,
    /// Paths whose values could not be read.
    tainted: BTreeSet<String>,
}

impl FileFaults {
    /// What a file contains, and the faults that were found by reading it.
    pub fn of<T>(source: Source, parsed: Parsed<T>) -> (T, Self) {
        let Parsed { content, places, faults, tainted, .. } = parsed;
        let found = faults.into_iter().map(|raw| place(&source, raw)).collect();
        (content, Self { source, places, found, tainted })
    }

    /// Name of the file, as given.
    pub fn name(&self) -> &str {
        &self.source.name
    }

    /// Adds a fault of the value at `path`.
    pub fn add(&mut self, code: FaultCode, path: &str, found: String, expected: &str) {
        let found = Diagnostic::at(code, &self.source, self.span(path), path, found, expected);
        self.found.push(found);
    }

    /// Refuses the name of a file outside the folder where files may lie only there; such a file is not looked at.
    pub fn refuse_outside(&mut self, path: &str, name: &str, folder: &Path, access: FileAccess) {
        if access == FileAccess::OwnFolder && !is_within(folder, name) {
            let found = format!("{name:?}, which lies outside the folder of this file");
            self.add(FaultCode::File, path, found, WITHIN);
            self.taint(path);
        }
    }

    /// Marks a value as one that could not be read.
    pub fn taint(&mut self, path: &str) {
        self.tainted.insert(path.to_owned());
    }

    /// Whether a value at this path could not be read, so that nothing more is to be said of it.
    pub fn is_tainted(&self, path: &str) -> bool {
        let within = |t: &String| t == path || path.starts_with(&format!("{t}."));
        self.tainted.iter().any(within)
    }

    /// All faults together: those of reading, and further ones at their places in the file.
    ///
    /// # Errors
    /// If there are any.
    pub fn settle(&self, more: Vec<Fault>) -> Result<(), Diagnostics> {
        let mut all = self.found.clone();
        let more = more.into_iter().filter(|fault| !self.is_tainted(&fault.path));
        all.extend(more.map(|Fault { path, found, expected, .. }| {
            let (code, span) = (of_path(&path), self.span(&path));
            Diagnostic::at(code, &self.source, span, path, found, expected)
        }));
        if all.is_empty() { Ok(()) } else { Err(Diagnostics::new(self.source.clone(), all)) }
    }

    fn span(&self, path: &str) -> std::ops::Range<usize> {
        self.places.find(path).unwrap_or(0..0)
    }
}
