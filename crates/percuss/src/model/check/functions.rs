//! Functions of time given by a user.

use super::faults::Faults;
use crate::model::time_function::TimeFunction;

pub(super) fn check_function(function: &TimeFunction, path: String, out: &mut Faults) {
    use TimeFunction::*;
    match function {
        Constant | Function(_) => {}
        Step { at } => out.finite(path, &[*at], "s"),
        Ramp { duration } | HalfSine { duration } | Triangle { duration } => {
            out.positive(path, *duration, "a duration", "s");
        }
        Harmonic { frequency, phase } => out.finite(path, &[*frequency, *phase], ""),
        Table { times, values, .. } => {
            if times.len() != values.len() || times.len() < 2 {
                let found = format!("{} times and {} values", times.len(), values.len());
                out.add(path, found, "at least two times, and as many values");
            } else if times.iter().chain(values).any(|x| !x.is_finite()) {
                out.add(path, "numbers that are not finite", "finite numbers");
            } else if let Some(i) = times.windows(2).position(|w| w[1] <= w[0]) {
                let found = format!("{} s after {} s", times[i + 1], times[i]);
                out.add(path, found, "times that increase");
            }
        }
    }
}

/// Smallest and largest factor of a load with a function, shape (2) \[-\]; zero, which it has before and after, is among them. Of a table they are its
/// values; those of a function given as code are not known.
pub(super) fn factors(function: &TimeFunction) -> [f64; 2] {
    use TimeFunction::*;
    match function {
        Constant | Step { .. } | Ramp { .. } | HalfSine { .. } | Triangle { .. } => [0.0, 1.0],
        Harmonic { .. } => [-1.0, 1.0],
        Table { values, .. } => {
            let of = |pick: fn(f64, f64) -> f64| values.iter().copied().fold(0.0, pick);
            [of(f64::min), of(f64::max)]
        }
        Function(_) => [0.0; 2],
    }
}
