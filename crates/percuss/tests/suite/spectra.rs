//! Natural modes, stability and linear buckling: counts and eigenvalues against closed forms.

use std::f64::consts::{PI, TAU};

use percuss::*;

const YOUNG: f64 = 2.1e11;
const SIDE: f64 = 0.05;
const LENGTH: f64 = 3.0;

fn at(beam: BeamId, fraction: f64) -> PointRef {
    PointRef { label: format!("p{fraction}"), beam, along: Along::Fraction(fraction) }
}

/// Steel, 50 x 50 mm, without rotary inertia.
fn steel(b: &mut ModelBuilder, density: f64) -> (MaterialId, SectionId) {
    let material = b.material(Material::new("steel", YOUNG, density));
    let mut section = Section::new("square", SIDE * SIDE, SIDE.powi(4) / 12.0);
    section.rotary_inertia = RotaryInertia::Neglected;
    (material, b.section(section))
}

fn bending() -> f64 {
    YOUNG * SIDE.powi(4) / 12.0
}

/// A straight beam of 3 m along the first axis, with the additions of `build`.
fn straight(elements: usize, density: f64, build: impl FnOnce(&mut ModelBuilder, BeamId)) -> Model {
    let mut b = ModelBuilder::new();
    let (material, section) = steel(&mut b, density);
    let points = [[0.0, 0.0], [LENGTH, 0.0]];
    let beam = b.beam(Beam::new("beam", &points, elements, material, section));
    build(&mut b, beam);
    b.build().unwrap()
}

fn clamp(b: &mut ModelBuilder, beam: BeamId, fraction: f64) {
    let name = format!("clamp{fraction}");
    b.support(Support::new(name, at(beam, fraction), SupportKind::Clamp));
}

fn tip_mass(b: &mut ModelBuilder, beam: BeamId) {
    let at = at(beam, 1.0);
    b.point_mass(PointMass { name: "tip".into(), at, mass: 1000.0, rotary_inertia: 0.0 });
}

fn close(found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs() / expected.abs();
    assert!(error <= tolerance, "found {found}, expected {expected}: {error:.2e}");
}

/// Roots of `cos x cosh x = sign`, from 1.
fn roots(sign: f64, count: usize) -> Vec<f64> {
    let f = |x: f64| x.cos() - sign / x.cosh();
    let start = if sign > 0.0 { 1 } else { 0 };
    (start..start + count)
        .map(|k| {
            let middle = (k as f64 + 0.5) * PI;
            let (mut lo, mut hi) = (middle - 1.0, middle + 1.0);
            for _ in 0..100 {
                let x = 0.5 * (lo + hi);
                if (f(x) > 0.0) == (f(lo) > 0.0) { lo = x } else { hi = x }
            }
            lo
        })
        .collect()
}

fn hertz(root: f64, density: f64) -> f64 {
    root * root / (TAU * LENGTH * LENGTH) * (bending() / (density * SIDE * SIDE)).sqrt()
}

#[test]
fn meshes_of_any_fineness_have_the_same_ten_lowest_modes() {
    for (elements, kinds) in [(300, 3), (3000, 3), (20_000, 2), (100_000, 1)] {
        for (clamps, sign, rigid) in
            [(1, -1.0, 0), (0, 1.0, 3), (2, 1.0, 0)].into_iter().take(kinds)
        {
            let model = straight(elements, 7850.0, |b, beam| {
                (0..clamps).for_each(|k| clamp(b, beam, f64::from(k)));
            });
            let found = natural_frequencies(&model, 10 + rigid);
            assert_eq!(found.len(), 10 + rigid);
            assert!(found[..rigid].iter().all(|f| *f == 0.0), "{elements} {found:?}");
            let across = roots(sign, 10).into_iter().map(|root| hertz(root, 7850.0));
            let quarters = if clamps == 1 { [1.0, 3.0] } else { [2.0, 4.0] };
            let wave = (YOUNG / 7850.0_f64).sqrt() / (4.0 * LENGTH);
            let mut expected: Vec<f64> = across.chain(quarters.map(|q| q * wave)).collect();
            expected.sort_by(f64::total_cmp);
            for (f, expected) in found[rigid..].iter().zip(expected) {
                // 300 elements have an error of (beta h)^4 / 720 = 2e-7 in the tenth, 100 000 only round-off.
                close(*f, expected, 1e-6);
            }
        }
    }
}

