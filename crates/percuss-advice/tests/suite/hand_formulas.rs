//! Hand formulas beside runs in which weights, motions and soft contacts take part: what is reported as met must fit.

use crate::common;

use common::{at, disc};
use percuss::*;
use percuss_advice::*;

const GRAVITY: f64 = 9.81;

/// A steel beam of 50 x 50 mm along the first axis.
fn steel(b: &mut ModelBuilder, length: f64, elements: usize) -> BeamId {
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(Section::rectangle("bar", 0.05, 0.05));
    b.beam(Beam::new("beam", &[[0.0, 0.0], [length, 0.0]], elements, material, section))
}

fn hold(b: &mut ModelBuilder, beam: BeamId, kind: &SupportKind, ends: &[f64]) {
    for end in ends {
        b.support(Support::new(format!("at {end}"), at("end", beam, *end), kind.clone()));
    }
}

fn gravity(b: &mut ModelBuilder) {
    let acceleration = [0.0, -GRAVITY];
    b.load(Load::new("weight", LoadKind::Gravity { acceleration }));
}

fn freeze(b: &ModelBuilder) -> Model {
    b.build().unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn run(model: &Model, settings: &Settings) -> RunSummary {
    simulate(model, settings, &mut NoRecorder).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn compared(b: &ModelBuilder, settings: &Settings) -> Vec<Comparison> {
    let model = freeze(b);
    compare(&model, settings, &run(&model, settings))
}

#[track_caller]
fn row<'a>(all: &'a [Comparison], formula: &str, quantity: &str) -> &'a Comparison {
    let found = all.iter().find(|c| c.formula == formula && c.quantity.contains(quantity));
    found.unwrap_or_else(|| panic!("no {formula}, {quantity} in {all:#?}"))
}

/// All rows that say that all they assume is met are within `off` per cent.
#[track_caller]
fn fits(all: &[Comparison], off: f64) {
    for c in all.iter().filter(|c| !c.holds_if.contains("not met")) {
        assert!(c.difference_percent.abs() < off, "{c:#?}");
    }
}

/// A disc of 1 kg on a floor, from rest or slowly: its weight is more than its motion. `W + sqrt(W^2 + k m v^2)`.
#[test]
fn a_disc_presses_a_floor_with_its_weight_too() {
    for (speed, potential) in [
        (0.01, Potential::Linear { stiffness: 2e5 }),
        (0.3, Potential::Linear { stiffness: 2e5 }),
        (0.02, Potential::Hertz { stiffness: 1e8 }),
    ] {
        let mut b = ModelBuilder::new();
        let ball = b.disc(disc("ball", 1.0, 0.05, [0.0, 0.05], [0.0, -speed]));
        let shape = ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] };
        let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
        gravity(&mut b);
        let law = TouchLaw::Smooth(SmoothLaw::elastic(potential.clone()));
        b.contact(Contact::new(
            "blow",
            [ContactPartner::Disc(ball), ContactPartner::Obstacle(floor)],
            law,
        ));
        let all = compared(&b, &Settings::new(0.03, 1e-5));
        // It comes down again, so that the force is that of the first contact.
        let force = row(&all, "two rigid bodies", "largest");
        assert!(!force.holds_if.contains("not met"), "{force:#?}");
        if matches!(potential, Potential::Linear { .. }) {
            let expected = GRAVITY + (GRAVITY * GRAVITY + 2e5 * speed * speed).sqrt();
            assert!((force.by_hand / expected - 1.0).abs() < 1e-9, "{force:#?}");
        }
        assert_eq!(all.len(), 2);
        fits(&all, 0.1);
    }
}

