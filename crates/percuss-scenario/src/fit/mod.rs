//! Files of fits: a scenario, parameters to be found, and records of tests.
//!
//! A fit is read by the machinery that reads scenarios, so that its faults are reported the same way. What its values mean is for the
//! scenario to say.

mod content;
mod dimension;
mod record;

use std::path::{Path, PathBuf};

use percuss::Fault;
use serde_json::{Value as Json, json};

pub use content::{
    Alignment, FitChannel, FitContent, FitJacobian, FitLoss, FitOptions, FitParameter, FitPrior,
    FitTest,
};
pub use record::{Record, RecordColumn};

use crate::diagnostic::Diagnostics;
use crate::file_faults::FileFaults;
use crate::file_kind::FileKind;
use crate::files::{FileAccess, Files};
use crate::parse::{folder, parse};
use crate::source::Source;
use crate::study::Given;
use crate::table::{Named, Part, to_toml};
use crate::units;
use dimension::dimension;

/// A file of a fit that has been read, with the faults found so far.
#[derive(Clone, Debug)]
pub struct FitFile {
    /// What the file contains; harmless values stand in for those at fault.
    pub content: FitContent,
    folder: PathBuf,
    access: FileAccess,
    faults: FileFaults,
}

impl FitFile {
    /// Reads a fit from a file, with a say in which files it may name.
    ///
    /// # Errors
    /// If the file cannot be read, is not UTF-8 or not TOML.
    pub fn load_with(path: impl AsRef<Path>, access: FileAccess) -> Result<Self, Diagnostics> {
        let path = path.as_ref();
        Self::read_from(Source::load(path)?, folder(path), access)
    }

    /// Reads a fit; `name` is the name of the file in messages, and the files it names are relative to its folder.
    ///
    /// # Errors
    /// If the text is empty or not TOML.
    pub fn read_with(text: &str, name: &str, access: FileAccess) -> Result<Self, Diagnostics> {
        Self::read_from(Source::new(name, text), folder(Path::new(name)), access)
    }

    fn read_from(source: Source, folder: &Path, access: FileAccess) -> Result<Self, Diagnostics> {
        FileKind::Fit.expect(&source.text, &source.name)?;
        let expected = "a fit, with `base`, [fit], [parameter.NAME] and [test.NAME]";
        let parsed = parse::<FitContent>(&source, Files::taken_in(folder, access), expected)?;
        let (content, mut faults) = FileFaults::of(source, parsed);
        if let Some(base) = &content.base {
            faults.refuse_outside("base", base, folder, access);
        }
        for Named { name, table } in &content.test {
            faults.refuse_outside(&format!("test.{name}.data"), &table.data, folder, access);
        }
        Ok(Self { content, folder: folder.into(), access, faults })
    }

    /// Name of the file, as given.
    pub fn name(&self) -> &str {
        self.faults.name()
    }

    /// Folder that paths of its files start from.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Which files it may name.
    pub fn access(&self) -> FileAccess {
        self.access
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

impl FitContent {
    /// The fit as a file.
    pub fn to_toml(&self) -> String {
        to_toml(self)
    }
}

impl Given {
    /// The value in an SI unit, empty or `1` for a pure number: a bare number is in that unit, a text names its own.
    ///
    /// # Errors
    /// What was found and what would be right.
    pub fn in_unit(&self, unit: &str) -> Result<f64, (String, String)> {
        let bare = self.toml.trim();
        let finite = |x: &f64| x.is_finite();
        if let Some(number) = bare.replace('_', "").parse::<f64>().ok().filter(finite) {
            return Ok(number);
        }
        let example = if matches!(unit, "" | "1") { "5".into() } else { format!("\"5 {unit}\"") };
        let expected = format!("a number, such as {example}");
        let text = bare.trim_matches(['"', '\'']);
        let quantity = units::parse(text).map_err(|fault| (fault.found, expected.clone()))?;
        match quantity.dimension == dimension(unit) {
            true => Ok(quantity.value),
            false => Err((
                format!("{bare}, which is {}", crate::measure::name(quantity.dimension)),
                expected,
            )),
        }
    }
}

/// JSON Schema of the file of a fit, for completion in editors.
pub fn fit_schema() -> Json {
    let mut schema = crate::schema::of_table(FitContent::layout());
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!("Percuss fit");
    schema
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIT: &str = r#"
title = "a drop"
base = "drop.toml"
[fit]
loss = "huber"
[parameter.k]
path = "projectile.bag.stiffness"
bounds = ["1 kN/m", 2e6]
prior = { mean = "5 kN/m", deviation = 100 }
[test.one]
data = "one.csv"
align = "fit"
[test.one.channel.F]
column = "contact.bag.force"
sigma = "5 N"
cfc = 600
[test.two]
data = "two.csv"
offset = "3 ms"
[test.two.channel.F]
column = "contact.bag.force"
[test.two.channel.a]
column = "point.tip.acceleration_2"
"#;

    #[test]
    fn a_fit_that_is_written_is_read_with_the_same_content() {
        let read = |text: &str| {
            let file = FitFile::read_with(text, "fit.toml", FileAccess::OwnFolder);
            let file = file.unwrap_or_else(|faults| panic!("{faults}"));
            file.settle(Vec::new()).unwrap_or_else(|faults| panic!("{faults}"));
            file.content
        };
        let content = read(FIT);
        let written = content.to_toml();
        assert!(written.contains("[test.two.channel.a]"), "{written}");
        assert_eq!(read(&written), content);
        assert!(crate::is_fit(FIT) && !crate::is_study(FIT));
    }

    #[test]
    fn deviations_have_the_unit_of_their_channel() {
        let given = |toml: &str| Given { toml: toml.into() };
        assert_eq!(given("\"5 kN\"").in_unit("N"), Ok(5e3));
        assert_eq!(given("0.02").in_unit("m"), Ok(0.02));
        assert_eq!(given("\"3 kg*m/s\"").in_unit("N*s"), Ok(3.0));
        let wrong = given("\"5 kN\"").in_unit("m");
        assert!(
            wrong.is_err_and(
                |(found, expected)| found.contains("a force") && expected.contains("5 m")
            )
        );
        assert!(given("\"much\"").in_unit("m").is_err());
    }
}
