//! Connected beams: the conditions of a joint, and its zero work.

use crate::common;

use common::*;
use percuss::*;

/// A portal corner: a column clamped at its foot and a girder, joined at the top, struck at the girder's tip.
fn corner(kind: JointKind, angle: f64) -> Model {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let tip = [2.0 * angle.cos(), 3.0 + 2.0 * angle.sin()];
    let column = b.beam(beam("column", [0.0, 0.0], [0.0, 3.0], 5, material, section));
    let girder = b.beam(beam("girder", [0.0, 3.0], tip, 4, material, section));
    b.support(Support::new("foot", at("column.start", column, 0.0), SupportKind::Clamp));
    if kind == JointKind::Hinge {
        // A girder on a hinge alone would rotate about it: its tip is supported sideways.
        b.support(Support::new(
            "tip",
            at("girder.end", girder, 1.0),
            SupportKind::Roller { direction: [1.0, 0.3] },
        ));
    }
    b.joint(Joint {
        name: "knee".into(),
        kind,
        between: [at("column.end", column, 1.0), at("girder.start", girder, 0.0)],
        yielding: None,
        strength: None,
    });
    b.projectile(elastic("mass", at("girder@0.6", girder, 0.6), [0.0, -20.0]));
    b.build().unwrap()
}

fn worst(summary: &RunSummary) -> f64 {
    let m = &summary.momentum;
    summary.energy.residual_max.max(m.linear_residual_max).max(m.angular_residual_max)
}

#[test]
fn a_joint_does_no_work() {
    for kind in [JointKind::Rigid, JointKind::Hinge] {
        for angle in [0.0, 0.9, -0.4] {
            let model = corner(kind, angle);
            let summary = simulate(&model, &Settings::new(0.3, 1e-3), &mut NoRecorder).unwrap();
            assert!(matches!(summary.termination, Termination::Completed), "{summary:?}");
            assert!(worst(&summary) < 1e-10, "{kind:?} {angle}: {:e}", worst(&summary));
            assert!(summary.projectiles[0].velocity_final[1].abs() < 19.9, "nothing was struck");
        }
    }
}

#[test]
fn a_rigid_corner_keeps_its_place_and_its_angle() {
    for angle in [0.0, 0.9] {
        let model = corner(JointKind::Rigid, angle);
        let mut simulation = Simulation::new(&model, &Settings::new(0.3, 1e-3)).unwrap();
        let mut turned = 0.0_f64;
        while simulation.state().step < simulation.step_count() {
            simulation.advance(&mut NoRecorder).unwrap();
            let u = &simulation.state().displacement;
            let (end, start) = (&u[5], &u[6]);
            let (column, girder) =
                ([end[2], 1.0 + end[3]], [angle.cos() + start[2], angle.sin() + start[3]]);
            let now = (column[0] * girder[1] - column[1] * girder[0])
                .atan2(column[0] * girder[0] + column[1] * girder[1]);
            let reference = angle - std::f64::consts::FRAC_PI_2;
            assert!((now - reference).abs() < 1e-12, "{:e}", now - reference);
            assert!((end[0] - start[0]).abs() < 1e-12 && (end[1] - start[1]).abs() < 1e-12);
            turned = turned.max(column[0].atan2(column[1]).abs());
        }
        assert!(turned > 0.05, "the corner turned by {turned} only");
    }
}

#[test]
fn two_beams_joined_in_line_move_as_one() {
    let rebound = |split: bool, elements: usize| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let mut ends = Vec::new();
        if split {
            let left =
                b.beam(beam("left", [0.0, 0.0], [1.5, 0.0], elements / 2, material, section));
            let right =
                b.beam(beam("right", [1.5, 0.0], [3.0, 0.0], elements / 2, material, section));
            b.joint(Joint {
                name: "middle".into(),
                kind: JointKind::Rigid,
                between: [at("left.end", left, 1.0), at("right.start", right, 0.0)],
                yielding: None,
                strength: None,
            });
            ends.extend([at("left.start", left, 0.0), at("right.end", right, 1.0)]);
            b.projectile(elastic("mass", at("left.end", left, 1.0), [0.0, 20.0]));
        } else {
            let whole = b.beam(beam("whole", [0.0, 0.0], [3.0, 0.0], elements, material, section));
            ends.extend([at("whole.start", whole, 0.0), at("whole.end", whole, 1.0)]);
            b.projectile(elastic("mass", at("whole.mid", whole, 0.5), [0.0, 20.0]));
        }
        for (i, at) in ends.into_iter().enumerate() {
            b.support(Support::new(format!("s{i}"), at, SupportKind::Clamp));
        }
        let model = b.build().unwrap();
        let summary = simulate(&model, &Settings::new(0.12, 1e-4), &mut NoRecorder).unwrap();
        assert!(worst(&summary) < 1e-10);
        summary.projectiles[0].velocity_final[1]
    };
    // A joint allows a jump of the stretch, a single beam does not: close, not equal.
    for elements in [4, 8, 16, 32] {
        let (joined, whole) = (rebound(true, elements), rebound(false, elements));
        assert!((joined - whole).abs() < 1e-6 * whole.abs(), "{elements}: {joined} {whole}");
    }
}

