//! Intervals of confidence for means, quantiles and shares of a sample.

use statrs::distribution::{Beta, Binomial, ContinuousCDF, DiscreteCDF, StudentsT};

/// Chance that an interval misses on either side.
const TAIL: f64 = 0.025;

/// The interval of Clopper and Pearson (1934) for the probability of an event that `k` of `n` independent runs had: it holds the
/// probability at least 95 times in 100, however small it is.
pub fn share_interval(k: usize, n: usize) -> [f64; 2] {
    let quantile = |a: usize, b: usize, p: f64| {
        Beta::new(a as f64, b as f64).map_or(f64::NAN, |beta| beta.inverse_cdf(p))
    };
    let low = if k == 0 { 0.0 } else { quantile(k, n - k + 1, TAIL) };
    let high = if k >= n { 1.0 } else { quantile(k + 1, n - k, 1.0 - TAIL) };
    [low, high]
}

/// Student's 95 % interval for the mean of which a sample of `n` has this mean and deviation; NaN for fewer than two.
pub(super) fn mean_interval(mean: f64, deviation: f64, n: usize) -> [f64; 2] {
    if n < 2 {
        return [f64::NAN; 2];
    }
    let t = StudentsT::new(0.0, 1.0, (n - 1) as f64);
    let half = t.map_or(f64::NAN, |t| t.inverse_cdf(1.0 - TAIL)) * deviation / (n as f64).sqrt();
    [mean - half, mean + half]
}

/// Ranks, counted from one, of the values between which the quantile `p` lies at least 95 times in 100, whatever the
/// distribution; zero, or one more than there are values, where the sample is too small to bound it.
pub(super) fn quantile_ranks(p: f64, n: usize) -> [usize; 2] {
    let Ok(binomial) = Binomial::new(p, n as u64) else { return [0, n + 1] };
    // The value of rank r lies above the quantile if fewer than r values lie below: chance P(B <= r - 1).
    let chance = |rank: usize| if rank == 0 { 0.0 } else { binomial.cdf(rank as u64 - 1) };
    let first_above = |limit: f64| {
        let (mut low, mut high) = (0, n + 1);
        while low < high {
            let middle = usize::midpoint(low, high);
            if middle <= n && chance(middle) < limit { low = middle + 1 } else { high = middle }
        }
        low
    };
    [first_above(TAIL).saturating_sub(1), first_above(1.0 - TAIL)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_have_the_intervals_of_the_binomial_tails() {
        // None of n: 1 - TAIL^(1/n); one of ten and five of ten as tabulated by Clopper and Pearson (1934).
        let [low, high] = share_interval(0, 20);
        assert!(low == 0.0 && (high - (1.0 - TAIL.powf(0.05))).abs() < 1e-9, "{high}");
        for (k, n, low, high) in [(1, 10, 0.0025, 0.4450), (5, 10, 0.1871, 0.8129)] {
            let found = share_interval(k, n);
            assert!((found[0] - low).abs() < 1e-4 && (found[1] - high).abs() < 1e-4, "{found:?}");
        }
        assert_eq!(share_interval(7, 7)[1], 1.0);
    }

    #[test]
    fn the_median_of_ten_lies_between_the_second_and_the_ninth() {
        // David and Nagaraja, Order Statistics: coverage 0.9785, and 0.8906 for the third and the eighth.
        assert_eq!(quantile_ranks(0.5, 10), [2, 9]);
        // Five values do not bound a median: 1 - 2 / 32 is below 0.95.
        assert_eq!(quantile_ranks(0.5, 5), [0, 6]);
        assert_eq!(quantile_ranks(0.99, 50)[1], 51);
    }

    #[test]
    fn the_interval_of_a_mean_is_students() {
        // t of 9 degrees of freedom at 0.975: 2.262157.
        let [low, high] = mean_interval(1.0, 2.0, 10);
        let half = 2.262_157_163 * 2.0 / 10f64.sqrt();
        assert!((low - 1.0 + half).abs() < 1e-6 && (high - 1.0 - half).abs() < 1e-6);
        assert!(mean_interval(1.0, 0.0, 1)[0].is_nan());
    }
}
