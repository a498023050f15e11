//! Confidence by resampling.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Times a sample is drawn again, as long as that is cheap.
const RESAMPLES: usize = 1000;
/// Values looked at in all resamples together, about.
const EFFORT: usize = 400_000_000;
/// Fewest resamples that make an interval.
const FEWEST: usize = 100;
/// Share of the resamples within the interval.
const CONFIDENCE: f64 = 0.95;

/// An estimate with its interval of confidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Lower end of the interval that holds 95 % of the resampled estimates.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// Estimates `statistic`, several numbers of a sample of `n` points, and their intervals; `values` counts what one evaluation
/// looks at.
///
/// The statistic gets the numbers of the points that count, each as often as it was drawn.
pub(super) fn bootstrap(
    n: usize,
    values: usize,
    seed: u64,
    statistic: impl Fn(&[u32]) -> Vec<f64>,
) -> Vec<Estimate> {
    let all: Vec<u32> = (0..n as u32).collect();
    let best = statistic(&all);
    let times = (EFFORT / values.max(1)).clamp(FEWEST, RESAMPLES);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut drawn = vec![0; n];
    let mut resampled: Vec<Vec<f64>> = vec![Vec::with_capacity(times); best.len()];
    for _ in 0..times {
        drawn.iter_mut().for_each(|point| *point = below(n as u64, &mut random) as u32);
        let again = statistic(&drawn);
        resampled.iter_mut().zip(again).for_each(|(all, one)| all.push(one));
    }
    let estimate = |(value, mut again): (f64, Vec<f64>)| {
        again.retain(|x| x.is_finite());
        again.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let last = again.len().saturating_sub(1) as f64;
            again.get((share * last).round() as usize).copied().unwrap_or(f64::NAN)
        };
        let tail = 0.5 * (1.0 - CONFIDENCE);
        Estimate { value, low: at(tail), high: at(1.0 - tail) }
    };
    best.into_iter().zip(resampled).map(estimate).collect()
}

/// A random whole number below `n`, by Lemire's multiplication; its bias of n / 2^64 is of no account.
fn below(n: u64, random: &mut ChaCha8Rng) -> u64 {
    ((u128::from(random.next_u64()) * u128::from(n)) >> 64) as u64
}
