//! Beams that yield, in lanes: the results of single runs, the same bits alone and beside others, and derivatives through plastic flow.

use crate::common;

use common::numbers::Numbers;
use common::{at, beam};
use percuss::*;
use percuss_batch::*;

/// Material law of a beam that yields.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Perfect,
    Table,
    Kinematic,
    Rate,
    OneSided,
    Crushing,
    Composite,
}

const KINDS: [Kind; 7] = [
    Kind::Perfect,
    Kind::Table,
    Kind::Kinematic,
    Kind::Rate,
    Kind::OneSided,
    Kind::Crushing,
    Kind::Composite,
];

/// Steel in N and mm is 205e9 Pa; its limit is this share of it.
const LIMIT: f64 = 1.2e-3;

fn inelasticity(kind: Kind, young: f64) -> Inelasticity {
    let limit = LIMIT * young;
    let mut law = Plasticity {
        curve: vec![Hardening { from: 0.0, stress: limit, modulus: 0.0 }],
        kinematic: 0.0,
        overstress: None,
        failure_strain: None,
    };
    match kind {
        Kind::Perfect => {}
        Kind::Table | Kind::Composite => {
            law.curve = vec![
                Hardening { from: 0.0, stress: limit, modulus: 0.04 * young },
                Hardening { from: 2e-3, stress: limit + 8e-5 * young, modulus: 0.01 * young },
                Hardening { from: 6e-3, stress: limit + 1.2e-4 * young, modulus: 0.0 },
            ];
        }
        Kind::Kinematic => law.kinematic = 0.02 * young,
        Kind::Rate => law.overstress = Some(Overstress { rate: 40.4, exponent: 5.0 }),
        Kind::OneSided => return Inelasticity::OneSided(Slack::Compression),
        Kind::Crushing => return Inelasticity::OneSidedPlastic(Slack::Tension, law),
    }
    Inelasticity::Plastic(law)
}

/// Numbers of a scene: Young's modulus, density, width, depth, mass, speed, struck point, stiffness of the contact.
const BASE: [f64; 8] = [205e9, 7850.0, 0.04, 0.02, 2.0, 30.0, 0.52, 1e8];

/// A clamped bar struck transversely by a projectile, with compliant or rigid contact.
fn scene(kind: Kind, rigid: Option<f64>, p: &[f64; 8]) -> Model {
    let mut b = ModelBuilder::new();
    let law = inelasticity(kind, p[0]);
    let own = Material {
        strain: StrainMeasure::Engineering,
        retardation: 2e-7,
        inelasticity: Some(law),
        ..Material::new("steel", p[0], p[1])
    };
    let steel = b.material(own);
    let section = if kind == Kind::Composite {
        let soft = b.material(Material {
            strain: StrainMeasure::Engineering,
            retardation: 2e-7,
            ..Material::new("core", 0.3 * p[0], 0.4 * p[1])
        });
        let fibre = |k: f64, material| SectionFibre {
            height: (k - 1.5) * 0.25 * p[3],
            area: 0.25 * p[2] * p[3],
            material,
        };
        let all = vec![
            fibre(0.0, None),
            fibre(1.0, Some(soft)),
            fibre(2.0, Some(soft)),
            fibre(3.0, None),
        ];
        Section::of_fibres("layers", all)
    } else {
        Section { fibres: 6, ..Section::rectangle("bar", p[2], p[3]) }
    };
    let section = b.section(section);
    let bar = b.beam(beam("bar", [0.0; 2], [0.8, 0.05], 6, steel, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, bar, f), SupportKind::Clamp));
    }
    let law = match rigid {
        Some(restitution) => ProjectileKind::Rigid { restitution },
        None => ProjectileKind::spring(p[7]),
    };
    let ball = Projectile::new("mass", law, p[4], [0.0, -p[5]], at("struck", bar, p[6]));
    b.projectile(Projectile { standoff: 1.3e-3, ..ball });
    b.build().unwrap()
}

