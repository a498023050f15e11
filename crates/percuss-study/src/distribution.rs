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
        /// Shares below which the truncation begins and ends: 0 and 1 without one.
        within: [f64; 2],
    },
    /// The logarithm is Gaussian.
    Lognormal {
        /// Mean and standard deviation of the logarithm.
        law: Gauss,
        /// Shares below which the truncation begins and ends: 0 and 1 without one.
        within: [f64; 2],
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
        let inside = |[low, high]: [f64; 2]| low + (high - low) * u;
        match self {
            Self::Uniform { from, to } => from + (to - from) * u,
            Self::Normal { law, within } => law.quantile(inside(*within)),
            Self::Lognormal { law, within } => law.quantile(inside(*within)).exp(),
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
        let all = Distribution::Lognormal { law, within: [0.0, 1.0] };
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
        let within = [law.share(9.0), law.share(12.0)];
        let cut = Distribution::Normal { law, within };
        for u in [1e-12, 0.3, 0.9, 1.0 - 1e-12] {
            let value = cut.quantile(u);
            assert!((9.0..=12.0).contains(&value), "{value} at {u}");
        }
        assert!((cut.quantile(0.0) - 9.0).abs() < 1e-9);
        assert!((cut.quantile(1.0) - 12.0).abs() < 1e-9);
    }
}
