//! Springs between two points whose force is no line: tension or compression alone, behind a gap or a slack, by a table; damped, and of a
//! given strength. A short bar on its way along the spring is the mass.

use std::cell::Cell;

use crate::common;

use common::*;
use percuss::*;

/// Stiffness of the springs \[N/m\], free way \[m\], speed of the bar \[m/s\].
const STIFFNESS: f64 = 1e4;
const WAY: f64 = 0.02;
const SPEED: f64 = 1.0;
/// Area, length and density of the bar: stiff enough for its waves to be nothing.
const AREA: f64 = 0.01;
const LENGTH: f64 = 0.1;
const DENSITY: f64 = 7850.0;
/// Height of the line of motion above the origin, so that there is an angular momentum \[m\].
const HEIGHT: f64 = 0.5;

fn mass() -> f64 {
    AREA * LENGTH * DENSITY
}

/// Circular frequency of the bar on the spring \[1/s\].
fn omega() -> f64 {
    (STIFFNESS / mass()).sqrt()
}

/// A spring of 1 m between the end of the bar and the ground ahead of it.
fn spring(law: SpringLaw) -> Spring {
    let name = "own".into();
    let ahead = Anchor::Ground([LENGTH + 1.0, HEIGHT]);
    // The other end is that of the bar, once there is one.
    let between = [ahead.clone(), ahead];
    Spring { name, between, law, damping: 0.0, length: None, strength: None, yielding: None }
}

/// The bar, which starts at a velocity towards the ground ahead of it.
fn model(spring: Spring, velocity: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2e12, DENSITY));
    let section = b.section(Section::new("bar", AREA, AREA * AREA / 12.0));
    let bar = b.beam(beam("bar", [0.0, HEIGHT], [LENGTH, HEIGHT], 1, material, section));
    let end = at("end", bar, 1.0);
    let between = [Anchor::Point(end.clone()), spring.between[0].clone()];
    b.spring(Spring { between, ..spring });
    b.record_point(end);
    b.initial_motion(InitialMotion { velocity: [velocity, 0.0], spin: 0.0, about: [0.0; 2] });
    b.build().unwrap()
}

/// Runs; the balances close. Times and displacements of the bar's end, shape (rows, 2), and the summary.
fn run(spring: Spring, velocity: f64, end: f64) -> (Vec<[f64; 2]>, RunSummary) {
    let mut rows = MemoryRecorder::default();
    let model = model(spring, velocity);
    let summary = simulate(&model, &Settings::new(end, 1e-4), &mut rows).unwrap();
    assert!(matches!(summary.termination, Termination::Completed), "{summary:?}");
    assert!(summary.energy.residual_max < 1e-10, "{:e}", summary.energy.residual_max);
    assert!(summary.momentum.linear_residual_max < 1e-10);
    assert!(summary.momentum.angular_residual_max < 1e-10);
    let [time, moved] =
        ["time", "point.end.displacement_1"].map(|name| rows.column(name).unwrap().to_vec());
    (time.into_iter().zip(moved).map(|(t, u)| [t, u]).collect(), summary)
}

/// The motion of a mass that meets a spring after a way, presses on it for half a period and goes back.
fn met(t: f64, way: f64) -> f64 {
    let (meets, half) = (way / SPEED, std::f64::consts::PI / omega());
    if t < meets {
        SPEED * t
    } else if t < meets + half {
        way + SPEED / omega() * (omega() * (t - meets)).sin()
    } else {
        way - SPEED * (t - meets - half)
    }
}

#[track_caller]
fn follows(rows: &[[f64; 2]], expected: impl Fn(f64) -> f64) {
    for [t, u] in rows {
        // The bar's own give, the period at these steps, and the step in which the gap closes.
        assert!((u - expected(*t)).abs() < 2e-5, "{t}: {u} {}", expected(*t));
    }
}

/// A gap, then half a period of `sqrt(k / m)`, then back at the same speed.
#[test]
fn a_spring_behind_a_gap_throws_a_mass_back() {
    let end = 2.5 * WAY / SPEED + std::f64::consts::PI / omega();
    let gap = SpringLaw::Compression { stiffness: STIFFNESS, gap: WAY };
    let (rows, summary) = run(spring(gap), SPEED, end);
    follows(&rows, |t| met(t, WAY));
    // Peak force v sqrt(k m).
    let most = summary.points[0].displacement_max[0];
    let force = STIFFNESS * (most.value - WAY);
    assert!((force / (SPEED * (STIFFNESS * mass()).sqrt()) - 1.0).abs() < 1e-4, "{force}");
    let turns = WAY / SPEED + 0.5 * std::f64::consts::PI / omega();
    assert!((most.time - turns).abs() < 3e-4, "{} {turns}", most.time);
}