/// A heavy mass that hardly moves, on a long beam that hangs under its own weight: nine tenths of the force are its weight.
#[test]
fn a_weight_on_a_beam_without_end_is_part_of_the_impact() {
    let of = |start: Start| {
        let mut b = ModelBuilder::new();
        let beam = steel(&mut b, 12.0, 240);
        hold(&mut b, beam, &SupportKind::Pin, &[0.0, 1.0]);
        gravity(&mut b);
        let kind = ProjectileKind::spring(1e6);
        b.projectile(Projectile::new("mass", kind, 20.0, [0.0, -0.05], at("mid", beam, 0.5)));
        compared(&b, &Settings { start, ..Settings::new(0.02, 2e-5) })
    };
    let all = of(Start::Static);
    let force = row(&all, "infinite beam", "largest contact force");
    let without = 0.05 * (20.0 * 1e6_f64).sqrt();
    assert!(force.by_hand > 1.3 * without, "{force:#?}");
    assert!(force.difference_percent.abs() < 1.0, "{force:#?}");
    // The instant of a flat maximum is found less well than its height: 1.0 %.
    fits(&all, 1.5);
    let sags = of(Start::Reference);
    let force = row(&sags, "infinite beam", "largest contact force");
    assert!(
        force.holds_if.contains("own weight") && force.holds_if.contains("not met"),
        "{force:#?}"
    );
}

/// Beam and mass fly together: velocities are reported against the beam's.
#[test]
fn a_beam_that_flies_is_struck_in_its_own_frame() {
    let of = |flies: f64| {
        let mut b = ModelBuilder::new();
        let beam = steel(&mut b, 8.0, 160);
        let velocity = [0.0, flies];
        b.initial_motion(InitialMotion { velocity, ..InitialMotion::default() });
        let kind = ProjectileKind::spring(1e7);
        b.projectile(Projectile::new("mass", kind, 2.0, [0.0, flies - 1.0], at("mid", beam, 0.5)));
        compared(&b, &Settings::new(4e-3, 5e-6))
    };
    for flies in [0.0, 0.5, -3.0] {
        let all = of(flies);
        let velocity = row(&all, "infinite beam", "velocity of the projectile");
        assert!(!velocity.holds_if.contains("not met"), "{velocity:#?}");
        assert!(velocity.difference_percent.abs() < 1.0, "{flies}: {velocity:#?}");
    }
}

/// A beam that is held and starts to move is not at rest.
#[test]
fn a_held_beam_that_starts_with_a_velocity_is_not_at_rest() {
    let mut b = ModelBuilder::new();
    let beam = steel(&mut b, 8.0, 160);
    hold(&mut b, beam, &SupportKind::Pin, &[0.0, 1.0]);
    b.initial_motion(InitialMotion { velocity: [0.0, 0.2], ..InitialMotion::default() });
    let kind = ProjectileKind::spring(1e7);
    b.projectile(Projectile::new("mass", kind, 2.0, [0.0, -1.0], at("mid", beam, 0.5)));
    let all = compared(&b, &Settings::new(4e-3, 5e-6));
    assert!(all.iter().all(|c| c.holds_if.contains("not met")), "{all:#?}");
}

/// A falling weight on a span, from the hanging and from the straight state.
#[test]
fn the_impact_factor_knows_how_the_span_hangs() {
    let of = |start: Start| {
        let mut b = ModelBuilder::new();
        let beam = steel(&mut b, 3.0, 24);
        hold(&mut b, beam, &SupportKind::Pin, &[0.0]);
        let direction = [1.0, 0.0];
        hold(&mut b, beam, &SupportKind::Roller { direction }, &[1.0]);
        gravity(&mut b);
        b.record_point(at("mid", beam, 0.5));
        let kind = ProjectileKind::spring(1e6);
        b.projectile(Projectile::new("mass", kind, 400.0, [0.0, -0.3], at("mid", beam, 0.5)));
        compared(&b, &Settings { start, ..Settings::new(0.3, 1e-4) })
    };
    let hung = of(Start::Static);
    let heavy = row(&hung, "impact factor, heavy span", "deflection");
    assert!(heavy.difference_percent.abs() < 3.0, "{heavy:#?}");
    assert!(!heavy.holds_if.contains("not met"), "{heavy:#?}");
    let straight = of(Start::Reference);
    let heavy = row(&straight, "impact factor, heavy span", "deflection");
    assert!(heavy.holds_if.contains("not met"), "{heavy:#?}");
}

