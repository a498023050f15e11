//! Springs that end at projectiles and discs: pendulums, sprung masses that start in balance, bodies that spring tie to each other.

use crate::common;

use common::*;
use percuss::*;

const GRAVITY: f64 = 9.81;

fn spring(name: &str, between: [Anchor; 2], law: SpringLaw) -> Spring {
    let name = name.into();
    Spring { name, between, law, damping: 0.0, length: None, strength: None, yielding: None }
}

fn at_body(name: &str) -> Anchor {
    Anchor::Projectile(name.into())
}

fn weigh(b: &mut ModelBuilder) {
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -GRAVITY] }));
}

/// Runs; the balances close.
fn run(model: &Model, settings: &Settings) -> (RunSummary, MemoryRecorder) {
    let mut rows = MemoryRecorder::default();
    let summary = simulate(model, settings, &mut rows).unwrap_or_else(|e| panic!("{e:?}"));
    assert!(matches!(summary.termination, Termination::Completed), "{summary:?}");
    assert!(summary.energy.residual_max < 1e-10, "{:e}", summary.energy.residual_max);
    assert!(summary.momentum.linear_residual_max < 1e-10, "{:?}", summary.momentum);
    assert!(summary.momentum.angular_residual_max < 1e-10, "{:?}", summary.momentum);
    (summary, rows)
}

/// Times at which a column passes through a value, between rows by straight lines.
fn crossings(rows: &MemoryRecorder, name: &str, value: f64) -> Vec<f64> {
    let (time, x) = (rows.column("time").unwrap(), rows.column(name).unwrap());
    let at = |k: usize| x[k] - value;
    let crosses = |k: &usize| at(*k) * at(k + 1) < 0.0;
    let cross = |k: usize| time[k] + (time[k + 1] - time[k]) * at(k) / (at(k) - at(k + 1));
    (0..x.len() - 1).filter(crosses).map(cross).collect()
}

/// `T = 2 pi sqrt(L / g) (1 + theta^2 / 16 + 11 theta^4 / 3072)` of a pendulum on a rope that hardly gives.
#[test]
fn a_ball_on_a_rope_swings_with_the_period_of_a_pendulum() {
    let (length, angle) = (1.0, 0.3_f64);
    let mut b = ModelBuilder::new();
    let place = [length * angle.sin(), -length * angle.cos()];
    b.disc(disc("ball", 2.0, 0.05, place, [0.0; 2]));
    let rope = SpringLaw::Tension { stiffness: 1e7, slack: 0.0 };
    b.spring(spring("rope", [at_body("ball"), Anchor::Ground([0.0; 2])], rope));
    weigh(&mut b);
    let model = b.build().unwrap();
    let (_, rows) = run(&model, &Settings::new(5.0, 5e-4));
    let passes = crossings(&rows, "projectile.ball.position_1", 0.0);
    let period = std::f64::consts::TAU
        * (length / GRAVITY).sqrt()
        * (1.0 + angle.powi(2) / 16.0 + 11.0 * angle.powi(4) / 3072.0);
    assert!(passes.len() >= 4, "{passes:?}");
    for (k, pass) in passes.iter().enumerate() {
        let expected = (0.25 + 0.5 * k as f64) * period;
        assert!((pass / expected - 1.0).abs() < 2e-4, "{pass} {expected}");
    }
    let [x, y] = [1, 2].map(|i| rows.column(&format!("projectile.ball.position_{i}")).unwrap());
    let apart = |k: usize| (x[k].hypot(y[k]) - length).abs();
    assert!((0..x.len()).all(|k| apart(k) < 2e-5));
}

/// Two discs in free space on a spring: the period of their reduced mass, the amplitude `v / omega`.
#[test]
fn two_discs_on_a_spring_swing_against_each_other() {
    let (masses, stiffness, speed) = ([2.0, 3.0], 4e3, 0.5);
    let mut b = ModelBuilder::new();
    b.disc(disc("left", masses[0], 0.05, [0.0, 1.0], [0.0, 0.0]));
    b.disc(disc("right", masses[1], 0.05, [1.0, 1.0], [speed, 0.0]));
    let law = SpringLaw::Linear { stiffness };
    b.spring(spring("own", [at_body("left"), at_body("right")], law));
    let model = b.build().unwrap();
    let (_, rows) = run(&model, &Settings::new(0.5, 1e-4));
    let omega = (stiffness * (1.0 / masses[0] + 1.0 / masses[1])).sqrt();
    let [time, left, right] = ["time", "projectile.left.position_1", "projectile.right.position_1"]
        .map(|name| rows.column(name).unwrap().to_vec());
    for k in 0..time.len() {
        let stretched = right[k] - left[k] - 1.0;
        let expected = speed / omega * (omega * time[k]).sin();
        assert!((stretched - expected).abs() < 1e-5, "{}: {stretched} {expected}", time[k]);
    }
}

