//! Tables of the format: declared once, for reader, writer, schema and suggestions.

use std::marker::PhantomData;

use serde_json::Value as Json;

use crate::code::FaultCode;
use crate::format::{Format, Inline, Written};
use crate::layout::{Described, Inner, Key, Layout, TableForm};
use crate::node::{Body, Node, Reader};
use crate::reach::{Lost, Reached};
use crate::schema;
use crate::source::join;
use crate::stray::Stray;
use crate::write::Writer;

/// A table of the format, or a part of one: keys that stand together in several tables, or a choice of kinds.
pub(crate) trait Part: Sized + 'static {
    /// What may stand in it.
    fn layout() -> Layout;
    /// Reads every key; `None` only if its kind is not known.
    fn read(body: &Body<'_>, reader: &mut Reader<'_>) -> Option<Self>;
    /// One of harmless values.
    fn placeholder() -> Self;
    /// Writes every key.
    fn write(&self, out: &mut Writer);
    /// What stands at the end of a path that begins with one of its keys.
    fn reach<'c>(&'c mut self, path: &[String]) -> Reached<'c>;
}

/// A part as the text of a file.
pub(crate) fn to_toml(part: &impl Part) -> String {
    let mut out = Writer::default();
    part.write(&mut out);
    out.finish()
}

/// A part that is declared by itself, as it stands in the source.
pub(crate) trait Declared: Part {
    /// The same as [`Part::layout`], made once: whoever reads a table looks at it.
    fn declared() -> &'static Layout;
}

/// A part whose keys may all be left out.
impl<P: Declared> Part for Option<P> {
    fn layout() -> Layout {
        let layout = P::layout();
        Layout { keys: layout.keys.into_iter().map(Key::optional).collect(), ..layout }
    }

    fn read(body: &Body<'_>, reader: &mut Reader<'_>) -> Option<Self> {
        let given = P::declared().keys.iter().any(|key| body.get(key.name).is_some());
        if given { P::read(body, reader).map(Some) } else { Some(None) }
    }

    fn placeholder() -> Self {
        None
    }

    fn write(&self, out: &mut Writer) {
        if let Some(part) = self {
            part.write(out);
        }
    }

    fn reach<'c>(&'c mut self, path: &[String]) -> Reached<'c> {
        if let Some(part) = self {
            return part.reach(path);
        }
        let keys: Vec<&str> = P::declared().keys.iter().map(|key| key.name).collect();
        match path {
            [key, ..] if keys.contains(&key.as_str()) => Err(Lost::Reread),
            [key, ..] => Err(Lost::key(key, keys)),
            [] => Err(Lost::Table),
        }
    }
}

/// Reads a key that must be there.
pub(crate) fn required<F: Format>(body: &Body<'_>, key: &str, reader: &mut Reader<'_>) -> F::Value {
    let value = match body.get(key) {
        Some(node) => F::read(&node, reader),
        None => {
            let (found, expected) = F::missing(key);
            reader.missing(body, key, found, expected);
            None
        }
    };
    value.unwrap_or_else(|| {
        reader.tainted.insert(join(&body.path, key));
        F::placeholder()
    })
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

/// Reads a table: keys that do not belong, then the keys that do.
pub(crate) fn read<T: Declared>(body: &Body<'_>, reader: &mut Reader<'_>) -> Option<T> {
    T::declared().check_keys(body, reader);
    T::read(body, reader)
}

/// Tells of the second of two keys that exclude each other; whether both are there.
pub(crate) fn exclude(body: &Body<'_>, keys: [&str; 2], reader: &mut Reader<'_>) -> bool {
    let [Some(_), Some(second)] = keys.map(|key| body.get(key)) else { return false };
    let found = format!("`{}` besides `{}`", keys[1], keys[0]);
    reader.misplaced(&second.path, second.span.clone(), found, "one of the two");
    true
}

/// A table that stands once: `[time]`.
pub(crate) struct Single<T>(PhantomData<T>);

impl<T: Declared> Format for Single<T> {
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
        let Layout { keys, choices, .. } = T::declared();
        let names = keys.iter().filter(|k| k.required).map(|k| format!("`{}`", k.name));
        let mut names: Vec<String> = names.collect();
        // A table of kinds alone has no key that each of them requires but that of its kind.
        if names.is_empty() {
            let open = choices.iter().filter(|kinds| kinds.default.is_none());
            names.extend(open.map(|kinds| {
                let words = kinds.variants.iter().map(|v| format!("\"{}\"", v.word));
                format!("`{}` = {}", kinds.tag, words.collect::<Vec<_>>().join(", "))
            }));
        }
        match names.is_empty() {
            true => "a table".to_owned(),
            false => format!("a table with {}", names.join(" and ")),
        }
    }

    fn missing(key: &str) -> (String, String) {
        (format!("no [{key}]"), Self::expected())
    }

    fn schema() -> Json {
        schema::of_table(T::layout())
    }

    fn described() -> Described {
        let table = Some(Inner::of::<T>(TableForm::Once));
        Described { expected: Self::expected(), table, ..Described::default() }
    }

    fn reach<'c>(value: &'c mut T, path: &[String]) -> Reached<'c> {
        value.reach(path)
    }
}

