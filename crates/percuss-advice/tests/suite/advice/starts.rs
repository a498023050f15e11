//! Stability, and static starts far from the drawing.

use super::*;

/// A strut under 0.5 and 2.8 times its Euler load at the start.
#[test]
fn a_start_from_an_unstable_equilibrium_is_reported() {
    for (share, reported) in [(0.5, None), (2.8, Some(Verdict::Warning))] {
        let mut b = ModelBuilder::new();
        let strut = bar(&mut b, 3.0, 12, [0.05, 0.05]);
        hold(&mut b, strut, &SupportKind::Pin, &[0.0]);
        hold(&mut b, strut, &SupportKind::Roller { direction: [1.0, 0.0] }, &[1.0]);
        let euler = std::f64::consts::PI.powi(2) * 2.1e11 * 0.05_f64.powi(4) / 12.0 / 9.0;
        let (force, moment) = ([-share * euler, 0.0], 0.0);
        let kind = LoadKind::Point { at: at("end", strut, 1.0), force, moment, follower: false };
        b.load(Load::new("thrust", kind));
        b.projectile(mass(at("mid", strut, 0.5), 5.0, 1e6, [0.0, -0.1]));
        let settings = Settings { start: Start::Static, ..Settings::new(0.02, 5e-5) };
        assert_eq!(verdict(&advise(&freeze(&b), &settings), Topic::Stability), reported, "{share}");
    }
}

/// Struck along its axis with more than its Euler load, a straight mesh stays straight.
#[test]
fn a_strut_struck_end_on_above_its_euler_load_is_reported() {
    for (speed, reported) in [(1e-3, None), (5.0, Some(Verdict::Warning))] {
        let mut b = ModelBuilder::new();
        let strut = bar(&mut b, 2.0, 20, [0.02, 0.02]);
        hold(&mut b, strut, &SupportKind::Clamp, &[0.0]);
        b.projectile(mass(at("end", strut, 1.0), 10.0, 1e8, [-speed, 0.0]));
        let advice = advise(&freeze(&b), &Settings::new(0.01, 1e-5));
        assert_eq!(verdict(&advice, Topic::Stability), reported, "{advice:#?}");
    }
}

/// A bar on a soft hinge swings down by itself before the run starts; a stiff one stays where it is drawn.
#[test]
fn a_static_start_far_from_the_drawing_is_reported_with_place_and_distance() {
    for (rotational_stiffness, reported) in [(1.0, Some(Verdict::Warning)), (1e7, None)] {
        let mut b = ModelBuilder::new();
        let arm = bar(&mut b, 1.0, 12, [0.05, 0.05]);
        let kind = SupportKind::Elastic {
            direction: [1.0, 0.0],
            stiffness: [1e9, 1e9],
            damping: [0.0; 2],
            rotational_stiffness,
            rotational_damping: 0.0,
        };
        hold(&mut b, arm, &kind, &[0.0]);
        b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
        b.projectile(mass(at("mid", arm, 0.5), 5.0, 1e6, [0.0, -0.1]));
        let settings = Settings { start: Start::Static, ..Settings::new(0.02, 5e-5) };
        let advice = advise(&freeze(&b), &settings);
        assert_eq!(verdict(&advice, Topic::StaticStart), reported, "{advice:#?}");
        if let Some(far) = advice.iter().find(|a| a.topic == Topic::StaticStart) {
            // From level to hanging: a quarter of a turn takes the end sqrt(2) m.
            assert!((far.value / 2.0_f64.sqrt() - 1.0).abs() < 0.01, "{far:?}");
            assert!(
                far.text.contains("by 1.4") && far.text.contains("beam 'beam', s = 1 m"),
                "{far:?}"
            );
        }
    }
}

/// A ball beside the anchor of its rope swings down to below it before the run starts; one that hangs there already stays.
#[test]
fn a_static_start_far_from_the_drawing_is_reported_for_projectiles() {
    for (x, reported) in [(-2.0, Some(Verdict::Warning)), (-1.0, None)] {
        let mut b = ModelBuilder::new();
        let arm = bar(&mut b, 1.0, 4, [0.05, 0.05]);
        hold(&mut b, arm, &SupportKind::Clamp, &[0.0]);
        b.disc(Disc {
            name: "ball".into(),
            mass: 20.0,
            inertia: None,
            radius: 0.1,
            position: [x, 2.0],
            velocity: [0.0; 2],
            spin: 0.0,
        });
        b.spring(Spring {
            name: "rope".into(),
            between: [Anchor::Ground([-1.0, 3.0]), Anchor::Projectile("ball".into())],
            law: SpringLaw::Tension { stiffness: 1e7, slack: 0.0 },
            damping: 0.0,
            length: None,
            strength: None,
            yielding: None,
        });
        b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
        let settings = Settings { start: Start::Static, ..Settings::new(0.02, 5e-5) };
        let advice = advise(&freeze(&b), &settings);
        assert_eq!(verdict(&advice, Topic::StaticStart), reported, "{advice:#?}");
        if let Some(far) = advice.iter().find(|a| a.topic == Topic::StaticStart) {
            // From beside to below the anchor at a distance of sqrt(2) m: by (1, 1 - sqrt(2)) m.
            let expected = 1.0_f64.hypot(2.0_f64.sqrt() - 1.0);
            assert!((far.value / expected - 1.0).abs() < 0.01, "{far:?}");
            assert!(far.text.contains("disc 'ball'"), "{far:?}");
        }
    }
}

/// A straight strut between pins that heat or a ramp presses beyond buckling in a run; not where its ends are clamped (four times the factor), where a
/// lateral load bends it, or below the factor.
#[test]
fn a_straight_strut_pressed_beyond_buckling_in_a_run_is_reported() {
    let found = |share: f64, kind: SupportKind, lateral: f64| {
        let mut b = ModelBuilder::new();
        let strut = bar(&mut b, 2.0, 16, [0.05, 0.05]);
        hold(&mut b, strut, &kind, &[0.0, 1.0]);
        let slenderness = 0.05_f64.powi(2) / 12.0 / 4.0;
        let strain = share * std::f64::consts::PI.powi(2) * slenderness;
        let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
        let kind = LoadKind::Strain { beam: strut, stretch, strain, curvature: 0.0 };
        let function = TimeFunction::Ramp { duration: 0.3 };
        b.load(Load { function: function.clone(), ..Load::new("growth", kind) });
        if lateral != 0.0 {
            let at = at("mid", strut, 0.5);
            let kind = LoadKind::Point { at, force: [0.0, lateral], moment: 0.0, follower: false };
            b.load(Load { function, ..Load::new("lateral", kind) });
        }
        verdict(&advise(&freeze(&b), &Settings::new(0.5, 5e-4)), Topic::Stability)
    };
    assert_eq!(found(2.0, SupportKind::Pin, 0.0), Some(Verdict::Warning));
    assert_eq!(found(0.9, SupportKind::Pin, 0.0), None);
    assert_eq!(found(2.0, SupportKind::Clamp, 0.0), None);
    assert_eq!(found(2.0, SupportKind::Pin, 100.0), None);
}
