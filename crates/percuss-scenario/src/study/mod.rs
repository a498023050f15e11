//! Study files: a base scenario, what varies in it, and the results wanted.
//!
//! A study is read by the machinery that reads scenarios, so its faults are reported the same way. What its values mean, their
//! dimensions among it, is for the scenario to say; who runs the study asks it.

mod content;
mod given;
mod points;
mod wanted;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use percuss::Fault;
use serde_json::{Value as Json, json};

pub(crate) use content::Spaced;
pub use content::{
    Correlation, Design, Distribution, Parameter, Range, Sampling, Spacing, StudyContent,
};
pub use given::Given;
pub(crate) use given::{Anything, Whole};
pub use wanted::{ColumnResult, WantedResult};

use crate::code::{FaultCode, of_path};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::file_kind::FileKind;
use crate::files::{FileAccess, Files, WITHIN, is_within};
use crate::parse::{folder, parse, place};
use crate::source::{Places, Source};
use crate::table::Part;
use crate::write::Writer;

/// A study file that has been read, with the faults found so far.
#[derive(Clone, Debug)]
pub struct StudyFile {
    /// What the file contains; harmless values stand in for those at fault.
    pub content: StudyContent,
    source: Source,
    places: Places,
    folder: PathBuf,
    access: FileAccess,
    /// Faults of the study found by reading, shape (faults).
    faults: Vec<Diagnostic>,
    tainted: BTreeSet<String>,
}

impl StudyFile {
    /// Reads a study from a file.
    ///
    /// # Errors
    /// If the file cannot be read, is not UTF-8 or not TOML.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        Self::load_with(path, FileAccess::OwnFolder)
    }

    /// The same, with a say in which files its scenario may name.
    ///
    /// # Errors
    /// As [`StudyFile::load`].
    pub fn load_with(path: impl AsRef<Path>, access: FileAccess) -> Result<Self, Diagnostics> {
        let path = path.as_ref();
        Self::read_from(Source::load(path)?, folder(path), access)
    }

    /// Reads a study; `name` is the name of the file in messages, and the scenario it names is relative to its folder.
    ///
    /// # Errors
    /// If the text is empty or not TOML.
    pub fn read(text: &str, name: &str) -> Result<Self, Diagnostics> {
        Self::read_with(text, name, FileAccess::OwnFolder)
    }

    /// The same, with a say in which files its scenario may name.
    ///
    /// # Errors
    /// As [`StudyFile::read`].
    pub fn read_with(text: &str, name: &str, access: FileAccess) -> Result<Self, Diagnostics> {
        Self::read_from(Source::new(name, text), folder(Path::new(name)), access)
    }

    /// Which files its scenario may name.
    pub fn access(&self) -> FileAccess {
        self.access
    }

    fn read_from(source: Source, folder: &Path, access: FileAccess) -> Result<Self, Diagnostics> {
        FileKind::Study.expect(&source.text, &source.name)?;
        let expected = "a study, with `base`, [parameter.NAME], [design] and [results]";
        let parsed = parse::<StudyContent>(&source, Files::taken_in(folder, access), expected)?;
        let mut faults: Vec<_> = parsed.faults.into_iter().map(|raw| place(&source, raw)).collect();
        let (mut content, places, mut tainted) = (parsed.content, parsed.places, parsed.tainted);
        if access == FileAccess::OwnFolder
            && let Some(base) = content.base.as_deref()
            && !is_within(folder, base)
        {
            let span = places.find("base").unwrap_or(0..0);
            let found = format!("{base:?}, which lies outside the folder of this file");
            let code = FaultCode::File;
            faults.push(Diagnostic::at(code, &source, span, "base", found, WITHIN));
            tainted.insert("base".into());
        }
        if let Err(points::Unread { code, found, expected }) =
            points::take_in(&mut content, folder, access)
        {
            let span = places.find("design.file").unwrap_or(0..0);
            faults.push(Diagnostic::at(code, &source, span, "design.file", found, expected));
            tainted.insert("parameter".into());
        }
        Ok(Self { content, places, folder: folder.into(), access, faults, tainted, source })
    }

    /// Name of the file, as given.
    pub fn name(&self) -> &str {
        &self.source.name
    }

    /// Folder that the path of the base scenario starts from.
    pub fn folder(&self) -> &Path {
        &self.folder
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
        let mut all = self.faults.clone();
        let more = more.into_iter().filter(|fault| !self.is_tainted(&fault.path));
        all.extend(more.map(|fault| {
            let span = self.places.find(&fault.path).unwrap_or(0..0);
            Diagnostic::at(
                of_path(&fault.path),
                &self.source,
                span,
                fault.path,
                fault.found,
                fault.expected,
            )
        }));
        if all.is_empty() { Ok(()) } else { Err(Diagnostics::new(self.source.clone(), all)) }
    }
}

impl StudyContent {
    /// The study as a file.
    pub fn to_toml(&self) -> String {
        let mut out = Writer::default();
        self.write(&mut out);
        out.finish()
    }
}

impl Distribution {
    /// One of its values.
    pub fn example(&self) -> &Given {
        match self {
            Self::Uniform { from, .. } => from,
            Self::Normal { mean, .. } | Self::Lognormal { mean, .. } => mean,
        }
    }
}

/// JSON Schema of the study file, for completion in editors.
pub fn study_schema() -> Json {
    let mut schema = crate::schema::of_table(StudyContent::layout());
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!("Percuss study");
    schema
}
