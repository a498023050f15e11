//! A run of a convergence study, with the largest magnitudes of columns.

use percuss::{Channel, Flow, Recorder, RecorderError};

/// Steps about a largest value: the middle one and two on either side.
const ABOUT: usize = 5;
/// Second differences of neighbouring steps that differ by more than this share of the larger one are not those of a resolved course.
const AGREES: f64 = 0.5;

/// Listens for the wish to stop, and keeps the values of largest magnitude of columns: of the whole run, step by step. What a column adds up over
/// the output interval is added up over that of the given run.
pub(super) struct Ear<'a> {
    goes_on: &'a dyn Fn() -> bool,
    /// Names of the columns, shape (columns).
    names: &'a [&'a str],
    /// Steps in an output interval of the given run.
    interval: usize,
    /// Rows since the last interval ended.
    rows: usize,
    /// The columns, shape (columns).
    columns: Vec<Followed>,
}

/// A column of a run.
#[derive(Clone, Debug)]
struct Followed {
    /// Its number among all.
    number: usize,
    /// Whether it is a sum over the output interval.
    adds_up: bool,
    sum: f64,
    /// The last steps, the latest last, shape (steps) \[unit of the column\].
    last: [f64; ABOUT],
    /// The value of largest magnitude \[unit of the column\]; NaN before the first row.
    largest: f64,
}

impl<'a> Ear<'a> {
    /// Before a run with so many steps in an output interval of the given one.
    pub fn new(goes_on: &'a dyn Fn() -> bool, names: &'a [&'a str], interval: usize) -> Self {
        Self { goes_on, names, interval, rows: 0, columns: Vec::new() }
    }

    /// The values of largest magnitude, shape (columns) \[unit of the column\].
    pub fn largest(&self) -> Vec<f64> {
        self.columns.iter().map(|column| column.largest).collect()
    }
}

impl Followed {
    fn new(number: usize, channel: &Channel) -> Self {
        let adds_up = channel.description.contains("during the output interval");
        Self { number, adds_up, sum: 0.0, last: [f64::NAN; ABOUT], largest: f64::NAN }
    }

    fn take(&mut self, value: f64, ends_interval: bool) {
        if self.adds_up {
            self.sum += value;
            if ends_interval {
                let sum = std::mem::take(&mut self.sum);
                self.enter(sum);
            }
            return;
        }
        self.last.rotate_left(1);
        self.last[ABOUT - 1] = value;
        self.enter(value);
        if let Some(between) = self.between() {
            self.enter(between);
        }
    }

    fn enter(&mut self, value: f64) {
        if self.largest.is_nan() || value.abs() > self.largest.abs() {
            self.largest = value;
        }
    }

    /// The extreme between steps of the parabola through three of them, if the course is resolved: its second difference is that of its neighbours.
    /// What jumps has no more than its values.
    fn between(&self) -> Option<f64> {
        let second = |k: usize| self.last[k - 1] - 2.0 * self.last[k] + self.last[k + 1];
        let bends = [second(1), second(2), second(3)];
        let agree = |a: f64, b: f64| (a - b).abs() <= AGREES * a.abs().max(b.abs());
        let [before, top, after] = [self.last[1], self.last[2], self.last[3]];
        let is_top = top.abs() >= before.abs().max(after.abs()) && top * bends[1] < 0.0;
        let resolved = agree(bends[0], bends[1]) && agree(bends[1], bends[2]);
        (is_top && resolved).then(|| top - (after - before).powi(2) / (8.0 * bends[1]))
    }
}

impl Recorder for Ear<'_> {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        let follow = |name: &&str| -> Result<Followed, RecorderError> {
            let found = channels.iter().position(|channel| channel.name == *name);
            let number = found.ok_or_else(|| format!("no column `{name}`"))?;
            Ok(Followed::new(number, &channels[number]))
        };
        self.columns = self.names.iter().map(follow).collect::<Result<_, _>>()?;
        Ok(())
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        // The first row is the state at the start.
        let ends = self.rows.is_multiple_of(self.interval);
        self.rows += 1;
        for column in &mut self.columns {
            column.take(values[column.number], ends);
        }
        Ok(())
    }

    fn wants_rows(&self) -> bool {
        !self.names.is_empty()
    }

    fn progress(&mut self, _time: f64) -> Flow {
        if (self.goes_on)() { Flow::Continue } else { Flow::Stop }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn largest(description: &str, values: &[f64], interval: usize) -> f64 {
        let channel = Channel { name: "x".into(), unit: "m", description: description.into() };
        let go = || true;
        let mut ear = Ear::new(&go, &["x"], interval);
        ear.begin(&[channel]).unwrap();
        values.iter().for_each(|value| ear.row(&[*value]).unwrap());
        ear.largest()[0]
    }

    #[test]
    fn largest_values_are_those_of_the_run_between_rows_too() {
        // Steps of a twelfth of a period meet the extreme of a sine by chance only.
        let sine = |k: usize| (0.52 * k as f64 + 0.3).sin();
        let values: Vec<f64> = (0..40).map(sine).collect();
        let found = largest("Displacement", &values, 10);
        assert!((found.abs() - 1.0).abs() < 2e-3, "{found}");
        // A jump has no value beyond its own.
        assert_eq!(largest("Velocity", &[0.0, 0.0, 0.0, 3.0, 3.0, 3.0, 3.0], 2), 3.0);
    }

    #[test]
    fn impulses_are_added_up_over_the_output_interval_of_the_given_run() {
        let text = "Impulse during the output interval";
        assert_eq!(largest(text, &[0.0, 1.0, 2.0, 5.0, 1.0], 2), 6.0);
        assert_eq!(largest(text, &[0.0, 1.0, 2.0, 5.0, 1.0], 1), 5.0);
    }
}