#[test]
fn a_heavy_tip_leaves_the_lowest_mode_of_a_fine_mesh() {
    // mu x (sin x cosh x - cos x sinh x) = 1 + cos x cosh x, mu the tip's share of the beam's mass; a light beam only bends.
    let exact = |density: f64| {
        if density < 1.0 {
            let own = 33.0 / 140.0 * density * SIDE * SIDE * LENGTH;
            return (3.0 * bending() / LENGTH.powi(3) / (1000.0 + own)).sqrt() / TAU;
        }
        let mu = 1000.0 / (density * SIDE * SIDE * LENGTH);
        let f = |x: f64| {
            let sway = x.sin() * x.cosh() - x.cos() * x.sinh();
            1.0 + x.cos() * x.cosh() - mu * x * sway
        };
        let (mut lo, mut hi) = (0.1, 1.8);
        for _ in 0..100 {
            let x = 0.5 * (lo + hi);
            if f(x) > 0.0 { lo = x } else { hi = x }
        }
        hertz(lo, density)
    };
    for elements in [4, 200, 300, 2000] {
        for density in [7850.0, 0.03, 1e-12, 0.0] {
            let model = straight(elements, density, |b, beam| {
                clamp(b, beam, 0.0);
                tip_mass(b, beam);
            });
            assert_eq!(mechanisms(&model), []);
            close(natural_frequencies(&model, 1)[0], exact(density), 1e-8);
        }
    }
}

/// A cantilever under a force that stays tangential at its tip, the case of Beck, and its loaded equilibrium's lowest modes.
fn beck(elements: usize, load: f64, count: usize) -> (bool, Vec<Mode>) {
    let model = straight(elements, 7850.0, |b, beam| {
        clamp(b, beam, 0.0);
        let force = [-load * bending() / (LENGTH * LENGTH), 0.0];
        let kind = LoadKind::Point { at: at(beam, 1.0), force, moment: 0.0, follower: true };
        b.load(Load::new("push", kind));
    });
    let found = equilibrium(&model).unwrap();
    (found.stable, modes_about(&model, &found.state, count))
}

/// Lowest squares of dimensionless frequencies of Beck's column under `p = P L^2 / EI`: roots of
/// `p^2 + 2 w^2 (1 + cosh a cos b) + p w sinh a sin b` (Beck 1952, Die Knicklast des einseitig eingespannten, tangential
/// gedrueckten Stabes), with `a, b = sqrt(sqrt(p^2/4 + w^2) -+ p/2)`.
fn beck_root(p: f64) -> f64 {
    let f = |w: f64| {
        let r = (0.25 * p * p + w * w).sqrt();
        let (a, b) = ((r - 0.5 * p).sqrt(), (r + 0.5 * p).sqrt());
        p * p + 2.0 * w * w * (1.0 + a.cosh() * b.cos()) + p * w * a.sinh() * b.sin()
    };
    let mut lo = 1.0;
    while f(lo + 0.01) > 0.0 {
        lo += 0.01;
    }
    let mut hi = lo + 0.01;
    for _ in 0..100 {
        let w = 0.5 * (lo + hi);
        if f(w) > 0.0 { lo = w } else { hi = w }
    }
    lo
}

#[test]
fn a_tangential_force_leaves_the_frequencies_of_becks_column() {
    // 5.568, 6.833, 8.749 against 3.516 without load, in units of the unloaded frequency.
    for load in [5.0, 10.0, 15.0] {
        let (stable, modes) = beck(24, load, 3);
        assert!(stable);
        let expected =
            beck_root(load) / (TAU * LENGTH * LENGTH) * (bending() / (7850.0 * SIDE * SIDE)).sqrt();
        // The strain of the load, p I / (A L^2) = 3.5e-4, stiffens and shortens.
        close(modes[0].frequency(), expected, 2e-3);
        assert!(modes.iter().all(|m| m.kind() == ModeKind::Vibration));
    }
}

#[test]
fn becks_column_flutters_at_20_05_and_never_diverges() {
    for (load, flutters) in [(19.9, false), (20.2, true), (30.0, true)] {
        let (stable, modes) = beck(24, load, 3);
        assert_eq!(stable, !flutters, "{load}");
        assert_eq!(modes[0].kind() == ModeKind::Flutter, flutters, "{load} {modes:?}");
        assert_eq!(modes[0].growth() > 0.0, flutters);
        assert!(modes.iter().all(|m| m.kind() != ModeKind::Unstable));
    }
}

