//! Section forces of runs in lanes: extremes and envelopes of single runs, and the same bits alone and beside others.

use crate::common;

use common::numbers::Numbers;
use common::{at, beam};
use percuss::*;
use percuss_batch::*;

/// Kind of a frame and of its projectile.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Elastic,
    Damped,
    /// With gravity, a force inside an element, and a pressure along a part of the girder.
    Loaded,
    Yielding,
    Rigid,
}

const KINDS: [Kind; 5] = [Kind::Elastic, Kind::Damped, Kind::Loaded, Kind::Yielding, Kind::Rigid];

/// A post and a girder, joined in a corner; a projectile strikes between two nodes of the girder.
fn model(kind: Kind, draw: &mut Numbers) -> Model {
    let mut b = ModelBuilder::new();
    let young = draw.between(1.8e11, 2.2e11);
    let own = Material::new("m", young, 7850.0);
    let material = match kind {
        Kind::Damped | Kind::Rigid => Material { retardation: 2e-6, mass_damping: 20.0, ..own },
        Kind::Yielding => {
            let curve = vec![Hardening { from: 0.0, stress: 1.2e-3 * young, modulus: 0.0 }];
            let law = Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain: None };
            Material { inelasticity: Some(Inelasticity::Plastic(law)), ..own }
        }
        Kind::Elastic | Kind::Loaded => own,
    };
    let material = b.material(material);
    let section = b.section(Section::rectangle("bar", 0.04, draw.between(0.02, 0.03)));
    let corner = [draw.between(-0.1, 0.1), 0.7];
    let post = b.beam(beam("post", [0.0; 2], corner, 3, material, section));
    let girder = b.beam(beam("girder", corner, [1.0, 0.75], 5, material, section));
    b.support(Support::new("foot", at("post.start", post, 0.0), SupportKind::Clamp));
    b.support(Support::new("pin", at("girder.end", girder, 1.0), SupportKind::Pin));
    let between = [at("post.end", post, 1.0), at("girder.start", girder, 0.0)];
    b.joint(Joint::new("corner", JointKind::Rigid, between));
    let law = match kind {
        Kind::Rigid => ProjectileKind::Rigid { restitution: 0.4 },
        _ => ProjectileKind::spring(draw.between(1e7, 2e7)),
    };
    let speed = if kind == Kind::Yielding { 25.0 } else { draw.between(5.0, 10.0) };
    let struck = at("struck", girder, draw.between(0.42, 0.48));
    let mass = Projectile::new("mass", law, draw.between(1.0, 3.0), [0.0, -speed], struck);
    b.projectile(Projectile { standoff: 1.3e-3, ..mass });
    if kind == Kind::Loaded {
        b.load(Load::new("weight", LoadKind::Gravity { acceleration: [1.0, -9.81] }));
        let place = at("pushed", girder, 0.71);
        let force = [300.0, draw.between(-4e3, -2e3)];
        let push = LoadKind::Point { at: place, force, moment: 0.0, follower: false };
        let function = TimeFunction::HalfSine { duration: 2.1e-3 };
        b.load(Load { function, until: 2.1e-3, ..Load::new("push", push) });
        let stretch = [Along::Fraction(0.1), Along::Distance(0.63)];
        let force = [[0.0, -1e3], [1e2, draw.between(-3e3, 3e3)]];
        let wind = LoadKind::Distributed { beam: girder, stretch, force, follower: false };
        b.load(Load::new("wind", wind));
    }
    b.build().unwrap()
}

fn runs(kind: Kind) -> Vec<(Model, Settings)> {
    let mut draw = Numbers(31);
    (0..9)
        .map(|_| (model(kind, &mut draw), Settings::new(draw.between(2e-3, 3e-3), 1e-5)))
        .collect()
}

/// Summaries with section forces of runs of a kind, computed in lanes.
fn detail(kind: Kind) -> Detail {
    if kind == Kind::Yielding { Detail::Resultants } else { Detail::Stresses }
}

fn batch(runs: &[(Model, Settings)], detail: Detail) -> Vec<RunSummary> {
    let runs: Vec<(&Model, &Settings)> = runs.iter().map(|(m, s)| (m, s)).collect();
    simulate_batch(&runs, detail).into_iter().map(Result::unwrap).collect()
}

