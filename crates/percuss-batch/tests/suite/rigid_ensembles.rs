//! Runs with a rigid projectile in lanes: the results of single runs, and the same bits alone and beside others.

use crate::common;

use common::{at, beam};
use percuss::*;
use percuss_batch::*;

/// Values that differ between the runs.
#[derive(Clone, Copy)]
struct Variant {
    speed: f64,
    mass: f64,
    restitution: f64,
    standoff: f64,
    step: f64,
    end: f64,
}

/// A clamped plank struck at midspan from above and, with `second`, also at another point.
fn model(v: Variant, second: Option<ProjectileKind>, gravity: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 2e11, 3e3));
    let section = b.section(Section::new("s", 0.1, 8.33e-5));
    let g = b.beam(beam("g", [0.0; 2], [3.0, 0.0], 6, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, g, f), SupportKind::Clamp));
    }
    let rigid = ProjectileKind::Rigid { restitution: v.restitution };
    let projectile = Projectile::new("mass", rigid, v.mass, [0.0, -v.speed], at("mid", g, 0.5));
    let direction = Some([0.0, -1.0]); // a projectile at rest needs a direction
    b.projectile(Projectile { standoff: v.standoff, direction, ..projectile });
    if let Some(kind) = second {
        let velocity = [0.0, -0.5 * v.speed];
        let projectile = Projectile::new("other", kind, v.mass, velocity, at("side", g, 0.3));
        b.projectile(Projectile { standoff: 0.7 * v.standoff, ..projectile });
    }
    if gravity > 0.0 {
        b.load(Load::new("gravity", LoadKind::Gravity { acceleration: [0.0, -gravity] }));
    }
    b.build().unwrap()
}

/// Pseudo-random numbers between 0 and 1.
fn draws(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as f64 / (1_u64 << 31) as f64
    }
}

fn variants(count: usize, seed: u64) -> Vec<Variant> {
    let mut draw = draws(seed);
    let variant = |k: usize| Variant {
        speed: 20.0 + 40.0 * draw(),
        mass: 50.0 + 150.0 * draw(),
        restitution: [0.0, 1.0, 0.25, 0.5, 0.75][k % 5],
        standoff: 0.02 * draw(),
        step: if k % 7 == 3 { 1.3e-5 } else { 1e-5 },
        // Lanes are refilled while other runs continue.
        end: 0.006 + 0.004 * draw(),
    };
    (0..count).map(variant).collect()
}

fn settings(variants: &[Variant]) -> Vec<Settings> {
    let each = variants.iter().enumerate();
    each.map(|(k, v)| Settings { record_every: 1 + k % 3, ..Settings::new(v.end, v.step) })
        .collect()
}

type RigidRecord<'a> = (&'a [Impact], &'a [ContactInterval], f64);

fn rigid_record(summary: &RunSummary) -> RigidRecord<'_> {
    match &summary.contacts[0].record {
        ContactRecord::Nonsmooth { impacts, intervals, impulse_total, .. } => {
            (impacts, intervals, *impulse_total)
        }
        ContactRecord::Smooth { .. } => panic!("a rigid contact"),
    }
}

/// All numbers of impacts and intervals, of points and of the balance; those of the contact relative to the largest of them.
fn numbers(s: &RunSummary) -> Vec<(&'static str, f64, f64)> {
    let (impacts, intervals, total) = rigid_record(s);
    // Approach velocities below a millimetre per second belong to a projectile that rests on the beam.
    let speed = impacts.iter().map(|i| i.approach_velocity).fold(1e-3, f64::max);
    let energy = s.energy.scale;
    let mut all = vec![
        ("time", s.time, s.time),
        ("energy", s.energy.final_, energy),
        ("loss", s.energy.loss_impacts, energy),
        ("work", s.energy.work_loads, energy),
        ("scale", energy, energy),
        ("impulses", total, total),
    ];
    for p in &s.projectiles {
        all.push(("velocity", p.velocity_final[1], speed));
        all.push(("momentum", p.momentum_transferred, total));
        all.push(("given", p.energy_given, energy));
        all.push(("received", p.energy_received_by_others, energy));
    }
    for i in impacts.iter().take(FEW) {
        all.extend([("at", i.time, i.time), ("impulse", i.impulse, total)]);
        all.extend([("in", i.approach_velocity, speed), ("out", i.separation_velocity, speed)]);
        all.extend([
            ("to beam", i.energy.given[0], energy),
            ("to mass", i.energy.given[1], energy),
        ]);
        all.extend([("lost", i.energy.lost, energy), ("s", i.place.s, 1.0)]);
        all.push(("place", i.place.position[1], 3e-2));
    }
    for i in intervals.iter().filter(|_| impacts.len() <= FEW) {
        all.extend([("from", i.start, i.start), ("until", i.end, i.start)]);
        all.extend([("rest", i.impulse, total), ("parts", i.separation_velocity, speed)]);
        all.extend([("gave", i.energy.given[0], energy), ("stored", i.energy.stored, energy)]);
        all.extend([("place", i.place.position[1], 3e-2), ("end", i.place_end.position[1], 3e-2)]);
    }
    for top in s.points.iter().flat_map(|p| p.displacement_max) {
        all.push(("peak", top.value, 1e-2));
        // The instant of the largest round-off is arbitrary.
        all.push(("peak at", if top.value.abs() > 1e-9 { top.time } else { 0.0 }, s.time));
    }
    all
}

