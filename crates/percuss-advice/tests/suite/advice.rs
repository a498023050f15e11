//! What the advisor says before a run and after it: warnings where results mislead, and none where they do not.

use crate::common;

use common::{at, disc};
use percuss::*;
use percuss_advice::*;

fn bar(b: &mut ModelBuilder, length: f64, elements: usize, [width, depth]: [f64; 2]) -> BeamId {
    let section = Section::rectangle("bar", width, depth);
    of_section(b, length, elements, section)
}

fn of_section(b: &mut ModelBuilder, length: f64, elements: usize, section: Section) -> BeamId {
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(section);
    b.beam(Beam::new("beam", &[[0.0, 0.0], [length, 0.0]], elements, material, section))
}

fn hold(b: &mut ModelBuilder, beam: BeamId, kind: &SupportKind, ends: &[f64]) {
    for end in ends {
        b.support(Support::new(format!("at {end}"), at("end", beam, *end), kind.clone()));
    }
}

fn mass(strikes: PointRef, mass: f64, stiffness: f64, velocity: [f64; 2]) -> Projectile {
    Projectile::new("mass", ProjectileKind::spring(stiffness), mass, velocity, strikes)
}

fn freeze(b: &ModelBuilder) -> Model {
    b.build().unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn run(model: &Model, settings: &Settings) -> RunSummary {
    simulate(model, settings, &mut NoRecorder).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn verdict(all: &[Advice], topic: Topic) -> Option<Verdict> {
    all.iter().filter(|a| a.topic == topic).map(|a| a.verdict).max()
}

/// Duration reported, and that of the run's first contact.
fn durations(b: &ModelBuilder, settings: &Settings) -> [f64; 2] {
    let model = freeze(b);
    let reported = advise(&model, settings)
        .iter()
        .find(|a| a.topic == Topic::ContactDuration)
        .map(|a| a.value);
    let found = match &run(&model, settings).contacts[0].record {
        ContactRecord::Smooth { intervals, .. } => intervals.first().map(|i| i.end - i.start),
        ContactRecord::Nonsmooth { .. } => None,
    };
    [reported.unwrap_or(f64::NAN), found.unwrap_or(f64::NAN)]
}

/// A car against the foot of a column, a head with a body behind it, a tube that comes down on a stop.
#[test]
fn contacts_last_as_long_as_the_modes_say() {
    let near = |[reported, found]: [f64; 2], off: f64| {
        assert!((reported / found - 1.0).abs() < off, "{reported} s told, {found} s found");
    };
    let mut b = ModelBuilder::new();
    let column = bar(&mut b, 5.0, 10, [0.1, 0.2]);
    hold(&mut b, column, &SupportKind::Clamp, &[0.0, 1.0]);
    b.projectile(mass(at("foot", column, 0.1), 1500.0, 3e5, [0.0, 0.5]));
    near(durations(&b, &Settings::new(0.4, 5e-4)), 0.02);

    let mut b = ModelBuilder::new();
    let girder = bar(&mut b, 3.0, 24, [0.1, 0.2]);
    hold(&mut b, girder, &SupportKind::Pin, &[0.0, 1.0]);
    let law = SmoothLaw::elastic(Potential::Hertz { stiffness: 2e10 });
    let kind = ProjectileKind::Elastic { law };
    let head = Projectile::new("head", kind, 20.0, [0.0, -1.0], at("mid", girder, 0.5));
    let rear = Some(RearMass { mass: 180.0, stiffness: 5e8, damping: 2e4 });
    b.projectile(Projectile { rear, ..head });
    near(durations(&b, &Settings::new(0.02, 1e-5)), 0.05);

    let mut b = ModelBuilder::new();
    let tube = bar(&mut b, 1.5, 30, [0.02, 0.02]);
    hold(&mut b, tube, &SupportKind::Clamp, &[0.0, 1.0]);
    let shape = ObstacleShape::Disc { centre: [0.5, -0.0305], radius: 0.02 };
    let stop = b.obstacle(Obstacle { name: "stop".into(), shape, motion: None });
    let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e6 }));
    b.contact(Contact::new(
        "stop",
        [ContactPartner::Beam(tube), ContactPartner::Obstacle(stop)],
        law,
    ));
    let force = [[0.0, -1000.0]; 2];
    let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
    let kind = LoadKind::Distributed { beam: tube, stretch, force, follower: false };
    b.load(Load { until: 2e-3, ..Load::new("push", kind) });
    // It is not known in what motion the tube comes: a factor of two.
    let [reported, found] = durations(&b, &Settings::new(0.1, 5e-5));
    assert!((0.5..2.0).contains(&(reported / found)), "{reported} {found}");
}

