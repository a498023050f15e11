//! Curves over time: interpolated, filtered, differentiated.

use percuss_output::shock::{Cfc, ShockError, Signal, filtered};

/// An even sampling has at most so many samples a row.
const SAMPLES_A_ROW: f64 = 8.0;
/// Steps that differ by less than this share are equal.
const EQUAL: f64 = 1e-6;

/// A curve over time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curve {
    /// Times, not decreasing, shape (n_row) \[s\].
    pub time: Vec<f64>,
    /// Values, shape (n_row) \[unit of the channel\].
    pub values: Vec<f64>,
}

impl Curve {
    /// The value at a time, linear between rows; before the first and behind the last row that of the row.
    pub fn at(&self, time: f64) -> f64 {
        let next = self.time.partition_point(|t| *t <= time);
        let last = self.time.len().saturating_sub(1);
        if next == 0 {
            return self.values.first().copied().unwrap_or(f64::NAN);
        }
        if next > last {
            return self.values[last];
        }
        let (from, to) = (self.time[next - 1], self.time[next]);
        let share = (time - from) / (to - from);
        self.values[next - 1] + share * (self.values[next] - self.values[next - 1])
    }

    /// The derivative of [`Curve::at`] by time; at a row, the one behind it.
    pub fn rate(&self, time: f64) -> f64 {
        let next = self.time.partition_point(|t| *t <= time);
        if next == 0 || next >= self.time.len() {
            return 0.0;
        }
        let step = self.time[next] - self.time[next - 1];
        (self.values[next] - self.values[next - 1]) / step
    }

    /// Median distance of rows \[s\], not much below their mean one.
    fn spacing(&self) -> f64 {
        let mut steps: Vec<f64> = self.time.windows(2).map(|pair| pair[1] - pair[0]).collect();
        steps.retain(|step| *step > 0.0);
        steps.sort_by(f64::total_cmp);
        let mean = self.length() / steps.len().max(1) as f64;
        steps.get(steps.len() / 2).map_or(1.0, |median| median.max(mean / SAMPLES_A_ROW))
    }

    fn length(&self) -> f64 {
        match self.time[..] {
            [first, .., last] => last - first,
            _ => 0.0,
        }
    }

    /// The curve in a channel frequency class, evenly sampled.
    ///
    /// The filter has no phase: a change at the start of the curve is felt before it. The filtered curve is therefore longer, by the memory
    /// of the filter at either end, and has the initial and the last value of the curve there.
    ///
    /// # Errors
    /// If its rows are too far apart for the class.
    pub fn filtered(&self, class: Cfc) -> Result<Self, ShockError> {
        let step = self.spacing();
        let count = (self.length() / step).round().max(1.0) as usize;
        let step = self.length() / count as f64;
        let start = self.time.first().copied().unwrap_or(0.0);
        let room = (class.memory() / step).ceil() as usize;
        let start = start - step * room as f64;
        let values = (0..=count + 2 * room).map(|k| self.at(start + step * k as f64)).collect();
        let signal = filtered(&Signal { start, step, values, resampled: true }, class)?;
        let even = (signal.step - step).abs() <= EQUAL * step;
        debug_assert!(even, "a filter keeps the sampling");
        Ok(Self { time: signal.times().collect(), values: signal.values })
    }

    /// The mean rate of change over each step, at the middle of it: an acceleration from a velocity. Before the curve its value does not
    /// change, so that its rate is zero up to half a step before the start, the middle of the step that ends there.
    ///
    /// # Errors
    /// As [`Signal::from_velocity`].
    pub fn derivative(&self) -> Result<Self, ShockError> {
        let signal = Signal::from_velocity(&self.time, &self.values)?;
        let before = signal.start - signal.step;
        Ok(Self {
            time: std::iter::once(before).chain(signal.times()).collect(),
            values: std::iter::once(0.0).chain(signal.values.iter().copied()).collect(),
        })
    }

    /// Values at times of a record, which begins `offset` before the curve.
    pub fn sampled(&self, times: &[f64], offset: f64) -> Vec<f64> {
        times.iter().map(|t| self.at(t - offset)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_linear_between_rows_and_held_beyond() {
        let curve = Curve { time: vec![0.0, 1.0, 1.0, 3.0], values: vec![1.0, 2.0, 4.0, 0.0] };
        let found: Vec<f64> = [-1.0, 0.5, 1.0, 2.0, 5.0].map(|t| curve.at(t)).into();
        assert_eq!(found, [1.0, 1.5, 4.0, 2.0, 0.0]);
        assert_eq!(curve.sampled(&[2.5], 2.0), [1.5]);
    }

    #[test]
    fn a_velocity_has_no_rate_of_change_before_its_start() {
        let time: Vec<f64> = (0..101).map(|k| 1e-4 * f64::from(k)).collect();
        let values: Vec<f64> = time.iter().map(|t| -3.0 + 200.0 * t).collect();
        let rate = Curve { time, values }.derivative().expect("rows enough");
        for (t, expected) in
            [(-1e-3, 0.0), (-6e-5, 0.0), (0.0, 100.0), (5e-3, 200.0), (2e-2, 200.0)]
        {
            // Differences of velocities of size 3 over 1e-4 s.
            assert!((rate.at(t) - expected).abs() < 1e-9, "{t}: {}", rate.at(t));
        }
        let filtered = rate.filtered(Cfc::Class600).expect("fine enough");
        assert!(filtered.at(-9e-3).abs() < 1e-9 && (filtered.at(5e-3) - 200.0).abs() < 1e-6);
    }

    #[test]
    fn a_filtered_curve_has_its_initial_value_only_before_the_filter_reaches_back() {
        let step = 1e-4;
        let rise = |k: i32| f64::from(k.clamp(0, 5)) / 5.0;
        let curve = |from: i32| Curve {
            time: (from..=400).map(|k| step * f64::from(k)).collect(),
            values: (from..=400).map(rise).collect(),
        };
        let [own, led] = [curve(0), curve(-1000)].map(|one| one.filtered(Cfc::Class60));
        let (own, led) = (own.expect("fine enough"), led.expect("fine enough"));
        // What a record holds that begins a while before the run: the filter spreads the rise over its time, to either side.
        for t in [-6e-3, -2e-3, -5e-4, 0.0, 1e-3, 1e-2] {
            // Times of samples differ by round-off.
            assert!((own.at(t) - led.at(t)).abs() < 1e-9, "{t}: {} {}", own.at(t), led.at(t));
        }
        assert!(own.at(-1e-3) > 0.05 && own.at(-0.09).abs() < 1e-12, "{}", own.at(-1e-3));
        assert!((own.at(1.0) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_slow_curve_passes_a_filter_unchanged() {
        let time: Vec<f64> = (0..2001).map(|k| 1e-4 * f64::from(k)).collect();
        let wave = |t: &f64| (20.0 * t).sin();
        let curve = Curve { values: time.iter().map(wave).collect(), time };
        let out = curve.filtered(Cfc::Class60).expect("fine enough");
        // 3 Hz in a class of 100 Hz: the amplitude is down by (3 / 125)^4.
        let off = (out.at(0.1) - wave(&0.1)).abs();
        assert!(off < 1e-6, "{off}");
        let rate = curve.rate(0.1) - 20.0 * f64::cos(2.0);
        // A difference over a row of 0.1 ms: half of that times the second derivative, 400.
        assert!(rate.abs() < 0.03, "{rate}");
    }
}
