//! Points on beams: `girder.start`, `girder.mid`, `girder.end`, `girder@0.25`, `girder@75cm`.

use percuss::Along;
use serde_json::{Value as Json, json};
use toml::de::DeValue;

use crate::code::FaultCode;
use crate::format::{Format, Inline, Text};
use crate::measure::{self, Length, Measure, Ratio};
use crate::name::known_name;
use crate::node::{Node, Reader};
use crate::quantity::{Quantity, Vector};
use crate::reach::{Lost, Reached};
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
            Some((beam, place)) => (beam, distance(place, " after `@`")),
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

    /// The place along its beam.
    fn number(value: &Point) -> Option<(f64, &'static str)> {
        Place::number(&value.along)
    }

    fn set_number(value: &mut Point, number: f64) -> Result<(), String> {
        Place::set_number(&mut value.along, number)?;
        value.label = match value.along {
            Along::Fraction(f) => format!("{}@{}", value.beam, write::number(f)),
            Along::Distance(s) => format!("{}@{}m", value.beam, write::number(s)),
        };
        Ok(())
    }

    /// A place alone keeps the beam.
    fn read_over(old: &Point, node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Point> {
        if node.value.as_str().is_some_and(|text| text.contains(['@', '.']) && names_beam(text)) {
            return Self::read(node, reader);
        }
        let along = Place::read(node, reader)?;
        let mut point = Point { along, ..old.clone() };
        if let Some((place, _)) = Place::number(&along) {
            Self::set_number(&mut point, place).ok()?;
        }
        Some(point)
    }
}

impl Inline for PointText {
    fn text(value: &Point) -> Option<String> {
        Some(write::text(&value.label))
    }
}

