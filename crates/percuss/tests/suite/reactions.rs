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
