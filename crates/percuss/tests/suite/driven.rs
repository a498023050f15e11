//! Prescribed motions: held velocities, reactions and impulses follow the motion itself.

use crate::common;

use common::{at, rows::Rows};
use percuss::*;

/// A stocky cantilever of one element, length 1 m, EI = 1 N m^2, rhoA = 1 kg/m, rhoI = 0.01 kg m, its clamp moved across by
/// so little that everything is linear.
const ROTARY: f64 = 0.01;
const MOVED: f64 = 1e-6;

fn driven_cantilever(function: &TimeFunction, until: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 100.0, 1.0));
    let section = b.section(Section::new("s", 1.0, ROTARY));
    let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [1.0, 0.0]], 1, material, section));
    let mut root = Support::new("root", at("root", beam, 0.0), SupportKind::Clamp);
    root.motion =
        Some(Motion { displacement: [0.0, MOVED], rotation: 0.0, function: function.clone() });
    root.until = until;
    b.support(root);
    b.record_point(at("root", beam, 0.0));
    b.record_point(at("tip", beam, 1.0));
    b.build().unwrap()
}

/// The same as a linear system of two degrees of freedom (deflection and slope of the tip), integrated by Runge-Kutta in the coordinate
/// `z = x + Mff^-1 Mfh u`, in which jumps of the clamp's velocity are no impulses: mean reactions over steps of size `h`.
fn reference(course: &dyn Fn(f64) -> [f64; 2], h: f64, steps: usize) -> Vec<f64> {
    // Consistent mass (Hermite), rotary inertia and stiffness of a unit element: order (u_a, u_b, u_b').
    let m = |r: [f64; 3], s: [f64; 3]| [0, 1, 2].map(|i| r[i] / 420.0 + ROTARY * s[i] / 30.0);
    let mass = [
        m([156.0, 54.0, -13.0], [36.0, -36.0, 3.0]),
        m([54.0, 156.0, -22.0], [-36.0, 36.0, -3.0]),
        m([-13.0, -22.0, 4.0], [3.0, -3.0, 4.0]),
    ];
    let stiff = [[12.0, -12.0, 6.0], [-12.0, 12.0, -6.0], [6.0, -6.0, 4.0]];
    let solve = |f: [f64; 2]| {
        let [[a, b], [c, d]] = [[mass[1][1], mass[1][2]], [mass[2][1], mass[2][2]]];
        let det = a * d - b * c;
        [(d * f[0] - b * f[1]) / det, (a * f[1] - c * f[0]) / det]
    };
    let p = solve([mass[1][0], mass[2][0]]);
    let free = |z: [f64; 2], u: f64| [z[0] - p[0] * u, z[1] - p[1] * u];
    let force = |x: [f64; 2], u: f64| {
        [1, 2].map(|i| -(stiff[i][0] * u + stiff[i][1] * x[0] + stiff[i][2] * x[1]))
    };
    let acceleration = |z: [f64; 2], t: f64| {
        let u = MOVED * course(t)[0];
        solve(force(free(z, u), u))
    };
    let reaction = |z: [f64; 2], t: f64| {
        let [u, a] = course(t).map(|c| MOVED * c);
        let x = free(z, u);
        let zz = acceleration(z, t);
        let [x1, x2] = [zz[0] - p[0] * a, zz[1] - p[1] * a];
        let inertia = mass[0][0] * a + mass[0][1] * x1 + mass[0][2] * x2;
        inertia + stiff[0][0] * u + stiff[0][1] * x[0] + stiff[0][2] * x[1]
    };
    let parts = 20;
    let k = h / parts as f64;
    let (mut z, mut v, mut t) = ([0.0; 2], [0.0; 2], 0.0);
    let plus = |x: [f64; 2], f: f64, y: [f64; 2]| [x[0] + f * y[0], x[1] + f * y[1]];
    let mut means = Vec::new();
    for _ in 0..steps {
        let mut sum = 0.0;
        for _ in 0..parts {
            // Inside the smooth pieces on both sides of a part's ends.
            let inside = |t: f64, s: f64| t + s * 1e-9 * k;
            sum += 0.5 * reaction(z, inside(t, 1.0));
            let (k1, l1) = (v, acceleration(z, inside(t, 1.0)));
            let (k2, l2) = (plus(v, 0.5 * k, l1), acceleration(plus(z, 0.5 * k, k1), t + 0.5 * k));
            let (k3, l3) = (plus(v, 0.5 * k, l2), acceleration(plus(z, 0.5 * k, k2), t + 0.5 * k));
            let (k4, l4) = (plus(v, k, l3), acceleration(plus(z, k, k3), inside(t + k, -1.0)));
            for i in 0..2 {
                z[i] += k / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
                v[i] += k / 6.0 * (l1[i] + 2.0 * l2[i] + 2.0 * l3[i] + l4[i]);
            }
            t += k;
            sum += 0.5 * reaction(z, inside(t, -1.0));
        }
        means.push(sum / parts as f64);
    }
    means
}

