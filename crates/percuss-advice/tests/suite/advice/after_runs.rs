//! What a finished run shows: open contacts, reactions, strains, steps of a contact.

use super::*;

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

/// A contact that the history has few rows of, of which nothing was known before the run.
#[test]
fn rows_too_far_apart_for_a_contact_are_reported_after_the_run() {
    let of = |record_every: usize, known: bool| {
        let mut b = ModelBuilder::new();
        let beam = bar(&mut b, 2.0, 20, [0.05, 0.05]);
        hold(&mut b, beam, &SupportKind::Clamp, &[0.0, 1.0]);
        let (kind, velocity) = (ProjectileKind::spring(5e7), [0.0, -0.5]);
        b.projectile(Projectile::new("mass", kind, 0.5, velocity, at("mid", beam, 0.5)));
        let settings = Settings { record_every, ..Settings::new(5e-3, 5e-6) };
        let model = freeze(&b);
        let before = if known { advise(&model, &settings) } else { Vec::new() };
        verdict(&review(&model, &settings, &run(&model, &settings), &before), Topic::Recording)
    };
    assert_eq!(of(1, false), None);
    assert_eq!(of(1000, false), Some(Verdict::Warning));
    // It has been said before.
    assert_eq!(of(1000, true), None);
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
        let mut allowed = advice.clone();
        allow(&mut allowed, |_| Some("meant"));
        settle(&mut allowed, &settings, &summary);
        assert_eq!(verdict(&allowed, Topic::EffectiveMass), Some(Verdict::Allowed));
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

/// A ball that falls on the tip of a cantilever under its weight: no estimate applies before the run.
fn dropped(step: f64) -> (Vec<Advice>, RunSummary, Findings) {
    let mut b = ModelBuilder::new();
    let strip = bar(&mut b, 0.5, 20, [0.05, 0.01]);
    hold(&mut b, strip, &SupportKind::Clamp, &[0.0]);
    let ends =
        [0.031, f64::INFINITY].map(|radius| HertzBody { young: 2.1e11, poisson: 0.3, radius });
    let law = SmoothLaw::elastic(Potential::hertz(ends));
    let kind = ProjectileKind::Elastic { law };
    let one = Projectile::new("ball", kind, 1.0, [0.0; 2], at("tip", strip, 1.0));
    b.projectile(Projectile { standoff: 0.5, direction: Some([0.0, -1.0]), ..one });
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let settings = Settings { start: Start::Static, ..Settings::new(0.322, step) };
    let model = freeze(&b);
    let before = advise(&model, &settings);
    let summary = run(&model, &settings);
    let found = conclude(&model, &settings, &summary, before.clone(), |_| None);
    (before, summary, found)
}

/// What no estimate covers is not checked before the run, and after it is judged by its own steps.
#[test]
fn a_contact_without_an_estimate_is_judged_by_its_own_steps() {
    let (before, coarse, found) = dropped(5e-5);
    assert_eq!(verdict(&before, Topic::ContactDuration), Some(Verdict::Unchecked), "{before:#?}");
    let own: Vec<&Advice> =
        found.advice.iter().filter(|a| a.topic == Topic::ContactDuration).collect();
    assert_eq!((own.len(), own[0].verdict), (1, Verdict::Warning), "{own:#?}");
    // The step that it asks for is enough, and then there is nothing to say.
    let text = own[0].text.split("time.step to ").nth(1).expect("a step");
    let micro = text.split(' ').next().and_then(|x| x.parse::<f64>().ok()).expect("microseconds");
    assert!(text.contains("\u{b5}s") && micro <= 5.0, "{text}");
    let (_, fine, settled) = dropped(1e-6 * micro);
    let peak = |run: &RunSummary| match &run.contacts[0].record {
        ContactRecord::Smooth { peak_force, .. } => peak_force.value,
        ContactRecord::Nonsmooth { .. } => f64::NAN,
    };
    let (_, finer, _) = dropped(0.5e-6 * micro);
    assert!((peak(&fine) / peak(&finer) - 1.0).abs() < 0.1, "{} {}", peak(&fine), peak(&finer));
    assert!((peak(&coarse) / peak(&finer) - 1.0).abs() > 0.2, "{} {}", peak(&coarse), peak(&finer));
    let verdicts = settled.advice.iter().filter(|a| a.topic == Topic::ContactDuration);
    assert!(verdicts.clone().all(|a| a.verdict != Verdict::Warning), "{:#?}", settled.advice);
    assert!(verdicts.clone().all(|a| a.verdict != Verdict::Unchecked), "{:#?}", settled.advice);
}

/// A boom with a mass at its tip that falls into a stiff rope, or on a stop: the snap lasts 2.2 ms, and its largest force is 174 kN.
fn snapped(stop: bool, step: f64) -> (RunSummary, Vec<Advice>) {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 2.1e11, 7850.0));
    let section = b.section(Section::tube("s", 0.04, 0.003));
    let boom = b.beam(Beam::new("a", &[[0.0; 2], [3.0, 0.0]], 6, material, section));
    hold(&mut b, boom, &SupportKind::Pin, &[0.0]);
    b.point_mass(PointMass {
        name: "t".into(),
        at: at("tip", boom, 1.0),
        mass: 50.0,
        rotary_inertia: 0.0,
    });
    if stop {
        let kind = SupportKind::Stop {
            direction: [0.0, -1.0],
            gap: 0.3,
            stiffness: 1e8,
            two_sided: false,
        };
        b.support(Support::new("s", at("tip", boom, 1.0), kind));
    } else {
        b.spring(Spring {
            name: "r".into(),
            between: [Anchor::Point(at("tip", boom, 1.0)), Anchor::Ground([3.0, 2.0])],
            law: SpringLaw::Tension { stiffness: 1e8, slack: 0.3 },
            damping: 0.0,
            length: None,
            strength: None,
            yielding: None,
        });
    }
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let (model, settings) = (freeze(&b), Settings::new(0.3, step));
    let summary = run(&model, &settings);
    let after = review(&model, &settings, &summary, &[]);
    (summary, after)
}

