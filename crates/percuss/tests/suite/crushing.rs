//! Contacts that crush: closed forms of a mass on a floor, balances of beams that are struck, equilibria, refusals.

use crate::common;

use common::*;
use percuss::*;

/// Loaded along `stiffness`, released along `unloading` \[N/m\].
fn crushing(stiffness: f64, unloading: f64) -> SmoothLaw {
    let potential = Potential::Linear { stiffness };
    SmoothLaw { unloading: Some(unloading), ..SmoothLaw::elastic(potential) }
}

/// It crushes at 2 kN over 30 mm, and locks.
fn crash_box() -> SmoothLaw {
    let potential = Potential::Table {
        penetration: vec![0.0, 0.4e-3, 30e-3, 32e-3],
        force: vec![0.0, 2e3, 2e3, 60e3],
    };
    SmoothLaw { unloading: Some(4e7), ..SmoothLaw::elastic(potential) }
}

const MASS: f64 = 2.0;
const RADIUS: f64 = 0.05;
const SPEED: f64 = 3.0;

/// A disc that falls on a floor with the given law, by gravity alone if there is any.
fn on_floor(law: SmoothLaw, gravity: f64) -> ModelBuilder {
    let speed = if gravity > 0.0 { 0.0 } else { SPEED };
    thrown_on_floor(law, gravity, disc("ball", MASS, RADIUS, [0.0, 0.051], [0.0, -speed])).0
}

fn thrown_on_floor(law: SmoothLaw, gravity: f64, ball: Disc) -> (ModelBuilder, DiscId) {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let far = b.beam(beam("far", [5.0, 0.0], [6.0, 0.0], 2, material, section));
    b.support(Support::new("far", at("far", far, 0.0), SupportKind::Clamp));
    let disc = b.disc(ball);
    let shape = ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] };
    let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
    let between = [ContactPartner::Disc(disc), ContactPartner::Obstacle(floor)];
    b.contact(Contact::new("ball-floor", between, TouchLaw::Smooth(law)));
    if gravity > 0.0 {
        b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -gravity] }));
    }
    (b, disc)
}

fn run(model: &Model, settings: &Settings) -> RunSummary {
    let summary = simulate(model, settings, &mut NoRecorder).unwrap();
    assert!(matches!(summary.termination, Termination::Completed), "{summary:?}");
    assert!(summary.energy.residual_max < 1e-12, "{:e}", summary.energy.residual_max);
    assert!(summary.momentum.linear_residual_max < 1e-12);
    summary
}

fn first(summary: &RunSummary) -> (&Peak, &ContactInterval) {
    match &summary.contacts[0].record {
        ContactRecord::Smooth { peak_force, intervals } => (peak_force, &intervals[0]),
        ContactRecord::Nonsmooth { .. } => panic!("a smooth contact"),
    }
}

#[test]
fn a_mass_on_a_floor_comes_back_as_the_two_stiffnesses_tell() {
    let (loading, unloading) = (1e6, 4e6);
    let model = on_floor(crushing(loading, unloading), 0.0).build().unwrap();
    let summary = run(&model, &Settings::new(5e-3, 2e-6));
    let deepest = SPEED * (MASS / loading).sqrt();
    let (peak, interval) = first(&summary);
    let near = |found: f64, exact: f64, share: f64, what: &str| {
        assert!((found / exact - 1.0).abs() < share, "{what}: {found}, {exact} expected");
    };
    // The step is a seventieth of the shorter quarter of a period: its error is of second order.
    near(peak.value, loading * deepest, 1e-5, "peak force");
    let permanent = summary.contacts[0].permanent_penetration.unwrap();
    near(permanent, deepest * (1.0 - loading / unloading), 1e-5, "permanent penetration");
    let restitution = (loading / unloading).sqrt();
    near(summary.projectiles[0].velocity_final[1], SPEED * restitution, 1e-5, "velocity after");
    near(interval.separation_velocity, SPEED * restitution, 1e-4, "separation");
    let energy = 0.5 * MASS * SPEED * SPEED;
    near(interval.energy.lost, energy * (1.0 - restitution * restitution), 1e-5, "lost");
    near(summary.energy.loss_damping, interval.energy.lost, 1e-12, "lost of the balance");
    // A quarter of a period on each line: contact ends with zero force, not with an open gap.
    let quarter = |k: f64| 0.5 * std::f64::consts::PI * (MASS / k).sqrt();
    near(interval.end - interval.start, quarter(loading) + quarter(unloading), 1e-4, "duration");
}