/// Where modes say something else: ends that cannot slide stiffen a beam that bends far, a shallow arch snaps through, stops close.
#[test]
fn contacts_that_no_modes_describe_last_as_long_as_a_trial_says() {
    let near = |b: &ModelBuilder, settings: &Settings| {
        let [reported, found] = durations(b, settings);
        assert!((reported / found - 1.0).abs() < 0.1, "{reported} s told, {found} s found");
        // That the modes say something else is said.
        let advice = advise(&freeze(b), settings);
        let text = advice.iter().find(|a| a.topic == Topic::ContactDuration).map(|a| &a.text);
        assert!(text.is_some_and(|t| t.contains("trial computation")), "{text:?}");
    };
    let mut b = ModelBuilder::new();
    let thin = bar(&mut b, 2.0, 20, [0.1, 0.01]);
    hold(&mut b, thin, &SupportKind::Pin, &[0.0, 1.0]);
    b.projectile(mass(at("mid", thin, 0.5), 20.0, 1e6, [0.0, -5.0]));
    let settings = Settings::new(0.2, 1e-4);
    near(&b, &settings);

    let mut b = ModelBuilder::new();
    let pipe = bar(&mut b, 6.0, 24, [0.1, 0.1]);
    hold(&mut b, pipe, &SupportKind::Clamp, &[0.0, 1.0]);
    for at_end in [0.333, 0.667] {
        let name = format!("stop {at_end}");
        let kind = SupportKind::Stop {
            direction: [0.0, -1.0],
            gap: 1e-3,
            stiffness: 1e8,
            two_sided: false,
        };
        b.support(Support::new(name.clone(), at(&name, pipe, at_end), kind));
    }
    b.projectile(mass(at("mid", pipe, 0.5), 400.0, 2e6, [0.0, -2.0]));
    near(&b, &Settings::new(0.3, 1e-4));
}

/// A mass that rests on a beam does not leave it: no duration is made up.
#[test]
fn a_contact_that_does_not_end_lasts_at_least_as_long_as_it_was_tried() {
    let mut b = ModelBuilder::new();
    let beam = bar(&mut b, 2.0, 20, [0.05, 0.05]);
    hold(&mut b, beam, &SupportKind::Pin, &[0.0, 1.0]);
    let acceleration = [0.0, -9.81];
    b.load(Load::new("weight", LoadKind::Gravity { acceleration }));
    b.projectile(mass(at("mid", beam, 0.5), 20.0, 1e5, [0.0, -1e-3]));
    let settings = Settings { start: Start::Static, ..Settings::new(0.5, 2e-4) };
    let model = freeze(&b);
    let advice = advise(&model, &settings);
    let found = advice.iter().find(|a| a.topic == Topic::ContactDuration);
    let text = found.map(|a| &a.text);
    assert!(text.is_some_and(|t| t.contains("at least")), "{text:?}");
    let summary = run(&model, &settings);
    let ContactRecord::Smooth { intervals, .. } = &summary.contacts[0].record else { return };
    let lasts = intervals[0].end.min(settings.end) - intervals[0].start;
    let reported = found.map_or(f64::NAN, |a| a.value);
    assert!(intervals[0].end.is_nan() || reported <= lasts, "{reported} {lasts}");
}

/// Too many elements for a trial, and too far bent for modes: nothing is estimated, and why.
#[test]
fn contacts_neither_linear_nor_tried_are_not_estimated() {
    let of = |speed: f64| {
        let mut b = ModelBuilder::new();
        let beam = bar(&mut b, 2.0, 2900, [0.1, 0.01]);
        hold(&mut b, beam, &SupportKind::Pin, &[0.0, 1.0]);
        b.projectile(mass(at("mid", beam, 0.5), 20.0, 1e6, [0.0, -speed]));
        let advice = advise(&freeze(&b), &Settings::new(0.2, 1e-4));
        let found = advice.into_iter().find(|a| a.topic == Topic::ContactDuration);
        found.map_or(String::new(), |a| a.text)
    };
    let far = of(5.0);
    assert!(far.contains("not estimated: the struck point deflects"), "{far}");
    let near = of(1e-3);
    assert!(near.contains("lasts about"), "{near}");
}

/// A soft end-on contact is carried by waves that the step follows; a hard one is not.
#[test]
fn waves_along_a_beam_are_reported_where_the_contact_is_short() {
    let of = |stiffness: f64| {
        let mut b = ModelBuilder::new();
        let strut = bar(&mut b, 2.0, 100, [0.05, 0.05]);
        hold(&mut b, strut, &SupportKind::Clamp, &[0.0]);
        b.projectile(mass(at("end", strut, 1.0), 5.0, stiffness, [-0.1, 0.0]));
        verdict(&advise(&freeze(&b), &Settings::new(0.05, 1e-5)), Topic::WaveTransit)
    };
    assert_eq!(of(1e6), Some(Verdict::Fine));
    assert_eq!(of(5e9), Some(Verdict::Note));
}

/// A section cannot have more inertia than its area has at half its depth, `A h^2/4`.
#[test]
fn an_inertia_beyond_what_the_depth_holds_is_reported() {
    for (inertia, reported) in
        [(4e-4 * 1e-4 * 0.99, None), (4e-4 * 1e-4 * 1.1, Some(Verdict::Warning))]
    {
        let mut b = ModelBuilder::new();
        let section = Section { depth: Some(0.02), ..Section::new("given", 4e-4, inertia) };
        let beam = of_section(&mut b, 1.0, 10, section);
        hold(&mut b, beam, &SupportKind::Clamp, &[0.0]);
        let advice = advise(&freeze(&b), &Settings::new(0.01, 1e-5));
        assert_eq!(verdict(&advice, Topic::Magnitude), reported, "{advice:#?}");
    }
}

