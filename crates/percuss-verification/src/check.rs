//! A number measured against a number expected.

/// How close a measured number must be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// Relative to the expected number.
    Relative(f64),
    /// Absolute.
    Absolute(f64),
    /// The measured number must not exceed the expected one.
    AtMost,
    /// The measured number must not fall below the expected one.
    AtLeast,
}

/// One comparison of a verification case.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// What is compared, with its unit.
    pub quantity: String,
    /// The number expected.
    pub expected: f64,
    /// The number measured.
    pub measured: f64,
    /// How close they must be.
    pub tolerance: Tolerance,
}

impl Check {
    /// Whether the comparison holds; a number that is not one never does.
    pub fn holds(&self) -> bool {
        self.deviation().is_some_and(|d| match self.tolerance {
            Tolerance::Relative(t) | Tolerance::Absolute(t) => d <= t,
            Tolerance::AtMost => self.measured <= self.expected,
            Tolerance::AtLeast => self.measured >= self.expected,
        })
    }

    /// Distance from the expected number, in the sense of the tolerance; none if a number is missing.
    pub fn deviation(&self) -> Option<f64> {
        let distance = (self.measured - self.expected).abs();
        let deviation = match self.tolerance {
            Tolerance::Relative(_) => distance / self.expected.abs(),
            Tolerance::Absolute(_) => distance,
            Tolerance::AtMost | Tolerance::AtLeast => self.measured,
        };
        (!deviation.is_nan()).then_some(deviation)
    }
}

/// Collects the checks of a case.
#[derive(Clone, Debug, Default)]
pub struct Checks(Vec<Check>);

impl Checks {
    /// No checks yet.
    pub fn new() -> Self {
        Self::default()
    }

    fn push(&mut self, quantity: impl Into<String>, measured: f64, expected: f64, t: Tolerance) {
        self.0.push(Check { quantity: quantity.into(), expected, measured, tolerance: t });
    }

    /// `measured` equals `expected` within a relative tolerance.
    pub fn relative(&mut self, what: impl Into<String>, measured: f64, expected: f64, t: f64) {
        self.push(what, measured, expected, Tolerance::Relative(t));
    }

    /// `measured` equals `expected` within an absolute tolerance.
    pub fn absolute(&mut self, what: impl Into<String>, measured: f64, expected: f64, t: f64) {
        self.push(what, measured, expected, Tolerance::Absolute(t));
    }

    /// `measured` is at most `limit`.
    pub fn at_most(&mut self, what: impl Into<String>, measured: f64, limit: f64) {
        self.push(what, measured, limit, Tolerance::AtMost);
    }

    /// `measured` is at least `limit`.
    pub fn at_least(&mut self, what: impl Into<String>, measured: f64, limit: f64) {
        self.push(what, measured, limit, Tolerance::AtLeast);
    }

    /// The checks collected.
    pub fn into_vec(self) -> Vec<Check> {
        self.0
    }
}
