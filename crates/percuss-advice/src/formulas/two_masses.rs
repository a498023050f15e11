//! A mass behind a spring that strikes a span reduced to one mass on one spring.

use std::f64::consts::{FRAC_PI_2, PI};

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
pub struct TwoMassImpact {
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

    /// The first contact after a touch at `speed` \[m/s\]; none where its numbers leave the range of floating point.
    ///
    /// The penetration is a sum of two sines, slow and fast. Beyond a ratio `FAR` of their frequencies it is looked at only
    /// where its first zero and its extremes can lie, so that the work is bounded whatever the ratio is.
    pub fn impact(&self, speed: f64) -> Option<TwoMassImpact> {
        let modes = Modes::new(self, speed);
        let mut impact =
            TwoMassImpact { peak_force: 0.0, peak_time: 0.0, duration: 0.0, deflection: 0.0 };
        for window in modes.windows() {
            let Window { start, samples } = window;
            let mut before = [start, modes.penetration(start)];
            for k in 0..=samples {
                let t = start + modes.step * (k + usize::from(start == 0.0)) as f64;
                let p = modes.penetration(t);
                if !p.is_finite() {
                    return None;
                }
                if p <= 0.0 {
                    // The crossing by a chord: steps are short against both periods.
                    let share = if before[1] > 0.0 { before[1] / (before[1] - p) } else { 1.0 };
                    impact.duration = before[0] + share * (t - before[0]);
                    return impact.is_finite().then_some(impact);
                }
                before = [t, p];
                if self.contact * p > impact.peak_force {
                    (impact.peak_force, impact.peak_time) = (self.contact * p, t);
                }
                impact.deflection = impact.deflection.max(modes.deflection(t));
            }
        }
        // So far apart that a fast period is lost in the digits of the time: the slow mode alone, if there is no other to speak of.
        impact.duration = modes.falls();
        (modes.share() < UNSEEN && impact.is_finite()).then_some(impact)
    }
}

impl TwoMassImpact {
    fn is_finite(&self) -> bool {
        let all = [self.peak_force, self.peak_time, self.duration, self.deflection];
        all.iter().all(|x| x.is_finite()) && self.duration > 0.0
    }
}

/// Samples in half a period of the faster mode.
const SAMPLES: usize = 400;
/// Ratio of the frequencies beyond which a contact is not sampled throughout: the slow sine is then constant, to second order in
/// this ratio, while the fast one takes all its values.
const FAR: f64 = 64.0;
/// Share of the fast mode in the penetration below which it changes no digit that is reported.
const UNSEEN: f64 = 1e-6;

/// A stretch of time in which the motion is looked at, in steps of [`Modes::step`].
struct Window {
    start: f64,
    samples: usize,
}

/// Both modes.
struct Modes {
    slow: Mode,
    fast: Mode,
    /// Time between samples \[s\].
    step: f64,
}

impl Modes {
    fn new(masses: &TwoMasses, speed: f64) -> Self {
        let [a, b] = masses.modes(speed);
        let (slow, fast) = if a.frequency <= b.frequency { (a, b) } else { (b, a) };
        let step = PI / fast.frequency / SAMPLES as f64;
        Self { slow, fast, step }
    }

    fn sum(&self, t: f64, of: fn(&Mode) -> f64) -> f64 {
        [&self.slow, &self.fast].map(|mode| of(mode) * (mode.frequency * t).sin()).iter().sum()
    }

    fn penetration(&self, t: f64) -> f64 {
        self.sum(t, |mode| mode.penetration)
    }

    fn deflection(&self, t: f64) -> f64 {
        self.sum(t, |mode| mode.deflection)
    }

    /// Amplitude of the fast penetration over that of the slow one, at most one.
    fn share(&self) -> f64 {
        (self.fast.penetration / self.slow.penetration).abs().min(1.0)
    }

    /// When the lower bound of the penetration falls below zero for good \[s\].
    fn falls(&self) -> f64 {
        (PI - self.share().asin()) / self.slow.frequency
    }

    /// Where the first zero and the extremes before it can lie.
    ///
    /// The sum lies between `P sin(w t) -+ |Q|`, P of the slow mode, Q of the fast one, and touches either bound once in a
    /// period of the fast mode. The lower bound rises up to a quarter of the slow period: if the sum is not negative in the
    /// first two fast periods, it is not until the bound falls below zero again, at `w t = pi - asin(|Q|/P)`, and is within the
    /// two fast periods after it. The largest values come within a fast period of a quarter of the slow one.
    fn windows(&self) -> Vec<Window> {
        let period = 2 * SAMPLES;
        let half = PI / self.slow.frequency;
        let ratio = self.fast.frequency / self.slow.frequency;
        if ratio <= FAR || ratio.is_nan() {
            // All of half a slow period and two fast ones.
            let samples = (ratio.max(1.0) * SAMPLES as f64) as usize + 2 * period;
            return vec![Window { start: 0.0, samples }];
        }
        let falls = self.falls();
        let fast = period as f64 * self.step;
        vec![
            Window { start: 0.0, samples: 2 * period },
            Window { start: 0.5 * half - fast, samples: 2 * period },
            Window { start: (falls - fast).max(0.5 * half + fast), samples: 4 * period },
        ]
    }
}