#[test]
fn linear_buckling_of_forces_that_follow_is_refused_and_flutter_found() {
    // The last load is some hundred times that of flutter: it is below the first factor of the search.
    for (elements, push) in [(4, 1000.0), (24, 1000.0), (24, 3e5), (24, 3e7)] {
        let model = straight(elements, 7850.0, |b, beam| {
            clamp(b, beam, 0.0);
            let force = [-push, 0.0];
            let kind = LoadKind::Point { at: at(beam, 1.0), force, moment: 0.0, follower: true };
            b.load(Load::new("push", kind));
        });
        let found = buckling(&model, 2);
        assert!(found.modes.is_empty());
        assert_eq!(found.outcome, BucklingOutcome::Follower);
        // Beck 1952: 20.05 EI / L^2; four elements meet it to their order.
        let Some(FollowerStability::Flutter { factor, frequency }) = found.stability else {
            panic!("{found:?}")
        };
        let load = factor * push * LENGTH * LENGTH / bending();
        // As above, the strain of the load stiffens and shortens: p I / (A L^2) = 1e-3 at 20.
        close(load, 20.0509, if elements == 4 { 1e-2 } else { 4e-3 });
        // Both frequencies are 11.016 there, in units of sqrt(EI / rhoA L^4).
        let unit = (bending() / (7850.0 * SIDE * SIDE)).sqrt() / (TAU * LENGTH * LENGTH);
        close(frequency, 11.016 * unit, if elements == 4 { 1e-2 } else { 4e-3 });
    }
}

/// A pinned column of 3 m beside `ties` rods in tension, pressed by `force`.
fn column_and_ties(ties: usize, force: f64) -> Model {
    let mut b = ModelBuilder::new();
    let (material, section) = steel(&mut b, 7850.0);
    let roller = || SupportKind::Roller { direction: [1.0, 0.0] };
    for k in 0..=ties {
        let y = k as f64;
        let name = format!("b{k}");
        let points = [[0.0, y], [LENGTH, y]];
        let beam = b.beam(Beam::new(name.clone(), &points, 16, material, section));
        b.support(Support::new(format!("{name}.left"), at(beam, 0.0), SupportKind::Pin));
        b.support(Support::new(format!("{name}.right"), at(beam, 1.0), roller()));
        let pull = if k == 0 { -force } else { 8.0 * force };
        let kind =
            LoadKind::Point { at: at(beam, 1.0), force: [pull, 0.0], moment: 0.0, follower: false };
        b.load(Load::new(format!("{name}.load"), kind));
    }
    b.build().unwrap()
}

#[test]
fn negative_factors_hide_no_positive_one() {
    let euler = PI * PI * bending() / (LENGTH * LENGTH);
    let found = buckling(&column_and_ties(4, euler / 6.0), 3);
    assert_eq!(found.outcome, BucklingOutcome::Found);
    assert_eq!(found.modes.len(), 3);
    for (k, mode) in (1..).zip(&found.modes) {
        // The strain of Euler's load, (pi k)^2 I / (A L^2) = 2.3e-4 k^2, and 16 elements.
        close(mode.factor, 6.0 * f64::from(k * k), 1e-3 * f64::from(k * k));
    }
    // In tension alone there is no buckling, which is proven.
    let pulled = buckling(&column_and_ties(0, -euler), 3);
    assert!(pulled.modes.is_empty());
    assert!(matches!(pulled.outcome, BucklingOutcome::Never { .. }), "{:?}", pulled.outcome);
}

#[test]
fn equal_columns_buckle_as_often_as_there_are() {
    let mut b = ModelBuilder::new();
    let (material, section) = steel(&mut b, 7850.0);
    for k in 0..3 {
        let points = [[f64::from(k), 0.0], [f64::from(k), LENGTH]];
        let beam = b.beam(Beam::new(format!("c{k}"), &points, 8, material, section));
        b.support(Support::new(format!("foot{k}"), at(beam, 0.0), SupportKind::Clamp));
        let force = [0.0, -1000.0];
        let kind = LoadKind::Point { at: at(beam, 1.0), force, moment: 0.0, follower: false };
        b.load(Load::new(format!("load{k}"), kind));
    }
    let found = buckling(&b.build().unwrap(), 4).modes;
    let euler = PI * PI * bending() / (4.0 * LENGTH * LENGTH) / 1000.0;
    for mode in &found[..3] {
        close(mode.factor, euler, 1e-3);
    }
    close(found[3].factor, 9.0 * euler, 3e-3);
}

