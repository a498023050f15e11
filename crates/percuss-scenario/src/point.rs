//! Points on beams: `girder.start`, `girder.mid`, `girder.end`, `girder@0.25`, `girder@75cm`.

use percuss::Along;
use serde_json::{Value as Json, json};

use crate::format::{Format, Inline, Text, known_name};
use crate::measure::{self, Length, Measure, Ratio};
use crate::node::{Node, Reader};
use crate::suggest;
use crate::units;
use crate::write;

/// A point on a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// As written, without blanks.
    pub label: String,
    /// Name of the beam.
    pub beam: String,
    /// Where along it.
    pub along: Along,
}

const WORDS: &[(&str, f64)] = &[("start", 0.0), ("mid", 0.5), ("end", 1.0)];

/// A point on a beam, as a text.
pub(crate) struct PointText;

impl Format for PointText {
    type Value = Point;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Point> {
        let text = Text::read(node, reader)?;
        let label: String = text.chars().filter(|c| !c.is_whitespace()).collect();
        let (beam, along) = match label.split_once('@') {
            Some((beam, place)) => (beam, distance(place)),
            None => match label.split_once('.') {
                Some((beam, place)) => (beam, word(place)),
                None => (label.as_str(), Err((node.found(), Self::expected()))),
            },
        };
        let known = match label.contains(['@', '.']) {
            true => known_name("beam", beam, node, reader),
            false => false,
        };
        match along {
            Ok(along) if known => Some(Point { label: label.clone(), beam: beam.into(), along }),
            Ok(_) => None,
            Err((found, expected)) => {
                reader.wrong(node, found, expected);
                None
            }
        }
    }

    fn placeholder() -> Point {
        Point { label: String::new(), beam: String::new(), along: Along::Fraction(0.5) }
    }

    fn expected() -> String {
        "a point on a beam: BEAM.start, BEAM.mid, BEAM.end, BEAM@0.25 or BEAM@0.75m".into()
    }

    fn schema() -> Json {
        json!({ "type": "string", "pattern": r"^\s*[^@.]+(\.(start|mid|end)|@.+)\s*$" })
    }
}

impl Inline for PointText {
    fn text(value: &Point) -> Option<String> {
        Some(write::text(&value.label))
    }
}

/// Found and expected.
type Clash = (String, String);

fn word(place: &str) -> Result<Along, Clash> {
    let known = WORDS.iter().find(|w| w.0 == place);
    known.map(|w| Along::Fraction(w.1)).ok_or_else(|| {
        let expected = suggest::one_of(place, WORDS.iter().map(|w| w.0));
        let expected = format!("{expected}, or `@` with a fraction or a length");
        (format!("the unknown place `.{place}`"), expected)
    })
}

fn distance(place: &str) -> Result<Along, Clash> {
    let expected = "a fraction or a length after `@`, such as 0.25 or 0.75m";
    let quantity = units::parse(place)
        .map_err(|fault| (format!("{} after `@`", fault.found), fault.expected))?;
    match quantity.dimension {
        Ratio::DIMENSION => Ok(Along::Fraction(quantity.value)),
        Length::DIMENSION => Ok(Along::Distance(quantity.value)),
        other => Err((
            format!("`{place}` after `@`, which is {}", measure::name(other)),
            expected.into(),
        )),
    }
}