fn runs(kind: Kind, rigid: Option<f64>) -> Vec<(Model, Settings)> {
    let mut draw = Numbers(23);
    let mut run = || {
        let p = BASE.map(|value| value * draw.between(0.9, 1.1));
        let end = if rigid.is_some() { 2e-3 } else { draw.between(3e-3, 5e-3) };
        (scene(kind, rigid, &p), Settings::new(end, 1e-5))
    };
    (0..9).map(|_| run()).collect()
}

fn all() -> impl Iterator<Item = (Kind, Option<f64>)> {
    KINDS.into_iter().flat_map(|kind| [None, Some(0.0), Some(0.6)].map(|rigid| (kind, rigid)))
}

fn batch(runs: &[(Model, Settings)]) -> Vec<RunSummary> {
    let runs: Vec<(&Model, &Settings)> = runs.iter().map(|(m, s)| (m, s)).collect();
    simulate_batch(&runs, Detail::Motion).into_iter().map(Result::unwrap).collect()
}

fn impulse(record: &ContactRecord) -> f64 {
    match record {
        ContactRecord::Smooth { intervals, .. } => intervals.iter().map(|i| i.impulse).sum(),
        ContactRecord::Nonsmooth { impulse_total, .. } => *impulse_total,
    }
}

/// Results of motion, plastic flow and balance, each with its scale.
fn scaled_results(s: &RunSummary) -> Vec<(&'static str, f64, f64)> {
    let energy = s.energy.scale;
    let mut all = vec![
        ("energy", s.energy.final_, energy),
        ("plastic", s.energy.plastic, energy),
        ("hardening", s.energy.hardening, energy),
        ("damped", s.energy.loss_damping, energy),
        ("loss", s.energy.loss_impacts, energy),
        ("velocity", s.projectiles[0].velocity_final[1], 10.0),
        ("momentum", s.momentum.linear_scale, s.momentum.linear_scale),
        ("impulse", impulse(&s.contacts[0].record), s.momentum.linear_scale),
    ];
    for p in &s.points {
        all.extend(p.displacement_max.map(|peak| ("displacement", peak.value, 1e-2)));
    }
    for beam in &s.plastic {
        let strain = LIMIT.max(beam.accumulated_max.value);
        all.push(("strain", beam.strain_max.value, strain));
        all.push(("strained at", beam.strain_max.s, 1.0));
        all.push(("strained when", beam.strain_max.time, 1e-3));
        all.push(("accumulated", beam.accumulated_max.value, strain));
        all.push(("dissipated", beam.dissipated, energy));
        all.push(("stored", beam.hardening, energy));
        all.extend(beam.first_yield.map(|first| ("yields when", first.time, 1e-3)));
        all.extend(beam.first_yield.map(|first| ("yields at", first.s, 1.0)));
        all.extend(beam.permanent_set.map(|set| ("set", set.displacement[1], 1e-2)));
        all.extend(beam.hinges.iter().map(|hinge| ("rotation", hinge.rotation, 1e-2)));
    }
    all
}