/// A bar's flat end presses with two corners, however fine its mesh is, and both count in what is reported it.
#[test]
fn a_flat_end_presses_with_both_corners_on_any_mesh() {
    for elements in [10, 50, 150] {
        let mut b = ModelBuilder::new();
        let flying = bar(&mut b, 1.0, elements, [0.05, 0.05]);
        let shape = ObstacleShape::HalfPlane { point: [-1e-3, 0.0], normal: [1.0, 0.0] };
        let wall = b.obstacle(Obstacle { name: "wall".into(), shape, motion: None });
        let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e6 }));
        b.contact(Contact::new(
            "wall",
            [ContactPartner::Beam(flying), ContactPartner::Obstacle(wall)],
            law,
        ));
        // Slow enough that nothing beside the end comes near the wall.
        b.initial_motion(InitialMotion { velocity: [-0.2, 0.0], ..InitialMotion::default() });
        let settings = Settings::new(0.03, 2e-5);
        let [reported, found] = durations(&b, &settings);
        // A rigid bar on 2 k.
        let rigid = std::f64::consts::PI * (7850.0 * 0.0025 / 2e6_f64).sqrt();
        assert!((reported / rigid - 1.0).abs() < 0.02, "{elements}: {reported} told, {rigid}");
        assert!((found / rigid - 1.0).abs() < 0.02, "{elements}: {found} found, {rigid}");
        let advice = advise(&freeze(&b), &settings);
        let text = advice.iter().find(|a| a.topic == Topic::ContactDuration).map(|a| &a.text);
        assert!(
            text.is_some_and(|t| t.contains("2 contact points") && t.contains("k/2")),
            "{text:?}"
        );
        // It moves as one piece, and no wave brings its force to EA v/c.
        assert_eq!(verdict(&advice, Topic::ForceRise), None);
    }
}

/// 50 x 200 mm under a short impact: 8 % of force by shear. A slender bar, and a stocky one behind a soft contact, do not care.
#[test]
fn shear_is_reported_where_it_matters() {
    let of = |depth: f64, length: f64, stiffness: f64| {
        let mut b = ModelBuilder::new();
        let beam = bar(&mut b, length, 40, [0.05, depth]);
        hold(&mut b, beam, &SupportKind::Pin, &[0.0, 1.0]);
        b.projectile(mass(at("mid", beam, 0.5), 5.0, stiffness, [0.0, -0.1]));
        advise(&freeze(&b), &Settings::new(0.01, 1e-6))
    };
    let stocky = of(0.2, 10.0, 3e9);
    assert!(verdict(&stocky, Topic::Shear) >= Some(Verdict::Note), "{stocky:#?}");
    let very = of(0.2, 0.266, 3e9);
    assert_eq!(verdict(&very, Topic::Shear), Some(Verdict::Warning), "{very:#?}");
    assert_eq!(verdict(&of(0.02, 3.0, 1e5), Topic::Shear), Some(Verdict::Fine));
    // The force of a soft contact is right, the way of the span under it is not.
    let soft = of(0.2, 0.8, 1e4);
    assert_eq!(verdict(&soft, Topic::Shear), Some(Verdict::Note));
    let text = soft.iter().find(|a| a.topic == Topic::Shear).map(|a| &a.text);
    assert!(text.is_some_and(|t| t.contains("deflection by 19.5 %")), "{text:?}");
}

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

/// A chord of I over two stations of a depth that doubles is a third too large in its middle; seven stations are within a per cent.
#[test]
fn two_stations_of_a_tapered_depth_are_reported() {
    let of = |parts: usize, power: i32| {
        let station = |k: usize| {
            let at = k as f64 / parts as f64;
            let size = 1.0 + at;
            let depth = if power == 3 { 0.02 * size } else { 0.02 };
            let (area, inertia) = (4e-4 * size, 1.333_333e-8 * size.powi(power));
            Station { at, area, inertia, depth: Some(depth), profile: Profile::Unknown }
        };
        let stations = (0..=parts).map(station).collect();
        let section = Section { stations, ..Section::rectangle("taper", 0.02, 0.02) };
        let mut b = ModelBuilder::new();
        let beam = of_section(&mut b, 1.0, 24, section);
        hold(&mut b, beam, &SupportKind::Clamp, &[0.0]);
        let advice = advise(&freeze(&b), &Settings::new(0.01, 1e-5));
        advice.iter().find(|a| a.topic == Topic::Taper).map(|a| (a.verdict, a.value))
    };
    let (found, share) = of(1, 3).unwrap_or((Verdict::Fine, 0.0));
    assert_eq!(found, Verdict::Warning);
    assert!((share - 1.0 / 3.0).abs() < 1e-3, "{share}");
    assert_eq!(of(6, 3), None);
    // A width that doubles has straight lines of A and I.
    assert_eq!(of(1, 1), None);
}

