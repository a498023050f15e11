//! Beams that a blow bends for good, against closed forms of rigid, perfectly plastic material.
//!
//! Elasticity fades from a result as Young's modulus grows at the same yield stress; so do the errors that it leaves.

use percuss::*;

use crate::check::{Check, Checks};
use crate::structure::{at, or_nan};
use crate::yielding::{balances, perfect};

/// Yield stress \[Pa\].
const LIMIT: f64 = 250e6;

pub fn struck_in_the_middle(kind: &SupportKind, lambda: f64, elements: usize, young: f64, density: f64, steps: usize) -> (f64, RunSummary) {
    let (half, width, depth, mass) = (0.5, 0.025, 0.025, 100.0);
    let plastic = LIMIT * width * depth * depth / 4.0;
    let speed = f64::sqrt(8.0 * plastic * depth * lambda / (mass * half));
    let mut b = ModelBuilder::new();
    let metal = b.material(perfect(young, density, LIMIT));
    let section = b.section(Section::rectangle("square", width, depth));
    let ends = [[0.0, 0.0], [half, 0.0]];
    let beam = b.beam(Beam::new("beam", &ends, elements, metal, section));
    b.support(Support::new("left", at("left", beam, 0.0), kind.clone()));
    let middle = at("middle", beam, 1.0);
    b.support(Support::new("mid", middle.clone(), SupportKind::Fix { components: vec![Component::Displacement1, Component::Rotation]}));
    let name = "striker".into();
    b.point_mass(PointMass { name, at: middle.clone(), mass: 0.5 * mass, rotary_inertia: 0.0 });
    b.record_point(middle);
    let model = b.build().expect("a verification case builds");
    let end = 1.1 * 2.0 * depth * lambda.sqrt() / speed;
    let mut run = Simulation::new(&model, &Settings::new(end, end / steps as f64)).expect("sound settings");
    run.set_velocities(|_, x| if (x[0] - half).abs() < 1e-9 { [0.0, speed] } else { [0.0; 2] });
    let summary = run.run(&mut NoRecorder);
    (summary.points[0].displacement_max[1].value / depth, summary)
}

/// Largest deflection over depth `w` that a mass of `lambda = G V0^2 L / (8 M0 h)` drives a rectangle to, with the interaction of moment and
/// axial force `M/M0 + (N/N0)^2 = 1`: the work of both, integrated over the deflection.
pub fn driven_to(clamped: bool, lambda: f64) -> f64 {
    if clamped {
        if lambda >= 4.0 / 3.0 {
            return (lambda - 1.0 / 3.0).sqrt();
        }
        let mut w = lambda;
        for _ in 0..50 {
            w -= (w + w.powi(3) / 3.0 - lambda) / (1.0 + w * w);
        }
        return w;
    }
    if lambda >= 1.0 / 3.0 {
        return (lambda - 1.0 / 12.0).sqrt();
    }
    let mut w = 2.0 * lambda;
    for _ in 0..50 {
        w -= (0.5 * w + 2.0 / 3.0 * w.powi(3) - lambda) / (0.5 + 2.0 * w * w);
    }
    w
}

/// A cantilever with a mass at its tip, at once at V0.
pub struct Parkes {
    /// Mass of the tip over that of the beam.
    pub ratio: f64,
    pub elements: usize,
    pub young: f64,
    pub steps: usize,
}

const ARM: f64 = 1.0;
const DEPTH: f64 = 0.1;
const DENSITY: f64 = 7850.0;

fn plastic_moment() -> f64 {
    LIMIT * DEPTH.powi(3) / 4.0
}

impl Parkes {
    /// The velocity that turns the root by the angle given.
    fn speed(&self, angle: f64) -> f64 {
        let mass = DENSITY * DEPTH * DEPTH * ARM;
        let after = 1.0 + 0.5 / self.ratio;
        (2.0 * plastic_moment() * angle / (mass * (self.ratio + 1.0 / 3.0))).sqrt() * after
    }