#[test]
fn beams_that_yield_move_in_lanes_as_they_do_alone() {
    for (kind, rigid) in all() {
        let name = format!("{kind:?}, {rigid:?}");
        let runs = runs(kind, rigid);
        for (model, settings) in &runs {
            assert_eq!(runs_alone(model, settings, Detail::Motion), None, "{name}");
        }
        // Instants of impact are located to a thousandth of an impact interval.
        let known = if rigid.is_some() { 1e-5 } else { 1e-7 };
        let (mut flowed, mut most) = (0, 0.0_f64);
        for (k, ((model, settings), found)) in runs.iter().zip(batch(&runs)).enumerate() {
            let single = simulate(model, settings, &mut NoRecorder).unwrap();
            assert!(found.supports.is_empty(), "{name}: run {k} was not stepped in a lane");
            assert!(matches!(found.termination, Termination::Completed));
            let m = &found.momentum;
            let worst = found.energy.residual_max.max(m.linear_residual_max);
            let worst = worst.max(m.angular_residual_max);
            assert!(worst < 1e-10, "{name}: run {k}: {worst:e}");
            let (mut a, mut b) = (scaled_results(&single), scaled_results(&found));
            if kind == Kind::Crushing {
                // No-tension sections are partly open after unloading: round-off decides which equilibrium is found, if any.
                a.retain(|(what, ..)| *what != "set");
                b.retain(|(what, ..)| *what != "set");
            }
            assert_eq!(a.len(), b.len(), "{name}: run {k}");
            for ((what, a, scale), (_, b, _)) in a.iter().zip(&b) {
                let off = (a - b).abs() / scale;
                most = most.max(off);
                if off > 0.1 * known {
                    println!(
                        "{name}: run {k}: {what}: {a} {b}, {off:.1e} impacts {:?}",
                        found.contacts[0].record
                    );
                }
            }
            flowed += usize::from(found.energy.plastic > 0.05 * found.energy.scale);
        }
        println!("{name}: {most:.1e}, {flowed} of 9 yielded");
        assert!(kind == Kind::OneSided || flowed > 6, "{name}: {flowed} of 9 yielded");
    }
}

/// The permanent deflection is that of a single run whatever holds the beam: an elastic support, or a stop that it has reached, whose springs are as
/// long as the beam's end is moved.
#[test]
fn permanent_deflections_on_springs_and_stops_are_those_of_single_runs() {
    let elastic = SupportKind::Elastic {
        direction: [1.0, 0.0],
        stiffness: [2e5, 4e5],
        damping: [0.0; 2],
        rotational_stiffness: 0.0,
        rotational_damping: 0.0,
    };
    let stop =
        SupportKind::Stop { direction: [0.0, -1.0], gap: 1e-3, stiffness: 4e5, two_sided: true };
    for kinds in [vec![elastic.clone()], vec![stop.clone()], vec![elastic, stop]] {
        let of = |end: f64| {
            let mut b = ModelBuilder::new();
            let steel = b.material(Material {
                strain: StrainMeasure::Engineering,
                inelasticity: Some(inelasticity(Kind::Perfect, 43e9)),
                ..Material::new("steel", 43e9, 1570.0)
            });
            let section = b.section(Section { fibres: 6, ..Section::rectangle("bar", 0.02, 0.04) });
            let bar = b.beam(beam("bar", [0.0; 2], [1.8, 0.0], 6, steel, section));
            b.support(Support::new("left", at("left", bar, 0.0), SupportKind::Pin));
            for (k, kind) in kinds.iter().enumerate() {
                b.support(Support::new(format!("{k}"), at("right", bar, 1.0), kind.clone()));
            }
            let law = ProjectileKind::spring(1e7);
            b.projectile(Projectile::new("mass", law, 0.6, [0.0, -8.0], at("struck", bar, 0.4)));
            (b.build().unwrap(), Settings::new(end, 1.5e-4))
        };
        let runs: Vec<_> = [0.042, 0.045, 0.048, 0.051, 0.054].map(of).into();
        for ((model, settings), found) in runs.iter().zip(batch(&runs)) {
            assert_eq!(runs_alone(model, settings, Detail::Motion), None);
            let single = simulate(model, settings, &mut NoRecorder).unwrap();
            let [a, b] = [&single, &found].map(|s| s.plastic[0].permanent_set);
            match [a, b] {
                [Ok(a), Ok(b)] => {
                    let off = [0, 1].map(|i| (a.displacement[i] - b.displacement[i]).abs());
                    assert!(a.size() > 1e-4, "{a:?}");
                    assert!(off.iter().all(|d| *d < 1e-5 * a.size()), "{kinds:?}: {a:?} {b:?}");
                }
                other => assert_eq!(other[0], other[1], "{kinds:?}"),
            }
        }
    }
}

