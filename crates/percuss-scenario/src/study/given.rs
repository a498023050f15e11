//! Values whose meaning another file decides.

use serde_json::{Value as Json, json};
use toml::de::DeValue;

use crate::code::FaultCode;
use crate::format::{Format, Inline};
use crate::node::{Body, Node, Reader};
use crate::table::{Named, is_name};
use crate::write::{self, Writer};

/// A value as it stands in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Given {
    /// As TOML: `20`, `"20 m/s"`, `[0, "20 m/s"]`.
    pub toml: String,
}

impl Given {
    /// Whether it is a bare word, so that no number can be meant: a text that begins with a letter.
    pub fn is_word(&self) -> bool {
        self.toml.trim_start_matches(['"', '\'']).starts_with(char::is_alphabetic)
    }
}

/// Any value but a table.
pub(crate) struct Anything;

impl Format for Anything {
    type Value = Given;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Given> {
        if matches!(node.value, DeValue::Table(_)) {
            reader.wrong(node, node.found(), Self::expected());
            return None;
        }
        let toml = reader.text.get(node.span.clone())?.to_string();
        Some(Given { toml })
    }

    fn placeholder() -> Given {
        Given { toml: "1".into() }
    }

    fn expected() -> String {
        "a value as written in the scenario, such as 20 or \"20 m/s\"".into()
    }

    fn schema() -> Json {
        json!({ "type": ["number", "string", "boolean", "array"] })
    }
}

impl Inline for Anything {
    fn text(value: &Given) -> Option<String> {
        Some(value.toml.clone())
    }
}

/// A whole number, zero included.
pub(crate) struct Whole;

impl Format for Whole {
    type Value = u64;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<u64> {
        let number = node.value.as_integer();
        let whole = number.and_then(|n| u64::from_str_radix(n.as_str(), n.radix()).ok());
        if whole.is_none() {
            reader.wrong(node, node.found(), Self::expected());
        }
        whole
    }

    fn placeholder() -> u64 {
        0
    }

    fn expected() -> String {
        "a whole number, zero or above".into()
    }

    fn schema() -> Json {
        json!({ "type": "integer", "minimum": 0 })
    }
}

impl Inline for Whole {
    fn text(value: &u64) -> Option<String> {
        Some(value.to_string())
    }
}

/// Texts with names of the user's: `[results]`.
pub(crate) struct NamedTexts;

impl Format for NamedTexts {
    type Value = Vec<Named<String>>;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value> {
        let Some(body) = Body::of(node) else {
            reader.wrong(node, node.found(), Self::expected());
            return None;
        };
        let mut all = Vec::new();
        for (name, span) in body.keys() {
            let Some(node) = body.get(name) else { continue };
            if !is_name(name) {
                let found = format!("the name {name:?}");
                let expected = "a name of letters, digits, `_` and `-`";
                reader.misplaced_as(FaultCode::InvalidName, &node.path, span, (found, expected));
            }
            match node.value.as_str() {
                Some(text) => all.push(Named { name: name.to_string(), table: text.to_string() }),
                None => {
                    let expected =
                        "a path into summary.json, such as \"contact.mass.peak_force.value\"";
                    reader.wrong(&node, node.found(), expected);
                    reader.tainted.insert(node.path.clone());
                }
            }
        }
        Some(all)
    }

    fn placeholder() -> Self::Value {
        Vec::new()
    }

    fn expected() -> String {
        "a table of names of your own, each with a path into summary.json".into()
    }

    fn missing(key: &str) -> (String, String) {
        (format!("no [{key}]"), Self::expected())
    }

    fn schema() -> Json {
        json!({ "type": "object", "additionalProperties": { "type": "string" } })
    }
}

impl crate::format::Written for NamedTexts {
    fn write(value: &Self::Value, key: &str, out: &mut Writer) {
        out.header(key, None);
        for one in value {
            out.line(&write::key(&one.name), &write::text(&one.table), "");
        }
    }

    fn default_text(_: &Self::Value) -> Option<String> {
        None
    }
}
