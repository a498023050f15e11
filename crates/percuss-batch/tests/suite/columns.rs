//! Numbers taken from columns of the history, and their derivatives.

use crate::common;

use common::{at, beam};
use percuss::*;
use percuss_batch::*;

/// Mass, speed, stiffness or restitution, and Young's modulus.
const BASE: [f64; 4] = [3.1, -4.2, 2e5, 70e9];

#[derive(Clone, Copy, PartialEq)]
enum Law {
    Linear,
    /// With Hunt and Crossley's dissipation, which grows with the stiffness.
    Damped,
    Rigid,
}

/// An arm struck by a ball.
fn scene([mass, speed, law, young]: [f64; 4], kind: Law) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("alu", young, 2700.0));
    let section = b.section(Section::new("bar", 24e-4, 28.8e-8));
    let arm = b.beam(beam("arm", [0.0; 2], [1.3, 0.2], 7, material, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let kind = match kind {
        Law::Rigid => ProjectileKind::Rigid { restitution: law },
        Law::Linear => ProjectileKind::spring(law),
        Law::Damped => {
            let elastic = SmoothLaw::elastic(Potential::Hertz { stiffness: 50.0 * law });
            ProjectileKind::Elastic { law: SmoothLaw { dissipation: 1e-6 * law, ..elastic } }
        }
    };
    let ball = Projectile::new("ball", kind, mass, [0.3, speed], at("struck", arm, 0.8));
    b.projectile(Projectile { standoff: 1.3e-3, ..ball });
    b.build().unwrap()
}

/// Columns whose derivatives are known, read at a time and between rows, and extremes.
fn samples(kind: Law, end: f64) -> Vec<ColumnSample> {
    let mut names = vec![
        "projectile.ball.position_2",
        "projectile.ball.velocity_1",
        "contact.ball.gap",
        "contact.ball.impulse",
        "point.struck.displacement_2",
        "point.struck.velocity_2",
        "point.struck.rotation",
        "energy.kinetic",
        "energy.strain",
        "momentum.angular",
    ];
    if kind != Law::Rigid {
        names.extend(["contact.ball.force", "energy.contact", "energy.loss_damping"]);
    }
    let mut all: Vec<ColumnSample> = Vec::new();
    for name in &names {
        all.extend([0.5, 0.671].map(|share| ColumnSample::at(*name, share * end)));
    }
    let (from, to) = (0.15 * end, 0.85 * end);
    for taken in [ColumnValue::Largest { from, to }, ColumnValue::Smallest { from, to }] {
        all.push(ColumnSample { column: "point.struck.velocity_2".into(), taken });
    }
    all
}

/// Derivatives against central differences of runs.
fn check(kind: Law, tolerance: f64) {
    let mut base = BASE;
    if kind == Law::Rigid {
        // A light ball rebounds once.
        (base[0], base[2]) = (0.4, 0.6);
    }
    // The rigid ball strikes after half the time, at 0.31 ms. Rows of every second step.
    let end = if kind == Law::Rigid { 0.6e-3 } else { 3e-3 };
    let settings = Settings { record_every: 2, ..Settings::new(end, 2e-5) };
    let samples = samples(kind, end);
    let moved = |i: usize, by: f64| {
        let mut p = base;
        p[i] += by;
        scene(p, kind)
    };
    let variation = |i: usize| {
        let change = 1e-3 * base[i].abs();
        let models = [-2.0, -1.0, 1.0, 2.0].map(|k| moved(i, k * change));
        Variation {
            size: 1e3 * change,
            differences: vec![Difference { models, ends: [end; 4], change }],
        }
    };
    let (model, all) = (scene(base, kind), [0, 1, 2, 3].map(variation));
    let found = sensitivities_with_columns(&model, &settings, &all, &samples).unwrap();
    assert_eq!(found.horizon, None);
    let run = |model: &Model| simulate_with_columns(model, &settings, &samples).unwrap().1;
    let own = run(&model);
    assert_eq!(found.columns.values, own);
    for (i, value) in base.iter().enumerate() {
        let change = 1e-5 * value.abs();
        let ends = [-change, change].map(|by| run(&moved(i, by)));
        for (k, sample) in samples.iter().enumerate() {
            let difference = (ends[1][k] - ends[0][k]) / (2.0 * change);
            let derivative = found.columns.derivatives[i][k];
            // Round-off of the runs, of some 1e-11 of a value, over twice the change of 1e-5.
            let scale = difference.abs().max(1e-3 * (own[k] / value).abs());
            assert!(
                (derivative - difference).abs() <= tolerance * scale,
                "{sample:?} by parameter {i}: {derivative} {difference}"
            );
        }
    }
}

#[test]
fn derivatives_of_columns_are_those_of_differences() {
    check(Law::Linear, 1e-4);
}

#[test]
fn derivatives_of_columns_go_on_through_damped_contacts() {
    check(Law::Damped, 1e-4);
}

/// The gap is located to a thousandth of an impact interval in every run.
#[test]
fn derivatives_of_columns_go_on_through_impacts() {
    check(Law::Rigid, 1e-3);
}

#[test]
fn values_are_those_between_the_rows_of_the_history() {
    let (model, settings) = (scene(BASE, Law::Linear), Settings::new(3e-3, 2e-5));
    let mut recorder = MemoryRecorder::default();
    simulate(&model, &settings, &mut recorder).unwrap();
    let [time, force] = ["time", "contact.ball.force"].map(|name| recorder.column(name).unwrap());
    let k = force.iter().position(|force| *force > 0.0).unwrap() + 3;
    let middle = 0.5 * (time[k] + time[k + 1]);
    let column = "contact.ball.force";
    let largest = ColumnValue::Largest { from: 0.0, to: 3e-3 };
    let samples = [
        ColumnSample::at(column, time[k]),
        ColumnSample::at(column, middle),
        ColumnSample::at(column, 1.0),
        ColumnSample { column: column.into(), taken: largest },
    ];
    let values = simulate_with_columns(&model, &settings, &samples).unwrap().1;
    assert_eq!(values[0], force[k]);
    let mean = 0.5 * (force[k] + force[k + 1]);
    assert!((values[1] - mean).abs() < 1e-12 * mean, "{} {mean}", values[1]);
    assert!(values[2].is_nan(), "later than the end");
    assert_eq!(values[3], force.iter().copied().fold(0.0, f64::max));
}

/// Forces of sections and supports are averages over rows, which only single runs record.
#[test]
fn columns_without_derivatives_are_known_as_such() {
    let model = scene(BASE, Law::Linear);
    assert!(has_derivatives("contact.ball.force", &model));
    for name in ["section.struck.moment", "support.root.force_2", "energy.residual"] {
        assert!(!has_derivatives(name, &model), "{name}");
        let sample = [ColumnSample::at(name, 1e-3)];
        let settings = Settings::new(2e-3, 2e-5);
        let change = 1e-3;
        let models = [-2.0, -1.0, 1.0, 2.0]
            .map(|k| scene([BASE[0] + k * change, BASE[1], BASE[2], BASE[3]], Law::Linear));
        let by = Variation {
            size: 1e3 * change,
            differences: vec![Difference { models, ends: [2e-3; 4], change }],
        };
        let found = sensitivities_with_columns(&model, &settings, &[by], &sample).unwrap();
        assert!(found.columns.values[0].is_finite() && found.columns.derivatives[0][0].is_nan());
    }
}

/// The tangent at the solution of a step is factored once, for the derivatives by all parameters; the iteration uses the factors of the step before.
#[test]
fn one_factorisation_a_step_serves_all_parameters() {
    let settings = Settings::new(2e-3, 2e-5);
    let model = scene(BASE, Law::Linear);
    let variation = |i: usize| {
        let change = 1e-3 * BASE[i].abs();
        let models = [-2.0, -1.0, 1.0, 2.0].map(|k| {
            let mut p = BASE;
            p[i] += k * change;
            scene(p, Law::Linear)
        });
        Variation {
            size: 1e3 * change,
            differences: vec![Difference { models, ends: [2e-3; 4], change }],
        }
    };
    let count = |parameters: &[usize]| {
        let all: Vec<Variation> = parameters.iter().map(|i| variation(*i)).collect();
        sensitivities(&model, &settings, &all).unwrap().factorizations
    };
    let (one, three) = (count(&[0]), count(&[0, 1, 2]));
    assert_eq!(one, three);
    // Those of 100 steps, the first one before its iteration, and a few where the contact opens or closes.
    assert!((100..115).contains(&one), "{one}");
}