#[test]
fn beams_apart_do_not_feel_each_other() {
    let lone = |apart: bool| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let struck = b.beam(beam("struck", [0.0, 0.0], [3.0, 0.0], 6, material, section));
        b.projectile(elastic("mass", at("struck.mid", struck, 0.5), [0.0, 20.0]));
        if apart {
            let other = b.beam(beam("other", [0.0, 9.0], [1.0, 8.0], 3, material, section));
            b.support(Support::new("other", at("other.start", other, 0.0), SupportKind::Pin));
        }
        let model = b.build().unwrap();
        let mut simulation = Simulation::new(&model, &Settings::new(0.1, 1e-3)).unwrap();
        while simulation.state().step < simulation.step_count() {
            simulation.advance(&mut NoRecorder).unwrap();
        }
        simulation.state().displacement[..7].to_vec()
    };
    for (a, b) in lone(true).iter().zip(&lone(false)) {
        for i in 0..4 {
            assert!((a[i] - b[i]).abs() < 1e-11);
        }
    }
}

/// A corner whose joint has the given strength, with the given impact velocity.
fn brittle(kind: JointKind, strength: JointStrength, speed: f64) -> Model {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let column = b.beam(beam("column", [0.0, 0.0], [0.0, 3.0], 5, material, section));
    let girder = b.beam(beam("girder", [0.0, 3.0], [2.0, 3.0], 4, material, section));
    for (name, beam, f) in [("foot", column, 0.0), ("far", girder, 1.0)] {
        b.support(Support::new(name, at(name, beam, f), SupportKind::Clamp));
    }
    let between = [at("column.end", column, 1.0), at("girder.start", girder, 0.0)];
    b.joint(Joint { strength: Some(strength), ..Joint::new("knee", kind, between) });
    b.projectile(elastic("mass", at("girder@0.4", girder, 0.4), [0.0, -speed]));
    b.build().unwrap()
}

fn strength_of(force: f64, moment: f64) -> JointStrength {
    let given = |x: f64| (x > 0.0).then_some(x);
    JointStrength { force: given(force), moment: given(moment) }
}

#[test]
fn a_joint_tears_beyond_its_strength_and_balances_stay_closed() {
    let settings = Settings::new(0.1, 2e-4);
    for (kind, strength) in [
        (JointKind::Rigid, strength_of(1e5, 0.0)),
        (JointKind::Rigid, strength_of(0.0, 2e4)),
        (JointKind::Hinge, strength_of(1e5, 0.0)),
    ] {
        let model = brittle(kind, strength, 20.0);
        let torn = simulate(&model, &settings, &mut NoRecorder).unwrap();
        assert!(matches!(torn.termination, Termination::Completed), "{:?}", torn.termination);
        assert!(worst(&torn) < 1e-10, "{:e}", worst(&torn));
        let parted = torn.joints[0].parted.expect("it tears");
        let most = [strength.force, strength.moment].map(|limit| limit.unwrap_or(f64::INFINITY));
        assert!(parted.force > most[0] || parted.moment > most[1], "{parted:?}");
        assert_eq!(torn.contacts[0].equivalent_force, None);
        // Its load before failure does not exceed that, and it has no load afterwards.
        assert!(torn.joints[0].force_max.time <= parted.time);
        assert!(torn.joints[0].moment_max.time <= parted.time || kind == JointKind::Hinge);
        // With a larger strength it does not fail, and the run is that of a joint without a strength.
        let more =
            strength_of(strength.force.map_or(0.0, |_| 1e9), strength.moment.map_or(0.0, |_| 1e9));
        let held = simulate(&brittle(kind, more, 20.0), &settings, &mut NoRecorder).unwrap();
        assert_eq!(held.joints[0].parted, None);
        assert!(held.joints[0].force_max.value > strength.force.unwrap_or(0.0));
        assert!((held.energy.final_ - torn.energy.final_).abs() < 1e-9 * torn.energy.scale);
        assert!(
            held.points[0].displacement_max[1].value > torn.points[0].displacement_max[1].value
        );
    }
}

#[test]
fn a_run_that_goes_on_from_a_checkpoint_remembers_what_has_torn() {
    let model = brittle(JointKind::Rigid, strength_of(1e5, 0.0), 20.0);
    let settings = Settings::new(0.1, 2e-4);
    let whole = simulate(&model, &settings, &mut NoRecorder).unwrap();
    let torn = whole.joints[0].parted.unwrap().time;
    for instant in [0.5 * torn, torn + 0.02] {
        let mut part = Simulation::new(&model, &settings).unwrap();
        while part.state().time < instant {
            part.advance(&mut NoRecorder).unwrap();
        }
        let resumed = Simulation::resume(&model, &settings, part.checkpoint()).unwrap();
        let resumed = resumed.run(&mut NoRecorder);
        assert_eq!(format!("{:?}", resumed.joints), format!("{:?}", whole.joints));
        assert_eq!(resumed.energy, whole.energy);
    }
}

