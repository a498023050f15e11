//! Tables of the format: declared once, for reader, writer, schema and suggestions.

use std::marker::PhantomData;

use serde_json::Value as Json;

use crate::format::{Format, Inline, Written};
use crate::node::{Body, Node, Reader};
use crate::schema;
use crate::source::join;
use crate::suggest;
use crate::write::Writer;

/// A key of a table.
pub(crate) struct Key {
    pub name: &'static str,
    pub about: String,
    /// Its JSON Schema; made only when asked for, for tables are described whenever one is read.
    pub schema: fn() -> Json,
    /// Whether it must be there.
    pub required: bool,
    /// Its default as TOML, if it has one that can be written.
    pub default: Option<String>,
}

/// One of the kinds a table can be of.
pub(crate) struct Variant {
    pub word: &'static str,
    pub about: String,
    pub keys: Vec<Key>,
}

/// The key that says of which kind a table is, and the kinds.
pub(crate) struct Kinds {
    pub tag: &'static str,
    pub about: String,
    pub default: Option<&'static str>,
    pub variants: Vec<Variant>,
}

/// A table of the format.
pub(crate) trait Table: Sized {
    fn about() -> String;
    fn keys() -> Vec<Key>;
    fn kinds() -> Option<Kinds>;
    /// Sets of keys that may be left out, of which one set must be there.
    fn either() -> Vec<Vec<&'static str>>;
    /// Reads every key; `None` only if its kind is not known.
    fn read(body: &Body<'_>, reader: &mut Reader<'_>) -> Option<Self>;
    fn placeholder() -> Self;
    fn write(&self, out: &mut Writer);
}

/// The part of a table that depends on its kind.
pub(crate) trait Choice: Sized {
    fn kinds() -> Kinds;
    fn read(body: &Body<'_>, reader: &mut Reader<'_>) -> Option<Self>;
    fn placeholder() -> Self;
    fn write(&self, out: &mut Writer);
}

/// Joins the lines of a doc comment.
pub(crate) fn about(lines: &[&str]) -> String {
    lines.iter().map(|l| l.trim()).collect::<Vec<_>>().join(" ").trim().to_string()
}

/// Reads a key that must be there.
pub(crate) fn required<F: Format>(body: &Body<'_>, key: &str, reader: &mut Reader<'_>) -> F::Value {
    let value = match body.get(key) {
        Some(node) => F::read(&node, reader),
        None => {
            let (found, expected) = F::missing(key);
            missing(body, key, found, expected, reader);
            None
        }
    };
    value.unwrap_or_else(|| {
        reader.tainted.insert(join(&body.path, key));
        F::placeholder()
    })
}

/// A key that is not there; nothing is said of it where it stands misspelt.
pub(crate) fn missing(
    body: &Body<'_>,
    key: &str,
    found: String,
    expected: String,
    reader: &mut Reader<'_>,
) {
    let path = join(&body.path, key);
    reader.tainted.insert(path.clone());
    if !reader.excuses(body, key) {
        reader.misplaced(&path, body.span.clone(), found, expected);
    }
}

/// Reads a key that has a default.
pub(crate) fn optional<F: Format>(
    body: &Body<'_>,
    key: &str,
    default: F::Value,
    reader: &mut Reader<'_>,
) -> F::Value {
    let Some(node) = body.get(key) else { return default };
    F::read(&node, reader).unwrap_or_else(|| {
        reader.tainted.insert(node.path.clone());
        default
    })
}

/// The word that says of which kind a table is.
pub(crate) fn kind<'k>(
    body: &Body<'_>,
    kinds: &'k Kinds,
    reader: &mut Reader<'_>,
) -> Option<&'k Variant> {
    let words = || kinds.variants.iter().map(|v| v.word);
    let Some(node) = body.get(kinds.tag) else {
        if kinds.default.is_none() {
            let found = format!("no `{}`", kinds.tag);
            missing(body, kinds.tag, found, suggest::one_of("", words()), reader);
        }
        return kinds.variants.iter().find(|v| Some(v.word) == kinds.default);
    };
    let word = node.value.as_str();
    let chosen = kinds.variants.iter().find(|v| Some(v.word) == word);
    if chosen.is_none() {
        reader.wrong(&node, node.found(), suggest::one_of(word.unwrap_or(""), words()));
    }
    chosen
}

/// Reads a table: keys that do not belong, then the keys that do.
pub(crate) fn read<T: Table>(body: &Body<'_>, reader: &mut Reader<'_>) -> Option<T> {
    let (keys, kinds) = (T::keys(), T::kinds());
    // The fault of an unknown kind is reported once, by the reader of the kind itself.
    let chosen = kinds.as_ref().and_then(|k| {
        let word = body.get(k.tag);
        let word = word.as_ref().map_or(k.default, |node| node.value.as_str());
        k.variants.iter().find(|v| Some(v.word) == word)
    });
    for (key, span) in body.keys() {
        let common = keys.iter().any(|k| k.name == key);
        let of = |v: &Variant| v.keys.iter().any(|k| k.name == key);
        if common || kinds.as_ref().is_some_and(|k| k.tag == key) || chosen.is_some_and(of) {
            continue;
        }
        let owner = kinds.iter().flat_map(|k| &k.variants).find(|v| of(v));
        let path = join(&body.path, key);
        match (owner, chosen, &kinds) {
            (Some(owner), Some(chosen), Some(kinds)) => {
                let found = format!("`{key}`, which belongs to {} = \"{}\"", kinds.tag, owner.word);
                let expected = expected_keys("", &keys, Some(kinds), &chosen.keys);
                let expected = format!("{expected} for {} = \"{}\"", kinds.tag, chosen.word);
                reader.misplaced(&path, span, found, expected);
            }
            (Some(_), None, _) => {} // may belong: the kind is not known
            _ => {
                let own = chosen.map_or(&[][..], |v| &v.keys);
                if let Some(meant) = suggest::nearest(key, names(&keys, kinds.as_ref(), own)) {
                    reader.excused.insert((join(&body.path, meant), body.span.start));
                }
                let expected = expected_keys(key, &keys, kinds.as_ref(), own);
                reader.misplaced(&path, span, format!("the unknown key `{key}`"), expected);
            }
        }
    }
    T::read(body, reader)
}