fn counts(s: &RunSummary) -> Vec<usize> {
    let (impacts, intervals, _) = rigid_record(s);
    let mut all = vec![s.steps, s.step_cuts, s.accumulated_steps, s.multiple_impacts.count];
    if impacts.len() <= FEW {
        all.extend([s.solver_steps, s.rows, impacts.len(), intervals.len()]);
        all.extend(intervals.iter().map(|i| i.steps));
    }
    all
}

/// Whether a run was computed in a lane: its iterations differ from those of a single run, and it has no section forces.
fn was_in_a_lane(single: &RunSummary, found: &RunSummary) -> bool {
    single.newton_iterations != found.newton_iterations
        || single.factorizations != found.factorizations
}

#[track_caller]
fn agree(single: &RunSummary, found: &RunSummary, tolerance: f64, run: usize) {
    assert!(matches!(found.termination, Termination::Completed));
    assert!(was_in_a_lane(single, found), "run {run} was not stepped by an ensemble");
    assert!(found.energy.residual_max < 1e-11 && found.momentum.linear_residual_max < 1e-11);
    assert!(found.momentum.angular_residual_max < 1e-11);
    assert_eq!(counts(single), counts(found), "run {run}");
    crate::scales::agree(single, found);
    let (a, b) = (numbers(single), numbers(found));
    assert_eq!(a.len(), b.len());
    for ((name, a, scale), (_, b, _)) in a.iter().zip(&b) {
        let near = (a - b).abs() <= tolerance * scale.abs() || (a.is_nan() && b.is_nan());
        assert!(near, "run {run}: {name}: {a} {b}");
    }
}

/// Number of impacts up to which a run is nearly as accurate as without impacts; times and number of later ones depend on round-off.
const FEW: usize = 8;

/// Tolerance for the runs: each of many impacts magnifies the error of the previous one.
fn known(single: &RunSummary) -> f64 {
    if rigid_record(single).0.len() <= FEW { 1e-9 } else { 1e-5 }
}

fn batch(models: &[Model], settings: &[Settings]) -> Vec<RunSummary> {
    let runs: Vec<(&Model, &Settings)> = models.iter().zip(settings).collect();
    simulate_batch(&runs, Detail::Motion).into_iter().map(Result::unwrap).collect()
}

fn single(model: &Model, settings: &Settings) -> RunSummary {
    simulate(model, settings, &mut NoRecorder).unwrap()
}

#[test]
fn lanes_strike_as_single_runs_do() {
    let variants = variants(40, 7);
    let models: Vec<Model> = variants.iter().map(|v| model(*v, None, 0.0)).collect();
    let settings = settings(&variants);
    let (mut impacts, mut rests) = (0, 0);
    for (k, found) in batch(&models, &settings).iter().enumerate() {
        let single = single(&models[k], &settings[k]);
        agree(&single, found, known(&single), k);
        impacts += rigid_record(found).0.len();
        rests += rigid_record(found).1.len();
    }
    assert!(impacts > 80 && rests > 10, "{impacts} impacts, {rests} rests");
}

