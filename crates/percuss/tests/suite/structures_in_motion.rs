//! Damping, moving and released supports, and starts of a transient, each compared with a closed form.

use crate::common;

use common::at;
use common::straight::*;
use percuss::*;

/// Steps a model and returns the simulation at its end.
fn run<'m>(model: &'m Model, end: f64, step: f64) -> Simulation<'m> {
    let mut simulation = Simulation::new(model, &Settings::new(end, step)).unwrap();
    while simulation.state().step < simulation.step_count() {
        simulation.advance(&mut NoRecorder).unwrap();
        let (ledger, m) = (&simulation.state().ledger, simulation.measures());
        let missing = ledger.energy_residual(m).abs();
        let t = simulation.state().time;
        assert!(
            missing <= 1e-11 * ledger.energy_scale,
            "{missing} of {} at {t}",
            ledger.energy_scale
        );
    }
    simulation
}

#[test]
fn mass_proportional_damping_slows_free_flight_exponentially() {
    let mut b = ModelBuilder::new();
    let damped = Material { mass_damping: 3.0, ..Material::new("m", YOUNG, DENSITY) };
    let material = b.material(damped);
    let section = b.section(Section::new("s", AREA, INERTIA));
    b.beam(Beam::new("beam", &[[0.0, 0.0], [2.0, 0.0]], 4, material, section));
    b.initial_motion(InitialMotion { velocity: [3.0, -1.0], spin: 0.0, about: [0.0; 2] });
    let model = b.build().unwrap();
    let end = run(&model, 0.5, 1e-3);
    let mass = DENSITY * AREA * 2.0;
    let slower = (-1.5_f64).exp();
    close(end.measures().linear[0], 3.0 * mass * slower, 1e-5);
    close(end.state().ledger.loss_damping, 0.5 * mass * 10.0 * (1.0 - slower * slower), 1e-5);
    let linear = end.state().ledger.linear_residual(end.measures());
    assert!(linear[0].abs() < 1e-10 && linear[1].abs() < 1e-10);
}

/// Amplitude after ten periods of the lowest mode, relative to the start.
fn decay(retardation: f64, ratios: Vec<f64>) -> f64 {
    let mut b = ModelBuilder::new();
    let material = b.material(Material { retardation, ..Material::new("m", YOUNG, DENSITY) });
    let section = b.section(Section::new("s", AREA, INERTIA));
    let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [2.0, 0.0]], 8, material, section));
    clamp(&mut b, beam);
    b.modal_damping(ratios);
    b.record_point(at("tip", beam, 1.0));
    let model = b.build().unwrap();
    let rest = Simulation::new(&model, &Settings::new(1.0, 1e-3)).unwrap();
    let mode = modes_about(&model, rest.state(), 1).remove(0);
    let period = 1.0 / mode.frequency();
    let mut simulation =
        Simulation::new(&model, &Settings::new(10.0 * period, period / 400.0)).unwrap();
    // Starts in its lowest mode, moving: slopes are those of the nodes' shape to the mesh's accuracy.
    let positions = model.beam_nodes("beam").unwrap();
    simulation.set_velocities(|_, x| {
        let n = positions.iter().position(|p| *p == x).unwrap();
        [1e-4 * mode.shape[n][0], 1e-4 * mode.shape[n][1]]
    });
    let start = simulation.measures().total();
    while simulation.state().step < simulation.step_count() {
        simulation.advance(&mut NoRecorder).unwrap();
    }
    (simulation.measures().total() / start).sqrt()
}

#[test]
fn modes_die_out_by_their_ratio() {
    // After ten periods: exp(-2 pi 10 zeta). The start is the mode but for its slopes.
    let none = decay(0.0, Vec::new());
    assert!((none - 1.0).abs() < 1e-10);
    let zeta = 0.02;
    let expected = (-20.0 * std::f64::consts::PI * zeta).exp();
    let modal = decay(0.0, vec![zeta; 30]);
    close(modal, expected, 2e-3);
    // Kelvin-Voigt: zeta = omega tau / 2.
    let omega = 1.875_104_07_f64.powi(2) * (BENDING / (DENSITY * AREA * 16.0)).sqrt();
    let viscous = decay(2.0 * zeta / omega, Vec::new());
    close(viscous, expected, 3e-2);
}

#[test]
fn a_shaken_support_moves_as_prescribed_and_does_the_work() {
    let model = beam(6, |b, beam| {
        let mut root = Support::new("root", at("root", beam, 0.0), SupportKind::Clamp);
        root.motion = Some(Motion {
            displacement: [0.0, 0.02],
            rotation: 0.3,
            function: TimeFunction::Harmonic { frequency: 5.0, phase: 0.0 },
        });
        b.support(root);
        b.record_point(at("root", beam, 0.0));
    });
    let end = run(&model, 0.33, 1e-3);
    let f = (10.0 * std::f64::consts::PI * 0.33).sin();
    let u = end.state().displacement[0];
    assert!((u[1] - 0.02 * f).abs() < 1e-14 && u[0].abs() < 1e-15);
    let angle = u[3].atan2(1.0 + u[2]);
    assert!((angle - 0.3 * f).abs() < 1e-12, "{angle}");
    assert!(end.state().ledger.work_supports > 0.0);
}

