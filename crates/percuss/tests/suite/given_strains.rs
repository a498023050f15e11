//! Temperatures and given strains: balances, schemes, spans, faults.

use std::f64::consts::FRAC_PI_2;

use crate::common;

use common::*;
use percuss::*;

/// A heated plank that a mass strikes, with a function of time on its temperature and gradient.
fn heated(function: TimeFunction, strain: StrainMeasure) -> Model {
    heated_with(function, strain, Theory::Slender)
}

fn heated_with(function: TimeFunction, strain: StrainMeasure, theory: Theory) -> Model {
    let mut b = ModelBuilder::new();
    let (expansion, poisson) = (1e-5, Some(0.3));
    let composite = Material::new("composite", 0.2e10, 3e3);
    let material = b.material(Material { strain, expansion, poisson, ..composite });
    let section = b.section(match theory {
        Theory::Slender => Section::new("plank", 0.1, 8.33e-5),
        Theory::Shear => Section::rectangle("plank", 1.0, 0.1),
    });
    let slender = beam("plank", [0.0, 0.0], [3.0, 0.4], 12, material, section);
    let plank = b.beam(Beam { theory, ..slender });
    b.support(Support::new("left", at("left", plank, 0.0), SupportKind::Pin));
    b.support(Support::new("right", at("right", plank, 1.0), SupportKind::Pin));
    b.projectile(elastic("mass", at("place", plank, 0.4), [0.0, -3.0]));
    let stretch = [Along::Fraction(0.25), Along::Fraction(1.0)];
    let kind = LoadKind::Temperature { beam: plank, stretch, change: 40.0, gradient: 2000.0 };
    b.load(Load { function: function.clone(), ..Load::new("heat", kind) });
    let stretch = [Along::Fraction(0.0), Along::Fraction(0.5)];
    let kind = LoadKind::Strain { beam: plank, stretch, strain: -2e-3, curvature: 0.03 };
    b.load(Load { from: 0.02, until: 0.11, ..Load::new("shrinkage", kind) });
    b.build().unwrap()
}

fn functions() -> [TimeFunction; 3] {
    [
        TimeFunction::Constant,
        TimeFunction::Ramp { duration: 0.05 },
        TimeFunction::Harmonic { frequency: 30.0, phase: 0.4 },
    ]
}

/// Energy and momenta balance under an impact while the temperature changes, whatever the strain measure, with strains that jump within a step.
#[test]
fn balances_close_while_strains_are_given() {
    let (green, engineering) = (StrainMeasure::Green, StrainMeasure::Engineering);
    let (slender, shear) = (Theory::Slender, Theory::Shear);
    for (strain, theory) in [(green, slender), (engineering, slender), (engineering, shear)] {
        for function in functions() {
            let model = heated_with(function.clone(), strain, theory);
            let summary = simulate(&model, &Settings::new(0.15, 1.7e-4), &mut NoRecorder).unwrap();
            let name = format!("{strain:?} {theory:?} {function:?}");
            assert!(matches!(summary.termination, Termination::Completed), "{name}: {summary:?}");
            assert!(summary.energy.residual_max < 1e-10, "{name}: {:?}", summary.energy);
            assert!(summary.momentum.linear_residual_max < 1e-10, "{name}");
            assert!(summary.momentum.angular_residual_max < 1e-10, "{name}");
            assert!(summary.energy.work_loads.abs() > 1.0, "{name}: {:?}", summary.energy);
        }
    }
}

