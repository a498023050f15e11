//! Prescribed motions: held velocities, reactions and impulses follow the motion itself.

mod common;

use common::at;
use percuss::*;

/// Rows of a run, and its columns by name.
#[derive(Default)]
struct Rows {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Recorder for Rows {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), Failed> {
        self.names = channels.iter().map(|c| c.name.clone()).collect();
        Ok(())
    }

    fn row(&mut self, row: &[f64]) -> Result<(), Failed> {
        self.rows.push(row.to_vec());
        Ok(())
    }
}

impl Rows {
    fn column(&self, name: &str) -> Vec<f64> {
        let k = self.names.iter().position(|n| n == name).unwrap_or_else(|| panic!("no {name}"));
        self.rows.iter().map(|r| r[k]).collect()
    }

    fn of(model: &Model, settings: &Settings) -> (Self, RunSummary) {
        let mut rows = Self::default();
        let summary = simulate(model, settings, &mut rows).unwrap();
        assert!(matches!(summary.termination, Termination::Completed), "{:?}", summary.termination);
        (rows, summary)
    }
}

/// A stocky cantilever of one element, length 1 m, EI = 1 N m^2, rhoA = 1 kg/m, rhoI = 0.01 kg m, its clamp moved across by
/// so little that everything is linear.
const ROTARY: f64 = 0.01;
const MOVED: f64 = 1e-6;

fn driven_cantilever(function: &TimeFunction, until: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 100.0, 1.0));
    let section = b.section(Section::new("s", 1.0, ROTARY));
    let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [1.0, 0.0]], 1, material, section));
    let mut root = Support::new("root", at("root", beam, 0.0), SupportKind::Clamp);
    root.motion =
        Some(Motion { displacement: [0.0, MOVED], rotation: 0.0, function: function.clone() });
    root.until = until;
    b.support(root);
    b.record_point(at("root", beam, 0.0));
    b.record_point(at("tip", beam, 1.0));
    b.build().unwrap()
}

/// The same as a linear system of two degrees of freedom (deflection and slope of the tip), integrated by Runge-Kutta in the coordinate
/// `z = x + Mff^-1 Mfh u`, in which jumps of the clamp's velocity are no impulses: mean reactions over steps of size `h`.
fn reference(course: &dyn Fn(f64) -> [f64; 2], h: f64, steps: usize) -> Vec<f64> {
    // Consistent mass (Hermite), rotary inertia and stiffness of a unit element: order (u_a, u_b, u_b').
    let m = |r: [f64; 3], s: [f64; 3]| [0, 1, 2].map(|i| r[i] / 420.0 + ROTARY * s[i] / 30.0);
    let mass = [
        m([156.0, 54.0, -13.0], [36.0, -36.0, 3.0]),
        m([54.0, 156.0, -22.0], [-36.0, 36.0, -3.0]),
        m([-13.0, -22.0, 4.0], [3.0, -3.0, 4.0]),
    ];
    let stiff = [[12.0, -12.0, 6.0], [-12.0, 12.0, -6.0], [6.0, -6.0, 4.0]];
    let solve = |f: [f64; 2]| {
        let [[a, b], [c, d]] = [[mass[1][1], mass[1][2]], [mass[2][1], mass[2][2]]];
        let det = a * d - b * c;
        [(d * f[0] - b * f[1]) / det, (a * f[1] - c * f[0]) / det]
    };
    let p = solve([mass[1][0], mass[2][0]]);
    let free = |z: [f64; 2], u: f64| [z[0] - p[0] * u, z[1] - p[1] * u];
    let force = |x: [f64; 2], u: f64| {
        [1, 2].map(|i| -(stiff[i][0] * u + stiff[i][1] * x[0] + stiff[i][2] * x[1]))
    };
    let acceleration = |z: [f64; 2], t: f64| {
        let u = MOVED * course(t)[0];
        solve(force(free(z, u), u))
    };
    let reaction = |z: [f64; 2], t: f64| {
        let [u, a] = course(t).map(|c| MOVED * c);
        let x = free(z, u);
        let zz = acceleration(z, t);
        let [x1, x2] = [zz[0] - p[0] * a, zz[1] - p[1] * a];
        let inertia = mass[0][0] * a + mass[0][1] * x1 + mass[0][2] * x2;
        inertia + stiff[0][0] * u + stiff[0][1] * x[0] + stiff[0][2] * x[1]
    };
    let parts = 20;
    let k = h / parts as f64;
    let (mut z, mut v, mut t) = ([0.0; 2], [0.0; 2], 0.0);
    let plus = |x: [f64; 2], f: f64, y: [f64; 2]| [x[0] + f * y[0], x[1] + f * y[1]];
    let mut means = Vec::new();
    for _ in 0..steps {
        let mut sum = 0.0;
        for _ in 0..parts {
            // Inside the smooth pieces on both sides of a part's ends.
            let inside = |t: f64, s: f64| t + s * 1e-9 * k;
            sum += 0.5 * reaction(z, inside(t, 1.0));
            let (k1, l1) = (v, acceleration(z, inside(t, 1.0)));
            let (k2, l2) = (plus(v, 0.5 * k, l1), acceleration(plus(z, 0.5 * k, k1), t + 0.5 * k));
            let (k3, l3) = (plus(v, 0.5 * k, l2), acceleration(plus(z, 0.5 * k, k2), t + 0.5 * k));
            let (k4, l4) = (plus(v, k, l3), acceleration(plus(z, k, k3), inside(t + k, -1.0)));
            for i in 0..2 {
                z[i] += k / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
                v[i] += k / 6.0 * (l1[i] + 2.0 * l2[i] + 2.0 * l3[i] + l4[i]);
            }
            t += k;
            sum += 0.5 * reaction(z, inside(t, -1.0));
        }
        means.push(sum / parts as f64);
    }
    means
}