fn expected_keys(key: &str, common: &[Key], kinds: Option<&Kinds>, own: &[Key]) -> String {
    let names: Vec<_> = names(common, kinds, own).collect();
    suggest::one_of(key, names.into_iter())
}

fn names<'k>(
    common: &'k [Key],
    kinds: Option<&Kinds>,
    own: &'k [Key],
) -> impl Iterator<Item = &'static str> + 'k {
    let tag = kinds.map(|k| k.tag);
    common.iter().chain(own).map(|k| k.name).chain(tag)
}

/// A table that stands once: `[time]`.
pub(crate) struct Single<T>(PhantomData<T>);

impl<T: Table> Format for Single<T> {
    type Value = T;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<T> {
        let Some(body) = Body::of(node) else {
            reader.wrong(node, node.found(), format!("a table [{}]", node.path));
            return None;
        };
        read(&body, reader)
    }

    fn placeholder() -> T {
        T::placeholder()
    }

    fn expected() -> String {
        let keys = T::keys();
        let names = keys.iter().filter(|k| k.required).map(|k| format!("`{}`", k.name));
        format!("a table with {}", names.collect::<Vec<_>>().join(" and "))
    }

    fn missing(key: &str) -> (String, String) {
        (format!("no [{key}]"), Self::expected())
    }

    fn schema() -> Json {
        schema::of_table::<T>()
    }
}

impl<T: Table> Written for Single<T> {
    fn write(value: &T, key: &str, out: &mut Writer) {
        out.header(key, None);
        value.write(out);
    }

    fn default_text(_: &T) -> Option<String> {
        None
    }
}

/// A table in braces behind an equals sign, or under a header of its own.
pub(crate) struct Braces<T>(PhantomData<T>);

impl<T: Table> Format for Braces<T> {
    type Value = T;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<T> {
        let Some(body) = Body::of(node) else {
            reader.wrong(node, node.found(), Self::expected());
            return None;
        };
        read(&body, reader)
    }

    fn placeholder() -> T {
        T::placeholder()
    }

    fn expected() -> String {
        let keys = T::keys();
        let names = keys.iter().filter(|k| k.required).map(|k| k.name);
        let names: Vec<String> = names.chain(T::kinds().map(|k| k.tag)).map(assigned).collect();
        match names.is_empty() {
            true => format!("a table in braces, such as {{ {} }}", assigned(keys[0].name)),
            false => format!("a table {{ {} }}", names.join(", ")),
        }
    }

    fn schema() -> Json {
        schema::of_table::<T>()
    }
}

fn assigned(key: &str) -> String {
    format!("{key} = ...")
}

impl<T: Table> Inline for Braces<T> {
    fn text(value: &T) -> Option<String> {
        let mut out = Writer::inline();
        value.write(&mut out);
        Some(out.finish())
    }
}

/// A table with the user's name for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Named<T> {
    /// The user's name.
    pub name: String,
    /// The table.
    pub table: T,
}

/// Tables with names: `[beam.girder]`, in the order of the file.
pub(crate) struct Collection<T>(PhantomData<T>);

impl<T: Table> Format for Collection<T> {
    type Value = Vec<Named<T>>;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value> {
        let header = format!("tables [{}.NAME], each with a name of your own", node.path);
        let Some(body) = Body::of(node) else {
            reader.wrong(node, node.found(), header);
            return None;
        };
        let keys = body.keys();
        let is_table = |key: &str| body.get(key).is_some_and(|n| n.value.is_table());
        if !keys.is_empty() && !keys.iter().any(|(key, _)| is_table(key)) {
            let found = format!("keys straight under [{}]", node.path);
            reader.misplaced(&node.path, node.span.clone(), found, header);
            return None;
        }
        let mut all = Vec::new();
        for (name, span) in keys {
            let Some(node) = body.get(name) else { continue };
            if !is_name(name) {
                let found = format!("the name {name:?}");
                reader.misplaced(&node.path, span, found, "a name of letters, digits, `_` and `-`");
            }
            if let Some(table) = Single::<T>::read(&node, reader) {
                all.push(Named { name: name.to_string(), table });
            }
        }
        Some(all)
    }

    fn placeholder() -> Self::Value {
        Vec::new()
    }

    fn expected() -> String {
        "tables with names of your own".into()
    }

    fn missing(key: &str) -> (String, String) {
        (format!("no {key}"), format!("at least one table [{key}.NAME]"))
    }

    fn schema() -> Json {
        schema::of_collection::<T>()
    }
}

impl<T: Table> Written for Collection<T> {
    fn write(value: &Self::Value, key: &str, out: &mut Writer) {
        for one in value {
            out.header(key, Some(&one.name));
            one.table.write(out);
        }
    }

    fn default_text(_: &Self::Value) -> Option<String> {
        None
    }
}

/// Names appear between dots in the names of results.
fn is_name(name: &str) -> bool {
    !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '-')
}
