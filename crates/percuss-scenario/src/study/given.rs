//! Values whose meaning another file decides.

use serde_json::{Value as Json, json};
use toml::de::DeValue;

use crate::format::{Format, Inline};
use crate::node::{Node, Reader};

/// A value in the form of the file.
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
