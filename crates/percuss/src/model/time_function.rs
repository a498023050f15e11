//! Functions of time for loads and prescribed motions.

use std::fmt;
use std::sync::Arc;

use crate::math::spline::Spline;

/// Ends of steps closer than this share of the step are the same instant.
pub const SAME_INSTANT: f64 = 1e-9;

/// A factor as a function of time, which counts from the start of the load or motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum TimeFunction {
    /// One, always.
    #[default]
    Constant,
    /// Zero before, one from this time on \[s\].
    Step {
        /// Time of the rise.
        at: f64,
    },
    /// Linear rise to one, then constant.
    Ramp {
        /// Time of the rise \[s\].
        duration: f64,
    },
    /// Half a sine wave, then zero.
    HalfSine {
        /// Its length \[s\].
        duration: f64,
    },
    /// Linear rise to one at half of its length and decrease to zero.
    Triangle {
        /// Its length \[s\].
        duration: f64,
    },
    /// `sin(2 pi frequency t + phase)`.
    Harmonic {
        /// Frequency \[Hz\].
        frequency: f64,
        /// Phase \[rad\].
        phase: f64,
    },
    /// Values at given times, constant outside.
    Table {
        /// Times, increasing, shape (points) \[s\].
        times: Vec<f64>,
        /// Values there, shape (points) \[-\].
        values: Vec<f64>,
        /// A natural cubic spline through the values instead of straight lines.
        smooth: bool,
    },
    /// Any function; must depend only on time.
    Function(Function),
}

/// A function given as code.
#[derive(Clone)]
pub struct Function(pub Arc<dyn Fn(f64) -> f64 + Send + Sync>);

impl fmt::Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Function")
    }
}

impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl TimeFunction {
    /// A function given as code.
    pub fn function(f: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self::Function(Function(Arc::new(f)))
    }
}

/// A [`TimeFunction`] prepared for evaluation, with its kinks.
#[derive(Clone, Debug)]
pub struct PreparedFunction {
    function: TimeFunction,
    spline: Option<Spline>,
    /// Times at which the function is not smooth, increasing, shape (kinks) \[s\].
    kinks: Vec<f64>,
}

impl PreparedFunction {
    /// As it is.
    pub fn is_constant(&self) -> bool {
        matches!(self.function, TimeFunction::Constant)
    }

    /// Frequency of a periodic function; zero for all others \[Hz\].
    pub fn frequency(&self) -> f64 {
        match self.function {
            TimeFunction::Harmonic { frequency, .. } => frequency.abs(),
            _ => 0.0,
        }
    }

    /// Prepares a function.
    pub fn new(function: &TimeFunction) -> Self {
        use TimeFunction::*;
        let kinks = match function {
            Constant | Harmonic { .. } | Function(_) => Vec::new(),
            Step { at } => vec![*at],
            Ramp { duration } | HalfSine { duration } => vec![0.0, *duration],
            Triangle { duration } => vec![0.0, 0.5 * duration, *duration],
            Table { times, .. } => times.clone(),
        };
        let spline = match function {
            Table { times, values, smooth: true } => Some(Spline::natural(times, values)),
            _ => None,
        };
        Self { function: function.clone(), spline, kinks }
    }

    /// Value at time `t`; at a jump the value after it.
    pub fn value(&self, t: f64) -> f64 {
        use TimeFunction::*;
        let tau = std::f64::consts::TAU;
        match &self.function {
            Constant => 1.0,
            Step { at } => f64::from(u8::from(t >= *at)),
            Ramp { duration } => (t / duration).clamp(0.0, 1.0),
            HalfSine { duration } if t > 0.0 && t < *duration => (0.5 * tau * t / duration).sin(),
            Triangle { duration } => (1.0 - (2.0 * t / duration - 1.0).abs()).max(0.0),
            HalfSine { .. } => 0.0,
            Harmonic { frequency, phase } => (tau * frequency * t + phase).sin(),
            Table { times, values, .. } => match &self.spline {
                Some(spline) => spline.value(t.clamp(times[0], times[times.len() - 1])),
                None => piecewise_linear(times, values, t),
            },
            Function(f) => f.0(t),
        }
    }

    /// Derivative at time `t`, at a kink the one after it; of a function given as code over `width` about it \[1/s\].
    pub fn rate(&self, t: f64, width: f64) -> f64 {
        self.rate_on(t, t, width)
    }

