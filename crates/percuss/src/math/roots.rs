//! Bracketed root search.

/// Finds a root of a continuous function between `lo` and `hi`, where `f(lo) > 0 >= f(hi)`.
///
/// Regula falsi with the Anderson-Bjorck weight: superlinear, never leaves the bracket. `guess` is tried first. Stops
/// when `|f| <= f_tolerance` or the bracket is narrower than `x_tolerance`; returns the last point tried, which is
/// always one at which `f` was evaluated last (so that a solver's workspace holds the state belonging to it).
///
/// # Errors
/// The first error of `f`.
pub fn bracketed<E>(
    mut lo: (f64, f64),
    mut hi: (f64, f64),
    guess: f64,
    x_tolerance: f64,
    f_tolerance: f64,
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    const TRIALS: usize = 60;
    let mut next = guess;
    let mut last = guess;
    let mut last_side = 0;
    for trial in 0..TRIALS {
        if !(next > lo.0 && next < hi.0) || trial % 8 == 7 {
            next = 0.5 * (lo.0 + hi.0);
        }
        last = next;
        let y = f(last)?;
        if y.abs() <= f_tolerance || hi.0 - lo.0 <= x_tolerance {
            break;
        }
        // Anderson and Bjorck's weight for an end of the bracket that stays twice.
        let weight = |old: f64| if y / old < 1.0 { 1.0 - y / old } else { 0.5 };
        if y > 0.0 {
            if last_side > 0 {
                hi.1 *= weight(lo.1);
            }
            lo = (last, y);
            last_side = 1;
        } else {
            if last_side < 0 {
                lo.1 *= weight(hi.1);
            }
            hi = (last, y);
            last_side = -1;
        }
        next = (lo.0 * hi.1 - hi.0 * lo.1) / (hi.1 - lo.1);
    }
    Ok(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_root_and_ends_on_its_last_evaluation() {
        let mut last = f64::NAN;
        let f = |x: f64| 2.0 - x * x * x;
        let root = bracketed((0.0, 2.0), (2.0, -6.0), 0.3, 1e-15, 1e-14, |x| {
            last = x;
            Ok::<_, ()>(f(x))
        });
        assert_eq!(root, Ok(last));
        assert!((last - 2.0_f64.cbrt()).abs() < 1e-14);
    }
}