const PI: f64 = std::f64::consts::PI;

type Course = Box<dyn Fn(f64) -> [f64; 2]>;

/// Motions whose velocity jumps: value and second derivative.
fn courses() -> Vec<(TimeFunction, Course)> {
    let (rise, half, rate) = (0.25, 0.3, 2.0 * PI * 3.0);
    vec![
        (
            TimeFunction::Ramp { duration: rise },
            Box::new(move |t| [(t / rise).clamp(0.0, 1.0), 0.0]),
        ),
        (
            TimeFunction::HalfSine { duration: half },
            Box::new(move |t| {
                let w = PI / half;
                if (0.0..half).contains(&t) {
                    [(w * t).sin(), -w * w * (w * t).sin()]
                } else {
                    [0.0; 2]
                }
            }),
        ),
        (
            TimeFunction::Harmonic { frequency: 3.0, phase: 0.0 },
            Box::new(move |t| [(rate * t).sin(), -rate * rate * (rate * t).sin()]),
        ),
        (
            TimeFunction::Harmonic { frequency: 3.0, phase: 0.6 },
            Box::new(move |t| {
                let (s, s0) = ((rate * t + 0.6).sin(), 0.6_f64.sin());
                [s - s0, -rate * rate * s]
            }),
        ),
    ]
}

/// Largest error of the mean reaction, relative to the largest reaction; in steps that begin at a jump within the run, and in all others.
fn error_of_reactions(model: &Model, course: &Course, scheme: Scheme, steps: usize) -> [f64; 2] {
    let end = 0.5;
    let h = end / steps as f64;
    let settings = Settings { scheme, ..Settings::new(end, h) };
    let (rows, _) = Rows::of(model, &settings);
    let found = rows.column("support.root.force_2");
    let expected = reference(&|t| course(t), h, steps);
    let size = expected.iter().fold(0.0, |m: f64, r| m.max(r.abs()));
    // A ramp ends in the middle, a half sine at three fifths.
    let after_jump = |k: usize| 2 * k == steps || 5 * k == 3 * steps;
    let mut most = [0.0_f64; 2];
    for (k, (f, e)) in found[1..].iter().zip(&expected).enumerate() {
        let own = &mut most[usize::from(!after_jump(k))];
        *own = own.max((f - e).abs() / size);
    }
    most
}

/// Reactions of driven supports converge at second order in the step, whatever the motion, under every scheme. Multipliers at the
/// start of a run are unknown to schemes that balance forces at the end of a step, so supports for a time are left to the others.
#[test]
fn reactions_of_driven_supports_converge_at_second_order() {
    let by_midpoint = [Scheme::EnergyMomentum, Scheme::StrainRate, Scheme::Midpoint];
    let by_ends = [Scheme::Newmark, Scheme::GeneralizedAlpha { spectral_radius: 0.8 }];
    let all: Vec<(Scheme, f64)> = by_midpoint
        .iter()
        .flat_map(|s| [(*s, f64::INFINITY), (*s, 10.0)])
        .chain(by_ends.iter().map(|s| (*s, f64::INFINITY)))
        .collect();
    for (function, course) in courses() {
        for (scheme, until) in &all {
            let model = driven_cantilever(&function, *until);
            let [coarse, fine] =
                [500, 1000].map(|n| error_of_reactions(&model, &course, *scheme, n));
            let reported = format!("{function:?} {scheme:?} {until}: {coarse:?} {fine:?}");
            // A ratio of four, less the terms of third order at these steps.
            assert!(coarse[1] / fine[1] > 3.5 && fine[1] < 1e-3, "{reported}");
            // Generalized-alpha carries accelerations of a little before the jump: the one step that begins there has a reaction of first
            // order.
            let lags = matches!(scheme, Scheme::GeneralizedAlpha { .. });
            let most = if lags { 2e-4 } else { fine[1] };
            assert!(fine[0] <= most, "{reported}");
        }
    }
}

