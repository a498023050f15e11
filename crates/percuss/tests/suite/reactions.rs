//! Reactions and impulses of supports: summary and rows have the same definition, without double counting.

use crate::common;

use common::{at, beam, rows::Rows};
use percuss::*;

#[test]
fn impulses_of_the_summary_are_those_of_the_rows() {
    // A clamp under an impact with many rebounds within a step.
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 2e11, 8e3));
    let section = b.section(Section::rectangle("s", 0.02, 0.04));
    let beam = b.beam(Beam::new("b", &[[0.0, 0.0], [0.5, 0.0]], 1, material, section));
    b.support(Support::new("root", at("root", beam, 0.0), SupportKind::Clamp));
    let struck = at("struck", beam, 0.5693);
    let mut hammer = common::rigid("hammer", struck, [-1.0, -5.0], 0.3);
    (hammer.mass, hammer.standoff) = (5.0, 0.0);
    b.projectile(hammer);
    let model = b.build().unwrap();
    for every in [1, 4] {
        let settings = Settings { record_every: every, ..Settings::new(4e-4, 1e-4) };
        let (rows, summary) = Rows::of(&model, &settings);
        for component in 0..2 {
            let name = format!("support.root.impulse_{}", component + 1);
            let sum: f64 = rows.column(&name).iter().sum();
            let reported = summary.supports[0].impulse[component];
            assert!(
                (sum - reported).abs() < 1e-12 * summary.momentum.linear_scale,
                "{sum} {reported}"
            );
        }
    }
}

/// Two beams with a hinge between, one clamped and the other pinned at its far end, struck by a rigid and by an elastic projectile.
fn hinged() -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 7e10, 3e3));
    let section = b.section(Section::rectangle("s", 0.02, 0.01));
    let (joined, end) = ([0.4370051629287558, 0.0], [0.6602317687310713, 0.0]);
    let first = b.beam(beam("b", [0.0, 0.0], joined, 4, material, section));
    let second = b.beam(beam("c", joined, end, 2, material, section));
    b.support(Support::new("a", at("b.start", first, 0.0), SupportKind::Clamp));
    b.support(Support::new("z", at("c.end", second, 1.0), SupportKind::Pin));
    b.joint(Joint {
        name: "hinge".into(),
        kind: JointKind::Hinge,
        between: [at("b.end", first, 1.0), at("c.start", second, 0.0)],
        yielding: None,
        strength: None,
    });
    let velocity = [0.7820365740128623, -2.04];
    let rigid = common::rigid("p0", at("p0", first, 0.4532), velocity, 0.7);
    b.projectile(Projectile { mass: 5.0, standoff: 1e-3, ..rigid });
    let velocity = [-1.886644278436259, -4.614771051133229];
    let elastic = common::elastic("p1", at("p1", first, 0.1614), velocity);
    let kind = ProjectileKind::spring(1053912.761922777);
    b.projectile(Projectile { kind, mass: 0.2, standoff: 5e-3, ..elastic });
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let push = LoadKind::Point {
        at: at("push", first, 0.4),
        force: [52.73506680725552, 400.0],
        moment: -25.37044723588786,
        follower: false,
    };
    b.load(Load::new("push", push));
    b.build().unwrap()
}

#[test]
fn rows_after_many_short_parts_of_a_step_tell_no_larger_reaction_than_the_steps_had() {
    // Impacts accumulate at 2.4 ms: between two rows lie parts of a step as short as impacts, whose means are no forces.
    let (rows, summary) = Rows::of(&hinged(), &Settings::new(3.1e-3, 5e-5));
    assert!(summary.accumulated_steps > 0);
    for support in &summary.supports {
        for (component, range) in support.force.iter().enumerate() {
            let column = rows.column(&format!("support.{}.force_{}", support.name, component + 1));
            let (least, most) = (range.min.value, range.max.value);
            let slack = 1e-3 * (most - least);
            for force in column {
                let inside = least - slack <= force && force <= most + slack;
                assert!(inside, "{} {component}: {force} of {least} to {most}", support.name);
            }
        }
    }
}