#[test]
fn a_support_that_lets_go_leaves_a_free_flight() {
    let model = beam(6, |b, beam| {
        let mut root = Support::new("root", at("root", beam, 0.0), SupportKind::Clamp);
        root.until = 0.0505;
        b.support(root);
        // An elastic support that takes the energy of its springs with it when released.
        let kind = SupportKind::Elastic {
            direction: [1.0, 0.0],
            stiffness: [0.0, 2e3],
            damping: [0.0; 2],
            rotational_stiffness: 0.0,
            rotational_damping: 0.0,
        };
        b.support(Support { until: 0.07, ..Support::new("spring", at("tip", beam, 1.0), kind) });
        let kind = LoadKind::Gravity { acceleration: [0.0, -9.81] };
        b.load(Load::new("weight", kind));
    });
    let end = run(&model, 0.2, 1e-3);
    let held = end.state().reactions[0];
    let before = run(&model, 0.06, 1e-3).state().reactions[0];
    assert_eq!(held, before, "nothing holds after the release");
    let mass = DENSITY * AREA * 2.0;
    let momentum = end.measures().linear[1];
    // Weight throughout, supports until their release.
    let supports: f64 = end.state().reactions.iter().map(|r| r[1]).sum();
    close(momentum, -mass * 9.81 * 0.2 + supports, 1e-10);
}

#[test]
fn a_transient_from_static_equilibrium_stays_there() {
    let model = beam(8, |b, beam| {
        clamp(b, beam);
        force(b, beam, 1.0, [-100.0, 300.0], 20.0);
    });
    let settings = Settings { start: Start::Static, ..Settings::new(0.1, 1e-3) };
    let mut simulation = Simulation::new(&model, &settings).unwrap();
    let start = simulation.state().displacement.clone();
    assert!(start[8][1] > 0.01);
    while simulation.state().step < simulation.step_count() {
        simulation.advance(&mut NoRecorder).unwrap();
    }
    for (a, b) in simulation.state().displacement.iter().zip(&start) {
        (0..4).for_each(|i| assert!((a[i] - b[i]).abs() < 1e-9, "{a:?} {b:?}"));
    }
}

#[test]
fn a_structure_stays_at_rest_until_its_load_begins() {
    // Inclined beams: their reference strains are round-off, not zero.
    for k in 0..12 {
        let angle = 0.1 + 0.5 * f64::from(k);
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", 2.1e11, 7850.0));
        let section = b.section(Section::rectangle("s", 0.02, 0.02));
        let start = [0.37 * f64::from(k), -1.3];
        let end = [start[0] + angle.cos(), start[1] + angle.sin()];
        let elements = [1, 4, 10][k as usize % 3];
        let arm = b.beam(Beam::new("arm", &[start, end], elements, material, section));
        clamp(&mut b, arm);
        let kind = LoadKind::Point {
            at: at("tip", arm, 1.0),
            force: [0.0, -100.0],
            moment: 0.0,
            follower: false,
        };
        b.load(Load { from: 1e-3, ..Load::new("late", kind) });
        let model = b.build().unwrap();
        let settings = Settings::new(3e-3, 1e-4);
        let summary = simulate(&model, &settings, &mut NoRecorder).unwrap();
        assert!(matches!(summary.termination, Termination::Completed), "{k}: {summary:?}");
        assert_eq!(summary.step_cuts, 0);
        assert!(summary.energy.residual_max < 1e-12, "{k}: {}", summary.energy.residual_max);
    }
}

#[test]
fn a_ratio_of_zero_leaves_its_mode_alone_and_every_body_is_damped() {
    let bodies = |count: usize, ratios: Vec<f64>| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", YOUNG, DENSITY));
        let section = b.section(Section::new("s", AREA, INERTIA));
        for k in 0..count {
            let y = 3.0 * k as f64;
            let name = format!("beam{k}");
            b.beam(Beam::new(name, &[[0.0, y], [2.0, y]], 6, material, section));
        }
        b.modal_damping(ratios);
        let model = b.build().unwrap();
        let mut simulation = Simulation::new(&model, &Settings::new(0.05, 1e-4)).unwrap();
        simulation.set_velocities(|_, x| [0.0, (2.4 * x[0]).cos()]);
        while simulation.state().step < simulation.step_count() {
            simulation.advance(&mut NoRecorder).unwrap();
        }
        simulation.state().ledger.loss_damping
    };
    assert_eq!(bodies(1, vec![0.0]), 0.0);
    let one = bodies(1, vec![0.1]);
    assert!(one > 0.0);
    // Two bodies have each frequency twice.
    close(bodies(2, vec![0.1, 0.1]), 2.0 * one, 1e-6);
}