#[test]
fn rows_too_far_apart_for_a_contact_are_reported() {
    let of = |record_every: usize| {
        let mut b = ModelBuilder::new();
        let beam = bar(&mut b, 3.0, 24, [0.05, 0.05]);
        hold(&mut b, beam, &SupportKind::Pin, &[0.0, 1.0]);
        b.projectile(mass(at("mid", beam, 0.5), 5.0, 1e7, [0.0, -0.1]));
        let settings = Settings { record_every, ..Settings::new(0.02, 2e-5) };
        verdict(&advise(&freeze(&b), &settings), Topic::Recording)
    };
    assert_eq!(of(1), Some(Verdict::Fine));
    assert_eq!(of(5), Some(Verdict::Fine));
    assert_eq!(of(100), Some(Verdict::Warning));
}

/// After the run: a contact still closed, one that never closed, reactions of rigid impacts.
#[test]
fn contacts_left_open_by_a_run_are_reported_after_it() {
    let of = |kind: ProjectileKind, mass: f64, standoff: f64| {
        let mut b = ModelBuilder::new();
        let beam = bar(&mut b, 2.0, 20, [0.05, 0.05]);
        hold(&mut b, beam, &SupportKind::Clamp, &[0.0, 1.0]);
        let one = Projectile::new("mass", kind, mass, [0.0, -0.5], at("mid", beam, 0.5));
        b.projectile(Projectile { standoff, ..one });
        let (model, settings) = (freeze(&b), Settings::new(5e-3, 5e-6));
        review(&model, &settings, &run(&model, &settings), &[])
    };
    let soft = of(ProjectileKind::spring(1e4), 20.0, 0.0);
    assert!(
        soft.iter().any(|a| a.topic == Topic::Ending && a.text.contains("still closed")),
        "{soft:#?}"
    );
    let late = of(ProjectileKind::spring(1e4), 20.0, 1.0);
    assert!(late.iter().any(|a| a.text.contains("no contact up to the end")), "{late:#?}");
    assert!(of(ProjectileKind::spring(5e7), 0.5, 0.0).is_empty());
    let rigid = of(ProjectileKind::Rigid { restitution: 0.5 }, 20.0, 0.0);
    assert!(rigid.iter().any(|a| a.topic == Topic::Reactions), "{rigid:#?}");
}

fn ball(position: [f64; 2]) -> Disc {
    let (velocity, name) = ([0.0; 2], "ball".to_owned());
    Disc { name, mass: 40.0, inertia: None, radius: 0.05, position, velocity, spin: 0.0 }
}

/// A ball that lies on a girder from the start, or falls on it from a height: only the fall has an impact, whose impulse depends on the mesh, and
/// a ball that lies there is no contact cut short.
#[test]
fn persistent_contacts_without_impacts_have_no_effective_mass_to_warn_of() {
    for (height, struck) in [(0.0, false), (1e-3, true)] {
        let mut b = ModelBuilder::new();
        let girder = bar(&mut b, 2.0, 8, [0.05, 0.05]);
        hold(&mut b, girder, &SupportKind::Clamp, &[0.0, 1.0]);
        let disc = b.disc(ball([1.0, 0.075 + height]));
        let between = [ContactPartner::Disc(disc), ContactPartner::Beam(girder)];
        let law = TouchLaw::Rigid(RigidLaw::frictionless(0.0));
        b.contact(Contact::new("seat", between, law));
        b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
        let start = if struck { Start::Reference } else { Start::Static };
        let (model, settings) = (freeze(&b), Settings { start, ..Settings::new(0.02, 2e-5) });
        let mut advice = advise(&model, &settings);
        let summary = run(&model, &settings);
        settle(&mut advice, &settings, &summary);
        let warned = verdict(&advice, Topic::EffectiveMass) == Some(Verdict::Warning);
        assert_eq!(warned, struck, "{advice:#?}");
        let of_mesh = |one: &AuditWarning| one.caution == Caution::MeshImpulse;
        assert_eq!(audit(&summary, &[], |_| None).iter().any(of_mesh), struck);
        let after = review(&model, &settings, &summary, &advice);
        let cut_short = after.iter().any(|a| a.topic == Topic::Ending);
        assert!(struck || !cut_short, "{after:#?}");
    }
}

/// A ball on a rope beside a beam is meant to hang; one without a rope is missed.
#[test]
fn a_ball_on_a_spring_that_touches_nothing_is_no_missed_contact() {
    for hangs in [true, false] {
        let mut b = ModelBuilder::new();
        let girder = bar(&mut b, 2.0, 8, [0.05, 0.05]);
        hold(&mut b, girder, &SupportKind::Clamp, &[0.0, 1.0]);
        let disc = b.disc(ball([1.0, 1.0]));
        let between = [ContactPartner::Disc(disc), ContactPartner::Beam(girder)];
        let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e6 }));
        b.contact(Contact::new("seat", between, law));
        if hangs {
            b.spring(Spring {
                name: "rope".into(),
                between: [Anchor::Ground([1.0, 2.0]), Anchor::Projectile("ball".into())],
                law: SpringLaw::Tension { stiffness: 1e5, slack: 0.0 },
                damping: 0.0,
                length: None,
                strength: None,
                yielding: None,
            });
        }
        let (model, settings) = (freeze(&b), Settings::new(0.02, 2e-5));
        let after = review(&model, &settings, &run(&model, &settings), &[]);
        let missed = after.iter().any(|a| a.text.contains("no contact up to the end"));
        assert_eq!(missed, !hangs, "{after:#?}");
    }
}