type Failed = Box<dyn std::error::Error + Send + Sync>;

const PI: f64 = std::f64::consts::PI;

type Course = Box<dyn Fn(f64) -> [f64; 2]>;

/// Motions whose velocity jumps: value and second derivative.
fn courses() -> Vec<(TimeFunction, Course)> {
    let (rise, half, rate) = (0.25, 0.3, 2.0 * PI * 3.0);
    vec![
        (
            TimeFunction::Ramp { duration: rise },
            Box::new(move |t| [(t / rise).clamp(0.0, 1.0), 0.0]),
        ),
        (
            TimeFunction::HalfSine { duration: half },
            Box::new(move |t| {
                let w = PI / half;
                if (0.0..half).contains(&t) {
                    [(w * t).sin(), -w * w * (w * t).sin()]
                } else {
                    [0.0; 2]
                }
            }),
        ),
        (
            TimeFunction::Harmonic { frequency: 3.0, phase: 0.0 },
            Box::new(move |t| [(rate * t).sin(), -rate * rate * (rate * t).sin()]),
        ),
        (
            TimeFunction::Harmonic { frequency: 3.0, phase: 0.6 },
            Box::new(move |t| {
                let (s, s0) = ((rate * t + 0.6).sin(), 0.6_f64.sin());
                [s - s0, -rate * rate * s]
            }),
        ),
    ]
}

/// Largest error of the mean reaction, relative to the largest reaction.
fn error_of_reactions(model: &Model, course: &Course, scheme: Scheme, steps: usize) -> f64 {
    let end = 0.5;
    let h = end / steps as f64;
    let settings = Settings { scheme, ..Settings::new(end, h) };
    let (rows, _) = Rows::of(model, &settings);
    let found = rows.column("support.root.force_2");
    let expected = reference(&|t| course(t), h, steps);
    let size = expected.iter().fold(0.0, |m: f64, r| m.max(r.abs()));
    let off = |(f, e): (&f64, &f64)| (f - e).abs();
    found[1..].iter().zip(&expected).map(off).fold(0.0, f64::max) / size
}

/// Reactions of driven supports converge at second order, whatever the motion and the scheme, whether nodes or multipliers hold.
#[test]
fn reactions_of_driven_supports_converge_at_second_order() {
    let schemes = [
        Scheme::EnergyMomentum,
        Scheme::StrainRate,
        Scheme::Midpoint,
        Scheme::Newmark,
        Scheme::GeneralizedAlpha { spectral_radius: 0.8 },
    ];
    for (function, course) in courses() {
        for scheme in schemes {
            for until in [f64::INFINITY, 10.0] {
                let model = driven_cantilever(&function, until);
                let [coarse, fine] =
                    [500, 1000].map(|n| error_of_reactions(&model, &course, scheme, n));
                println!("{function:?} {scheme:?} {until}: {coarse:.3e} {fine:.3e} {:.2}", coarse / fine);
            }
        }
    }
}
