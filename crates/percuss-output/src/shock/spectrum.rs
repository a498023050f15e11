//! Shock response spectra: the largest answers of oscillators on a base that moves with a signal.
//!
//! `z'' + 2 zeta w z' + w^2 z = -a(t)` for the displacement z relative to the base; the absolute acceleration is
//! `z'' + a = -(2 zeta w z' + w^2 z)`. Between samples the signal is a straight line, on which the oscillator is followed exactly: the
//! ramp-invariant recursion of Smallwood (An improved recursive formula for calculating shock response spectra, 1981), in the form of
//! Nigam and Jennings (1969), which keeps z and z' and so gives displacements, velocities and the free motion after the end besides.

use std::f64::consts::PI;
use std::fmt::Write as _;

use super::{ShockError, Signal};

/// Samples of an answer a period: between two of them its largest value is missed by at most 1 - cos(pi / 64), 0.12 %.
const PER_PERIOD: f64 = 64.0;
/// A spectrum goes up to this share of the sampling unless asked to go on; the signal's own shape is not known beyond.
const RESOLVED: f64 = 0.1;
/// Beyond half the sampling there is nothing to be known.
const NYQUIST: f64 = 0.5;
/// Terms of the series for short steps: with `w h` below 2 pi / 64 the rest is below 1e-16.
const TERMS: usize = 16;
/// Natural frequencies of a spectrum at most.
const MOST: f64 = 2_000.0;

/// Natural frequencies, evenly spaced on a logarithmic axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// The lowest \[Hz\].
    pub from: f64,
    /// The highest \[Hz\]; without it 10 kHz, or a tenth of the sampling where that is less.
    pub to: Option<f64>,
    /// Frequencies an octave.
    pub per_octave: f64,
}

impl Default for Band {
    fn default() -> Self {
        Self { from: 1.0, to: None, per_octave: 12.0 }
    }
}

impl Band {
    /// The frequencies for a signal, shape (n_frequencies) \[Hz\].
    fn frequencies(&self, signal: &Signal) -> Result<Vec<f64>, ShockError> {
        let rate = 1.0 / signal.step;
        let to = self.to.unwrap_or_else(|| f64::min(1e4, RESOLVED * rate));
        if to > NYQUIST * rate {
            let what = format!("a spectrum up to {to} Hz");
            return Err(ShockError::Coarse { what, needed: to / NYQUIST, rate });
        }
        let count = (self.per_octave * (to / self.from).log2()).ceil();
        if !(self.from > 0.0 && self.per_octave > 0.0 && (1.0..MOST).contains(&count)) {
            let text = format!("no frequencies from {} Hz to {to} Hz", self.from);
            return Err(ShockError::Request(text));
        }
        let at = |k: usize| self.from * (to / self.from).powf(k as f64 / count);
        Ok((0..=count as usize).map(at).collect())
    }
}

/// Largest magnitudes of an answer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extremes {
    /// While the signal lasts.
    pub primary: f64,
    /// After its end, when the base moves on with its velocity.
    pub residual: f64,
}

impl Extremes {
    /// At any time.
    pub fn maximax(self) -> f64 {
        self.primary.max(self.residual)
    }
}

/// A shock response spectrum.
#[derive(Clone, Debug, PartialEq)]
pub struct ShockSpectrum {
    /// Damping ratio of the oscillators \[-\].
    pub damping: f64,
    /// Their undamped natural frequencies, shape (n_frequencies) \[Hz\].
    pub frequency: Vec<f64>,
    /// Absolute accelerations, shape (n_frequencies) \[m/s^2\].
    pub acceleration: Vec<Extremes>,
    /// Displacements relative to the base, shape (n_frequencies) \[m\].
    pub displacement: Vec<Extremes>,
}

impl ShockSpectrum {
    /// Pseudo-velocities `w z`, shape (n_frequencies) \[m/s\].
    pub fn pseudo_velocity(&self) -> Vec<Extremes> {
        let scaled = |(f, z): (&f64, &Extremes)| {
            let w = 2.0 * PI * f;
            Extremes { primary: w * z.primary, residual: w * z.residual }
        };
        self.frequency.iter().zip(&self.displacement).map(scaled).collect()
    }
}

/// First line of the file of a spectrum.
pub const SPECTRUM_HEADER: &str = "frequency,acceleration_primary,acceleration_residual,acceleration_maximax,\
    pseudo_velocity_primary,pseudo_velocity_residual,pseudo_velocity_maximax,\
    displacement_primary,displacement_residual,displacement_maximax";

impl ShockSpectrum {
    /// The spectrum as CSV, a row a frequency \[Hz, m/s^2, m/s, m\], below [`SPECTRUM_HEADER`].
    pub fn csv(&self) -> String {
        let mut out = format!("{SPECTRUM_HEADER}\n");
        for (k, velocity) in self.pseudo_velocity().into_iter().enumerate() {
            let _ = write!(out, "{}", self.frequency[k]);
            for answer in [self.acceleration[k], velocity, self.displacement[k]] {
                let _ = write!(out, ",{},{},{}", answer.primary, answer.residual, answer.maximax());
            }
            out.push('\n');
        }
        out
    }
}

