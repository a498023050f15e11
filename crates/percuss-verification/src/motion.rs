//! Large motion under prescribed rotation and gravity.

use std::f64::consts::PI;

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::at;

/// Angle of the root of the spin-up manoeuvre \[rad\].
pub fn root_angle(t: f64) -> f64 {
    if t < 15.0 {
        0.4 * (0.5 * t * t + (7.5 / PI).powi(2) * ((2.0 * PI * t / 15.0).cos() - 1.0))
    } else {
        6.0 * t - 45.0
    }
}

/// A clamp at the start of a beam that turns by [`root_angle`].
pub fn turning_root(arm: BeamId) -> Support {
    let function = TimeFunction::function(root_angle);
    let motion = Some(Motion { displacement: [0.0; 2], rotation: 1.0, function });
    Support { motion, ..Support::new("root", at("root", arm, 0.0), SupportKind::Clamp) }
}

/// C1: spin-up of a beam (Simo and Vu-Quoc 1986; ANSYS VM258).
pub fn spin_up() -> Report {
    let mut c = Checks::new();
    // Steady stretch: tan(kL)/k - L with k^2 = rhoA w^2 / EA, and its counterpart in Green strains.
    for (name, strain, steady) in [
        ("Green", StrainMeasure::Green, 5.142_698_46e-4),
        ("engineering", StrainMeasure::Engineering, 5.143_174_55e-4),
    ] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material { strain, ..Material::new("m", 2.8e7, 1.2) });
        let mut section = Section::new("s", 1.0, 5e-4);
        section.rotary_inertia = RotaryInertia::Given(6e-4);
        let section = b.section(section);
        let arm = b.beam(Beam::new("arm", &[[0.0, 0.0], [10.0, 0.0]], 16, material, section));
        b.support(turning_root(arm));
        let model = b.build().expect("a verification case builds");
        let mut run = Simulation::new(&model, &Settings::new(20.0, 1e-2)).expect("valid settings");
        let (mut axial, mut across) = ((0.0, 0.0), (0.0, 0.0));
        let (mut sum, mut count, mut residual) = (0.0, 0.0, 0.0_f64);
        while run.state().step < run.step_count() {
            if run.advance(&mut NoRecorder).is_err() {
                sum = f64::NAN;
                break;
            }
            let state = run.state();
            let (u, t) = (state.displacement[16], state.time);
            let (sine, cosine) = root_angle(t).sin_cos();
            let x = [10.0 + u[0], u[1]];
            let along = cosine * x[0] + sine * x[1] - 10.0;
            let off = cosine * x[1] - sine * x[0];
            if along < axial.0 {
                axial = (along, t);
            }
            if off < across.0 {
                across = (off, t);
            }
            if t > 15.0 {
                (sum, count) = (sum + along, count + 1.0);
            }
            let ledger = &state.ledger;
            residual =
                residual.max((ledger.energy_residual(run.measures()) / ledger.energy_scale).abs());
        }
        let name = |what: &str| format!("{name}: {what}");
        // References of an independent method; published: -.019 at 6.7 s, -.575 at 6.85 s, 5.14e-4.
        c.relative(name("least axial displacement [m]"), axial.0, -0.018_830, 1e-3);
        c.absolute(name("its time [s]"), axial.1, 6.741, 1e-2);
        c.relative(name("least transverse displacement [m]"), across.0, -0.573_951, 1e-3);
        c.absolute(name("its time [s]"), across.1, 6.762, 1e-2);
        // The remaining vibration shortens the mean slightly.
        c.relative(name("steady stretch [m]"), sum / count, steady, 1e-3);
        c.at_most(name("energy residual"), residual, 1e-10);
    }
    c.into_report()
}

/// C4: a pendulum of large swing (ANSYS VM91): a mass on a stiff, nearly massless bar; period by elliptic integral.
pub fn pendulum() -> Report {
    let mut c = Checks::new();
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("light", 3e12, 1e-9));
    let section = b.section(Section::new("s", 1.0, 1.0));
    let bar = b.beam(Beam::new("bar", &[[0.0, 0.0], [60.0, -80.0]], 1, material, section));
    b.support(Support::new("pivot", at("pivot", bar, 0.0), SupportKind::Pin));
    let at = at("bob", bar, 1.0);
    b.point_mass(PointMass { name: "bob".into(), at, mass: 0.5, rotary_inertia: 0.0 });
    let acceleration = [0.0, -386.0];
    b.load(Load::new("weight", LoadKind::Gravity { acceleration }));
    let model = b.build().expect("a verification case builds");
    let mut run = Simulation::new(&model, &Settings::new(3.5, 2.5e-4)).expect("valid settings");
    let (mut before, mut period, mut residual) = ((0.0, 0.0), f64::NAN, 0.0_f64);
    while run.state().step < run.step_count() {
        if run.advance(&mut NoRecorder).is_err() {
            break;
        }
        let state = run.state();
        let (t, v) = (state.time, state.velocity[1][0]);
        // It moves to the left and back: it is at rest again when the horizontal velocity passes zero downwards.
        if before.1 > 0.0 && v <= 0.0 {
            period = before.0 + (t - before.0) * before.1 / (before.1 - v);
        }
        before = (t, v);
        let ledger = &state.ledger;
        residual =
            residual.max((ledger.energy_residual(run.measures()) / ledger.energy_scale).abs());
    }
    c.relative("period [s], published 3.28284", period, 3.282_844_15, 1e-6);
    c.at_most("energy residual", residual, 1e-10);
    c.into_report()
}