/// Uniform heat and a gradient bend and lengthen a free end, and press on walls, alike in slender and in shear-flexible beams: there is no shear.
#[test]
fn shear_flexible_beams_expand_as_slender_ones() {
    let (length, area, young) = (3.0, 0.1, 0.2e10);
    let (stretch, curvature) = (1e-5 * 40.0, 1e-5 * 300.0);
    let of = |theory: Theory, places: &[f64]| {
        let mut b = ModelBuilder::new();
        let strain = StrainMeasure::Engineering;
        let (expansion, poisson) = (1e-5, Some(0.3));
        let composite = Material::new("composite", young, 3e3);
        let material = b.material(Material { strain, expansion, poisson, ..composite });
        let section = b.section(Section::rectangle("plank", 1.0, 0.1));
        let slender = beam("plank", [0.0, 0.0], [length, 0.0], 12, material, section);
        let plank = b.beam(Beam { theory, ..slender });
        for place in places {
            let name = format!("wall{place}");
            b.support(Support::new(&name, at(&name, plank, *place), SupportKind::Clamp));
        }
        let whole = [0.0, 1.0].map(Along::Fraction);
        let kind =
            LoadKind::Temperature { beam: plank, stretch: whole, change: 40.0, gradient: 300.0 };
        b.load(Load::new("heat", kind));
        b.record_point(at("end", plank, 1.0));
        equilibrium(&b.build().unwrap()).unwrap()
    };
    // The deflection across is without the stretch, 4e-4 of it.
    let close = |found: f64, exact: f64| (found / exact - 1.0).abs() < 2e-3;
    for theory in [Theory::Slender, Theory::Shear] {
        let free = of(theory, &[0.0]);
        let [along, across] = free.points[0].1;
        // The warmer top is longer: the end turns clockwise, on a circle, of the stretched length.
        let angle = curvature * length;
        let exact = [(1.0 + stretch) * angle.sin() / curvature - length, -0.5 * angle * length];
        assert!(close(along, exact[0]) && close(across, exact[1]), "{theory:?}: {along} {across}");
        let size = young * area * stretch;
        let forces = free.element_forces.iter().flatten();
        let most = forces.flatten().fold(0.0_f64, |most, force| most.max(force.abs()));
        assert!(most < 1e-6 * size, "{theory:?}: {most}");
        let held = of(theory, &[0.0, 1.0]);
        let [axial, shear, moment] = held.element_forces[5][0];
        let bending = young * area * 0.1 * 0.1 / 12.0;
        assert!(close(axial, -size), "{theory:?}: {axial} {size}");
        assert!(close(moment.abs(), bending * curvature), "{theory:?}: {moment}");
        assert!(shear.abs() < 1e-6 * size, "{theory:?}: {shear}");
    }
}

/// The other schemes balance as far as they do without: the paper's to round-off, and the motion is that of the energy-momentum scheme.
#[test]
fn schemes_agree_on_heated_beams() {
    let model = heated(TimeFunction::Ramp { duration: 0.05 }, StrainMeasure::Green);
    let run = |scheme| {
        // It ends before the strains jump: the waves of a jump differ from scheme to scheme.
        let settings = Settings { scheme, ..Settings::new(0.019, 2e-5) };
        simulate(&model, &settings, &mut NoRecorder).unwrap()
    };
    let own = run(Scheme::EnergyMomentum);
    let largest = |s: &RunSummary| s.points[0].displacement_max[1].value;
    for scheme in [Scheme::StrainRate, Scheme::Midpoint, Scheme::Newmark] {
        let other = run(scheme);
        let ratio = largest(&other) / largest(&own);
        assert!((ratio - 1.0).abs() < 1e-3, "{scheme:?}: {ratio}");
    }
    assert!(run(Scheme::StrainRate).energy.residual_max < 1e-10);
}

/// A heated beam in equilibrium has the reactions of its section forces.
#[test]
fn equilibrium_of_a_heated_beam_is_balanced() {
    let model = heated(TimeFunction::Constant, StrainMeasure::Engineering);
    let found = equilibrium(&model).unwrap();
    let size = 0.2e10 * 0.1 * 4e-4;
    let sum = [0, 1].map(|i| found.reactions.iter().map(|(_, r)| r[i]).sum::<f64>());
    assert!(sum[0].hypot(sum[1]) < 1e-8 * size, "{sum:?}");
    // At the pin the axial force and the shear force are the reaction, the moment is none.
    let [axial, shear, moment] = found.element_forces[0][0];
    let reaction = found.reactions[0].1;
    let force = reaction[0].hypot(reaction[1]);
    assert!(axial < 0.0 && force > 0.1 * size, "{axial} {force}");
    assert!((axial.hypot(shear) - force).abs() < 1e-8 * size, "{axial} {shear} {reaction:?}");
    assert!(moment.abs() < 1e-8 * size, "{moment}");
}