#[test]
fn a_beam_struck_again_and_again_closes_its_balance() {
    for law in [crushing(7.5e5, 3e6), crash_box(), SmoothLaw { dissipation: 0.05, ..crash_box() }] {
        for step in [1e-4, 1e-3] {
            let mut b = ModelBuilder::new();
            let (material, section) = plank(&mut b);
            let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
            for (name, f) in [("left", 0.0), ("right", 1.0)] {
                b.support(Support::new(name, at(name, girder, f), SupportKind::Clamp));
            }
            let mut one = elastic("mass", at("mid", girder, 0.5), [0.0, 20.0]);
            one.kind = ProjectileKind::Elastic { law: law.clone() };
            let mut other = elastic("late", at("third", girder, 0.3), [0.0, -5.0]);
            other.kind = ProjectileKind::Elastic { law: law.clone() };
            b.projectile(one);
            b.projectile(other);
            let summary = run(&b.build().unwrap(), &Settings::new(0.2, step));
            for (contact, intervals) in summary.contacts.iter().map(|c| (c, c.record.intervals())) {
                assert!(contact.permanent_penetration.unwrap() > 0.0);
                assert!(intervals.iter().all(|i| i.energy.lost >= 0.0), "{contact:?}");
            }
            let lost: f64 = summary
                .contacts
                .iter()
                .flat_map(|c| c.record.intervals())
                .map(|i| i.energy.lost)
                .sum();
            assert!((lost / summary.energy.loss_damping - 1.0).abs() < 1e-9, "{lost}");
        }
    }
}

#[test]
fn a_resting_weight_has_crushed_the_contact_to_its_static_depth() {
    let (loading, unloading, gravity) = (1e5, 9e5, 9.81);
    let model = on_floor(crushing(loading, unloading), gravity).build().unwrap();
    let found = equilibrium(&model).unwrap();
    let deep = MASS * gravity / loading;
    assert!((-found.contacts[0].gap / deep - 1.0).abs() < 1e-9, "{:?}", found.contacts);
    assert!((found.state.pairs[0].deepest / deep - 1.0).abs() < 1e-9);
    // Started at rest there without loads it remains; no further crushing.
    let settings = Settings { start: Start::Static, ..Settings::new(0.1, 1e-4) };
    let summary = simulate(&model, &settings, &mut NoRecorder).unwrap();
    let permanent = summary.contacts[0].permanent_penetration.unwrap();
    assert!((permanent / (deep * (1.0 - loading / unloading)) - 1.0).abs() < 1e-6, "{permanent}");
}

/// A cantilever whose end leans on a prop: small motions follow the line of unloading, which its own weight has reached.
#[test]
fn small_motions_about_rest_know_the_stiffness_of_unloading() {
    let (loading, unloading) = (2e4, 2e5);
    let lowest = |law: SmoothLaw| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, 7850.0));
        let section = b.section(Section::rectangle("bar", 0.02, 0.02));
        let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 8, material, section));
        b.support(Support::new("root", at("root", bar, 0.0), SupportKind::Clamp));
        let shape = ObstacleShape::Disc { centre: [0.95, -0.06], radius: 0.05 };
        let prop = b.obstacle(Obstacle { name: "prop".into(), shape, motion: None });
        let between = [ContactPartner::Beam(bar), ContactPartner::Obstacle(prop)];
        b.contact(Contact::new("bar-prop", between, TouchLaw::Smooth(law)));
        b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
        let model = b.build().unwrap();
        let found = equilibrium(&model).unwrap();
        assert!(found.contacts[0].force > 1.0, "{:?}", found.contacts);
        modes_about_equilibrium(&model, &found, 1)[0].frequency()
    };
    let elastic = |stiffness| lowest(SmoothLaw::elastic(Potential::Linear { stiffness }));
    let [soft, stiff] = [loading, unloading].map(elastic);
    let found = lowest(crushing(loading, unloading));
    assert!(stiff > 1.2 * soft, "{soft} {stiff}");
    // The bar lies a fraction of a millimetre deeper than on the stiff prop.
    assert!((found / stiff - 1.0).abs() < 1e-3, "{found} {stiff}");
}

#[test]
fn laws_that_would_give_energy_are_refused() {
    let path = |law: SmoothLaw| {
        let faults = on_floor(law, 0.0).build().unwrap_err();
        faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
    };
    let steep = path(crushing(2e6, 1e6));
    assert!(steep.contains("unloading_stiffness") && steep.contains("2000000 N/m"), "{steep}");
    let hertz = SmoothLaw { potential: Potential::Hertz { stiffness: 1e8 }, ..crushing(1e6, 1e7) };
    assert!(path(hertz).contains("unloading_stiffness"));
    let midpoint = SmoothLaw { force: ContactForce::Midpoint, ..crushing(1e6, 1e7) };
    assert!(path(midpoint).contains("force"));
    let model = on_floor(crushing(1e6, 4e6), 0.0).build().unwrap();
    let settings = Settings { scheme: Scheme::Newmark, ..Settings::new(1e-3, 1e-5) };
    let faults = simulate(&model, &settings, &mut NoRecorder).unwrap_err();
    assert!(faults[0].to_string().contains("crushes"), "{faults:?}");
}

/// Loading and unloading [N/m]: half the speed comes back.
const STIFFNESSES: [f64; 2] = [1e6, 4e6];

