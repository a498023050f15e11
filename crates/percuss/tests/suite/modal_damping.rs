//! Modal damping acts on deformation alone: rigid motions of bodies and steady motions of supports are left as they are.

use crate::common;

use common::at;
use common::straight::*;
use percuss::*;

/// A free bar of 60 kg and 2 m, with ratios of modal damping.
fn free_bar(ratios: Vec<f64>) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", YOUNG, DENSITY));
    let section = b.section(Section::new("s", AREA, INERTIA));
    b.beam(Beam::new("beam", &[[0.0, 0.0], [2.0, 0.0]], 8, material, section));
    b.modal_damping(ratios);
    b.build().unwrap()
}

/// Runs to the end with the balances checked after every step.
fn run(simulation: &mut Simulation<'_>) {
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
        assert!(ledger.loss_damping >= 0.0);
    }
}

#[test]
fn momenta_of_a_free_body_are_kept_and_its_vibration_dies() {
    let model = free_bar(vec![0.1; 12]);
    let mut simulation = Simulation::new(&model, &Settings::new(1.5, 1e-3)).unwrap();
    // Spin, flight and a bend that is not small.
    let (spin, flight) = (8.0, [2.0, -1.0]);
    simulation.set_velocities(|_, x| {
        let bend = 3.0 * (std::f64::consts::PI * x[0]).cos();
        [flight[0], flight[1] + spin * (x[0] - 1.0) + bend]
    });
    let start = *simulation.measures();
    run(&mut simulation);
    let (end, ledger) = (simulation.measures(), &simulation.state().ledger);
    for i in 0..2 {
        let off = (end.linear[i] - start.linear[i]).abs();
        assert!(off <= 1e-12 * start.linear_size, "{off} of {}", start.linear_size);
    }
    // About the origin, from which the body moves away.
    let off = (end.angular - start.angular).abs();
    assert!(off <= 1e-12 * start.linear_size * 4.0, "{off} of {}", start.angular);
    assert!(ledger.impulse_damping.iter().all(|p| p.abs() <= 1e-12 * start.linear_size));
    // The rest is translation and spin: L^2 / 2I about the centre of mass.
    let mass = 60.0;
    let velocity = end.linear.map(|p| p / mass);
    let centre = [1.0 + velocity[0] * 1.5, velocity[1] * 1.5];
    let about = end.angular - (centre[0] * end.linear[1] - centre[1] * end.linear[0]);
    let inertia = mass * 4.0 / 12.0 + DENSITY * INERTIA * 2.0;
    let speed = velocity[0].hypot(velocity[1]);
    let rigid = 0.5 * mass * speed * speed + 0.5 * about * about / inertia;
    close(end.kinetic_beams, rigid, 1e-3);
    assert!(ledger.loss_damping > 10.0, "{}", ledger.loss_damping);
}

#[test]
fn modes_of_a_body_that_has_turned_die_out_by_their_ratio() {
    let zeta = 0.02;
    let decay = |spin: f64| {
        let model = free_bar(vec![zeta; 12]);
        let rest = Simulation::new(&model, &Settings::new(1.0, 1e-3)).unwrap();
        let all = modes_about(&model, rest.state(), 4);
        let mode = all.iter().find(|m| m.eigenvalue > 0.0).unwrap();
        let period = 1.0 / mode.frequency();
        let settings = Settings::new(10.0 * period, period / 400.0);
        let mut simulation = Simulation::new(&model, &settings).unwrap();
        let positions = model.beam_nodes("beam").unwrap();
        simulation.set_velocities(|_, x| {
            let n = positions.iter().position(|p| *p == x).unwrap();
            [0.0, spin * (x[0] - 1.0) + 5.0 * mode.shape[n][1]]
        });
        let inertia = 60.0 * 4.0 / 12.0 + DENSITY * INERTIA * 2.0;
        let rigid = |m: &Measures| {
            let about = m.angular - m.linear[1];
            0.5 * about * about / inertia + 0.5 * m.linear[1] * m.linear[1] / 60.0
        };
        let start = simulation.measures().total() - rigid(simulation.measures());
        run(&mut simulation);
        let m = simulation.measures();
        // The mass's centre is at rest: the bar receives no momentum.
        ((m.total() - rigid(m)) / start).sqrt()
    };
    let expected = (-20.0 * std::f64::consts::PI * zeta).exp();
    close(decay(0.0), expected, 2e-2);
    // It turns by 1.7 rad, slowly beside its vibration.
    close(decay(4.0), expected, 2e-2);
}

