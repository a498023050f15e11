//! How the value of a key is written in a file: one type per form, for reader, writer and schema.

mod plain;

use std::marker::PhantomData;

use serde_json::{Value as Json, json};

use crate::layout::Described;
use crate::node::{Node, Reader};
use crate::reach::{self, Lost, Reached, Slot};
use crate::write::Writer;

pub(crate) use plain::{Count, Flag, Text};

/// A form in which a value stands behind a key.
pub(crate) trait Format: Sized + 'static {
    /// What it is read into.
    type Value: 'static;
    /// Reads it; a fault is reported to the reader.
    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value>;
    /// A harmless value that stands in for one at fault, so that the rest can be checked.
    fn placeholder() -> Self::Value;
    /// What is expected, with an example.
    fn expected() -> String;
    /// What is said where `key` is missing: what was found and what was expected.
    fn missing(key: &str) -> (String, String) {
        (format!("no `{key}`"), Self::expected())
    }
    /// JSON Schema.
    fn schema() -> Json;
    /// What a reference says of it.
    fn described() -> Described {
        Described { expected: Self::expected(), ..Described::default() }
    }
    /// What stands at the end of a path that begins at the value.
    fn reach<'c>(value: &'c mut Self::Value, path: &[String]) -> Reached<'c> {
        end::<Self>(value, path)
    }
    /// The value as a number with its SI unit, where it is one.
    fn number(_: &Self::Value) -> Option<(f64, &'static str)> {
        None
    }
    /// Makes a number the value.
    ///
    /// # Errors
    /// What would be right.
    fn set_number(_: &mut Self::Value, _: f64) -> Result<(), String> {
        Err(Self::expected())
    }
    /// Reads what shall take the place of the value.
    fn read_over(_: &Self::Value, node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value> {
        Self::read(node, reader)
    }
}

/// A form that fits behind an equals sign and into a list.
pub(crate) trait Inline: Format {
    /// SI unit of a bare number.
    const UNIT: &'static str = "";
    /// The value as TOML; `None` for one that is left out.
    fn text(value: &Self::Value) -> Option<String>;
}

/// A form that can be written: behind an equals sign, or as a table of its own.
pub(crate) trait Written: Format {
    /// Writes `key = value`, or a table.
    fn write(value: &Self::Value, key: &str, out: &mut Writer);
    /// The value as TOML, if it fits behind an equals sign.
    fn default_text(value: &Self::Value) -> Option<String>;
}

impl<F: Inline> Written for F {
    fn write(value: &Self::Value, key: &str, out: &mut Writer) {
        if let Some(text) = F::text(value) {
            out.line(key, &text, F::UNIT);
        }
    }

    fn default_text(value: &Self::Value) -> Option<String> {
        F::text(value)
    }
}

/// A value of a form.
struct At<'c, F: Format>(&'c mut F::Value);

impl<F: Format> Slot for At<'_, F> {
    fn unit(&self) -> Option<&'static str> {
        F::number(self.0).map(|number| number.1)
    }

    fn number(&self) -> Option<f64> {
        F::number(self.0).map(|number| number.0)
    }

    fn set(&mut self, number: f64) -> Result<(), String> {
        F::set_number(self.0, number)
    }

    fn read(&mut self, node: &Node<'_>, reader: &mut Reader<'_>) -> bool {
        match F::read_over(self.0, node, reader) {
            Some(value) => {
                *self.0 = value;
                true
            }
            None => false,
        }
    }
}

/// The value itself, if the path ends here.
pub(crate) fn end<'c, F: Format>(value: &'c mut F::Value, path: &[String]) -> Reached<'c> {
    match path {
        [] => Ok(Box::new(At::<F>(value))),
        [step, ..] => Err(Lost::behind(step)),
    }
}

/// Any number of values.
pub(crate) struct List<F>(PhantomData<F>);

impl<F: Inline> Format for List<F> {
    type Value = Vec<F::Value>;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value> {
        let Some(elements) = node.elements() else {
            reader.wrong(node, node.found(), Self::expected());
            return None;
        };
        // Every element is read before the first missing one ends it: all faults at once.
        let read: Vec<_> = elements.iter().map(|e| F::read(e, reader)).collect();
        read.into_iter().collect()
    }

    fn placeholder() -> Self::Value {
        vec![F::placeholder(), F::placeholder()]
    }

    fn expected() -> String {
        format!("a list `[...]`, each entry {}", F::expected())
    }

    fn schema() -> Json {
        json!({ "type": "array", "items": F::schema() })
    }

    fn described() -> Described {
        Described { expected: Self::expected(), ..F::described() }
    }

