//! The paper's elastic projectile (section 2.3) and elementary smooth impacts.

use std::f64::consts::PI;

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::*;

/// Limit h -> 0 of the clamped elastic example with 6 elements: an independent implementation of the same equations.
const LIMIT: Figures = Figures {
    displacement: 0.177864203,
    force: 337784.605,
    start: 0.01,
    end: 0.09718568,
    rebound: -19.10077444,
};

/// Compared results of an impact.
struct Figures {
    displacement: f64,
    force: f64,
    start: f64,
    end: f64,
    rebound: f64,
}

fn figures(model: &Model, end: f64, step: f64) -> Figures {
    let summary = run(model, &Settings::new(end, step));
    let (peak, intervals) = smooth(&summary);
    let first = intervals.first();
    Figures {
        displacement: summary.points[0].displacement_max[1].value,
        force: peak.value,
        start: or_nan(first.map(|i| i.start)),
        end: or_nan(first.map(|i| i.end)),
        rebound: summary.projectiles[0].velocity_final[1],
    }
}

/// Values at a step of 1e-4 s, and their second-order convergence to the limit.
pub fn clamped() -> Report {
    let model = paper_beam(6).clamped().struck(paper_elastic()).build();
    let mut c = Checks::new();
    let at = figures(&model, 0.15, 1e-4);
    c.relative("peak displacement [m]", at.displacement, LIMIT.displacement, 2e-5);
    c.relative("peak force [N]", at.force, LIMIT.force, 2e-5);
    c.relative("contact start [s]", at.start, LIMIT.start, 2e-5);
    c.relative("contact end [s]", at.end, LIMIT.end, 2e-5);
    c.relative("rebound velocity [m/s]", at.rebound, LIMIT.rebound, 2e-5);
    let fine = figures(&model, 0.15, 5e-6);
    c.relative("peak displacement, step 5e-6 [m]", fine.displacement, LIMIT.displacement, 1e-8);
    c.relative("peak force, step 5e-6 [N]", fine.force, LIMIT.force, 1e-8);
    c.relative("contact end, step 5e-6 [s]", fine.end, LIMIT.end, 1e-7);
    c.relative("rebound velocity, step 5e-6 [m/s]", fine.rebound, LIMIT.rebound, 2e-8);
    // Coarser steps do not resolve the beam's fastest modes, whose phase makes the error change sign.
    let ladder: Vec<Figures> =
        [2.5e-5, 1.25e-5, 6.25e-6].iter().map(|h| figures(&model, 0.15, *h)).collect();
    for (name, value) in [
        ("peak displacement", (|f: &Figures| f.displacement) as fn(&Figures) -> f64),
        ("peak force", |f| f.force),
        ("contact end", |f| f.end),
        ("rebound velocity", |f| f.rebound),
    ] {
        let d: Vec<f64> = ladder.windows(2).map(|w| value(&w[0]) - value(&w[1])).collect();
        let order = (d[0] / d[1]).abs().log2();
        c.absolute(format!("order of convergence, {name}"), order, 2.0, 0.25);
    }
    c.into_report()
}

/// E3: the same on a converged mesh, both strain measures, and at low velocity.
pub fn converged_mesh() -> Report {
    let mut c = Checks::new();
    let green = paper_beam(384).clamped().struck(paper_elastic());
    let mut engineering = green.clone();
    engineering.strain = StrainMeasure::Engineering;
    let mut slow = green.clone();
    slow.projectiles[0].velocity = [0.0, 0.02];
    slow.projectiles[0].standoff = 2e-4;
    // Meshes of 48 to 384 elements and five integration schemes agree with each other to 1e-6 here, and to 5e-6 with the
    // reference at low velocity; in the large-displacement range the reference itself is off by up to 3.1e-5.
    for (name, beam, force, displacement, rebound, tolerance) in [
        ("Green", green, 337429.1, 0.178100, -19.11234, 5e-5),
        ("engineering", engineering, 336428.1, 0.179258, -19.13891, 5e-5),
        ("slow", slow, 259.022, 3.71063e-4, -0.01957146, 5e-6),
    ] {
        let f = figures(&beam.build(), if name == "slow" { 0.2 } else { 0.12 }, 4e-5);
        c.relative(format!("{name}: peak force [N]"), f.force, force, tolerance);
        c.relative(
            format!("{name}: peak displacement [m]"),
            f.displacement,
            displacement,
            tolerance,
        );
        c.relative(format!("{name}: rebound velocity [m/s]"), f.rebound, rebound, tolerance);
    }
    c.into_report()
}

/// E8: mass and spring against a wall; two free masses.
pub fn elementary() -> Report {
    let mut c = Checks::new();
    let (mass, k, v) = (500.0, 7.5e5, 20.0);
    let wall = paper_beam(1).held().struck(paper_elastic()).build();
    let f = figures(&wall, 0.12, 1e-5);
    c.relative("wall: contact duration [s]", f.end - f.start, PI * f64::sqrt(mass / k), 1e-6);
    c.relative("wall: peak force [N]", f.force, v * f64::sqrt(mass * k), 1e-6);
    c.relative("wall: rebound velocity [m/s]", f.rebound, -v, 1e-10);
    // A free beam that is so stiff that it moves as a rigid body of 900 kg.
    let free = paper_beam(2).young(1e16).struck(paper_elastic()).build();
    let f = figures(&free, 0.12, 1e-5);
    let reduced = 1.0 / (1.0 / mass + 1.0 / 900.0);
    c.relative("free: contact duration [s]", f.end - f.start, PI * (reduced / k).sqrt(), 1e-6);
    c.relative("free: peak force [N]", f.force, v * (reduced * k).sqrt(), 1e-6);
    c.relative("free: velocity of the mass [m/s]", f.rebound, -v * 400.0 / 1400.0, 1e-6);
    c.into_report()
}

/// The unsupported example with large steps for 20 s: the run completes, and energy and momenta are conserved.
pub fn large_steps() -> Report {
    let mut c = Checks::new();
    let model = paper_beam(6).struck(paper_elastic()).build();
    for step in [5e-3, 1e-2] {
        let summary = run(&model, &Settings::new(20.0, step));
        let name = |what: &str| format!("step {step}: {what}");
        c.at_least(name("time reached [s]"), summary.time, 20.0 * (1.0 - 1e-12));
        c.at_most(name("energy residual"), summary.energy.residual_max, 1e-10);
        c.at_most(name("linear momentum residual"), summary.momentum.linear_residual_max, 1e-10);
        c.at_most(name("angular momentum residual"), summary.momentum.angular_residual_max, 1e-10);
    }
    c.into_report()
}