#[test]
fn beams_that_yield_give_the_same_bits_alone_and_in_company() {
    for (kind, rigid) in all() {
        let runs = runs(kind, rigid);
        let text = |s: &RunSummary| format!("{s:?}"); // contains every float exactly
        for (k, together) in batch(&runs).iter().enumerate() {
            let alone = batch(&runs[k..=k]);
            assert_eq!(text(&alone[0]), text(together), "{kind:?}, {rigid:?}: run {k}");
        }
    }
}

/// Numbers of a scene and its end, with respect to which results are differentiated.
const NAMES: [&str; 9] =
    ["young", "density", "width", "depth", "mass", "speed", "where it strikes", "stiffness", "end"];

const RESULTS: [&str; 8] = [
    "peak displacement",
    "velocity",
    "impulse",
    "plastic energy",
    "hardening energy",
    "largest plastic strain",
    "largest accumulated plastic strain",
    "energy",
];

fn results(s: &RunSummary) -> [f64; 8] {
    let beam = &s.plastic[0];
    [
        s.points[0].displacement_max[1].value,
        s.projectiles[0].velocity_final[1],
        impulse(&s.contacts[0].record),
        beam.dissipated,
        beam.hardening,
        beam.strain_max.value,
        beam.accumulated_max.value,
        s.energy.final_,
    ]
}

/// Relative changes of a parameter for differences: a fibre that begins or ceases to yield within a change causes a kink, whose effect on the
/// difference vanishes with the change, while round-off grows.
const SHARES: [f64; 3] = [1e-5, 1e-6, 1e-7];

/// Derivatives compared with fourth-order differences of whole runs.
fn check(kind: Kind, end: f64) {
    let base: [f64; 9] = std::array::from_fn(|i| if i < 8 { BASE[i] } else { end });
    let moved = |i: usize, by: f64| {
        let mut p = base;
        p[i] += by;
        p
    };
    let of = |p: &[f64; 9]| {
        let numbers: [f64; 8] = std::array::from_fn(|i| p[i]);
        (scene(kind, None, &numbers), Settings::new(p[8], 1e-5))
    };
    let variation = |i: usize| {
        let change = 1e-3 * base[i];
        let each = [-2.0, -1.0, 1.0, 2.0].map(|k| moved(i, k * change));
        Variation {
            size: base[i],
            differences: vec![Difference {
                models: each.map(|p| of(&p).0),
                ends: each.map(|p| p[8]),
                change,
            }],
        }
    };
    let variations: Vec<_> = (0..9).map(variation).collect();
    let (model, settings) = of(&base);
    let found = sensitivities(&model, &settings, &variations).unwrap();
    assert_eq!(found.horizon, None, "{kind:?}");
    let run = |p: &[f64; 9]| {
        let (model, settings) = of(p);
        results(&simulate(&model, &settings, &mut NoRecorder).unwrap())
    };
    let (single, mut off, mut worst) = (run(&base), Vec::new(), 0.0_f64);
    for (i, (name, value)) in NAMES.iter().zip(base).enumerate() {
        let differences = SHARES.map(|share| {
            let change = share * value;
            let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| run(&moved(i, k * change)));
            let difference = |k: usize| (8.0 * (c[k] - b[k]) - (d[k] - a[k])) / (12.0 * change);
            std::array::from_fn::<f64, 8, _>(difference)
        });
        let derivative = results(&found.derivatives[i]);
        for (k, what) in RESULTS.iter().enumerate() {
            let miss = differences.map(|difference| {
                let scale = difference[k].abs().max(1e-3 * (single[k] / value).abs());
                if scale > 0.0 { (derivative[k] - difference[k]).abs() / scale } else { 0.0 }
            });
            let miss = miss.into_iter().fold(f64::INFINITY, f64::min);
            worst = worst.max(miss);
            if miss.is_nan() || miss > 2e-5 {
                off.push(format!("{what} by {name}: {} {miss:.1e}", derivative[k]));
            }
        }
    }
    println!("{kind:?}: {worst:.1e}");
    assert!(off.is_empty(), "{kind:?}: {off:#?}");
}