/// A run that starts in the equilibrium of a heated beam stays there.
#[test]
fn a_heated_beam_in_equilibrium_stays_at_rest() {
    let mut b = ModelBuilder::new();
    let material =
        b.material(Material { expansion: 1e-5, ..Material::new("composite", 0.2e10, 3e3) });
    let section = b.section(Section::new("plank", 0.1, 8.33e-5));
    let arch = b.beam(Beam {
        curve: Curve::Arc,
        ..Beam::new("arch", &[[0.0, 0.0], [1.5, 0.3], [3.0, 0.0]], 12, material, section)
    });
    for (name, place) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, arch, place), SupportKind::Clamp));
    }
    let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
    let heat = LoadKind::Temperature { beam: arch, stretch, change: 40.0, gradient: 300.0 };
    b.load(Load::new("heat", heat));
    b.record_point(at("mid", arch, 0.5));
    let model = b.build().unwrap();
    let settings = Settings { start: Start::Static, ..Settings::new(0.05, 1e-4) };
    let mut rows = MemoryRecorder::default();
    let summary = simulate(&model, &settings, &mut rows).unwrap();
    assert!(matches!(summary.termination, Termination::Completed), "{summary:?}");
    let place = rows.column("point.mid.displacement_2").unwrap();
    assert!(place[0] > 1e-4, "{}", place[0]);
    assert!(place.iter().all(|u| (u - place[0]).abs() < 1e-7 * place[0]), "{place:?}");
    assert!(summary.energy.residual_max < 1e-10, "{:?}", summary.energy);
}

#[test]
fn faults_of_given_strains_name_their_key() {
    let fault = |kind: &dyn Fn(BeamId) -> LoadKind, inelasticity: Option<Inelasticity>| {
        let mut b = ModelBuilder::new();
        let material =
            b.material(Material { inelasticity, ..Material::new("composite", 0.2e10, 3e3) });
        let section = b.section(Section::rectangle("plank", 0.1, 0.1));
        let plank = b.beam(beam("plank", [0.0, 0.0], [3.0, 0.0], 4, material, section));
        b.load(Load::new("heat", kind(plank)));
        b.build().unwrap_err().into_iter().map(|f| f.path).collect::<Vec<_>>()
    };
    let whole = [0.0, 1.0].map(Along::Fraction);
    let strain = |beam, strain, stretch| LoadKind::Strain { beam, stretch, strain, curvature: 0.0 };
    let heat =
        move |beam| LoadKind::Temperature { beam, stretch: whole, change: 10.0, gradient: 0.0 };
    assert_eq!(fault(&move |b| strain(b, 0.0, whole), None), ["load.heat.strain"]);
    assert_eq!(fault(&move |b| strain(b, f64::NAN, whole), None), ["load.heat.strain"]);
    let back = [1.0, 0.5].map(Along::Fraction);
    assert_eq!(fault(&move |b| strain(b, 1e-3, back), None), ["load.heat.stretch"]);
    assert_eq!(fault(&heat, None), ["load.heat.on"]);
    let slack = Some(Inelasticity::OneSided(Slack::Tension));
    assert_eq!(fault(&move |b| strain(b, 1e-3, whole), slack), ["load.heat.on"]);
}

