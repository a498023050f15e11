//! Numbers with units, alone and in pairs.

use std::marker::PhantomData;

use serde_json::{Value as Json, json};
use toml::de::{DeInteger, DeValue};

use crate::code::FaultCode;
use crate::format::{self, Format, Inline};
use crate::layout::Described;
use crate::measure::{self, Measure};
use crate::node::{Node, Reader};
use crate::reach::{self, Lost, Reached};
use crate::units::{self, Dimension};
use crate::write;

/// A number: bare in SI, or a text with its unit.
pub(crate) struct Quantity<M>(PhantomData<M>);

impl<M: Measure> Format for Quantity<M> {
    type Value = f64;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<f64> {
        match node.value {
            DeValue::Integer(number) => bare(node, integer(number), reader),
            DeValue::Float(number) => bare(node, number.as_str().parse().ok(), reader),
            DeValue::String(text) => with_unit::<M>(node, text, reader),
            _ => {
                reader.wrong(node, node.found(), Self::expected());
                None
            }
        }
    }

    fn placeholder() -> f64 {
        1.0
    }

    fn expected() -> String {
        expected::<M>()
    }

    fn schema() -> Json {
        let about = if M::UNIT.is_empty() {
            "a number".to_string()
        } else {
            format!("{}: a number in {}, or a text with its unit", M::NAME, M::UNIT)
        };
        json!({ "type": ["number", "string"], "title": about })
    }

    fn described() -> Described {
        Described { expected: Self::expected(), unit: M::UNIT, ..Described::default() }
    }

    fn number(value: &f64) -> Option<(f64, &'static str)> {
        Some((*value, M::UNIT))
    }

    fn set_number(value: &mut f64, number: f64) -> Result<(), String> {
        *value = number;
        Ok(())
    }
}

impl<M: Measure> Inline for Quantity<M> {
    const UNIT: &'static str = M::UNIT;

    fn text(value: &f64) -> Option<String> {
        Some(write::number(*value))
    }
}

fn expected<M: Measure>() -> String {
    match M::UNIT {
        "" => format!("a number, such as {}", M::EXAMPLE),
        _ => format!("{}, such as {}", name::<M>(), M::EXAMPLE),
    }
}

fn name<M: Measure>() -> String {
    match M::UNIT {
        "" => M::NAME.to_string(),
        unit => format!("{} ({unit})", M::NAME),
    }
}

fn integer(number: &DeInteger<'_>) -> Option<f64> {
    match number.radix() {
        10 => number.as_str().parse().ok(),
        radix => u64::from_str_radix(number.as_str(), radix).ok().map(|n| n as f64),
    }
}

/// Whether a value is the number 1.
pub(crate) fn is_one(value: &DeValue<'_>) -> bool {
    match value {
        DeValue::Integer(number) => integer(number) == Some(1.0),
        DeValue::Float(number) => number.as_str().parse() == Ok(1.0),
        _ => false,
    }
}

fn bare(node: &Node<'_>, value: Option<f64>, reader: &mut Reader<'_>) -> Option<f64> {
    let finite = value.filter(|v| v.is_finite());
    if finite.is_none() {
        reader.wrong(node, node.found(), "a finite number");
    }
    finite
}

fn with_unit<M: Measure>(node: &Node<'_>, text: &str, reader: &mut Reader<'_>) -> Option<f64> {
    let quantity = match units::parse(text) {
        Ok(quantity) => quantity,
        Err(fault) => {
            let node = part(node, text, fault.span, reader.text);
            let expected = if fault.expected.starts_with("a known unit") {
                fault.expected
            } else {
                format!("{}: {}", fault.expected, expected::<M>())
            };
            reader.wrong_as(FaultCode::Unit, &node, fault.found, expected);
            return None;
        }
    };
    if !measure::fits::<M>(quantity.dimension) {
        let found = format!("\"{text}\", which is {}", measure::name(quantity.dimension));
        let expected = format!("{}{}", expected::<M>(), gravities::<M>(text, quantity.dimension));
        reader.wrong_as(FaultCode::Unit, node, found, expected);
        return None;
    }
    if let Some(unit) = M::REFUSED.iter().find(|unit| text.contains(*unit)) {
        let found = format!("\"{text}\", in {unit}");
        reader.wrong_as(FaultCode::Unit, node, found, expected::<M>());
        return None;
    }
    Some(quantity.value)
}

/// What an acceleration in `g` is in its unit: `g` is the gram in every file, and means standard gravity to many.
fn gravities<M: Measure>(text: &str, found: Dimension) -> String {
    if M::DIMENSION != measure::Acceleration::DIMENSION || found != measure::Mass::DIMENSION {
        return String::new();
    }
    let number = text.trim().strip_suffix('g').and_then(|number| number.trim().parse::<f64>().ok());
    let converted = |number: f64| {
        let value = units::parse(&format!("{number} kgf/kg")).map(|found| found.value);
        value.map(|value| {
            format!("; {number} times standard gravity is \"{} m/s^2\"", rounded(value))
        })
    };
    number.and_then(|number| converted(number).ok()).unwrap_or_default()
}

/// Six significant digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// The bytes `span` of a text as a place in the file, where the text stands there letter by letter.
fn part<'s>(node: &Node<'s>, text: &str, span: std::ops::Range<usize>, source: &str) -> Node<'s> {
    let mut part = node.clone();
    let written = source.get(node.span.start + 1..node.span.end.saturating_sub(1));
    if written == Some(text) {
        part.span = node.span.start + 1 + span.start..node.span.start + 1 + span.end;
    }
    part
}

/// Two components along e1 and e2.
pub(crate) struct Vector<M>(PhantomData<M>);

impl<M: Measure> Format for Vector<M> {
    type Value = [f64; 2];

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<[f64; 2]> {
        match node.elements().as_deref() {
            Some([first, second]) => {
                let first = Quantity::<M>::read(first, reader);
                let second = Quantity::<M>::read(second, reader);
                Some([first?, second?])
            }
            _ => {
                reader.wrong(node, node.found(), Self::expected());
                None
            }
        }
    }

    fn placeholder() -> [f64; 2] {
        [1.0, 0.0]
    }

    fn expected() -> String {
        format!("two components, each {}, such as [0, {}]", name::<M>(), M::EXAMPLE)
    }

    fn schema() -> Json {
        json!({ "type": "array", "items": Quantity::<M>::schema(), "minItems": 2, "maxItems": 2 })
    }

    fn described() -> Described {
        Described { expected: Self::expected(), unit: M::UNIT, ..Described::default() }
    }

    fn reach<'c>(value: &'c mut [f64; 2], path: &[String]) -> Reached<'c> {
        if path.is_empty() {
            return format::end::<Self>(value, path);
        }
        let (entry, rest) = reach::entry(value, path)?;
        Quantity::<M>::reach(entry, rest).map_err(Lost::deeper)
    }
}

impl<M: Measure> Inline for Vector<M> {
    const UNIT: &'static str = M::UNIT;

    fn text(value: &[f64; 2]) -> Option<String> {
        Some(format!("[{}, {}]", write::number(value[0]), write::number(value[1])))
    }
}