/// A body of 5 kg on a clamp moved by 1 mm at 10 Hz needs m w^2 A, not the force of an alternating velocity.
#[test]
fn a_shaken_mass_pulls_with_mass_times_acceleration() {
    for step in [1e-4, 5e-5] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("light", 2e11, 1e-3));
        let section = b.section(Section::new("s", 1e-4, 8.33e-10));
        let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [0.1, 0.0]], 2, material, section));
        let mut root = Support::new("root", at("root", beam, 0.0), SupportKind::Clamp);
        root.motion = Some(Motion {
            displacement: [0.0, 1e-3],
            rotation: 0.0,
            function: TimeFunction::Harmonic { frequency: 10.0, phase: 0.0 },
        });
        b.support(root);
        let body = at("body", beam, 0.0);
        b.point_mass(PointMass { name: "body".into(), at: body, mass: 5.0, rotary_inertia: 0.0 });
        let (rows, summary) = Rows::of(&b.build().unwrap(), &Settings::new(0.3, step));
        let rate = 20.0 * PI;
        let largest = 5.0 * rate * rate * 1e-3; // 19.74 N
        let found =
            rows.column("support.root.force_2").iter().fold(0.0, |m: f64, f| m.max(f.abs()));
        assert!((found / largest - 1.0).abs() < 1e-3, "{found} {largest}");
        // The impulse that sets it moving is no force: m w A.
        let impulse = summary.supports[0].impulse[1];
        assert!((impulse / (5.0 * rate * 1e-3) - 1.0).abs() < 1e-6, "{impulse}");
    }
}

/// A rigid projectile at rest in front of a point driven at 1 m/s separates from it at 2 m/s, for any standoff.
#[test]
fn a_driven_point_throws_at_twice_its_velocity() {
    for standoff in [0.01, 0.0123, 0.01505] {
        let mut b = ModelBuilder::new();
        let (material, section) = common::plank(&mut b);
        let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [3.0, 0.0]], 4, material, section));
        let mut root = Support::new("root", at("root", beam, 0.0), SupportKind::Clamp);
        let function = TimeFunction::Ramp { duration: 1.0 };
        root.motion = Some(Motion { displacement: [0.0, 1.0], rotation: 0.0, function });
        b.support(root);
        let thrown = common::rigid("ball", at("root", beam, 0.0), [0.0, 0.0], 1.0);
        b.projectile(Projectile { standoff, direction: Some([0.0, -1.0]), ..thrown });
        let (_, summary) = Rows::of(&b.build().unwrap(), &Settings::new(0.05, 1e-4));
        let found = summary.projectiles[0].velocity_final[1];
        assert!((found - 2.0).abs() < 1e-6, "{standoff}: {found}");
        // At rest at the start, it has received 200 N s along its line of motion backwards.
        let given = summary.projectiles[0].momentum_transferred;
        assert!((given - 200.0).abs() < 1e-3, "{given}");
    }
}

/// A frame of all that prescribed motions act on: a clamp that moves and turns, a point mass with rotary inertia on it, a support between
/// nodes for a time, kinks that fall into steps.
fn shaken() -> ModelBuilder {
    let mut b = ModelBuilder::new();
    let (material, section) = common::plank(&mut b);
    let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [3.0, 0.0]], 6, material, section));
    let mut root = Support::new("root", at("root", beam, 0.0), SupportKind::Clamp);
    let function = TimeFunction::Table {
        times: vec![0.0, 0.01234, 0.03, 0.0555],
        values: vec![0.0, 1.0, -0.5, 0.25],
        smooth: false,
    };
    root.motion = Some(Motion { displacement: [0.01, 0.02], rotation: 0.3, function });
    b.support(root);
    let kind = SupportKind::Roller { direction: [1.0, 0.0] };
    let mut guide = Support::new("guide", at("guide", beam, 0.7), kind);
    guide.until = 0.0405;
    let function = TimeFunction::Harmonic { frequency: 20.0, phase: 0.3 };
    guide.motion = Some(Motion { displacement: [0.0, 0.01], rotation: 0.0, function });
    b.support(guide);
    let mass = |name: &str, x| PointMass {
        name: name.into(),
        at: at(name, beam, x),
        mass: 50.0,
        rotary_inertia: 20.0,
    };
    b.point_mass(mass("wheel", 0.0));
    b.point_mass(mass("end", 1.0));
    b
}

