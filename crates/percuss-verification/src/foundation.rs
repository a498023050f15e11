//! Beams on Winkler foundations: statics, frequencies, buckling, and a foundation of compression that yields.

use std::f64::consts::PI;

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::{at, or_nan};

/// Bending stiffness \[N m^2\], stiffness of the foundation per length \[N/m^2\], mass per length \[kg/m\].
const BENDING: f64 = 1e6;
const STIFFNESS: f64 = 1e7;
const MASS: f64 = 60.0;

/// A straight beam of that bending stiffness on a foundation, `area` its cross section \[m^2\].
fn founded(
    b: &mut ModelBuilder,
    (length, elements, area): (f64, usize, f64),
    law: FoundationLaw,
    yielding: Option<Plasticity>,
) -> BeamId {
    let (young, inertia) = (1e10, 1e-4);
    assert!((young * inertia / BENDING - 1.0_f64).abs() < 1e-12);
    let material = b.material(Material::new("m", young, MASS / area));
    let mut section = Section::new("s", area, inertia);
    section.rotary_inertia = RotaryInertia::Neglected;
    let section = b.section(section);
    let points = [[0.0, 0.0], [length, 0.0]];
    let beam = b.beam(Beam::new("beam", &points, elements, material, section));
    b.foundation(Foundation {
        name: "ground".into(),
        beam,
        stretch: [Along::Fraction(0.0), Along::Fraction(1.0)],
        direction: None,
        law,
        damping: 0.0,
        yielding,
    });
    beam
}

/// An infinite beam on an elastic foundation under a force (Hetenyi 1946): `w0 = P beta / (2 k)`, `M0 = P / (4 beta)`,
/// `beta^4 = k / (4 EI)`, and `M = -M0 exp(-pi/2)` where it is least.
pub fn infinite_beam() -> Report {
    let mut c = Checks::new();
    // Of a beam of 40 m the ends have no effect (exp(-25)), under so small a force neither have large displacements.
    let (length, force) = (40.0, 100.0);
    let beta = (STIFFNESS / (4.0 * BENDING)).powf(0.25);
    let (w0, m0) = (force * beta / (2.0 * STIFFNESS), force / (4.0 * beta));
    let (mut deflections, mut moments) = (Vec::new(), Vec::new());
    for elements in [80, 160, 320] {
        let mut b = ModelBuilder::new();
        let law = FoundationLaw::Linear { stiffness: STIFFNESS };
        let beam = founded(&mut b, (length, elements, 0.1), law, None);
        let middle = at("middle", beam, 0.5);
        let components = vec![Component::Displacement1];
        b.support(Support::new("guide", middle.clone(), SupportKind::Fix { components }));
        let down = LoadKind::Point {
            at: middle.clone(),
            force: [0.0, -force],
            moment: 0.0,
            follower: false,
        };
        b.load(Load::new("P", down));
        b.record_point(middle);
        let model = b.build().expect("a verification case builds");
        let found = equilibrium(&model).ok();
        let of = |f: &dyn Fn(&Equilibrium) -> f64| or_nan(found.as_ref().map(f));
        let deflection = of(&|e| -e.points[0].1[1]);
        let moment = of(&|e| e.section_forces[0].moment.max.value);
        let size = length / elements as f64;
        deflections.push([size, (deflection / w0 - 1.0).abs()]);
        moments.push([size, (moment / m0 - 1.0).abs()]);
        let carried = of(&|e| e.foundations[0].force[1]);
        c.relative(format!("{elements} elements: reaction [N]"), carried, force, 1e-9);
        if elements < 320 {
            continue;
        }
        // The error of order 4 is 2.5e-6 on this mesh (independent assembly of the same elements).
        c.relative("deflection under the force [m]", deflection, w0, 4e-6);
        c.relative("moment under the force [N m]", moment, m0, 2e-6);
        let least = of(&|e| e.section_forces[0].moment.min.value);
        c.relative("least moment [N m]", least, -m0 * (-0.5 * PI).exp(), 1e-4);
        let shear = of(&|e| e.section_forces[0].shear.largest().value.abs());
        c.relative("shear beside the force [N]", shear, 0.5 * force, 1e-8);
        let energy = of(&|e| e.foundations[0].energy);
        // Three quarters of the work of the force: int k w^2 / 2 ds.
        c.relative("energy in the foundation [J]", energy, 0.375 * force * w0, 1e-5);
    }
    let axes = ["element size [m]", "relative error"];
    let order = c.convergence("Deflection under the force", axes, deflections);
    c.absolute("order of the deflection", order, 4.0, 0.1);
    let order = c.convergence("Moment under the force", axes, moments);
    c.absolute("order of the moment", order, 4.0, 0.2);
    c.into_report()
}