#[test]
fn a_hook_catches_a_mass_after_its_slack() {
    let end = 2.5 * WAY / SPEED + std::f64::consts::PI / omega();
    let hook = SpringLaw::Tension { stiffness: STIFFNESS, slack: WAY };
    let (rows, _) = run(spring(hook), -SPEED, end);
    follows(&rows, |t| -met(t, WAY));
}

#[test]
fn what_bears_tension_alone_is_slack_under_compression() {
    let tie = || SpringLaw::Tension { stiffness: STIFFNESS, slack: 0.0 };
    let (rows, _) = run(spring(tie()), SPEED, 0.05);
    assert!(rows.iter().all(|[t, u]| (u - SPEED * t).abs() < 1e-12), "{rows:?}");
    let (rows, _) = run(spring(tie()), -SPEED, 0.1);
    follows(&rows, |t| -met(t, 0.0));
}

#[test]
fn what_bears_compression_alone_does_not_pull() {
    let strut = || SpringLaw::Compression { stiffness: STIFFNESS, gap: 0.0 };
    let (rows, _) = run(spring(strut()), -SPEED, 0.05);
    assert!(rows.iter().all(|[t, u]| (u + SPEED * t).abs() < 1e-12), "{rows:?}");
    let (rows, _) = run(spring(strut()), SPEED, 0.1);
    follows(&rows, |t| met(t, 0.0));
}

/// A table that falls: the mass turns where its energy is that below the lines, and comes back as fast as it went.
#[test]
fn a_table_stores_the_area_below_its_lines() {
    let table = SpringLaw::Table {
        extension: vec![-0.1, 0.0, 0.01, 0.03, 0.1],
        force: vec![-1000.0, 0.0, 400.0, 200.0, 1000.0],
    };
    let (rows, _) = run(spring(table), -SPEED, 0.1);
    // 2 J up to 10 mm, then 400 x - 5000 x^2.
    let rest = 0.5 * mass() * SPEED * SPEED - 2.0;
    let turns = 0.01 + (400.0 - (400.0 * 400.0 - 4.0 * 5000.0 * rest).sqrt()) / 1e4;
    let most = rows.iter().map(|[_, u]| *u).fold(0.0, f64::min);
    assert!((-most - turns).abs() < 2e-6, "{most} {turns}");
    // On the other side it is a line of 10 kN/m.
    let least = rows.iter().map(|[_, u]| *u).fold(0.0, f64::max);
    let back = SPEED / omega();
    let crossed = rows.iter().any(|[_, u]| *u > 0.0);
    assert!(crossed && least <= back * (1.0 + 1e-4), "{least} {back}");
}

/// Beyond its last point a table keeps its force, even where its last line falls, and before its first one it has none: the mass turns where
/// that force has done the work of its speed, and leaves a spring that pulls alone as fast as it came.
#[test]
fn a_table_keeps_its_last_forces_beyond_its_points() {
    let table = |extension: &[f64], force: &[f64]| SpringLaw::Table {
        extension: extension.to_vec(),
        force: force.to_vec(),
    };
    let energy = 0.5 * mass() * SPEED * SPEED;
    for (law, turns) in [
        // 0.05 J up to 1 mm, then 100 N.
        (table(&[0.0, 0.001], &[0.0, 100.0]), 0.001 + (energy - 0.05) / 100.0),
        // 0.1 J up to 1 mm and 0.6 J to 5 mm, then 100 N: the falling line would be zero at 7 mm.
        (table(&[0.0, 0.001, 0.005], &[0.0, 200.0, 100.0]), 0.005 + (energy - 0.7) / 100.0),
    ] {
        let (rows, _) = run(spring(law), -SPEED, 0.2);
        let most = rows.iter().map(|[_, u]| *u).fold(0.0, f64::min);
        assert!((-most - turns).abs() < 2e-6, "{most} {turns}");
        let [last, before] = [rows[rows.len() - 1], rows[rows.len() - 20]];
        let speed = (last[1] - before[1]) / (last[0] - before[0]);
        assert!(before[1] > 0.0 && (speed / SPEED - 1.0).abs() < 1e-4, "{before:?} {speed}");
    }
}

