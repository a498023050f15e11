//! Rigid impacts: several at once, resting, accumulating.

use crate::common;

use common::*;
use percuss::*;

fn girder(supported: bool, shots: &[(f64, [f64; 2], f64)]) -> Model {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
    if supported {
        for (name, f) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, girder, f), SupportKind::Pin));
        }
    }
    for (i, (f, velocity, e)) in shots.iter().enumerate() {
        b.projectile(rigid(&format!("hammer{i}"), at(&format!("p{i}"), girder, *f), *velocity, *e));
    }
    b.build().unwrap()
}

fn run(model: &Model, settings: &Settings) -> RunSummary {
    let summary = simulate(model, settings, &mut NoRecorder).unwrap();
    assert!(matches!(summary.termination, Termination::Completed), "{summary:?}");
    summary
}

fn impacts(summary: &RunSummary, i: usize) -> &[Impact] {
    match &summary.contacts[i].record {
        ContactRecord::Nonsmooth { impacts, .. } => impacts,
        ContactRecord::Smooth { .. } => panic!("a rigid projectile"),
    }
}

fn assert_balances(summary: &RunSummary) {
    assert!(summary.energy.residual_max < 1e-10, "{:e}", summary.energy.residual_max);
    assert!(summary.momentum.linear_residual_max < 1e-10);
    assert!(summary.momentum.angular_residual_max < 1e-10);
    assert!(summary.energy.loss_impacts >= -1e-10 * summary.energy.scale);
}

#[test]
fn projectiles_that_arrive_together_strike_together() {
    let down = [0.0, -40.0];
    let model = girder(true, &[(0.25, down, 1.0), (0.75, down, 1.0), (0.5, down, 0.3)]);
    let summary = run(&model, &Settings::new(0.02, 1e-5));
    assert_balances(&summary);
    for i in 0..3 {
        let first = impacts(&summary, i)[0];
        assert!((first.time - 5e-4).abs() < 1e-12);
        let e = if i == 2 { 0.3 } else { 1.0 };
        assert!((first.separation_velocity - e * first.approach_velocity).abs() < 1e-9);
    }
    // A symmetric scene stays symmetric.
    let [a, b] = [0, 1].map(|i| summary.projectiles[i].velocity_final[1]);
    assert!((a - b).abs() < 1e-6 * 40.0, "{a} {b}");
}

#[test]
fn projectiles_from_both_sides_and_askew() {
    let shots = [(0.2, [10.0, -40.0], 0.7), (0.61, [0.0, 30.0], 1.0), (1.0, [-20.0, 0.0], 0.0)];
    for supported in [true, false] {
        assert_balances(&run(&girder(supported, &shots), &Settings::new(0.01, 1e-5)));
        let time_stepping = Settings {
            impacts: ImpactResolution::TimeStepping { closed_tolerance: 1e-9 },
            ..Settings::new(0.01, 1e-5)
        };
        assert_balances(&run(&girder(supported, &shots), &time_stepping));
    }
}

#[test]
fn a_plastic_impact_rides_along_until_the_beam_throws_it_off() {
    let model = girder(true, &[(0.5, [0.0, -4.0], 0.0)]);
    let summary = run(&model, &Settings::new(0.2, 1e-4));
    assert_balances(&summary);
    let ContactRecord::Nonsmooth { intervals, .. } = &summary.contacts[0].record else { panic!() };
    assert!(!intervals.is_empty());
    assert!(intervals.iter().all(|i| i.impulse > 0.0));
    let thrown_off = summary.projectiles[0].velocity_final[1];
    assert!(thrown_off > 0.0, "{thrown_off}");
}

#[test]
fn impulses_account_for_the_change_of_momentum() {
    for e in [1.0, 0.5, 0.0] {
        let model = girder(true, &[(0.5, [0.0, -40.0], e)]);
        let summary = run(&model, &Settings::new(0.02, 1e-5));
        let ContactRecord::Nonsmooth { impulse_total, .. } = summary.contacts[0].record else {
            panic!()
        };
        let change = 100.0 * (summary.projectiles[0].velocity_final[1] + 40.0);
        assert!((impulse_total - change).abs() < 1e-9 * change, "{impulse_total} {change}");
    }
}

