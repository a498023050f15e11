//! Measured values without spikes of a row or two, for what a single wrong value must not decide.

/// Rows before and behind a value whose median, with itself, it is compared with: a rise and a level have their own values as medians.
const HALF: usize = 2;
/// Ratio of the standard deviation of normal noise to the median of its magnitudes.
pub(crate) const NORMAL: f64 = 1.4826;
/// A distance of so many times the noise is none of it.
const LEVEL: f64 = 5.0;
/// A spike is farther from the median than this share of the range of the medians.
const SPIKE: f64 = 0.25;

/// Values with running medians in place of spikes; the values themselves where no median leaves the noise, since what is measured lasts for
/// a row or two.
pub(crate) fn without_spikes(values: &[f64]) -> Vec<f64> {
    let last = values.len().saturating_sub(1);
    let around = |k: usize| {
        let half = HALF.min(k).min(last - k);
        median(values[k - half..=k + half].to_vec())
    };
    let medians: Vec<f64> = (0..values.len()).map(around).collect();
    let distances = medians.iter().zip(values).map(|(m, v)| (v - m).abs());
    let noise = LEVEL * NORMAL * median(distances.collect());
    let inner = medians.get(1..last).unwrap_or_default();
    let highest = inner.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let lowest = inner.iter().copied().fold(f64::INFINITY, f64::min);
    let range = highest - lowest;
    let limit = if range > noise { noise.max(SPIKE * range) } else { f64::INFINITY };
    let both = medians.iter().zip(values);
    both.map(|(m, v)| if (v - m).abs() > limit { *m } else { *v }).collect()
}

/// The median of values, the upper one of an even number; NaN if there are none.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spikes_vanish_and_rises_stay() {
        let mut values = vec![0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 4.0, 8.0, 8.0, 8.0];
        let clean = values.clone();
        for (spikes, height) in [(&[2][..], 50.0), (&[2, 3], -50.0), (&[7], 90.0)] {
            spikes.iter().for_each(|k| values[*k] = height);
            let found = without_spikes(&values);
            assert!(found.iter().all(|v| (0.0..=8.0).contains(v)), "{spikes:?}: {found:?}");
            values.clone_from(&clean);
        }
        assert_eq!(without_spikes(&clean), clean);
    }

    #[test]
    fn a_pulse_of_one_row_is_kept_where_there_is_nothing_else() {
        let pulse = [0.0, 0.1, 0.0, -0.1, 9.0, 0.1, 0.0, -0.1, 0.1];
        assert_eq!(without_spikes(&pulse), pulse);
        assert_eq!(without_spikes(&[1.0]), [1.0]);
        assert!(without_spikes(&[]).is_empty());
    }
}