#[test]
fn ropes_and_stops_that_snap_within_a_step_are_reported() {
    for stop in [false, true] {
        let (summary, after) = snapped(stop, 5e-3);
        let found = after.iter().find(|a| a.topic == Topic::ContactDuration).expect("a warning");
        assert_eq!(found.verdict, Verdict::Warning, "{found:?}");
        assert_eq!(found.contact, if stop { "support s" } else { "spring r" });
        assert!(found.text.contains("time.step to 100 \u{b5}s"), "{}", found.text);
        // 2.2 ms, seen in steps of 5 ms.
        assert!((2e-3..3.5e-3).contains(&summary.pulses[0].lasts), "{:?}", summary.pulses);
        let (summary, after) = snapped(stop, 1e-4);
        let force = summary.pulses[0].force.value;
        assert!((force / 174.1e3 - 1.0).abs() < 0.02, "{force}");
        assert_eq!(verdict(&after, Topic::ContactDuration), None, "{after:#?}");
    }
}

/// A free bar that falls on a bed of compression alone with 2 m/s: a half wave of `pi sqrt(m / k)`, or a damper whose force jumps to `c v`.
fn on_a_bed(stiffness: f64, damping: f64, settings: &Settings) -> (RunSummary, Vec<Advice>) {
    let mut b = ModelBuilder::new();
    let beam = bar(&mut b, 2.0, 16, [0.06, 0.04]);
    b.foundation(Foundation {
        name: "bed".into(),
        beam,
        stretch: [Along::Fraction(0.0), Along::Fraction(1.0)],
        direction: None,
        law: FoundationLaw::Compression { stiffness, gap: 0.01 },
        damping,
        yielding: None,
    });
    b.initial_motion(InitialMotion { velocity: [0.0, -2.0], spin: 0.0, about: [0.0; 2] });
    let model = freeze(&b);
    let summary = run(&model, settings);
    let after = review(&model, settings, &summary, &[]);
    (summary, after)
}

