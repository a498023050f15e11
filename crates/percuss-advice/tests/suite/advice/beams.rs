//! Sections, meshes and connections of beams, and effective masses of struck points.

use super::*;

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

/// A girder of timber, 0.2 m by 0.8 m, under a load along it; all of it with these parts.
fn girder(length: f64, shear_modulus: Option<f64>, theory: Theory) -> ModelBuilder {
    let mut b = ModelBuilder::new();
    let material = b.material(Material { shear_modulus, ..Material::new("timber", 11e9, 450.0) });
    let section = Section { shear_factor: Some(0.833), ..Section::rectangle("deep", 0.2, 0.8) };
    let section = b.section(section);
    let slender = Beam::new("girder", &[[0.0, 0.0], [length, 0.0]], 16, material, section);
    let beam = b.beam(Beam { theory, ..slender });
    hold(&mut b, beam, &SupportKind::Pin, &[0.0]);
    let (stretch, force) = ([0.0, 1.0].map(Along::Fraction), [[0.0, -1e3]; 2]);
    b.load(Load::new("snow", LoadKind::Distributed { beam, stretch, force, follower: false }));
    b
}

/// Shear over bending in the lowest vibration of a pinned beam is `pi^2 EI/(kappa G A L^2)`: of the material's modulus, or of a solid rectangle.
#[test]
fn shear_of_beams_that_nothing_strikes_is_reported() {
    let of = |length: f64, modulus: Option<f64>, theory: Theory| {
        let mut b = girder(length, modulus, theory);
        hold(&mut b, BeamId::default(), &SupportKind::Pin, &[1.0]);
        let all = advise(&freeze(&b), &Settings::new(0.01, 1e-5));
        all.into_iter().find(|advice| advice.topic == Topic::Shear)
    };
    let bending = 11e9 * 0.8_f64.powi(2) / 12.0;
    let share =
        |shear: f64, length: f64| std::f64::consts::PI.powi(2) * bending / shear / length.powi(2);
    let timber = of(4.0, Some(650e6), Theory::Slender).unwrap();
    // Shear forces are constant in each of 16 elements.
    let exact = share(0.833 * 650e6, 4.0);
    assert!((timber.value / exact - 1.0).abs() < 5e-3, "{timber:?} {exact}");
    assert_eq!((timber.verdict, timber.contact.as_str()), (Verdict::Warning, "beam girder"));
    assert!(timber.text.contains("of its material and section"), "{}", timber.text);
    let solid = of(3.0, None, Theory::Slender).unwrap();
    let exact = share(11e9 / 2.6 * 5.0 / 6.0, 3.0);
    assert!((solid.value / exact - 1.0).abs() < 5e-3, "{solid:?} {exact}");
    assert_eq!(solid.verdict, Verdict::Note);
    assert!(solid.text.contains("for a solid rectangle"), "{}", solid.text);
    assert_eq!(of(4.0, Some(650e6), Theory::Shear), None);
    assert_eq!(of(20.0, Some(650e6), Theory::Slender), None);
}

/// A struck girder has the shear stiffness of its material, and where a joint holds its end the modes know how far it yields.
#[test]
fn shear_of_struck_girders_is_that_of_their_material() {
    let of = |on_corbel: bool| {
        let mut b = girder(4.0, Some(650e6), Theory::Slender);
        let beam = BeamId::default();
        if on_corbel {
            let material = b.material(Material::new("steel", 2.1e11, 7850.0));
            let section = b.section(Section::rectangle("bracket", 0.2, 0.3));
            let corbel = Beam::new("corbel", &[[4.4, 0.0], [4.0, 0.0]], 2, material, section);
            let corbel = b.beam(corbel);
            b.support(Support::new("column", at("column", corbel, 0.0), SupportKind::Clamp));
            let between = [at("end", beam, 1.0), at("tip", corbel, 1.0)];
            b.joint(Joint::new("bearing", JointKind::Hinge, between));
        } else {
            hold(&mut b, beam, &SupportKind::Pin, &[1.0]);
        }
        b.projectile(mass(at("mid", beam, 0.5), 5e3, 2e7, [0.0, -1.0]));
        let all = advise(&freeze(&b), &Settings::new(0.07, 1e-4));
        let found = all.into_iter().filter(|advice| advice.topic == Topic::Shear);
        found.collect::<Vec<_>>()
    };
    // 12 EI/(kappa G A L^2) of a span between pins.
    let [pinned] = &of(false)[..] else { panic!() };
    assert_eq!(pinned.verdict, Verdict::Warning);
    assert!(pinned.text.contains("static deflection by 81.3 %"), "{}", pinned.text);
    let [joined] = &of(true)[..] else { panic!() };
    assert_eq!(joined.verdict, Verdict::Warning);
    assert!(joined.text.contains("increase the static deflection by"), "{}", joined.text);
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
            Station {
                at,
                area,
                inertia,
                depth: Some(depth),
                profile: Profile::Unknown,
                properties: Default::default(),
            }
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

/// A rigid mass on a coarse mesh of a beam that can yield: no section force of the run shows how much too little it yields.
#[test]
fn a_rigid_mass_between_long_elements_of_a_beam_that_can_yield_is_reported() {
    let found = |elements: usize, plastic: bool| {
        let mut b = ModelBuilder::new();
        let curve = vec![Hardening { from: 0.0, stress: 355e6, modulus: 0.0 }];
        let law = Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain: None };
        let inelasticity = plastic.then_some(Inelasticity::Plastic(law));
        let steel = Material { inelasticity, ..Material::new("steel", 2.1e11, 7850.0) };
        let material = b.material(steel);
        let section = b.section(Section::rectangle("bar", 0.06, 0.1));
        let points = [[0.0, 0.0], [3.0, 0.0]];
        let beam = b.beam(Beam::new("beam", &points, elements, material, section));
        hold(&mut b, beam, &SupportKind::Pin, &[0.0]);
        hold(&mut b, beam, &SupportKind::Roller { direction: [1.0, 0.0] }, &[1.0]);
        let kind = ProjectileKind::Rigid { restitution: 0.0 };
        let strikes = at("mid", beam, 0.5);
        b.projectile(Projectile::new("mass", kind, 60.0, [0.0, -5.0], strikes));
        let all = advise(&freeze(&b), &Settings::new(0.06, 1e-4));
        let of = |one: &&Advice| one.topic == Topic::Unresolved && one.contact == "mass";
        all.iter().find(of).map(|one| (one.verdict, one.text.clone()))
    };
    let (verdict, text) = found(8, true).unwrap();
    assert!(verdict >= Verdict::Note && text.contains("elements of 375 mm"), "{text}");
    assert_eq!(found(64, true), None);
    assert_eq!(found(8, false), None);
}
