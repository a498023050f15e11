//! A straight beam whose numbers are few enough for closed forms.

use super::at;
use percuss::*;

pub const YOUNG: f64 = 2e9;
pub const AREA: f64 = 0.01;
pub const INERTIA: f64 = 1e-5;
pub const DENSITY: f64 = 3e3;
pub const BENDING: f64 = YOUNG * INERTIA;

/// One straight beam of length 2 from the origin along e1; `more` adds to it.
pub fn beam(elements: usize, more: impl Fn(&mut ModelBuilder, BeamId)) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", YOUNG, DENSITY));
    let section = b.section(Section::new("s", AREA, INERTIA));
    let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [2.0, 0.0]], elements, material, section));
    more(&mut b, beam);
    b.record_point(at("tip", beam, 1.0));
    b.build().unwrap()
}

/// Clamps a beam at its start.
pub fn clamp(b: &mut ModelBuilder, beam: BeamId) {
    b.support(Support::new("root", at("root", beam, 0.0), SupportKind::Clamp));
}

/// A dead force and moment at a fraction of a beam.
pub fn force(b: &mut ModelBuilder, beam: BeamId, fraction: f64, force: [f64; 2], moment: f64) {
    let at = at("load", beam, fraction);
    let kind = LoadKind::Point { at, force, moment, follower: false };
    b.load(Load::new(format!("load at {fraction}"), kind));
}

/// Asserts a relative deviation below `tolerance`.
pub fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "{found} instead of {expected}");
}