impl<T: Declared> Written for Single<T> {
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

impl<T: Declared> Format for Braces<T> {
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
        let Layout { keys, choices, .. } = T::declared();
        let names = keys.iter().filter(|k| k.required).map(|k| k.name);
        let names: Vec<String> = names.chain(choices.iter().map(|k| k.tag)).map(assigned).collect();
        match names.is_empty() {
            true => format!("a table in braces, such as {{ {} }}", assigned(keys[0].name)),
            false => format!("a table {{ {} }}", names.join(", ")),
        }
    }

    fn schema() -> Json {
        schema::of_table(T::layout())
    }

    fn described() -> Described {
        let table = Some(Inner::of::<T>(TableForm::Braces));
        Described { expected: Self::expected(), table, ..Described::default() }
    }

    fn reach<'c>(value: &'c mut T, path: &[String]) -> Reached<'c> {
        value.reach(path)
    }
}

fn assigned(key: &str) -> String {
    format!("{key} = ...")
}

impl<T: Declared> Inline for Braces<T> {
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

impl<T: Declared> Format for Collection<T> {
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
                let expected = "a name of letters, digits, `_` and `-`";
                reader.misplaced_as(FaultCode::InvalidName, &node.path, span, (found, expected));
            }
            match Single::<T>::read(&node, reader) {
                Some(table) => all.push(Named { name: name.to_string(), table }),
                None => _ = reader.tainted.insert(node.path),
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
        schema::of_collection(T::layout())
    }

    fn described() -> Described {
        let table = Some(Inner::of::<T>(TableForm::Named));
        Described { expected: Self::expected(), table, ..Described::default() }
    }

    fn reach<'c>(value: &'c mut Self::Value, path: &[String]) -> Reached<'c> {
        let Some((name, rest)) = path.split_first() else { return Err(Lost::Table) };
        let known: Vec<String> = value.iter().map(|one| one.name.clone()).collect();
        match value.iter_mut().find(|one| one.name == *name) {
            Some(one) => one.table.reach(rest).map_err(Lost::deeper),
            None => Err(Lost::Missing(Stray::name(name, known.iter().map(String::as_str)))),
        }
    }
}

impl<T: Declared> Written for Collection<T> {
    fn write(value: &Self::Value, key: &str, out: &mut Writer) {
        for one in value {
            out.header(key, Some(&one.name));
            out.inside(|out| one.table.write(out));
        }
    }

    fn default_text(_: &Self::Value) -> Option<String> {
        None
    }
}

/// Names appear between dots in the names of results.
pub(crate) fn is_name(name: &str) -> bool {
    !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '-')
}

impl Inner {
    /// The declaration of `T`.
    pub fn of<T: Part>(form: TableForm) -> Self {
        let path = std::any::type_name::<T>();
        let name = path.rsplit("::").next().unwrap_or(path);
        Self { name, form, layout: T::layout }
    }
}
