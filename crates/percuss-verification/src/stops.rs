//! Impact of beams on one-sided springs, and of a mass that remains attached to the struck beam.

use std::f64::consts::PI;

use percuss::*;

use crate::check::{Checks, Curve, Report};
use crate::structure::{at, or_nan};

/// E1: a hinged beam rotates onto a spring at its tip (code_aster SDNL32, VPCS V5.02.032).
pub fn swinging_beam() -> Report {
    let mut c = Checks::new();
    // Independent exact modal sum, 40 modes, undamped [mm].
    let undamped = [
        2.6607, 4.3284, 4.9387, 4.7676, 3.7875, 2.8256, 2.7028, 3.1350, 3.4943, 3.4855, 2.7947,
        0.8227,
    ];
    // Published with 1 % modal damping. At 3 ms the printed value is 4.92; a sum of 10 damped modes by an independent Runge-Kutta integration gives
    // 4.9535 there and agrees with the other eleven values: 4.9535 is expected.
    let damped = [2.66, 4.33, 4.9535, 4.78, 3.82, 2.87, 2.71, 3.09, 3.41, 3.36, 2.64, 0.742];
    for (name, ratios, expected) in
        [("undamped", Vec::new(), undamped), ("1 % modal damping", vec![0.01; 10], damped)]
    {
        let is_damped = !ratios.is_empty();
        let model = falling_beam(ratios);
        let settings = Settings::new(0.0125, 1e-5);
        let mut run = Simulation::new(&model, &settings).expect("valid settings");
        let (mut largest, mut leaves, mut residual) = ((0.0, 0.0), f64::NAN, 0.0_f64);
        let mut before = 0.0;
        let mut moved = Vec::new();
        while run.state().step < run.step_count() {
            if run.advance(&mut NoRecorder).is_err() {
                break;
            }
            let state = run.state();
            let u = state.displacement[20][1];
            if state.step.is_multiple_of(10) {
                moved.push([1e3 * state.time, 1e3 * u]);
            }
            if state.step.is_multiple_of(100) {
                let k = state.step / 100;
                let what = format!("{name}: tip displacement at {k} ms [mm]");
                // 0.3 % of the value, or of the largest where the published ones are rounded.
                let expected = -expected[k - 1];
                if is_damped {
                    c.absolute(what, 1e3 * u, expected, 0.003 * 4.95);
                } else {
                    c.relative(what, 1e3 * u, expected, 3e-3);
                }
            }
            if -18_000.0 * u > largest.0 {
                largest = (-18_000.0 * u, state.time);
            }
            if before < 0.0 && u >= 0.0 {
                leaves = state.time - 1e-5 * u / (u - before);
            }
            before = u;
            let ledger = &state.ledger;
            let missing = ledger.energy_residual(run.measures()) / ledger.energy_scale;
            residual = residual.max(missing.abs());
        }
        let known = expected.iter().enumerate().map(|(k, u)| [(k + 1) as f64, -u]);
        c.figure(
            format!("Displacement of the tip, {name}"),
            ["time [ms]", "displacement [mm]"],
            [Curve::computed("Percuss", moved), Curve::reference("expected", known.collect())],
        );
        c.at_most(format!("{name}: energy residual"), residual, 1e-10);
        let loss = run.state().ledger.loss_damping;
        if is_damped {
            c.at_least(format!("{name}: energy taken by damping [J]"), loss, 1e-2);
        } else {
            c.relative(format!("{name}: largest force [N]"), largest.0, 89.63, 3e-3);
            c.absolute(format!("{name}: its time [s]"), largest.1, 3.331e-3, 1e-5);
            c.absolute(format!("{name}: leaves at [s]"), leaves, 12.321e-3, 1e-5);
        }
    }
    c.into_report()
}

/// A hinged beam that rotates towards a spring below its tip, with ratios of modal damping.
fn falling_beam(ratios: Vec<f64>) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("aluminium", 6.7e10, 2400.0));
    let mut section = Section::rectangle("square", 0.014, 0.014);
    section.rotary_inertia = RotaryInertia::Neglected;
    let section = b.section(section);
    let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [0.783, 0.0]], 20, material, section));
    b.support(Support::new("hinge", at("hinge", beam, 0.0), SupportKind::Pin));
    let stop = SupportKind::Stop {
        direction: [0.0, -1.0],
        gap: 0.0,
        stiffness: 18_000.0,
        two_sided: false,
    };
    b.support(Support::new("spring", at("tip", beam, 1.0), stop));
    b.initial_motion(InitialMotion { velocity: [0.0; 2], spin: -3.8, about: [0.0; 2] });
    b.modal_damping(ratios);
    b.build().expect("a verification case builds")
}

