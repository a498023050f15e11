//! Static structures supported only by stops: closed ones are springs, open ones have no effect.

use crate::common;

use common::*;
use percuss::*;

const STIFFNESS: f64 = 400e3;
const WIND: f64 = 2e3;

/// Support of the head of the mast.
#[derive(Clone, Copy)]
enum Guys {
    /// A stop on either side, with a gap \[m\].
    Stops(f64),
    /// The one on the windward side.
    Windward,
    /// A spring.
    Spring,
}

/// A mast of 6 m on a pin, its head held by guys, under wind at its head and a dead weight there \[N\].
fn mast(guys: Guys, weight: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 205e9, 7850.0));
    let section = b.section(Section::new("tube", 1.2e-3, 1.4e-6));
    let mast = b.beam(beam("mast", [0.0, 0.0], [0.0, 6.0], 8, material, section));
    let head = at("head", mast, 1.0);
    b.support(Support::new("foot", at("foot", mast, 0.0), SupportKind::Pin));
    let stop = |direction: f64, gap: f64| SupportKind::Stop {
        direction: [direction, 0.0],
        gap,
        stiffness: STIFFNESS,
        two_sided: false,
    };
    match guys {
        Guys::Stops(gap) => {
            b.support(Support::new("left", head.clone(), stop(1.0, gap)));
            b.support(Support::new("right", head.clone(), stop(-1.0, gap)));
        }
        Guys::Windward => b.support(Support::new("right", head.clone(), stop(-1.0, 0.0))),
        Guys::Spring => {
            let kind = SupportKind::Elastic {
                direction: [1.0, 0.0],
                stiffness: [STIFFNESS, 0.0],
                damping: [0.0; 2],
                rotational_stiffness: 0.0,
                rotational_damping: 0.0,
            };
            b.support(Support::new("left", head.clone(), kind));
        }
    }
    let force = [WIND, -weight];
    let kind = LoadKind::Point { at: head.clone(), force, moment: 0.0, follower: false };
    b.load(Load::new("wind", kind));
    b.record_point(head);
    b.build().unwrap()
}

/// The wind closes the left stop, which gives all of it: the head moves by the gap and by wind over stiffness.
#[test]
fn a_mast_between_stops_leans_on_one_of_them() {
    for gap in [0.0, 0.01] {
        let model = mast(Guys::Stops(gap), 0.0);
        assert!(mechanisms(&model).is_empty());
        let found = equilibrium(&model).unwrap();
        let head = found.points[0].1[0];
        assert!((head / (gap + WIND / STIFFNESS) - 1.0).abs() < 1e-9, "{gap}: {head}");
        let reaction = |name: &str| found.reactions.iter().find(|r| r.0 == name).unwrap().1;
        assert!((reaction("left")[0] / -WIND - 1.0).abs() < 1e-9, "{:?}", found.reactions);
        assert_eq!(reaction("right")[0], 0.0);
        assert!(found.stable);
        let closed: Vec<bool> = stops(&model, &found.state).iter().map(|s| s.closed).collect();
        assert_eq!(closed, [true, false]);
    }
}

/// In small motions and buckling the closed stop is a spring.
#[test]
fn a_closed_stop_is_a_spring_in_small_motions() {
    let weight = 1e3;
    let [stops, spring] = [Guys::Stops(0.0), Guys::Spring].map(|guys| {
        let model = mast(guys, weight);
        let found = equilibrium(&model).unwrap();
        let modes = modes_about_equilibrium(&model, &found, 3);
        let frequencies: Vec<f64> = modes.iter().map(Mode::frequency).collect();
        (frequencies, buckling_in_contact(&model, &found, 1).modes[0].factor)
    });
    for (a, b) in stops.0.iter().zip(&spring.0) {
        assert!(*a > 1.0 && (a / b - 1.0).abs() < 1e-9, "{a} {b}");
    }
    assert!((stops.1 / spring.1 - 1.0).abs() < 1e-9, "{} {}", stops.1, spring.1);
}