/// A bar on a wall: the contact's own stiffness counts, from as soft as a rigid bar to as hard as the wave.
#[test]
fn a_bar_on_a_wall_stays_as_long_as_its_contact_lets_it() {
    let (length, speed) = (2.0, 0.5);
    for (stiffness, step) in [(2e6, 2e-5), (2e8, 2e-6), (1.5e9, 5e-7)] {
        let mut b = ModelBuilder::new();
        let beam = steel(&mut b, length, 80);
        let shape = ObstacleShape::HalfPlane { point: [-1e-4, 0.0], normal: [1.0, 0.0] };
        let wall = b.obstacle(Obstacle { name: "wall".into(), shape, motion: None });
        let velocity = [-speed, 0.0];
        b.initial_motion(InitialMotion { velocity, ..InitialMotion::default() });
        let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness }));
        b.contact(Contact::new(
            "end",
            [ContactPartner::Beam(beam), ContactPartner::Obstacle(wall)],
            law,
        ));
        let all = compared(&b, &Settings::new(2400.0 * step, step));
        for quantity in ["largest contact force", "time from the first touch", "impulse"] {
            let c = row(&all, "elastic bar on a rigid wall", quantity);
            assert!(!c.holds_if.contains("not met"), "{c:#?}");
            assert!(c.difference_percent.abs() < 4.0, "{stiffness:e}: {c:#?}");
        }
    }
}

/// A contact far stiffer than an element makes a force that is none of the bar; the advisor says so, and what the wave gives.
#[test]
fn a_hard_contact_of_a_bar_is_reported_as_one_of_the_mesh() {
    let mut b = ModelBuilder::new();
    let beam = steel(&mut b, 2.0, 40);
    let shape = ObstacleShape::HalfPlane { point: [-1e-4, 0.0], normal: [1.0, 0.0] };
    let wall = b.obstacle(Obstacle { name: "wall".into(), shape, motion: None });
    b.initial_motion(InitialMotion { velocity: [-1.0, 0.0], ..InitialMotion::default() });
    let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e12 }));
    b.contact(Contact::new(
        "end",
        [ContactPartner::Beam(beam), ContactPartner::Obstacle(wall)],
        law,
    ));
    let (model, settings) = (freeze(&b), Settings::new(2e-3, 4e-6));
    let advice = advise(&model, &settings);
    let rise = advice.iter().find(|a| a.topic == Topic::ForceRise);
    assert!(rise.is_some_and(|a| a.verdict == Verdict::Warning), "{advice:#?}");
    let all = compare(&model, &settings, &run(&model, &settings));
    let force = row(&all, "elastic bar on a rigid wall", "largest contact force");
    let wave = 1.0 * 0.0025 * (2.1e11 * 7850.0_f64).sqrt();
    assert!((force.by_hand / wave - 1.0).abs() < 1e-9, "{force:#?}");
    assert!(force.simulated > 1.5 * wave, "{force:#?}");
}

/// With friction the energy lost is not that of the normal velocity alone: only the impulse is compared.
#[test]
fn energy_lost_is_compared_without_friction_only() {
    let of = |friction: f64| {
        let mut b = ModelBuilder::new();
        let ball = b.disc(disc("ball", 1.0, 0.05, [0.0, 0.06], [0.8, -1.0]));
        let shape = ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] };
        let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
        let law = RigidLaw { friction, ..RigidLaw::frictionless(0.5) };
        let between = [ContactPartner::Disc(ball), ContactPartner::Obstacle(floor)];
        b.contact(Contact::new("blow", between, TouchLaw::Rigid(law)));
        compared(&b, &Settings::new(0.05, 1e-3))
    };
    fits(&of(0.0), 1e-6);
    assert_eq!(of(0.0).len(), 2);
    let rubs = of(0.4);
    assert_eq!(rubs.len(), 1, "{rubs:#?}");
    fits(&rubs, 1e-6);
}

/// A free beam falls as the mass does: gravity does not bring them together.
#[test]
fn a_free_beam_is_reached_by_velocity_alone() {
    let mut b = ModelBuilder::new();
    let beam = steel(&mut b, 2.0, 20);
    gravity(&mut b);
    let kind = ProjectileKind::spring(1e6);
    let mass = Projectile::new("mass", kind, 1.0, [0.0, -1.0], at("mid", beam, 0.5));
    b.projectile(Projectile { standoff: 1.0, ..mass });
    let advice = advise(&freeze(&b), &Settings::new(0.5, 1e-4));
    let touch = advice.iter().find(|a| a.topic == Topic::FirstContact);
    let time = touch.map_or(f64::NAN, |a| a.value);
    assert!((time - 1.0).abs() < 1e-12, "{touch:?}");
    assert_eq!(touch.map(|a| a.verdict), Some(Verdict::Warning));
}