/// A rubber block pressed together by a fifth: Green's strain and the engineering strain are no longer the same.
#[test]
fn large_compression_under_greens_strain_is_reported() {
    let of = |measure: StrainMeasure, force: f64| {
        let mut b = ModelBuilder::new();
        let rubber = Material::new("rubber", 1e6, 1000.0);
        let material = b.material(Material { strain: measure, ..rubber });
        let section = b.section(Section::rectangle("block", 0.1, 0.1));
        let beam = Beam::new("block", &[[0.0, 0.0], [0.05, 0.0]], 4, material, section);
        let beam = b.beam(beam);
        hold(&mut b, beam, &SupportKind::Clamp, &[0.0]);
        let (force, moment) = ([-force, 0.0], 0.0);
        let kind = LoadKind::Point { at: at("end", beam, 1.0), force, moment, follower: false };
        b.load(Load::new("thrust", kind));
        let model = freeze(&b);
        let settings = Settings { start: Start::Static, ..Settings::new(1e-3, 1e-4) };
        verdict(&review(&model, &settings, &run(&model, &settings), &[]), Topic::Strain)
    };
    assert_eq!(of(StrainMeasure::Green, 1600.0), Some(Verdict::Warning));
    assert_eq!(of(StrainMeasure::Green, 200.0), None);
    assert_eq!(of(StrainMeasure::Engineering, 1600.0), None);
}

/// A projectile against a clamp: nothing in the beam moves, and nothing is said of its waves.
#[test]
fn nothing_is_said_of_waves_in_a_beam_that_cannot_move() {
    let mut b = ModelBuilder::new();
    let beam = bar(&mut b, 1.0, 10, [0.05, 0.05]);
    hold(&mut b, beam, &SupportKind::Clamp, &[0.0, 1.0]);
    let kind = ProjectileKind::Rigid { restitution: 0.5 };
    b.projectile(Projectile::new("hammer", kind, 1.0, [0.0, -1.0], at("start", beam, 0.0)));
    let advice = advise(&freeze(&b), &Settings::new(0.01, 1e-3));
    assert_eq!(verdict(&advice, Topic::WaveTransit), None);
    assert!(advice.iter().all(|a| a.verdict == Verdict::Fine), "{advice:#?}");
}

/// A strip above a stop, at rest: it is not its clamped end that will be struck.
#[test]
fn a_place_that_never_comes_is_not_reported_as_struck() {
    let mut b = ModelBuilder::new();
    let beam = bar(&mut b, 0.3, 12, [0.02, 0.001]);
    hold(&mut b, beam, &SupportKind::Clamp, &[0.0]);
    let shape = ObstacleShape::HalfPlane { point: [0.28, -0.0025], normal: [0.0, 1.0] };
    let stop = b.obstacle(Obstacle { name: "stop".into(), shape, motion: None });
    let law = TouchLaw::Rigid(RigidLaw::frictionless(0.6));
    b.contact(Contact::new(
        "tap",
        [ContactPartner::Beam(beam), ContactPartner::Obstacle(stop)],
        law,
    ));
    let advice = advise(&freeze(&b), &Settings::new(1.0, 1e-4));
    assert_eq!(verdict(&advice, Topic::EffectiveMass), None, "{advice:#?}");
}

/// Two elements of the shortest wave of weight leave the force right within a per cent: no alarm; one does not.
#[test]
fn elements_are_too_few_where_the_force_is_wrong() {
    let of = |elements: usize| {
        let mut b = ModelBuilder::new();
        let beam = bar(&mut b, 2.0, elements, [0.05, 0.05]);
        hold(&mut b, beam, &SupportKind::Pin, &[0.0, 1.0]);
        b.projectile(mass(at("mid", beam, 0.5), 1.0, 5e7, [0.0, -0.1]));
        let (model, settings) = (freeze(&b), Settings::new(1e-3, 2e-6));
        let reported = verdict(&advise(&model, &settings), Topic::BendingWave);
        let force = match &run(&model, &settings).contacts[0].record {
            ContactRecord::Smooth { peak_force, .. } => peak_force.value,
            ContactRecord::Nonsmooth { .. } => f64::NAN,
        };
        (reported, force)
    };
    let (_, fine) = of(120);
    for (elements, reported, off) in
        [(12, Verdict::Fine, 0.01), (6, Verdict::Note, 0.05), (4, Verdict::Warning, 0.4)]
    {
        let (found, force) = of(elements);
        assert_eq!(found, Some(reported), "{elements}");
        assert!((force / fine - 1.0).abs() < off, "{elements}: {force} {fine}");
    }
}

/// A disc thrown at a beam: what is said of it is there, whatever holds the beam.
#[test]
fn a_disc_gets_the_same_advice_as_a_guided_mass() {
    let mut b = ModelBuilder::new();
    let beam = bar(&mut b, 2.0, 40, [0.05, 0.05]);
    hold(&mut b, beam, &SupportKind::Pin, &[0.0, 1.0]);
    let ball = b.disc(disc("ball", 1.0, 0.05, [1.0, 0.0751], [0.0, -1.0]));
    let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e6 }));
    b.contact(Contact::new("blow", [ContactPartner::Disc(ball), ContactPartner::Beam(beam)], law));
    let [reported, found] = durations(&b, &Settings::new(8e-3, 2e-5));
    assert!((reported / found - 1.0).abs() < 0.03, "{reported} {found}");
}

