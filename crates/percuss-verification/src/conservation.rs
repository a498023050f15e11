//! Conservation: energy and momentum balances, invariances.

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::*;

macro_rules! paper_scenarios {
    ($($name:literal),* $(,)?) => {
        /// The paper's examples, copies of `scenarios/paper/` in the crate: name and text.
        const PAPER: &[(&str, &str)] =
            &[$(($name, include_str!(concat!("../scenarios/", $name, ".toml")))),*];
    };
}

paper_scenarios![
    "elastic-clamped",
    "elastic-pinned",
    "elastic-free",
    "rigid-clamped-e1",
    "rigid-clamped-e0.5",
    "rigid-clamped-e0",
    "rigid-free-e1",
    "rigid-free-e0.5",
    "rigid-free-e0",
    "elastic-clamped-paper",
    "elastic-pinned-paper",
    "elastic-free-paper",
    "rigid-clamped-e1-paper",
    "rigid-clamped-e0.5-paper",
    "rigid-clamped-e0-paper",
    "rigid-free-e1-paper",
    "rigid-free-e0.5-paper",
    "rigid-free-e0-paper",
];

fn paper_run(text: &str) -> RunSummary {
    let compiled = percuss_scenario::read(text, "scenarios/paper")
        .and_then(|scenario| scenario.compile())
        .expect("the scenarios of the paper are valid");
    run(&compiled.model, &compiled.settings)
}

/// Energy and momenta in every scenario of `scenarios/paper/`, including opening and closing of contacts.
pub fn paper_balances() -> Report {
    let mut c = Checks::new();
    for (name, text) in PAPER {
        let summary = paper_run(text);
        let reached = f64::from(u8::from(completed(&summary)));
        c.at_least(format!("{name}: completed"), reached, 1.0);
        let energy = summary.energy.residual_max;
        if name.starts_with("elastic") && name.ends_with("-paper") {
            // The midpoint force has an energy error in the opening and closing steps, and only there.
            c.at_least(format!("{name}: energy residual (midpoint force errs)"), energy, 1e-9);
            c.at_most(format!("{name}: energy residual"), energy, 1e-5);
        } else {
            c.at_most(format!("{name}: energy residual"), energy, 1e-10);
        }
        let m = summary.momentum;
        c.at_most(format!("{name}: linear momentum residual"), m.linear_residual_max, 1e-10);
        c.at_most(format!("{name}: angular momentum residual"), m.angular_residual_max, 1e-10);
    }
    c.into_report()
}

/// The paper's forms have energy errors in opening and closing steps and for contact in whole steps.
pub fn paper_forms() -> Report {
    let mut c = Checks::new();
    let text = |wanted: &str| PAPER.iter().find(|(name, _)| *name == wanted).map_or("", |p| p.1);
    let mut midpoint = paper_beam(6).clamped().struck(paper_elastic());
    midpoint.projectiles[0].kind = ProjectileKind::Elastic {
        law: SmoothLaw {
            force: ContactForce::Midpoint,
            ..SmoothLaw::elastic(Potential::Linear { stiffness: 7.5e5 })
        },
    };
    let energy = run(&midpoint.build(), &Settings::new(0.15, 1e-4)).energy.residual_max;
    c.relative("midpoint force: energy residual", energy, 2.8e-7, 0.05);
    let rigid = paper_run(text("rigid-clamped-e1-paper"));
    c.absolute("time-stepping at 1e-5 s: impacts", impacts(&rigid).len() as f64, 2.0, 0.0);
    // The last bit of the gap decides whether the first contact is in step 50 or 51; it is in step 51 of the independent implementation, and here
    // with a gap wider by 1e-8 m.
    let mut late = paper_rigid(1.0);
    late.standoff += 1e-8;
    let settings = Settings {
        scheme: Scheme::StrainRate,
        impacts: ImpactResolution::TimeStepping { closed_tolerance: 1e-9 },
        ..Settings::new(0.02, 1e-5)
    };
    let late = run(&paper_beam(6).young(0.2e12).clamped().struck(late).build(), &settings);
    c.absolute("seen one step later: impacts", impacts(&late).len() as f64, 2.0, 0.0);
    let end = late.projectiles[0].velocity_final[1];
    c.relative("seen one step later: velocity after [m/s]", end, 16.07, 2e-4);
    c.into_report()
}

/// Trap 4: of the stored strains only the bending strain drifts from the configuration, with the square of the step.
pub fn strain_history() -> Report {
    let mut c = Checks::new();
    let model = paper_beam(6).struck(paper_elastic()).build();
    let drift = |step: f64| {
        let settings = Settings { scheme: Scheme::StrainRate, ..Settings::new(0.15, step) };
        run(&model, &settings).audit
    };
    let (coarse, fine) = (drift(1e-4), drift(5e-5));
    let ratio = coarse.curvature_drift_max / fine.curvature_drift_max;
    c.absolute("curvature drift: ratio, step halved", ratio, 4.0, 0.2);
    c.at_least("curvature drift at 1e-4 s [1/m]", coarse.curvature_drift_max, 1e-9);
    c.at_most("membrane drift", coarse.membrane_drift_max, 1e-13);
    let invariant = run(&model, &Settings::new(0.15, 1e-4)).audit.curvature_drift_max;
    c.at_most("invariant scheme: curvature drift [1/m]", invariant, 0.0);
    c.into_report()
}

