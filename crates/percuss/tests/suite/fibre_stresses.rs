//! Stresses at the top and at the bottom fibre of recorded points against closed forms.

use crate::common;

use common::rows::Rows;
use common::*;
use percuss::*;

/// Side of the square section \[m\].
const SIDE: f64 = 0.1;
const AREA: f64 = SIDE * SIDE;
/// Section modulus \[m^3\].
const MODULUS: f64 = SIDE * SIDE * SIDE / 6.0;

/// A straight beam so stiff that its deflections do not count; `more` adds to it.
fn stiff(ends: [[f64; 2]; 2], more: impl Fn(&mut ModelBuilder, BeamId)) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 1e15, 1e3));
    let section = b.section(Section::rectangle("square", SIDE, SIDE));
    let bar = b.beam(beam("bar", ends[0], ends[1], 4, material, section));
    more(&mut b, bar);
    b.record_point(at("mid", bar, 0.5));
    b.build().unwrap()
}

fn hold(b: &mut ModelBuilder, bar: BeamId, fraction: f64, kind: SupportKind) {
    let name = format!("end{fraction}");
    b.support(Support::new(name.clone(), at(&name, bar, fraction), kind));
}

fn push(b: &mut ModelBuilder, bar: BeamId, fraction: f64, force: [f64; 2], moment: f64) {
    let kind = LoadKind::Point { at: at("load", bar, fraction), force, moment, follower: false };
    b.load(Load::new(format!("load at {fraction}"), kind));
}

/// Stress of largest magnitude, at the top and at the bottom of the middle in the equilibrium that a run starts from.
fn at_rest(model: &Model) -> [f64; 3] {
    let settings = Settings { start: Start::Static, ..Settings::new(1e-6, 1e-6) };
    let mut rows = Rows::default();
    simulate(model, &settings, &mut rows).unwrap();
    let first = stresses(&rows).map(|column| column[0]);
    let PointStress { largest, top, bottom } = equilibrium(model).unwrap().point_forces[0].stress;
    for (first, found) in first.iter().zip([largest, top, bottom]) {
        let size = first.abs().max(largest.abs());
        assert!((first - found).abs() < 1e-6 * size, "{first} in motion, {found} in statics");
    }
    first
}

fn stresses(rows: &Rows) -> [Vec<f64>; 3] {
    ["stress", "stress_top", "stress_bottom"].map(|q| rows.column(&format!("section.mid.{q}")))
}

fn assert_near(found: [f64; 3], exact: [f64; 3], tolerance: f64) {
    for (found, exact) in found.iter().zip(exact) {
        assert!((found / exact - 1.0).abs() < tolerance, "{found} in place of {exact}");
    }
}

/// A beam on two supports under 1000 N downwards at its middle and a pull of 10 kN.
fn sagging(start: f64, end: f64) -> Model {
    stiff([[start, 0.0], [end, 0.0]], |b, bar| {
        let [left, right] = if start < end { [0.0, 1.0] } else { [1.0, 0.0] };
        hold(b, bar, left, SupportKind::Pin);
        hold(b, bar, right, SupportKind::Roller { direction: [1.0, 0.0] });
        push(b, bar, 0.5, [0.0, -1e3], 0.0);
        push(b, bar, right, [1e4, 0.0], 0.0);
    })
}

#[test]
fn a_sagging_beam_is_stretched_at_its_lower_face() {
    let (mean, bent) = (1e4 / AREA, 1e3 / 4.0 / MODULUS);
    let [above, below] = [mean - bent, mean + bent];
    // The pull turns deflections into moments: 1e-7 of the moment.
    assert_near(at_rest(&sagging(0.0, 1.0)), [below, above, below], 1e-6);
}

#[test]
fn the_top_of_a_beam_drawn_from_right_to_left_is_its_lower_face() {
    let (mean, bent) = (1e4 / AREA, 1e3 / 4.0 / MODULUS);
    let [above, below] = [mean - bent, mean + bent];
    assert_near(at_rest(&sagging(1.0, 0.0)), [below, below, above], 1e-6);
}

#[test]
fn a_bar_in_tension_has_one_stress() {
    let bar = stiff([[0.0, 0.0], [1.0, 0.0]], |b, bar| {
        hold(b, bar, 0.0, SupportKind::Clamp);
        push(b, bar, 1.0, [1e4, 0.0], 0.0);
    });
    assert_near(at_rest(&bar), [1e4 / AREA; 3], 1e-9);
}

