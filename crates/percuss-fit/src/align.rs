//! The onset of a curve: when it leaves its initial value.

use crate::curve::Curve;

/// The onset lies where the curve passes this share of its largest distance from the initial value.
const ONSET: f64 = 0.1;
/// It is sought backwards from where the curve first passes this share, so that noise before it is not taken for it.
const RISE: f64 = 0.5;
/// The initial value of a record is the median of this part of its rows.
const INITIAL: usize = 50;

/// Where a curve comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Origin {
    /// Measured, with noise, from before the test on.
    Measured,
    /// Computed: its first value is its initial one, and it may leave that at once.
    Computed,
}

/// Time at which a curve leaves its initial value \[s\]; none for one that is constant.
pub(crate) fn onset(curve: &Curve, origin: Origin) -> Option<f64> {
    let rows = match origin {
        Origin::Measured => (curve.values.len() / INITIAL).max(1),
        Origin::Computed => 1,
    };
    let mut first: Vec<f64> = curve.values.iter().take(rows).copied().collect();
    first.sort_by(f64::total_cmp);
    let initial = *first.get(first.len() / 2)?;
    let distance: Vec<f64> = curve.values.iter().map(|v| (v - initial).abs()).collect();
    // The first row has the initial value, unless it is wrong.
    let largest = distance.iter().skip(1).copied().fold(0.0, f64::max);
    if largest.is_nan() || largest <= 0.0 {
        return None;
    }
    let risen = 1 + distance.iter().skip(1).position(|d| *d >= RISE * largest)?;
    let Some(below) = distance[..risen].iter().rposition(|d| *d < ONSET * largest) else {
        return curve.time.first().copied();
    };
    let (from, to) = (distance[below], distance[below + 1]);
    let share = (ONSET * largest - from) / (to - from);
    Some(curve.time[below] + share * (curve.time[below + 1] - curve.time[below]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spikes::without_spikes;

    #[test]
    fn the_onset_is_where_a_curve_rises_whatever_lies_before() {
        let time: Vec<f64> = (0..401).map(|k| 0.01 * f64::from(k)).collect();
        // A ramp from t = 1 with noise of five per cent of its height.
        let ramp = |t: &f64| {
            3.0 + (t - 1.0).clamp(0.0, 1.0) + 0.05 * (97.0 * t).sin() * f64::from(*t < 0.9)
        };
        let curve = Curve { values: time.iter().map(ramp).collect(), time };
        let found = onset(&curve, Origin::Measured).expect("an onset");
        // A tenth of the height; the noise shifts the initial value by half of one tenth at most.
        assert!((found - 1.1).abs() < 0.05, "{found}");
        // A single value of thirty times the height, before the onset or first of all.
        for spike in [0, 60] {
            let mut values = curve.values.clone();
            values[spike] = 33.0;
            let curve = Curve { values: without_spikes(&values), time: curve.time.clone() };
            let found = onset(&curve, Origin::Measured).expect("an onset");
            assert!((found - 1.1).abs() < 0.05, "{spike}: {found}");
        }
        let level = Curve { time: vec![0.0, 1.0], values: vec![2.0, 2.0] };
        assert_eq!(onset(&level, Origin::Computed), None);
        let at_once = Curve { time: vec![0.0, 1.0, 2.0], values: vec![0.0, 10.0, 0.0] };
        assert_eq!(onset(&at_once, Origin::Computed), Some(0.1));
    }
}
