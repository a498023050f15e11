//! Derivatives of results through a run against differences of whole runs, impacts included.

mod common;

use common::{at, beam};
use percuss::*;

/// Names and values of the parameters of both scenes.
const PARAMETERS: [(&str, f64); 12] = [
    ("young", 2e9),
    ("density", 3e3),
    ("area", 0.1),
    ("inertia", 8.33e-5),
    ("length", 3.0),
    ("height of the far end", 0.1),
    ("mass", 200.0),
    ("speed", 20.0),
    // So that the first impact lies within a step: at its very end the run is not differentiable.
    ("standoff", 0.0207),
    ("where it strikes", 0.52),
    ("stiffness", 7.5e5),
    ("restitution", 0.7),
];

#[derive(Clone, Copy, PartialEq)]
enum Law {
    Linear,
    Hertz,
    Rigid,
}

fn scene(p: &[f64; 12], law: Law) -> Model {
    let mut b = ModelBuilder::new();
    // Damping is a number like any other. So little of it that impacts stay apart, and none within a change of the end of a step,
    // where the run is not differentiable.
    let (retardation, mass_damping) = (3e-9 * p[1], 1e-2 * p[6]);
    let material = Material { retardation, mass_damping, ..Material::new("m", p[0], p[1]) };
    let material = b.material(material);
    let section = b.section(Section::new("s", p[2], p[3]));
    let g = b.beam(beam("g", [0.0; 2], [p[4], p[5]], 6, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, g, f), SupportKind::Clamp));
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
    // Loads are numbers like any other: weight, and a push that grows with the first parameters.
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [3.0 * p[4], -9.81] }));
    // Across the beam: a force along it would part its spans, which derivatives do not know.
    let push = p[3] * 3e7 + p[0] * 1e-6;
    let force = [-p[5] * push, p[4] * push];
    let kind = LoadKind::Point { at: at("pushed", g, 0.3), force, moment: 0.0, follower: false };
    b.load(Load::new("push", kind));
    b.build().unwrap()
}

/// Peak displacement, velocity at the end, peak force or number of impacts, impulse, start of the contact.
fn results(s: &RunSummary) -> [f64; 5] {
    let (force, impulse, start) = match &s.contacts[0].record {
        ContactRecord::Smooth { peak_force, intervals } => {
            (peak_force.value, intervals[0].impulse, intervals[0].start)
        }
        ContactRecord::Nonsmooth { impacts, impulse_total, .. } => {
            (impacts.last().unwrap().impulse, *impulse_total, impacts.last().unwrap().time)
        }
    };
    let top = s.points[0].displacement_max[1].value;
    [top, s.projectiles[0].velocity_final[1], force, impulse, start]
}

fn check(law: Law, end: f64, tolerance: f64) {
    let base = PARAMETERS.map(|(_, value)| value);
    let settings = Settings::new(end, 1e-4);
    let moved = |i: usize, by: f64| {
        let mut p = base;
        p[i] += by;
        scene(&p, law)
    };
    let variations: Vec<Variation> = (0..12)
        .map(|i| {
            let change = 1e-3 * base[i];
            let models = [-2.0, -1.0, 1.0, 2.0].map(|k| moved(i, k * change));
            Variation { models, change }
        })
        .collect();
    let model = scene(&base, law);
    let found = sensitivities(&model, &settings, &variations).unwrap();
    let run = |m: &Model| results(&simulate(m, &settings, &mut NoRecorder).unwrap());
    let single = run(&model);
    for (a, b) in results(&found.summary).iter().zip(&single) {
        // Instants of impact are located to a thousandth of a pulse, which later impacts magnify.
        assert!((a - b).abs() <= 1e-6 * b.abs(), "{a} {b}");
    }
    for (i, (name, value)) in PARAMETERS.iter().enumerate() {
        // Differences of fourth order: over changes so small that results still are quartics, least where it strikes, and large
        // enough for the digits that instants of impact are located to.
        let share = match *name {
            "young" | "height of the far end" | "speed" => 2e-4,
            "standoff" if law == Law::Rigid => 1e-3,
            "standoff" => 2e-4,
            "where it strikes" | "restitution" => 1e-6,
            _ => 2e-5,
        };
        let change = share * value;
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| run(&moved(i, k * change)));
        let derivative = results(&found.derivatives[i]);
        for k in 0..5 {
            let difference = (8.0 * (c[k] - b[k]) - (d[k] - a[k])) / (12.0 * change);
            let scale = difference.abs().max(1e-3 * (single[k] / value).abs());
            assert!(
                (derivative[k] - difference).abs() <= tolerance * scale,
                "result {k} by {name}: {} {difference}",
                derivative[k]
            );
        }
    }
}

#[test]
fn derivatives_through_elastic_contact() {
    check(Law::Linear, 0.11, 1e-6);
    check(Law::Hertz, 0.11, 1e-6);
}

#[test]
fn derivatives_through_impacts_jump_where_these_move() {
    // The differences are no better: instants of impact are located to a thousandth of a pulse in every run.
    check(Law::Rigid, 0.03, 3e-6);
}

#[test]
fn what_cannot_be_differentiated_says_so() {
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
        p[9] = 0.9; // strikes another element
        scene(&p, Law::Linear)
    };
    let variation = Variation { models: [(); 4].map(|()| other.clone()), change: 1.0 };
    let refused = sensitivities(&model, &Settings::new(0.01, 1e-4), &[variation]).unwrap_err();
    assert!(refused.to_string().contains("mesh"), "{refused}");
}