/// E2: a cantilever with a stop at its tip under a suddenly applied force (code_aster SDNL104).
pub fn tip_stop() -> Report {
    let mut c = Checks::new();
    for (name, scheme, step, expected, tolerance) in [
        // Published: -1.85334e-6, -4.63284e-3, .0514081.
        (
            "Newmark, 1e-4 s",
            Scheme::Newmark,
            1e-4,
            [-1.853_338e-6, -4.632_84e-3, 0.051_408_02],
            2e-6,
        ),
        (
            "Newmark, 1e-5 s",
            Scheme::Newmark,
            1e-5,
            [-1.833_304e-6, -4.493_228e-3, 0.051_439_354],
            2e-6,
        ),
        (
            "energy-momentum, 1e-5 s",
            Scheme::EnergyMomentum,
            1e-5,
            [-1.833_304e-6, -4.493_228e-3, 0.051_439_354],
            5e-6,
        ),
    ] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", 1e10, 1e6));
        let mut section = Section::new("circle", PI * 0.01, PI * 1e-4 / 4.0);
        section.rotary_inertia = RotaryInertia::Neglected;
        let section = b.section(section);
        let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [1.0, 0.0]], 10, material, section));
        b.support(Support::new("root", at("root", beam, 0.0), SupportKind::Clamp));
        let stop = SupportKind::Stop {
            direction: [0.0, -1.0],
            gap: 1e-4,
            stiffness: 1e8,
            two_sided: false,
        };
        b.support(Support::new("stop", at("tip", beam, 1.0), stop));
        let (force, moment) = ([0.0, -1000.0], 0.0);
        let tip = at("tip", beam, 1.0);
        b.load(Load::new("force", LoadKind::Point { at: tip, force, moment, follower: false }));
        let model = b.build().expect("a verification case builds");
        let settings = Settings { scheme, ..Settings::new(0.16, step) };
        let mut run = Simulation::new(&model, &settings).expect("valid settings");
        let at_step = |t: f64| (t / step).round() as usize;
        let (mut u, mut v) = (f64::NAN, f64::NAN);
        while run.state().step < run.step_count() {
            if run.advance(&mut NoRecorder).is_err() {
                break;
            }
            let state = run.state();
            if state.step == at_step(0.1315) {
                u = state.displacement[10][1];
            }
            if state.step == at_step(0.1566) {
                v = state.velocity[10][1];
            }
        }
        let kinetic = run.measures().kinetic_beams;
        c.relative(format!("{name}: u(0.1315) [m]"), u, expected[0], tolerance);
        c.relative(format!("{name}: v(0.1566) [m/s]"), v, expected[1], tolerance);
        c.relative(format!("{name}: kinetic energy(0.16) [J]"), kinetic, expected[2], tolerance);
    }
    c.into_report()
}

/// E6: a mass strikes a beam at midspan and remains on it (Saint-Venant): largest deflections from the modes of beam and mass.
pub fn mass_that_stays() -> Report {
    let mut c = Checks::new();
    for (name, kind, mu, expected) in [
        ("pinned, mass ratio 1", SupportKind::Pin, 1.0, 0.119_323_77),
        ("pinned, mass ratio 2", SupportKind::Pin, 2.0, 0.182_183_75),
        ("clamped, mass ratio 1", SupportKind::Clamp, 1.0, 0.061_866_62),
    ] {
        let (length, mass_per_length, bending) = (3.0_f64, 300.0_f64, 2e9 * 8.33e-5);
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", 2e9, 3e3));
        let mut section = Section::new("s", 0.1, 8.33e-5);
        section.rotary_inertia = RotaryInertia::Neglected;
        let section = b.section(section);
        let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [length, 0.0]], 64, material, section));
        for (end, f) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(end, at(end, beam, f), kind.clone()));
        }
        let (middle, mass) = (at("middle", beam, 0.5), mu * mass_per_length * length);
        let (velocity, scale) = (1e-3, length * length * f64::sqrt(mass_per_length / bending));
        let step = 4e-5 * scale;
        b.point_mass(PointMass {
            name: "mass".into(),
            at: middle.clone(),
            mass,
            rotary_inertia: 0.0,
        });
        // The momentum of the mass is applied within the first step.
        let force = [0.0, mass * velocity / step];
        let kind = LoadKind::Point { at: middle.clone(), force, moment: 0.0, follower: false };
        b.load(Load { until: step, ..Load::new("blow", kind) });
        b.record_point(middle);
        let model = b.build().expect("a verification case builds");
        let settings = Settings::new(0.6 * scale, step);
        let largest = simulate(&model, &settings, &mut NoRecorder)
            .ok()
            .map(|summary| summary.points[0].displacement_max[1].value);
        let measured = or_nan(largest) / (velocity * scale);
        c.relative(format!("{name}: largest deflection"), measured, expected, 1e-3);
    }
    c.into_report()
}
