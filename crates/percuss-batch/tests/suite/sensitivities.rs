//! Derivatives of results compared with finite differences of whole runs, including impacts.

use crate::common;

use common::{at, beam};
use percuss::*;
use percuss_batch::*;

/// Names and values of the parameters of both scenes.
const PARAMETERS: [(&str, f64); 13] = [
    ("young", 2e9),
    ("density", 3e3),
    ("area", 0.1),
    ("inertia", 8.33e-5),
    ("length", 3.0),
    ("height of the far end", 0.1),
    ("mass", 200.0),
    ("speed", 20.0),
    // The first impact lies within a step: at its very end the run is not differentiable.
    ("standoff", 0.0207),
    ("where it strikes", 0.52),
    ("stiffness", 7.5e5),
    ("restitution", 0.7),
    // Parameters neither of the model nor of the grid of steps.
    ("end", 0.109_97),
];

#[derive(Clone, Copy, PartialEq)]
enum Law {
    Linear,
    Hertz,
    Rigid,
}

fn scene(p: &[f64; 13], law: Law) -> Model {
    built(p, law, false)
}

/// The beam between clamps or, `framed`, between a rigid corner with a column on springs and a clamp, on a roller between nodes, with a stop.
fn built(p: &[f64; 13], law: Law, framed: bool) -> Model {
    let mut b = ModelBuilder::new();
    // Damping is a parameter. It is so small that impacts remain separate, and none of them is within a change of the end of a step, where the run
    // is not differentiable.
    let (retardation, mass_damping) = (3e-9 * p[1], 1e-2 * p[6]);
    let material = Material { retardation, mass_damping, ..Material::new("m", p[0], p[1]) };
    let material = b.material(material);
    let section = b.section(Section::new("s", p[2], p[3]));
    let g = b.beam(beam("g", [0.0; 2], [p[4], p[5]], 6, material, section));
    b.support(Support::new("right", at("right", g, 1.0), SupportKind::Clamp));
    if framed {
        let column = b.beam(beam("column", [0.1, -2.2], [0.0; 2], 3, material, section));
        let elastic = SupportKind::Elastic {
            direction: [1.0, 0.1],
            stiffness: [0.1 * p[0], 0.2 * p[0]],
            damping: [1e-5 * p[0], 0.0],
            rotational_stiffness: 0.0,
            rotational_damping: 0.0,
        };
        b.support(Support::new("foot", at("foot", column, 0.0), elastic));
        let (direction, gap) = ([0.0, 1.0], 1e-3 * p[4]);
        let stop = SupportKind::Stop { direction, gap, stiffness: 20.0 * p[10], two_sided: false };
        b.support(Support::new("stop", at("stops", g, 0.31), stop));
        let between = [at("top", column, 1.0), at("left", g, 0.0)];
        b.joint(Joint::new("corner", JointKind::Rigid, between));
        let roller = SupportKind::Roller { direction: [p[4], p[5]] };
        b.support(Support::new("roller", at("rolls", g, 0.7 * p[9] / 0.52), roller));
    } else {
        b.support(Support::new("left", at("left", g, 0.0), SupportKind::Clamp));
    }
    let kind = match law {
        Law::Linear => ProjectileKind::spring(p[10]),
        Law::Hertz => ProjectileKind::Elastic {
            law: SmoothLaw::elastic(Potential::Hertz { stiffness: 10.0 * p[10] }),
        },
        Law::Rigid => ProjectileKind::Rigid { restitution: p[11] },
    };
    let projectile = Projectile::new("mass", kind, p[6], [0.0, p[7]], at("struck", g, p[9]));
    b.projectile(Projectile { standoff: p[8], ..projectile });
    // Loads are parameters: weight, and a force that grows with the first parameters.
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [3.0 * p[4], -9.81] }));
    // Across the beam: a force along it would separate its spans, which derivatives do not support.
    let push = p[3] * 3e7 + p[0] * 1e-6;
    let force = [-p[5] * push, p[4] * push];
    let kind = LoadKind::Point { at: at("pushed", g, 0.3), force, moment: 0.0, follower: false };
    b.load(Load::new("push", kind));
    b.build().unwrap()
}

/// Names of the results that are differentiated.
const RESULTS: [&str; 12] = [
    "peak displacement",
    "time of peak displacement",
    "velocity at the end",
    "peak force or last impulse",
    "time of peak force or last impulse",
    "impulse",
    "start of the contact",
    "its end",
    "restitution",
    "effective mass",
    "place",
    "time",
];

fn results(s: &RunSummary) -> [f64; 12] {
    let restitution = match &s.contacts[0].record {
        ContactRecord::Smooth { intervals, .. } => intervals[0].restitution(),
        ContactRecord::Nonsmooth { impacts, .. } => impacts.last().unwrap().restitution(),
    };
    values(s, restitution.unwrap())
}