/// Buckling neglects the gap of a stop that the wind closes, and says so.
#[test]
fn linear_buckling_says_that_the_gap_of_a_closed_stop_is_neglected() {
    for (gap, said) in [(0.0, 0), (0.01, 1)] {
        let model = mast(Guys::Stops(gap), 1e3);
        let found = equilibrium(&model).unwrap();
        let linear = buckling_in_contact(&model, &found, 1);
        assert_eq!((linear.closed_stops, linear.springs_as_unloaded), (said, 0), "{gap}");
        let words = linear.assumptions().join(" ");
        assert_eq!(words.contains("1 stop behind a gap counts as a spring"), said == 1, "{words}");
    }
}

/// A run from the equilibrium stays there.
#[test]
fn a_static_start_on_a_stop_stays_at_rest() {
    let model = mast(Guys::Stops(0.01), 1e3);
    let settings = Settings { start: Start::Static, ..Settings::new(0.05, 5e-4) };
    let mut rows = MemoryRecorder::default();
    let summary = simulate(&model, &settings, &mut rows).unwrap();
    assert!(matches!(summary.termination, Termination::Completed), "{:?}", summary.termination);
    let head = rows.column("point.head.displacement_1").expect("recorded");
    assert!(head.iter().all(|u| (u - head[0]).abs() < 1e-10), "{head:?}");
    assert!((head[0] - 0.015).abs() < 1e-3, "{}", head[0]);
}

/// A path ends where the load steps of statics do.
#[test]
fn a_path_on_stops_ends_in_the_equilibrium() {
    for gap in [0.0, 0.01] {
        let model = mast(Guys::Stops(gap), 1e3);
        let settings = PathSettings { end: PathEnd::Factor(1.0), ..PathSettings::default() };
        let path = equilibrium_path(&model, &settings).unwrap();
        assert!(path.reached);
        let (end, found) = (path.points.last().unwrap(), equilibrium(&model).unwrap());
        let (a, b) = (end.displacements[0][0], found.points[0].1[0]);
        assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
        assert!(path.points.iter().all(|point| point.stable));
    }
}

/// A stop on the wrong side does not support the beam, which is named.
#[test]
fn beams_that_no_stop_holds_are_named() {
    let error = equilibrium(&mast(Guys::Windward, 0.0)).unwrap_err();
    assert_eq!(error.code(), AnalysisCode::NothingHolds, "{error}");
    assert!(error.to_string().contains("mast"), "{error}");
}

#[test]
fn a_mast_between_compliant_bumpers_leans_on_one() {
    // Pinned at its foot, 10 mm from half-planes: the closed bumper carries the moment H L about the foot.
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 2.1e11, 7850.0));
    let section = b.section(Section::rectangle("s", 0.04, 0.04));
    let mast = b.beam(beam("mast", [0.0, 0.0], [0.0, 2.0], 6, material, section));
    b.support(Support::new("foot", at("foot", mast, 0.0), SupportKind::Pin));
    for (name, x, normal) in [("left", -0.03, [1.0, 0.0]), ("right", 0.03, [-1.0, 0.0])] {
        let shape = ObstacleShape::HalfPlane { point: [x, 0.0], normal };
        let wall = b.obstacle(Obstacle { name: name.into(), shape, motion: None });
        let law = SmoothLaw::elastic(Potential::Linear { stiffness: 1e6 });
        let partners = [ContactPartner::Beam(mast), ContactPartner::Obstacle(wall)];
        b.contact(Contact::new(name, partners, TouchLaw::Smooth(law)));
    }
    let force = LoadKind::Point {
        at: at("head", mast, 1.0),
        force: [2e3, 0.0],
        moment: 0.0,
        follower: false,
    };
    b.load(Load::new("wind", force));
    let found = equilibrium(&b.build().unwrap()).unwrap();
    let moment = |name: &str| found.reactions.iter().find(|(n, _)| n == name).unwrap().1[2];
    let head = found.state.displacement[6];
    let from_load = -2e3 * (2.0 + head[1]);
    assert!((moment("right") + from_load).abs() < 1e-6 * 4e3, "{} {from_load}", moment("right"));
    assert!(head[0] > 0.01, "{head:?}");
}