impl TwoMasses {
    /// Both modes, with the amplitudes that a velocity `speed` of the projectile alone gives them.
    fn modes(&self, speed: f64) -> [Mode; 2] {
        // Eigenvalues of the matrix [[a, b], [b, d]] of the coordinates scaled with the roots of their masses.
        let (m, n) = (self.mass.sqrt(), self.span_mass.sqrt());
        let a = self.contact / self.mass;
        let b = -self.contact / (m * n);
        let d = (self.contact + self.span_stiffness) / self.span_mass;
        let angle = 0.5 * (2.0 * b).atan2(a - d);
        let largest = 0.5 * (a + d) + (0.5 * (a - d)).hypot(b);
        let determinant = a * (self.span_stiffness / self.span_mass);
        [angle, angle + FRAC_PI_2].map(|angle| {
            let (sine, cosine) = angle.sin_cos();
            let squared = a * cosine * cosine + 2.0 * b * sine * cosine + d * sine * sine;
            // The smaller eigenvalue follows from the determinant: beside a much larger one the sum has no digits of it.
            let squared = if squared < 0.5 * (a + d) { determinant / largest } else { squared };
            let frequency = squared.sqrt();
            // The scaled velocity (m v, 0) in the direction of the mode.
            let amplitude = m * speed * cosine / frequency;
            let deflection = amplitude * sine / n;
            Mode { frequency, penetration: amplitude * cosine / m - deflection, deflection }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::{linear_impact, near};
    use super::*;

    #[test]
    fn a_heavy_span_is_a_rigid_target() {
        let model = TwoMasses { mass: 2.0, contact: 800.0, span_mass: 1e9, span_stiffness: 1e3 };
        let impact = model.impact(3.0).expect("an estimate");
        let wall = linear_impact(2.0, 800.0, 3.0);
        near(impact.peak_force, wall.peak_force, 1e-5);
        near(impact.duration, wall.duration, 1e-5);
    }

    #[test]
    fn a_span_without_mass_is_a_spring_in_series() {
        let model = TwoMasses { mass: 2.0, contact: 800.0, span_mass: 1e-6, span_stiffness: 200.0 };
        let impact = model.impact(3.0).expect("an estimate");
        let series = linear_impact(2.0, 160.0, 3.0);
        near(impact.peak_force, series.peak_force, 1e-2);
        near(impact.duration, series.duration, 1e-2);
        near(impact.deflection, series.peak_force / 200.0, 1e-2);
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
        let impact = model.impact(20.0).expect("an estimate");
        near(impact.peak_force, force, 1e-4);
        near(impact.duration, t, 1e-4);
        near(impact.deflection, deflection, 1e-4);
    }

    /// The first zero by samples of the whole motion, eighty in half a fast period.
    fn sampled(model: &TwoMasses, speed: f64) -> [f64; 3] {
        let modes = Modes::new(model, speed);
        let step = modes.step * SAMPLES as f64 / 80.0;
        let (mut t, mut force, mut deflection) = (step, 0.0_f64, 0.0_f64);
        while modes.penetration(t) > 0.0 {
            force = force.max(model.contact * modes.penetration(t));
            deflection = deflection.max(modes.deflection(t));
            t += step;
        }
        [t, force, deflection]
    }

    /// Ratios of masses and of springs on either side of where the windows begin to differ from the whole.
    #[test]
    fn windows_hold_the_first_zero_and_the_extremes_of_the_whole_motion() {
        for mass in [1e-4, 0.03, 1.0, 40.0, 1e4] {
            for contact in [1e-6, 1e-3, 0.2, 5.0, 1e4, 1e7] {
                let model = TwoMasses { mass, contact, span_mass: 1.0, span_stiffness: 1.0 };
                let impact = model.impact(1.0).expect("an estimate");
                let [t, force, deflection] = sampled(&model, 1.0);
                // A sampled step is pi/80 of the faster mode.
                near(impact.duration, t, 0.02);
                near(impact.peak_force, force, 1e-3);
                // It may still grow where the contact ends.
                near(impact.deflection, deflection, 0.02);
            }
        }
    }

    #[test]
    fn the_work_does_not_grow_with_the_ratio() {
        for power in -60..=60 {
            for contact in [1e-3, 1.0, 1e3] {
                let span_stiffness = 10_f64.powi(power);
                let model = TwoMasses { mass: 1.0, contact, span_mass: 1.0, span_stiffness };
                let windows = Modes::new(&model, 1.0).windows();
                let samples: usize = windows.iter().map(|window| window.samples).sum();
                assert!(samples <= (FAR as usize + 8) * SAMPLES, "{samples} at 1e{power}");
            }
        }
    }

    /// Work is bounded: springs and masses of any ratio give an estimate, that of the slow or the fast partner alone.
    #[test]
    fn partners_of_any_ratio_meet_like_one_mass_on_one_spring() {
        for power in (9..=60).step_by(3) {
            let far = 10_f64.powi(power);
            let soft = TwoMasses {
                mass: 2.0,
                contact: 800.0,
                span_mass: 1.0,
                span_stiffness: 800.0 * far,
            };
            let (impact, wall) = (soft.impact(3.0), linear_impact(2.0, 800.0, 3.0));
            near(impact.map_or(f64::NAN, |b| b.duration), wall.duration, 1e-4);
            near(impact.map_or(f64::NAN, |b| b.peak_force), wall.peak_force, 1e-4);
            let heavy =
                TwoMasses { mass: 2.0, contact: 800.0, span_mass: far, span_stiffness: 1.0 };
            near(heavy.impact(3.0).map_or(f64::NAN, |b| b.duration), wall.duration, 1e-4);
        }
        let lost = TwoMasses { mass: 1e-300, contact: 1e300, span_mass: 1.0, span_stiffness: 1.0 };
        assert_eq!(lost.impact(1.0), None);
    }
}
