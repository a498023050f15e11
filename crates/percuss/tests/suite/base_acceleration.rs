//! Structures on a base that is accelerated: against closed forms, and against the same base as a prescribed motion.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::common;

use common::rows::Rows;
use common::*;
use percuss::*;

const MASS: f64 = 10.0;

/// A stiff bar of 10 kg that slides along e1 on a spring to the base, and swings at 3 Hz.
fn oscillator(load: Load) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 1e11, 1e3));
    let section = b.section(Section::rectangle("s", 0.1, 0.1));
    let bar = b.beam(beam("bar", [0.0; 2], [1.0, 0.0], 2, material, section));
    let components = vec![Component::Displacement2, Component::Rotation];
    b.support(Support::new("guide", at("start", bar, 0.0), SupportKind::Fix { components }));
    let spring = SupportKind::Elastic {
        direction: [1.0, 0.0],
        stiffness: [stiffness(), 0.0],
        damping: [0.0; 2],
        rotational_stiffness: 0.0,
        rotational_damping: 0.0,
    };
    b.support(Support::new("spring", at("mid", bar, 0.5), spring));
    b.record_point(at("mid", bar, 0.5));
    b.load(load);
    b.build().unwrap()
}

fn frequency() -> f64 {
    3.0 * TAU
}

fn stiffness() -> f64 {
    MASS * frequency() * frequency()
}

fn quake(acceleration: [f64; 2], function: TimeFunction) -> Load {
    Load { function, ..Load::new("quake", LoadKind::Base { acceleration }) }
}

#[test]
fn an_oscillator_answers_a_sine_of_its_base_as_in_closed_form_and_swings_about_zero_after_it() {
    const SIZE: f64 = 2.0;
    const END: f64 = 1.75;
    let function = TimeFunction::Harmonic { frequency: 2.0, phase: 0.0 };
    let model = oscillator(Load { until: END, ..quake([SIZE, 0.0], function) });
    let (rows, run) = Rows::of(&model, &Settings::new(4.0, 5e-4));
    let (own, driven) = (frequency(), 2.0 * TAU);
    // u'' + own^2 u = -a of the base, at rest at first; then u and v at its end swing on.
    let size = -SIZE / (own * own - driven * driven);
    let forced = |t: f64| {
        let (s, c) = (driven * t).sin_cos();
        [size * (s - driven / own * (own * t).sin()), size * driven * (c - (own * t).cos())]
    };
    let exact = |t: f64| {
        if t <= END {
            return forced(t)[0];
        }
        let ([u, v], (s, c)) = (forced(END), (own * (t - END)).sin_cos());
        u * c + v / own * s
    };
    let amplitude = size.abs() * (1.0 + driven / own);
    let moved = rows.column("point.mid.displacement_1");
    let reaction = rows.column("support.spring.force_1");
    for (k, t) in rows.column("time").into_iter().enumerate() {
        let off = moved[k] - exact(t);
        assert!(off.abs() < 2e-3 * amplitude, "{t}: {} {}", moved[k], exact(t));
        // What the base pushes with is the mass times its true acceleration, that of the base included: -k u.
        let push = -stiffness() * exact(t - 2.5e-4);
        let most = stiffness() * amplitude;
        assert!(k == 0 || (reaction[k] - push).abs() < 2e-3 * most, "{t}: {} {push}", reaction[k]);
    }
    assert!(run.energy.residual_max < 1e-11, "{:?}", run.energy);
    assert!(run.momentum.linear_residual_max < 1e-11, "{:?}", run.momentum);
}

#[test]
fn nothing_drifts_after_a_record_that_ends_anyhow() {
    // Neither its sum nor its last value is zero.
    let record = |start: f64| TimeFunction::Table {
        times: [0.0, 0.4, 1.0].map(|t| start + t).to_vec(),
        values: vec![0.5, 3.0, 1.0],
        smooth: false,
    };
    let (rows, run) =
        Rows::of(&oscillator(quake([1.0, 0.0], record(0.0))), &Settings::new(6.0, 1e-3));
    let (time, moved) = (rows.column("time"), rows.column("point.mid.displacement_1"));
    let after = || time.iter().zip(&moved).filter(|(t, _)| **t > 1.001).map(|(_, u)| *u);
    let (least, most) = (after().fold(f64::MAX, f64::min), after().fold(f64::MIN, f64::max));
    assert!(most > 1e-4 && (least + most).abs() < 1e-3 * most, "{least} {most}");
    let work = rows.column("energy.work_loads");
    let at_end = time.iter().position(|t| *t > 1.001).unwrap();
    assert!(work[at_end..].iter().all(|w| *w == work[at_end]), "nothing acts after the record");
    assert!(run.energy.residual_max < 1e-11, "{:?}", run.energy);

    // A record that begins later is the same one from then on.
    let later = oscillator(quake([1.0, 0.0], record(0.5)));
    let from = oscillator(Load { from: 0.5, ..quake([1.0, 0.0], record(0.0)) });
    let settings = Settings::new(2.0, 1e-3);
    let [later, from] =
        [later, from].map(|model| Rows::of(&model, &settings).0.column("point.mid.displacement_1"));
    let apart = later.iter().zip(&from).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    assert!(apart < 1e-9 * most && later[499] == 0.0, "{apart}");
}

/// A cantilever with a mass at its end whose root goes to and fro, as a prescribed motion or as its base.
fn cantilever(moves: bool, size: f64, rate: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 7e10, 2700.0));
    let section = b.section(Section::rectangle("s", 0.02, 0.01));
    let mast = b.beam(beam("mast", [0.0; 2], [0.0, 1.0], 4, material, section));
    let function = TimeFunction::function(move |t| 1.0 - (rate * t).cos());
    let motion = Motion { displacement: [size, 0.0], rotation: 0.0, function };
    let root = Support::new("root", at("root", mast, 0.0), SupportKind::Clamp);
    b.support(Support { motion: moves.then_some(motion), ..root });
    b.point_mass(PointMass {
        name: "head".into(),
        at: at("head", mast, 1.0),
        mass: 0.5,
        rotary_inertia: 0.0,
    });
    if !moves {
        let function = TimeFunction::Harmonic { frequency: rate / TAU, phase: FRAC_PI_2 };
        b.load(quake([size * rate * rate, 0.0], function));
    }
    b.record_point(at("tip", mast, 1.0));
    b.record_point(at("foot", mast, 0.0));
    b.build().unwrap()
}

#[test]
fn a_base_acceleration_is_a_prescribed_motion_seen_from_the_base() {
    let (size, rate) = (0.2, 12.0);
    let settings = Settings::new(1.0, 2e-4);
    let [seen, true_motion] =
        [false, true].map(|moves| Rows::of(&cantilever(moves, size, rate), &settings).0);
    for component in [1, 2] {
        let column = |rows: &Rows, what: &str| rows.column(&format!("{what}_{component}"));
        let foot = column(&true_motion, "point.foot.displacement");
        let tip = column(&true_motion, "point.tip.displacement");
        let against: Vec<f64> = tip.iter().zip(&foot).map(|(tip, foot)| tip - foot).collect();
        let pairs = [
            (column(&seen, "point.tip.displacement"), against),
            (column(&seen, "support.root.force"), column(&true_motion, "support.root.force")),
        ];
        for (found, right) in pairs {
            let most = right.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            assert!(most > 1e-3, "component {component}: {most}");
            for (k, (a, b)) in found.iter().zip(&right).enumerate().skip(1) {
                assert!((a - b).abs() < 2e-5 * most, "component {component}, row {k}: {a} {b}");
            }
        }
    }
}