/// No stretch has a Green strain of -1/2 or less, or an engineering strain of -1 or less; what a load reaches over time counts.
#[test]
fn given_strains_that_leave_no_length_are_faults() {
    let of = |strain: StrainMeasure, theory: Theory, function: TimeFunction, kind: &LoadKind| {
        let mut b = ModelBuilder::new();
        let (expansion, poisson) = (1e-5, Some(0.3));
        let composite = Material::new("composite", 0.2e10, 3e3);
        let material = b.material(Material { strain, expansion, poisson, ..composite });
        let section = b.section(Section::rectangle("plank", 0.1, 0.1));
        let slender = beam("plank", [0.0, 0.0], [3.0, 0.0], 4, material, section);
        b.beam(Beam { theory, ..slender });
        b.load(Load { function, ..Load::new("heat", kind.clone()) });
        b.build().err().unwrap_or_default()
    };
    let (beam, stretch) = (BeamId::default(), [0.0, 1.0].map(Along::Fraction));
    let given = |strain: f64| LoadKind::Strain { beam, stretch, strain, curvature: 0.1 };
    let heat = |change: f64| LoadKind::Temperature { beam, stretch, change, gradient: 0.0 };
    let (green, engineering) = (StrainMeasure::Green, StrainMeasure::Engineering);
    let (slender, shear) = (Theory::Slender, Theory::Shear);
    let constant = TimeFunction::Constant;
    for (strain, theory, limit) in
        [(green, slender, 0.5), (engineering, slender, 1.0), (green, shear, 1.0)]
    {
        let paths = |kind: &LoadKind, function: &TimeFunction| -> Vec<String> {
            let faults = of(strain, theory, function.clone(), kind);
            faults.into_iter().map(|fault| fault.path).collect()
        };
        assert!(paths(&given(0.001 - limit), &constant).is_empty());
        assert!(paths(&heat(1e5 * (0.001 - limit)), &constant).is_empty());
        assert_eq!(paths(&given(-limit), &constant), ["load.heat.strain"]);
        assert_eq!(paths(&heat(-1.001e5 * limit), &constant), ["load.heat.change"]);
        // An elongation, which a negative factor makes a contraction.
        let table = |least: f64| {
            let (times, values) = (vec![0.0, 1.0], vec![0.5, least]);
            TimeFunction::Table { times, values, smooth: false }
        };
        assert!(paths(&given(limit), &constant).is_empty());
        assert!(paths(&given(limit), &table(-0.9)).is_empty());
        assert_eq!(paths(&given(limit), &table(-1.1)), ["load.heat.strain"]);
        let harmonic = TimeFunction::Harmonic { frequency: 1.0, phase: 0.0 };
        assert_eq!(paths(&given(limit), &harmonic), ["load.heat.strain"]);
    }
    // Loads that act together add up where both act.
    let both = |ends: [f64; 2]| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("composite", 0.2e10, 3e3));
        let section = b.section(Section::rectangle("plank", 0.1, 0.1));
        let plank = self::beam("plank", [0.0, 0.0], [3.0, 0.0], 4, material, section);
        b.beam(plank);
        for (name, ends) in [("first", [0.0, 0.5]), ("second", ends)] {
            let (stretch, strain) = (ends.map(Along::Fraction), -0.3);
            let kind = LoadKind::Strain { beam, stretch, strain, curvature: 0.0 };
            b.load(Load::new(name, kind));
        }
        let faults = b.build().err().unwrap_or_default();
        faults.into_iter().map(|fault| fault.path).collect::<Vec<_>>()
    };
    assert!(both([0.5, 1.0]).is_empty());
    assert_eq!(both([0.25, 1.0]), ["load.second.strain"]);
    let faults = of(green, slender, constant, &heat(-2e5));
    assert!(faults[0].found.contains("a strain of -2 "), "{faults:?}");
    assert!(faults[0].expected.contains("above -0.5 in `plank`"), "{faults:?}");
}

/// A quarter of a circle of radius 2 m, clamped at its start, heated evenly: it is dilated, without forces and rotations.
#[test]
fn a_curved_beam_expands_evenly() {
    let (green, engineering) = (StrainMeasure::Green, StrainMeasure::Engineering);
    let (slender, shear) = (Theory::Slender, Theory::Shear);
    for (strain, theory) in [(green, slender), (engineering, slender), (engineering, shear)] {
        let mut b = ModelBuilder::new();
        let (expansion, poisson) = (1e-5, Some(0.3));
        let composite = Material::new("composite", 1e10, 2e3);
        let material = b.material(Material { strain, expansion, poisson, ..composite });
        let section = b.section(Section::rectangle("bar", 0.1, 0.2));
        let half = 2_f64.sqrt();
        let points = [[0.0, 0.0], [2.0 - half, half], [2.0, 2.0]];
        let polyline = Beam::new("arc", &points, 30, material, section);
        let arc = b.beam(Beam { curve: Curve::Arc, theory, ..polyline });
        b.support(Support::new("root", at("root", arc, 0.0), SupportKind::Clamp));
        b.record_point(at("tip", arc, 1.0));
        let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
        let kind = LoadKind::Temperature { beam: arc, stretch, change: 30.0, gradient: 0.0 };
        b.load(Load::new("heat", kind));
        let found = equilibrium(&b.build().unwrap()).unwrap();
        let [u, v, ..] = *found.state.displacement.last().unwrap();
        // Green strains of 3e-4 elongate by 4.5e-8 less; 30 shear-flexible elements are of second order.
        let expected = 2.0 * 3e-4;
        assert!((u / expected - 1.0).abs() < 1e-3, "{strain:?} {theory:?}: {u}");
        assert!((v / expected - 1.0).abs() < 1e-3, "{strain:?} {theory:?}: {v}");
    }
}

