//! How a material yields.
#![allow(non_snake_case, reason = "Cowper and Symonds' C is called so")]

use serde_json::{Value as Json, json};

use crate::format::{Couple, Format, Inline, List, Maybe};
use crate::layout::Described;
use crate::measure;
use crate::node::{Body, Node, Reader};
use crate::quantity::Quantity;
use crate::reach::Reached;
use crate::table::{Braces, exclude};
use crate::words::{Endless, OfPreset, Word, Words};
use crate::write::Writer;

table! {
    /// How the yield stress of a material grows with plastic strain.
    pub struct Hardening {
        /// Isotropic plastic modulus, d(stress)/d(plastic strain) (Pa); none without, or `table` in its place.
        isotropic: Option<f64> as Maybe<Quantity<measure::Pressure>> = None,
        /// Kinematic plastic modulus: the range between both yield stresses moves (Pa).
        kinematic: f64 as Quantity<measure::Pressure> = 0.0,
        /// Instead of `isotropic`: [plastic strain, stress (Pa)] of a tension test, from [0, yield stress] on; the nominal stress is constant
        /// beyond the last. It is converted to the measure of `strain`, in which a bar pulled gives it back.
        table: Option<Vec<[f64; 2]>> as Maybe<List<Couple<Quantity<measure::Ratio>, Quantity<measure::Pressure>>>> = None,
        /// Stresses and strains of `table`.
        stress: TableStress as Word<TableStresses> = TableStress::Nominal,
    }
    then settle_hardening
}

/// Which stress and strain a table tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableStress {
    /// Force over the area of the free bar, elongation over its length.
    Nominal,
    /// Force over the area that is left, logarithm of the stretch.
    True,
}

fn settle_hardening(hardening: &mut Hardening, body: &Body<'_>, reader: &mut Reader<'_>) {
    exclude(body, ["isotropic", "table"], reader);
    // The default may be written out.
    let converted = hardening.stress == TableStress::True;
    if converted && body.get("table").is_none() && !reader.excuses(body, "table") {
        let found = "`stress` without a table";
        reader.missing(body, "table", found, "`table` with these stresses");
    }
}

table! {
    /// How the yield force of a spring grows with plastic extension.
    pub struct SpringHardening {
        /// Isotropic plastic stiffness, d(force)/d(plastic extension) (N/m); none without, or `table` in its place.
        isotropic: Option<f64> as Maybe<Quantity<measure::Stiffness>> = None,
        /// Kinematic plastic stiffness: the range between both yield forces moves (N/m).
        kinematic: f64 as Quantity<measure::Stiffness> = 0.0,
        /// Instead of `isotropic`: [plastic extension (m), force (N)], from [0, yield force] on; constant beyond the last.
        table: Option<Vec<[f64; 2]>> as Maybe<List<Couple<Quantity<measure::Length>, Quantity<measure::Force>>>> = None,
    }
    then settle_spring_hardening
}

fn settle_spring_hardening(_: &mut SpringHardening, body: &Body<'_>, reader: &mut Reader<'_>) {
    exclude(body, ["isotropic", "table"], reader);
}

table! {
    /// How the yield moment of a hinge grows with plastic rotation.
    pub struct HingeHardening {
        /// Isotropic plastic stiffness, d(moment)/d(plastic rotation) (N m); none without, or `table` in its place.
        isotropic: Option<f64> as Maybe<Quantity<measure::TurnStiffness>> = None,
        /// Kinematic plastic stiffness: the range between both yield moments moves (N m).
        kinematic: f64 as Quantity<measure::TurnStiffness> = 0.0,
        /// Instead of `isotropic`: [plastic rotation (rad), moment (N m)], from [0, yield moment] on; constant beyond the last.
        table: Option<Vec<[f64; 2]>> as Maybe<List<Couple<Quantity<measure::Angle>, Quantity<measure::Moment>>>> = None,
    }
    then settle_hinge_hardening
}

fn settle_hinge_hardening(_: &mut HingeHardening, body: &Body<'_>, reader: &mut Reader<'_>) {
    exclude(body, ["isotropic", "table"], reader);
}

table! {
    /// Overstress after Cowper and Symonds: plastic strain grows at the rate C (|stress| / yield stress - 1)^q.
    pub struct RateLaw {
        /// C (1/s): 40.4 for mild steel, 6500 for aluminium 6061-T6.
        C: f64 as Quantity<measure::Rate>,
        /// q: 5 for mild steel, 4 for aluminium 6061-T6.
        q: f64 as Quantity<measure::Ratio>,
    }
}

/// A rate law in braces, or `"preset"`: that of the material known by name, without end till then.
pub(crate) struct RateText;

impl Format for RateText {
    type Value = RateLaw;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<RateLaw> {
        match node.value.as_str() {
            Some(word) if word == OfPreset::WORD => {
                Some(RateLaw { C: f64::INFINITY, q: f64::INFINITY })
            }
            _ => Braces::<RateLaw>::read(node, reader),
        }
    }

    fn placeholder() -> RateLaw {
        Braces::<RateLaw>::placeholder()
    }

    fn expected() -> String {
        format!("\"{}\" or {}", OfPreset::WORD, Braces::<RateLaw>::expected())
    }

    fn schema() -> Json {
        json!({ "anyOf": [{ "const": OfPreset::WORD }, Braces::<RateLaw>::schema()] })
    }

    fn described() -> Described {
        Described { expected: Self::expected(), ..Braces::<RateLaw>::described() }
    }

    fn reach<'c>(value: &'c mut RateLaw, path: &[String]) -> Reached<'c> {
        Braces::<RateLaw>::reach(value, path)
    }
}

impl Inline for RateText {
    fn text(value: &RateLaw) -> Option<String> {
        Braces::<RateLaw>::text(value)
    }
}

/// What goes with a yield force or moment, `keys[0]`, goes nowhere without one.
pub(super) fn settle_connector_yield(keys: [&str; 3], body: &Body<'_>, reader: &mut Reader<'_>) {
    let [limit, with @ ..] = keys;
    if body.get(limit).is_none()
        && !reader.excuses(body, limit)
        && let Some(key) = with.into_iter().find(|key| body.get(key).is_some())
    {
        let words = limit.replace('_', " ");
        let found = format!("`{key}` without a {words}");
        reader.missing(body, limit, found, format!("`{limit}` beside it"));
    }
}

/// What goes with a yield stress goes nowhere without one.
pub(super) fn settle_yield(body: &Body<'_>, reader: &mut Reader<'_>) {
    if body.get("yield").is_none() && !reader.excuses(body, "yield") {
        let with = ["hardening", "rate", "failure_strain"];
        if let Some(key) = with.into_iter().find(|key| body.get(key).is_some()) {
            let found = format!("`{key}` without a yield stress");
            let expected = "`yield`, such as \"275 MPa\", beside it";
            reader.missing(body, "yield", found, expected);
        }
    }
}

/// Which stress and strain a table of a material tells.
pub(crate) struct TableStresses;

impl Words for TableStresses {
    type Value = TableStress;
    const WORDS: &'static [(&'static str, TableStress, &'static str)] = &[
        (
            "nominal",
            TableStress::Nominal,
            "force over the area of the free bar, elongation over its length",
        ),
        (
            "true",
            TableStress::True,
            "force over the area that is left, logarithm of the stretch; plastic flow keeps the volume",
        ),
    ];
}
