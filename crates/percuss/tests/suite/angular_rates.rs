//! The two accounts of how sections turn: their own angular rates, whose energy is conserved, and the velocities of the slopes.

use percuss::*;

/// Simo and Vu-Quoc's beam (1986), thrown and spun by a force and a moment at one end for 2.5 s: EA = 1e4 N, EI = 100 N m^2, 1 kg/m, rotary inertia
/// 10 kg m, ten elements of 1 m.
fn thrown() -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("benchmark", 1e4, 1.0));
    let rotary_inertia = RotaryInertia::Given(ROTARY);
    let section = b.section(Section { rotary_inertia, ..Section::new("bar", 1.0, 0.01) });
    let rod = b.beam(Beam::new("rod", &[[0.0, 8.0], [6.0, 0.0]], 10, material, section));
    let end = PointRef { label: "end".into(), beam: rod, along: Along::Fraction(1.0) };
    let kind = LoadKind::Point { at: end, force: [8.0, 0.0], moment: -80.0, follower: false };
    b.load(Load { until: 2.5, ..Load::new("throw", kind) });
    b.build().unwrap()
}

/// Rotary inertia \[kg m\].
const ROTARY: f64 = 10.0;
/// Direction of the rod at rest, from (0, 8) to (6, 0).
const ALONG: [f64; 2] = [0.6, -0.8];

/// Hermite's cubics on an element of 1 m and their derivatives, at a share of its length.
fn cubics(x: f64) -> [[f64; 4]; 2] {
    let (y, xx) = (1.0 - x, x * x);
    [
        [y * y * (1.0 + 2.0 * x), x * y * y, xx * (3.0 - 2.0 * x), -xx * y],
        [-6.0 * x * y, y * (1.0 - 3.0 * x), 6.0 * x * y, x * (3.0 * x - 2.0)],
    ]
}

fn sum(shape: [f64; 4], two: &[[f64; 4]], i: usize) -> f64 {
    shape[0] * two[0][i]
        + shape[1] * two[0][2 + i]
        + shape[2] * two[1][i]
        + shape[3] * two[1][2 + i]
}

/// Kinetic energy by the velocities of the nodes and the angular rates of the sections, and by the velocities of the nodes alone, from a
/// quadrature of its own \[J\].
fn kinetic(state: &State) -> [f64; 2] {
    // Four Gauss points integrate the square of a cubic exactly; three carry the rotary inertia.
    let four = [
        (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
        (0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
    ];
    let four =
        four.into_iter().flat_map(|(x, w)| [(0.5 - 0.5 * x, 0.5 * w), (0.5 + 0.5 * x, 0.5 * w)]);
    let d = 0.5 * 0.6_f64.sqrt();
    let three = [(0.5 - d, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + d, 5.0 / 18.0)];
    let (mut both, mut nodes) = (0.0, 0.0);
    for (e, spin) in state.spin.iter().enumerate() {
        let (u, v) = (&state.displacement[e..e + 2], &state.velocity[e..e + 2]);
        for (x, w) in four.clone() {
            let square: f64 = (0..2).map(|i| sum(cubics(x)[0], v, i).powi(2)).sum();
            both += 0.5 * w * square;
            nodes += 0.5 * w * square;
        }
        for ((x, w), omega) in three.iter().zip(spin) {
            let [g, r] = [u, v].map(|two| [0, 1].map(|i| sum(cubics(*x)[1], two, i)));
            let g = [0, 1].map(|i| ALONG[i] + g[i]);
            let of_slope = (g[0] * r[1] - g[1] * r[0]) / (g[0] * g[0] + g[1] * g[1]);
            both += 0.5 * w * ROTARY * omega * omega;
            nodes += 0.5 * w * ROTARY * of_slope * of_slope;
        }
    }
    [both, nodes]
}

/// Largest drift over a run, from the summary; compared with velocities and rates of every step.
fn drift(settings: &Settings) -> f64 {
    let model = thrown();
    let mut simulation = Simulation::new(&model, settings).unwrap();
    let mut largest = 0.0_f64;
    while !simulation.is_over() {
        simulation.advance(&mut NoRecorder).unwrap();
        let ([both, nodes], m) = (kinetic(simulation.state()), simulation.measures());
        assert!((m.kinetic_beams - both).abs() < 1e-12 * both, "{} {both}", m.kinetic_beams);
        assert!((m.angular_rate_drift - (nodes - both)).abs() < 1e-11 * both);
        largest = largest.max((nodes - both).abs());
    }
    let summary = simulation.run(&mut NoRecorder);
    assert!(summary.energy.residual_max < 1e-12);
    let reported = summary.audit.angular_rate_drift_max;
    assert!((reported - largest / summary.energy.scale).abs() < 1e-11, "{reported}");
    reported
}

/// The energy of the sections' own rates is conserved to round-off; that of the slopes' velocities comes to it as the square of the step.
#[test]
fn angular_rates_and_velocities_of_slopes_meet_as_steps_shrink() {
    let drifts = [0.02, 0.01, 0.005, 0.0025].map(|step| drift(&Settings::new(10.0, step)));
    assert!(
        drifts[0] > AuditSummary::UNRESOLVED && drifts[3] < AuditSummary::UNRESOLVED,
        "{drifts:?}"
    );
    let order = (drifts[2] / drifts[3]).log2();
    assert!((order - 2.0).abs() < 0.15, "{drifts:?}: order {order}");
}

/// Schemes that advance accelerations have one velocity.
#[test]
fn schemes_that_advance_accelerations_have_no_drift_of_angular_rates() {
    for scheme in [Scheme::Newmark, Scheme::GeneralizedAlpha { spectral_radius: 0.8 }] {
        let found = drift_of(scheme);
        assert!(found < 1e-13, "{scheme:?}: {found:e}");
    }
    assert!(drift_of(Scheme::StrainRate) > 1e-4);
}

fn drift_of(scheme: Scheme) -> f64 {
    let settings = Settings { scheme, ..Settings::new(4.0, 0.02) };
    simulate(&thrown(), &settings, &mut NoRecorder).unwrap().audit.angular_rate_drift_max
}

/// A frame's velocities and angular rates are those that the kinetic energy of its row is made of.
#[test]
fn frames_hold_the_rates_that_are_conserved() {
    #[derive(Default)]
    struct Frames {
        spins: Vec<Vec<[f64; 3]>>,
    }
    impl Recorder for Frames {
        fn begin(&mut self, _channels: &[Channel]) -> Result<(), RecorderError> {
            Ok(())
        }
        fn row(&mut self, _values: &[f64]) -> Result<(), RecorderError> {
            Ok(())
        }
        fn wants_frame(&mut self, _time: f64, _force: f64, _impulse: f64) -> bool {
            true
        }
        fn frame(&mut self, frame: &Frame<'_>) {
            self.spins.push(frame.spin.to_vec());
        }
    }
    let (model, settings, mut frames) = (thrown(), Settings::new(1.0, 0.02), Frames::default());
    simulate(&model, &settings, &mut frames).unwrap();
    let mut simulation = Simulation::new(&model, &settings).unwrap();
    for spins in &frames.spins[1..] {
        simulation.advance(&mut NoRecorder).unwrap();
        assert_eq!(&simulation.state().spin, spins);
    }
    assert_eq!(frames.spins.len(), 51);
}