/// A path ends just before a joint would tear, at the load factor at which it carries its strength in an equilibrium.
#[test]
fn a_path_ends_where_a_joint_would_tear() {
    let built = |strength: JointStrength, factor: f64| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let column = b.beam(beam("column", [0.0, 0.0], [0.0, 3.0], 5, material, section));
        let girder = b.beam(beam("girder", [0.0, 3.0], [2.0, 3.0], 4, material, section));
        for (name, beam, f) in [("foot", column, 0.0), ("far", girder, 1.0)] {
            b.support(Support::new(name, at(name, beam, f), SupportKind::Clamp));
        }
        let between = [at("column.end", column, 1.0), at("girder.start", girder, 0.0)];
        let strength = Some(strength);
        b.joint(Joint { strength, ..Joint::new("knee", JointKind::Rigid, between) });
        let (at, force) = (at("middle", girder, 0.5), [0.0, -1e4 * factor]);
        let kind = LoadKind::Point { at, force, moment: 0.0, follower: false };
        b.load(Load::new("weight", kind));
        b.build().unwrap()
    };
    let strength = strength_of(0.0, 200.0);
    let settings = PathSettings { end: PathEnd::Factor(1.0), ..PathSettings::default() };
    let path = equilibrium_path(&built(strength, 1.0), &settings).unwrap();
    assert!(!path.reached);
    assert_eq!(path.torn.as_deref(), Some("joint.knee"));
    let last = path.points.last().unwrap().factor;
    assert!(last > 0.05 && last < 0.9, "{last}");
    // There it holds, a thousandth further it tears.
    assert!(equilibrium(&built(strength, 0.999 * last)).unwrap().failures.is_empty());
    let torn = equilibrium(&built(strength, 1.001 * last)).unwrap();
    assert_eq!(torn.failures[0].name, "joint.knee");
    assert!((torn.failures[0].factor * 1.001 - 1.0).abs() < 1e-6, "{:?}", torn.failures);
    let strong = equilibrium_path(&built(strength_of(0.0, 1e6), 1.0), &settings).unwrap();
    assert!(strong.reached && strong.torn.is_none());
}

/// The elastic recovery of beams follows the remaining connections: not a torn joint, and the girder rests at the end of a damped run.
#[test]
fn a_joint_that_has_torn_holds_no_set() {
    let run = |limit: f64| {
        let mut b = ModelBuilder::new();
        let curve = vec![Hardening { from: 0.0, stress: 2e6, modulus: 1e8 }];
        let law = Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain: None };
        let material = b.material(Material {
            strain: StrainMeasure::Engineering,
            inelasticity: Some(Inelasticity::Plastic(law)),
            mass_damping: 40.0,
            ..Material::new("soft", 2e9, 3e3)
        });
        let section = b.section(Section::rectangle("plank", 1.0, 0.1));
        let column = b.beam(beam("column", [0.0, 0.0], [0.0, 3.0], 4, material, section));
        let girder = b.beam(beam("girder", [0.0, 3.0], [2.0, 3.0], 4, material, section));
        for (name, beam, f) in [("foot", column, 0.0), ("far", girder, 1.0)] {
            b.support(Support::new(name, at(name, beam, f), SupportKind::Clamp));
        }
        let between = [at("column.end", column, 1.0), at("girder.start", girder, 0.0)];
        let strength = Some(strength_of(limit, 0.0));
        b.joint(Joint { strength, ..Joint::new("knee", JointKind::Rigid, between) });
        b.projectile(elastic("mass", at("girder@0.4", girder, 0.4), [0.0, -10.0]));
        b.record_point(at("girder.mid", girder, 0.5));
        let mut rows = MemoryRecorder::default();
        let model = b.build().unwrap();
        let summary = simulate(&model, &Settings::new(1.5, 2e-4), &mut rows).unwrap();
        let last = |k: usize| {
            let column = rows.column(&format!("point.girder.mid.displacement_{k}"));
            column.expect("recorded").last().copied().expect("rows")
        };
        (summary, [last(1), last(2)])
    };
    for (limit, tears) in [(1e9, false), (1e4, true)] {
        let (summary, rest) = run(limit);
        assert_eq!(summary.joints[0].parted.is_some(), tears);
        let girder = &summary.plastic[1];
        assert!(girder.first_yield.is_some(), "{girder:?}");
        let set = girder.permanent_set.expect("a set");
        assert_eq!(set.s, 1.0);
        let off = (0..2).map(|i| (set.displacement[i] - rest[i]).abs()).fold(0.0, f64::max);
        assert!(off < 1e-6 * set.size(), "{set:?} {rest:?}");
        assert!(worst(&summary) < 1e-10, "{:e}", worst(&summary));
    }
}