/// The derivatives of these results; a coefficient of restitution is a quotient.
fn derived(s: &RunSummary, by: &RunSummary) -> [f64; 12] {
    let restitution = match (&s.contacts[0].record, &by.contacts[0].record) {
        (
            ContactRecord::Smooth { intervals: own, .. },
            ContactRecord::Smooth { intervals: by, .. },
        ) => own[0].restitution_derivative(&by[0]),
        (
            ContactRecord::Nonsmooth { impacts: own, .. },
            ContactRecord::Nonsmooth { impacts: by, .. },
        ) => own.last().unwrap().restitution_derivative(by.last().unwrap()),
        _ => unreachable!(),
    };
    values(by, restitution.unwrap())
}

fn values(s: &RunSummary, restitution: f64) -> [f64; 12] {
    let contact = &s.contacts[0];
    let [force, peak, impulse, start, end, place] = match &contact.record {
        ContactRecord::Smooth { peak_force, intervals } => {
            let [first, ..] = intervals.as_slice() else { unreachable!() };
            let Peak { value, time } = *peak_force;
            [value, time, first.impulse, first.start, first.end, first.place.s]
        }
        ContactRecord::Nonsmooth { impacts, impulse_total, .. } => {
            let (first, last) = (&impacts[0], impacts.last().unwrap());
            [last.impulse, last.time, *impulse_total, first.time, last.time, last.place.s]
        }
    };
    let top = s.points[0].displacement_max[1];
    let velocity = s.projectiles[0].velocity_final[1];
    let mass = contact.effective_mass.unwrap().on_mesh;
    [
        top.value,
        top.time,
        velocity,
        force,
        peak,
        impulse,
        start,
        end,
        restitution,
        mass,
        place,
        s.time,
    ]
}

fn check(law: Law, framed: bool, end: f64, tolerance: f64) {
    let scene = |p: &[f64; 13], law: Law| built(p, law, framed);
    let mut base = PARAMETERS.map(|(_, value)| value);
    base[12] = end;
    let settings = |p: &[f64; 13]| Settings::new(p[12], 1e-4);
    let moved = |i: usize, by: f64| {
        let mut p = base;
        p[i] += by;
        p
    };
    let variations: Vec<Variation> = (0..13)
        .map(|i| {
            let change = 1e-3 * base[i];
            let each = [-2.0, -1.0, 1.0, 2.0].map(|k| moved(i, k * change));
            let (models, ends) = (each.map(|p| scene(&p, law)), each.map(|p| p[12]));
            Variation { size: base[i], differences: vec![Difference { models, ends, change }] }
        })
        .collect();
    let found = sensitivities(&scene(&base, law), &settings(&base), &variations).unwrap();
    assert_eq!(found.horizon, None);
    let run =
        |p: &[f64; 13]| results(&simulate(&scene(p, law), &settings(p), &mut NoRecorder).unwrap());
    let (single, mut off) = (run(&base), Vec::new());
    assert_eq!(results(&found.summary), single);
    for (i, (name, value)) in PARAMETERS.iter().enumerate() {
        // Differences of fourth order: the changes are small enough that results are quartics, smallest for the struck point, and large enough for
        // the accuracy of located instants of impact.
        let share = match *name {
            "young" | "height of the far end" | "speed" => 2e-4,
            "standoff" if law == Law::Rigid => 1e-3,
            "standoff" => 2e-4,
            "where it strikes" | "restitution" => 1e-6,
            _ => 2e-5,
        };
        let differences = |share: f64| -> [f64; 12] {
            let change = share * value;
            let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| run(&moved(i, k * change)));
            std::array::from_fn(|k| (8.0 * (c[k] - b[k]) - (d[k] - a[k])) / (12.0 * change))
        };
        let all = differences(share);
        // At the end of a step the cubics of both sides have different curvatures: within the larger changes a crest passes such an instant.
        let near = match share {
            1e-6 => all,
            _ if framed => differences(5e-6),
            2e-4 => differences(2e-5),
            _ => all,
        };
        let derivative = derived(&found.summary, &found.derivatives[i]);
        for (k, what) in RESULTS.iter().enumerate() {
            let difference = if what.starts_with("time of peak") { near[k] } else { all[k] };
            // Times of peaks are accurate to a few units in the last place, which a difference over a change of 5e-6 magnifies.
            let known = if framed && what.starts_with("time of peak") { 1e-2 } else { 1e-3 };
            let scale = difference.abs().max(known * (single[k] / value).abs());
            if (derivative[k] - difference).abs() > tolerance * scale {
                off.push(format!("{what} by {name}: {} {difference}", derivative[k]));
            }
        }
    }
    assert!(off.is_empty(), "{off:#?}");
}

