//! Beams without contact: frequencies and large free motion.

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::*;

/// B: natural frequencies of the paper's beam, six Hermite elements with rotary inertia.
pub fn frequencies() -> Report {
    let mut c = Checks::new();
    let clamp = || SupportKind::Clamp;
    let pin = || SupportKind::Pin;
    for (name, supports, expected) in [
        (
            "clamped-clamped",
            vec![(0.0, clamp()), (1.0, clamp())],
            [9.32078456, 25.69662046, 50.51370237],
        ),
        ("pinned-pinned", vec![(0.0, pin()), (1.0, pin())], [4.11129329, 16.43515175, 37.01083415]),
        ("cantilever", vec![(0.0, clamp())], [1.46492265, 9.17093792, 25.66618639]),
    ] {
        let mut beam = paper_beam(6);
        beam.supports = supports;
        let found = natural_frequencies(&beam.build(), 3);
        for (k, f) in expected.into_iter().enumerate() {
            // The source has eight decimals.
            c.absolute(
                format!("{name}, mode {} [Hz]", k + 1),
                or_nan(found.get(k).copied()),
                f,
                1e-8 * f.max(1.0),
            );
        }
    }
    c.into_report()
}

/// C2: a beam thrown by a force and a torque at its end (Simo and Vu-Quoc 1986): invariants of its free flight.
pub fn flying_beam() -> Report {
    let mut c = Checks::new();
    for (name, strain, angular, ends) in [
        ("Green", StrainMeasure::Green, -229.983, [[5.045580, 4.474242], [3.570129, 6.093238]]),
        (
            "engineering",
            StrainMeasure::Engineering,
            -229.506,
            [[4.961946, 4.476356], [3.582826, 6.111070]],
        ),
    ] {
        let model = thrown(strain).build();
        let settings = Settings::new(10.0, 2.5e-3);
        let mut simulation = Simulation::new(&model, &settings).expect("valid settings");
        let mut loaded = None;
        while simulation.state().step < simulation.step_count() {
            simulation.advance(&mut NoRecorder).expect("the beam flies");
            if simulation.state().step == 1000 {
                loaded = Some((simulation.state().clone(), *simulation.measures()));
            }
        }
        let (at_end_of_load, m0) = loaded.expect("the load ends at 2.5 s");
        let m1 = *simulation.measures();
        let name = |what: &str| format!("{name}: {what}");
        // The reference converges at first order (0.3 %).
        c.relative(name("angular momentum [kg m^2/s]"), m0.angular, angular, 3e-3);
        let relative = |a: f64, b: f64| (a - b).abs() / b.abs();
        c.at_most(name("angular momentum kept"), relative(m1.angular, m0.angular), 1e-11);
        c.at_most(name("energy kept"), relative(m1.total(), m0.total()), 1e-11);
        c.absolute(name("momentum 1 [kg m/s]"), m1.linear[0], 20.0, 1e-9);
        c.absolute(name("momentum 2 [kg m/s]"), m1.linear[1], 0.0, 1e-9);
        let centre = centre_of_mass(simulation.state());
        c.absolute(name("centre of mass 1 at 10 s [m]"), centre[0], 20.5, 1e-9);
        c.absolute(name("centre of mass 2 at 10 s [m]"), centre[1], 4.0, 1e-9);
        for (node, which) in [(32, "loaded end"), (0, "other end")] {
            let u = at_end_of_load.displacement[node];
            let x = if node == 0 { [0.0, 8.0] } else { [6.0, 0.0] };
            let expected = if node == 0 { ends[1] } else { ends[0] };
            for i in 0..2 {
                let what = format!("{which}, component {} at 2.5 s [m]", i + 1);
                c.absolute(name(&what), x[i] + u[i], expected[i], 5e-3);
            }
        }
    }
    c.into_report()
}

fn thrown(strain: StrainMeasure) -> Single {
    let mut beam = paper_beam(32);
    beam.points = [[0.0, 8.0], [6.0, 0.0]];
    beam.young = 1e4;
    beam.density = 1.0;
    beam.area = 1.0;
    beam.inertia = 0.01;
    beam.rotary = RotaryInertia::Given(10.0);
    beam.strain = strain;
    let at = PointRef { label: String::new(), beam: dummy_beam(), along: Along::Fraction(1.0) };
    let kind = LoadKind::Point { at, force: [8.0, 0.0], moment: -80.0, follower: false };
    beam.loads.push((1.0, Load { from: 0.0, until: 2.5, ..Load::new("throw", kind) }));
    beam
}

/// A placeholder that is replaced when the structure is built.
fn dummy_beam() -> BeamId {
    let mut b = ModelBuilder::new();
    let strain = StrainMeasure::Green;
    let material = b.material(Material { strain, ..Material::new("", 1.0, 1.0) });
    let rotary_inertia = RotaryInertia::Density;
    let section = b.section(Section { rotary_inertia, ..Section::new("", 1.0, 1.0) });
    b.beam(Beam::new("", &[], 1, material, section))
}

/// Centre of mass of the thrown beam (uniform Hermite elements of equal length).
fn centre_of_mass(state: &State) -> [f64; 2] {
    let n = state.displacement.len() - 1;
    let h = 10.0 / n as f64;
    let mut sum = [3.0, 4.0];
    for w in state.displacement.windows(2) {
        for i in 0..2 {
            // Integral of a cubic over its element, as a share of the length.
            let mean = 0.5 * (w[0][i] + w[1][i]) + h / 12.0 * (w[0][2 + i] - w[1][2 + i]);
            sum[i] += mean / n as f64;
        }
    }
    sum
}