/// A bar of 20 x 20 x 400 mm that hardens beyond 250 MPa, clamped at its start.
fn hardening(more: impl Fn(&mut ModelBuilder, BeamId)) -> Model {
    let mut b = ModelBuilder::new();
    let plasticity = Plasticity {
        curve: vec![Hardening { from: 0.0, stress: 250e6, modulus: 4e9 }],
        kinematic: 0.0,
        overstress: None,
        failure_strain: None,
    };
    let material = b.material(Material {
        strain: StrainMeasure::Engineering,
        inelasticity: Some(Inelasticity::Plastic(plasticity)),
        ..Material::new("steel", 205e9, 7850.0)
    });
    let section = b.section(Section::rectangle("square", 0.02, 0.02));
    let bar = b.beam(beam("bar", [0.0, 0.0], [0.4, 0.0], 8, material, section));
    hold(&mut b, bar, 0.0, SupportKind::Clamp);
    more(&mut b, bar);
    b.record_point(at("mid", bar, 0.5));
    b.build().unwrap()
}

#[test]
fn a_beam_bent_beyond_yield_is_compressed_at_the_top_and_stretched_at_the_bottom() {
    // 1.2 of the moment at first yield, sagging.
    let model =
        hardening(|b, bar| push(b, bar, 1.0, [0.0; 2], 1.2 * 250e6 * 0.02_f64.powi(3) / 6.0));
    let [stress, top, bottom] = at_rest(&model);
    assert!(bottom > 250e6 && top < -250e6, "{top} {bottom}");
    // Strains are those of bending alone up to what the mesh leaves of the axial strain.
    assert!((top + bottom).abs() < 1e-3 * bottom, "{top} {bottom}");
    // No fibre inside is strained as much as the outer ones.
    assert_eq!(stress, if top.abs() > bottom.abs() { top } else { bottom });
}

#[test]
fn no_fibre_of_a_beam_in_motion_exceeds_the_stress_of_its_column() {
    let strike = |b: &mut ModelBuilder, bar: BeamId| {
        let struck = at("struck", bar, 1.0);
        b.projectile(Projectile { mass: 1.0, ..rigid("p", struck, [0.0, -20.0], 0.5) });
    };
    // Under the elastic limit, where the outer fibres are those of largest stress, and beyond.
    let (rows, run) = Rows::of(&hardening(strike), &Settings::new(4e-3, 1e-5));
    let first = run.plastic[0].first_yield.expect("it yields").time;
    let [stress, top, bottom] = stresses(&rows);
    let time = rows.column("time");
    for k in 0..time.len() {
        let outer = top[k].abs().max(bottom[k].abs());
        assert!(stress[k].abs() >= outer, "{} s: {} {outer}", time[k], stress[k]);
        assert!(time[k] >= first || stress[k].abs() == outer, "{} s: {}", time[k], stress[k]);
    }
}

#[test]
fn stresses_of_an_elastic_beam_in_motion_follow_from_axial_force_and_moment() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 7e10, 3e3));
    let section = b.section(Section::rectangle("s", 0.05, 0.02));
    let bar = b.beam(beam("bar", [0.0, 0.0], [0.8, 0.0], 8, material, section));
    hold(&mut b, bar, 0.0, SupportKind::Clamp);
    hold(&mut b, bar, 1.0, SupportKind::Clamp);
    // Within an element, where nothing jumps.
    b.record_point(at("mid", bar, 0.47));
    let struck = at("struck", bar, 0.5493);
    b.projectile(Projectile { mass: 1.0, standoff: 0.0, ..rigid("p", struck, [2.0, -4.0], 0.7) });
    let (rows, _) = Rows::of(&b.build().unwrap(), &Settings::new(2e-3, 2e-5));
    let [stress, top, bottom] = stresses(&rows);
    let [axial, moment] = ["axial", "moment"].map(|q| rows.column(&format!("section.mid.{q}")));
    let size = stress.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    assert!(size > 1e6, "{size}");
    for k in 0..stress.len() {
        let (mean, bent) = (axial[k] / 1e-3, moment[k] * 6.0 / (0.05 * 0.02 * 0.02));
        assert!((top[k] - (mean - bent)).abs() < 1e-9 * size, "{} {mean} {bent}", top[k]);
        assert!((bottom[k] - (mean + bent)).abs() < 1e-9 * size, "{} {mean} {bent}", bottom[k]);
        let larger = if top[k].abs() > bottom[k].abs() { top[k] } else { bottom[k] };
        // Of equal ones the sign is free.
        assert!(stress[k] == larger || stress[k].abs() == larger.abs(), "{}", stress[k]);
    }
}

#[test]
fn a_section_without_a_depth_has_no_stresses() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 2, material, section));
    hold(&mut b, bar, 0.0, SupportKind::Clamp);
    b.record_point(at("mid", bar, 0.5));
    let (rows, _) = Rows::of(&b.build().unwrap(), &Settings::new(1e-3, 1e-3));
    let columns = rows.names.iter().filter(|name| name.starts_with("section.mid."));
    assert_eq!(columns.count(), 3, "{:?}", rows.names);
}