/// About the reference configuration a heated bar between walls has its axial force, flexible in shear or not, and a frame that the heat bends has
/// none: nothing balances it there.
#[test]
fn modes_about_the_reference_have_the_heat_that_supports_bear() {
    let lowest = |points: &[[f64; 2]], theory, change: f64| {
        let mut b = ModelBuilder::new();
        let (expansion, poisson) = (1e-5, Some(0.25));
        let composite = Material::new("composite", 1e10, 2e3);
        let material = b.material(Material { expansion, poisson, ..composite });
        let section = b.section(Section::rectangle("bar", 0.1, 0.2));
        let bar = b.beam(Beam { theory, ..Beam::new("bar", points, 30, material, section) });
        for (name, end) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, bar, end), SupportKind::Clamp));
        }
        if change > 0.0 {
            let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
            let kind = LoadKind::Temperature { beam: bar, stretch, change, gradient: 0.0 };
            b.load(Load::new("heat", kind));
        }
        let model = b.build().unwrap();
        let reference = modes_about(&model, &reference_state(&model).unwrap(), 1);
        let found = equilibrium(&model).unwrap();
        let heated = modes_about_equilibrium(&model, &found, 1);
        [reference, heated].map(|modes| modes[0].frequency())
    };
    let bar = [[0.0, 0.0], [2.0, 0.0]];
    let frame = [[0.0, 0.0], [0.0, 2.0], [2.0, 2.0], [2.0, 0.0]];
    for theory in [Theory::Slender, Theory::Shear] {
        let [reference, heated] = lowest(&bar, theory, 500.0);
        let [cold, _] = lowest(&bar, theory, 0.0);
        assert!((reference / heated - 1.0).abs() < 1e-9, "{theory:?}: {reference} {heated}");
        assert!(heated < 0.95 * cold, "{theory:?}: {heated} {cold}");
        let [reference, _] = lowest(&frame, theory, 200.0);
        let [cold, _] = lowest(&frame, theory, 0.0);
        assert!((reference / cold - 1.0).abs() < 1e-9, "{theory:?}: {reference} {cold}");
    }
}

/// A cantilever of ten elements with the given curvature of half a circle and a stretch of 1 % is rolled up evenly: no load step folds an element, in
/// which strains at a few places would be the same.
#[test]
fn a_given_curvature_rolls_a_beam_up_without_folds() {
    for curvature in [1.56, FRAC_PI_2, 1.58] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("composite", 1e10, 2e3));
        let section = b.section(Section::rectangle("bar", 0.1, 0.2));
        let bar = b.beam(beam("bar", [0.0, 0.0], [2.0, 0.0], 10, material, section));
        b.support(Support::new("root", at("root", bar, 0.0), SupportKind::Clamp));
        let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
        let kind = LoadKind::Strain { beam: bar, stretch, strain: 0.01, curvature };
        b.load(Load::new("roll", kind));
        let model = b.build().unwrap();
        let found = equilibrium(&model).unwrap();
        for (n, u) in found.state.displacement.iter().enumerate() {
            // The bending strain of Green's law is the rotation per reference length times the stretch, whose square is 1 + 2 * 1 %.
            let angle = curvature * 0.2 * n as f64 / 1.02_f64.sqrt();
            let turned = u[3].atan2(1.0 + u[2]);
            // Ten elements of a cubic: rotations between nodes are of high order.
            assert!((turned - angle).abs() < 1e-2, "{curvature} {n}: {turned} {angle}");
        }
        assert!(found.stable);
    }
}
