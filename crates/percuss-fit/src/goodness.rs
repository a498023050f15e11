//! How well computed curves follow measured ones.

use crate::channel::Channel;

/// How well a channel is met.
#[derive(Clone, Debug, PartialEq)]
pub struct Goodness {
    /// Name of its test.
    pub test: String,
    /// Its name.
    pub channel: String,
    /// Column of the history.
    pub column: String,
    /// SI unit.
    pub unit: String,
    /// Whether its test was kept out of the fit.
    pub hold_out: bool,
    /// Number of measured values.
    pub samples: usize,
    /// Standard deviation of the measured values as given, or from the residuals \[unit of the channel\].
    pub sigma: f64,
    /// Root mean square of the residuals \[unit of the channel\].
    pub rms: f64,
    /// Mean square of the residuals in standard deviations, per degree of freedom: 1 where they are noise.
    pub reduced_chi_square: f64,
    /// Share of the variance of the measured values that the computed ones explain.
    pub r_squared: f64,
    /// Correlation of neighbouring residuals: 0 where they are independent.
    pub autocorrelation: f64,
    /// Number of independent values with the same information, `n (1 - a) / (1 + a)` of the autocorrelation `a`.
    pub effective_samples: f64,
}

/// How well computed values meet a channel; `freedom` is the share of its values that are left as degrees of freedom.
pub(crate) fn goodness(
    (test, hold_out): (&str, bool),
    channel: &Channel,
    predicted: &[f64],
    sigma: f64,
    freedom: f64,
) -> Goodness {
    let residuals: Vec<f64> =
        predicted.iter().zip(&channel.measured).map(|(y, measured)| y - measured).collect();
    let n = residuals.len() as f64;
    let squares: f64 = residuals.iter().map(|r| r * r).sum();
    let mean = channel.measured.iter().sum::<f64>() / n;
    let spread: f64 = channel.measured.iter().map(|y| (y - mean).powi(2)).sum();
    let neighbours: f64 = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum();
    let autocorrelation = if squares > 0.0 { neighbours / squares } else { 0.0 };
    let positive = autocorrelation.clamp(0.0, 1.0);
    Goodness {
        test: test.into(),
        channel: channel.name.clone(),
        column: channel.column_name.clone(),
        unit: channel.unit.clone(),
        hold_out,
        samples: residuals.len(),
        sigma,
        rms: (squares / n).sqrt(),
        reduced_chi_square: squares / (sigma * sigma * n * freedom),
        r_squared: 1.0 - squares / spread,
        autocorrelation,
        effective_samples: (n * (1.0 - positive) / (1.0 + positive)).max(1.0),
    }
}
