//! Beams with joints, spring supports and stops, in lanes: the results of single runs, and the same bits alone and beside others.

use crate::common;

use common::numbers::Numbers;
use common::{at, beam};
use percuss::*;
use percuss_batch::*;

/// A portal of three beams, one corner rigid and one a hinge or both rigid, a roller between two nodes of the girder or a foot on springs
/// and a stop below the girder, struck from above.
#[derive(Clone, Copy, Debug)]
struct Portal {
    hinged: bool,
    roller: bool,
    sprung: bool,
    rigid: Option<f64>,
}

/// All variants of the portal.
fn portals() -> impl Iterator<Item = Portal> {
    let held = [(false, false), (true, false), (false, true)];
    let kinds = [false, true].into_iter().flat_map(move |hinged| held.map(|held| (hinged, held)));
    kinds.flat_map(|(hinged, (roller, sprung))| {
        [None, Some(0.6), Some(0.0)].map(|rigid| Portal { hinged, roller, sprung, rigid })
    })
}

fn model(kind: Portal, draw: &mut Numbers) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", draw.between(5e9, 2e10), 3e3));
    let section = b.section(Section::new("s", 0.1, 8.33e-4));
    let height = draw.between(2.5, 3.5);
    let (left, right) = ([0.0, height], [4.0, height + draw.between(-0.5, 0.5)]);
    let a = b.beam(beam("a", [0.0; 2], left, 4, material, section));
    let g = b.beam(beam("girder", left, right, 5, material, section));
    let c = b.beam(beam("c", [4.5, 0.0], right, 3, material, section));
    b.support(Support::new("foot", at("a.start", a, 0.0), SupportKind::Clamp));
    let (stiff, damped) = (draw.between(1e7, 1e8), draw.between(1e3, 1e4));
    let foot = if kind.sprung {
        SupportKind::Elastic {
            direction: [1.0, 0.1],
            stiffness: [2.0 * stiff, stiff],
            damping: [damped, 0.0],
            rotational_stiffness: 0.0,
            rotational_damping: 0.0,
        }
    } else {
        SupportKind::Pin
    };
    b.support(Support::new("pin", at("c.start", c, 0.0), foot));
    if kind.sprung {
        let (direction, gap) = ([0.1, -1.0], 1e-3 * draw.between(1.0, 3.0));
        let stop = SupportKind::Stop { direction, gap, stiffness: stiff, two_sided: kind.hinged };
        b.support(Support::new("stop", at("stops", g, 0.31), stop));
    }
    if kind.roller {
        let roller = SupportKind::Roller { direction: [1.0, 0.2] };
        b.support(Support::new("roller", at("rolls", g, draw.between(0.66, 0.72)), roller));
    }
    let knee = if kind.hinged { JointKind::Hinge } else { JointKind::Rigid };
    for (name, kind, between) in [
        ("knee", knee, [at("a.end", a, 1.0), at("girder.start", g, 0.0)]),
        ("corner", JointKind::Rigid, [at("c.end", c, 1.0), at("girder.end", g, 1.0)]),
    ] {
        b.joint(Joint::new(name, kind, between));
    }
    let law = match kind.rigid {
        Some(restitution) => ProjectileKind::Rigid { restitution },
        None => ProjectileKind::spring(draw.between(1e7, 5e7)),
    };
    let (mass, speed) = (draw.between(100.0, 300.0), draw.between(10.0, 30.0));
    let struck = at("struck", g, draw.between(0.42, 0.58));
    let projectile = Projectile::new("mass", law, mass, [0.0, -speed], struck);
    b.projectile(Projectile { standoff: draw.between(0.003, 0.02), ..projectile });
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    b.build().unwrap()
}

fn runs(kind: Portal, count: usize) -> Vec<(Model, Settings)> {
    let mut draw = Numbers(17);
    let step = if kind.rigid.is_some() { 2e-5 } else { 1e-4 };
    let end =
        |draw: &mut Numbers| if kind.rigid.is_some() { 0.006 } else { draw.between(0.02, 0.03) };
    (0..count).map(|_| (model(kind, &mut draw), Settings::new(end(&mut draw), step))).collect()
}

fn batch(runs: &[(Model, Settings)]) -> Vec<RunSummary> {
    let runs: Vec<(&Model, &Settings)> = runs.iter().map(|(m, s)| (m, s)).collect();
    simulate_batch(&runs, Detail::Motion).into_iter().map(Result::unwrap).collect()
}

/// Results of motion, impacts and balance, each with its scale.
fn scaled_results(s: &RunSummary) -> Vec<(&'static str, f64, f64)> {
    let energy = s.energy.scale;
    let mut all = vec![
        ("energy", s.energy.final_, energy),
        ("loss", s.energy.loss_impacts, energy),
        ("work", s.energy.work_loads, energy),
        ("velocity", s.projectiles[0].velocity_final[1], 10.0),
        ("given", s.projectiles[0].energy_given, energy),
        ("received", s.projectiles[0].energy_received_by_others, energy),
    ];
    for p in &s.points {
        all.extend(p.displacement_max.map(|peak| ("displacement", peak.value, 1e-2)));
    }
    match &s.contacts[0].record {
        ContactRecord::Smooth { peak_force, intervals } => {
            all.push(("force", peak_force.value, peak_force.value));
            let impulses =
                intervals.iter().map(|i| ("impulse", i.impulse, s.momentum.linear_scale));
            all.extend(impulses);
        }
        ContactRecord::Nonsmooth { impacts, impulse_total, .. } => {
            all.push(("total", *impulse_total, *impulse_total));
            let first = impacts.first().map(|i| ("impulse", i.impulse, i.impulse));
            all.extend(first);
        }
    }
    all
}