/// Energy and both momenta stay closed in every step of a run with driven supports, jumps of their velocities included.
#[test]
fn balances_close_where_supports_are_driven() {
    let model = shaken().build().unwrap();
    for scheme in [Scheme::EnergyMomentum, Scheme::StrainRate] {
        let (_, summary) = Rows::of(&model, &Settings { scheme, ..Settings::new(0.08, 5e-4) });
        // Round-off and the tolerance of Newton's iteration over some hundred steps and pulses.
        assert!(summary.energy.residual_max < 1e-11, "{:?}", summary.energy);
        assert!(summary.momentum.linear_residual_max < 1e-11, "{:?}", summary.momentum);
        assert!(summary.momentum.angular_residual_max < 1e-11, "{:?}", summary.momentum);
    }
}

/// Total impulse of a support from its columns, summed over rows: force times time plus impulse, and the same of moments.
fn given_by(rows: &Rows, support: &str, n: usize) -> [f64; 3] {
    let time = rows.column("time");
    let pairs = [("force_1", "impulse_1"), ("force_2", "impulse_2"), ("moment", "impulse_moment")];
    pairs.map(|(force, impulse)| {
        let force = rows.column(&format!("support.{support}.{force}"));
        let impulse = rows.column(&format!("support.{support}.{impulse}"));
        (1..=n).map(|k| force[k] * (time[k] - time[k - 1]) + impulse[k]).sum()
    })
}

/// Whether the momenta of every row follow from forces and impulses of the supports (with their points in `places`, NaN for obstacles) and from the
/// weight.
fn momentum_closes(rows: &Rows, places: &[(&str, [f64; 2])], weight: [f64; 2]) {
    let time = rows.column("time");
    let momentum =
        ["linear_1", "linear_2", "angular"].map(|n| rows.column(&format!("momentum.{n}")));
    let scale = [0, 1].map(|i| momentum[i].iter().fold(0.0, |m: f64, p| m.max(p.abs())));
    let scale = scale[0].max(scale[1]);
    for n in (1..time.len()).step_by(7).chain([time.len() - 1]) {
        let mut sum = weight.map(|w| w * (time[n] - time[0]));
        let mut turned = 0.0;
        for (support, place) in places {
            let [x, y, moment] = given_by(rows, support, n);
            sum = [sum[0] + x, sum[1] + y];
            turned += place[0] * y - place[1] * x + moment;
        }
        for i in 0..2 {
            let change = momentum[i][n] - momentum[i][0];
            assert!((change - sum[i]).abs() < 1e-9 * scale, "{}: {change} {}", time[n], sum[i]);
        }
        if !turned.is_nan() {
            let change = momentum[2][n] - momentum[2][0];
            assert!((change - turned).abs() < 3e-9 * scale, "{}: {change} {turned}", time[n]);
        }
    }
}

fn clamped_plank(b: &mut ModelBuilder) -> BeamId {
    let (material, section) = common::plank(b);
    let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [3.0, 0.0]], 6, material, section));
    for (name, x) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, beam, x), SupportKind::Clamp));
    }
    beam
}

