//! Beams that a blow bends for good, against closed forms of rigid, perfectly plastic material.
//!
//! Elasticity fades from a result as Young's modulus grows at the same yield stress; so do the errors that it leaves.

use percuss::*;

use crate::check::{Check, Checks};
use crate::structure::{at, or_nan};
use crate::yielding::{balances, perfect};

/// Yield stress \[Pa\].
const LIMIT: f64 = 250e6;

/// A heavy mass G on the middle of a light beam of half span 0.5 m, at once at V0.
fn struck_in_the_middle(kind: &SupportKind, lambda: f64, elements: usize, young: f64) -> (f64, RunSummary) {
    let (half, width, depth, mass) = (0.5, 0.02, 0.02, 100.0);
    let plastic = LIMIT * width * depth * depth / 4.0;
    let speed = f64::sqrt(8.0 * plastic * depth * lambda / (mass * half));
    let mut b = ModelBuilder::new();
    let metal = b.material(perfect(young, 1.0, LIMIT));
    let section = b.section(Section::rectangle("square", width, depth));
    let ends = [[0.0, 0.0], [2.0 * half, 0.0]];
    let beam = b.beam(Beam::new("beam", &ends, elements, metal, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, beam, f), kind.clone()));
    }
    let middle = at("middle", beam, 0.5);
    let name = "striker".into();
    b.point_mass(PointMass { name, at: middle.clone(), mass, rotary_inertia: 0.0 });
    b.record_point(middle);
    let model = b.build().expect("a verification case builds");
    let end = 2.5 * 2.0 * depth * lambda.sqrt() / speed;
    let mut run = Simulation::new(&model, &Settings::new(end, end / 300.0)).expect("sound settings");
    run.set_velocities(|_, x| if (x[0] - half).abs() < 1e-9 { [0.0, speed] } else { [0.0; 2] });
    let summary = run.run(&mut NoRecorder);
    (summary.points[0].displacement_max[1].value / depth, summary)
}

/// Largest deflection over depth `w` that a mass of `lambda = G V0^2 L / (8 M0 h)` drives a rectangle to, with the interaction of moment and
/// axial force `M/M0 + (N/N0)^2 = 1`: the work of both, integrated over the deflection.
fn driven_to(clamped: bool, lambda: f64) -> f64 {
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

/// A heavy mass on a beam whose ends cannot draw in: bending at first, then a string (Haythornthwaite 1957; Jones 1989, ch. 7).
pub fn heavy_mass() -> Vec<Check> {
    let mut c = Checks::new();
    for (name, kind, clamped) in
        [("clamped", SupportKind::Clamp, true), ("pinned", SupportKind::Pin, false)]
    {
        for lambda in [0.3, 1.0, 4.0] {
            let exact = driven_to(clamped, lambda);
            for (elements, young) in [(8, 2e13), (16, 2e13), (32, 2e13), (16, 2e14)] {
                let (w, summary) = struck_in_the_middle(&kind, lambda, elements, young);
                let what = format!("{name}, lambda {lambda}, {elements} elements, {young:e}:");
                c.relative(format!("{what} deflection over depth"), w, exact, 1e-2);
                balances(&mut c, &what, &summary);
            }
        }
    }
    c.into_vec()
}

/// A cantilever with a mass at its tip, at once at V0.
struct Parkes {
    /// Mass of the tip over that of the beam.
    ratio: f64,
    elements: usize,
    young: f64,
    steps: usize,
}

const ARM: f64 = 1.0;
const DEPTH: f64 = 0.02;
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

    fn run(&self, angle: f64) -> RunSummary {
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
        b.record_point(tip);
        let model = b.build().expect("a verification case builds");
        // Momentum about the root: M0 T = G V0 L.
        let end = 1.2 * mass * speed * ARM / plastic_moment();
        let settings = Settings::new(end, end / self.steps as f64);
        let mut run = Simulation::new(&model, &settings).expect("sound settings");
        run.set_velocities(|_, x| if x[0] > ARM - 1e-9 { [0.0, speed] } else { [0.0; 2] });
        run.run(&mut NoRecorder)
    }
}

/// A cantilever struck at its tip: a hinge travels to the root, then the beam turns about it (Parkes 1955).
pub fn parkes() -> Vec<Check> {
    let mut c = Checks::new();
    let angle = 0.02;
    // Share of the energy that the root takes.
    for (ratio, share) in [(0.5_f64, 0.41667), (2.0, 0.74667), (10.0, 0.93726)] {
        let beta = 0.5 / ratio;
        let mass = DENSITY * DEPTH * DEPTH * ARM;
        for (elements, young, steps) in [(20, 2e14, 500), (40, 2e14, 500), (40, 2e14, 2000), (40, 2e15, 500), (80, 2e14, 1000)] {
            let case = Parkes { ratio, elements, young, steps };
            let summary = case.run(angle);
            let speed = case.speed(angle);
            let tip = (ratio * speed).powi(2) * mass / (3.0 * plastic_moment())
                * (beta / (1.0 + beta) + 2.0 * beta.ln_1p());
            let found = summary.points[0].displacement_max[1].value;
            let what = format!("G/mL {ratio}, {elements} elements {young:e} {steps}:");
            c.relative(format!("{what} tip deflection [m]"), found, tip, 2e-2);
            let arm = &summary.plastic[0];
            println!("{what} {:?}", arm.hinges.iter().filter(|h| h.rotation.abs() > 1e-4).collect::<Vec<_>>());
            println!("   total {} of {:?}", arm.dissipated, summary.energy.initial);
            let root = arm.hinges.first();
            c.relative(format!("{what} root rotation"), or_nan(root.map(|h| h.rotation)), angle, 5e-2);
            let lost = root.map(|h| h.dissipated / arm.dissipated);
            c.relative(format!("{what} root's share of the energy"), or_nan(lost), share, 5e-2);
            balances(&mut c, &what, &summary);
        }
    }
    c.into_vec()
}

/// A velocity on all of a beam of half span 0.5 m, in bending alone: `m V0^2 L^2 / (3 M0)`, half of it between clamps.
pub fn thrown() -> Vec<Check> {
    let mut c = Checks::new();
    use Component::*;
    let half = 0.5;
    let mass = DENSITY * DEPTH * DEPTH;
    let speed = 5.0;
    let whole = mass * speed * speed * half * half / (3.0 * plastic_moment());
    for (name, held, exact) in [
        ("simply supported", vec![Displacement2], whole),
        ("clamped", vec![Displacement2, Rotation], 0.5 * whole),
    ] {
        for (elements, young, steps) in
            [(10, 2e13, 500), (20, 2e13, 500), (40, 2e13, 500), (20, 2e14, 500), (20, 2e13, 2000)]
        {
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
            let model = b.build().expect("a verification case builds");
            // At rest at m V0 L^2 / 2 M0, a beam between clamps after half of that.
            let end = 1.2 * mass * speed * half * half / (2.0 * plastic_moment());
            let settings = Settings::new(end, end / f64::from(steps));
            let mut run = Simulation::new(&model, &settings).expect("sound settings");
            run.set_velocities(|_, x| {
                if x[0] > 1e-9 && x[0] < 2.0 * half - 1e-9 { [0.0, speed] } else { [0.0; 2] }
            });
            let summary = run.run(&mut NoRecorder);
            let found = summary.points[0].displacement_max[1].value;
            let what = format!("{name}, {elements} elements {young:e} {steps}:");
            c.relative(format!("{what} deflection [m]"), found, exact, 2e-2);
            balances(&mut c, &what, &summary);
        }
    }
    c.into_vec()
}