#[test]
fn foundations_that_close_within_a_step_are_reported() {
    // A half wave of 0.96 ms.
    let (_, after) = on_a_bed(2e8, 0.0, &Settings::new(0.02, 1e-3));
    let found = after.iter().find(|a| a.topic == Topic::ContactDuration).expect("a warning");
    assert_eq!((found.verdict, found.contact.as_str()), (Verdict::Warning, "foundation bed"));
    assert!(found.text.contains("kN/m"), "{}", found.text);
    let (summary, after) = on_a_bed(2e8, 0.0, &Settings::new(0.02, 2e-5));
    assert_eq!(verdict(&after, Topic::ContactDuration), None, "{after:#?}");
    // `v sqrt(k m)`.
    let force = 2.0 * (2e8_f64 * 7850.0 * 0.06 * 0.04).sqrt();
    assert!((summary.pulses[0].force.value / force - 1.0).abs() < 0.01, "{:?}", summary.pulses);
}

#[test]
fn dampers_whose_force_falls_within_a_step_are_reported() {
    // 400 kN/m at the closing, which fall within 94 microseconds.
    let (summary, after) = on_a_bed(2e7, 2e5, &Settings::new(0.01, 1e-4));
    let found = after.iter().find(|a| a.topic == Topic::ContactDuration).expect("a warning");
    assert!(found.verdict == Verdict::Warning && found.text.contains("damper"), "{found:?}");
    assert!((summary.pulses[0].onset.value / 4e5 - 1.0).abs() < 1e-3, "{:?}", summary.pulses);
    let (summary, after) = on_a_bed(2e7, 2e5, &Settings::new(0.01, 1e-6));
    assert_eq!(verdict(&after, Topic::ContactDuration), None, "{after:#?}");
    assert!(summary.pulses[0].force.value > 0.97 * 4e5, "{:?}", summary.pulses);
}

/// A largest force at the end of a run is not final, but for what bears from the start on.
#[test]
fn what_is_still_rising_at_the_end_is_reported() {
    // It closes after 5 ms, and turns half a millisecond later.
    let open = |end: f64| {
        let (summary, after) = on_a_bed(2e8, 0.0, &Settings::new(end, 1e-5));
        let found = after.into_iter().any(|a| a.topic == Topic::Ending);
        (summary.still_rising().count(), found)
    };
    assert_eq!(open(4.9e-3), (0, false));
    assert_eq!(open(5.3e-3), (1, true));
    assert_eq!(open(5.8e-3), (0, false));
    assert_eq!(open(7e-3), (0, false));
}

/// Steps for an accuracy are not made shorter than a hundredth of the first one: a shorter contact is not seen.
#[test]
fn contacts_of_few_steps_are_reported_with_an_accuracy() {
    let mut b = ModelBuilder::new();
    let beam = bar(&mut b, 2.0, 20, [0.05, 0.05]);
    hold(&mut b, beam, &SupportKind::Clamp, &[0.0, 1.0]);
    b.projectile(mass(at("mid", beam, 0.5), 0.5, 5e7, [0.0, -0.5]));
    let model = freeze(&b);
    let of = |first: f64| {
        let settings = Settings { accuracy: Some(0.02), ..Settings::new(0.05, first) };
        let found = review(&model, &settings, &run(&model, &settings), &[]);
        found.into_iter().find(|one| one.topic == Topic::ContactDuration)
    };
    assert_eq!(of(1e-5), None);
    let found = of(2e-2).expect("a warning");
    assert_eq!(found.verdict, Verdict::Warning, "{found:?}");
    assert!(found.text.contains("in place of time.accuracy"), "{}", found.text);
}