#[test]
fn a_pendulum_swings_undamped() {
    let drop = |ratios: Vec<f64>| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", YOUNG, DENSITY));
        let section = b.section(Section::new("s", AREA, INERTIA));
        let rod = b.beam(Beam::new("rod", &[[0.0, 0.0], [2.0, 0.0]], 6, material, section));
        b.support(Support::new("pin", at("pin", rod, 0.0), SupportKind::Pin));
        let kind = LoadKind::Gravity { acceleration: [0.0, -9.81] };
        b.load(Load::new("weight", kind));
        b.modal_damping(ratios);
        let model = b.build().unwrap();
        let mut simulation = Simulation::new(&model, &Settings::new(2.0, 2e-3)).unwrap();
        run(&mut simulation);
        let ledger = &simulation.state().ledger;
        (simulation.state().displacement[6], ledger.loss_damping, ledger.work_loads)
    };
    let (free, _, _) = drop(Vec::new());
    let (damped, loss, _) = drop(vec![0.05; 6]);
    for i in 0..2 {
        assert!((free[i] - damped[i]).abs() < 2e-2, "{free:?} {damped:?}");
    }
    // Of some 590 J that come and go a rod that bends by a few millimetres loses little.
    assert!(loss < 1.0, "{loss}");
}

/// A mast whose foot moves according to a time function, in metres.
fn on_a_sledge(function: &TimeFunction, initial: f64, ratio: f64) -> Model {
    beam(8, |b, beam| {
        let mut root = Support::new("root", at("root", beam, 0.0), SupportKind::Clamp);
        root.motion =
            Some(Motion { displacement: [0.0, 1.0], rotation: 0.0, function: function.clone() });
        b.support(root);
        let velocity = [0.0, initial];
        b.initial_motion(InitialMotion { velocity, spin: 0.0, about: [0.0; 2] });
        b.modal_damping(vec![ratio; 6]);
    })
}

#[test]
fn a_support_that_moves_steadily_brakes_nothing() {
    // A table that continues at 2 m/s, like the structure.
    let table =
        |values: Vec<f64>| TimeFunction::Table { times: vec![0.0, 100.0], values, smooth: false };
    let model = on_a_sledge(&table(vec![0.0, 200.0]), 2.0, 0.5);
    let mut simulation = Simulation::new(&model, &Settings::new(2.0, 1e-3)).unwrap();
    run(&mut simulation);
    for u in &simulation.state().displacement {
        assert!((u[1] - 4.0).abs() < 1e-10 && u[3].abs() < 1e-10, "{u:?}");
    }
    assert!(simulation.state().ledger.loss_damping < 1e-18);
}

#[test]
fn vibration_on_a_moving_support_is_that_on_one_at_rest() {
    let settle = |speed: f64| {
        let function = TimeFunction::Table {
            times: vec![0.0, 100.0],
            values: vec![0.0, 100.0 * speed],
            smooth: false,
        };
        let model = on_a_sledge(&function, speed, 0.05);
        let mut simulation = Simulation::new(&model, &Settings::new(0.3, 1e-3)).unwrap();
        simulation.set_velocities(|_, x| [0.0, speed + 0.5 * x[0] * x[0]]);
        run(&mut simulation);
        let tip = simulation.state().displacement[8][1] - 0.3 * speed;
        (tip, simulation.state().ledger.loss_damping)
    };
    let (still, moving) = (settle(0.0), settle(30.0));
    assert!((still.0 - moving.0).abs() < 1e-9, "{still:?} {moving:?}");
    close(moving.1, still.1, 1e-7);
}