#[test]
fn a_projectile_laid_on_a_rigid_beam_rests_there() {
    use Component::{Displacement1, Displacement2, Rotation, Stretch};
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 1, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        let components = vec![Displacement1, Displacement2, Rotation, Stretch];
        let kind = SupportKind::Fix { components };
        b.support(Support::new(name, at(name, girder, f), kind));
    }
    let mut laid = rigid("weight", at("mid", girder, 0.5), [0.0, 0.0], 0.5);
    laid.direction = Some([0.0, -1.0]);
    laid.standoff = 0.0;
    b.projectile(laid);
    let kind = LoadKind::Gravity { acceleration: [0.0, -9.81] };
    b.load(Load::new("weight", kind));
    let summary = run(&b.build().unwrap(), &Settings::new(0.5, 1e-3));
    assert_balances(&summary);
    let ContactRecord::Nonsmooth { impact_count, impulse_total, .. } = summary.contacts[0].record
    else {
        panic!()
    };
    assert_eq!(impact_count, 0);
    assert!((impulse_total / (100.0 * 9.81 * 0.5) - 1.0).abs() < 1e-12, "{impulse_total}");
}

#[test]
fn rows_never_go_back_in_time_and_show_both_sides_of_an_impact() {
    // The first impact falls on the end of a step.
    let model = girder(true, &[(0.5, [0.0, -40.0], 0.0)]);
    for end in [5e-4, 3e-3] {
        let mut memory = MemoryRecorder::default();
        simulate(&model, &Settings::new(end, 1e-5), &mut memory).unwrap();
        let time = memory.column("time").unwrap();
        assert!(time.windows(2).all(|w| w[1] > w[0]), "{time:?}");
        let speed = memory.column("projectile.hammer0.velocity_2").unwrap();
        let impulse = memory.column("contact.hammer0.impulse").unwrap();
        if end > 1e-3 {
            let row = impulse.iter().position(|j| *j > 0.0).unwrap();
            assert!((100.0 * (speed[row] - speed[row - 1]) - impulse[row]).abs() < 1e-9);
            assert!(time[row] - time[row - 1] < 1e-10);
        }
    }
}

#[test]
fn impulses_of_the_rows_add_up_to_the_momentum_handed_over() {
    for is_elastic in [true, false] {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
        let mid = at("mid", girder, 0.5);
        b.projectile(if is_elastic {
            elastic("shot", mid, [0.0, 20.0])
        } else {
            rigid("shot", mid, [0.0, 20.0], 0.4)
        });
        let mut memory = MemoryRecorder::default();
        let settings = Settings { record_every: 7, ..Settings::new(0.12, 1e-4) };
        let summary = simulate(&b.build().unwrap(), &settings, &mut memory).unwrap();
        let sum: f64 = memory.column("contact.shot.impulse").unwrap().iter().sum();
        let given = summary.projectiles[0].momentum_transferred;
        assert!((sum - given).abs() < 1e-9 * given, "{sum} {given}");
    }
}

#[test]
fn the_summary_names_the_line_of_motion_and_the_struck_point_also_of_a_projectile_that_turns_back()
{
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
    b.projectile(rigid("shot", at("girder.mid", girder, 0.5), [12.0, 16.0], 1.0));
    let summary = simulate(&b.build().unwrap(), &Settings::new(0.12, 1e-4), &mut NoRecorder);
    let shot = &summary.unwrap().projectiles[0];
    let [x, y] = shot.direction.unwrap();
    assert!((x - 0.6).abs() < 1e-15 && (y - 0.8).abs() < 1e-15, "{x} {y}");
    assert_eq!(shot.strikes.as_deref(), Some("girder.mid"));
}

