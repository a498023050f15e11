//! Equilibria in contact, their stability and their vibrations.

use std::f64::consts::{PI, TAU};

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::{at, or_nan};

const YOUNG: f64 = 2.1e11;
const DENSITY: f64 = 7850.0;
const GRAVITY: f64 = 9.81;

/// Force and moment of the clamp, and the free length, of an inextensible strip (EI = 1.4 N m^2, 1.54 N/m) with a horizontal clamp at a height
/// above a smooth floor, which it touches without a moment: `EI theta' = m`, `m' = (R - w s) cos theta`, by Runge-Kutta's method and Newton's, 400
/// steps.
const HEAVY_ELASTICA: [(f64, f64, f64, f64); 3] = [
    (0.02, 1.098431424117, 0.293682685904, 1.069718523686),
    (0.1, 1.645048910359, 0.656694449496, 1.601069259786),
    (0.2, 1.962333716804, 0.928706196809, 1.907524563494),
];

/// A strip of 2 m over a rigid floor, at a height of its faces.
fn strip_on_floor(height: f64, elements: usize) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", YOUNG, DENSITY));
    let section = Section { depth: Some(2e-3), ..Section::new("strip", 2e-5, 0.01 * 8e-9 / 12.0) };
    let section = b.section(section);
    let strip = b.beam(Beam::new("strip", &[[0.0; 2], [2.0, 0.0]], elements, material, section));
    b.support(Support::new("root", at("root", strip, 0.0), SupportKind::Clamp));
    let shape = ObstacleShape::HalfPlane { point: [0.0, -height - 1e-3], normal: [0.0, 1.0] };
    let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
    let law = TouchLaw::Rigid(RigidLaw::frictionless(0.0));
    b.contact(Contact::new(
        "lies",
        [ContactPartner::Beam(strip), ContactPartner::Obstacle(floor)],
        law,
    ));
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -GRAVITY] }));
    b.build().expect("a verification case builds")
}

/// A strip on a floor: linear closed form for small heights, heavy elastica for large ones.
pub fn strip_on_a_floor() -> Report {
    let mut c = Checks::new();
    let (bending, weight) = (YOUNG * 0.01 * 8e-9 / 12.0, DENSITY * 2e-5 * GRAVITY);
    let elements = 160;
    // An element has two contact candidates: the error of the touch-down point is half their distance, that of the force half of its weight.
    let slack = 0.25 * weight * 2.0 / (2 * elements) as f64;
    let linear = [1e-3, 2e-3, 5e-3].map(|height| {
        let free = (72.0 * bending * height / weight).powf(0.25);
        // The slope is about h / a, and the difference from a linear beam is its square.
        let steep = (height / free).powi(2) * weight * free;
        let force = 2.0 / 3.0 * weight * free;
        (height, force, 0.25 * force * free, free, slack + steep)
    });
    let curved =
        HEAVY_ELASTICA.map(|(height, force, moment, free)| (height, force, moment, free, slack));
    for (height, force, moment, free, slack) in linear.into_iter().chain(curved) {
        let found = equilibrium(&strip_on_floor(height, elements)).ok();
        let root = found.as_ref().map_or([f64::NAN; 3], |found| found.reactions[0].1);
        let contact = found.as_ref().map(|found| &found.contacts[0]);
        c.absolute(format!("{height} m: force of the clamp [N]"), root[1], force, slack);
        c.absolute(format!("{height} m: moment of the clamp [N m]"), root[2], moment, slack * free);
        let from = or_nan(contact.map(|c| c.s[0]));
        let apart = 2.0 / (2 * elements) as f64;
        c.absolute(format!("{height} m: place of the touch-down [m]"), from, free, 1.01 * apart);
        let sum = root[1] + or_nan(contact.map(|c| c.force));
        c.absolute(format!("{height} m: all vertical forces [N]"), sum, 2.0 * weight, 1e-9);
    }
    c.into_report()
}

/// A square steel bar of 50 mm and 3 m, clamped at its start.
fn cantilever(b: &mut ModelBuilder, elements: usize) -> BeamId {
    let material = b.material(Material::new("steel", YOUNG, DENSITY));
    let mut section = Section::new("bar", 2.5e-3, 0.05_f64.powi(4) / 12.0);
    section.rotary_inertia = RotaryInertia::Neglected;
    let section = b.section(section);
    let beam = b.beam(Beam::new("bar", &[[0.0; 2], [3.0, 0.0]], elements, material, section));
    b.support(Support::new("root", at("root", beam, 0.0), SupportKind::Clamp));
    beam
}

/// `sqrt(EI / (rho A L^4)) / (2 pi)` of that bar \[Hz\].
fn unit() -> f64 {
    (YOUNG * 0.05_f64.powi(4) / 12.0 / (DENSITY * 2.5e-3)).sqrt() / (TAU * 9.0)
}