/// A small generator, the same on every machine.
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Between two numbers, evenly in their logarithm.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }
}

/// Masses with and without one behind, under both laws, with and without weight, on spans held in several ways: where all that the
/// bound assumes is met, no force is above it.
#[test]
fn no_force_is_above_its_upper_bound() {
    let mut draws = Draws(20_240_611);
    let mut reported = 0;
    let mut nearest = 0.0_f64;
    for case in 0..40 {
        let mut b = ModelBuilder::new();
        let beam = steel(&mut b, draws.between(0.5, 3.0), 12);
        let kinds = [SupportKind::Pin, SupportKind::Clamp];
        let ends: &[f64] = if case % 5 == 0 { &[0.0] } else { &[0.0, 1.0] };
        hold(&mut b, beam, &kinds[case % 2], if case % 2 == 0 { &[0.0, 1.0] } else { ends });
        let weighs = case % 3 == 0;
        if weighs {
            gravity(&mut b);
        }
        let (mass, speed) = (draws.between(0.1, 50.0), draws.between(0.02, 2.0));
        let potential = match case % 4 {
            3 => Potential::Hertz { stiffness: draws.between(1e8, 1e11) },
            _ => Potential::Linear { stiffness: draws.between(1e4, 1e8) },
        };
        let law = SmoothLaw::elastic(potential);
        let place = 0.2 + 0.7 * draws.next();
        let kind = ProjectileKind::Elastic { law };
        let one = Projectile::new("mass", kind, mass, [0.0, -speed], at("place", beam, place));
        let rear = (case % 2 == 1).then(|| {
            let mass = mass * draws.between(0.1, 30.0);
            RearMass { mass, stiffness: draws.between(1e5, 1e9), damping: 0.0 }
        });
        b.projectile(Projectile { rear, ..one });
        let start = if weighs { Start::Static } else { Start::Reference };
        let settings = Settings { start, ..Settings::new(0.02, 2e-5) };
        for c in compared(&b, &settings).iter().filter(|c| c.formula == "upper bound of the force")
        {
            if c.holds_if.contains("not met") {
                continue;
            }
            reported += 1;
            nearest = nearest.max(c.simulated / c.by_hand);
            assert!(c.simulated <= 1.001 * c.by_hand, "{case}: {c:#?}");
        }
    }
    assert!(reported >= 20, "{reported}");
    assert!(nearest > 0.8, "no case comes near the bound: {nearest}");
}

/// 1 kg with 20 kg behind it: the bound counts both.
#[test]
fn a_mass_behind_counts_in_the_bound() {
    let mut b = ModelBuilder::new();
    let beam = steel(&mut b, 0.4, 12);
    hold(&mut b, beam, &SupportKind::Clamp, &[0.0, 1.0]);
    let kind = ProjectileKind::spring(1e7);
    let one = Projectile::new("mass", kind, 1.0, [0.0, -1.0], at("place", beam, 0.3));
    let rear = Some(RearMass { mass: 20.0, stiffness: 1e8, damping: 0.0 });
    b.projectile(Projectile { rear, ..one });
    let all = compared(&b, &Settings::new(0.02, 1e-5));
    let force = row(&all, "upper bound of the force", "largest contact force");
    let front = (1e7_f64).sqrt();
    assert!((force.by_hand / (21.0_f64.sqrt() * front) - 1.0).abs() < 1e-9, "{force:#?}");
    assert!(force.simulated > front && force.simulated < force.by_hand, "{force:#?}");
}

/// Pinned at one end, on a roller at the other, hanging at rest under its weight; a mass strikes its middle.
fn on_a_hanging_span(kind: ProjectileKind, mass: f64, speed: f64, end: f64) -> Vec<Comparison> {
    let mut b = ModelBuilder::new();
    let beam = steel(&mut b, 2.0, 24);
    hold(&mut b, beam, &SupportKind::Pin, &[0.0]);
    let direction = [1.0, 0.0];
    hold(&mut b, beam, &SupportKind::Roller { direction }, &[1.0]);
    gravity(&mut b);
    b.record_point(at("mid", beam, 0.5));
    b.projectile(Projectile::new("mass", kind, mass, [0.0, -speed], at("mid", beam, 0.5)));
    compared(&b, &Settings { start: Start::Static, ..Settings::new(end, 5e-5) })
}

