//! What can touch, by name: beams, obstacles and projectiles share one namespace.

use serde_json::{Value as Json, json};

use crate::code::FaultCode;
use crate::format::{Format, Inline, Text};
use crate::name::{BeamName, Kind};
use crate::node::{Node, Reader};
use crate::point::{Point, PointText};
use crate::suggest;
use crate::write;

/// What something that can touch is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartnerKind {
    /// A beam.
    Beam,
    /// An obstacle.
    Obstacle,
    /// A projectile.
    Projectile,
}

impl PartnerKind {
    const ALL: [Self; 3] = [Self::Beam, Self::Obstacle, Self::Projectile];

    /// Its name in the file.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Beam => BeamName::NAME,
            Self::Obstacle => "obstacle",
            Self::Projectile => "projectile",
        }
    }
}

/// Something that can touch.
#[derive(Clone, Debug, PartialEq)]
pub struct Partner {
    /// What it is.
    pub kind: PartnerKind,
    /// The user's name for it.
    pub name: String,
}

/// The name of something that can touch.
pub(crate) struct PartnerName;

impl Format for PartnerName {
    type Value = Partner;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Partner> {
        let name = Text::read(node, reader)?;
        let has = |kind: &PartnerKind| reader.knows(kind.name(), &name);
        let kinds: Vec<PartnerKind> = PartnerKind::ALL.into_iter().filter(has).collect();
        match kinds[..] {
            [kind] => return Some(Partner { kind, name }),
            [] => {
                let all = PartnerKind::ALL.iter().flat_map(|kind| reader.names(kind.name()));
                let all: Vec<&str> = all.copied().collect();
                let found = format!("the unknown beam, obstacle or projectile {name:?}");
                let expected = suggest::one_of(&name, all.into_iter());
                let span = node.span.clone();
                reader.misplaced_as(FaultCode::UnknownName, &node.path, span, (found, expected));
            }
            _ => {
                let header = |kind: &PartnerKind| format!("[{}.{name}]", kind.name());
                let headers: Vec<String> = kinds.iter().map(header).collect();
                let found = format!("{name:?}, the name of {}", headers.join(" and "));
                let expected = "a name that no two of them share";
                reader.misplaced(&node.path, node.span.clone(), found, expected);
            }
        }
        None
    }

    fn placeholder() -> Partner {
        Partner { kind: PartnerKind::Beam, name: String::new() }
    }

    fn expected() -> String {
        "the name of a beam, an obstacle or a projectile".into()
    }

    fn schema() -> Json {
        json!({ "type": "string" })
    }
}

impl Inline for PartnerName {
    fn text(value: &Partner) -> Option<String> {
        Some(write::text(&value.name))
    }
}

/// What a free projectile strikes.
#[derive(Clone, Debug, PartialEq)]
pub struct Strikes {
    /// The point it flies at; its beam is struck.
    pub point: Option<Point>,
    /// What is struck besides, shape (partners).
    pub partners: Vec<Partner>,
}

/// A point, a name, or a list of names that may begin with a point.
pub(crate) struct StrikesText;

impl StrikesText {
    fn is_point(node: &Node<'_>) -> bool {
        node.value.as_str().is_some_and(|text| text.contains(['.', '@']))
    }
}

impl Format for StrikesText {
    type Value = Strikes;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Strikes> {
        let nodes = match node.elements() {
            Some(elements) if elements.is_empty() => {
                reader.wrong(node, "an empty list", Self::expected());
                return None;
            }
            Some(elements) => elements,
            None if node.value.as_str().is_some() => vec![node.clone()],
            None => {
                reader.wrong(node, node.found(), Self::expected());
                return None;
            }
        };
        let (point, names) = match nodes.split_first() {
            Some((first, rest)) if Self::is_point(first) => (Some(first), rest),
            _ => (None, &nodes[..]),
        };
        // Every entry is read before the first one at fault ends it.
        let point = point.map(|node| PointText::read(node, reader));
        let mut partners = Vec::new();
        for node in names {
            if Self::is_point(node) {
                reader.wrong(node, node.found(), "the point first, names after it");
                partners.push(None);
            } else {
                partners.push(PartnerName::read(node, reader));
            }
        }
        let point = match point {
            Some(point) => Some(point?),
            None => None,
        };
        let partners = partners.into_iter().collect::<Option<Vec<Partner>>>()?;
        Some(Strikes { point, partners })
    }

    fn placeholder() -> Strikes {
        Strikes { point: Some(PointText::placeholder()), partners: Vec::new() }
    }

    fn expected() -> String {
        "a point on a beam, a name, or a list of names of beams, obstacles and projectiles that \
         may begin with a point"
            .into()
    }

    fn schema() -> Json {
        let list = json!({ "type": "array", "items": PartnerName::schema(), "minItems": 1 });
        json!({ "anyOf": [{ "type": "string" }, list] })
    }
}

impl Inline for StrikesText {
    fn text(value: &Strikes) -> Option<String> {
        let point = value.point.iter().filter_map(PointText::text);
        let names = value.partners.iter().filter_map(PartnerName::text);
        let all: Vec<String> = point.chain(names).collect();
        Some(if all.len() == 1 { all[0].clone() } else { format!("[{}]", all.join(", ")) })
    }
}