/// The lowest frequency of a cantilever with a heavy mass at its tip, on fine meshes.
pub fn tip_mass() -> Report {
    let mut c = Checks::new();
    let ratio = 1000.0 / (DENSITY * 2.5e-3 * 3.0);
    // 1 + cos x cosh x + ratio x (cos x sinh x - sin x cosh x) = 0.
    let f =
        |x: f64| 1.0 + x.cos() * x.cosh() + ratio * x * (x.cos() * x.sinh() - x.sin() * x.cosh());
    let (mut low, mut high) = (0.1, 1.5);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 { low = middle } else { high = middle }
    }
    let exact = low * low * unit();
    c.absolute("closed form [Hz]", exact, 0.551, 5e-4);
    for elements in [30, 300, 1000] {
        let mut b = ModelBuilder::new();
        let beam = cantilever(&mut b, elements);
        b.point_mass(PointMass {
            name: "mass".into(),
            at: at("tip", beam, 1.0),
            mass: 1000.0,
            rotary_inertia: 0.0,
        });
        let model = b.build().expect("a verification case builds");
        let found = or_nan(natural_frequencies(&model, 1).first().copied());
        c.relative(format!("{elements} elements: lowest frequency [Hz]"), found, exact, 1e-6);
    }
    c.into_report()
}

/// Lowest `w = omega L^2 sqrt(rho A / EI)` of Beck's column under `p = P L^2 / EI`: the first root of
/// `p^2 + 2 w^2 (1 + cosh a cos b) + p w sinh a sin b`, `a, b = sqrt(sqrt(p^2/4 + w^2) -+ p/2)`.
fn beck_root(p: f64) -> f64 {
    let f = |w: f64| {
        let r = (0.25 * p * p + w * w).sqrt();
        let (a, b) = ((r - 0.5 * p).sqrt(), (r + 0.5 * p).sqrt());
        p * p + 2.0 * w * w * (1.0 + a.cosh() * b.cos()) + p * w * a.sinh() * b.sin()
    };
    let mut low = 1.0;
    while f(low + 0.01) > 0.0 {
        low += 0.01;
    }
    let mut high = low + 0.01;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

/// Beck's column: frequencies under a tangential follower force, and the load at which two of them coincide.
pub fn becks_column() -> Report {
    let mut c = Checks::new();
    let one = YOUNG * 0.05_f64.powi(4) / 12.0 / 9.0;
    let column = |load: f64| {
        let mut b = ModelBuilder::new();
        let beam = cantilever(&mut b, 24);
        let at = at("tip", beam, 1.0);
        let kind = LoadKind::Point { at, force: [-load * one, 0.0], moment: 0.0, follower: true };
        b.load(Load::new("push", kind));
        b.build().expect("a verification case builds")
    };
    // The strain of the load, p I / (A L^2) = 4.6e-4 at 20, stiffens and shortens the column; the effect grows where two frequencies approach each
    // other.
    for load in [5.0, 10.0, 15.0] {
        let model = column(load);
        let modes = equilibrium(&model)
            .map_or_else(|_| Vec::new(), |found| modes_about_equilibrium(&model, &found, 2));
        let found = or_nan(modes.first().map(Mode::frequency)) / unit();
        c.relative(format!("P L^2 / EI = {load}: omega"), found, beck_root(load), 3e-3);
    }
    let (factor, omega) = match buckling(&column(15.0), 1).stability {
        Some(FollowerStability::Flutter { factor, frequency }) => (factor, frequency / unit()),
        _ => (f64::NAN, f64::NAN),
    };
    c.relative("P L^2 / EI at flutter", 15.0 * factor, 20.0509, 3e-3);
    c.relative("omega at flutter", omega, 11.016, 3e-3);
    c.into_report()
}

/// A pinned column beside four unconnected rods in tension: its buckling factor comes after all negative factors of the rods.
pub fn column_beside_ties() -> Report {
    let mut c = Checks::new();
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", YOUNG, DENSITY));
    let section = b.section(Section::new("bar", 1e-4, 1e-8 / 12.0));
    let critical = PI * PI * YOUNG * 1e-8 / 12.0;
    for (k, push) in [-1.0 / 6.0, 2.0, 3.0, 5.0, 8.0].into_iter().enumerate() {
        let (name, x) = (format!("bar{k}"), k as f64);
        let bar = b.beam(Beam::new(name.clone(), &[[x, 0.0], [x, 1.0]], 16, material, section));
        b.support(Support::new(format!("{name}.foot"), at("foot", bar, 0.0), SupportKind::Pin));
        let roller = SupportKind::Roller { direction: [0.0, 1.0] };
        b.support(Support::new(format!("{name}.head"), at("head", bar, 1.0), roller));
        let (at, force) = (at("head", bar, 1.0), [0.0, push * critical]);
        let kind = LoadKind::Point { at, force, moment: 0.0, follower: false };
        b.load(Load::new(name, kind));
    }
    let found = buckling(&b.build().expect("a verification case builds"), 2);
    // Euler's load of a column whose axial strain under it, 8e-5, is neglected.
    for (k, exact) in [6.0, 24.0].into_iter().enumerate() {
        let factor = or_nan(found.modes.get(k).map(|m| m.factor));
        c.relative(format!("factor {}", k + 1), factor, exact, 5e-4);
    }
    c.into_report()
}
