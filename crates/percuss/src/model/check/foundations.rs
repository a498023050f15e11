//! Faults of foundations.

use super::super::builder::ModelBuilder;
use super::super::definition::*;
use super::beams::check_stretch;
use super::faults::Faults;
use super::supports::check_force_table;
use super::yielding::check_yielding_foundation;
use crate::math::vec2::norm;

pub(super) fn check_foundation(model: &ModelBuilder, foundation: &Foundation, out: &mut Faults) {
    let path = |field: &str| format!("foundation.{}.{field}", foundation.name);
    match model.beams.get(foundation.beam.0 as usize) {
        None => out.add(path("on"), "an unknown beam", "a beam of this model"),
        Some(beam) => check_stretch(beam, foundation.stretch, &path, out),
    }
    if let Some(direction) = foundation.direction {
        if direction.iter().any(|c| !c.is_finite()) {
            out.finite(path("direction"), &direction, "");
        } else if norm(direction) == 0.0 {
            let expected = "the direction in which it pushes the beam";
            out.add(path("direction"), "a direction of zero length", expected);
        }
    }
    out.not_negative(path("damping"), foundation.damping, "damping", "N*s/m^2");
    match &foundation.law {
        FoundationLaw::Linear { stiffness } => {
            out.not_negative(path("stiffness"), *stiffness, "a stiffness per length", "N/m^2");
            if *stiffness == 0.0 && foundation.damping == 0.0 && foundation.yielding.is_none() {
                let expected = "a stiffness or a damping above zero";
                out.add(path("stiffness"), "a foundation without stiffness and damping", expected);
            }
        }
        FoundationLaw::Compression { stiffness, gap } => {
            out.positive(path("stiffness"), *stiffness, "a stiffness per length", "N/m^2");
            out.not_negative(path("gap"), *gap, "a gap", "m");
        }
        FoundationLaw::Table { deflection, reaction } => {
            let words = [
                ["deflections", "deflections", "m"],
                ["reactions", "reactions", "N/m"],
                ["a reaction", "deflection", "no reaction without deflection"],
            ];
            check_force_table(&path, words, [deflection, reaction], out);
        }
    }
    check_yielding_foundation(foundation, out);
}