/// Momentum can be closed from the columns alone: supports and obstacles give forces, and impulses apart from them.
#[test]
fn momentum_closes_from_the_columns() {
    // A strike beside a clamp.
    let mut b = ModelBuilder::new();
    let beam = clamped_plank(&mut b);
    let disc = b.disc(common::disc("ball", 10.0, 0.1, [0.45, 0.2], [1.0, -10.0]));
    let law = RigidLaw { friction: 0.3, ..RigidLaw::frictionless(0.5) };
    let touch = TouchLaw::Rigid(law);
    b.contact(Contact::new(
        "strike",
        [ContactPartner::Disc(disc), ContactPartner::Beam(beam)],
        touch.clone(),
    ));
    let (rows, summary) = Rows::of(&b.build().unwrap(), &Settings::new(0.05, 1e-4));
    let places = [("left", [0.0, 0.0]), ("right", [3.0, 0.0])];
    momentum_closes(&rows, &places, [0.0; 2]);
    assert!(summary.supports[0].impulse[1].abs() > 1.0, "{:?}", summary.supports[0].impulse);

    // A ball that bounces on a rigid floor, and comes to rest.
    let mut b = ModelBuilder::new();
    let shape = ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] };
    let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
    let ball = b.disc(common::disc("ball", 1.0, 0.1, [0.0, 0.3], [0.4, -1.0]));
    clamped_plank_far(&mut b);
    b.contact(Contact::new(
        "bounce",
        [ContactPartner::Disc(ball), ContactPartner::Obstacle(floor)],
        touch,
    ));
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let model = b.build().unwrap();
    let (rows, summary) = Rows::of(&model, &Settings::new(0.6, 1e-3));
    let mass = 1.0 + 3e3 * 0.1;
    let nowhere = [f64::NAN; 2];
    momentum_closes(&rows, &[("far", nowhere), ("floor", nowhere)], [0.0, -9.81 * mass]);
    // Contact impulse without gravity: the sum of the impulses, upwards and along, on the line of its first velocity.
    let sum = |name: &str| rows.column(name).iter().sum::<f64>();
    let (up, along) = (sum("contact.bounce.impulse"), sum("contact.bounce.friction_impulse"));
    let ball = &summary.projectiles[0];
    let gained = [ball.velocity_final[0] - 0.4, ball.velocity_final[1] + 1.0 + 9.81 * 0.6];
    assert!((gained[1] - up).abs() < 1e-9 && (gained[0].abs() - along.abs()).abs() < 1e-9);
    let given = -(0.4 * gained[0] - gained[1]) / 1.16_f64.sqrt();
    assert!(
        (ball.momentum_transferred - given).abs() < 1e-9,
        "{} {given}",
        ball.momentum_transferred
    );
    // The floor is fixed: no work is done on it, all energy is dissipated in the contact.
    let loss = summary.energy.loss_impacts;
    assert!((ball.energy_given - loss).abs() < 1e-9, "{} {loss}", ball.energy_given);
    assert!(ball.energy_received_by_others.abs() < 1e-9);

    // A driven clamp and a released guide: forces act where the supports are, which is known in the middle of a step only.
    let (rows, _) = Rows::of(&shaken().build().unwrap(), &Settings::new(0.08, 5e-4));
    let nowhere = [f64::NAN; 2];
    momentum_closes(&rows, &[("root", nowhere), ("guide", nowhere)], [0.0; 2]);
}

/// A beam out of the way of all else, held at one end.
fn clamped_plank_far(b: &mut ModelBuilder) {
    let (material, section) = common::plank(b);
    let beam = b.beam(Beam::new("far", &[[50.0, 9.0], [51.0, 9.0]], 2, material, section));
    b.support(Support::new("far", at("far", beam, 0.0), SupportKind::Clamp));
}

/// A displacement's largest value is one of the run: a support moved by 1 mm in a step has moved by 1 mm.
#[test]
fn crests_are_reported_where_steps_resolve_them() {
    let function =
        TimeFunction::Table { times: vec![0.0, 1e-3], values: vec![0.0, 1.0], smooth: false };
    for function in [function, TimeFunction::Step { at: 0.0105 }] {
        let model = driven_cantilever(&function, f64::INFINITY);
        let (_, summary) = Rows::of(&model, &Settings::new(0.05, 1e-3));
        let found = summary.points[0].displacement_max[1].value;
        assert!((found - MOVED).abs() < 1e-12 * MOVED, "{found}");
    }
}

/// A sudden load moves the end of a bar by at most twice its static displacement, and a step that does not resolve the bar's waves reports no more;
/// one that resolves them finds it.
#[test]
fn a_sudden_load_moves_a_bar_by_twice_its_static_displacement_at_most() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2e11, 7850.0));
    let section = b.section(Section::new("s", 4e-4, 1.33e-8));
    let beam = b.beam(Beam::new("bar", &[[0.0, 0.0], [1.0, 0.0]], 8, material, section));
    b.support(Support::new("root", at("root", beam, 0.0), SupportKind::Clamp));
    let tip = at("tip", beam, 1.0);
    let pull = LoadKind::Point { at: tip.clone(), force: [8e4, 0.0], moment: 0.0, follower: false };
    b.load(Load::new("pull", pull));
    b.record_point(tip);
    let model = b.build().unwrap();
    let of_static = 8e4 / (2e11 * 4e-4);
    for (end, step, resolved) in [(0.02, 1e-3, false), (0.004, 5e-7, true)] {
        let (_, summary) = Rows::of(&model, &Settings::new(end, step));
        let point = &summary.points[0];
        let found = point.displacement_max[0].value / of_static;
        // Strains are small (1e-3), so that the bound of the linear bar holds to their order.
        assert!(found < 2.01 && (!resolved || found > 1.9), "{step}: {found}");
        assert!(point.resolved[0] == resolved, "{step}: {found}");
    }
}

