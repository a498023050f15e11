//! Runs in lanes: the results of single runs, and the same bits alone and beside others.

use crate::common;

use common::{at, beam};
use percuss::*;
use percuss_batch::*;

/// Values that differ between the runs.
#[derive(Clone, Copy)]
struct Variant {
    young: f64,
    speed: f64,
    mass: f64,
    standoff: f64,
    step: f64,
    along: f64,
    retardation: f64,
    mass_damping: f64,
}

const USUAL: Variant = Variant {
    young: 2e9,
    speed: 20.0,
    mass: 500.0,
    // No contact closes at the very end of a step, where round-off would decide whether it closes in that step.
    standoff: 0.200_3,
    step: 1e-4,
    along: 0.5,
    retardation: 0.0,
    mass_damping: 0.0,
};

fn model(v: Variant, law: SmoothLaw, angle: f64, elements: usize) -> Model {
    loaded(v, law, angle, elements, |_, _| {})
}

fn loaded(
    v: Variant,
    law: SmoothLaw,
    angle: f64,
    elements: usize,
    loads: impl Fn(&mut ModelBuilder, BeamId),
) -> Model {
    let mut b = ModelBuilder::new();
    let (retardation, mass_damping) = (v.retardation, v.mass_damping);
    let material = Material { retardation, mass_damping, ..Material::new("m", v.young, 3e3) };
    let section = Section::new("s", 0.1, 8.33e-5);
    let (material, section) = (b.material(material), b.section(section));
    let (sine, cosine) = angle.sin_cos();
    let g = b.beam(beam("g", [0.0; 2], [3.0 * cosine, 3.0 * sine], elements, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, g, f), SupportKind::Clamp));
    }
    let kind = ProjectileKind::Elastic { law };
    let velocity = [-v.speed * sine, v.speed * cosine];
    let projectile = Projectile::new("mass", kind, v.mass, velocity, at("mid", g, v.along));
    b.projectile(Projectile { standoff: v.standoff, ..projectile });
    loads(&mut b, g);
    b.build().unwrap()
}

/// Gravity, also across the line of motion, a base acceleration, a force of limited duration, and an oscillating pressure.
fn loads(b: &mut ModelBuilder, g: BeamId, k: usize) {
    let x = k as f64 / 20.0;
    let gravity = LoadKind::Gravity { acceleration: [-2.0 * x, -9.81] };
    b.load(Load::new("gravity", gravity));
    let (times, values) = (vec![1e-3, 4e-3, 8e-3], vec![0.2, 1.0, 0.4]);
    let function = TimeFunction::Table { times, values, smooth: false };
    let base = LoadKind::Base { acceleration: [3.0, 5.0 - 8.0 * x] };
    b.load(Load { function, ..Load::new("base", base) });
    let push = LoadKind::Point {
        at: at("pushed", g, 0.3),
        force: [1e4 * x, 2e5],
        moment: 0.0,
        follower: false,
    };
    let function = TimeFunction::HalfSine { duration: 7e-3 + 1e-3 * x };
    // It neither begins nor ends at the boundary of a step.
    let (from, until) = (3.33e-3, 9.97e-3);
    b.load(Load { function, from, until, ..Load::new("push", push) });
    let force = [[0.0, -1e4], [1e3, 3e4 * x]];
    let stretch = [Along::Fraction(0.25), Along::Distance(2.9)];
    let swing = LoadKind::Distributed { beam: g, stretch, force, follower: false };
    let function = TimeFunction::Harmonic { frequency: 120.0 + 40.0 * x, phase: x };
    b.load(Load { function, ..Load::new("swing", swing) });
}

fn linear() -> SmoothLaw {
    SmoothLaw::elastic(Potential::Linear { stiffness: 7.5e5 })
}

/// All numbers of a summary that an ensemble provides.
fn numbers(s: &RunSummary) -> Vec<(&'static str, f64)> {
    let mut all = vec![
        ("steps", s.steps as f64),
        ("energy", s.energy.final_),
        ("work of loads", s.energy.work_loads),
        ("damping", s.energy.loss_damping),
        ("scale", s.energy.scale),
        ("velocity", s.projectiles[0].velocity_final[1]),
        ("momentum", s.projectiles[0].momentum_transferred),
        ("given", s.projectiles[0].energy_given),
        ("received", s.projectiles[0].energy_received_by_others),
    ];
    let ContactRecord::Smooth { peak_force, intervals } = &s.contacts[0].record else { panic!() };
    all.extend([("force", peak_force.value), ("force at", peak_force.time)]);
    for i in intervals {
        all.extend([("start", i.start), ("end", i.end), ("impulse", i.impulse)]);
        all.extend([("peak", i.peak_force.value), ("approach", i.approach_velocity)]);
        all.extend([("separation", i.separation_velocity), ("to beam", i.energy.given[0])]);
        all.extend([("to mass", i.energy.given[1]), ("stored", i.energy.stored)]);
        all.extend([("place", i.place.position[1]), ("place end", i.place_end.position[1])]);
    }
    for p in &s.points {
        for top in &p.displacement_max {
            // The instant of the largest round-off is arbitrary.
            let time = if top.value.abs() > 1e-9 { top.time } else { 0.0 };
            all.extend([("displacement", top.value), ("displacement at", time)]);
        }
    }
    all
}

