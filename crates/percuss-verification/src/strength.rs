//! Failure of joints at their strength, and fracture of a bar.

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::{at, or_nan, run};
use crate::yielding::balances;

const SIDE: f64 = 0.1;
const LENGTH: f64 = 0.5;
const DENSITY: f64 = 7850.0;
const YOUNG: f64 = 210e9;
const MASS: f64 = DENSITY * SIDE * SIDE * LENGTH;
/// Strengths, half of the final loads, force \[N\] and moment \[N m\].
const STRENGTH: f64 = 5e4;
const TURNED: f64 = 1e3;
/// Time over which the loads grow \[s\], long compared with the periods of the bar.
const RAMP: f64 = 0.4;

/// A bar joined to a stub in a wall, under a force and a moment on its end that grow linearly.
fn hung(kind: JointKind, strength: JointStrength, [force, moment]: [f64; 2]) -> Model {
    let mut b = ModelBuilder::new();
    let metal = b.material(Material::new("metal", YOUNG, DENSITY));
    let section = b.section(Section::rectangle("square", SIDE, SIDE));
    let stub = b.beam(Beam::new("stub", &[[-0.1, 0.0], [0.0, 0.0]], 1, metal, section));
    let bar = b.beam(Beam::new("bar", &[[0.0, 0.0], [LENGTH, 0.0]], 3, metal, section));
    b.support(Support::new("wall", at("wall", stub, 0.0), SupportKind::Clamp));
    let between = [at("root", stub, 1.0), at("heel", bar, 0.0)];
    b.joint(Joint { strength: Some(strength), ..Joint::new("weld", kind, between) });
    let force = [force, 0.0];
    let kind = LoadKind::Point { at: at("tip", bar, 1.0), force, moment, follower: false };
    let function = TimeFunction::Ramp { duration: RAMP };
    b.load(Load { function, ..Load::new("pull", kind) });
    b.build().expect("a verification case builds")
}

/// A joint that fails in tension, and one that fails in bending, by a load that grows linearly to twice the strength S over T: failure is at about
/// T / 2, and the bar then moves freely. From the time t0 to t the work of the force on it is `S^2 (t^2 - t0^2)^2 / (2 m T^2)`, that of the moment
/// the same with the bar's inertia, without the strain energy of bar and stub.
pub fn strong_joints() -> Report {
    let mut c = Checks::new();
    let force = JointStrength { force: Some(STRENGTH), moment: None };
    let moment = JointStrength { force: None, moment: Some(TURNED) };
    let inertia = MASS * (LENGTH * LENGTH + SIDE * SIDE) / 12.0;
    let (pull, turn) = ([2.0 * STRENGTH, 0.0], [0.0, 2.0 * TURNED]);
    let end = 0.75 * RAMP;
    for (name, kind, strength, load, mass) in [
        ("weld pulled", JointKind::Rigid, force, pull, MASS),
        ("hinge pulled", JointKind::Hinge, force, pull, MASS),
        ("weld turned", JointKind::Rigid, moment, turn, inertia),
    ] {
        let most = if load[0] > 0.0 { STRENGTH } else { TURNED };
        let summary = run(&hung(kind, strength, load), &Settings::new(end, 2e-5));
        balances(&mut c, name, &summary);
        let parted = summary.joints.first().and_then(|joint| joint.parted);
        // Bar and stub vibrate from the start of the load, with an amplitude of its rate divided by their circular frequency: 0.24 % in bending.
        let time = or_nan(parted.map(|one| one.time));
        c.relative(format!("{name}: time (s)"), time, 0.5 * RAMP, 5e-3);
        let carried = or_nan(parted.map(|one| if load[0] > 0.0 { one.force } else { one.moment }));
        c.relative(format!("{name}: carried (N or N m)"), carried, most, 1e-3);
        let impulse = most * (end * end - time * time) / RAMP;
        let work = summary.energy.work_loads;
        c.relative(format!("{name}: work (J)"), work, 0.5 * impulse * impulse / mass, 1e-3);
    }
    c.into_report()
}

/// Area of the bar that fails \[m^2\].
const AREA: f64 = 1e-3;

/// A perfectly plastic bar of one element, pulled by a support until all of its fibres fail at once: its plastic work until then, the stored energy
/// that it releases, and zero reaction afterwards.
pub fn failing_bar() -> Report {
    let mut c = Checks::new();
    let (young, limit, fails, rate, length) = (200e9, 250e6, 0.02, 0.1, 1.0);
    for fibres in [4, 10] {
        let mut b = ModelBuilder::new();
        let curve = vec![Hardening { from: 0.0, stress: limit, modulus: 0.0 }];
        let plasticity =
            Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain: Some(fails) };
        // The density is so small that its forces are those of statics.
        let metal = b.material(Material {
            strain: StrainMeasure::Engineering,
            inelasticity: Some(Inelasticity::Plastic(plasticity)),
            ..Material::new("metal", young, 1.0)
        });
        let section = b.section(Section { fibres, ..Section::rectangle("deep", AREA, 1.0) });
        let bar = b.beam(Beam::new("bar", &[[0.0, 0.0], [length, 0.0]], 1, metal, section));
        b.support(Support::new("held", at("held", bar, 0.0), SupportKind::Clamp));
        let components =
            vec![Component::Displacement1, Component::Displacement2, Component::Rotation];
        let function = TimeFunction::function(move |t| rate * t);
        let motion = Motion { displacement: [1.0, 0.0], rotation: 0.0, function };
        let end = Support::new("pulled", at("pulled", bar, 1.0), SupportKind::Fix { components });
        b.support(Support { motion: Some(motion), ..end });
        let model = b.build().expect("a verification case builds");
        let step = 1e-4;
        let settings = Settings::new(1.2 * fails * length / rate, step);
        let mut simulation = Simulation::new(&model, &settings).expect("valid settings");
        simulation.set_velocities(|_, x| [rate * x[0], 0.0]);
        let mut rows = MemoryRecorder::default();
        let summary = simulation.run(&mut rows);
        let name = format!("{fibres} fibres");
        balances(&mut c, &name, &summary);
        let parted = summary.plastic.first().and_then(|beam| beam.parted.first());
        let time = or_nan(parted.map(|one| one.time));
        // The end of the step of failure.
        c.absolute(format!("{name}: time (s)"), time, fails * length / rate, step);
        let stored = 0.5 * limit * limit / young * AREA * length;
        let released = or_nan(parted.map(|one| one.energy));
        c.relative(format!("{name}: released (J)"), released, stored, 1e-6);
        c.relative(format!("{name}: lost by failure (J)"), summary.energy.failure, stored, 1e-6);
        let flowed = limit * (time * rate / length - limit / young) * AREA * length;
        c.relative(format!("{name}: plastic (J)"), summary.energy.plastic, flowed, 1e-6);
        let pull = rows.column("support.pulled.force_1").unwrap_or_default();
        let last = or_nan(pull.last().copied());
        c.absolute(format!("{name}: force at the end (N)"), last, 0.0, 1e-6 * limit * AREA);
        let before = pull.iter().fold(0.0_f64, |most, force| most.max(*force));
        c.relative(format!("{name}: force before (N)"), before, limit * AREA, 1e-6);
    }
    c.into_report()
}
