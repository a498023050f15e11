//! The shear force is the derivative of the bending moment along the beam, sagging moments positive.

use crate::common;

use common::rows::Rows;
use common::*;
use percuss::*;

/// Recorded places, shares of the length; mid-span, where the load acts, is none of them.
const PLACES: [f64; 4] = [0.1, 0.3, 0.65, 0.9];
/// From a place to its neighbours, as a share of the length.
const APART: f64 = 1e-3;
const LOAD: f64 = 100.0;

/// A steel strip on a pin and a roller, 1 m from support to support, with a load downwards at mid-span that swells at 30 Hz from its value
/// at rest; straight, or an arc.
fn loaded_strip(arc: bool) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2e11, 7850.0));
    let section = b.section(Section::rectangle("strip", 0.05, 0.01));
    let middle = if arc { [0.5, 0.2] } else { [0.5, 0.0] };
    let mut strip = Beam::new("strip", &[[0.0; 2], middle, [1.0, 0.0]], 8, material, section);
    strip.curve = if arc { Curve::Arc } else { Curve::Polyline };
    let strip = b.beam(strip);
    let kinds = [SupportKind::Pin, SupportKind::Roller { direction: [1.0, 0.0] }];
    for (k, kind) in kinds.into_iter().enumerate() {
        b.support(Support::new(["left", "right"][k], at("end", strip, k as f64), kind));
    }
    let crown = at("crown", strip, 0.5);
    let kind = LoadKind::Point { at: crown, force: [0.0, -LOAD], moment: 0.0, follower: false };
    b.load(Load::new("rest", kind.clone()));
    let function = TimeFunction::Harmonic { frequency: 30.0, phase: 0.0 };
    b.load(Load { function, ..Load::new("swell", kind) });
    for (k, place) in PLACES.into_iter().enumerate() {
        for (side, away) in [("before", -APART), ("here", 0.0), ("after", APART)] {
            b.record_point(at(&format!("{k} {side}"), strip, place + away));
        }
    }
    b.build().unwrap()
}

/// Rows of a run that starts in equilibrium: the first is that of statics, the others are those of the motion.
fn rows_of(model: &Model) -> (Rows, RunSummary) {
    Rows::of(model, &Settings { start: Start::Static, ..Settings::new(0.02, 2e-4) })
}

#[test]
fn a_simply_supported_beam_has_half_the_load_as_its_shear_force_positive_on_the_left() {
    let (rows, _) = rows_of(&loaded_strip(false));
    for (k, place) in PLACES.into_iter().enumerate() {
        let of = |part: &str| rows.column(&format!("section.{k} here.{part}"))[0];
        let (shear, moment) = if place < 0.5 {
            (0.5 * LOAD, 0.5 * LOAD * place)
        } else {
            (-0.5 * LOAD, 0.5 * LOAD * (1.0 - place))
        };
        // The deflection of 2.5 mm tilts the section by 0.0075 at most.
        assert!((of("shear") - shear).abs() < 1e-4 * LOAD, "{place}: {} {shear}", of("shear"));
        assert!((of("moment") - moment).abs() < 1e-4 * LOAD, "{place}: {} {moment}", of("moment"));
        assert!(of("axial").abs() < 1e-2 * LOAD, "{place}: {}", of("axial"));
    }
}

#[test]
fn the_shear_force_is_the_slope_of_the_bending_moment_at_rest_and_in_motion() {
    for arc in [false, true] {
        let (rows, run) = rows_of(&loaded_strip(arc));
        let length = *run.section_forces[0].envelope.s.last().unwrap();
        let peak = run.section_forces[0].shear.largest().value.abs();
        assert!(peak > 0.4 * LOAD && rows.rows.len() > 50, "{peak}");
        for (k, place) in PLACES.into_iter().enumerate() {
            let [before, after] =
                ["before", "after"].map(|side| rows.column(&format!("section.{k} {side}.moment")));
            let shear = rows.column(&format!("section.{k} here.shear"));
            for (row, shear) in shear.into_iter().enumerate() {
                let slope = (after[row] - before[row]) / (2.0 * APART * length);
                // The rotary inertia of a strip as thin as this is what else changes the moment, up to a thousandth of V.
                assert!(
                    (shear - slope).abs() < 5e-3 * peak,
                    "arc {arc} {place}, row {row}: V = {shear}, dM/ds = {slope}"
                );
            }
        }
    }
}
