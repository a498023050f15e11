//! Heated beams: free and held expansion, curvature, buckling, and the work of heat in motion.

use std::f64::consts::PI;

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::{at, or_nan};

/// Young's modulus \[Pa\], thermal expansion \[1/K\], side of the square section and length \[m\], density \[kg/m^3\].
const YOUNG: f64 = 2.1e11;
const EXPANSION: f64 = 12e-6;
const SIDE: f64 = 0.05;
const LENGTH: f64 = 2.0;
const DENSITY: f64 = 7850.0;
/// Area \[m^2\], axial and bending stiffness \[N, N m^2\].
const AREA: f64 = SIDE * SIDE;
const AXIAL: f64 = YOUNG * AREA;
const BENDING: f64 = YOUNG * SIDE * SIDE * SIDE * SIDE / 12.0;

/// A straight bar with supports at its ends, heated along the shares of its length.
fn bar(
    elements: usize,
    supports: [Option<SupportKind>; 2],
    (change, gradient): (f64, f64),
    shares: [f64; 2],
) -> (ModelBuilder, BeamId) {
    let mut b = ModelBuilder::new();
    let material = b.material(Material {
        strain: StrainMeasure::Engineering,
        expansion: EXPANSION,
        ..Material::new("steel", YOUNG, DENSITY)
    });
    let mut section = Section::rectangle("square", SIDE, SIDE);
    section.rotary_inertia = RotaryInertia::Neglected;
    let section = b.section(section);
    let points = [[0.0, 0.0], [LENGTH, 0.0]];
    let beam = b.beam(Beam::new("bar", &points, elements, material, section));
    for (k, kind) in supports.into_iter().enumerate() {
        if let Some(kind) = kind {
            let name = ["left", "right"][k];
            b.support(Support::new(name, at(name, beam, k as f64), kind));
        }
    }
    let stretch = shares.map(Along::Fraction);
    b.load(Load::new("heat", LoadKind::Temperature { beam, stretch, change, gradient }));
    b.record_point(at("middle", beam, 0.5));
    b.record_point(at("end", beam, 1.0));
    (b, beam)
}

fn at_rest(of: &(ModelBuilder, BeamId)) -> Option<Equilibrium> {
    equilibrium(&of.0.build().expect("a verification case builds")).ok()
}

/// Free expansion `alpha DT L`, curvature `alpha DT/h` of a bar free to bend, `N = -EA alpha DT` and `M = EI alpha DT/h` of one that is held.
pub fn heated_bars() -> Report {
    let mut c = Checks::new();
    let (clamp, rise, gradient) = (Some(SupportKind::Clamp), 80.0, 1000.0);
    let whole = [0.0, 1.0];
    let found = at_rest(&bar(4, [clamp.clone(), None], (rise, 0.0), whole));
    let of = |f: &dyn Fn(&Equilibrium) -> f64| or_nan(found.as_ref().map(f));
    let longer = EXPANSION * rise * LENGTH;
    c.relative("free bar: displacement of its end [m]", of(&|e| e.points[1].1[0]), longer, 1e-9);
    let force = of(&|e| e.section_forces[0].axial.largest().value.abs());
    c.absolute("free bar: axial force [N]", force, 0.0, 1e-6 * AXIAL * EXPANSION * rise);

    let found = at_rest(&bar(16, [clamp.clone(), None], (0.0, gradient), whole));
    let of = |f: &dyn Fn(&Equilibrium) -> f64| or_nan(found.as_ref().map(f));
    // The top is hotter: the bar becomes an arc that bends down.
    let curvature = EXPANSION * gradient;
    let angle = curvature * LENGTH;
    let sag = -(1.0 - angle.cos()) / curvature;
    c.relative("bent bar: displacement of its end [m]", of(&|e| e.points[1].1[1]), sag, 1e-7);
    c.relative("bent bar: rotation of its end [rad]", of(&|e| e.rotations[1]), -angle, 1e-7);

    let held = [clamp.clone(), clamp.clone()];
    let found = at_rest(&bar(4, held.clone(), (rise, gradient), whole));
    let of = |f: &dyn Fn(&Equilibrium) -> f64| or_nan(found.as_ref().map(f));
    let forces = |e: &Equilibrium| e.section_forces[0].clone();
    let (normal, moment) = (-AXIAL * EXPANSION * rise, BENDING * curvature);
    c.relative("held bar: least axial force [N]", of(&|e| forces(e).axial.min.value), normal, 1e-9);
    c.relative(
        "held bar: largest axial force [N]",
        of(&|e| forces(e).axial.max.value),
        normal,
        1e-9,
    );
    c.relative("held bar: least moment [N m]", of(&|e| forces(e).moment.min.value), moment, 1e-9);
    c.relative("held bar: largest moment [N m]", of(&|e| forces(e).moment.max.value), moment, 1e-9);
    c.relative("held bar: reaction of the wall [N]", of(&|e| e.reactions[0].1[0]), -normal, 1e-9);
    let stress = normal / AREA - moment * 0.5 * SIDE / (BENDING / YOUNG);
    c.relative(
        "held bar: stress at the top [Pa]",
        of(&|e| e.point_forces[0].stress.top),
        stress,
        1e-9,
    );

    // Half of it is heated: that half is longer by what the other one is compressed.
    let found = at_rest(&bar(4, held, (rise, 0.0), [0.0, 0.5]));
    let of = |f: &dyn Fn(&Equilibrium) -> f64| or_nan(found.as_ref().map(f));
    let axial = of(&|e| forces(e).axial.largest().value);
    c.relative("half heated: axial force [N]", axial, 0.5 * normal, 1e-9);
    let middle = of(&|e| e.points[0].1[0]);
    c.relative("half heated: displacement of the middle [m]", middle, 0.25 * longer, 1e-9);
    c.into_report()
}