/// The spectrum of a signal; before its first sample the acceleration is zero, and a step after its last sample again.
///
/// # Errors
/// If the damping ratio is not from 0 to below 1, the band is empty, or goes beyond half the sampling.
pub fn shock_spectrum(
    signal: &Signal,
    damping: f64,
    band: &Band,
) -> Result<ShockSpectrum, ShockError> {
    if !(0.0..1.0).contains(&damping) {
        let text = format!("damping {damping}: expected a ratio from 0 to below 1, such as 0.05");
        return Err(ShockError::Request(text));
    }
    if signal.values.iter().all(|a| *a == 0.0) {
        let text = "the acceleration is zero".to_owned();
        return Err(ShockError::Signal(text));
    }
    let frequency = band.frequencies(signal)?;
    let (acceleration, displacement) =
        frequency.iter().map(|f| extremes(signal, 2.0 * PI * f, damping)).unzip();
    Ok(ShockSpectrum { damping, frequency, acceleration, displacement })
}

/// Extremes of absolute acceleration and relative displacement of one oscillator.
fn extremes(signal: &Signal, w: f64, zeta: f64) -> (Extremes, Extremes) {
    let parts = (PER_PERIOD * w / (2.0 * PI) * signal.step).ceil().max(1.0);
    let step = Exact::new(w, zeta, signal.step / parts);
    let felt = |[z, v]: [f64; 2]| -(2.0 * zeta * w * v + w * w * z);
    let (mut state, mut before) = ([0.0; 2], 0.0);
    let (mut acceleration, mut displacement) = (Extremes::default(), Extremes::default());
    for &after in signal.values.iter().chain(&[0.0]) {
        let slope = (after - before) / parts;
        for k in 0..parts as usize {
            let a = before + slope * k as f64;
            state = step.advance(state, a, a + slope);
            acceleration.primary = acceleration.primary.max(felt(state).abs());
            displacement.primary = displacement.primary.max(state[0].abs());
        }
        before = after;
    }
    let q = felt(state);
    let rate = -(2.0 * zeta * w * q + w * w * state[1]);
    acceleration.residual = free_extreme([q, rate], w, zeta);
    displacement.residual = free_extreme(state, w, zeta);
    (acceleration, displacement)
}

/// Largest magnitude of a free oscillation from a value and its rate on: there, or where it first turns.
fn free_extreme([value, rate]: [f64; 2], w: f64, zeta: f64) -> f64 {
    let damped = w * (1.0 - zeta * zeta).sqrt();
    let sine = (rate + zeta * w * value) / damped;
    let phase = f64::atan2(damped * sine - zeta * w * value, damped * value + zeta * w * sine);
    let phase = phase.rem_euclid(PI);
    let turned = (value * phase.cos() + sine * phase.sin()) * (-zeta * w * phase / damped).exp();
    turned.abs().max(value.abs())
}

/// An oscillator over a step on which the base's acceleration is a straight line.
struct Exact {
    /// Answers to displacement and velocity at the start of the step, shape (2, 2) \[m, m/s by these\].
    free: [[f64; 2]; 2],
    /// Answers to the acceleration at the start and at the end of the step, shape (2, 2) \[m, m/s by m/s^2\].
    forced: [[f64; 2]; 2],
}

impl Exact {
    /// From the answer g to a unit impulse, whose derivatives at zero follow from the equation itself: g, its rate, and its first two
    /// integrals as power series, which keep their digits however short the step.
    fn new(w: f64, zeta: f64, h: f64) -> Self {
        let mut derivative = [0.0; TERMS + 2];
        derivative[1] = 1.0;
        for n in 0..TERMS {
            derivative[n + 2] = -2.0 * zeta * w * derivative[n + 1] - w * w * derivative[n];
        }
        let [mut rate, mut g, mut once, mut twice] = [0.0; 4];
        let mut power = 1.0; // h^n / n!
        for n in 0..=TERMS {
            let next = (n + 1) as f64;
            rate += derivative[n + 1] * power;
            g += derivative[n] * power;
            once += derivative[n] * power * h / next;
            twice += derivative[n] * power * h * h / (next * (next + 1.0));
            power *= h / next;
        }
        let free = [[rate + 2.0 * zeta * w * g, g], [-w * w * g, rate]];
        // A ramp of height one over the step, and what is left of a step of height one.
        let ramp = [-twice / h, -once / h];
        let forced = [[-once - ramp[0], -g - ramp[1]], ramp];
        Self { free, forced }
    }