#[test]
fn derivatives_through_elastic_contact() {
    check(Law::Linear, false, 0.109_97, 1e-6);
    check(Law::Hertz, false, 0.109_97, 1e-6);
}

#[test]
fn derivatives_through_impacts_jump_where_these_move() {
    // The accuracy of the differences: instants of impact are located to a thousandth of a pulse in every run.
    check(Law::Rigid, false, 0.029_97, 3e-6);
}

#[test]
fn derivatives_through_joints() {
    check(Law::Linear, true, 0.079_97, 1e-6);
    check(Law::Rigid, true, 0.004_97, 3e-6);
}

#[test]
fn models_without_derivatives_say_why() {
    let base = PARAMETERS.map(|(_, value)| value);
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 2e9, 3e3));
    let section = b.section(Section::new("s", 0.1, 8.33e-5));
    b.beam(beam("g", [0.0; 2], [3.0, 0.0], 6, material, section));
    let kind = LoadKind::Gravity { acceleration: [0.0, -9.81] };
    let function = TimeFunction::HalfSine { duration: 0.01 };
    b.load(Load { function, ..Load::new("shake", kind) });
    let shaken = b.build().unwrap();
    let refused = sensitivities(&shaken, &Settings::new(0.01, 1e-4), &[]).unwrap_err();
    assert!(refused.to_string().contains("loads that change in time"), "{refused}");
    let model = scene(&base, Law::Linear);
    let mut settings = Settings::new(0.01, 1e-4);
    settings.scheme = Scheme::Midpoint;
    let refused = sensitivities(&model, &settings, &[]).unwrap_err();
    assert!(refused.to_string().contains("scheme"), "{refused}");
    let other = {
        let mut p = base;
        p[9] = 0.9; // a point of another element
        scene(&p, Law::Linear)
    };
    let variation = Variation {
        size: 1.0,
        differences: vec![Difference {
            models: [(); 4].map(|()| other.clone()),
            ends: [0.01; 4],
            change: 1.0,
        }],
    };
    let refused = sensitivities(&model, &Settings::new(0.01, 1e-4), &[variation]).unwrap_err();
    assert!(refused.to_string().contains("mesh"), "{refused}");
}

