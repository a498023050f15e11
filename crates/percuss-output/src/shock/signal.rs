//! Evenly sampled signals: accelerations from the velocities of a history, and its other columns.

use super::ShockError;

/// Steps that differ by less than this share are equal.
const EQUAL: f64 = 1e-6;
/// An even sampling has at most so many samples a row.
const SAMPLES_A_ROW: f64 = 8.0;

/// An evenly sampled signal: an acceleration, or a column of the history.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// Time of the first sample \[s\].
    pub start: f64,
    /// Time between samples \[s\].
    pub step: f64,
    /// Samples, shape (n_samples) \[m/s^2, or the unit of the column\].
    pub values: Vec<f64>,
    /// Whether the rows were not evenly spaced, so that velocities between them were interpolated.
    pub resampled: bool,
}

impl Signal {
    /// Values at the rows, such as a contact force. Where rows are not evenly spaced, values are interpolated linearly to their median distance.
    ///
    /// # Errors
    /// As of [`Self::from_velocity`].
    pub fn from_samples(time: &[f64], values: &[f64]) -> Result<Self, ShockError> {
        let rows = RowSamples::new(time, values)?;
        let (values, resampled) = rows.even();
        Ok(Self { start: rows.time[0], step: rows.step, values, resampled })
    }

    /// The mean acceleration over each step, `(v1 - v0) / h`, at the middle of it: what the scheme's balance of momentum, which holds
    /// over steps, gives exactly, and what keeps the change of velocity of an impact within its step. Where rows are not evenly
    /// spaced, velocities are interpolated linearly to their median distance first, which keeps changes of velocity as well.
    ///
    /// # Errors
    /// With fewer than three rows, times that do not grow, or values that are no numbers.
    pub fn from_velocity(time: &[f64], velocity: &[f64]) -> Result<Self, ShockError> {
        let rows = RowSamples::new(time, velocity)?;
        let step = rows.step;
        let (even, resampled) = rows.even();
        let values = even.windows(2).map(|pair| (pair[1] - pair[0]) / step).collect();
        Ok(Self { start: rows.time[0] + 0.5 * step, step, values, resampled })
    }

    /// Times of the samples \[s\].
    pub fn times(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.values.len()).map(|k| self.start + self.step * k as f64)
    }

    /// The sample of largest magnitude, signed, and its time \[unit of the samples, s\].
    pub fn peak(&self) -> Option<(f64, f64)> {
        let samples = self.values.iter().copied().zip(self.times());
        samples.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))
    }
}

/// Rows of a history with growing times and finite values, and the distance of an even sampling of them.
struct RowSamples<'a> {
    /// Times, shape (rows) \[s\].
    time: &'a [f64],
    /// Values, shape (rows) \[SI unit of the column\].
    values: &'a [f64],
    /// Time between even samples \[s\].
    step: f64,
    /// Samples if the rows are not evenly spaced; otherwise the rows are the samples.
    count: Option<f64>,
}

impl<'a> RowSamples<'a> {
    fn new(time: &'a [f64], values: &'a [f64]) -> Result<Self, ShockError> {
        let n = time.len().min(values.len());
        if n < 3 {
            let text = format!("the history has {n} rows; a signal needs three at least");
            return Err(ShockError::Signal(text));
        }
        let (time, values) = (&time[..n], &values[..n]);
        let mut steps: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
        if let Some(k) = steps.iter().position(|h| !(h.is_finite() && *h > 0.0)) {
            let text = format!("row {} is not later than the row before", k + 1);
            return Err(ShockError::Signal(text));
        }
        if let Some(k) = values.iter().position(|v| !v.is_finite()) {
            return Err(ShockError::Signal(format!("the value in row {k} is no finite number")));
        }
        let length = time[n - 1] - time[0];
        let mean = length / (n - 1) as f64;
        if steps.iter().all(|h| (h - mean).abs() <= EQUAL * mean) {
            return Ok(Self { time, values, step: mean, count: None });
        }
        steps.sort_by(f64::total_cmp);
        let median = steps[steps.len() / 2].max(mean / SAMPLES_A_ROW);
        let count = (length / median).round().max(2.0);
        Ok(Self { time, values, step: length / count, count: Some(count) })
    }

    /// Values at even times, and whether they were interpolated.
    fn even(&self) -> (Vec<f64>, bool) {
        let Self { time, values, step, .. } = *self;
        let Some(count) = self.count else { return (values.to_vec(), false) };
        let mut row = 0;
        let mut at = |t: f64| {
            while row + 2 < time.len() && time[row + 1] < t {
                row += 1;
            }
            let share = (t - time[row]) / (time[row + 1] - time[row]);
            values[row] + share * (values[row + 1] - values[row])
        };
        ((0..=count as usize).map(|k| at(time[0] + step * k as f64)).collect(), true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_of_velocity_is_kept_whatever_the_rows() {
        // An impact between two rows that are nearly at one time.
        let time = [0.0, 0.1, 0.2, 0.2 + 1e-9, 0.3, 0.4];
        let velocity = [0.0, 0.0, 0.0, 5.0, 5.0, 5.0];
        let signal = Signal::from_velocity(&time, &velocity).unwrap();
        assert!(signal.resampled);
        let change: f64 = signal.values.iter().map(|a| a * signal.step).sum();
        assert!((change - 5.0).abs() < 1e-12);
    }

    #[test]
    fn a_uniform_acceleration_is_itself_in_the_middle_of_steps() {
        let time: Vec<f64> = (0..11).map(|k| 0.1 * f64::from(k)).collect();
        let velocity: Vec<f64> = time.iter().map(|t| 3.0 * t).collect();
        let signal = Signal::from_velocity(&time, &velocity).unwrap();
        assert!(!signal.resampled && signal.values.len() == 10);
        assert!((signal.start - 0.05).abs() < 1e-12);
        assert!(signal.values.iter().all(|a| (a - 3.0).abs() < 1e-12));
    }

    #[test]
    fn samples_are_the_rows_where_these_are_even_and_lie_between_them_elsewhere() {
        let time: Vec<f64> = (0..5).map(|k| 0.1 * f64::from(k)).collect();
        let force = [0.0, 1.0, 4.0, 2.0, 0.0];
        let signal = Signal::from_samples(&time, &force).unwrap();
        assert!(!signal.resampled && signal.values == force && signal.start == 0.0);
        // Rows of a straight line at any times: the same line at even ones.
        let uneven = [0.0, 0.1, 0.15, 0.3, 0.4, 0.5];
        let signal = Signal::from_samples(&uneven, &uneven.map(|t| 7.0 * t)).unwrap();
        assert!(signal.resampled && signal.values.len() == 6);
        assert!(signal.times().zip(&signal.values).all(|(t, v)| (v - 7.0 * t).abs() < 1e-12));
        assert!(Signal::from_samples(&time[..2], &force).is_err());
        assert!(Signal::from_samples(&time, &[f64::NAN; 5]).is_err());
    }

    #[test]
    fn rows_without_time_or_value_are_refused() {
        assert!(Signal::from_velocity(&[0.0, 1.0], &[0.0, 1.0]).is_err());
        assert!(Signal::from_velocity(&[0.0, 1.0, 1.0], &[0.0; 3]).is_err());
        assert!(Signal::from_velocity(&[0.0, 1.0, 2.0], &[0.0, f64::NAN, 1.0]).is_err());
    }
}