    /// Derivative at time `t` of the smooth piece that contains the time `inside`: at a kink from the left or from the right, according to `inside`
    /// \[1/s\].
    pub fn rate_on(&self, t: f64, inside: f64, width: f64) -> f64 {
        use TimeFunction::*;
        let pi = std::f64::consts::PI;
        let within = |duration: f64| (0.0..duration).contains(&inside);
        match &self.function {
            Constant | Step { .. } => 0.0,
            Ramp { duration } if within(*duration) => 1.0 / duration,
            HalfSine { duration } if within(*duration) => pi / duration * (pi * t / duration).cos(),
            Triangle { duration } if within(*duration) => {
                if inside < 0.5 * duration {
                    2.0 / duration
                } else {
                    -2.0 / duration
                }
            }
            Ramp { .. } | HalfSine { .. } | Triangle { .. } => 0.0,
            Harmonic { frequency, phase } => {
                let rate = 2.0 * pi * frequency;
                rate * (rate * t + phase).cos()
            }
            Table { times, .. } if inside < times[0] || inside >= times[times.len() - 1] => 0.0,
            Table { times, values, .. } => self.spline.as_ref().map_or_else(
                || {
                    let next = times.partition_point(|x| *x <= inside);
                    (values[next] - values[next - 1]) / (times[next] - times[next - 1])
                },
                |spline| spline.slope(t),
            ),
            Function(f) if t < 0.5 * width => {
                // No value before time zero is needed: a parabola through the values after it.
                let [a, b, c] = [0.0, 0.5, 1.0].map(|x| f.0(t + x * width));
                (4.0 * b - 3.0 * a - c) / width
            }
            Function(f) => (f.0(t + 0.5 * width) - f.0(t - 0.5 * width)) / width,
        }
    }

    /// Second derivative at time `t` of the smooth piece that contains the time `inside`; for a function given as code over `width` about it
    /// \[1/s^2\].
    pub fn second_rate_on(&self, t: f64, inside: f64, width: f64) -> f64 {
        use TimeFunction::*;
        let pi = std::f64::consts::PI;
        match &self.function {
            Constant | Step { .. } | Ramp { .. } | Triangle { .. } => 0.0,
            HalfSine { duration } if (0.0..*duration).contains(&inside) => {
                let rate = pi / duration;
                -rate * rate * (rate * t).sin()
            }
            HalfSine { .. } => 0.0,
            Harmonic { frequency, phase } => {
                let rate = 2.0 * pi * frequency;
                -rate * rate * (rate * t + phase).sin()
            }
            Table { times, .. } => match &self.spline {
                Some(spline) if inside >= times[0] && inside < times[times.len() - 1] => {
                    spline.bend(t)
                }
                _ => 0.0,
            },
            Function(f) => {
                let middle = t.max(width);
                let [a, b, c] = [-1.0, 0.0, 1.0].map(|x| f.0(middle + x * width));
                (a - 2.0 * b + c) / (width * width)
            }
        }
    }

    /// Times from zero on at which two different functions differ: kinks, points between and after them, parts of a period, and every order of
    /// magnitude.
    pub fn probes(&self) -> Vec<f64> {
        let mut times: Vec<f64> =
            (-24..=24).map(|k| 1.2345 * 10_f64.powf(0.25 * f64::from(k))).collect();
        let mut ends = vec![0.0];
        ends.extend(self.kinks.iter().copied().filter(|k| *k > 0.0));
        let last = *ends.last().unwrap_or(&0.0);
        ends.push(1.5 * last + f64::from(u8::from(last == 0.0)));
        for pair in ends.windows(2) {
            times.extend([0.0, 0.137, 0.382, 0.713].map(|x| pair[0] + x * (pair[1] - pair[0])));
        }
        if let TimeFunction::Harmonic { frequency, .. } = self.function {
            times.extend([0.137, 0.382, 0.713, 1.907].map(|x| x / frequency.abs()));
        }
        times.retain(|t| t.is_finite());
        times
    }

    /// Times at which the derivative jumps, as far as steps of size `step` resolve it: samples of a table at smaller distances represent a smooth
    /// function.
    pub fn rate_jumps(&self, step: f64) -> Vec<f64> {
        use TimeFunction::*;
        let Table { times, smooth, .. } = &self.function else {
            return match &self.function {
                Step { .. } => Vec::new(),
                _ => self.kinks.clone(),
            };
        };
        let last = times.len() - 1;
        let apart = |i: usize| times[i] - times[i - 1] >= step * (1.0 - SAME_INSTANT);
        let jumps = |i: usize| i == 0 || i == last || (!smooth && apart(i) && apart(i + 1));
        (0..=last).filter(|i| jumps(*i)).map(|i| times[i]).collect()
    }

    /// Largest jump of its rate, that from rest before time zero included, as a share of its largest rate; zero of a function given as
    /// code.
    pub fn largest_jump(&self) -> f64 {
        let (mut times, width) = (self.rate_jumps(0.0), f64::MIN_POSITIVE);
        match &self.function {
            TimeFunction::Function(_) | TimeFunction::Constant => return 0.0,
            TimeFunction::Harmonic { phase, .. } => return phase.cos().abs(),
            _ => times.push(0.0),
        }
        let last = self.kinks.last().copied().unwrap_or(0.0);
        let rate = |share: f64| self.rate(share * last, width).abs();
        let most = (0..400).map(|k| rate((f64::from(k) + 0.5) / 400.0)).fold(0.0, f64::max);
        let near = 1e-9 * last;
        let jump = |t: f64| {
            let before = if t <= 0.0 { 0.0 } else { self.rate_on(t, t - near, width) };
            (self.rate_on(t, t + near, width) - before).abs()
        };
        let jumps = times.iter().filter(|t| **t >= 0.0).map(|t| jump(*t));
        let largest = jumps.fold(0.0, f64::max);
        if largest == 0.0 { 0.0 } else { largest / most.max(largest) }
    }