/// With reversed velocities the motion returns to its start: compliant contact, and restitution 1.
pub fn time_reversal() -> Report {
    let mut c = Checks::new();
    let elastic = paper_beam(6).struck(paper_elastic()).build();
    let rigid = paper_beam(6).young(0.2e12).struck(paper_rigid(1.0)).build();
    // In the reversed motion the pulse of an impact is not in the middle of its step: the times of impact differ by the tolerance of their
    // location, 1e-9 steps.
    for (name, model, end, step, tolerance) in
        [("elastic", elastic, 0.1, 1e-4, 1e-9), ("rigid", rigid, 0.001, 1e-6, 1e-6)]
    {
        let settings = Settings::new(end, step);
        let mut simulation = Simulation::new(&model, &settings).expect("valid settings");
        for _ in 0..2 {
            while simulation.state().step < simulation.step_count() {
                simulation.advance(&mut NoRecorder).expect("the run completes");
            }
            simulation.reverse();
        }
        let state = simulation.state();
        let largest =
            |nodal: &[[f64; 4]]| nodal.as_flattened().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        c.absolute(
            format!("{name}: displacement [m]"),
            largest(&state.displacement),
            0.0,
            tolerance,
        );
        // Displacement and velocity of the projectile, after those of the beam's nodes.
        let node = state.displacement.len() - 1;
        let travel = state.displacement[node][1];
        c.absolute(format!("{name}: travel of the projectile [m]"), travel, 0.0, tolerance);
        let (speed, initial) =
            (state.velocity[node][1].abs(), if name == "elastic" { 20.0 } else { 40.0 });
        c.relative(format!("{name}: speed of the projectile [m/s]"), speed, initial, tolerance);
    }
    c.into_report()
}

/// A rotated and translated scene gives the same run.
pub fn rigid_motion() -> Report {
    let mut c = Checks::new();
    let (angle, shift) = (0.7_f64, [3.0, -5.0]);
    let turn = |v: [f64; 2]| {
        let (s, k) = angle.sin_cos();
        [k * v[0] - s * v[1], s * v[0] + k * v[1]]
    };
    let mut off_centre = paper_elastic();
    off_centre.at = 0.3;
    let plain = paper_beam(6).clamped().struck(off_centre.clone());
    let mut moved = plain.clone();
    moved.points = plain.points.map(|p| {
        let q = turn(p);
        [q[0] + shift[0], q[1] + shift[1]]
    });
    moved.projectiles[0].velocity = turn(off_centre.velocity);
    let settings = Settings::new(0.15, 1e-4);
    let (a, b) = (run(&plain.build(), &settings), run(&moved.build(), &settings));
    let speed = |s: &RunSummary| {
        s.projectiles[0].velocity_final[0].hypot(s.projectiles[0].velocity_final[1])
    };
    c.relative("speed after [m/s]", speed(&b), speed(&a), 1e-9);
    c.relative("peak force [N]", smooth(&b).0.value, smooth(&a).0.value, 1e-9);
    for (name, s) in [("as given", &a), ("turned and moved", &b)] {
        c.at_most(format!("{name}: energy residual"), s.energy.residual_max, 1e-10);
        let m = s.momentum;
        c.at_most(format!("{name}: linear momentum residual"), m.linear_residual_max, 1e-10);
        c.at_most(format!("{name}: angular momentum residual"), m.angular_residual_max, 1e-10);
    }
    c.into_report()
}

/// The struck point may lie inside an element: 0.5 of a 7-element beam against a node of an 8-element one.
pub fn contact_point() -> Report {
    let mut c = Checks::new();
    let settings = Settings::new(0.12, 1e-4);
    let result = |elements: usize, at: f64| {
        let mut shot = paper_elastic();
        shot.at = at;
        let summary = run(&paper_beam(elements).clamped().struck(shot).build(), &settings);
        (smooth(&summary).0.value, summary.projectiles[0].velocity_final[1])
    };
    let node = result(8, 0.5);
    let inside = result(7, 0.5);
    // Mesh error at this size: 1.1e-3 between 6 elements and the limit (E3), less for 7 and 8.
    c.relative("peak force [N]", inside.0, node.0, 1e-3);
    c.relative("rebound velocity [m/s]", inside.1, node.1, 1e-3);
    // The result is smooth where the struck point passes a node that is not at midspan: with 8 elements the node at 3/8.
    let (left, at, right) = (result(8, 0.375 - 1e-7), result(8, 0.375), result(8, 0.375 + 1e-7));
    c.relative("just left of a node: peak force [N]", left.0, at.0, 1e-6);
    c.relative("just right of a node: peak force [N]", right.0, at.0, 1e-6);
    c.at_least("and yet not the same point", (left.0 - right.0).abs() / at.0, 1e-12);
    c.into_report()
}

/// The same input gives the same bits.
pub fn same_bits() -> Report {
    let mut c = Checks::new();
    let model = paper_beam(6).young(0.2e12).clamped().struck(paper_rigid(0.5)).build();
    let record = || {
        let mut memory = MemoryRecorder::default();
        simulate(&model, &Settings::new(0.02, 1e-5), &mut memory).expect("valid settings");
        memory.values
    };
    let (a, b) = (record(), record());
    let differing = a.iter().zip(&b).filter(|(x, y)| x.to_bits() != y.to_bits()).count();
    c.absolute("values that differ", (differing + a.len().abs_diff(b.len())) as f64, 0.0, 0.0);
    c.at_least("values compared", a.len() as f64, 1e4);
    c.into_report()
}
