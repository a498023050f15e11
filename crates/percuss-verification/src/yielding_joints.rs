//! Springs and hinges that yield.

use percuss::*;

use crate::check::{Checks, Curve, Report};
use crate::structure::{at, or_nan, run};
use crate::yielding::balances;

/// Perfectly plastic spring law with the given yield force or moment.
fn perfect(limit: f64) -> Option<Plasticity> {
    let curve = vec![Hardening { from: 0.0, stress: limit, modulus: 0.0 }];
    Some(Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain: None })
}

/// Connects the end of a beam to the start of another one by a hinge that yields.
fn hinge(b: &mut ModelBuilder, name: &str, between: [PointRef; 2], stiffness: f64, limit: f64) {
    let kind = JointKind::ElasticHinge { stiffness, damping: 0.0 };
    b.joint(Joint { yielding: perfect(limit), ..Joint::new(name, kind, between) });
}

/// A stiff rotating bar on a hinge that yields: of its energy `J w^2 / 2` the hinge stores `M^2 / 2k` and dissipates the rest, `M` times its
/// plastic rotation. With rotations up to a full turn the axial force of the rotation has no effect on it.
pub fn thrown_bar() -> Report {
    let mut c = Checks::new();
    let (length, side, density, young) = (1.0, 0.05, 7850.0, 2e14);
    let mass = density * side * side * length;
    let inertia = mass * (length * length / 3.0 + side * side / 12.0);
    let (limit, stiffness) = (500.0, 5e4);
    for spin in [6.0, 12.0, 30.0] {
        let mut b = ModelBuilder::new();
        let metal = b.material(Material::new("metal", young, density));
        let section = b.section(Section::rectangle("square", side, side));
        let bar = b.beam(Beam::new("bar", &[[0.0, 0.0], [length, 0.0]], 2, metal, section));
        let stub = b.beam(Beam::new("stub", &[[-0.1, 0.0], [0.0, 0.0]], 1, metal, section));
        b.support(Support::new("wall", at("wall", stub, 0.0), SupportKind::Clamp));
        let ends = [at("root", stub, 1.0), at("heel", bar, 0.0)];
        hinge(&mut b, "root", ends, stiffness, limit);
        let motion = InitialMotion { velocity: [0.0; 2], spin, about: [0.0; 2] };
        b.initial_motion_of("bar", motion);
        let model = b.build().expect("a verification case builds");
        let energy = 0.5 * inertia * spin * spin;
        let expected = (energy - 0.5 * limit * limit / stiffness) / limit;
        // Under the full moment it is at rest after J w / M.
        let settings = Settings::new(1.5 * inertia * spin / limit, 5e-4);
        let summary = run(&model, &settings);
        let name = format!("thrown at {spin} rad/s");
        balances(&mut c, &name, &summary);
        let found = summary.yielding.first();
        let rotation = or_nan(found.map(|one| one.plastic.abs()));
        c.relative(format!("{name}: plastic rotation (rad)"), rotation, expected, 1e-4);
        let dissipated = or_nan(found.map(|one| one.dissipated));
        c.relative(format!("{name}: dissipated (J)"), dissipated, limit * expected, 1e-4);
        let once = or_nan(found.map(|one| one.accumulated));
        c.relative(format!("{name}: it yields one way (rad)"), once, rotation, 1e-12);
    }
    c.into_report()
}

/// A pound-force \[N\] and an inch \[m\].
const POUND: f64 = 4.448_221_615_260_5;
const INCH: f64 = 0.0254;

