//! Natural cubic splines.

/// A cubic spline through values at increasing abscissae, of vanishing second derivative at both ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    /// Abscissae, increasing, shape (points) \[unit of the abscissa\].
    x: Vec<f64>,
    /// Values there, shape (points) \[unit of the value\].
    y: Vec<f64>,
    /// Second derivatives there, shape (points) \[unit of the value by the square of that of the abscissa\].
    bend: Vec<f64>,
}

impl Spline {
    /// The natural spline; `x` must increase and hold at least two values.
    pub fn natural(x: &[f64], y: &[f64]) -> Self {
        let n = x.len();
        let mut bend = vec![0.0; n];
        // Thomas algorithm for the inner second derivatives: strictly diagonally dominant, so without pivots.
        let mut gain = vec![0.0; n];
        for i in 1..n.saturating_sub(1) {
            let (a, b) = (x[i] - x[i - 1], x[i + 1] - x[i]);
            let pivot = 2.0 * (a + b) - a * gain[i - 1];
            gain[i] = b / pivot;
            let load = 6.0 * ((y[i + 1] - y[i]) / b - (y[i] - y[i - 1]) / a);
            bend[i] = (load - a * bend[i - 1]) / pivot;
        }
        for i in (1..n.saturating_sub(1)).rev() {
            bend[i] -= gain[i] * bend[i + 1];
        }
        Self { x: x.to_vec(), y: y.to_vec(), bend }
    }

    /// Value at `t`.
    pub fn value(&self, t: f64) -> f64 {
        let (i, h, a, b) = self.interval(t);
        let bend = (a * a * a - a) * self.bend[i] + (b * b * b - b) * self.bend[i + 1];
        a * self.y[i] + b * self.y[i + 1] + bend * h * h / 6.0
    }

    /// First derivative at `t`.
    pub fn slope(&self, t: f64) -> f64 {
        let (i, h, a, b) = self.interval(t);
        let bend = (3.0 * b * b - 1.0) * self.bend[i + 1] - (3.0 * a * a - 1.0) * self.bend[i];
        (self.y[i + 1] - self.y[i]) / h + bend * h / 6.0
    }

    /// Second derivative at `t`.
    pub fn bend(&self, t: f64) -> f64 {
        let (i, _, a, b) = self.interval(t);
        a * self.bend[i] + b * self.bend[i + 1]
    }

    /// Number of the interval that contains `t`, its length, and the shares of its ends.
    fn interval(&self, t: f64) -> (usize, f64, f64, f64) {
        let i = self.x.partition_point(|x| *x <= t).clamp(1, self.x.len() - 1) - 1;
        let h = self.x[i + 1] - self.x[i];
        (i, h, (self.x[i + 1] - t) / h, (t - self.x[i]) / h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spline_follows_a_sine_and_its_slope() {
        // Natural ends suit a sine between two of its zeros.
        let x: Vec<f64> = (0..=20).map(|i| f64::from(i) * std::f64::consts::PI / 20.0).collect();
        let y: Vec<f64> = x.iter().map(|x| x.sin()).collect();
        let spline = Spline::natural(&x, &y);
        for k in 0..100 {
            let t = f64::from(k) * 0.0314;
            assert!((spline.value(t) - t.sin()).abs() < 2e-6);
            assert!((spline.slope(t) - t.cos()).abs() < 5e-5);
        }
    }
}