    fn advance(&self, [z, v]: [f64; 2], start: f64, end: f64) -> [f64; 2] {
        let row = |i: usize| {
            self.free[i][0] * z
                + self.free[i][1] * v
                + self.forced[0][i] * start
                + self.forced[1][i] * end
        };
        [row(0), row(1)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const T: f64 = 0.01;
    const SAMPLES: usize = 4000;

    fn pulse(shape: impl Fn(f64) -> f64) -> Signal {
        let step = T / SAMPLES as f64;
        let values = (0..=SAMPLES).map(|k| shape(k as f64 / SAMPLES as f64)).collect();
        Signal { start: 0.0, step, values, resampled: false }
    }

    fn at(signal: &Signal, frequency: f64, damping: f64) -> (Extremes, Extremes) {
        extremes(signal, 2.0 * PI * frequency, damping)
    }

    #[track_caller]
    fn near(found: f64, exact: f64, tolerance: f64) {
        assert!((found - exact).abs() < tolerance, "{found} instead of {exact}");
    }

    #[test]
    fn a_half_sine_gives_its_closed_form() {
        let signal = pulse(|t| (PI * t).sin());
        for cycles in [0.2, 0.35, 0.7, 0.81, 1.3, 2.2, 5.3] {
            let found = at(&signal, cycles / T, 0.0).0;
            let r = 0.5 / cycles; // of the pulse's frequency to the natural one
            let residual = (2.0 * r * (PI * cycles).cos() / (1.0 - r * r)).abs();
            // Straight lines between 4000 samples miss the sine by 1e-7.
            near(found.residual, residual, 1e-6 + 1e-3 * r * r);
            if r < 1.0 {
                // Turning points while it lasts, where cos(W t) = cos(w t) and sin(w t) = -sin(W t).
                let turn = |n: u32| 2.0 * f64::from(n) * r / (1.0 + r); // in units of the duration
                let turns = (1..9).map(turn).filter(|t| *t <= 1.0);
                let primary = turns.map(|t| (PI * t).sin() / (1.0 - r)).fold(0.0, f64::max);
                near(found.primary, primary, 1.3e-3 * primary);
            }
        }
        // The largest of all, tabulated as 1.77.
        let peak = (60..110).map(|k| at(&signal, f64::from(k) * 0.01 / T, 0.0).0.maximax());
        near(peak.fold(0.0, f64::max), 1.768, 1e-3);
    }

    #[test]
    fn a_sawtooth_with_its_peak_at_the_end_gives_its_closed_form() {
        let signal = pulse(|t| t);
        for cycles in [0.3, 0.5, 1.25, 3.4, 8.0] {
            let (found, w) = (at(&signal, cycles / T, 0.0).0, 2.0 * PI * cycles);
            let (end, rate) = (1.0 - w.sin() / w, (1.0 - w.cos()) / w);
            // The drop takes one sample, w / 4000 of a radian.
            let drop = 2.0 * w / SAMPLES as f64;
            near(found.residual, end.hypot(rate), drop);
            near(found.primary, end, drop);
        }
    }

    #[test]
    fn a_step_doubles_and_damping_takes_what_it_takes_of_a_period() {
        let signal = pulse(|_| 1.0);
        for zeta in [0.0_f64, 0.05, 0.3] {
            let (frequency, overshoot) = (5.0 / T, (-PI * zeta / (1.0 - zeta * zeta).sqrt()).exp());
            let w = 2.0 * PI * frequency;
            let (_, z) = at(&signal, frequency, zeta);
            // The step rises within a sample; extremes are met to 0.12 %.
            near(z.primary * w * w, 1.0 + overshoot, 3e-3);
        }
    }

    #[test]
    fn slow_oscillators_feel_the_change_of_velocity_and_stiff_ones_the_signal() {
        let signal = pulse(|t| (PI * t).sin());
        let change = 2.0 * T / PI;
        let found = shock_spectrum(
            &signal,
            0.05,
            &Band { from: 0.01, to: Some(40_000.0), per_octave: 3.0 },
        )
        .unwrap();
        let pseudo = found.pseudo_velocity()[0].maximax();
        // A change of velocity lets a damped oscillator reach exp(-zeta acos(zeta) / sqrt(1 - zeta^2)) of it.
        let (zeta, root) = (0.05_f64, (1.0 - 0.0025_f64).sqrt());
        near(pseudo / change, (-zeta * zeta.acos() / root).exp(), 1e-3);
        near(found.acceleration.last().unwrap().maximax(), 1.0, 2e-3);
    }

    #[test]
    fn senseless_requests_of_spectra_are_refused() {
        let signal = pulse(|t| t);
        assert!(shock_spectrum(&signal, 1.0, &Band::default()).is_err());
        assert!(shock_spectrum(&signal, 0.05, &Band { from: 0.0, ..Band::default() }).is_err());
        let beyond = Band { to: Some(0.51 * SAMPLES as f64 / T), ..Band::default() };
        let refused = shock_spectrum(&signal, 0.05, &beyond).unwrap_err();
        assert!(matches!(refused, ShockError::Coarse { .. }));
        let default = shock_spectrum(&signal, 0.05, &Band::default()).unwrap();
        near(*default.frequency.last().unwrap(), 1e4, 1e-6);
    }
}