#[test]
fn a_resting_contact_parts_with_the_velocity_of_its_gap() {
    // A mass without restitution on a flexible beam: it comes to rest on it and separates many times.
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 7e10, 3e3));
    let section = b.section(Section::rectangle("s", 0.05, 0.02));
    let plank = b.beam(beam("plank", [0.0, 0.0], [2.0, 0.0], 8, material, section));
    for (name, fraction) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, plank, fraction), SupportKind::Clamp));
    }
    let mass = common::rigid("p", at("p", plank, 0.3), [0.0, -4.0], 0.0);
    b.projectile(Projectile { mass: 1.0, standoff: 0.0, ..mass });
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let (h, model) = (5e-5, b.build().unwrap());
    let (rows, summary) = Rows::of(&model, &Settings::new(0.05, h));
    let ContactRecord::Nonsmooth { impacts, intervals, impulse_total, impulse_resting, .. } =
        &summary.contacts[0].record
    else {
        panic!("a rigid projectile")
    };
    let rested: f64 = intervals.iter().map(|one| one.impulse).sum();
    let struck: f64 = impacts.iter().map(|one| one.impulse).sum();
    assert!((impulse_resting - rested).abs() < 1e-12 * impulse_total, "{impulse_resting} {rested}");
    assert!((impulse_total - rested - struck).abs() < 1e-12 * impulse_total);
    assert!(impacts.iter().all(|one| one.restitution() == Ok(0.0)), "{impacts:?}");
    let (time, gap) = (rows.column("time"), rows.column("contact.p.gap"));
    let mut compared = 0;
    for one in intervals {
        assert!(one.approach_velocity >= 0.0, "{one:?}");
        if one.end.is_nan() {
            continue;
        }
        assert!(one.separation_velocity >= 0.0, "{one:?}");
        // At a separation with a whole step left: the travel of the gap over that step.
        let Some(k) = time.iter().position(|t| (t - one.end).abs() < 1e-12) else { continue };
        if k + 1 < time.len() && (time[k + 1] - time[k] - h).abs() < 1e-12 {
            let mean = (gap[k + 1] - gap[k]) / h;
            assert!((one.separation_velocity - mean).abs() < 1e-6, "{one:?} {mean}");
            compared += 1;
        }
    }
    assert!(compared > 2, "{compared} of {}", intervals.len());
}

/// A run in time-stepping as in the paper, or with located impacts.
fn settings(end: f64, step: f64, located: bool) -> Settings {
    let impacts = match located {
        true => ImpactResolution::Event,
        false => ImpactResolution::TimeStepping { closed_tolerance: 1e-9 },
    };
    Settings { impacts, ..Settings::new(end, step) }
}

/// Component 2 of a support: magnitude of its largest force, and its impulse.
fn reaction(summary: &RunSummary, support: usize) -> [f64; 2] {
    let own = &summary.supports[support];
    let Range { min, max } = own.force[1];
    [max.value.max(-min.value), own.impulse[1]]
}

/// The paper's rigid projectile on a clamped beam, section 3.5.
fn clamped() -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("stiff", 0.2e12, 3e3));
    let section = b.section(Section::new("plank", 0.1, 8.33e-5));
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
    for (name, fraction) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, girder, fraction), SupportKind::Clamp));
    }
    b.projectile(common::rigid("hammer", at("girder.mid", girder, 0.5), [0.0, -40.0], 0.5));
    b.build().unwrap()
}