    pub fn deflection(&self, angle: f64) -> f64 {
        let (ratio, beta, speed) = (self.ratio, 0.5 / self.ratio, self.speed(angle));
        (ratio * speed).powi(2) * DENSITY * DEPTH * DEPTH * ARM / (3.0 * plastic_moment()) * ARM
                * (beta / (1.0 + beta) + 2.0 * beta.ln_1p())
    }

    pub fn run(&self, angle: f64) -> RunSummary {
        let mass = self.ratio * DENSITY * DEPTH * DEPTH * ARM;
        let speed = self.speed(angle);
        let mut b = ModelBuilder::new();
        let metal = b.material(perfect(self.young, DENSITY, LIMIT));
        let rotary_inertia = RotaryInertia::Neglected;
        let square = Section { rotary_inertia, ..Section::rectangle("square", DEPTH, DEPTH) };
        let section = b.section(square);
        let ends = [[0.0, 0.0], [ARM, 0.0]];
        let arm = b.beam(Beam::new("arm", &ends, self.elements, metal, section));
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        let tip = at("tip", arm, 1.0);
        let name = "striker".into();
        b.point_mass(PointMass { name, at: tip.clone(), mass, rotary_inertia: 0.0 });
        b.record_point(tip.clone());
        // Momentum about the root: M0 T = G V0 L.
        let end = 1.2 * mass * speed * ARM / plastic_moment();
        let step = end / self.steps as f64;
        let force = [0.0, mass * speed / step];
        let kind = LoadKind::Point { at: tip, force, moment: 0.0, follower: false };
        b.load(Load { until: step, ..Load::new("blow", kind) });
        let model = b.build().expect("a verification case builds");
        simulate(&model, &Settings::new(end, step), &mut NoRecorder).expect("sound settings")
    }
}


use Component::*;
pub fn thrown_beam(clamped: bool, elements: usize, young: f64, steps: usize, way: f64) -> (f64, f64, RunSummary) {
            let half = 0.5;
            let mass = DENSITY * DEPTH * DEPTH;
            let speed = (way * 3.0 * plastic_moment() / (mass * half * half)).sqrt();
            let exact = if clamped { 0.5 * way } else { way };
            let held = if clamped { vec![Displacement2, Rotation] } else { vec![Displacement2] };
            let mut b = ModelBuilder::new();
            let metal = b.material(perfect(young, DENSITY, LIMIT));
            let rotary_inertia = RotaryInertia::Neglected;
            let square = Section { rotary_inertia, ..Section::rectangle("square", DEPTH, DEPTH) };
            let section = b.section(square);
            let ends = [[0.0, 0.0], [2.0 * half, 0.0]];
            let beam = b.beam(Beam::new("beam", &ends, elements, metal, section));
            for (name, f) in [("left", 0.0), ("right", 1.0)] {
                let components = held.clone();
                b.support(Support::new(name, at(name, beam, f), SupportKind::Fix { components }));
            }
            let components = vec![Displacement1];
            b.support(Support::new("mid", at("mid", beam, 0.5), SupportKind::Fix { components }));
            b.record_point(at("mid", beam, 0.5));
            // At rest at m V0 L^2 / 2 M0, a beam between clamps after half of that.
            let end = if clamped { 0.6 } else { 1.2 } * mass * speed * half * half / (2.0 * plastic_moment());
            let step = end / steps as f64;
            let q = [0.0, mass * speed / step];
            let stretch = [0.0, 1.0].map(Along::Fraction);
            let kind = LoadKind::Distributed { beam, stretch, force: [q, q], follower: false };
            b.load(Load { until: step, ..Load::new("blow", kind) });
            let model = b.build().expect("a verification case builds");
            let summary = simulate(&model, &Settings::new(end, step), &mut NoRecorder).expect("sound");
            let found = summary.points[0].displacement_max[1].value;
            (found, exact, summary)
}
