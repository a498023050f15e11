//! Forms of counts, truth values and texts.

use serde_json::{Value as Json, json};

use super::{Format, Inline};
use crate::node::{Node, Reader};
use crate::write;

/// A whole number of zero or above.
pub(crate) struct Count;

impl Format for Count {
    type Value = usize;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<usize> {
        let number = node.value.as_integer();
        let count = number.and_then(|n| usize::from_str_radix(n.as_str(), n.radix()).ok());
        if count.is_none() {
            reader.wrong(node, node.found(), Self::expected());
        }
        count
    }

    fn placeholder() -> usize {
        1
    }

    fn expected() -> String {
        "a whole number above zero, such as 6".into()
    }

    fn schema() -> Json {
        json!({ "type": "integer", "minimum": 1 })
    }

    fn number(value: &usize) -> Option<(f64, &'static str)> {
        Some((*value as f64, ""))
    }

    fn set_number(value: &mut usize, number: f64) -> Result<(), String> {
        if number.fract() != 0.0 || !(0.0..1e9).contains(&number) {
            return Err(Self::expected());
        }
        *value = number as usize;
        Ok(())
    }
}

impl Inline for Count {
    fn text(value: &usize) -> Option<String> {
        Some(value.to_string())
    }
}

/// `true` or `false`.
pub(crate) struct Flag;

impl Format for Flag {
    type Value = bool;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<bool> {
        let flag = node.value.as_bool();
        if flag.is_none() {
            reader.wrong(node, node.found(), Self::expected());
        }
        flag
    }

    fn placeholder() -> bool {
        false
    }

    fn expected() -> String {
        "true or false".into()
    }

    fn schema() -> Json {
        json!({ "type": "boolean" })
    }
}

impl Inline for Flag {
    fn text(value: &bool) -> Option<String> {
        Some(value.to_string())
    }
}

/// Free text.
pub(crate) struct Text;

impl Format for Text {
    type Value = String;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<String> {
        let text = node.value.as_str().map(str::to_string);
        if text.is_none() {
            reader.wrong(node, node.found(), Self::expected());
        }
        text
    }

    fn placeholder() -> String {
        String::new()
    }

    fn expected() -> String {
        "a text in quotes".into()
    }

    fn schema() -> Json {
        json!({ "type": "string" })
    }
}

impl Inline for Text {
    fn text(value: &String) -> Option<String> {
        Some(write::text(value))
    }
}