/// Whether a text begins with a name and not with a number: `girder@0.3` beside `0.3 m`.
fn names_beam(text: &str) -> bool {
    text.trim_start().starts_with(|c: char| c.is_alphabetic() || c == '_')
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

fn distance(place: &str, after: &str) -> Result<Along, Clash> {
    let expected = format!("a fraction or a length{after}, such as 0.25 or 0.75m");
    let quantity =
        units::parse(place).map_err(|fault| (format!("{}{after}", fault.found), fault.expected))?;
    match quantity.dimension {
        Ratio::DIMENSION => Ok(Along::Fraction(quantity.value)),
        Length::DIMENSION => Ok(Along::Distance(quantity.value)),
        other => Err((format!("`{place}`{after}, which is {}", measure::name(other)), expected)),
    }
}

/// A place along a beam that is known already: a word, a fraction, or a text with a length.
pub(crate) struct Place;

impl Format for Place {
    type Value = Along;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Along> {
        let DeValue::String(text) = node.value else {
            return match node.value {
                DeValue::Integer(_) | DeValue::Float(_) => {
                    Quantity::<Ratio>::read(node, reader).map(Along::Fraction)
                }
                _ => {
                    reader.wrong(node, node.found(), Self::expected());
                    None
                }
            };
        };
        let known = WORDS.iter().find(|w| w.0 == text.trim());
        let along = match known {
            Some(word) => Ok(Along::Fraction(word.1)),
            None => distance(text, ""),
        };
        let begins = |c: char| c.is_alphabetic();
        along
            .map_err(|(found, expected)| match text.trim().starts_with(begins) {
                true => {
                    let expected = suggested(text.trim());
                    reader.wrong_as(FaultCode::UnknownName, node, node.found(), expected)
                }
                false => reader.wrong(node, found, expected),
            })
            .ok()
    }

    fn placeholder() -> Along {
        Along::Fraction(0.5)
    }

    fn expected() -> String {
        "a place along the beam: \"start\", \"mid\", \"end\", 0.25 or \"0.75 m\"".into()
    }

    fn schema() -> Json {
        json!({ "type": ["number", "string"] })
    }

    fn number(value: &Along) -> Option<(f64, &'static str)> {
        Some(match *value {
            Along::Fraction(f) => (f, Ratio::UNIT),
            Along::Distance(s) => (s, Length::UNIT),
        })
    }

    /// A fraction stays a fraction, a length a length.
    fn set_number(value: &mut Along, number: f64) -> Result<(), String> {
        match value {
            Along::Fraction(f) => *f = number,
            Along::Distance(s) => *s = number,
        }
        Ok(())
    }
}

fn suggested(word: &str) -> String {
    let near = suggest::nearest(word, WORDS.iter().map(|w| w.0));
    let near = near.map(|n| format!(" (did you mean `{n}`?)")).unwrap_or_default();
    Place::expected() + &near
}

impl Inline for Place {
    fn text(value: &Along) -> Option<String> {
        Some(match value {
            Along::Fraction(f) => write::number(*f),
            Along::Distance(s) => write::text(&format!("{} m", write::number(*s))),
        })
    }
}

/// A point on a beam, at which a joint connects it.
pub(crate) struct JointEnd;

impl JointEnd {
    /// The projectile that a text names in the place of a point, if it does.
    fn projectile<'t>(text: &'t str, reader: &Reader<'_>) -> Option<&'t str> {
        let name = text.split(['@', '.']).next()?.trim();
        (reader.knows("projectile", name) && !reader.knows("beam", name)).then_some(name)
    }
}

impl Format for JointEnd {
    type Value = Point;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Point> {
        let text = node.value.as_str().unwrap_or_default();
        let Some(name) = Self::projectile(text, reader) else {
            return PointText::read(node, reader);
        };
        let found = format!("{text:?}, the projectile {name:?}");
        let expected = format!(
            "a point on a beam; a projectile is connected by a stiff spring, \
             `[spring.NAME] between = [..., {name:?}]`, and a mass on a hinge at a point is \
             a `[mass.NAME]`"
        );
        reader.wrong_as(FaultCode::UnknownName, node, found, expected);
        None
    }

    fn placeholder() -> Point {
        PointText::placeholder()
    }

    fn expected() -> String {
        PointText::expected()
    }

    fn schema() -> Json {
        PointText::schema()
    }

    fn number(value: &Point) -> Option<(f64, &'static str)> {
        PointText::number(value)
    }

    fn set_number(value: &mut Point, number: f64) -> Result<(), String> {
        PointText::set_number(value, number)
    }

    fn read_over(old: &Point, node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Point> {
        PointText::read_over(old, node, reader)
    }
}

impl Inline for JointEnd {
    fn text(value: &Point) -> Option<String> {
        PointText::text(value)
    }
}

/// An end of a spring.
#[derive(Clone, Debug, PartialEq)]
pub enum Anchor {
    /// A point of a beam.
    Point(Point),
    /// The centre of a projectile, by its name.
    Projectile(String),
    /// A point fixed in space (m), shape (2) \[m\].
    Ground([f64; 2]),
}

/// A point on a beam or the name of a projectile as a text, or a position in space as a list.
pub(crate) struct AnchorText;

impl Format for AnchorText {
    type Value = Anchor;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Anchor> {
        match node.value {
            DeValue::String(text) if reader.knows("projectile", text) => {
                Some(Anchor::Projectile(text.to_string()))
            }
            DeValue::String(text) if !text.contains(['@', '.']) => {
                let near = suggest::nearest(text, reader.names("projectile").iter().copied());
                let near = near.map(|n| format!(" (did you mean `{n}`?)")).unwrap_or_default();
                reader.wrong(node, node.found(), Self::expected() + &near);
                None
            }
            DeValue::String(text) => {
                let name = text.split(['@', '.']).next().unwrap_or_default().trim();
                if reader.knows("projectile", name) && !reader.knows("beam", name) {
                    let found = format!("{text:?}, a place on the projectile {name:?}");
                    let expected = format!("its name alone, {name:?}, for its centre");
                    reader.wrong_as(FaultCode::UnknownName, node, found, expected);
                    return None;
                }
                PointText::read(node, reader).map(Anchor::Point)
            }
            DeValue::Array(_) => Vector::<Length>::read(node, reader).map(Anchor::Ground),
            _ => {
                reader.wrong(node, node.found(), Self::expected());
                None
            }
        }
    }

    fn placeholder() -> Anchor {
        Anchor::Point(PointText::placeholder())
    }

    fn expected() -> String {
        format!(
            "{}; the name of a projectile; or a place on the ground, such as [0, \"2 m\"]",
            PointText::expected()
        )
    }

    fn schema() -> Json {
        json!({ "anyOf": [PointText::schema(), { "type": "string" }, Vector::<Length>::schema()] })
    }

    fn reach<'c>(value: &'c mut Anchor, path: &[String]) -> Reached<'c> {
        match value {
            Anchor::Point(point) => PointText::reach(point, path),
            Anchor::Projectile(_) => Err(Lost::Reread),
            Anchor::Ground(place) => Vector::<Length>::reach(place, path),
        }
    }
}

impl Inline for AnchorText {
    fn text(value: &Anchor) -> Option<String> {
        match value {
            Anchor::Point(point) => PointText::text(point),
            Anchor::Projectile(name) => Some(write::text(name)),
            Anchor::Ground(place) => Vector::<Length>::text(place),
        }
    }
}
