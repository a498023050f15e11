//! The reference of the file formats, from the declarations that also read them.

use crate::content::Content;
use crate::fit::FitContent;
use serde_json::{Value as Json, json};

use crate::layout::{Described, Inner, Key, Kinds, Layout, TableForm, Variant};
use crate::schema::of_table;
use crate::study::StudyContent;
use crate::table::Part;

/// A table of a format.
#[derive(Clone, Debug)]
pub struct TableReference {
    /// Name of its declaration, unique in its format.
    pub name: &'static str,
    /// How it stands in the file.
    pub form: TableForm,
    /// Where it stands: `beam`, `support.motion`; several keys may hold the same kind of table, shape (places).
    pub places: Vec<String>,
    /// What may stand in it.
    pub body: BodyReference,
}

/// What may stand in a table, or comes into it with one of its kinds.
#[derive(Clone, Debug)]
pub struct BodyReference {
    /// What it is.
    pub about: String,
    /// Its keys, shape (keys).
    pub keys: Vec<KeyReference>,
    /// Sets of keys of which one must be given, shape (sets, keys of one).
    pub either: Vec<Vec<&'static str>>,
    /// Its choices of kinds, shape (choices).
    pub kinds: Vec<KindsReference>,
}

/// A choice of kinds.
#[derive(Clone, Debug)]
pub struct KindsReference {
    /// The key that says which.
    pub tag: &'static str,
    /// What is chosen.
    pub about: String,
    /// The kind if nothing is said.
    pub default: Option<&'static str>,
    /// A key that implies a kind if nothing is said, and that kind.
    pub implied: Option<(&'static str, &'static str)>,
    /// Each kind by its word, with what it brings, shape (kinds).
    pub variants: Vec<(&'static str, BodyReference)>,
}

/// A key.
#[derive(Clone, Debug)]
pub struct KeyReference {
    /// The key itself.
    pub name: &'static str,
    /// What it means.
    pub about: String,
    /// What is expected, with an example.
    pub expected: String,
    /// SI unit of a bare number; empty where there is none.
    pub unit: &'static str,
    /// Words that may stand here, and what they mean, shape (words).
    pub words: Vec<(&'static str, &'static str)>,
    /// Whether it must be given.
    pub required: bool,
    /// Its default as it would stand in the file, if it has one.
    pub default: Option<String>,
    /// Name of the declaration of the table that stands behind it.
    pub table: Option<&'static str>,
}

/// Every table of scenario files.
pub fn reference() -> Vec<TableReference> {
    collect(Content::layout(), "Content")
}

/// Every table of study files.
pub fn study_reference() -> Vec<TableReference> {
    collect(StudyContent::layout(), "StudyContent")
}

/// Every table of files of fits.
pub fn fit_reference() -> Vec<TableReference> {
    collect(FitContent::layout(), "FitContent")
}

fn collect(file: Layout, name: &'static str) -> Vec<TableReference> {
    let mut tables = Vec::new();
    add(&mut tables, Inner { name, form: TableForm::File, layout: Layout::default }, "", &file);
    tables
}

/// Adds a table, and those behind its keys; one that is there already has one place more.
fn add(tables: &mut Vec<TableReference>, inner: Inner, place: &str, layout: &Layout) {
    let Inner { name, form, .. } = inner;
    if let Some(known) = tables.iter_mut().find(|table| table.name == name) {
        known.places.push(place.into());
        return;
    }
    let (places, body) = (vec![place.to_string()], BodyReference::of(layout));
    tables.push(TableReference { name, form, places, body });
    within(layout, &mut |key| {
        let Some(inner) = (key.described)().table else { return };
        let place =
            if place.is_empty() { key.name.into() } else { format!("{place}.{}", key.name) };
        let layout = (inner.layout)();
        add(tables, inner, &place, &layout);
    });
}

/// Every key of a table, those of all its kinds included.
fn within(layout: &Layout, see: &mut impl FnMut(&Key)) {
    layout.keys.iter().for_each(&mut *see);
    for kinds in &layout.choices {
        for variant in &kinds.variants {
            within(&variant.layout, see);
        }
    }
}

impl BodyReference {
    fn of(layout: &Layout) -> Self {
        Self {
            about: layout.about.clone(),
            keys: layout.keys.iter().map(KeyReference::of).collect(),
            either: layout.either.clone(),
            kinds: layout
                .choices
                .iter()
                .map(|kinds| KindsReference::of(kinds, &layout.about))
                .collect(),
        }
    }
}

impl KindsReference {
    /// The kinds of a table; where they are all that is in it, what is said of the table is said of them.
    fn of(kinds: &Kinds, table: &str) -> Self {
        let variant = |v: &Variant| (v.word, BodyReference::of(&v.layout));
        Self {
            tag: kinds.tag,
            about: if kinds.about.is_empty() { table.into() } else { kinds.about.clone() },
            default: kinds.default,
            implied: kinds.implied,
            variants: kinds.variants.iter().map(variant).collect(),
        }
    }
}

impl KeyReference {
    fn of(key: &Key) -> Self {
        let Described { expected, unit, words, table } = (key.described)();
        Self {
            name: key.name,
            about: key.about.clone(),
            expected,
            unit,
            words,
            required: key.required,
            default: key.default.clone(),
            table: table.map(|inner| inner.name),
        }
    }
}

/// The part of the schema with one key of the file alone, and the key as the format spells it; none if the file has no such key.
pub(crate) fn schema_of(key: &str) -> Option<(&'static str, Json)> {
    let mut layout = Content::layout();
    layout.keys.retain(|own| own.name == key);
    let name = layout.keys.first()?.name;
    Some((name, of_table(layout)))
}

/// JSON Schema of the scenario file, for completion in editors.
pub fn schema() -> Json {
    let mut schema = of_table(Content::layout());
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!("Percuss scenario");
    schema
}