/// A pinned bar between walls buckles at `alpha DT = pi^2 I / (A L^2)`, and at half of that its frequency is lower by the root of one half.
pub fn heated_strut() -> Report {
    let mut c = Checks::new();
    let pin = Some(SupportKind::Pin);
    let critical = PI * PI * BENDING / (AXIAL * LENGTH * LENGTH) / EXPANSION;
    let (b, _) = bar(16, [pin.clone(), pin.clone()], (1.0, 0.0), [0.0, 1.0]);
    let model = b.build().expect("a verification case builds");
    let factor = or_nan(buckling(&model, 1).modes.first().map(|mode| mode.factor));
    c.relative("buckling temperature [K]", factor, critical, 1e-5);
    let (b, _) = bar(16, [pin.clone(), pin], (0.5 * critical, 0.0), [0.0, 1.0]);
    let model = b.build().expect("a verification case builds");
    let cold = (PI / LENGTH).powi(2) * (BENDING / (DENSITY * AREA)).sqrt() / (2.0 * PI);
    let first = or_nan(natural_frequencies(&model, 1).first().copied());
    c.relative("frequency of the cold bar [Hz]", first, cold, 1e-5);
    let hot = equilibrium(&model).ok().map(|found| {
        let modes = modes_about_equilibrium(&model, &found, 1);
        modes.first().map_or(f64::NAN, Mode::frequency)
    });
    c.relative("frequency of the hot bar [Hz]", or_nan(hot), cold * 0.5_f64.sqrt(), 1e-3);
    c.into_report()
}

/// Heat in motion: what it does to a held bar is `EA (alpha DT)^2 L / 2`; a bar heated at once at a free end swings to twice its expansion and keeps
/// its energy.
pub fn sudden_heat() -> Report {
    let mut c = Checks::new();
    let rise = 1.0;
    let (clamp, strain) = (SupportKind::Clamp, EXPANSION * rise);
    let energy = 0.5 * AXIAL * strain * strain * LENGTH;
    let wave = LENGTH / (YOUNG / DENSITY).sqrt();

    let held = [Some(clamp.clone()), Some(clamp.clone())];
    let (mut b, beam) = bar(4, held, (rise, 0.0), [0.0, 1.0]);
    // A second load adds to the first: half of the strain is given at once, half slowly.
    let stretch = [0.0, 1.0].map(Along::Fraction);
    let kind = LoadKind::Strain { beam, stretch, strain, curvature: 0.0 };
    let function = TimeFunction::Ramp { duration: wave };
    b.load(Load { function, ..Load::new("more", kind) });
    let model = b.build().expect("a verification case builds");
    let summary = simulate(&model, &Settings::new(2.0 * wave, 0.01 * wave), &mut NoRecorder).ok();
    let of = |f: &dyn Fn(&RunSummary) -> f64| or_nan(summary.as_ref().map(f));
    c.relative("held bar: energy at the start [J]", of(&|s| s.energy.initial), energy, 1e-9);
    c.relative("held bar: work of the heat [J]", of(&|s| s.energy.work_loads), 3.0 * energy, 1e-9);
    c.relative("held bar: energy at the end [J]", of(&|s| s.energy.final_), 4.0 * energy, 1e-9);
    c.at_most("held bar: energy residual", of(&|s| s.energy.residual_max), 1e-10);

    let (b, _) = bar(32, [Some(clamp), None], (rise, 0.0), [0.0, 1.0]);
    let model = b.build().expect("a verification case builds");
    let settings = Settings::new(2.5 * wave, 0.2 / 32.0 * wave);
    let summary = simulate(&model, &settings, &mut NoRecorder).ok();
    let of = |f: &dyn Fn(&RunSummary) -> f64| or_nan(summary.as_ref().map(f));
    let swing = of(&|s| s.points[1].displacement_max[0].value);
    // The kink of the wave front is rounded by a mesh: 0.6 % of 32 elements (independent linear model).
    c.relative("free end: largest displacement [m]", swing, 2.0 * strain * LENGTH, 1e-2);
    c.relative("free end: energy [J]", of(&|s| s.energy.final_), energy, 1e-9);
    c.absolute("free end: work of the heat [J]", of(&|s| s.energy.work_loads), 0.0, 1e-9 * energy);
    c.at_most("free end: energy residual", of(&|s| s.energy.residual_max), 1e-10);
    c.into_report()
}