/// A mass in the middle ties two spans of one beam there: that is neither an end nor a support.
#[test]
fn a_mass_at_the_struck_point_is_no_support() {
    let of = |mass_there: bool| {
        let mut b = ModelBuilder::new();
        let beam = bar(&mut b, 2.0, 20, [0.05, 0.05]);
        hold(&mut b, beam, &SupportKind::Pin, &[0.0, 1.0]);
        if mass_there {
            let name = "load".to_owned();
            b.point_mass(PointMass {
                name,
                at: at("mid", beam, 0.5),
                mass: 5.0,
                rotary_inertia: 0.0,
            });
        }
        b.projectile(mass(at("mid", beam, 0.5), 1.0, 1e6, [0.0, -0.1]));
        let advice = advise(&freeze(&b), &Settings::new(0.02, 1e-5));
        advice.iter().find(|a| a.topic == Topic::Span).map_or(f64::NAN, |a| a.value)
    };
    assert!((of(true) - 1.0).abs() < 1e-9 && (of(false) - 1.0).abs() < 1e-9, "{}", of(true));
}

/// A stiff stick that falls askew on a floor without losses: its mesh answers with far more than a slender beam's own mass, so that
/// what follows is a property of the mesh. Reported before the run and in its summary.
#[test]
fn the_effective_mass_of_a_stick_on_a_floor_is_reported() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("stiff", 1e12, 1000.0));
    let section = Section { depth: Some(0.02), ..Section::new("rod", 4e-4, 1.3333e-8) };
    let section = b.section(section);
    let stick = b.beam(common::beam("stick", [0.0, 0.02], [0.9, 0.2], 4, material, section));
    let floor = b.obstacle(Obstacle {
        name: "floor".into(),
        shape: ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] },
        motion: None,
    });
    let law = TouchLaw::Rigid(RigidLaw::frictionless(1.0));
    b.contact(Contact::new(
        "drop",
        [ContactPartner::Beam(stick), ContactPartner::Obstacle(floor)],
        law,
    ));
    b.initial_motion(InitialMotion { velocity: [0.0, -1.0], ..InitialMotion::default() });
    let model = b.build().unwrap();
    let settings = Settings::new(0.02, 1e-5);
    let advice = advise(&model, &settings);
    let reported = advice.iter().find(|a| a.topic == Topic::EffectiveMass).unwrap();
    assert_eq!(reported.verdict, Verdict::Warning, "{reported:?}");
    let found = simulate(&model, &settings, &mut NoRecorder).unwrap();
    let mass = found.contacts[0].effective_mass.unwrap();
    assert!((reported.value / mass.on_mesh - 1.0).abs() < 1e-3, "{reported:?} {mass:?}");
}

#[test]
fn no_contact_is_predicted_on_a_beam_without_mass_that_no_run_can_move() {
    let struck = |density: f64| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, density));
        let section = b.section(Section::new("square", 1e-2, 8.333e-6));
        let beam = b.beam(common::beam("beam", [0.0, 0.0], [5.0, 0.0], 4, material, section));
        b.support(Support::new("root", at("root", beam, 0.0), SupportKind::Clamp));
        let (name, tip) = ("tip".to_owned(), at("tip", beam, 1.0));
        b.point_mass(PointMass { name, at: tip.clone(), mass: 1000.0, rotary_inertia: 0.0 });
        let kind = ProjectileKind::Rigid { restitution: 0.5 };
        b.projectile(Projectile::new("ball", kind, 10.0, [0.0, 1.0], tip));
        freeze(&b)
    };
    let settings = Settings::new(1.0, 1e-3);
    assert!(advise(&struck(7850.0), &settings).iter().any(|one| one.contact == "ball"));
    let found = advise(&struck(0.0), &settings);
    assert!(found.iter().all(|one| one.contact != "ball"), "{found:?}");
    for one in &found {
        assert!(one.value.is_finite() && one.reference.is_finite(), "{one:?}");
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

/// A bar that flies at a post with a flat end presses with as many points as the mesh has; a round end, or one askew, with one.
#[test]
fn a_contact_whose_stiffness_grows_with_the_mesh_is_reported() {
    fn built(ends: Ends, turned: f64, law: TouchLaw) -> ModelBuilder {
        let mut b = ModelBuilder::new();
        let post = bar(&mut b, 3.0, 12, [0.2, 0.2]);
        hold(&mut b, post, &SupportKind::Clamp, &[0.0, 1.0]);
        let material = b.material(Material::new("ram", 2.1e11, 7850.0));
        let section = b.section(Section::rectangle("ram", 0.2, 0.2));
        let (sine, cosine) = turned.sin_cos();
        // Five millimetres above the post with its lowest corner.
        let low = 0.105 + 0.1 * sine;
        let top = [1.5 + sine, low + cosine];
        let ram = Beam::new("ram", &[[1.5, low], top], 8, material, section);
        let ram = b.beam(Beam { ends, ..ram });
        let velocity = [0.0, -1.0];
        b.initial_motion_of("ram", InitialMotion { velocity, ..InitialMotion::default() });
        b.contact(Contact::new(
            "blow",
            [ContactPartner::Beam(post), ContactPartner::Beam(ram)],
            law,
        ));
        b
    }
    let scene = |ends: Ends, turned: f64, law: TouchLaw| {
        let model = freeze(&built(ends, turned, law));
        verdict(&advise(&model, &Settings::new(0.5, 1e-4)), Topic::FaceStiffness)
    };
    let linear = || TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e6 }));
    assert_eq!(scene(Ends::Flat, 0.0, linear()), Some(Verdict::Note));
    assert_eq!(scene(Ends::Round, 0.0, linear()), None);
    assert_eq!(scene(Ends::Flat, 0.5, linear()), None);
    assert_eq!(scene(Ends::Flat, 0.0, TouchLaw::Rigid(RigidLaw::frictionless(0.5))), None);
    // Whatever presses, the duration reported is that of the run, and the step advised resolves it.
    for (ends, stiffness) in [(Ends::Flat, 1e8), (Ends::Round, 1e8), (Ends::Flat, 1e9)] {
        let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness }));
        let b = built(ends, 0.0, law);
        for step in [1e-5, 1e-3] {
            let [reported, _] = durations(&b, &Settings::new(0.015, step));
            let [_, found] = durations(&b, &Settings::new(0.015, 1e-5));
            println!("{ends:?} {stiffness:e} {step:e}: told {reported:e}, found {found:e}");
            assert!((reported / found - 1.0).abs() < 0.1, "{ends:?} {reported} {found}");
        }
    }
    // Lying along each other, whatever the ends.
    assert_eq!(scene(Ends::Round, std::f64::consts::FRAC_PI_2, linear()), Some(Verdict::Note));
}