/// Extremes of reactions include the first row.
#[test]
fn extremes_of_reactions_hold_every_row() {
    let mut b = ModelBuilder::new();
    clamped_plank(&mut b);
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let (rows, summary) = Rows::of(&b.build().unwrap(), &Settings::new(0.05, 1e-3));
    for support in &summary.supports {
        for (i, range) in support.force.iter().chain([&support.moment]).enumerate() {
            let name = ["force_1", "force_2", "moment"][i];
            for value in rows.column(&format!("support.{}.{name}", support.name)) {
                assert!(range.min.value <= value && value <= range.max.value, "{value} {range:?}");
            }
        }
    }
}

/// The energy split of a contact is complete under every scheme, including the energy of the scheme itself.
#[test]
fn the_energy_of_a_contact_adds_up_under_every_scheme() {
    for scheme in [Scheme::EnergyMomentum, Scheme::Newmark] {
        let mut b = ModelBuilder::new();
        let beam = clamped_plank(&mut b);
        b.projectile(common::elastic("mass", at("mid", beam, 0.5), [0.0, -5.0]));
        let settings = Settings { scheme, ..Settings::new(0.15, 1e-3) };
        let (_, summary) = Rows::of(&b.build().unwrap(), &settings);
        let ContactRecord::Smooth { intervals, .. } = &summary.contacts[0].record else { panic!() };
        assert!(!intervals.is_empty());
        for interval in intervals {
            let e = interval.energy;
            let sum = e.given[0] + e.given[1] + e.lost + e.stored + e.scheme;
            assert!(sum.abs() < 1e-9 * e.given[1].abs(), "{e:?}");
            let exact = scheme == Scheme::EnergyMomentum;
            assert!((e.scheme.abs() < 1e-9 * e.given[1].abs()) == exact, "{scheme:?} {e:?}");
        }
    }
}

/// Additional impulses of supports are bounded by those of contacts: parts of a step as short as the instant of an event have no forces, whose
/// products could be large.
#[test]
fn a_bar_that_comes_to_rest_gives_its_floor_no_impulse_beyond_those_of_its_contact() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(Section::rectangle("s", 0.03, 0.03));
    let bar = Beam::new("bar", &[[0.0, 0.1], [0.5, 0.11]], 6, material, section);
    let bar = b.beam(bar);
    let shape = ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] };
    let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
    let law = RigidLaw { friction: 0.3, ..RigidLaw::frictionless(0.5) };
    let between = [ContactPartner::Beam(bar), ContactPartner::Obstacle(floor)];
    b.contact(Contact::new("c", between, TouchLaw::Rigid(law)));
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let model = b.build().unwrap();
    let end = 0.3;
    let (rows, summary) = Rows::of(&model, &Settings::new(end, 5e-4));
    let [along, up, _] = summary.supports[0].impulse;
    let ContactRecord::Nonsmooth { impulse_total, .. } = &summary.contacts[0].record else {
        panic!("a rigid law")
    };
    let sum = |name: &str| rows.column(name).iter().sum::<f64>();
    let gave = sum("contact.c.impulse");
    assert!((gave - impulse_total).abs() < 1e-9 * impulse_total);
    // Impulses of forces in a thousandth of a step are not counted: the additional impulses may be less than the contact's by this amount, or of
    // opposite sign.
    let slack = 1e-3 * impulse_total;
    assert!(up > -slack && up < impulse_total + slack, "{up} of {impulse_total}");
    assert!(along.abs() < 0.3 * impulse_total + slack, "{along} of {impulse_total}");
    // Forces and impulses of the rows add up to the contact's impulse.
    let (time, force) = (rows.column("time"), rows.column("support.floor.force_2"));
    let forces: f64 = (1..time.len()).map(|k| (time[k] - time[k - 1]) * force[k]).sum();
    let total = forces + sum("support.floor.impulse_2");
    assert!((total - gave).abs() < 1e-9 * gave, "{total} against {gave}");
}