    /// Mean over `[start, start + h]`: exact but for functions given as code, which are taken at three Gauss points.
    pub fn mean(&self, start: f64, h: f64) -> f64 {
        let end = start + h;
        let first = self.kinks.partition_point(|k| *k <= start);
        let inside = self.kinks[first..].iter().copied().take_while(|k| *k < end);
        let (mut sum, mut a) = (0.0, start);
        for b in inside {
            sum += (b - a) / h * self.smooth_mean(a, b - a);
            a = b;
        }
        if a == start {
            // Without a kink inside, lengths are not compared, for an interval of any length.
            return self.smooth_mean(start, h);
        }
        sum + (end - a) / h * self.smooth_mean(a, end - a)
    }

    /// Mean over an interval without kinks inside.
    fn smooth_mean(&self, start: f64, h: f64) -> f64 {
        use crate::math::hermite::{GAUSS_WEIGHTS, gauss_points};
        use TimeFunction::*;
        let middle = start + 0.5 * h;
        // The mean of a sine is the sine in the middle times sin(x)/x of half the angle.
        let damped =
            |half: f64| if half.abs() < 1e-4 { 1.0 - half * half / 6.0 } else { half.sin() / half };
        let pi = std::f64::consts::PI;
        match &self.function {
            Constant => 1.0,
            Step { .. } | Ramp { .. } | Triangle { .. } => self.value(middle),
            HalfSine { duration } => self.value(middle) * damped(0.5 * pi * h / duration),
            Harmonic { frequency, .. } => self.value(middle) * damped(pi * frequency * h),
            Table { .. } | Function(_) => {
                let at = |x: f64| self.value(start + x * h);
                gauss_points().into_iter().zip(GAUSS_WEIGHTS).map(|(x, w)| w * at(x)).sum()
            }
        }
    }
}

fn piecewise_linear(times: &[f64], values: &[f64], t: f64) -> f64 {
    let next = times.partition_point(|x| *x <= t);
    if next == 0 {
        return values[0];
    }
    if next == times.len() {
        return values[next - 1];
    }
    let f = (t - times[next - 1]) / (times[next] - times[next - 1]);
    values[next - 1] + f * (values[next] - values[next - 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One of each kind that varies.
    fn functions() -> [TimeFunction; 7] {
        let table = |smooth| TimeFunction::Table {
            times: vec![0.0, 0.4, 1.0, 1.5],
            values: vec![0.0, 2.0, -1.0, 0.5],
            smooth,
        };
        [
            TimeFunction::Step { at: 0.3 },
            TimeFunction::Ramp { duration: 0.7 },
            TimeFunction::HalfSine { duration: 1.2 },
            TimeFunction::Triangle { duration: 0.9 },
            TimeFunction::Harmonic { frequency: 0.5, phase: 0.4 },
            table(false),
            table(true),
        ]
    }

    #[test]
    fn means_are_integrals() {
        for f in functions() {
            let function = PreparedFunction::new(&f);
            for (start, h) in [(-0.1, 0.5), (0.2, 1.1), (1.4, 0.3)] {
                let n = 20_000;
                let sum: f64 = (0..n)
                    .map(|k| function.value(start + (k as f64 + 0.5) / n as f64 * h) / n as f64)
                    .sum();
                assert!((function.mean(start, h) - sum).abs() < 1e-4, "{f:?} {start}");
            }
        }
    }

    #[test]
    fn rates_are_derivatives() {
        let code = TimeFunction::function(|t| t * t);
        for f in functions().into_iter().chain([code]) {
            let function = PreparedFunction::new(&f);
            for t in [0.1, 0.35, 0.55, 1.1, 1.3, 2.0] {
                let difference = (function.value(t + 1e-6) - function.value(t - 1e-6)) / 2e-6;
                assert!((function.rate(t, 1e-5) - difference).abs() < 1e-5, "{f:?} {t}");
            }
            // A function that begins at zero starts the motion from there.
            assert!((function.rate(0.0, 1e-5) - function.rate(1e-9, 1e-5)).abs() < 1e-4, "{f:?}");
        }
    }

    #[test]
    fn a_tabled_mean_over_a_tiny_interval_is_its_value() {
        let times = vec![0.0, 1.0];
        let function = PreparedFunction::new(&TimeFunction::Table {
            times,
            values: vec![0.0, 3.0],
            smooth: false,
        });
        assert!((function.mean(0.5, 1e-14) - 1.5).abs() < 1e-12);
    }
}
