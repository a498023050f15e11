//! Durations of contacts, and steps and rows that resolve them.

use super::*;

/// A car against the foot of a column, a head with a body behind it, a tube that comes down on a stop.
#[test]
fn contacts_last_as_long_as_the_modes_say() {
    let near = |[reported, found]: [f64; 2], off: f64| {
        assert!((reported / found - 1.0).abs() < off, "{reported} s reported, {found} s found");
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
        assert!((reported / found - 1.0).abs() < 0.1, "{reported} s reported, {found} s found");
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
        assert!((reported / rigid - 1.0).abs() < 0.02, "{elements}: {reported} reported, {rigid}");
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