/// Whatever else is known of a contact, the step that is advised resolves it as the book says: twenty steps and more.
#[test]
fn the_advised_step_takes_twenty_steps_of_the_contact() {
    for (kg, stiffness, step) in [(5.0, 1e6, 2e-3), (0.5, 1e6, 1e-3), (50.0, 2e5, 2e-2)] {
        let mut b = ModelBuilder::new();
        let girder = bar(&mut b, 3.0, 24, [0.1, 0.1]);
        hold(&mut b, girder, &SupportKind::Pin, &[0.0, 1.0]);
        b.projectile(mass(at("mid", girder, 0.5), kg, stiffness, [0.0, -1.0]));
        let model = freeze(&b);
        let advice = advise(&model, &Settings::new(0.2, step));
        let reported =
            advice.iter().find(|a| a.topic == Topic::ContactDuration).expect("a contact");
        let (_, said) = reported.text.split_once("set time.step to ").expect("a step");
        let (number, unit) = said.split_once(' ').expect("a unit");
        let scale = if unit.starts_with("ms") { 1e-3 } else { 1e-6 };
        let better = number.parse::<f64>().expect("a number") * scale;
        let steps = |duration: f64| duration / better;
        assert!(steps(reported.value) >= 20.0, "{reported:?}");
        // And by a run in such steps.
        let [_, found] = durations(&b, &Settings::new(0.2, better));
        assert!(steps(found) >= 19.0 && steps(found) < 100.0, "{found}: {reported:?}");
    }
}

/// An end that begins to move at once makes reactions without a limit (of an endless beam they fall with the root of time); one that follows a
/// smooth course does not.
#[test]
fn velocity_jumps_of_driven_supports_are_reported() {
    let of = |function: TimeFunction| {
        let mut b = ModelBuilder::new();
        let beam = bar(&mut b, 2.0, 20, [0.05, 0.05]);
        let driven = Support::new("first", at("start", beam, 0.0), SupportKind::Pin);
        let motion = Motion { displacement: [0.0, 5e-3], rotation: 0.0, function };
        b.support(Support { motion: Some(motion), ..driven });
        b.support(Support::new("second", at("end", beam, 1.0), SupportKind::Pin));
        let (model, settings) = (freeze(&b), Settings::new(10e-3, 2e-5));
        let found = review(&model, &settings, &run(&model, &settings), &[]);
        found.into_iter().find(|one| one.topic == Topic::Reactions)
    };
    let reported = of(TimeFunction::Ramp { duration: 4e-3 }).expect("told");
    assert!(
        reported.contact == "support first" && reported.verdict == Verdict::Note,
        "{reported:?}"
    );
    let times: Vec<f64> = (0..=40).map(|k| f64::from(k) * 1e-4).collect();
    let course = |t: &f64| 0.5 - 0.5 * (std::f64::consts::PI * t / 4e-3).cos();
    let values = times.iter().map(course).collect();
    assert_eq!(of(TimeFunction::Table { times, values, smooth: true }), None);
}

