//! Rotations of recorded points, and the largest displacement at rest, against closed forms.

use std::f64::consts::TAU;

use crate::common;

use common::rows::Rows;
use common::*;
use percuss::*;

/// A strip 1 m long with EI = 1 N m^2, clamped at its start, of so many elements; its end is recorded.
fn clamped_strip(elements: usize) -> (ModelBuilder, BeamId) {
    let mut b = ModelBuilder::new();
    let strain = StrainMeasure::Engineering;
    let material = b.material(Material { strain, ..Material::new("m", 1e9, 1e3) });
    let section = b.section(Section::new("strip", 1e-6, 1e-9));
    let strip = b.beam(beam("strip", [0.0; 2], [1.0, 0.0], elements, material, section));
    b.support(Support::new("root", at("root", strip, 0.0), SupportKind::Clamp));
    b.record_point(at("end", strip, 1.0));
    b.record_point(at("inside", strip, 0.55));
    (b, strip)
}

#[test]
fn a_strip_rolled_up_by_a_moment_has_turned_by_m_l_over_ei_beyond_a_whole_turn() {
    for moment in [1.0, 1.25 * TAU] {
        let (mut b, strip) = clamped_strip(64);
        let end = at("end", strip, 1.0);
        let kind = LoadKind::Point { at: end, force: [0.0; 2], moment, follower: false };
        b.load(Load::new("m", kind));
        let found = equilibrium(&b.build().unwrap()).unwrap();
        let [end, inside] = found.rotations[..] else { panic!("{:?}", found.rotations) };
        assert!((end / moment - 1.0).abs() < 1e-3, "{end} {moment}");
        assert!((inside / (0.55 * moment) - 1.0).abs() < 1e-3, "{inside} {moment}");
    }
}

#[test]
fn a_stick_that_spins_turns_on_beyond_whole_turns_from_row_to_row() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 1e11, 1e3));
    let section = b.section(Section::rectangle("s", 0.02, 0.02));
    let stick = b.beam(beam("stick", [-0.5, 0.0], [0.5, 0.0], 4, material, section));
    b.record_point(at("tip", stick, 1.0));
    let spin = -20.0;
    b.initial_motion(InitialMotion { spin, ..InitialMotion::default() });
    let (rows, _) = Rows::of(&b.build().unwrap(), &Settings::new(1.0, 5e-4));
    let time = rows.column("time");
    for (t, angle) in time.into_iter().zip(rows.column("point.tip.rotation")) {
        // Three turns in a second; the midpoint rule turns by 2 atan(spin h / 2) a step, 8e-6 too little.
        assert!((angle - spin * t).abs() < 5e-4, "{t}: {angle}");
    }
}

#[test]
fn the_largest_displacement_at_rest_is_found_between_nodes_and_recorded_points() {
    // A cantilever propped at its end under an end moment M: u = M (x^3 - x^2) / (4 EI), largest at x = 2 / 3.
    for elements in [1, 2, 3] {
        let (mut b, strip) = clamped_strip(elements);
        let end = at("end", strip, 1.0);
        b.support(Support::new("prop", end.clone(), SupportKind::Roller { direction: [1.0, 0.0] }));
        let moment = 1e-3;
        let kind = LoadKind::Point { at: end, force: [0.0; 2], moment, follower: false };
        b.load(Load::new("m", kind));
        let found = equilibrium(&b.build().unwrap()).unwrap();
        let most = found.largest_displacement.clone().unwrap();
        let exact = -moment / 27.0;
        assert!((most.displacement[1] / exact - 1.0).abs() < 1e-4, "{elements}: {most:?}");
        assert!((most.s - 2.0 / 3.0).abs() < 1e-3 && most.beam == "strip", "{elements}: {most:?}");
        assert!((found.rotations[0] - moment / 4.0).abs() < 1e-4 * moment, "{:?}", found.rotations);
    }
}