/// An arm on which a ball bounces until it rests; mass, standoff and restitution of the ball.
fn chatter([mass, standoff, restitution]: [f64; 3]) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("alu", 70e9, 2700.0));
    let section = b.section(Section::new("bar", 24e-4, 28.8e-8));
    let arm = b.beam(beam("arm", [0.0; 2], [1.3, 0.2], 7, material, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let kind = ProjectileKind::Rigid { restitution };
    let ball = Projectile::new("ball", kind, mass, [0.3, -4.2], at("struck", arm, 0.8));
    b.projectile(Projectile { standoff, ..ball });
    b.build().unwrap()
}

/// Impulses and velocities of a run with a rigid contact: total impulse and impulse of resting contact, velocity, energy, and dissipation of the
/// impacts.
fn momentum(s: &RunSummary) -> [f64; 5] {
    let ContactRecord::Nonsmooth { impulse_total, impulse_resting, .. } = s.contacts[0].record
    else {
        panic!("a smooth contact")
    };
    let velocity = s.projectiles[0].velocity_final[1];
    [impulse_total, impulse_resting, velocity, s.energy.final_, s.energy.loss_impacts]
}

fn impacts(s: &RunSummary) -> &[Impact] {
    match &s.contacts[0].record {
        ContactRecord::Nonsmooth { impacts, .. } => impacts,
        ContactRecord::Smooth { .. } => panic!("a smooth contact"),
    }
}

/// Derivatives are valid beyond accumulated impacts and resting contact: for the following motion, and for all except the slightest impacts, whose
/// number depends on round-off.
#[test]
fn derivatives_go_on_through_accumulated_impacts_and_rest() {
    let base = [3.1, 7.3e-3, 0.3];
    let end = 0.00186;
    let settings = Settings::new(end, 2e-5);
    let moved = |i: usize, by: f64| {
        let mut p = base;
        p[i] += by;
        chatter(p)
    };
    let variation = |i: usize| {
        let change = 1e-3 * base[i];
        let models = [-2.0, -1.0, 1.0, 2.0].map(|k| moved(i, k * change));
        Variation {
            size: 1e3 * change,
            differences: vec![Difference { models, ends: [end; 4], change }],
        }
    };
    let model = chatter(base);
    let found = sensitivities(&model, &settings, &[0, 1, 2].map(variation)).unwrap();
    let run = |model: &Model| simulate(model, &settings, &mut NoRecorder).unwrap();
    let all = impacts(&found.summary);
    assert_eq!((all, momentum(&found.summary)), (impacts(&run(&model)), momentum(&run(&model))));
    assert_eq!(found.horizon, None);
    let ContactRecord::Nonsmooth { intervals, .. } = &found.summary.contacts[0].record else {
        unreachable!()
    };
    assert!(
        intervals.len() == 1 && intervals[0].end.is_nan(),
        "it does not come to rest: {intervals:?}"
    );
    let largest = all.iter().map(|impact| impact.impulse).fold(0.0, f64::max);
    for (i, derivative) in found.derivatives.iter().enumerate() {
        let known = impacts(derivative);
        assert_eq!(known.len(), all.len());
        for (own, by) in all.iter().zip(known) {
            assert!(by.impulse.is_finite() || own.impulse < 1e-3 * largest, "{own:?} {by:?}");
        }
        let change = 1e-5 * base[i];
        let ends = [-change, change].map(|by| impacts(&run(&moved(i, by))).to_vec());
        for k in 0..3 {
            let difference =
                |of: fn(&Impact) -> f64| (of(&ends[1][k]) - of(&ends[0][k])) / (2.0 * change);
            for of in [|i: &Impact| i.time, |i: &Impact| i.impulse] {
                let (own, difference) = (of(&known[k]), difference(of));
                let scale = difference.abs().max(1e-3 * (of(&all[k]) / base[i]).abs());
                assert!((own - difference).abs() < 1e-3 * scale, "{i} {k}: {own} {difference}");
            }
        }
    }
    // The threshold of resting contact, a millionth of the fastest approach, is noise in the differences, mainly in the impulse of resting contact.
    for (i, derivative) in found.derivatives.iter().enumerate() {
        let change = 1e-4 * base[i];
        let ends = [-change, change].map(|by| momentum(&run(&moved(i, by))));
        for (k, own) in momentum(derivative).into_iter().enumerate() {
            let difference = (ends[1][k] - ends[0][k]) / (2.0 * change);
            assert!(
                (own - difference).abs() < 1e-2 * difference.abs(),
                "{i} {k}: {own} {difference}"
            );
        }
    }
}

/// A resting contact ends at the end of a step. If the projectile bounces afterwards, the total impulse as a function of the standoff is a
/// sawtooth, whose derivative is meaningless: derivatives end there.
#[test]
fn derivatives_end_where_a_contact_bounces_after_it_let_go() {
    let base = [3.1, 7.3e-3, 0.3];
    let settings = Settings::new(0.01, 2e-5);
    let change = 1e-3 * base[1];
    let models = [-2.0, -1.0, 1.0, 2.0].map(|k| chatter([base[0], base[1] + k * change, base[2]]));
    let variation = Variation {
        size: 1e3 * change,
        differences: vec![Difference { models, ends: [0.01; 4], change }],
    };
    let found = sensitivities(&chatter(base), &settings, &[variation]).unwrap();
    let ContactRecord::Nonsmooth { intervals, .. } = &found.summary.contacts[0].record else {
        unreachable!()
    };
    let all = impacts(&found.summary);
    let again = all.iter().find(|impact| impact.time > intervals[0].end).unwrap();
    let horizon = found.horizon.as_ref().unwrap();
    assert_eq!(horizon.time, again.time, "{horizon:?}");
    let derivative = &found.derivatives[0];
    assert!(momentum(derivative).iter().all(|x| x.is_nan()), "{:?}", momentum(derivative));
    let before = all.iter().filter(|impact| impact.time < horizon.time).count();
    let known = impacts(derivative);
    assert!(known.len() == before && known[0].impulse.is_finite(), "{before} {known:?}");
}

/// The time of a peak at the end of a step, not within it, is a time of the grid.
#[test]
fn times_that_steps_do_not_resolve_have_no_derivative() {
    let base = PARAMETERS.map(|(_, value)| value);
    // A step of a quarter of a millisecond does not resolve the fastest waves of a stiffer beam.
    let scene = |speed: f64| {
        let mut p = base;
        (p[0], p[7]) = (2e13, speed);
        scene(&p, Law::Linear)
    };
    let settings = Settings::new(0.02, 2.5e-4);
    let models = [19.96, 19.98, 20.02, 20.04].map(scene);
    let variation = Variation {
        size: 20.0,
        differences: vec![Difference { models, ends: [0.02; 4], change: 0.02 }],
    };
    let found = sensitivities(&scene(20.0), &settings, &[variation]).unwrap();
    let points = found.summary.points.iter().zip(&found.derivatives[0].points);
    let mut unresolved = 0;
    for (own, derivative) in points {
        for (resolved, peak) in own.resolved.iter().zip(&derivative.displacement_max) {
            assert!(*resolved || peak.time.is_nan(), "{own:?} {derivative:?}");
            unresolved += usize::from(!resolved);
        }
    }
    assert!(unresolved > 0, "{:?}", found.summary.points);
}