/// Bending stiffness 48 EI/L^3 of that span, its mass reduced by the static shape (17/35), and its sag in the middle.
fn hanging_span() -> [f64; 3] {
    let (bending, weight) = (2.1e11 * 0.05_f64.powi(4) / 12.0, 7850.0 * 0.0025 * GRAVITY);
    let stiffness = 48.0 * bending / 8.0;
    [stiffness, 17.0 / 35.0 * 7850.0 * 0.0025 * 2.0, 5.0 * weight * 16.0 / (384.0 * bending)]
}

/// Cox by momentum and energy: met while the mass weighs less than two hundredths of its force, not met or left out beyond.
#[test]
fn cox_knows_when_the_mass_is_too_heavy_for_it() {
    let [stiffness, own, sag] = hanging_span();
    for (mass, speed, met) in [(100.0, 7.2, true), (100.0, 2.0, false), (500.0, 1.0, false)] {
        let kind = ProjectileKind::Rigid { restitution: 0.0 };
        let all = on_a_hanging_span(kind, mass, speed, 0.06);
        let all: Vec<_> = all.into_iter().filter(|c| c.formula == "Cox").collect();
        let together: f64 = mass * speed / (mass + own);
        let by_hand = together * ((mass + own) / stiffness).sqrt();
        let share = mass * GRAVITY / (stiffness * by_hand);
        assert_eq!(share < 0.02, met, "{share}");
        for c in all.iter().filter(|c| c.quantity.contains("deflection")) {
            // The speed of approach is that of the run, which gravity changes a little within the first step.
            assert!((c.by_hand / (by_hand + sag) - 1.0).abs() < 1e-4, "{c:#?}");
            let (_, weight) =
                c.holds_if.split_once("weight negligible").expect("what is said of it");
            assert_eq!(!weight.contains("not met"), met, "{c:#?}");
        }
        if met {
            let c = row(&all, "Cox", "deflection");
            assert!(c.difference_percent.abs() < 2.0, "{c:#?}");
        }
    }
}

/// Two masses and two springs under a weight: met and near while it is small against the force, else not met.
#[test]
fn two_masses_know_when_their_weight_counts() {
    for (speed, met) in [(8.0, true), (2.0, false)] {
        let all = on_a_hanging_span(ProjectileKind::spring(1e6), 100.0, speed, 0.12);
        let c = row(&all, "two-degree-of-freedom model", "largest contact force");
        assert_eq!(!c.holds_if.contains("not met"), met, "{c:#?}");
        if met {
            assert!(c.difference_percent.abs() < 3.0, "{c:#?}");
        }
    }
}

/// A heavy mass comes back and bends the span more the second time: that is no case of a formula of one contact.
#[test]
fn the_largest_deflection_of_a_later_contact_is_not_met() {
    let all = on_a_hanging_span(ProjectileKind::spring(1e6), 200.0, 0.2, 1.0);
    for formula in ["two-degree-of-freedom model", "impact factor, heavy span"] {
        let c = row(&all, formula, "deflection");
        assert!(c.difference_percent.abs() < 4.0 || c.holds_if.contains("not met"), "{c:#?}");
    }
}

/// A bar that turns meets a wall with one corner, and that is no case of the whole section.
#[test]
fn a_bar_that_turns_does_not_meet_the_wall_with_its_whole_section() {
    for (spin, met) in [(0.0, true), (5.0, false)] {
        let mut b = ModelBuilder::new();
        let beam = steel(&mut b, 1.0, 20);
        let about = [0.5, 0.0];
        b.initial_motion(InitialMotion { velocity: [-1.0, 0.0], spin, about });
        let shape = ObstacleShape::HalfPlane { point: [-1e-3, 0.0], normal: [1.0, 0.0] };
        let wall = b.obstacle(Obstacle { name: "wall".into(), shape, motion: None });
        let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e6 }));
        b.contact(Contact::new(
            "wall",
            [ContactPartner::Beam(beam), ContactPartner::Obstacle(wall)],
            law,
        ));
        let all = compared(&b, &Settings::new(0.02, 1e-5));
        let force = row(&all, "elastic bar on a rigid wall", "force");
        assert_eq!(!force.holds_if.contains("not met"), met, "{force:#?}");
        fits(&all, 1.0);
    }
}
