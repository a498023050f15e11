//! How values are spread.

/// Statistics of the finite values of a column.
#[derive(Clone, Debug, PartialEq)]
pub struct Spread {
    /// Number of values.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation of the sample.
    pub deviation: f64,
    /// The values in ascending order.
    sorted: Vec<f64>,
}

/// Counts of values in equal parts of their range.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// Ends of the parts, one more than there are parts.
    pub edges: Vec<f64>,
    /// Share of the values in each part, divided by its width.
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

    /// Share of the values above `x`.
    pub fn exceedance(&self, x: f64) -> f64 {
        (self.count - self.sorted.partition_point(|value| *value <= x)) as f64 / self.count as f64
    }

    /// Smallest value.
    pub fn min(&self) -> f64 {
        self.sorted[0]
    }

    /// Largest value.
    pub fn max(&self) -> f64 {
        self.sorted[self.count - 1]
    }

    /// The values in ascending order, thinned evenly to at most `most`, both ends kept; with the share at or below each.
    pub fn distribution(&self, most: usize) -> Vec<(f64, f64)> {
        let n = self.count;
        let shown = n.min(most.max(2));
        let place = |k: usize| if shown < 2 { 0 } else { k * (n - 1) / (shown - 1) };
        (0..shown).map(place).map(|k| (self.sorted[k], (k + 1) as f64 / n as f64)).collect()
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
        assert_eq!(Spread::of(&[f64::NAN]), None);
    }
}