/// Frequencies and buckling of a pinned beam on an elastic foundation (Hetenyi 1946): `omega^2 = (EI (n pi / L)^4 + k) / (rho A)`,
/// `P = EI (m pi / L)^2 + k (L / (m pi))^2`, least over m.
pub fn frequencies_and_buckling() -> Report {
    let mut c = Checks::new();
    let length = 10.0;
    // The axial strain at buckling is 6e-6.
    let area = 100.0;
    let mut b = ModelBuilder::new();
    let law = FoundationLaw::Linear { stiffness: STIFFNESS };
    let beam = founded(&mut b, (length, 80, area), law, None);
    b.support(Support::new("left", at("left", beam, 0.0), SupportKind::Pin));
    let rolls = SupportKind::Roller { direction: [1.0, 0.0] };
    b.support(Support::new("right", at("right", beam, 1.0), rolls));
    let force = 1e6;
    let end = at("end", beam, 1.0);
    let push = LoadKind::Point { at: end, force: [-force, 0.0], moment: 0.0, follower: false };
    b.load(Load::new("P", push));
    let model = b.build().expect("a verification case builds");
    let found = natural_frequencies(&model, 2);
    for (n, expected) in [(1, 65.006_371_38), (2, 65.479_106_19)] {
        let closed = (BENDING * (n as f64 * PI / length).powi(4) + STIFFNESS) / MASS;
        let closed = closed.sqrt() / (2.0 * PI);
        c.relative(format!("closed form of mode {n} [Hz]"), closed, expected, 1e-9);
        c.relative(format!("frequency of mode {n} [Hz]"), found[n - 1], closed, 1e-8);
    }
    let load = |m: f64| {
        let k = m * PI / length;
        BENDING * k * k + STIFFNESS / (k * k)
    };
    let least = (1..20).map(|m| load(f64::from(m))).fold(f64::INFINITY, f64::min);
    let factor = buckling(&model, 1).modes.first().map(|mode| mode.factor);
    c.relative("buckling load, six half waves [N]", or_nan(factor) * force, least, 1e-4);
    c.into_report()
}

/// A beam that falls without turning on a foundation of compression that yields, per length: the kinetic energy goes into the elastic energy
/// `p^2 / (2 k)`, which throws it back, and the plastic work `p w`.
pub fn yielding_drop() -> Report {
    let mut c = Checks::new();
    let (length, speed, limit) = (2.0, 1.0, 2e4);
    let mut b = ModelBuilder::new();
    let law = FoundationLaw::Compression { stiffness: STIFFNESS, gap: 0.0 };
    let curve = vec![Hardening { from: 0.0, stress: limit, modulus: 0.0 }];
    let yielding = Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain: None };
    founded(&mut b, (length, 4, 0.1), law, Some(yielding));
    let velocity = [0.0, -speed];
    b.initial_motion(InitialMotion { velocity, spin: 0.0, about: [0.0; 2] });
    let model = b.build().expect("a verification case builds");
    let (kinetic, elastic) = (0.5 * MASS * speed * speed, 0.5 * limit * limit / STIFFNESS);
    let plastic = (kinetic - elastic) / limit;
    let settings = Settings::new(0.02, 1e-5);
    let mut run = Simulation::new(&model, &settings).expect("valid settings");
    let mut deepest = 0.0_f64;
    while run.state().step < run.step_count() && run.advance(&mut NoRecorder).is_ok() {
        deepest = deepest.max(-run.state().displacement[0][1]);
    }
    let whole = limit / STIFFNESS + plastic;
    c.relative("largest deflection [m]", deepest, whole, 1e-4);
    let thrown = run.state().velocity[0][1];
    c.relative("velocity afterwards [m/s]", thrown, (2.0 * elastic / MASS).sqrt(), 1e-5);
    let summary = simulate(&model, &settings, &mut NoRecorder).ok();
    let of = |f: &dyn Fn(&RunSummary) -> f64| or_nan(summary.as_ref().map(f));
    let ground = |f: &dyn Fn(&FoundationSummary) -> f64| of(&|s| f(&s.foundations[0]));
    c.relative("plastic deflection [m]", ground(&|f| f.plastic.value), plastic, 1e-4);
    c.relative("largest reaction [N/m]", ground(&|f| f.pressure.max.value), limit, 1e-9);
    c.absolute("least reaction [N/m]", ground(&|f| f.pressure.min.value), 0.0, 1e-6);
    c.relative("lifted off [m]", ground(&|f| f.lifted.value), length, 1e-9);
    c.relative("dissipated [J]", of(&|s| s.energy.plastic), length * plastic * limit, 1e-4);
    let stored = ground(&|f| f.energy_max.value);
    c.relative("largest stored energy [J]", stored, length * elastic, 1e-4);
    c.at_most("energy residual", of(&|s| s.energy.residual_max), 1e-10);
    c.at_most("linear momentum residual", of(&|s| s.momentum.linear_residual_max), 1e-10);
    c.into_report()
}
