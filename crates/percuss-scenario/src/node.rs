//! The spanned tree of a file and the reader that collects its faults.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::ops::Range;
use std::path::PathBuf;

use toml::de::{DeTable, DeValue};

use crate::code::FaultCode;
use crate::files::{FileAccess, Files};
use crate::source::join;

/// A value of the file with its place.
#[derive(Clone, Debug)]
pub(crate) struct Node<'s> {
    /// Dotted path.
    pub path: String,
    /// Bytes of the value; of a table the bytes of its header.
    pub span: Range<usize>,
    /// The value.
    pub value: &'s DeValue<'s>,
}

impl<'s> Node<'s> {
    /// The elements of an array; their path is that of the array.
    pub fn elements(&self) -> Option<Vec<Node<'s>>> {
        let element = |v: &'s toml::Spanned<DeValue<'s>>| Node {
            path: self.path.clone(),
            span: v.span(),
            value: v.get_ref(),
        };
        Some(self.value.as_array()?.iter().map(element).collect())
    }

    /// The value in words, for the middle of a message.
    pub fn found(&self) -> String {
        match self.value {
            DeValue::String(text) => format!("the text {:?}", shortened(text)),
            DeValue::Integer(number) => format!("the number {number}"),
            DeValue::Float(number) => format!("the number {number}"),
            DeValue::Boolean(value) => format!("`{value}`"),
            DeValue::Datetime(_) => "a date".into(),
            DeValue::Array(items) if items.len() == 1 => "a list of 1 entry".into(),
            DeValue::Array(items) => format!("a list of {} entries", items.len()),
            DeValue::Table(_) => "a table".into(),
        }
    }
}

/// `1 row`, `2 rows`.
pub(crate) fn count(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

fn shortened(text: &str) -> String {
    match text.char_indices().nth(60) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_string(),
    }
}

/// A table of the file.
#[derive(Clone, Debug)]
pub(crate) struct Body<'s> {
    /// Dotted path; empty at the root.
    pub path: String,
    /// Bytes of the header.
    pub span: Range<usize>,
    table: &'s DeTable<'s>,
}

impl<'s> Body<'s> {
    /// The file itself.
    pub fn root(table: &'s DeTable<'s>) -> Self {
        Self { path: String::new(), span: 0..0, table }
    }

    /// The table at a node, if it is one.
    pub fn of(node: &Node<'s>) -> Option<Self> {
        let table = node.value.as_table()?;
        Some(Self { path: node.path.clone(), span: node.span.clone(), table })
    }

    /// The value under `key`.
    pub fn get(&self, key: &str) -> Option<Node<'s>> {
        let value = self.table.get(key)?;
        Some(Node { path: join(&self.path, key), span: value.span(), value: value.get_ref() })
    }

    /// Keys with their places, in the order of the file.
    pub fn keys(&self) -> Vec<(&'s str, Range<usize>)> {
        let mut keys: Vec<_> =
            self.table.iter().map(|(k, _)| (k.get_ref().as_ref(), k.span())).collect();
        keys.sort_by_key(|(_, span)| span.start);
        keys
    }
}

/// What a fault is about: a file with syntax errors keeps only the faults of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum About {
    /// A value that is wrong wherever it stands.
    Value,
    /// A key or name that something else in the file decides about.
    Context,
}

/// A fault before it has got its line and column.
#[derive(Clone, Debug)]
pub(crate) struct Raw {
    pub code: FaultCode,
    pub about: About,
    pub path: String,
    pub span: Range<usize>,
    pub found: String,
    pub expected: String,
}

/// Collects faults, and the names that values may refer to.
#[derive(Debug, Default)]
pub(crate) struct Reader<'s> {
    /// The text, to look at values as they were written.
    pub text: &'s str,
    /// Faults so far, shape (faults).
    pub faults: Vec<Raw>,
    /// Paths at which a placeholder stands for a value that could not be read.
    pub tainted: BTreeSet<String>,
    /// Missing keys that stand misspelt in their table, by path and place of the table: one fault says it all.
    pub excused: BTreeSet<(String, usize)>,
    /// Folder that the paths of other files start from.
    pub folder: PathBuf,
    /// Which files it may name.
    pub access: FileAccess,
    /// A table of another file with more rows is written as its name.
    pub most_rows: usize,
    /// Other files that were read.
    pub files: usize,
    /// Paths of time functions of base loads, whose files may hold accelerations.
    pub base_functions: BTreeSet<String>,
    /// Paths of the keys that name files of accelerations.
    pub accelerations: BTreeSet<String>,
    names: BTreeMap<&'static str, Names<'s>>,
}