    fn reach<'c>(value: &'c mut Self::Value, path: &[String]) -> Reached<'c> {
        if path.is_empty() {
            return end::<Self>(value, path);
        }
        let (entry, rest) = reach::entry(value, path)?;
        F::reach(entry, rest).map_err(Lost::deeper)
    }
}

impl<F: Inline> Inline for List<F> {
    const UNIT: &'static str = F::UNIT;

    fn text(value: &Self::Value) -> Option<String> {
        let items: Vec<String> = value.iter().filter_map(F::text).collect();
        Some(format!("[{}]", items.join(", ")))
    }
}

/// Exactly two values.
pub(crate) struct Pair<F>(PhantomData<F>);

impl<F: Inline> Format for Pair<F> {
    type Value = [F::Value; 2];

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value> {
        match node.elements().as_deref() {
            Some([first, second]) => {
                let (first, second) = (F::read(first, reader), F::read(second, reader));
                Some([first?, second?])
            }
            _ => {
                reader.wrong(node, node.found(), Self::expected());
                None
            }
        }
    }

    fn placeholder() -> Self::Value {
        [F::placeholder(), F::placeholder()]
    }

    fn expected() -> String {
        format!("a list of two, each {}", F::expected())
    }

    fn schema() -> Json {
        json!({ "type": "array", "items": F::schema(), "minItems": 2, "maxItems": 2 })
    }

    fn described() -> Described {
        Described { expected: Self::expected(), ..F::described() }
    }

    fn reach<'c>(value: &'c mut Self::Value, path: &[String]) -> Reached<'c> {
        if path.is_empty() {
            return end::<Self>(value, path);
        }
        let (entry, rest) = reach::entry(value, path)?;
        F::reach(entry, rest).map_err(Lost::deeper)
    }
}

impl<F: Inline> Inline for Pair<F> {
    const UNIT: &'static str = F::UNIT;

    fn text(value: &Self::Value) -> Option<String> {
        Some(format!("[{}, {}]", F::text(&value[0])?, F::text(&value[1])?))
    }
}

/// Two values of the same kind in two forms.
pub(crate) struct Couple<F, G>(PhantomData<(F, G)>);

impl<F: Inline, G: Inline<Value = F::Value>> Format for Couple<F, G> {
    type Value = [F::Value; 2];

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value> {
        match node.elements().as_deref() {
            Some([first, second]) => {
                let (first, second) = (F::read(first, reader), G::read(second, reader));
                Some([first?, second?])
            }
            _ => {
                reader.wrong(node, node.found(), Self::expected());
                None
            }
        }
    }

    fn placeholder() -> Self::Value {
        [F::placeholder(), G::placeholder()]
    }

    fn expected() -> String {
        format!("a list of two, first {}, then {}", F::expected(), G::expected())
    }

    fn schema() -> Json {
        json!({
            "type": "array", "prefixItems": [F::schema(), G::schema()], "minItems": 2, "maxItems": 2
        })
    }

    fn reach<'c>(value: &'c mut Self::Value, path: &[String]) -> Reached<'c> {
        if path.is_empty() {
            return end::<Self>(value, path);
        }
        let second = path[0] == "1";
        let (entry, rest) = reach::entry(value, path)?;
        if second { G::reach(entry, rest) } else { F::reach(entry, rest) }.map_err(Lost::deeper)
    }
}

impl<F: Inline, G: Inline<Value = F::Value>> Inline for Couple<F, G> {
    const UNIT: &'static str = "";

    fn text(value: &Self::Value) -> Option<String> {
        Some(format!("[{}, {}]", F::text(&value[0])?, G::text(&value[1])?))
    }
}

/// A value that may be left out and has no default.
pub(crate) struct Maybe<F>(PhantomData<F>);

impl<F: Inline> Format for Maybe<F> {
    type Value = Option<F::Value>;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value> {
        F::read(node, reader).map(Some)
    }

    fn placeholder() -> Self::Value {
        None
    }

    fn expected() -> String {
        F::expected()
    }

    fn schema() -> Json {
        F::schema()
    }

    fn described() -> Described {
        Described { expected: Self::expected(), ..F::described() }
    }

    fn reach<'c>(value: &'c mut Self::Value, path: &[String]) -> Reached<'c> {
        match value {
            Some(value) => F::reach(value, path),
            None => Err(Lost::Reread),
        }
    }
}

impl<F: Inline> Inline for Maybe<F> {
    const UNIT: &'static str = F::UNIT;

    fn text(value: &Self::Value) -> Option<String> {
        F::text(value.as_ref()?)
    }
}
