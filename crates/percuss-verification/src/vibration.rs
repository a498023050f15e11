//! Published natural frequencies.

use std::f64::consts::{PI, TAU};

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::{at, or_nan};

fn simply_supported(b: &mut ModelBuilder, beam: BeamId) {
    b.support(Support::new("left", at("left", beam, 0.0), SupportKind::Pin));
    let roller = SupportKind::Roller { direction: [1.0, 0.0] };
    b.support(Support::new("right", at("right", beam, 1.0), roller));
}

/// B1: a simply supported beam (ANSYS VM50).
pub fn simple_beam() -> Report {
    let mut c = Checks::new();
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 30e6, 728e-6));
    let mut section = Section::new("s", 4.0, 4.0 / 3.0);
    section.rotary_inertia = RotaryInertia::Neglected;
    let section = b.section(section);
    let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [80.0, 0.0]], 24, material, section));
    simply_supported(&mut b, beam);
    let found = natural_frequencies(&b.build().expect("a verification case builds"), 1);
    let exact = PI / 2.0 / 6400.0 * f64::sqrt(30e6 * 4.0 / 3.0 / (728e-6 * 4.0));
    c.relative("closed form [Hz]", exact, 28.766, 2e-5);
    c.relative("lowest frequency [Hz]", or_nan(found.first().copied()), exact, 1e-6);
    c.into_report()
}

/// B2: a simply supported bar under compression (ANSYS VM59): modes about a loaded equilibrium.
pub fn compressed_bar() -> Report {
    let mut c = Checks::new();
    let published = [17.055, 105.32, 249.39];
    let exact = [17.05581, 105.3258, 249.39453];
    // Stiffer along its axis by `stiff`, the bar is strained less by its load: 3.3e-4 at 1, amplified near buckling by
    // P / (2 (Pcr - P)) = 0.92 and the change of length and stretch; the closed form neglects this strain.
    for (stiff, tolerance) in [(1.0, 7e-4), (1e4, 1e-5)] {
        for (name, strain) in
            [("Green", StrainMeasure::Green), ("engineering", StrainMeasure::Engineering)]
        {
            let mut b = ModelBuilder::new();
            let (young, density) = (30e6, 727_973e-9 / stiff);
            let material =
                b.material(Material { strain, ..Material::new("steel", young, density) });
            let mut section = Section::new("s", 4.0 * stiff, 4.0 / 3.0);
            section.rotary_inertia = RotaryInertia::Neglected;
            let section = b.section(section);
            let ends = [[0.0, 0.0], [80.0, 0.0]];
            let beam = b.beam(Beam::new("bar", &ends, 32, material, section));
            simply_supported(&mut b, beam);
            let force = [-40_000.0, 0.0];
            let at = at("end", beam, 1.0);
            b.load(Load::new("load", LoadKind::Point { at, force, moment: 0.0, follower: false }));
            let model = b.build().expect("a verification case builds");
            let modes = equilibrium(&model)
                .map_or_else(|_| Vec::new(), |found| modes_about(&model, &found.state, 3));
            for k in 0..3 {
                let f = or_nan(modes.get(k).map(Mode::frequency));
                let what = format!("{name}, EA x {stiff}, mode {} [Hz]", k + 1);
                c.relative(what, f, exact[k], tolerance);
            }
        }
    }
    for k in 0..3 {
        c.relative(format!("closed form, mode {} [Hz]", k + 1), exact[k], published[k], 1e-4);
    }
    c.into_report()
}

/// B3: axial frequencies of a free rod (ANSYS VM61): n c / (2 L).
pub fn free_rod() -> Report {
    let mut c = Checks::new();
    // c/(2 L) = 126.70 Hz with steel and L = 800 in.
    let (young, density, length) = (30e6, 730e-6, 800.0_f64);
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", young, density));
    let section = b.section(Section::new("s", 1.0, 1.0 / 12.0));
    let beam = b.beam(Beam::new("rod", &[[0.0, 0.0], [length, 0.0]], 24, material, section));
    // Its transverse motion is fixed.
    let components = vec![Component::Displacement2, Component::Rotation];
    for k in 0..=24 {
        let f = f64::from(k) / 24.0;
        let kind = SupportKind::Fix { components: components.clone() };
        b.support(Support::new(format!("guide{k}"), at("guide", beam, f), kind));
    }
    let found = natural_frequencies(&b.build().expect("a verification case builds"), 3);
    let exact = f64::sqrt(young / density) / (2.0 * length);
    c.absolute("rigid motion [Hz]", or_nan(found.first().copied()), 0.0, 1e-6 * exact);
    for (k, published) in [(1, 126.70), (2, 253.40)] {
        let f = or_nan(found.get(k).copied());
        c.relative(format!("axial mode {k}, published [Hz]"), f, published, 1e-4);
        c.relative(format!("axial mode {k} [Hz]"), f, exact * k as f64, 1e-6);
    }
    c.into_report()
}

/// Clamped, free, pinned: beta L of slender beams, with modes of all beams of a frame together.
pub fn slender_beams() -> Report {
    let mut c = Checks::new();
    for (name, left, right, roots) in [
        (
            "clamped-clamped",
            Some(SupportKind::Clamp),
            Some(SupportKind::Clamp),
            [4.730_040_74, 7.853_204_62, 10.995_607_84],
        ),
        ("free-free", None, None, [4.730_040_74, 7.853_204_62, 10.995_607_84]),
        ("cantilever", Some(SupportKind::Clamp), None, [1.875_104_07, 4.694_091_13, 7.854_757_44]),
    ] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", 2e9, 3e3));
        let mut section = Section::new("s", 0.1, 8.33e-5);
        section.rotary_inertia = RotaryInertia::Neglected;
        let section = b.section(section);
        let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [3.0, 0.0]], 48, material, section));
        for (end, f, kind) in [("left", 0.0, left), ("right", 1.0, right)] {
            if let Some(kind) = kind {
                b.support(Support::new(end, at(end, beam, f), kind));
            }
        }
        let model = b.build().expect("a verification case builds");
        let found: Vec<f64> =
            natural_frequencies(&model, 8).into_iter().filter(|f| *f > 1e-3).collect();
        for (k, root) in roots.into_iter().enumerate() {
            let exact = (root / 3.0_f64).powi(2) / TAU * f64::sqrt(2e9 * 8.33e-5 / 300.0);
            let f = or_nan(found.get(k).copied());
            c.relative(format!("{name}, mode {} [Hz]", k + 1), f, exact, 2e-6);
        }
    }
    c.into_report()
}