/// Least and largest axial force, shear force, moment and stress of a beam, shape (4, 2).
fn peaks(beam: &SectionForceSummary) -> [[SectionPeak; 2]; 4] {
    [&beam.axial, &beam.shear, &beam.moment, &beam.stress].map(|range| [range.min, range.max])
}

fn envelopes(beam: &SectionForceSummary) -> [&[Vec<f64>; 2]; 4] {
    let e = &beam.envelope;
    [&e.axial, &e.shear, &e.moment, &e.stress]
}

/// Tolerance between forces of single runs and those of another iteration: impacts magnify the error of their instant.
fn known(kind: Kind) -> f64 {
    if kind == Kind::Rigid { 1e-5 } else { 1e-7 }
}

#[test]
fn section_forces_side_by_side_are_those_of_single_runs() {
    for kind in KINDS {
        let runs = runs(kind);
        for (found, (model, settings)) in batch(&runs, detail(kind)).iter().zip(&runs) {
            assert_eq!(runs_alone(model, settings, detail(kind)), None);
            assert!(found.supports.is_empty());
            let single = simulate(model, settings, &mut NoRecorder).unwrap();
            assert_eq!(single.section_forces.len(), found.section_forces.len());
            for (own, side) in single.section_forces.iter().zip(&found.section_forces) {
                compare(kind, own, side, settings.step);
            }
        }
    }
}

#[track_caller]
fn compare(kind: Kind, own: &SectionForceSummary, side: &SectionForceSummary, step: f64) {
    assert_eq!(own.name, side.name);
    assert!(side.strain.min.value.is_nan());
    let count = if kind == Kind::Yielding { 3 } else { 4 };
    for (peaks, envelope) in peaks(side).iter().zip(envelopes(side)).skip(count) {
        assert!(peaks.iter().all(|peak| peak.value.is_nan()));
        assert!(envelope.iter().flatten().all(|x| x.is_nan()));
    }
    let both = peaks(own).into_iter().zip(peaks(side)).take(count);
    let envelopes = envelopes(own).into_iter().zip(envelopes(side));
    for ((a, b), envelope) in both.zip(envelopes) {
        let scale = a[0].value.abs().max(a[1].value.abs());
        assert!(scale > 1.0, "{kind:?} {}: hardly a force", own.name);
        let near = |a: f64, b: f64| (a - b).abs() <= known(kind) * scale;
        for (a, b) in a.iter().zip(&b) {
            assert!(near(a.value, b.value), "{kind:?} {}: {a:?} {b:?}", own.name);
            assert!((a.s - b.s).abs() < 1e-4, "{kind:?} {}: {a:?} {b:?}", own.name);
            assert!((a.time - b.time).abs() < 1e-3 * step, "{kind:?} {}: {a:?} {b:?}", own.name);
        }
        for (a, b) in envelope.0.iter().flatten().zip(envelope.1.iter().flatten()) {
            assert!(near(*a, *b), "{kind:?} {}: envelope {a} {b}", own.name);
        }
    }
}

/// Runs are independent of each other, and the requested detail does not change the other results.
#[test]
fn section_forces_alone_and_in_company_have_the_same_bits() {
    for kind in KINDS {
        let runs = runs(kind);
        let together = batch(&runs, detail(kind));
        let moving: Vec<(&Model, &Settings)> = runs.iter().map(|(m, s)| (m, s)).collect();
        let moving = simulate_batch(&moving, Detail::Motion);
        for ((run, one), moving) in runs.iter().zip(&together).zip(moving) {
            let alone = batch(std::slice::from_ref(run), detail(kind)).pop().unwrap();
            let bits = |s: &RunSummary| -> Vec<u64> {
                let all = s.section_forces.iter().flat_map(peaks).flatten();
                all.flat_map(|p| [p.value, p.s, p.time].map(f64::to_bits)).collect()
            };
            assert_eq!(bits(&alone), bits(one), "{kind:?}");
            let mut moving = moving.unwrap();
            assert!(moving.section_forces.is_empty());
            moving.section_forces.clone_from(&one.section_forces);
            assert_eq!(moving.energy, one.energy, "{kind:?}");
            assert_eq!(moving.points, one.points, "{kind:?}");
        }
    }
}