/// Tolerance for a run: each of many impacts magnifies the error of the previous one.
fn known(single: &RunSummary) -> f64 {
    match &single.contacts[0].record {
        ContactRecord::Nonsmooth { impacts, .. } if impacts.len() > 8 => 1e-5,
        _ => 1e-8,
    }
}

#[test]
fn joined_beams_move_in_lanes_as_they_do_alone() {
    for kind in portals() {
        let runs = runs(kind, 9);
        assert!(
            runs.iter()
                .all(|(model, settings)| runs_alone(model, settings, Detail::Motion).is_none())
        );
        for (k, ((model, settings), found)) in runs.iter().zip(batch(&runs)).enumerate() {
            let single = simulate(model, settings, &mut NoRecorder).unwrap();
            assert!(found.supports.is_empty(), "run {k} was not stepped in a lane");
            assert!(matches!(found.termination, Termination::Completed));
            let m = &found.momentum;
            let worst = found.energy.residual_max.max(m.linear_residual_max);
            let worst = worst.max(m.angular_residual_max);
            assert!(worst < 1e-10, "run {k}: {worst:e}");
            crate::scales::agree(&single, &found);
            let (a, b) = (scaled_results(&single), scaled_results(&found));
            assert_eq!(a.len(), b.len(), "run {k}");
            for ((what, a, scale), (_, b, _)) in a.iter().zip(&b) {
                assert!((a - b).abs() <= known(&single) * scale, "run {k}: {what}: {a} {b}");
            }
        }
    }
}

#[test]
fn joined_beams_give_the_same_bits_alone_and_in_company() {
    for kind in portals() {
        let runs = runs(kind, 9);
        let text = |s: &RunSummary| format!("{s:?}"); // contains every float exactly
        for (k, together) in batch(&runs).iter().enumerate() {
            let alone = batch(&runs[k..=k]);
            assert_eq!(text(&alone[0]), text(together), "run {k}");
        }
    }
}

#[test]
fn shear_flexible_beams_run_alone() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material { poisson: Some(0.3), ..Material::new("m", 2e10, 3e3) });
    let section = b.section(Section::rectangle("s", 0.2, 0.5));
    let slender = beam("arm", [0.0; 2], [3.0, 0.0], 3, material, section);
    let arm = b.beam(Beam { theory: Theory::Shear, ..slender });
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let (model, settings) = (b.build().unwrap(), Settings::new(0.1, 2e-4));
    assert_eq!(runs_alone(&model, &settings, Detail::Motion), Some("shear-flexible beams"));
    let refused = sensitivities(&model, &settings, &[]).err().map(|why| why.to_string());
    assert!(refused.is_some_and(|why| why.contains("shear-flexible beams")));
}

#[test]
fn joints_of_a_given_strength_run_alone() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 2e10, 3e3));
    let section = b.section(Section::new("s", 0.1, 8.33e-4));
    let column = b.beam(beam("column", [0.0; 2], [0.0, 3.0], 3, material, section));
    let girder = b.beam(beam("girder", [0.0, 3.0], [4.0, 3.0], 4, material, section));
    b.support(Support::new("foot", at("foot", column, 0.0), SupportKind::Clamp));
    b.support(Support::new("end", at("end", girder, 1.0), SupportKind::Clamp));
    let between = [at("column.end", column, 1.0), at("girder.start", girder, 0.0)];
    let strength = Some(JointStrength { force: Some(1e5), moment: None });
    b.joint(Joint { strength, ..Joint::new("knee", JointKind::Rigid, between) });
    let (model, settings) = (b.build().unwrap(), Settings::new(0.1, 2e-4));
    assert_eq!(runs_alone(&model, &settings, Detail::Motion), Some("joints of a given strength"));
}

#[test]
fn foundations_and_heat_run_alone() {
    let reason = |add: &dyn Fn(&mut ModelBuilder, BeamId)| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material { expansion: 1e-5, ..Material::new("m", 2e10, 3e3) });
        let section = b.section(Section::new("s", 0.1, 8.33e-4));
        let girder = b.beam(beam("girder", [0.0; 2], [4.0, 0.0], 4, material, section));
        b.support(Support::new("end", at("end", girder, 1.0), SupportKind::Clamp));
        add(&mut b, girder);
        runs_alone(&b.build().unwrap(), &Settings::new(0.1, 2e-4), Detail::Motion)
    };
    assert_eq!(reason(&|_, _| ()), None);
    let stretch = [0.0, 1.0].map(Along::Fraction);
    let curve = vec![Hardening { from: 0.0, stress: 1e4, modulus: 0.0 }];
    let limit = Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain: None };
    for yielding in [None, Some(limit)] {
        let found = reason(&|b, beam| {
            b.foundation(Foundation {
                name: "ground".into(),
                beam,
                stretch,
                direction: None,
                law: FoundationLaw::Linear { stiffness: 1e6 },
                damping: 0.0,
                yielding: yielding.clone(),
            });
        });
        assert_eq!(found, Some("foundations along beams"));
    }
    let found = reason(&|b, beam| {
        let heat = LoadKind::Temperature { beam, stretch, change: 10.0, gradient: 0.0 };
        b.load(Load::new("heat", heat));
    });
    assert_eq!(found, Some("given strains and temperatures"));
}