/// The run shows how many steps its contact lasted, whatever could be estimated before.
#[test]
fn contacts_of_few_steps_are_reported_after_the_run() {
    let of = |step: f64, before: &[Advice]| {
        let mut b = ModelBuilder::new();
        let beam = bar(&mut b, 2.0, 20, [0.05, 0.05]);
        hold(&mut b, beam, &SupportKind::Clamp, &[0.0, 1.0]);
        b.projectile(mass(at("mid", beam, 0.5), 0.5, 5e7, [0.0, -0.5]));
        let (model, settings) = (freeze(&b), Settings::new(5e-3, step));
        let found = review(&model, &settings, &run(&model, &settings), before);
        found.into_iter().find(|one| one.topic == Topic::ContactDuration)
    };
    assert_eq!(of(5e-6, &[]), None);
    let reported = of(1.5e-4, &[]).expect("told");
    assert!(
        reported.verdict == Verdict::Warning && reported.text.contains("time.step"),
        "{reported:?}"
    );
    assert_eq!(of(1.5e-4, std::slice::from_ref(&reported)), None, "once is enough");
}

/// Rods of one element that meet with round ends have one point each; a stub on a column is meant to be short.
#[test]
fn short_beams_are_no_wrong_units() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(Section::circle("rod", 0.03));
    let rod = |name: &str, points: [[f64; 2]; 2]| {
        let beam = Beam::new(name, &points, 1, material, section);
        Beam { ends: Ends::Round, ..beam }
    };
    let one = b.beam(rod("a", [[0.0, 0.0], [0.5, 0.0]]));
    let other = b.beam(rod("b", [[1.001, 0.0], [0.501, 0.0]]));
    let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 5e7 }));
    b.contact(Contact::new("c", [ContactPartner::Beam(one), ContactPartner::Beam(other)], law));
    let found = advise(&freeze(&b), &Settings::new(2e-3, 1e-6));
    assert_eq!(verdict(&found, Topic::FaceStiffness), None, "{found:#?}");

    let stub = |tied: bool| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, 7850.0));
        let section = b.section(Section::rectangle("bar", 0.1, 0.1));
        let points = [[0.0, -0.05], [0.0, 0.0]];
        let foot = b.beam(Beam::new("foot", &points, 1, material, section));
        b.support(Support::new("ground", at("ground", foot, 0.0), SupportKind::Clamp));
        if tied {
            let points = [[0.0, 0.0], [0.0, 4.0]];
            let post = b.beam(Beam::new("post", &points, 4, material, section));
            let kind = JointKind::ElasticHinge { stiffness: 5e7, damping: 0.0 };
            b.joint(Joint::new("hinge", kind, [at("foot", foot, 1.0), at("post", post, 0.0)]));
        }
        verdict(&advise(&freeze(&b), &Settings::new(1e-3, 1e-4)), Topic::Magnitude)
    };
    assert_eq!((stub(false), stub(true)), (Some(Verdict::Warning), None));
}

/// The roof of a portal whose corners were forgotten is named with the joints that it lacks; with them, or on supports of its own, nothing is said.
#[test]
fn ends_that_nothing_joins_are_reported() {
    let of = |joined: usize, held: bool| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, 7850.0));
        let section = b.section(Section::rectangle("bar", 0.1, 0.1));
        let mut beam = |name: &str, points: [[f64; 2]; 2]| {
            b.beam(Beam::new(name, &points, 4, material, section))
        };
        let left = beam("left", [[0.0, 0.0], [0.0, 3.0]]);
        let right = beam("right", [[4.0, 0.0], [4.0, 3.0]]);
        let top = beam("top", [[0.0, 3.0], [4.0, 3.0]]);
        let mut support = |name: &str, beam: BeamId, end: f64, kind: SupportKind| {
            b.support(Support::new(name, at(name, beam, end), kind));
        };
        support("a", left, 0.0, SupportKind::Clamp);
        support("b", right, 0.0, SupportKind::Clamp);
        if held {
            support("c", left, 1.0, SupportKind::Pin);
            support("d", top, 0.0, SupportKind::Pin);
        }
        for (name, post, end) in
            [("first", left, 0.0), ("second", right, 1.0)].into_iter().take(joined)
        {
            let between = [at("post", post, 1.0), at("top", top, end)];
            b.joint(Joint::new(name, JointKind::Rigid, between));
        }
        freeze(&b)
    };
    let reported = |model: &Model| {
        let found = advise(model, &Settings::new(0.2, 1e-3)).into_iter();
        found.filter(|one| one.topic == Topic::LooseEnds).map(|one| one.text).collect::<Vec<_>>()
    };
    let none = of(0, false);
    let texts = reported(&none);
    assert!(
        texts.len() == 2 && texts[0].contains("between = [\"left.end\", \"top.start\"]"),
        "{texts:?}"
    );
    assert!(texts[1].contains("[joint.right-top]"), "{texts:?}");
    assert_eq!(reported(&of(1, false)).len(), 1);
    assert!(reported(&of(2, false)).is_empty());
    assert_eq!(reported(&of(0, true)).len(), 1, "where both are held they cannot part");
    // Statics names the joint, too.
    let faults = mechanisms(&none);
    let text = faults.iter().map(ToString::to_string).collect::<String>();
    assert!(
        text.contains("`left.end` and `top.start`") && text.contains("[joint.left-top]"),
        "{text}"
    );
    assert!(mechanisms(&of(2, false)).is_empty());
}
