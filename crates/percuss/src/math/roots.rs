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
    lo: (f64, f64),
    hi: (f64, f64),
    guess: f64,
    x_tolerance: f64,
    f_tolerance: f64,
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let mut search = Bracket::new(lo, hi, guess, [x_tolerance, f_tolerance]);
    loop {
        let x = search.propose();
        if search.take(f(x)?) {
            return Ok(x);
        }
    }
}

/// The same search with function values provided by the caller, for several searches in turns for instance.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bracket {
    /// Ends of the bracket with the values there, weighted.
    lo: (f64, f64),
    hi: (f64, f64),
    next: f64,
    /// On which side the last point was.
    last_side: i32,
    /// Points tried.
    trial: usize,
    x_tolerance: f64,
    f_tolerance: f64,
}

impl Bracket {
    const TRIALS: usize = 60;

    /// A search as that of [`bracketed`], with the tolerances of the argument and of the value.
    pub fn new(
        lo: (f64, f64),
        hi: (f64, f64),
        guess: f64,
        [x_tolerance, f_tolerance]: [f64; 2],
    ) -> Self {
        Self { lo, hi, next: guess, last_side: 0, trial: 0, x_tolerance, f_tolerance }
    }

    /// The next point to evaluate the function at.
    pub fn propose(&mut self) -> f64 {
        let inside = self.next > self.lo.0 && self.next < self.hi.0;
        if !inside || self.trial % 8 == 7 {
            self.next = 0.5 * (self.lo.0 + self.hi.0);
        }
        self.trial += 1;
        self.next
    }

    /// Enters the value there; returns whether the search has ended at that point.
    pub fn take(&mut self, y: f64) -> bool {
        let last = self.next;
        if y.abs() <= self.f_tolerance || self.hi.0 - self.lo.0 <= self.x_tolerance {
            return true;
        }
        // Anderson and Bjorck's weight for an end of the bracket that stays twice.
        let weight = |old: f64| if y / old < 1.0 { 1.0 - y / old } else { 0.5 };
        if y > 0.0 {
            if self.last_side > 0 {
                self.hi.1 *= weight(self.lo.1);
            }
            self.lo = (last, y);
            self.last_side = 1;
        } else {
            if self.last_side < 0 {
                self.lo.1 *= weight(self.hi.1);
            }
            self.hi = (last, y);
            self.last_side = -1;
        }
        let (lo, hi) = (self.lo, self.hi);
        self.next = (lo.0 * hi.1 - hi.0 * lo.1) / (hi.1 - lo.1);
        self.trial >= Self::TRIALS
    }
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