/// Span \[m\], bending stiffness \[N m^2\] and weight \[N/m\] of the bridge.
const SPAN: f64 = 4.0;
const BENDING: f64 = 2.1e11 * 1e-4 / 12.0;
const WEIGHT: f64 = 7850.0 * 0.01 * GRAVITY;

/// A beam of a square section of 0.1 m on two supports, with its middle.
fn bridge(b: &mut ModelBuilder) -> PointRef {
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(Section::new("square", 0.01, 1e-4 / 12.0));
    let bridge = b.beam(beam("bridge", [0.0, 0.0], [SPAN, 0.0], 8, material, section));
    let roller = SupportKind::Roller { direction: [1.0, 0.0] };
    b.support(Support::new("left", at("left", bridge, 0.0), SupportKind::Pin));
    b.support(Support::new("right", at("right", bridge, 1.0), roller));
    let middle = at("middle", bridge, 0.5);
    b.record_point(middle.clone());
    weigh(b);
    middle
}

/// Deflection of its middle under its weight and a force there \[m\].
fn sag(force: f64) -> f64 {
    5.0 * WEIGHT * SPAN.powi(4) / (384.0 * BENDING) + force * SPAN.powi(3) / (48.0 * BENDING)
}

/// A body of a mass on a spring starts in balance, and stays there.
fn stays(model: &Model, name: &str, (mass, stiffness, height): (f64, f64, f64)) {
    let settings = Settings { start: Start::Static, ..Settings::new(0.3, 5e-4) };
    let (_, rows) = run(model, &settings);
    let column = |name: &str| rows.column(name).unwrap().to_vec();
    let middle = column("point.middle.displacement_2");
    let body = column(&format!("projectile.{name}.position_2"));
    let deep = sag(mass * GRAVITY);
    assert!((middle[0] / -deep - 1.0).abs() < 1e-3, "{} {deep}", middle[0]);
    // The spring gives by m g / k.
    let lies = height - deep - mass * GRAVITY / stiffness;
    assert!((body[0] - lies).abs() < 1e-3 * deep, "{} {lies}", body[0]);
    for k in 0..middle.len() {
        assert!((middle[k] - middle[0]).abs() < 1e-8, "row {k}: {:e}", middle[k] - middle[0]);
        assert!((body[k] - body[0]).abs() < 1e-8, "row {k}: {:e}", body[k] - body[0]);
    }
}

#[test]
fn a_mass_that_hangs_on_a_spring_below_a_beam_starts_in_balance() {
    for law in
        [SpringLaw::Linear { stiffness: 1e5 }, SpringLaw::Tension { stiffness: 1e5, slack: 0.0 }]
    {
        let mut b = ModelBuilder::new();
        let middle = bridge(&mut b);
        b.disc(disc("ball", 100.0, 0.1, [0.5 * SPAN, -0.5], [0.0; 2]));
        b.spring(spring("rope", [Anchor::Point(middle), at_body("ball")], law));
        stays(&b.build().unwrap(), "ball", (100.0, 1e5, -0.5));
    }
}

/// A vehicle: a guided projectile above the bridge, on a spring and a damper.
#[test]
fn a_vehicle_on_its_suspension_starts_in_balance() {
    let mut b = ModelBuilder::new();
    let middle = bridge(&mut b);
    let kind = ProjectileKind::spring(1e6);
    let car = Projectile::new("car", kind, 100.0, [0.0; 2], middle.clone());
    b.projectile(Projectile { direction: Some([0.0, -1.0]), standoff: 0.6, ..car });
    let law = SpringLaw::Linear { stiffness: 1e5 };
    let own = spring("suspension", [at_body("car"), Anchor::Point(middle)], law);
    b.spring(Spring { damping: 500.0, ..own });
    stays(&b.build().unwrap(), "car", (100.0, 1e5, 0.6));
}