#[test]
fn energy_given_by_a_projectile_is_distinguished_from_that_received() {
    // A free beam with an added mass of 20 kg at the struck point: 1 kg at 10 m/s transfers nearly all of its 50 J, most of which is dissipated in
    // the impact.
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(Section::rectangle("s", 0.04, 0.05));
    let beam = b.beam(Beam::new("b", &[[0.0, 0.0], [1.5, 0.0]], 8, material, section));
    let flying = rigid("p", at("b.mid", beam, 0.5), [0.0, -10.0], 0.0);
    b.projectile(Projectile { mass: 1.0, standoff: 0.0, local_mass: 20.0, ..flying });
    let model = b.build().unwrap();
    let summary = simulate(&model, &Settings::new(1e-3, 2e-5), &mut NoRecorder).unwrap();
    let (p, energy) = (&summary.projectiles[0], &summary.energy);
    let left = 0.5 * p.velocity_final[1] * p.velocity_final[1];
    assert!((p.energy_given - (50.0 - left)).abs() < 1e-9, "{}", p.energy_given);
    // Without other actions the momentum of the structure is the transferred one.
    let structure = energy.final_ - left;
    assert!(
        (p.energy_received_by_others - structure).abs() < 1e-9,
        "{}",
        p.energy_received_by_others
    );
    assert!((p.energy_given - p.energy_received_by_others - energy.loss_impacts).abs() < 1e-9);
    assert!(p.energy_given > 45.0 && p.energy_received_by_others < 5.0);
}

/// Two discs that fall on a clamped bar left and right of its middle, equally far from it and equally heavy.
fn mirrored(restitution: f64, friction: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = Section { depth: Some(0.02), ..Section::new("bar", 1e-3, 3.3333e-8) };
    let section = b.section(section);
    let deck = b.beam(beam("deck", [-1.0, 0.0], [1.0, 0.0], 8, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, deck, f), SupportKind::Clamp));
    }
    for (name, x) in [("a", -0.5), ("b", 0.5)] {
        let disc = b.disc(disc(name, 1.0, 0.05, [x, 0.161], [0.0; 2]));
        let law = RigidLaw { friction, ..RigidLaw::frictionless(restitution) };
        let between = [ContactPartner::Disc(disc), ContactPartner::Beam(deck)];
        b.contact(Contact::new(name, between, TouchLaw::Rigid(law)));
    }
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    b.build().unwrap()
}

/// Round-off would decide which of two mirrored contacts closes first: they close together, and gaps of round-off are no velocities. Symmetry is
/// therefore preserved through hundreds of impacts that accumulate, come to rest and start again.
#[test]
fn mirrored_discs_stay_mirrored_through_accumulation() {
    let cases = [(0.5, 0.0), (0.5, 0.3), (0.2, 0.0), (0.0, 0.0)];
    for ((e, friction), multiple_impacts) in cases.into_iter().flat_map(|case| {
        [MultipleImpacts::Simultaneous, MultipleImpacts::Sequential].map(|m| (case, m))
    }) {
        let settings = Settings { multiple_impacts, ..Settings::new(0.8, 1e-3) };
        let summary = run(&mirrored(e, friction), &settings);
        let about = format!("e = {e}, friction {friction}, {multiple_impacts:?}");
        let (a, b) = (impacts(&summary, 0), impacts(&summary, 1));
        assert!(a.len() == b.len() && a.len() > 20, "{about}: {} {}", a.len(), b.len());
        let hardest = a.iter().map(|i| i.impulse).fold(0.0, f64::max);
        for (x, y) in a.iter().zip(b) {
            assert!((x.time - y.time).abs() < 1e-9 * x.time, "{about}: {x:?} {y:?}");
            assert!((x.impulse - y.impulse).abs() < 1e-9 * hardest, "{about}: {x:?} {y:?}");
            let apart = x.approach_velocity - y.approach_velocity;
            assert!(apart.abs() < 1e-9 * a[0].approach_velocity, "{about}: {x:?} {y:?}");
        }
        let rested = |i: usize| match &summary.contacts[i].record {
            ContactRecord::Nonsmooth { intervals, .. } => intervals.clone(),
            ContactRecord::Smooth { .. } => panic!("a rigid contact"),
        };
        assert!(rested(0).len() == rested(1).len() && !rested(0).is_empty(), "{about}");
        for (x, y) in rested(0).iter().zip(&rested(1)) {
            assert!((x.start - y.start).abs() < 1e-9 * x.start, "{about}: {x:?} {y:?}");
            assert!((x.impulse - y.impulse).abs() < 1e-9 * hardest, "{about}: {x:?} {y:?}");
        }
        let [a, b] = [0, 1]
            .map(|i| (summary.projectiles[i].velocity_final, summary.projectiles[i].spin_final));
        let apart = [a.0[0] + b.0[0], a.0[1] - b.0[1], 0.05 * (a.1 + b.1)];
        assert!(apart.iter().all(|v| v.abs() < 1e-9), "{about}: {apart:?}");
    }
}
