//! Temperatures and given strains: balances, schemes, spans, faults.

use crate::common;

use common::*;
use percuss::*;

/// A heated plank that a mass strikes; `change` of the temperature and its gradient.
fn heated(function: TimeFunction, strain: StrainMeasure) -> Model {
    let mut b = ModelBuilder::new();
    let expansion = 1e-5;
    let material =
        b.material(Material { strain, expansion, ..Material::new("composite", 0.2e10, 3e3) });
    let section = b.section(Section::new("plank", 0.1, 8.33e-5));
    let plank = b.beam(beam("plank", [0.0, 0.0], [3.0, 0.4], 12, material, section));
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
    for strain in [StrainMeasure::Green, StrainMeasure::Engineering] {
        for function in functions() {
            let model = heated(function.clone(), strain);
            let summary = simulate(&model, &Settings::new(0.15, 1.7e-4), &mut NoRecorder).unwrap();
            let name = format!("{strain:?} {function:?}");
            assert!(matches!(summary.termination, Termination::Completed), "{name}: {summary:?}");
            assert!(summary.energy.residual_max < 1e-10, "{name}: {:?}", summary.energy);
            assert!(summary.momentum.linear_residual_max < 1e-10, "{name}");
            assert!(summary.momentum.angular_residual_max < 1e-10, "{name}");
            assert!(summary.energy.work_loads.abs() > 1.0, "{name}: {:?}", summary.energy);
        }
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

/// A heated frame in equilibrium has the reactions of its section forces.
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
