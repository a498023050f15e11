//! A mass behind a spring that strikes a span reduced to one mass on one spring.

use super::Span;

/// Projectile, contact spring, reduced mass of the span, stiffness of the span (K. N. Shivakumar, W. Elber and W. Illg,
/// Prediction of impact force and duration due to low-velocity impact on circular composite laminates, Journal of Applied
/// Mechanics 52, 1985: here for a span, as is usual, and with a linear contact).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoMasses {
    /// Mass of the projectile \[kg\].
    pub mass: f64,
    /// Contact stiffness \[N/m\].
    pub contact: f64,
    /// Reduced mass of the span \[kg\].
    pub span_mass: f64,
    /// Stiffness of the span \[N/m\].
    pub span_stiffness: f64,
}

/// The first contact of [`TwoMasses`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoMassBlow {
    /// Largest force \[N\].
    pub peak_force: f64,
    /// Time of the largest force after touch \[s\].
    pub peak_time: f64,
    /// Time from touch to release \[s\].
    pub duration: f64,
    /// Largest deflection of the span during the contact \[m\].
    pub deflection: f64,
}

/// A mode: angular frequency, and amplitudes of penetration and deflection.
struct Mode {
    frequency: f64,
    penetration: f64,
    deflection: f64,
}

impl TwoMasses {
    /// A mass \[kg\] behind a spring \[N/m\] that strikes a span.
    pub fn on(span: &Span, mass: f64, contact: f64) -> Self {
        let (span_mass, span_stiffness) = (span.reduced_mass(), span.stiffness());
        Self { mass, contact, span_mass, span_stiffness }
    }

    /// The first contact after a touch at `speed` \[m/s\].
    pub fn blow(&self, speed: f64) -> TwoMassBlow {
        const SAMPLES: usize = 400;
        let modes = self.modes(speed);
        let sum = |t: f64, of: fn(&Mode) -> f64| -> f64 {
            modes.iter().map(|mode| of(mode) * (mode.frequency * t).sin()).sum()
        };
        let penetration = |t: f64| sum(t, |mode| mode.penetration);
        let deflection = |t: f64| sum(t, |mode| mode.deflection);
        let fastest = modes[0].frequency.max(modes[1].frequency);
        let step = std::f64::consts::PI / fastest / SAMPLES as f64;
        let mut blow =
            TwoMassBlow { peak_force: 0.0, peak_time: 0.0, duration: 0.0, deflection: 0.0 };
        loop {
            let t = blow.duration + step;
            let p = penetration(t);
            if p <= 0.0 {
                // The crossing by a chord: steps are short against both periods.
                let before = penetration(blow.duration);
                blow.duration += step * before / (before - p);
                return blow;
            }
            blow.duration = t;
            if self.contact * p > blow.peak_force {
                (blow.peak_force, blow.peak_time) = (self.contact * p, t);
            }
            blow.deflection = blow.deflection.max(deflection(t));
        }
    }

    /// Both modes, with the amplitudes that a velocity `speed` of the projectile alone gives them.
    fn modes(&self, speed: f64) -> [Mode; 2] {
        // Eigenvalues of the matrix [[a, b], [b, d]] of the coordinates scaled with the roots of their masses.
        let (m, n) = (self.mass.sqrt(), self.span_mass.sqrt());
        let a = self.contact / self.mass;
        let b = -self.contact / (m * n);
        let d = (self.contact + self.span_stiffness) / self.span_mass;
        let angle = 0.5 * (2.0 * b).atan2(a - d);
        [angle, angle + std::f64::consts::FRAC_PI_2].map(|angle| {
            let (sine, cosine) = angle.sin_cos();
            let squared = a * cosine * cosine + 2.0 * b * sine * cosine + d * sine * sine;
            let frequency = squared.max(f64::MIN_POSITIVE).sqrt();
            // The scaled velocity (m v, 0) in the direction of the mode.
            let amplitude = m * speed * cosine / frequency;
            let deflection = amplitude * sine / n;
            Mode { frequency, penetration: amplitude * cosine / m - deflection, deflection }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::{linear_blow, near};
    use super::*;

    #[test]
    fn a_heavy_span_is_a_rigid_target() {
        let model = TwoMasses { mass: 2.0, contact: 800.0, span_mass: 1e9, span_stiffness: 1e3 };
        let (blow, wall) = (model.blow(3.0), linear_blow(2.0, 800.0, 3.0));
        near(blow.peak_force, wall.peak_force, 1e-5);
        near(blow.duration, wall.duration, 1e-5);
    }

    #[test]
    fn a_span_without_mass_is_a_spring_in_series() {
        let model = TwoMasses { mass: 2.0, contact: 800.0, span_mass: 1e-6, span_stiffness: 200.0 };
        let (blow, series) = (model.blow(3.0), linear_blow(2.0, 160.0, 3.0));
        near(blow.peak_force, series.peak_force, 1e-2);
        near(blow.duration, series.duration, 1e-2);
        near(blow.deflection, series.peak_force / 200.0, 1e-2);
    }

    #[test]
    fn two_masses_move_by_their_equations_of_motion() {
        let model =
            TwoMasses { mass: 500.0, contact: 7.5e5, span_mass: 334.0, span_stiffness: 1.2e6 };
        let h = 1e-6;
        let (mut u, mut v, mut t) = ([0.0, 0.0], [20.0, 0.0], 0.0);
        let (mut force, mut deflection) = (0.0_f64, 0.0_f64);
        // Leapfrog.
        while t == 0.0 || u[0] > u[1] {
            u = [u[0] + h * v[0], u[1] + h * v[1]];
            let contact = 7.5e5 * (u[0] - u[1]);
            v[0] -= h * contact / 500.0;
            v[1] += h * (contact - 1.2e6 * u[1]) / 334.0;
            t += h;
            force = force.max(contact);
            deflection = deflection.max(u[1]);
        }
        let blow = model.blow(20.0);
        near(blow.peak_force, force, 1e-4);
        near(blow.duration, t, 1e-4);
        near(blow.deflection, deflection, 1e-4);
    }
}