/// With `zeta = c / (2 sqrt(k m)) = sin(phi)` a mass leaves a damped buffer, which does not pull, when its force is zero, at
/// `exp(-tan(phi) (pi - 2 phi))` of its speed (Schwager and Poeschel 2007); the largest force is that of the damped oscillation.
#[test]
fn a_damper_beside_a_spring_of_one_side_acts_while_that_presses() {
    let table = |sign: f64| SpringLaw::Table {
        extension: if sign > 0.0 { vec![WAY, WAY + 1.0] } else { vec![-WAY - 1.0, -WAY] },
        force: if sign > 0.0 { vec![0.0, STIFFNESS] } else { vec![-STIFFNESS, 0.0] },
    };
    let laws = [
        (SpringLaw::Compression { stiffness: STIFFNESS, gap: WAY }, 1.0),
        (SpringLaw::Tension { stiffness: STIFFNESS, slack: WAY }, -1.0),
        (table(-1.0), 1.0),
        (table(1.0), -1.0),
    ];
    for (law, sign) in laws {
        for zeta in [0.1_f64, 0.4, 0.8] {
            let damping = 2.0 * zeta * (STIFFNESS * mass()).sqrt();
            let strength = Some(1e6);
            let damped = Spring { damping, strength, ..spring(law.clone()) };
            // With zeta = sin(phi) the force is zero at the phase pi - 2 phi, and largest at pi/2 - 3 phi or at once.
            let phi = zeta.asin();
            let frequency = omega() * phi.cos();
            let way = |phase: f64| (-phi.tan() * phase).exp();
            let pressed = (std::f64::consts::PI - 2.0 * phi) / frequency;
            let slower = way(std::f64::consts::PI - 2.0 * phi);
            let (rows, summary) = run(damped, sign * SPEED, WAY / SPEED + 3.0 * pressed);
            let [last, before] = [rows[rows.len() - 1], rows[rows.len() - 20]];
            let speed = (last[1] - before[1]) / (last[0] - before[0]);
            let expected = -sign * SPEED * slower;
            assert!((speed / expected - 1.0).abs() < 2e-3, "{law:?} {zeta}: {speed} {expected}");
            let told = summary.yielding[0].force_max.value * -sign;
            let most = match std::f64::consts::FRAC_PI_2 - 3.0 * phi {
                phase if phase > 0.0 => way(phase),
                _ => 2.0 * zeta,
            };
            let most = most * SPEED * (STIFFNESS * mass()).sqrt();
            assert!((told / most - 1.0).abs() < 1e-2, "{law:?} {zeta}: {told} {most}");
        }
    }
}

/// What is left in the spring when the force becomes zero is dissipated, too, as the spring relaxes: the loss is that of the motion.
#[test]
fn a_damper_of_one_side_takes_what_the_motion_loses() {
    let zeta = 0.1_f64;
    let damping = 2.0 * zeta * (STIFFNESS * mass()).sqrt();
    let buffer = SpringLaw::Compression { stiffness: STIFFNESS, gap: WAY };
    let (_, summary) = run(Spring { damping, ..spring(buffer) }, SPEED, 0.2);
    let phi = zeta.asin();
    let slower = (-phi.tan() * (std::f64::consts::PI - 2.0 * phi)).exp();
    let lost = 0.5 * mass() * SPEED * SPEED * (1.0 - slower * slower);
    assert!((summary.energy.loss_damping / lost - 1.0).abs() < 2e-3, "{:?}", summary.energy);
}

/// It breaks at `F`, when `F^2 / (2 k)` is stored: that is lost, and the mass goes on with the rest.
#[test]
fn a_spring_breaks_at_its_strength() {
    let strength = 0.6 * SPEED * (STIFFNESS * mass()).sqrt();
    let hook = SpringLaw::Tension { stiffness: STIFFNESS, slack: WAY };
    let weak = Spring { strength: Some(strength), ..spring(hook) };
    let (rows, summary) = run(weak, -SPEED, 0.1);
    let stored = strength * strength / (2.0 * STIFFNESS);
    assert!((summary.energy.failure / stored - 1.0).abs() < 2e-2, "{:?}", summary.energy);
    let [last, before] = [rows[rows.len() - 1], rows[rows.len() - 20]];
    let speed = (last[1] - before[1]) / (last[0] - before[0]);
    assert!((speed / (-0.8 * SPEED) - 1.0).abs() < 1e-2, "{speed}");
    let own = &summary.yielding[0];
    let breaks = WAY / SPEED + 0.6_f64.asin() / omega();
    assert_eq!((own.name.as_str(), own.first_yield), ("spring.own", None));
    assert!((own.failed.unwrap() - breaks).abs() < 3e-4, "{own:?} {breaks}");
    // Its largest extension is that from its slack on, not the way through the slack.
    let most = own.extension_max.value;
    assert!((STIFFNESS * most / strength - 1.0).abs() < 2e-2, "{own:?}");
    // A strength that is not reached changes nothing.
    let strong = |strength| {
        let hook = SpringLaw::Tension { stiffness: STIFFNESS, slack: WAY };
        run(Spring { strength, ..spring(hook) }, -SPEED, 0.1).0
    };
    let pairs = strong(Some(1e6)).into_iter().zip(strong(None));
    assert!(pairs.into_iter().all(|(a, b)| (a[1] - b[1]).abs() < 1e-12));
    let hook = SpringLaw::Tension { stiffness: STIFFNESS, slack: WAY };
    let (_, summary) = run(Spring { strength: Some(1e6), ..spring(hook) }, -SPEED, 0.1);
    let most = summary.yielding[0].force_max.value;
    assert!((most / (SPEED * (STIFFNESS * mass()).sqrt()) - 1.0).abs() < 1e-3, "{most}");
    // One that never acts has neither extension nor force.
    let hook = SpringLaw::Tension { stiffness: STIFFNESS, slack: WAY };
    let (_, summary) = run(Spring { strength: Some(1e6), ..spring(hook) }, SPEED, 0.05);
    let own = &summary.yielding[0];
    assert_eq!([own.extension_max.value, own.force_max.value], [0.0; 2]);
}

