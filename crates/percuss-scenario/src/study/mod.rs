//! Study files: a base scenario, what varies in it, and the results wanted.
//!
//! A study is read by the machinery that reads scenarios, so its faults are reported the same way. What its values mean, their
//! dimensions among it, is for the scenario to say; who runs the study asks it.

mod content;
mod given;
mod points;
mod wanted;

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

use crate::diagnostic::Diagnostics;
use crate::file_faults::FileFaults;
use crate::file_kind::FileKind;
use crate::files::{FileAccess, Files};
use crate::parse::{folder, parse};
use crate::source::Source;
use crate::table::{Part, to_toml};

/// A study file that has been read, with the faults found so far.
#[derive(Clone, Debug)]
pub struct StudyFile {
    /// What the file contains; harmless values stand in for those at fault.
    pub content: StudyContent,
    folder: PathBuf,
    access: FileAccess,
    faults: FileFaults,
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
        let (mut content, mut faults) = FileFaults::of(source, parsed);
        if let Some(base) = &content.base {
            faults.refuse_outside("base", base, folder, access);
        }
        if let Err(points::Unread { code, found, expected }) =
            points::take_in(&mut content, folder, access)
        {
            faults.add(code, "design.file", found, &expected);
            faults.taint("parameter");
        }
        Ok(Self { content, folder: folder.into(), access, faults })
    }

    /// Name of the file, as given.
    pub fn name(&self) -> &str {
        self.faults.name()
    }

    /// Folder that the path of the base scenario starts from.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Whether a value at this path could not be read, so that nothing more is to be said of it.
    pub fn is_tainted(&self, path: &str) -> bool {
        self.faults.is_tainted(path)
    }

    /// All faults together: those of reading, and further ones at their places in the file.
    ///
    /// # Errors
    /// If there are any.
    pub fn settle(&self, more: Vec<Fault>) -> Result<(), Diagnostics> {
        self.faults.settle(more)
    }
}

impl StudyContent {
    /// The study as a file.
    pub fn to_toml(&self) -> String {
        to_toml(self)
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
