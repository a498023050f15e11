//! Scenarios that differ in some values, made without reading the file again where that is possible.

use percuss::Fault;
use toml::de::DeValue;

use crate::content::Content;
use crate::diagnostic::Diagnostics;
use crate::edit::Adds;
use crate::known_path::KnownPath;
use crate::node::{Node, Reader};
use crate::overrides::apply_changes;
use crate::reach::{Lost, Reached};
use crate::reading::read;
use crate::scenario::Scenario;
use crate::stray::Stray;
use crate::table::Part;

/// A value of a scenario, by its path: `projectile.mass.velocity[1]`, `beam.girder.points[1][0]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    path: String,
    /// Steps of its path, shape (steps).
    steps: Vec<String>,
    reread: bool,
}

impl Field {
    /// The path as given.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Its steps: names, keys and indices, shape (steps).
    pub fn steps(&self) -> &[String] {
        &self.steps
    }

    /// Whether the file has to be read again to change it: it decides what else stands in its table (`kind`), is a word, or
    /// stands in a table that the file does not have.
    pub fn needs_reread(&self) -> bool {
        self.reread
    }

    /// Whether it is a setting of the computation, such as a time step, the size of elements or what is recorded, and no number of the
    /// model: its effect on a result is an error, or the part of the motion that is computed.
    pub fn is_setting(&self) -> bool {
        const TABLES: [&str; 5] = ["time", "integrator", "record", "path", "report"];
        const MESH: [&str; 3] = ["elements", "element_length", "grading"];
        match self.steps.as_slice() {
            [table, _, key, ..] if table == "beam" => MESH.contains(&key.as_str()),
            [table, _, key] if table == "section" => key == "fibres",
            [table, ..] => TABLES.contains(&table.as_str()),
            [] => false,
        }
    }
}

impl Scenario {
    /// Finds the value at a path.
    ///
    /// # Errors
    /// The first step of the path that leads nowhere, with the names that would lead on.
    pub fn field(&self, path: &str) -> Result<Field, Fault> {
        let stray = |Stray { found, expected }| {
            Fault::new(path, format!("{found} in the path `{path}`"), expected)
        };
        let KnownPath { steps, .. } = KnownPath::find(path).map_err(stray)?;
        let mut content = self.content.clone();
        let reread = match content.reach(&steps) {
            Ok(_) => false,
            Err(Lost::Reread) => true,
            Err(Lost::Table) => {
                let found = format!("`{path}`, which is a table");
                return Err(Fault::new(path, found, "the path of a value in it"));
            }
            Err(Lost::Missing(lost)) => return Err(stray(lost)),
            Err(Lost::Unknown { depth, found, known }) => {
                let word = steps.get(depth).map_or("", String::as_str);
                return Err(stray(Stray::new(found, Lost::expected(&known, word))));
            }
        };
        Ok(Field { path: path.into(), steps, reread })
    }

    /// The number at a field and its SI unit, empty for a pure number; `None` where no number stands.
    pub fn number(&mut self, field: &Field) -> Option<(f64, &'static str)> {
        let slot = self.content.reach(&field.steps).ok()?;
        Some((slot.number()?, slot.unit()?))
    }

    /// Puts a number in its place, in SI units.
    ///
    /// # Errors
    /// If no such number can stand there.
    pub fn set_number(&mut self, field: &Field, number: f64) -> Result<(), Fault> {
        let fault = |expected| Fault::new(&field.path, number.to_string(), expected);
        let mut slot = self.slot(field)?;
        slot.set(number).map_err(fault)
    }

    /// Puts a value in its place, as TOML, read as if it stood in the file.
    ///
    /// # Errors
    /// If the file could not have it there, what was found and what would be right.
    pub fn set_toml(&mut self, field: &Field, toml: &str) -> Result<(), Fault> {
        let Ok(value) = DeValue::parse(toml) else {
            return Err(Fault::new(&field.path, toml, "a value as written in a file"));
        };
        let content = self.content.clone();
        let mut reader = Reader::of_content(toml, &content);
        let path = field.path.clone();
        let node = Node { path, span: value.span(), value: value.get_ref() };
        if self.slot(field)?.read(&node, &mut reader) {
            return Ok(());
        }
        let first = reader.faults.into_iter().next();
        let (found, expected) =
            first.map_or_else(|| (node.found(), "another value".into()), |f| (f.found, f.expected));
        Err(Fault::new(&field.path, found, expected))
    }

    /// Reads the file again with other values, each a path and a value as TOML.
    ///
    /// # Errors
    /// Every fault of the changed file.
    pub fn reread(&self, changes: &[(&str, &str)]) -> Result<Self, Diagnostics> {
        let name = self.source.name.as_str();
        let changes: Vec<(String, String)> =
            changes.iter().map(|(p, v)| ((*p).into(), (*v).into())).collect();
        let text = apply_changes(&self.source.text, [name, name], &changes, Adds::Fixed)?;
        let given = std::sync::Arc::clone(&self.given);
        Ok(Self { given, ..read(&text, name)? })
    }

    /// The scenario as one text that names no other files: as it was read where it names none, else with their values and
    /// every default written out.
    pub fn self_contained(&self) -> String {
        match self.names_files {
            false => self.source.text.clone(),
            true => self.to_toml(),
        }
    }

    fn slot(&mut self, field: &Field) -> Result<Box<dyn crate::reach::Slot + '_>, Fault> {
        let reached: Reached<'_> = self.content.reach(&field.steps);
        reached.map_err(|_| {
            Fault::new(&field.path, "no such value in this scenario", "a value of the scenario")
        })
    }
}

impl<'s> Reader<'s> {
    /// A reader of one value for a scenario that has been read.
    fn of_content(text: &'s str, content: &'s Content) -> Self {
        fn names<T>(all: &[crate::Named<T>]) -> Vec<&str> {
            all.iter().map(|one| one.name.as_str()).collect()
        }
        let mut reader = Self::default();
        reader.text = text;
        reader.name_all([
            ("material", names(&content.material)),
            ("section", names(&content.section)),
            ("beam", names(&content.beam)),
            ("mass", names(&content.mass)),
            ("obstacle", names(&content.obstacle)),
            ("projectile", names(&content.projectile)),
        ]);
        reader
    }
}