/// A pinned bar between two vertical ties: one bears the load, the other one is slack.
#[test]
fn ties_at_rest_bear_tension_alone() {
    let sag = |law: &dyn Fn() -> SpringLaw, strength: Option<f64>| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2e12, DENSITY));
        let section = b.section(Section::new("bar", AREA, AREA * AREA / 12.0));
        let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 2, material, section));
        let end = at("end", bar, 1.0);
        b.support(Support::new("pin", at("pin", bar, 0.0), SupportKind::Pin));
        for (name, y) in [("above", 1.0), ("below", -1.0)] {
            let between = [Anchor::Point(end.clone()), Anchor::Ground([1.0, y])];
            let name = name.into();
            let (law, damping, length) = (law(), 0.0, None);
            b.spring(Spring { name, between, law, damping, length, strength, yielding: None });
        }
        let (force, moment, follower) = ([0.0, -10.0], 0.0, false);
        let kind = LoadKind::Point { at: end.clone(), force, moment, follower };
        b.load(Load::new("pull", kind));
        b.record_point(end);
        let model = b.build().unwrap();
        equilibrium(&model).map(|found| found.state.displacement[2][1])
    };
    let stiffness = 1e6;
    let single = sag(&|| SpringLaw::Tension { stiffness, slack: 0.0 }, None).unwrap();
    assert!((single / -1e-5 - 1.0).abs() < 1e-3, "{single:e}");
    let both = sag(&|| SpringLaw::Linear { stiffness }, None).unwrap();
    assert!((both / -5e-6 - 1.0).abs() < 1e-3, "{both:e}");
    let slack = sag(&|| SpringLaw::Tension { stiffness, slack: 1e-4 }, None).unwrap();
    assert!((slack / -1.1e-4 - 1.0).abs() < 1e-3, "{slack:e}");
    let pushed = sag(&|| SpringLaw::Compression { stiffness, gap: 1e-4 }, None).unwrap();
    assert!((pushed / -1.1e-4 - 1.0).abs() < 1e-3, "{pushed:e}");
    // One that breaks under less leaves nothing to hold the bar.
    assert!(sag(&|| SpringLaw::Tension { stiffness, slack: 0.0 }, Some(5.0)).is_err());
    assert!(sag(&|| SpringLaw::Tension { stiffness, slack: 0.0 }, Some(20.0)).is_ok());
}

