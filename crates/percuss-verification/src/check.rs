//! Comparison of a computed number with an expected one.

/// Tolerance of a comparison.
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
    /// Compared quantity, with its unit.
    pub quantity: String,
    /// The number expected.
    pub expected: f64,
    /// The number measured.
    pub measured: f64,
    /// Tolerance.
    pub tolerance: Tolerance,
}

impl Check {
    /// Whether the comparison holds; NaN never does.
    pub fn holds(&self) -> bool {
        self.deviation().is_some_and(|d| match self.tolerance {
            Tolerance::Relative(t) | Tolerance::Absolute(t) => d <= t,
            Tolerance::AtMost => self.measured <= self.expected,
            Tolerance::AtLeast => self.measured >= self.expected,
        })
    }

    /// Distance from the expected number, in the sense of the tolerance; `None` if a number is missing.
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

/// Result of a case: its checks, and the figures and files shown in the manual.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Its comparisons, shape (checks).
    pub checks: Vec<Check>,
    /// Figures of curves and their references, shape (figures).
    pub figures: Vec<Figure>,
    /// Scenario files of the case, as (name, text), shape (files).
    pub files: Vec<(&'static str, String)>,
}

/// A figure of the manual.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Title.
    pub title: String,
    /// The axes, with their units, shape (2).
    pub axes: [&'static str; 2],
    /// Whether both axes are logarithmic, as for errors over sizes.
    pub logarithmic: bool,
    /// Curves, shape (curves).
    pub curves: Vec<Curve>,
}

/// A curve of a figure.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Label.
    pub name: String,
    /// Its points, shape (n, 2) \[unit of either axis\], in the units of the axes.
    pub points: Vec<[f64; 2]>,
    /// Whether it is the reference.
    pub reference: bool,
}

impl Curve {
    /// A curve computed by Percuss.
    pub fn computed(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self { name: name.into(), points, reference: false }
    }

    /// A reference curve.
    pub fn reference(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self { name: name.into(), points, reference: true }
    }
}

/// Slope of a straight line through the logarithms of (size, error), least squares; NaN with fewer than two errors above zero.
pub fn observed_order(points: &[[f64; 2]]) -> f64 {
    let logs: Vec<[f64; 2]> =
        points.iter().filter(|p| p[0] > 0.0 && p[1] > 0.0).map(|p| p.map(f64::ln)).collect();
    let n = logs.len() as f64;
    let mean = |k: usize| logs.iter().map(|p| p[k]).sum::<f64>() / n;
    let (x, y) = (mean(0), mean(1));
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| logs.iter().map(f).sum::<f64>();
    sum(&|p| (p[0] - x) * (p[1] - y)) / sum(&|p| (p[0] - x).powi(2))
}

/// Collects the checks of a case.
#[derive(Clone, Debug, Default)]
pub struct Checks(Report);

impl Checks {
    /// An empty list of checks.
    pub fn new() -> Self {
        Self::default()
    }

    fn push(&mut self, quantity: impl Into<String>, measured: f64, expected: f64, t: Tolerance) {
        self.0.checks.push(Check { quantity: quantity.into(), expected, measured, tolerance: t });
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

    /// A figure for the manual.
    pub fn figure(
        &mut self,
        title: impl Into<String>,
        axes: [&'static str; 2],
        curves: impl Into<Vec<Curve>>,
    ) {
        let (title, curves) = (title.into(), curves.into());
        self.0.figures.push(Figure { title, axes, logarithmic: false, curves });
    }

    /// Errors over sizes of elements, steps or fibres, shape (n, 2), on logarithmic axes; returns the observed order, which the figure states.
    pub fn convergence(
        &mut self,
        title: impl Into<String>,
        axes: [&'static str; 2],
        points: Vec<[f64; 2]>,
    ) -> f64 {
        let order = observed_order(&points);
        let curves = vec![Curve::computed(format!("order {order:.2}"), points)];
        self.0.figures.push(Figure { title: title.into(), axes, logarithmic: true, curves });
        order
    }

    /// Adds a scenario file, which the manual shows with a sketch.
    pub fn file(&mut self, name: &'static str, text: impl Into<String>) {
        self.0.files.push((name, text.into()));
    }

    /// The collected checks, figures and files.
    pub fn into_report(self) -> Report {
        self.0
    }
}