#[test]
fn derivatives_through_plastic_flow() {
    for kind in [Kind::Table, Kind::Kinematic, Kind::Rate, Kind::Composite, Kind::Perfect] {
        check(kind, 3.003e-3);
    }
}

/// Impacts in which the bar nearly yields, or only just yields.
#[test]
fn a_beam_that_is_about_to_yield_says_so() {
    let of = |speed: f64| {
        let mut p = BASE;
        p[5] = speed;
        scene(Kind::Perfect, None, &p)
    };
    let settings = Settings::new(3e-3, 1e-5);
    let flows = |speed: f64| {
        let summary = simulate(&of(speed), &settings, &mut NoRecorder).unwrap();
        summary.plastic[0].first_yield.is_some()
    };
    let (mut low, mut high) = (0.1, 30.0);
    while high - low > 1e-6 {
        let middle = 0.5 * (low + high);
        *(if flows(middle) { &mut high } else { &mut low }) = middle;
    }
    for (speed, missed) in [(0.997 * low, true), (1.003 * low, false)] {
        let change = 1e-3 * speed;
        let models = [-2.0, -1.0, 1.0, 2.0].map(|k| of(speed + k * change));
        let variation = Variation {
            size: 1e3 * change,
            differences: vec![Difference { models, ends: [settings.end; 4], change }],
        };
        let found = sensitivities(&of(speed), &settings, &[variation]).unwrap();
        let yields = |g: &&Grazing| g.onset == Onset::Yield("bar".into());
        let near = found.grazing.iter().find(yields).unwrap();
        assert_eq!(near.missed, missed);
        let at = speed + near.changes[0];
        assert!((at / low - 1.0).abs() < 1e-3, "{speed}: {at}, {low}");
    }
}

/// Runs with failing fibres are computed as single runs, and their derivatives end at the failure.
#[test]
fn a_fibre_that_fails_leaves_its_lane_and_ends_derivatives() {
    let weak = |speed: f64| {
        let mut b = ModelBuilder::new();
        let Inelasticity::Plastic(law) = inelasticity(Kind::Table, 205e9) else { unreachable!() };
        let law = Inelasticity::Plastic(Plasticity { failure_strain: Some(0.02), ..law });
        let steel = Material { inelasticity: Some(law), ..Material::new("steel", 205e9, 7850.0) };
        let strain = StrainMeasure::Engineering;
        let steel = b.material(Material { strain, ..steel });
        let section = b.section(Section { fibres: 6, ..Section::rectangle("bar", 0.04, 0.02) });
        let bar = b.beam(beam("bar", [0.0; 2], [0.8, 0.05], 6, steel, section));
        for (name, f) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, bar, f), SupportKind::Clamp));
        }
        let kind = ProjectileKind::spring(1e8);
        b.projectile(Projectile::new("mass", kind, 2.0, [0.0, -speed], at("struck", bar, 0.52)));
        b.build().unwrap()
    };
    let settings = Settings::new(3e-3, 1e-5);
    let runs: Vec<_> = [10.0, 60.0, 20.0].map(|speed| (weak(speed), settings)).into();
    let found = batch(&runs);
    let failed: Vec<_> = found.iter().map(|s| s.plastic[0].failed > 0).collect();
    assert_eq!(failed, [false, true, false]);
    let single = simulate(&runs[1].0, &settings, &mut NoRecorder).unwrap();
    assert_eq!(single.plastic, found[1].plastic);
    let models = [59.88, 59.94, 60.06, 60.12].map(weak);
    let variation = Variation {
        size: 60.0,
        differences: vec![Difference { models, ends: [settings.end; 4], change: 0.06 }],
    };
    let derived = sensitivities(&runs[1].0, &settings, &[variation]).unwrap();
    let horizon = derived.horizon.unwrap();
    assert!(horizon.why.contains("fibre fails"), "{horizon:?}");
    assert!(derived.derivatives[0].plastic[0].dissipated.is_nan());
}