/// A mass on a rod that yields, under a sudden force: ANSYS VM80, after Biggs 1964, article 2.7: 0.0259 kip s^2/in, a rod
/// of 100 in and 0.278 in^2, 30e3 ksi, that yields at 162.9 ksi, 30 kip.
///
/// Elastic, `x = F/k (1 - cos wt)`; from `R = k x` on uniformly decelerated; then elastic again about the permanent displacement.
pub fn mass_on_a_rod() -> Report {
    let mut c = Checks::new();
    let per_inch = 1e3 * POUND / INCH;
    let (mass, stiffness) = (0.0259 * per_inch, 30e3 * 0.278 / 100.0 * per_inch);
    let (limit, force) = (162.9 * 0.278 * 1e3 * POUND, 30e3 * POUND);
    let mut b = ModelBuilder::new();
    // It guides mass and load along its axis, and has negligible mass and stiffness.
    let light = b.material(Material::new("light", 2e11, 1e-3));
    let section = b.section(Section::rectangle("square", 0.1, 0.1));
    let slide = b.beam(Beam::new("slide", &[[0.0, 0.0], [0.1, 0.0]], 1, light, section));
    for (name, place) in [("near", 0.0), ("far", 1.0)] {
        let components = vec![Component::Displacement2];
        b.support(Support::new(name, at(name, slide, place), SupportKind::Fix { components }));
    }
    let end = at("mass", slide, 1.0);
    let (name, rotary_inertia) = ("mass".into(), 0.0);
    b.point_mass(PointMass { name, at: end.clone(), mass, rotary_inertia });
    b.spring(Spring {
        name: "rod".into(),
        between: [Anchor::Point(end.clone()), Anchor::Ground([0.1 - 100.0 * INCH, 0.0])],
        law: SpringLaw::Linear { stiffness },
        damping: 0.0,
        length: None,
        strength: None,
        yielding: perfect(limit),
    });
    let kind =
        LoadKind::Point { at: end.clone(), force: [force, 0.0], moment: 0.0, follower: false };
    b.load(Load::new("force", kind));
    b.record_point(end);
    let model = b.build().expect("a verification case builds");
    let mut rows = MemoryRecorder::default();
    let settings = Settings::new(0.14, 5e-5);
    let summary = simulate(&model, &settings, &mut rows).expect("valid settings");
    balances(&mut c, "mass on a rod", &summary);

    let (rate, still) = ((stiffness / mass).sqrt(), force / stiffness);
    let yields_at = limit / stiffness;
    let first = (1.0 - yields_at / still).acos() / rate;
    let speed = still * rate * (rate * first).sin();
    let slowed = (limit - force) / mass;
    let largest = yields_at + 0.5 * speed * speed / slowed;
    let (at_largest, half) = (first + speed / slowed, std::f64::consts::PI / rate);
    let smallest = largest - 2.0 * (limit - force) / stiffness;

    let column = |name: &str| rows.column(name).unwrap_or_default();
    let (time, way) = (column("time"), column("point.mass.displacement_1"));
    let points: Vec<[f64; 2]> = time.iter().zip(&way).map(|(t, x)| [*t, x / INCH]).collect();
    let most = points.iter().copied().fold([f64::NAN; 2], |a, b| if b[1] <= a[1] { a } else { b });
    let after = points.iter().copied().filter(|p| p[0] > most[0]);
    let least = after.fold([f64::NAN; 2], |a, b| if b[1] >= a[1] { a } else { b });
    for (what, found, exact, published) in [
        ("largest displacement (in)", most[1], largest / INCH, 0.806),
        ("at (s)", most[0], at_largest, 0.0669),
        ("smallest displacement after it (in)", least[1], smallest / INCH, 0.438),
        ("at (s)", least[0], at_largest + half, 0.122),
    ] {
        c.relative(format!("{what}, closed form"), found, exact, 5e-4);
        c.relative(format!("{what}, VM80"), found, published, 3e-3);
    }
    let plastic = or_nan(summary.yielding.first().map(|one| one.plastic));
    c.relative("plastic extension (in)", plastic / INCH, (largest - yields_at) / INCH, 1e-3);
    let drawn: Vec<[f64; 2]> = points.iter().step_by(10).copied().collect();
    let known = vec![[at_largest, largest / INCH], [at_largest + half, smallest / INCH]];
    c.figure(
        "Displacement of the mass",
        ["time (s)", "displacement (in)"],
        [Curve::computed("Percuss", drawn), Curve::reference("closed form", known)],
    );
    c.into_report()
}

/// Height, span, Young's modulus, second moment of area and plastic moment of the portal \[m, Pa, m^4, N m\].
const HEIGHT: f64 = 4.0;
const SPAN: f64 = 8.0;
const YOUNG: f64 = 2e11;
const INERTIA: f64 = 1e-5;
const MOMENT: f64 = 20.0;

/// A portal with a force `p` sideways on its left corner and one downwards at the middle of its girder, with hinges at the largest moments.
/// The clamped stubs under its hinged feet are short; the slope-deflection method assumes inextensible bars.
fn portal(p: f64) -> Model {
    let mut b = ModelBuilder::new();
    let metal = b.material(Material::new("metal", YOUNG, 7850.0));
    let section = b.section(Section::new("bar", 1.0, INERTIA));
    let bar = |b: &mut ModelBuilder, name: &str, points: [[f64; 2]; 2], n: usize| {
        b.beam(Beam::new(name, &points, n, metal, section))
    };
    let (half, stub) = (0.5 * SPAN, 0.001);
    let left = bar(&mut b, "left", [[0.0, 0.0], [0.0, HEIGHT]], 4);
    let right = bar(&mut b, "right", [[SPAN, 0.0], [SPAN, HEIGHT]], 4);
    let near = bar(&mut b, "near", [[0.0, HEIGHT], [half, HEIGHT]], 4);
    let far = bar(&mut b, "far", [[half, HEIGHT], [SPAN, HEIGHT]], 4);
    let feet = [0.0, SPAN].map(|x| bar(&mut b, &format!("foot{x}"), [[x, -stub], [x, 0.0]], 1));
    for (foot, name) in feet.iter().zip(["a", "b"]) {
        b.support(Support::new(name, at(name, *foot, 0.0), SupportKind::Clamp));
    }
    for (name, first, second) in [
        ("left-foot", (feet[0], 1.0), (left, 0.0)),
        ("right-foot", (feet[1], 1.0), (right, 0.0)),
        ("left-corner", (left, 1.0), (near, 0.0)),
        ("middle", (near, 1.0), (far, 0.0)),
        ("right-corner", (far, 1.0), (right, 1.0)),
    ] {
        let ends = [first, second].map(|(beam, s)| at(&format!("{name}{s}"), beam, s));
        hinge(&mut b, name, ends, 1e10, MOMENT);
    }
    for (name, beam, force) in [("wind", left, [p, 0.0]), ("weight", near, [0.0, -p])] {
        let point = at(name, beam, 1.0);
        b.record_point(point.clone());
        let kind = LoadKind::Point { at: point, force, moment: 0.0, follower: false };
        b.load(Load::new(name, kind));
    }
    b.build().expect("a verification case builds")
}

