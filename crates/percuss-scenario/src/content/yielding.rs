//! How a material yields.
#![allow(non_snake_case, reason = "Cowper and Symonds' C is called so")]

use super::Material;
use crate::format::{Couple, List, Maybe};
use crate::measure;
use crate::node::{Body, Reader};
use crate::quantity::Quantity;
use crate::table::exclude;
use crate::write::Writer;

table! {
    /// How the yield stress of a material grows with plastic strain.
    pub struct Hardening {
        /// Isotropic plastic modulus, d(stress)/d(plastic strain) (Pa); none without, or `table` in its place.
        isotropic: Option<f64> as Maybe<Quantity<measure::Pressure>> = None,
        /// Kinematic plastic modulus: the range between both yield stresses moves (Pa).
        kinematic: f64 as Quantity<measure::Pressure> = 0.0,
        /// Instead of `isotropic`: [plastic strain, stress (Pa)], from [0, yield stress] on; constant beyond the last.
        table: Option<Vec<[f64; 2]>> as Maybe<List<Couple<Quantity<measure::Ratio>, Quantity<measure::Pressure>>>> = None,
    }
    then settle_hardening
}

fn settle_hardening(_: &mut Hardening, body: &Body<'_>, reader: &mut Reader<'_>) {
    exclude(body, ["isotropic", "table"], reader);
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
pub(super) fn settle_yield(material: &mut Material, body: &Body<'_>, reader: &mut Reader<'_>) {
    if body.get("yield").is_none() && !reader.excuses(body, "yield") {
        let with = ["hardening", "rate", "failure_strain"];
        if let Some(key) = with.into_iter().find(|key| body.get(key).is_some()) {
            let found = format!("`{key}` without a yield stress");
            let expected = "`yield`, such as \"275 MPa\", beside it";
            reader.missing(body, "yield", found, expected);
        }
    } else if material.bears.is_some() {
        let found = "a material that yields and bears stress of one sign only";
        let expected = "one of `yield` and `bears`";
        reader.misplaced(&body.path, body.span.clone(), found, expected);
    }
}