/// Names under a kind of table.
#[derive(Debug, Default)]
struct Names<'s> {
    /// In the order of the file, shape (names).
    list: Vec<&'s str>,
    all: HashSet<&'s str>,
}

impl<'s> Names<'s> {
    fn new(list: Vec<&'s str>) -> Self {
        let all = list.iter().copied().collect();
        Self { list, all }
    }
}

/// Paths of the time functions of loads of kind "base".
fn base_functions(root: &Body<'_>) -> BTreeSet<String> {
    let Some(loads) = root.get("load").as_ref().and_then(Body::of) else { return BTreeSet::new() };
    let load = |(name, _): (&str, _)| loads.get(name).as_ref().and_then(Body::of);
    let bodies = loads.keys().into_iter().filter_map(load);
    let is_base =
        |body: &Body<'_>| body.get("kind").is_some_and(|k| k.value.as_str() == Some("base"));
    bodies.filter(is_base).map(|body| join(&body.path, "function")).collect()
}

impl<'s> Reader<'s> {
    pub fn new(text: &'s str, root: &Body<'s>, files: Files<'_>) -> Self {
        let mut names = BTreeMap::new();
        for kind in ["material", "section", "beam", "mass", "obstacle", "projectile"] {
            let table = root.get(kind).as_ref().and_then(Body::of);
            let keys = table.map(|t| t.keys()).unwrap_or_default();
            names.insert(kind, Names::new(keys.into_iter().map(|(name, _)| name).collect()));
        }
        let Files { folder, access, most_rows } = files;
        let base_functions = base_functions(root);
        let folder = folder.into();
        Self { text, names, folder, access, most_rows, base_functions, ..Self::default() }
    }

    /// Makes names known that values may refer to, by kind of table.
    pub fn name_all(&mut self, names: impl IntoIterator<Item = (&'static str, Vec<&'s str>)>) {
        self.names.extend(names.into_iter().map(|(kind, list)| (kind, Names::new(list))));
    }

    /// Names under a kind of table that others refer to.
    pub fn names(&self, kind: &str) -> &[&'s str] {
        self.names.get(kind).map_or(&[], |names| names.list.as_slice())
    }

    /// Whether a table of that kind has that name.
    pub fn knows(&self, kind: &str, name: &str) -> bool {
        self.names.get(kind).is_some_and(|names| names.all.contains(name))
    }

    /// Whether `key` stands misspelt in that table.
    pub fn excuses(&self, body: &Body<'_>, key: &str) -> bool {
        self.excused.contains(&(join(&body.path, key), body.span.start))
    }

    /// A fault of a value.
    pub fn wrong(
        &mut self,
        node: &Node<'_>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) {
        self.wrong_as(FaultCode::ValueType, node, found, expected);
    }

    /// A fault of a value, of a kind of its own.
    pub fn wrong_as(
        &mut self,
        code: FaultCode,
        node: &Node<'_>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) {
        let (path, span) = (node.path.clone(), node.span.clone());
        let (found, expected) = (found.into(), expected.into());
        self.faults.push(Raw { code, about: About::Value, path, span, found, expected });
    }

    /// A key that is not there; nothing is said of it where it stands misspelt.
    pub fn missing(
        &mut self,
        body: &Body<'_>,
        key: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) {
        let path = join(&body.path, key);
        self.tainted.insert(path.clone());
        if !self.excuses(body, key) {
            self.misplaced_as(FaultCode::MissingKey, &path, body.span.clone(), (found, expected));
        }
    }

    /// A fault of a key or name.
    pub fn misplaced(
        &mut self,
        path: &str,
        span: Range<usize>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) {
        self.misplaced_as(FaultCode::Conflict, path, span, (found, expected));
    }

    /// A fault of a key or name, of a kind of its own: what was found, and what was expected.
    pub fn misplaced_as(
        &mut self,
        code: FaultCode,
        path: &str,
        span: Range<usize>,
        (found, expected): (impl Into<String>, impl Into<String>),
    ) {
        let (path, found, expected) = (path.into(), found.into(), expected.into());
        self.faults.push(Raw { code, about: About::Context, path, span, found, expected });
    }
}