/// A disc that moves between a floor and a ceiling, both with crushing, tangentially with the given velocity.
fn between_planes(along: f64) -> RunSummary {
    let law = crushing(STIFFNESSES[0], STIFFNESSES[1]);
    let ball = disc("ball", MASS, RADIUS, [0.0, 0.051], [along, -SPEED]);
    let (mut b, ball) = thrown_on_floor(law.clone(), 0.0, ball);
    let shape = ObstacleShape::HalfPlane { point: [0.0, 0.2], normal: [0.0, -1.0] };
    let ceiling = b.obstacle(Obstacle { name: "ceiling".into(), shape, motion: None });
    let between = [ContactPartner::Disc(ball), ContactPartner::Obstacle(ceiling)];
    b.contact(Contact::new("ball-ceiling", between, TouchLaw::Smooth(law)));
    run(&b.build().unwrap(), &Settings::new(0.3, 2e-5))
}

#[test]
fn dents_are_found_again_where_they_were_made_only() {
    let [loading, unloading] = STIFFNESSES;
    let near = |found: f64, exact: f64, what: &str| {
        assert!((found / exact - 1.0).abs() < 1e-3, "{what}: {found}, {exact} expected");
    };
    // Half the speed is left after the floor, a quarter after the ceiling; its dents are 22 mm wide to either side, or less.
    let speed = 0.25 * SPEED;
    let elsewhere = between_planes(1.0);
    let [first, second] = [0, 1].map(|k| elsewhere.contacts[0].record.intervals()[k]);
    assert!(second.place.position[0] - first.place.position[0] > 0.03);
    near(second.peak_force.value, speed * (MASS * loading).sqrt(), "a whole floor");
    near(second.separation_velocity, 0.5 * speed, "a whole floor");
    // The deepest indentation is reported, at any place.
    let deepest = SPEED * (MASS / loading).sqrt();
    let left = elsewhere.contacts[0].permanent_penetration.unwrap();
    near(left, deepest * (1.0 - loading / unloading), "the first dent");
    let back = between_planes(0.0);
    let second = back.contacts[0].record.intervals()[1];
    near(second.peak_force.value, speed * (MASS * unloading).sqrt(), "its dent");
    near(second.separation_velocity, speed, "its dent");
    assert!([elsewhere, back].iter().all(|run| run.contacts[0].carried_crush.is_none()));
}

/// The same on a beam that hardly gives way.
#[test]
fn dents_belong_to_places_of_a_beam() {
    let peaks = [0.0, 1.5].map(|along| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("hard", 2.1e14, 7.85e6));
        let section = b.section(Section::rectangle("block", 0.5, 0.5));
        let girder = b.beam(beam("girder", [0.0, 0.0], [1.0, 0.0], 8, material, section));
        for k in 0..=8 {
            let name = format!("s{k}");
            let point = at(&name, girder, f64::from(k) / 8.0);
            b.support(Support::new(&name, point, SupportKind::Clamp));
        }
        let ball = b.disc(disc("ball", MASS, RADIUS, [0.3, 0.301], [along, -SPEED]));
        let shape = ObstacleShape::HalfPlane { point: [0.0, 0.45], normal: [0.0, -1.0] };
        let ceiling = b.obstacle(Obstacle { name: "ceiling".into(), shape, motion: None });
        let disc = ContactPartner::Disc(ball);
        let law = || TouchLaw::Smooth(crushing(STIFFNESSES[0], STIFFNESSES[1]));
        b.contact(Contact::new("ball-girder", [disc, ContactPartner::Beam(girder)], law()));
        let bounce = TouchLaw::Rigid(RigidLaw::frictionless(1.0));
        b.contact(Contact::new("top", [disc, ContactPartner::Obstacle(ceiling)], bounce));
        let summary = run(&b.build().unwrap(), &Settings::new(0.2, 1e-5));
        summary.contacts[0].record.intervals()[1].peak_force.value
    });
    let speed = 0.5 * SPEED;
    for (peak, stiffness) in peaks.into_iter().zip([STIFFNESSES[1], STIFFNESSES[0]]) {
        let exact = speed * (MASS * stiffness).sqrt();
        assert!((peak / exact - 1.0).abs() < 5e-3, "{peak}, {exact} expected");
    }
}

/// Released on the floor its penetration is twice the static one, and it slides on from there: the indentation of the floor exists only at its
/// initial place.
#[test]
fn a_sliding_contact_carries_its_dent_along() {
    let (loading, unloading, gravity) = (1e5, 9e5, 9.81);
    let carried = [0.0, 1.0].map(|along| {
        let ball = disc("ball", MASS, RADIUS, [0.0, RADIUS], [along, 0.0]);
        let (b, _) = thrown_on_floor(crushing(loading, unloading), gravity, ball);
        let summary = run(&b.build().unwrap(), &Settings::new(0.2, 1e-5));
        summary.contacts[0].carried_crush
    });
    assert_eq!(carried[0], None);
    let found = carried[1].unwrap();
    // Beyond half the chord of a dent by 2 w/K = 0.39 mm; from r(m) = (16/9) w/K to r(p) for a p between r(m) and m.
    let rest = MASS * gravity / loading;
    let half_width = (2.0 * rest * 2.0 * RADIUS).sqrt();
    assert!(found.distance > half_width && found.distance < 0.2, "{found:?}");
    assert!(found.depth > 0.05 * rest && found.depth < 0.2 * rest, "{found:?}");
}