/// Pushover of a portal, small displacements: a sequence of plastic hinges, and finally a mechanism.
///
/// Hand calculation with the slope-deflection method in fractions: moments of the right foot, the right corner, the middle and the left foot
/// are 1.65, 1.55, 1.2 and 0.85 times p at first, so that the right foot yields at 20/33 of the moment; solved again with each hinge
/// the others follow at 43/67, 17/23 and 3/4, the sway then 16/3 M/EI. The combined mechanism has `p (H + L/2) = 6 M`, which is the
/// last of them, below those of the girder, `p L/2 = 4 M`, and of sway, `p H = 4 M`.
pub fn portal_pushover() -> Report {
    let mut c = Checks::new();
    let limit = 6.0 * MOMENT / (HEIGHT + 0.5 * SPAN);
    let model = portal(limit);
    let end = PathEnd::Displacement { point: "wind".into(), component: 1, value: 1e-3 };
    let path = equilibrium_path(&model, &PathSettings { first: 0.05, points: 500, end }).ok();
    let yields = path.as_ref().map(|path| path.yields.as_slice()).unwrap_or_default();
    let order = [
        ("joint.right-foot", 20.0 / 33.0),
        ("joint.right-corner", 43.0 / 67.0),
        ("joint.middle", 17.0 / 23.0),
        ("joint.left-foot", 0.75),
    ];
    c.absolute("hinges that yield", yields.len() as f64, order.len() as f64, 0.0);
    for (k, (name, load)) in order.iter().enumerate() {
        let found = yields.get(k).filter(|one| one.name == *name);
        let load = load * MOMENT / limit;
        let found = or_nan(found.map(|one| one.factor));
        c.relative(format!("hinge {}, {name}: load over the limit", k + 1), found, load, 5e-4);
    }
    let points = path.as_ref().map(|path| path.points.as_slice()).unwrap_or_default();
    let most = points.iter().map(|point| point.factor).fold(f64::NAN, f64::max);
    c.relative("largest load over that of the mechanism", most, 1.0, 1e-4);
    let sway = 16.0 / 3.0 * MOMENT / (YOUNG * INERTIA);
    let last = points.iter().find(|point| point.factor > 0.9999);
    let found = or_nan(last.and_then(|point| point.displacements.first()).map(|u| u[0]));
    c.relative("sway as the last hinge yields (m)", found, sway, 1e-2);
    // Loads below the limit have an equilibrium, in which yielded hinges carry their plastic moment.
    let below = equilibrium(&portal(0.99 * limit)).ok();
    let moments = below.iter().flat_map(|found| &found.yielding).filter(|one| one.yielded);
    let largest =
        moments.map(|one| (one.force.abs() / MOMENT - 1.0).abs()).fold(f64::NAN, f64::max);
    c.at_most("moments of hinges that have yielded at 0.99 of it, off theirs", largest, 1e-6);
    let curve: Vec<[f64; 2]> = points
        .iter()
        .filter_map(|point| Some([point.displacements.first()?[0] / sway, point.factor]))
        .take_while(|point| point[0] < 2.0)
        .collect();
    // Ratio of the sway to that at the limit, from the same solutions.
    let sways = [280.0 / 99.0, 632.0 / 201.0, 328.0 / 69.0, 16.0 / 3.0];
    let by_hand = [[0.0; 2]].into_iter();
    let events = sways.iter().zip(&order).map(|(u, (_, load))| [u * 3.0 / 16.0, load / 0.75]);
    let reference = by_hand.chain(events).chain([[2.0, 1.0]]).collect();
    c.figure(
        "Load over the limit and sway over that at the limit",
        ["sway (1)", "load (1)"],
        [Curve::computed("Percuss", curve), Curve::reference("hand calculation", reference)],
    );
    c.into_report()
}