/// A column on a pin between two stays, pressed by its dead load and drawn to the left: linear buckling is about the reference configuration, where a
/// stay behind a slack has no stiffness, however far the loads take it; a strength that is not reached changes nothing.
#[test]
fn linear_buckling_takes_stays_as_they_are_in_the_reference_configuration() {
    const STAY: f64 = 1e3;
    // As good as none: linear springs without stiffness are refused.
    const WEAK: f64 = 1e-9;
    let as_unloaded = Cell::new(usize::MAX);
    let factor = |laws: [SpringLaw; 2], length: Option<f64>, strength: Option<f64>| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let column = b.beam(beam("column", [0.0, 0.0], [0.0, 1.0], 4, material, section));
        let head = at("head", column, 1.0);
        let kind = SupportKind::Elastic {
            direction: [1.0, 0.0],
            stiffness: [1e9, 1e9],
            damping: [0.0; 2],
            rotational_stiffness: 100.0,
            rotational_damping: 0.0,
        };
        b.support(Support::new("foot", at("foot", column, 0.0), kind));
        for (law, (name, x)) in laws.into_iter().zip([("left", -2.0), ("right", 2.0)]) {
            let between = [Anchor::Point(head.clone()), Anchor::Ground([x, 1.0])];
            let (name, damping) = (name.into(), 0.0);
            b.spring(Spring { name, between, law, damping, length, strength, yielding: None });
        }
        let (force, moment, follower) = ([-1.0, -1.0], 0.0, false);
        let kind = LoadKind::Point { at: head, force, moment, follower };
        b.load(Load::new("press", kind));
        let model = b.build().unwrap();
        let found = equilibrium(&model).unwrap();
        let buckling = buckling_in_contact(&model, &found, 1);
        as_unloaded.set(buckling.springs_as_unloaded);
        assert_eq!(buckling.closed_stops, 0);
        assert_eq!(buckling.assumptions().len(), buckling.springs_as_unloaded);
        buckling.modes[0].factor
    };
    let linear = |stiffness| SpringLaw::Linear { stiffness };
    let tension = |slack| SpringLaw::Tension { stiffness: STAY, slack };
    // Round-off: the column is 1e6 times as stiff as the hinge at its foot.
    let same = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-7, "{a} {b}");
    let [none, one, two] = [[WEAK, WEAK], [WEAK, STAY], [STAY, STAY]]
        .map(|stays| factor(stays.map(linear), None, None));
    assert!(1.5 * none < one && one < two, "{none} {one} {two}");
    // The left stay slackens, and the right one is at once in tension, after a slack that closes (which is said), or never.
    for (slack, expected, said) in [(0.0, one, 0), (1e-4, none, 1), (0.5, none, 0)] {
        same(factor([tension(0.0), tension(slack)], None, None), expected);
        assert_eq!(as_unloaded.get(), said, "{slack}");
        same(factor([tension(0.0), tension(slack)], None, Some(1e3)), expected);
    }
    // Two stays in tension from the start, which the load does not slacken, are springs.
    let short = Some(1.9);
    same(
        factor([tension(0.0), tension(0.0)], short, None),
        factor([linear(STAY), linear(STAY)], short, None),
    );
    // A table on one side acts as a stay does.
    let table = || SpringLaw::Table { extension: vec![0.0, 0.1], force: vec![0.0, 0.1 * STAY] };
    same(factor([table(), table()], None, None), one);
}

#[test]
fn laws_that_cannot_be_are_refused() {
    let fault = |spring: Spring| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let bar = b.beam(beam("bar", [0.0, HEIGHT], [LENGTH, HEIGHT], 1, material, section));
        let between = [Anchor::Point(at("end", bar, 1.0)), spring.between[0].clone()];
        b.spring(Spring { between, ..spring });
        let faults = b.build().unwrap_err();
        assert_eq!(faults.len(), 1, "{faults:?}");
        format!("{}: {}", faults[0].path, faults[0].found)
    };
    let table = |extension: &[f64], force: &[f64]| {
        let (extension, force) = (extension.to_vec(), force.to_vec());
        fault(spring(SpringLaw::Table { extension, force }))
    };
    assert_eq!(
        table(&[0.0, 0.1], &[5.0, 6.0]),
        "spring.own.forces: a force of 5 N without extension"
    );
    // Before its first point a table has the force of that point.
    assert_eq!(
        table(&[0.1, 0.2], &[1.0, 2.0]),
        "spring.own.forces: a force of 1 N without extension"
    );
    assert_eq!(table(&[0.0], &[0.0]), "spring.own.forces: 1 extensions and 1 forces");
    assert_eq!(
        table(&[0.0, 0.2, 0.1], &[0.0, 1.0, 2.0]),
        "spring.own.extensions: 0.1 m after 0.2 m"
    );
    let gap = SpringLaw::Compression { stiffness: 1.0, gap: 1.5 };
    assert_eq!(
        fault(spring(gap)),
        "spring.own.gap: 1.5 m, and a length without force of 1 m: it never closes"
    );
    let none = SpringLaw::Tension { stiffness: 0.0, slack: 0.0 };
    assert_eq!(fault(spring(none)), "spring.own.stiffness: a spring of one side without stiffness");
    let hook = SpringLaw::Tension { stiffness: 1.0, slack: 0.0 };
    let weak = Spring { strength: Some(0.0), ..spring(hook) };
    assert!(fault(weak).starts_with("spring.own.strength: "));
}
