//! Distributions of random values, through their quantiles.

use statrs::distribution::{ContinuousCDF, Normal};

/// A distribution; numbers are in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Distribution {
    /// Equally likely between two values.
    Uniform {
        /// Smallest.
        from: f64,
        /// Largest.
        to: f64,
    },
    /// Gaussian.
    Normal {
        /// Mean and standard deviation.
        law: Gauss,
        /// What is left of it.
        within: Truncation,
    },
    /// The logarithm is Gaussian.
    Lognormal {
        /// Mean and standard deviation of the logarithm.
        law: Gauss,
        /// What is left of it.
        within: Truncation,
    },
}

/// Mean and standard deviation of a Gaussian variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gauss {
    /// Mean.
    pub mean: f64,
    /// Standard deviation, above zero.
    pub deviation: f64,
}

/// The values to which a distribution is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truncation {
    /// Shares of all values below the smallest and the largest one, shape (2) \[-\].
    pub shares: [f64; 2],
    /// The smallest and the largest value, shape (2) \[SI unit of the parameter\].
    pub values: [f64; 2],
}

impl Truncation {
    /// Nothing is cut off.
    pub const NONE: Self = Self { shares: [0.0, 1.0], values: [f64::NEG_INFINITY, f64::INFINITY] };

    fn share(&self, u: f64) -> f64 {
        let [low, high] = self.shares;
        low + (high - low) * u
    }

    /// A quantile is the inverse of a share to some ten digits only: what lies a little outside is the limit.
    fn clamp(&self, value: f64) -> f64 {
        value.max(self.values[0]).min(self.values[1])
    }
}

impl Gauss {
    /// The logarithm of a variable with this mean and deviation, both above zero, if it is Gaussian.
    pub(crate) fn of_logarithm(mean: f64, deviation: f64) -> Self {
        let variance = (deviation / mean).powi(2).ln_1p();
        Self { mean: mean.ln() - 0.5 * variance, deviation: variance.sqrt() }
    }

    /// Share of values below `x`.
    pub(crate) fn share(self, x: f64) -> f64 {
        standard_share((x - self.mean) / self.deviation)
    }

    fn quantile(self, u: f64) -> f64 {
        self.mean + self.deviation * standard_quantile(u)
    }
}

impl Distribution {
    /// The value below which the share `u` lies.
    pub fn quantile(&self, u: f64) -> f64 {
        match self {
            Self::Uniform { from, to } => from + (to - from) * u,
            Self::Normal { law, within } => within.clamp(law.quantile(within.share(u))),
            Self::Lognormal { law, within } => within.clamp(law.quantile(within.share(u)).exp()),
        }
    }
}

/// Share of a standard Gaussian variable below `z`.
pub(crate) fn standard_share(z: f64) -> f64 {
    Normal::standard().cdf(z)
}

/// The value below which the share `u` of a standard Gaussian variable lies.
pub(crate) fn standard_quantile(u: f64) -> f64 {
    Normal::standard().inverse_cdf(u)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lognormal_variable_has_the_mean_and_deviation_that_were_asked_for() {
        let law = Gauss::of_logarithm(20.0, 5.0);
        let all = Distribution::Lognormal { law, within: Truncation::NONE };
        let n = 200_000;
        let values = (0..n).map(|i| all.quantile((f64::from(i) + 0.5) / f64::from(n)));
        let values: Vec<f64> = values.collect();
        let mean = values.iter().sum::<f64>() / f64::from(n);
        let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / f64::from(n);
        // The midpoint rule misses a little of the long tail.
        assert!((mean - 20.0).abs() < 1e-3, "{mean}");
        assert!((variance.sqrt() - 5.0).abs() < 1e-2, "{}", variance.sqrt());
    }

    #[test]
    fn truncation_keeps_every_value_inside() {
        let law = Gauss { mean: 10.0, deviation: 3.0 };
        let values = [9.0, 12.0];
        let within = Truncation { shares: values.map(|x| law.share(x)), values };
        let cut = Distribution::Normal { law, within };
        for u in [1e-12, 0.3, 0.9, 1.0 - 1e-12] {
            let value = cut.quantile(u);
            assert!((9.0..=12.0).contains(&value), "{value} at {u}");
        }
        for (u, limit) in [(0.0, 9.0), (1.0, 12.0)] {
            assert!((cut.quantile(u) - limit).abs() < 1e-9);
        }
        // No quantile lies beyond a limit, not by a digit.
        for most in [250.0_f64, 333.0, 1e3, 7.0, 61.0] {
            let law = Gauss::of_logarithm(0.8 * most, 0.2 * most);
            let values = [0.3 * most, most];
            let within = Truncation { shares: values.map(|x| law.share(x.ln())), values };
            let cut = Distribution::Lognormal { law, within };
            assert!(cut.quantile(1.0) <= most && cut.quantile(0.0) >= 0.3 * most, "{most}");
        }
    }
}