/// All counts of a run except those of the solver.
fn counts(s: &RunSummary) -> Vec<usize> {
    let mut all = vec![s.steps, s.solver_steps, s.step_cuts, s.accumulated_steps, s.rows];
    all.push(s.multiple_impacts.count);
    for contact in &s.contacts {
        let ContactRecord::Smooth { intervals, .. } = &contact.record else { panic!() };
        all.push(intervals.len());
        all.extend(intervals.iter().map(|i| i.steps));
        all.extend(intervals.iter().map(|i| usize::from(i.steady) + 2 * usize::from(i.one_point)));
        all.extend(intervals.iter().map(|i| usize::from(i.restitution().is_ok())));
    }
    for p in &s.points {
        // Whether round-off is resolved is arbitrary.
        let moves =
            p.displacement_max.iter().zip(p.resolved).filter(|(top, _)| top.value.abs() > 1e-9);
        all.extend(moves.map(|(_, resolved)| usize::from(resolved)));
    }
    all
}

#[track_caller]
fn agree(model: &Model, settings: &Settings, found: &RunSummary, tolerance: f64) {
    let single = simulate(model, settings, &mut NoRecorder).unwrap();
    assert!(matches!(found.termination, Termination::Completed));
    assert!(found.supports.is_empty(), "this run was not stepped by an ensemble");
    let [own, other] = [&single, found].map(|run| run.audit.angular_rate_drift_max);
    assert!(own > 0.0 && (own - other).abs() < tolerance * own.max(1e-3), "{own:e} {other:e}");
    assert!(found.energy.residual_max < 1e-11 && found.momentum.linear_residual_max < 1e-11);
    assert!(found.momentum.angular_residual_max < 1e-11);
    assert_eq!(counts(&single), counts(found));
    crate::scales::agree(&single, found);
    let (a, b) = (numbers(&single), numbers(found));
    assert_eq!(a.len(), b.len());
    for ((name, a), (_, b)) in a.iter().zip(&b) {
        let scale = a.abs().max(1e-3);
        assert!(
            (a - b).abs() <= tolerance * scale || (a.is_nan() && b.is_nan()),
            "{name}: {a} {b}"
        );
    }
}

fn variants() -> Vec<Variant> {
    (0..21)
        .map(|k| {
            let x = f64::from(k) / 20.0;
            Variant {
                young: 2e9 * (1.0 + x),
                speed: 5.0 + 30.0 * x,
                mass: 500.0 - 300.0 * x,
                standoff: 0.010_3 + 0.3 * x,
                step: if k % 5 == 0 { 1.3e-4 } else { 1e-4 },
                ..USUAL
            }
        })
        .collect()
}

#[test]
fn an_ensemble_gives_what_single_runs_give_and_lanes_see_only_themselves() {
    let variants = variants();
    let models: Vec<Model> = variants.iter().map(|v| model(*v, linear(), 0.0, 6)).collect();
    let settings: Vec<Settings> = variants.iter().map(|v| Settings::new(0.03, v.step)).collect();
    let runs: Vec<(&Model, &Settings)> = models.iter().zip(&settings).collect();
    let found = simulate_batch(&runs, Detail::Motion);
    for (k, ((model, settings), found)) in runs.iter().zip(&found).enumerate() {
        let found = found.as_ref().unwrap();
        agree(model, settings, found, 1e-9);
        let alone = simulate_batch(&[(*model, *settings)], Detail::Motion).pop().unwrap().unwrap();
        let bits =
            |s: &RunSummary| numbers(s).into_iter().map(|(_, x)| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&alone), bits(found), "run {k}");
        assert_eq!(alone.newton_iterations, found.newton_iterations);
        // The text contains every float exactly, including sums of reactions, which must not depend on the iterations of other lanes.
        assert_eq!(format!("{alone:?}"), format!("{found:?}"), "run {k}");
    }
}

#[test]
fn dead_loads_act_by_the_time_of_each_lane() {
    let variants = variants();
    let model = |(k, v): (usize, &Variant)| loaded(*v, linear(), 0.4, 6, |b, g| loads(b, g, k));
    let models: Vec<Model> = variants.iter().enumerate().map(model).collect();
    // Runs of different length: lanes are refilled while other runs continue.
    let settings = |(k, v): (usize, &Variant)| Settings::new(0.02 + 1e-3 * k as f64, v.step);
    let settings: Vec<Settings> = variants.iter().enumerate().map(settings).collect();
    let runs: Vec<(&Model, &Settings)> = models.iter().zip(&settings).collect();
    for ((model, settings), found) in runs.iter().zip(simulate_batch(&runs, Detail::Motion)) {
        let found = found.unwrap();
        assert!(found.energy.work_loads.abs() > 1.0);
        agree(model, settings, &found, 1e-8);
    }
}