/// The beam is struck after 0.5 ms; 0.2 ms later it has vibrated, and nothing has struck again. Divided by the step the impulse of a clamp would be
/// 3.1 MN at 10 microseconds and 13 MN at 2.5.
#[test]
fn forces_of_clamps_in_time_stepping_do_not_grow_as_steps_become_shorter() {
    let model = clamped();
    let found = [(1e-5, 0.1), (2.5e-6, 0.01)].map(|(step, close)| {
        let [located, paper] = [true, false].map(|located| {
            let (rows, summary) = Rows::of(&model, &settings(0.7e-3, step, located));
            let [force, impulse] = reaction(&summary, 0);
            let forces = rows.column("support.left.force_2");
            let largest = forces.into_iter().fold(0.0, |most: f64, force| most.max(force.abs()));
            assert!((largest - force).abs() < 1e-6 * force, "{step} {located}: {largest} {force}");
            let sum: f64 = rows.column("support.left.impulse_2").iter().sum();
            assert!((sum - impulse).abs() < 1e-9 * impulse.abs(), "{step} {located}: {sum}");
            [force, impulse]
        });
        // The impulse acts over a step: its distribution over the beam is that of an instant up to an error of the step.
        assert!((paper[1] / located[1] - 1.0).abs() < close, "{step}: {paper:?} {located:?}");
        assert!((paper[0] / located[0] - 1.0).abs() < 0.02, "{step}: {paper:?} {located:?}");
        paper[0]
    });
    assert!((found[0] / found[1] - 1.0).abs() < 0.05, "{found:?}");
}

/// A cantilever is struck at its tip, under which a stop is closed without force.
#[test]
fn a_stop_has_the_force_of_its_compression_in_impacts_too() {
    let stiffness = 1e6;
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 2e11, 8e3));
    let section = b.section(Section::rectangle("s", 0.02, 0.04));
    let strip = b.beam(beam("b", [0.0, 0.0], [0.5, 0.0], 2, material, section));
    b.support(Support::new("root", at("root", strip, 0.0), SupportKind::Clamp));
    let tip = at("tip", strip, 1.0);
    let kind = SupportKind::Stop { direction: [0.0, -1.0], gap: 0.0, stiffness, two_sided: false };
    b.support(Support::new("stop", tip.clone(), kind));
    let hammer = common::rigid("hammer", tip, [0.0, -5.0], 0.5);
    b.projectile(Projectile { mass: 1.0, standoff: 0.0, ..hammer });
    let (model, step) = (b.build().unwrap(), 1e-5);
    for located in [true, false] {
        let (rows, summary) = Rows::of(&model, &settings(5e-4, step, located));
        let [time, tip, force] =
            ["time", "point.tip.displacement_2", "support.stop.force_2"].map(|c| rows.column(c));
        let mut compared = 0;
        for k in 1..time.len() {
            // Rows on both sides of an impact are closer to each other.
            if time[k] - time[k - 1] > 0.5 * step && tip[k - 1] <= 0.0 && tip[k] < 0.0 {
                // The mean force over a step does the work that the stop stores.
                let expected = -0.5 * stiffness * (tip[k - 1] + tip[k]);
                let error = (force[k] - expected).abs();
                assert!(error < 1e-6 * expected, "{located} {}: {} {expected}", time[k], force[k]);
                compared += 1;
            }
        }
        assert!(compared > 10, "{located}: {compared}");
        let [largest, impulse] = reaction(&summary, 1);
        let most = force.into_iter().fold(0.0, f64::max);
        assert!((largest - most).abs() < 1e-6 * most, "{located}: {largest} {most}");
        assert!(impulse.abs() < 1e-6, "{located}: {impulse}");
        assert!(reaction(&summary, 0)[1] != 0.0, "{located}: the clamp transmits an impulse");
    }
}

/// A ball of 3 kg at 2 m/s bounces on a floor with restitution 0.5 in time-stepping: an impulse of 9 N s, and no force.
#[test]
fn an_obstacle_struck_in_time_stepping_has_an_impulse_and_no_force() {
    for step in [1e-3, 2.5e-4] {
        let model = common::ball_above_floor(2.5 * step);
        let summary =
            simulate(&model, &settings(10.0 * step, step, false), &mut NoRecorder).unwrap();
        let [force, impulse] = reaction(&summary, 0);
        assert_eq!(force, 0.0, "{step}");
        assert!((impulse.abs() - 9.0).abs() < 1e-9, "{step}: {impulse}");
    }
}
