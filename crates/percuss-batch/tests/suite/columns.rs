//! Numbers taken from columns of the history, and their derivatives.

use crate::common;

use common::{at, beam};
use percuss::*;
use percuss_batch::*;

/// Mass, speed, stiffness or restitution, and Young's modulus.
const BASE: [f64; 4] = [3.1, -4.2, 2e5, 70e9];

/// An arm struck by a ball, compliant or rigid.
fn scene([mass, speed, law, young]: [f64; 4], rigid: bool) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("alu", young, 2700.0));
    let section = b.section(Section::new("bar", 24e-4, 28.8e-8));
    let arm = b.beam(beam("arm", [0.0; 2], [1.3, 0.2], 7, material, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let kind = match rigid {
        true => ProjectileKind::Rigid { restitution: law },
        false => ProjectileKind::spring(law),
    };
    let ball = Projectile::new("ball", kind, mass, [0.3, speed], at("struck", arm, 0.8));
    b.projectile(Projectile { standoff: 1.3e-3, ..ball });
    b.build().unwrap()
}

/// Columns whose derivatives are known, read at a time and between rows, and extremes.
fn samples(rigid: bool) -> Vec<ColumnSample> {
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
    if !rigid {
        names.extend(["contact.ball.force", "energy.contact"]);
    }
    let mut all: Vec<ColumnSample> = Vec::new();
    for name in &names {
        all.extend([1.5e-3, 2.013e-3].map(|time| ColumnSample::at(*name, time)));
    }
    let (from, to) = (0.5e-3, 2.5e-3);
    for taken in [Taken::Largest { from, to }, Taken::Smallest { from, to }] {
        all.push(ColumnSample { column: "point.struck.velocity_2".into(), taken });
    }
    all
}

/// Derivatives against central differences of runs.
fn check(rigid: bool, tolerance: f64) {
    let mut base = BASE;
    if rigid {
        base[2] = 0.6;
    }
    // Rows of every second step.
    let settings = Settings { record_every: 2, ..Settings::new(3e-3, 2e-5) };
    let samples = samples(rigid);
    let moved = |i: usize, by: f64| {
        let mut p = base;
        p[i] += by;
        scene(p, rigid)
    };
    let variation = |i: usize| {
        let change = 1e-3 * base[i].abs();
        let models = [-2.0, -1.0, 1.0, 2.0].map(|k| moved(i, k * change));
        Variation { models, ends: [3e-3; 4], change }
    };
    let (model, all) = (scene(base, rigid), [0, 1, 2, 3].map(variation));
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
    check(false, 1e-4);
}

/// The gap is located to a thousandth of an impact interval in every run.
#[test]
fn derivatives_of_columns_go_on_through_impacts() {
    check(true, 1e-3);
}

#[test]
fn values_are_those_between_the_rows_of_the_history() {
    let (model, settings) = (scene(BASE, false), Settings::new(3e-3, 2e-5));
    let mut recorder = MemoryRecorder::default();
    simulate(&model, &settings, &mut recorder).unwrap();
    let [time, force] = ["time", "contact.ball.force"].map(|name| recorder.column(name).unwrap());
    let k = force.iter().position(|force| *force > 0.0).unwrap() + 3;
    let middle = 0.5 * (time[k] + time[k + 1]);
    let column = "contact.ball.force";
    let largest = Taken::Largest { from: 0.0, to: 3e-3 };
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
    let model = scene(BASE, false);
    assert!(has_derivatives("contact.ball.force", &model));
    for name in ["section.struck.moment", "support.root.force_2", "energy.residual"] {
        assert!(!has_derivatives(name, &model), "{name}");
        let sample = [ColumnSample::at(name, 1e-3)];
        let settings = Settings::new(2e-3, 2e-5);
        let change = 1e-3;
        let models = [-2.0, -1.0, 1.0, 2.0]
            .map(|k| scene([BASE[0] + k * change, BASE[1], BASE[2], BASE[3]], false));
        let by = Variation { models, ends: [2e-3; 4], change };
        let found = sensitivities_with_columns(&model, &settings, &[by], &sample).unwrap();
        assert!(found.columns.values[0].is_finite() && found.columns.derivatives[0][0].is_nan());
    }
}