#[test]
fn massless_beams_are_refused_in_time_and_named() {
    let model = straight(4, 0.0, |b, beam| {
        clamp(b, beam, 0.0);
        tip_mass(b, beam);
        let force = [0.0, -100.0];
        let kind = LoadKind::Point { at: at(beam, 1.0), force, moment: 0.0, follower: false };
        b.load(Load::new("weight", kind));
    });
    // One motion across and one along, of the tip alone.
    let found = natural_frequencies(&model, 10);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found.iter().all(|f| f.is_finite() && *f > 0.0));
    let stiffness = YOUNG * SIDE * SIDE / LENGTH;
    close(found[1], (stiffness / 1000.0).sqrt() / TAU, 1e-9);
    let bent = equilibrium(&model).unwrap();
    assert!(bent.stable);
    let faults = Simulation::new(&model, &Settings::new(1.0, 1e-3)).err().unwrap();
    assert_eq!(faults[0].path, "beam.beam");
    assert!(faults[0].found.contains("no mass"), "{faults:?}");
}

/// A portal of three storeys, 3 m high and 4 m wide, lumped masses of 1 t at its joints.
fn portal(density: f64) -> Model {
    let mut b = ModelBuilder::new();
    let (material, section) = steel(&mut b, density);
    let mut columns = Vec::new();
    for (k, x) in [0.0, 4.0].into_iter().enumerate() {
        let points = [[x, 0.0], [x, 9.0]];
        let beam = b.beam(Beam::new(format!("column{k}"), &points, 12, material, section));
        b.support(Support::new(format!("foot{k}"), at(beam, 0.0), SupportKind::Clamp));
        columns.push(beam);
    }
    for storey in 1..=3 {
        let y = 3.0 * f64::from(storey);
        let points = [[0.0, y], [4.0, y]];
        let name = format!("girder{storey}");
        let beam = b.beam(Beam::new(name.clone(), &points, 4, material, section));
        for (end, column) in [(0.0, columns[0]), (1.0, columns[1])] {
            let there = at(column, f64::from(storey) / 3.0);
            let name = format!("{name}.{end}");
            b.joint(Joint {
                name: name.clone(),
                kind: JointKind::Rigid,
                between: [at(beam, end), there],
                yielding: None,
                strength: None,
            });
            b.point_mass(PointMass { name, at: at(beam, end), mass: 1000.0, rotary_inertia: 0.0 });
        }
    }
    b.build().unwrap()
}

#[test]
fn members_without_mass_leave_all_frequencies_of_lumped_masses() {
    let without = natural_frequencies(&portal(0.0), 20);
    // Six masses that move in a plane.
    assert_eq!(without.len(), 12, "{without:?}");
    assert!(without.windows(2).all(|w| w[0] <= w[1] * (1.0 + 1e-9)));
    let light = natural_frequencies(&portal(1e-12), 12);
    for (a, b) in light.iter().zip(&without) {
        close(*a, *b, 1e-7);
    }
    // Slope deflection of the frame's left half, which sways antisymmetrically: girders of half length hinged at mid-span.
    // Masses move across, joints turn without inertia; columns do not stretch (A h^2 / I = 4e4).
    let (h, half) = (3.0, 2.0);
    let ei = bending();
    let mut stiffness = nalgebra::DMatrix::<f64>::zeros(6, 6);
    for storey in 0..3_usize {
        let (c, d) = (12.0 * ei / (h * h * h), 6.0 * ei / (h * h));
        let (e, f) = (4.0 * ei / h, 2.0 * ei / h);
        // Displacements 0..3 and rotations 3..6 of the joints; below the first storey is the ground.
        let ends = [storey.checked_sub(1), Some(storey)];
        let local = [[c, d, -c, d], [d, e, -d, f], [-c, -d, c, -d], [d, f, -d, e]];
        let place = |k: usize| ends[k / 2].map(|joint| joint + 3 * (k % 2));
        for i in 0..4 {
            for j in 0..4 {
                if let (Some(i_), Some(j_)) = (place(i), place(j)) {
                    stiffness[(i_, j_)] += local[i][j];
                }
            }
        }
        stiffness[(3 + storey, 3 + storey)] += 3.0 * ei / half;
    }
    let (uu, ur) = (stiffness.view((0, 0), (3, 3)), stiffness.view((0, 3), (3, 3)));
    let rr = stiffness.view((3, 3), (3, 3)).into_owned().try_inverse().unwrap();
    let sway = uu - ur * rr * ur.transpose();
    let mut squares: Vec<f64> = sway.symmetric_eigenvalues().iter().map(|k| k / 1000.0).collect();
    squares.sort_by(f64::total_cmp);
    for (found, square) in without.iter().zip(squares) {
        close(*found, square.sqrt() / TAU, 2e-3);
    }
}