#[test]
fn a_blade_on_a_hub_that_turns_steadily_is_not_braked() {
    let spin = 6.0;
    let model = beam(8, |b, beam| {
        let mut hub = Support::new("hub", at("hub", beam, 0.0), SupportKind::Clamp);
        let function = TimeFunction::Table {
            times: vec![0.0, 10.0],
            values: vec![0.0, 10.0 * spin],
            smooth: false,
        };
        hub.motion = Some(Motion { displacement: [0.0; 2], rotation: 1.0, function });
        b.support(hub);
        b.initial_motion(InitialMotion { velocity: [0.0; 2], spin, about: [0.0; 2] });
        b.modal_damping(vec![0.05; 8]);
    });
    let mut simulation = Simulation::new(&model, &Settings::new(1.0, 1e-3)).unwrap();
    run(&mut simulation);
    // Only the stretching by centrifugal forces, of 0.1 J, rings; the spin's energy is 1440 J.
    let loss = simulation.state().ledger.loss_damping;
    assert!(loss < 0.5, "{loss}");
    let tip = simulation.state().displacement[8];
    let expected = [2.0 * spin.cos() - 2.0, 2.0 * spin.sin()];
    for i in 0..2 {
        assert!((tip[i] - expected[i]).abs() < 2e-3, "{tip:?} {expected:?}");
    }
}

#[test]
fn supports_that_move_slowly_against_each_other_are_followed() {
    // A beam clamped at both ends; one of them moves up by 20 mm in 2 s, uniformly after a soft start.
    let model = beam(8, |b, beam| {
        clamp(b, beam);
        let mut end = Support::new("end", at("end", beam, 1.0), SupportKind::Clamp);
        let function = TimeFunction::Table {
            times: vec![0.0, 0.5, 2.0, 4.0],
            values: vec![0.0, 0.002, 0.02, 0.044],
            smooth: true,
        };
        end.motion = Some(Motion { displacement: [0.0, 1.0], rotation: 0.0, function });
        b.support(end);
        b.modal_damping(vec![0.9; 6]);
    });
    let mut simulation = Simulation::new(&model, &Settings::new(2.0, 1e-3)).unwrap();
    run(&mut simulation);
    // Dampers to the ground would resist: with omega = 144 /s, a generalized mass of about 24 kg and 12 mm/s they would dissipate 2 x 0.9 x 144 x
    // 24 x (6 mm/s)^2 x 2 s = 0.4 J and more.
    let loss = simulation.state().ledger.loss_damping;
    assert!(loss < 4e-3, "{loss}");
    // In the middle as in a static beam: half of the motion of the end.
    let middle = simulation.state().displacement[4];
    assert!((middle[1] - 0.01).abs() < 2e-5, "{middle:?}");
}

#[test]
fn a_body_that_its_support_has_let_go_flies_on_undamped() {
    let model = beam(6, |b, beam| {
        let mut root = Support::new("root", at("root", beam, 0.0), SupportKind::Clamp);
        root.until = 0.0505;
        b.support(root);
        b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
        b.modal_damping(vec![0.1; 8]);
    });
    let mut simulation = Simulation::new(&model, &Settings::new(1.0, 1e-3)).unwrap();
    let mut released = None;
    while simulation.state().step < simulation.step_count() {
        simulation.advance(&mut NoRecorder).unwrap();
        if simulation.state().time > 0.0515 && released.is_none() {
            released = Some((simulation.state().time, simulation.state().ledger.impulse_damping));
        }
    }
    let (_, before) = released.unwrap();
    let after = simulation.state().ledger.impulse_damping;
    // Weight has given 560 N s since.
    for i in 0..2 {
        assert!((after[i] - before[i]).abs() < 1e-11, "{before:?} {after:?}");
    }
}

#[test]
fn a_mechanism_is_refused() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", YOUNG, DENSITY));
    let section = b.section(Section::new("s", AREA, INERTIA));
    let one = b.beam(Beam::new("one", &[[0.0, 0.0], [2.0, 0.0]], 4, material, section));
    let two = b.beam(Beam::new("two", &[[2.0, 0.0], [4.0, 0.0]], 4, material, section));
    b.support(Support::new("pin", at("pin", one, 0.0), SupportKind::Pin));
    let between = [at("end", one, 1.0), at("begin", two, 0.0)];
    b.joint(Joint::new("knee", JointKind::Hinge, between));
    b.modal_damping(vec![0.02; 4]);
    let model = b.build().unwrap();
    let faults = Simulation::new(&model, &Settings::new(0.1, 1e-3)).unwrap_err();
    assert_eq!(faults.len(), 1);
    assert_eq!(faults[0].path, "damping.modal");
    assert!(faults[0].found.contains("2 independent motions without strain, of which 1"));
}