#[test]
fn materials_damp_in_lanes_as_they_do_alone() {
    let variant = |(k, v): (usize, Variant)| {
        let x = k as f64 / 20.0;
        // The first run has only mass-proportional damping, the last only stiffness-proportional damping.
        Variant { retardation: 2e-5 * x, mass_damping: 10.0 * (1.0 - x), ..v }
    };
    let variants: Vec<Variant> = variants().into_iter().enumerate().map(variant).collect();
    let settings = Settings::new(0.03, 1e-4);
    // Elements that are short and long relative to the radius of gyration.
    for elements in [2, 6] {
        let models: Vec<Model> =
            variants.iter().map(|v| model(*v, linear(), 0.4, elements)).collect();
        let runs: Vec<(&Model, &Settings)> = models.iter().map(|m| (m, &settings)).collect();
        for ((model, settings), found) in runs.iter().zip(simulate_batch(&runs, Detail::Motion)) {
            let found = found.unwrap();
            assert!(found.energy.loss_damping > 10.0, "{}", found.energy.loss_damping);
            // Instants at which a contact opens slowly are less accurate: the observed difference is 1.6e-8.
            agree(model, settings, &found, 1e-7);
        }
    }
}

#[test]
fn laws_and_slender_inclined_beams_agree_too() {
    let hertz = SmoothLaw::elastic(Potential::Hertz { stiffness: 2e7 });
    for (law, angle, elements) in [(hertz.clone(), 0.0, 6), (linear(), 0.7, 6), (hertz, -1.1, 13)] {
        let model = model(USUAL, law, angle, elements);
        let settings = Settings::new(0.04, 1e-4);
        let found = simulate_batch(&[(&model, &settings)], Detail::Motion).pop().unwrap().unwrap();
        // Repeated contacts magnify round-off.
        agree(&model, &settings, &found, 1e-6);
    }
}

#[test]
fn models_unknown_to_lanes_run_singly() {
    let dashed = SmoothLaw { dissipation: 0.1, ..linear() };
    let (known, other) = (model(USUAL, linear(), 0.0, 6), model(USUAL, dashed, 0.0, 6));
    let settings = Settings::new(0.02, 1e-4);
    let faulty = Settings::new(0.02, -1.0);
    let turns = loaded(USUAL, linear(), 0.0, 6, |b, g| {
        let at = at("turned", g, 0.5);
        let kind = LoadKind::Point { at, force: [0.0; 2], moment: 100.0, follower: false };
        b.load(Load::new("moment", kind));
    });
    let runs = [(&known, &settings), (&other, &settings), (&known, &faulty), (&turns, &settings)];
    let found = simulate_batch(&runs, Detail::Motion);
    agree(&known, &settings, found[0].as_ref().unwrap(), 1e-9);
    assert!(found[1].as_ref().unwrap().energy.loss_damping > 0.0);
    assert!(found[2].is_err());
    let single = simulate(&turns, &settings, &mut NoRecorder).unwrap();
    assert_eq!(found[3].as_ref().unwrap().energy, single.energy);
    let full = simulate_batch(&runs[..1], Detail::Full);
    assert_eq!(full[0].as_ref().unwrap().supports.len(), 2);
}

/// A contact that never closes has no peak force, in single runs and in lanes: not a force of zero at time zero.
#[test]
fn contacts_that_never_closed_have_no_peak() {
    let far = Variant { standoff: 5.0, ..USUAL };
    let near = Variant { standoff: 0.1, ..USUAL };
    let models = [far, near].map(|v| model(v, linear(), 0.0, 6));
    let settings = Settings { record_every: 7, ..Settings::new(0.02, 1e-4) };
    let runs: Vec<(&Model, &Settings)> = models.iter().map(|m| (m, &settings)).collect();
    let peak = |s: &RunSummary| match &s.contacts[0].record {
        ContactRecord::Smooth { peak_force, .. } => *peak_force,
        ContactRecord::Nonsmooth { .. } => unreachable!(),
    };
    for (k, found) in simulate_batch(&runs, Detail::Motion).into_iter().enumerate() {
        let found = found.unwrap();
        let single = simulate(&models[k], &settings, &mut NoRecorder).unwrap();
        assert_eq!(counts(&single), counts(&found));
        assert_eq!(found.rows, 1 + 200_usize.div_ceil(7));
        for peak in [peak(&found), peak(&single)] {
            assert_eq!(peak.value.is_nan() && peak.time.is_nan(), k == 0, "{peak:?}");
        }
    }
}
