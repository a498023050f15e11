//! Initial motion: of the whole structure, or of single parts.

use serde_json::Value as Json;

use crate::code::FaultCode;
use crate::format::{Format, Written};
use crate::layout::Described;
use crate::measure;
use crate::node::{Body, Node, Reader};
use crate::quantity::{Quantity, Vector};
use crate::reach::{Lost, Reached};
use crate::schema;
use crate::source::join;
use crate::suggest;
use crate::table::{Collection, Declared, Named, Part, Single};
use crate::write::Writer;

table! {
    /// Initial rigid motion of beams and point masses.
    pub struct InitialMotion {
        /// Velocity of the point `about` (m/s).
        velocity: [f64; 2] as Vector<measure::Velocity> = [0.0, 0.0],
        /// Angular velocity, positive counter-clockwise (rad/s).
        spin: f64 as Quantity<measure::Spin> = 0.0,
        /// Centre of the rotation (m).
        about: [f64; 2] as Vector<measure::Length> = [0.0, 0.0],
    }
}

impl Default for InitialMotion {
    fn default() -> Self {
        Self { velocity: [0.0; 2], spin: 0.0, about: [0.0; 2] }
    }
}

/// `[initial]`, and `[initial.NAME]` for beams and point masses that start in a motion of their own instead.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Initial {
    /// The motion of all that has none of its own.
    pub all: InitialMotion,
    /// Motions of beams and point masses, by their names, shape (motions).
    pub of: Vec<Named<InitialMotion>>,
}

/// The form of [`Initial`]: a table that stands once, with tables by name within it.
pub(crate) struct Starts;

/// Whether a key is one of the motion itself, not a name.
fn is_own(key: &str) -> bool {
    InitialMotion::declared().keys.iter().any(|own| own.name == key)
}

/// Tells of a name that is no beam and no point mass.
fn check_name(name: &str, node: &Node<'_>, reader: &mut Reader<'_>) {
    if reader.knows("beam", name) || reader.knows("mass", name) {
        return;
    }
    let (found, expected) = if reader.knows("projectile", name) {
        let found = format!("the projectile `{name}`");
        (found, format!("its `velocity` and `spin` in [projectile.{name}]"))
    } else {
        let names = [reader.names("beam"), reader.names("mass")].concat();
        let found = format!("`{name}`, which is no beam and no point mass");
        (found, suggest::one_of(name, names.iter().copied()))
    };
    reader.misplaced_as(FaultCode::UnknownName, &node.path, node.span.clone(), (found, expected));
}

impl Format for Starts {
    type Value = Initial;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Initial> {
        let all = Single::<InitialMotion>::read;
        let Some(body) = Body::of(node) else { return all(node, reader).map(Initial::of_all) };
        let mut of = Vec::new();
        let named = |key: &str| !is_own(key) && body.get(key).is_some_and(|n| n.value.is_table());
        let names: Vec<&str> = body.keys().into_iter().map(|k| k.0).filter(|k| named(k)).collect();
        let before = reader.faults.len();
        InitialMotion::declared().check_keys(&body, reader);
        // To the motion itself the names are unknown keys.
        let later = reader.faults.split_off(before);
        let is_name = |path: &str| names.iter().any(|name| join(&body.path, name) == path);
        reader.faults.extend(later.into_iter().filter(|fault| !is_name(&fault.path)));
        for name in &names {
            let Some(node) = body.get(name) else { continue };
            check_name(name, &node, reader);
            match Single::<InitialMotion>::read(&node, reader) {
                Some(table) => of.push(Named { name: (*name).to_string(), table }),
                None => _ = reader.tainted.insert(node.path),
            }
        }
        Some(Initial { all: InitialMotion::read(&body, reader)?, of })
    }

    fn placeholder() -> Initial {
        Initial::default()
    }

    fn expected() -> String {
        Single::<InitialMotion>::expected()
    }

    fn schema() -> Json {
        let mut schema = schema::of_table(InitialMotion::layout());
        schema["additionalProperties"] = schema::of_table(InitialMotion::layout());
        schema
    }

    fn described() -> Described {
        Single::<InitialMotion>::described()
    }

    fn reach<'c>(value: &'c mut Initial, path: &[String]) -> Reached<'c> {
        match path {
            [] => Err(Lost::Table),
            [key, ..] if is_own(key) || value.of.is_empty() => value.all.reach(path),
            _ => Collection::<InitialMotion>::reach(&mut value.of, path),
        }
    }
}

impl Written for Starts {
    fn write(value: &Initial, key: &str, out: &mut Writer) {
        Single::<InitialMotion>::write(&value.all, key, out);
        Collection::<InitialMotion>::write(&value.of, key, out);
    }

    fn default_text(_: &Initial) -> Option<String> {
        None
    }
}

impl Initial {
    fn of_all(all: InitialMotion) -> Self {
        Self { all, of: Vec::new() }
    }
}