/// A ball that is thrown stands still in statics: the spring acts as one to the ground does.
#[test]
fn a_moving_ball_holds_its_spring_at_the_start() {
    let sag = |end: &dyn Fn(&mut ModelBuilder) -> Anchor| {
        let mut b = ModelBuilder::new();
        let middle = bridge(&mut b);
        let own = end(&mut b);
        let law = SpringLaw::Linear { stiffness: 1e5 };
        let own = spring("rope", [Anchor::Point(middle), own], law);
        b.spring(Spring { length: Some(0.49), ..own });
        let found = equilibrium(&b.build().unwrap()).unwrap();
        (found.state.displacement, found.balance)
    };
    let place = [0.5 * SPAN, -0.5];
    let (tied, balance) = sag(&|b| {
        b.disc(disc("ball", 100.0, 0.1, place, [1.0, 0.0]));
        at_body("ball")
    });
    let (held, same) = sag(&|_| Anchor::Ground(place));
    for (a, b) in tied.iter().zip(&held) {
        assert!((0..4).all(|k| (a[k] - b[k]).abs() < 1e-12), "{a:?} {b:?}");
    }
    assert!(tied[held.len()].iter().all(|x| x.abs() < 1e-20), "{:?}", tied[held.len()]);
    for (a, b) in balance.springs.iter().zip(same.springs) {
        assert!((a - b).abs() < 1e-6, "{balance:?} {same:?}");
    }
}

/// A disc on a tether strikes a beam, with a compliant and with a rigid contact.
#[test]
fn a_tethered_disc_strikes_a_beam() {
    let rigid = RigidLaw { friction: 0.3, ..RigidLaw::frictionless(0.5) };
    let soft = SmoothLaw::elastic(Potential::Linear { stiffness: 1e6 });
    for law in [TouchLaw::Smooth(soft), TouchLaw::Rigid(rigid)] {
        let mut b = ModelBuilder::new();
        let middle = bridge(&mut b);
        let ball = b.disc(disc("ball", 5.0, 0.05, [0.45 * SPAN, 0.2], [1.0, -2.0]));
        let partners = [ContactPartner::Disc(ball), ContactPartner::Beam(middle.beam)];
        b.contact(Contact::new("blow", partners, law));
        let rope = SpringLaw::Tension { stiffness: 2e4, slack: 0.1 };
        b.spring(spring("rope", [at_body("ball"), Anchor::Ground([0.5 * SPAN, 1.0])], rope));
        let linear = SpringLaw::Linear { stiffness: 500.0 };
        b.spring(spring("tie", [Anchor::Point(middle), at_body("ball")], linear));
        run(&b.build().unwrap(), &Settings::new(0.3, 1e-4));
    }
}

#[test]
fn springs_end_at_projectiles_that_are_there_and_of_one_mass() {
    let build = |name: &str, rear: Option<RearMass>| {
        let mut b = ModelBuilder::new();
        let middle = bridge(&mut b);
        let kind = ProjectileKind::spring(1e6);
        let car = Projectile::new("car", kind, 100.0, [0.0, -1.0], middle.clone());
        b.projectile(Projectile { standoff: 0.6, rear, ..car });
        let law = SpringLaw::Linear { stiffness: 1e5 };
        b.spring(spring("own", [at_body(name), Anchor::Point(middle)], law));
        b.build()
    };
    let fault = |name: &str, rear: Option<RearMass>| {
        let faults = build(name, rear).unwrap_err();
        assert_eq!(faults.len(), 1, "{faults:?}");
        format!("{}: {}", faults[0].path, faults[0].found)
    };
    assert_eq!(fault("bus", None), "spring.own.between: the unknown projectile \"bus\"");
    let rear = RearMass { mass: 1.0, stiffness: 1.0, damping: 0.0 };
    assert_eq!(
        fault("car", Some(rear)),
        "spring.own.between: the projectile \"car\", which has a rear mass"
    );
    // Schemes that carry accelerations would have to begin with the spring's.
    let model = build("car", None).unwrap();
    let settings = Settings { scheme: Scheme::Newmark, ..Settings::new(0.1, 1e-3) };
    let faults = simulate(&model, &settings, &mut NoRecorder).unwrap_err();
    assert_eq!(faults[0].path, "integrator.scheme");
}
