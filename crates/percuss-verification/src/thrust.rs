//! A free rod under a follower force.

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::run;

const LENGTH: f64 = 1.0;
const DEPTH: f64 = 0.05;
const DENSITY: f64 = 7850.0;
/// A hundred times that of steel, with which the bending of the rod changes its path by 2e-4.
const YOUNG: f64 = 210e11;
const FORCE: f64 = 400.0;

/// A square rod along the first axis, with a transverse follower force at its end.
fn pushed() -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("stiff", YOUNG, DENSITY));
    let (area, inertia) = (DEPTH * DEPTH, DEPTH.powi(4) / 12.0);
    let section = b.section(Section::new("rod", area, inertia));
    let rod = b.beam(Beam::new("rod", &[[0.0; 2], [LENGTH, 0.0]], 4, material, section));
    let at = |label: &str, fraction| PointRef {
        label: label.into(),
        beam: rod,
        along: Along::Fraction(fraction),
    };
    b.record_point(at("middle", 0.5));
    let kind =
        LoadKind::Point { at: at("end", 1.0), force: [0.0, FORCE], moment: 0.0, follower: true };
    b.load(Load::new("thrust", kind));
    b.build().expect("a valid model")
}

/// Path of the middle of a rigid rod, at the given number of instants up to `end`, and its final speed: the direction of the force turns by
/// `alpha t^2 / 2`, whose sine and cosine are integrated twice (Fresnel's integrals) by Simpson's rule.
fn rigid(alpha: f64, mass: f64, end: f64, instants: usize) -> (Vec<[f64; 3]>, [f64; 2]) {
    let acceleration = |t: f64| {
        let angle = 0.5 * alpha * t * t;
        [-FORCE / mass * angle.sin(), FORCE / mass * angle.cos()]
    };
    let (mut way, mut velocity) = ([0.0; 2], [0.0; 2]);
    let (h, mut out) = (end / instants as f64, Vec::new());
    for k in 0..instants {
        let t = k as f64 * h;
        let [a, m, b] = [t, t + 0.5 * h, t + h].map(acceleration);
        for i in 0..2 {
            way[i] += h * velocity[i] + h * h / 6.0 * (a[i] + 2.0 * m[i]);
            velocity[i] += h / 6.0 * (a[i] + 4.0 * m[i] + b[i]);
        }
        out.push([t + h, way[0], way[1]]);
    }
    (out, velocity)
}

/// The rod has a constant angular acceleration and its middle moves on a spiral, as a rocket with a skew nozzle; under a force of constant
/// direction it would move on a straight line.
pub fn skew_thrust() -> Report {
    let mut c = Checks::new();
    let mass = DENSITY * DEPTH * DEPTH * LENGTH;
    let inertia = mass * (LENGTH * LENGTH + DEPTH * DEPTH) / 12.0;
    let alpha = FORCE * LENGTH / 2.0 / inertia;
    // One turn and a quarter.
    let end = (2.5 * std::f64::consts::TAU / alpha).sqrt();
    let (way, velocity) = rigid(alpha, mass, end, 2000);
    let found = run(&pushed(), &Settings::new(end, end / 2000.0));
    for (i, axis) in ["first", "second"].into_iter().enumerate() {
        let largest = way
            .iter()
            .map(|x| x[1 + i])
            .fold(0.0, |m: f64, x| if x.abs() > m.abs() { x } else { m });
        let peak = found.points[0].displacement_max[i].value;
        // The end of the rod rotates slightly relative to its middle, as the rod bends: the difference vanishes with growing stiffness.
        c.relative(format!("largest way of the middle, {axis} axis [m]"), peak, largest, 1e-5);
    }
    let spin = alpha * end;
    let kinetic =
        0.5 * mass * (velocity[0].powi(2) + velocity[1].powi(2)) + 0.5 * inertia * spin * spin;
    c.relative("work of the thrust [J]", found.energy.work_loads, kinetic, 1e-5);
    c.at_most("energy residual", found.energy.residual_max, 1e-12);
    c.at_most("angular momentum residual", found.momentum.angular_residual_max, 1e-12);
    c.into_report()
}
