//! How values are spread.

use super::confidence::{mean_interval, quantile_ranks};

/// Statistics of the finite values of a column.
#[derive(Clone, Debug, PartialEq)]
pub struct Spread {
    /// Number of values.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation of the sample.
    pub deviation: f64,
    /// The values in ascending order, shape (values) \[unit of the values\].
    sorted: Vec<f64>,
}

/// Counts of values in equal parts of their range.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// Ends of the parts, one more than there are parts, shape (parts + 1) \[unit of the values\].
    pub edges: Vec<f64>,
    /// Share of the values in each part, divided by its width, shape (parts) \[1 by the unit of the values\].
    pub density: Vec<f64>,
}

impl Spread {
    /// Statistics of the finite ones of these values; `None` if there are none.
    pub fn of(values: &[f64]) -> Option<Self> {
        let mut sorted: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let count = sorted.len();
        let mean = sorted.iter().sum::<f64>() / count as f64;
        let squares = sorted.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
        let deviation = (squares / count.saturating_sub(1).max(1) as f64).sqrt();
        (count > 0).then_some(Self { count, mean, deviation, sorted })
    }

    /// The value below which the share `p` of them lies, interpolated.
    pub fn quantile(&self, p: f64) -> f64 {
        let at = p.clamp(0.0, 1.0) * (self.count - 1) as f64;
        let (low, high) = (self.sorted[at.floor() as usize], self.sorted[at.ceil() as usize]);
        low + (high - low) * at.fract()
    }

    /// 95 % interval of the mean (Student's).
    pub fn mean_interval(&self) -> [f64; 2] {
        mean_interval(self.mean, self.deviation, self.count)
    }

    /// 95 % interval of the quantile `p`, between two of the values, whatever the distribution; NaN on a side that so few values do
    /// not bound.
    pub fn quantile_interval(&self, p: f64) -> [f64; 2] {
        let at = |rank: usize| self.sorted.get(rank.wrapping_sub(1)).copied().unwrap_or(f64::NAN);
        quantile_ranks(p, self.count).map(at)
    }

    /// Number of values above `x`.
    pub fn above(&self, x: f64) -> usize {
        self.count - self.sorted.partition_point(|value| *value <= x)
    }

    /// Share of the values above `x`.
    pub fn exceedance(&self, x: f64) -> f64 {
        self.above(x) as f64 / self.count as f64
    }

    /// The smallest value that at most `count` values exceed.
    pub fn exceeded_by(&self, count: usize) -> f64 {
        self.sorted[self.count.saturating_sub(count + 1)]
    }

    /// Smallest value.
    pub fn min(&self) -> f64 {
        self.sorted[0]
    }

    /// Largest value.
    pub fn max(&self) -> f64 {
        self.sorted[self.count - 1]
    }

    /// Steps of the empirical distribution: values in ascending order, each once, with the number of values at or below each.
    ///
    /// Beyond `most` the middle is thinned evenly; half of them stay in the upper tail and a quarter in the lower one, every step of
    /// these whole.
    pub fn steps(&self, most: usize) -> Vec<(f64, usize)> {
        let last = |k: &usize| self.sorted.get(k + 1).is_none_or(|next| *next > self.sorted[*k]);
        let all: Vec<usize> = (0..self.count).filter(last).collect();
        let (n, lower, upper) = (all.len(), most / 4, most / 2);
        let inner = most.saturating_sub(lower + upper).max(1);
        let shown = |place: usize| {
            let middle = n.saturating_sub(lower + upper).max(1);
            let (before, next) = (place.saturating_sub(lower), place.saturating_sub(lower) + 1);
            let passes = before * inner / middle != next * inner / middle;
            n <= most || place < lower || place + upper >= n || passes
        };
        let kept = (0..n).filter(|place| shown(*place));
        kept.map(|place| (self.sorted[all[place]], all[place] + 1)).collect()
    }

    /// Counts in parts as wide as Freedman and Diaconis advise, 4 to 80 of them; `None` if all values are equal.
    pub fn histogram(&self) -> Option<Histogram> {
        let range = self.max() - self.min();
        if range <= 0.0 {
            return None;
        }
        let width = 2.0 * (self.quantile(0.75) - self.quantile(0.25)) / (self.count as f64).cbrt();
        let parts = if width > 0.0 { (range / width).ceil() } else { 4.0 };
        let parts = parts.clamp(4.0, 80.0) as usize;
        let edges: Vec<f64> =
            (0..=parts).map(|k| self.min() + range * k as f64 / parts as f64).collect();
        let mut density = vec![0.0; parts];
        let share = 1.0 / self.count as f64 / (range / parts as f64);
        for value in &self.sorted {
            let part = ((value - self.min()) / range * parts as f64) as usize;
            density[part.min(parts - 1)] += share;
        }
        Some(Histogram { edges, density })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_histogram_holds_every_value_once() {
        let values: Vec<f64> = (0..1000).map(|k| f64::from(k).sqrt()).collect();
        let spread = Spread::of(&values).expect("values");
        let histogram = spread.histogram().expect("parts");
        let parts = histogram.edges.windows(2).zip(&histogram.density);
        let all: f64 = parts.map(|(ends, density)| (ends[1] - ends[0]) * density).sum();
        assert!((all - 1.0).abs() < 1e-12, "{all}");
    }

    #[test]
    fn quantiles_and_exceedances_belong_together() {
        let values: Vec<f64> = (1..=100).map(f64::from).collect();
        let spread = Spread::of(&values).expect("values");
        assert_eq!((spread.min(), spread.max(), spread.mean), (1.0, 100.0, 50.5));
        assert_eq!(spread.quantile(0.5), 50.5);
        assert_eq!(spread.exceedance(90.0), 0.1);
        assert_eq!(spread.exceeded_by(10), 90.0);
        assert_eq!(Spread::of(&[f64::NAN]), None);
    }

    #[test]
    fn steps_keep_the_tail_whole_however_many_values_there_are() {
        let values: Vec<f64> = (0..20_000).map(|k| f64::from(k / 2)).collect();
        let steps = Spread::of(&values).expect("values").steps(800);
        assert!((700..=800).contains(&steps.len()), "{}", steps.len());
        // The upper 400 steps, two values each, end with all values.
        for (k, (value, below)) in steps.iter().rev().take(400).enumerate() {
            assert_eq!((*value, *below), (9999.0 - k as f64, 20_000 - 2 * k));
        }
        assert!(steps.windows(2).all(|w| w[0].0 < w[1].0 && w[0].1 < w[1].1));
        let few = Spread::of(&[1.0, 1.0, 3.0]).expect("values");
        assert_eq!(few.steps(800), [(1.0, 2), (3.0, 3)]);
    }
}