#[test]
fn lanes_see_only_themselves_in_whatever_order_and_company() {
    let variants = variants(25, 11);
    let rigid: Vec<Model> = variants.iter().map(|v| model(*v, None, 0.0)).collect();
    let settings = settings(&variants);
    let text = |s: &RunSummary| format!("{s:?}"); // contains every float exactly
    let together: Vec<String> = batch(&rigid, &settings).iter().map(text).collect();
    let mut runs: Vec<(&Model, &Settings)> = rigid.iter().zip(&settings).collect();
    runs.reverse();
    let reversed = simulate_batch(&runs, Detail::Motion);
    for (k, found) in reversed.iter().rev().enumerate() {
        assert_eq!(text(found.as_ref().unwrap()), together[k], "run {k} in another order");
    }
    for k in 0..rigid.len() {
        let alone = batch(&rigid[k..=k], &settings[k..=k]);
        assert_eq!(text(&alone[0]), together[k], "run {k} alone");
    }
    // With compliant contacts between them, and some models that are computed as single runs.
    let spring = ProjectileKind::spring(7.5e7);
    let others: Vec<Model> = variants
        .iter()
        .enumerate()
        .map(|(k, v)| {
            let second = (k % 3 > 0).then(|| spring.clone());
            let twice = ProjectileKind::Rigid { restitution: 0.5 };
            model(*v, if k % 9 == 5 { Some(twice) } else { second }, 0.0)
        })
        .collect();
    let both = rigid.iter().zip(&others).zip(&settings);
    let mixed: Vec<(&Model, &Settings)> =
        both.flat_map(|((a, b), settings)| [(a, settings), (b, settings)]).collect();
    let found = simulate_batch(&mixed, Detail::Motion);
    for (k, found) in found.iter().step_by(2).enumerate() {
        assert_eq!(text(found.as_ref().unwrap()), together[k], "run {k} among others");
    }
}

#[test]
fn an_elastic_projectile_strikes_beside_a_rigid_one() {
    let variants = variants(12, 23);
    let spring = ProjectileKind::spring(7.5e7);
    let models: Vec<Model> =
        variants.iter().map(|v| model(*v, Some(spring.clone()), 0.0)).collect();
    let settings = settings(&variants);
    for (k, found) in batch(&models, &settings).iter().enumerate() {
        let single = single(&models[k], &settings[k]);
        agree(&single, found, known(&single), k);
        let touches = |s: &RunSummary| match &s.contacts[1].record {
            ContactRecord::Smooth { peak_force, intervals } => (*peak_force, intervals.len()),
            ContactRecord::Nonsmooth { .. } => panic!("an elastic contact"),
        };
        let ((a, m), (b, n)) = (touches(&single), touches(found));
        assert_eq!(m, n);
        assert!((a.value - b.value).abs() <= known(&single) * a.value, "{k}: {a:?} {b:?}");
    }
}

/// The contact of a projectile under its weight is closed from the start, or closes when it comes to rest on the beam.
#[test]
fn gravity_lays_projectiles_down_in_lanes_too() {
    let lies = Variant {
        speed: 0.0,
        mass: 100.0,
        restitution: 0.5,
        standoff: 0.0,
        step: 1e-5,
        end: 0.004,
    };
    let falls = Variant { speed: 0.05, restitution: 0.0, standoff: 1e-5, ..lies };
    let models = [lies, falls].map(|v| model(v, None, 9.81));
    let settings = [lies, falls].map(|v| Settings::new(v.end, v.step));
    for (k, found) in batch(&models, &settings).iter().enumerate() {
        let single = single(&models[k], &settings[k]);
        assert!(!rigid_record(&single).1.is_empty(), "nothing rests");
        agree(&single, found, 1e-6, k);
    }
}

/// A run that reaches the Zeno limit has the same bits as a single run, and does not affect other runs.
#[test]
fn events_unknown_to_lanes_run_singly() {
    let usual = variants(5, 3)[3];
    let heavy = Variant { restitution: 0.9, standoff: 1e-4, speed: 10.0, mass: 1000.0, ..usual };
    let coarse = Variant { step: 1e-3, end: 0.03, ..heavy };
    let models = [usual, coarse, usual].map(|v| model(v, None, 9.81));
    let settings = [usual, coarse, usual].map(|v| Settings::new(v.end, v.step));
    let found = batch(&models, &settings);
    let single = single(&models[1], &settings[1]);
    assert!(single.accumulated_steps > 0, "impacts do not accumulate");
    assert_eq!(found[1].accumulated_steps, single.accumulated_steps);
    assert_eq!(found[1].energy, single.energy);
    let alone = batch(&models[..1], &settings[..1]);
    for k in [0, 2] {
        assert_eq!(format!("{:?}", found[k]), format!("{:?}", alone[0]));
    }
}
