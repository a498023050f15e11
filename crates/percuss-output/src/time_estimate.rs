//! How long a run will take, and why, in words.

use std::time::{Duration, Instant};

use percuss::RunStatus;

/// Nothing is said of a run that ends within this time \[s\].
const SOON: f64 = 5.0;

/// An estimate is given after this time.
const PATIENCE: Duration = Duration::from_secs(5);

/// What had been done when the watch began.
#[derive(Clone, Copy, Debug)]
struct Beginning {
    step: usize,
    time: f64,
    iterations: usize,
    impacts: usize,
}

/// Estimates the time that a run will take, after a few seconds and again each time that four times as much has passed.
#[derive(Debug)]
pub struct TimeEstimate {
    begun: Instant,
    next: Duration,
    beginning: Option<Beginning>,
}

impl Default for TimeEstimate {
    fn default() -> Self {
        Self { begun: Instant::now(), next: PATIENCE, beginning: None }
    }
}

impl TimeEstimate {
    /// Whether the status of the run is wanted: before the first step, and when an estimate is due.
    pub fn wants(&self) -> bool {
        self.beginning.is_none() || self.begun.elapsed() >= self.next
    }

    /// Takes in the status of the run; the estimate in words, when it is due.
    pub fn look(&mut self, status: &RunStatus<'_>) -> Option<String> {
        let elapsed = self.begun.elapsed();
        let RunStatus { step, time, iterations, impacts, .. } = *status;
        // A run may go on from a checkpoint: what was before is not counted.
        let first = Beginning { step, time, iterations, impacts };
        let Beginning { step, time, iterations, impacts } = *self.beginning.get_or_insert(first);
        if elapsed < self.next {
            return None;
        }
        self.next = 4 * elapsed;
        let before = RunStatus { step, time, iterations, impacts, busiest: None, ..*status };
        in_words(status, &before, elapsed)
    }
}

/// How long a run will take, and why: `None` where it ends soon. `before` was its status so long ago.
fn in_words(status: &RunStatus<'_>, before: &RunStatus<'_>, elapsed: Duration) -> Option<String> {
    let seconds = elapsed.as_secs_f64();
    let steps = status.step.saturating_sub(before.step).max(1);
    let done = status.time - before.time;
    let left = seconds * (status.end - status.time) / done;
    if left < SOON {
        return None;
    }
    let each = |count: usize| count as f64 / steps as f64;
    let corrections = each(status.iterations.saturating_sub(before.iterations));
    let mut text = format!(
        "{} % done after {}; about {} remain. {} per step: {} Newton iterations",
        short(100.0 * status.time / status.end),
        time(seconds),
        time(left),
        time(seconds / steps as f64),
        short(corrections)
    );
    let impacts = status.impacts.saturating_sub(before.impacts);
    if let Some((name, count)) = status.busiest.filter(|_| impacts > 0) {
        text += &format!(
            " and {} impacts per step; contact `{name}` has {} % of the impacts",
            short(each(impacts)),
            short(share(count, status))
        );
    }
    Some(text)
}

fn share(count: usize, status: &RunStatus<'_>) -> f64 {
    100.0 * count as f64 / status.impacts.max(1) as f64
}

/// Two digits or so.
fn short(x: f64) -> String {
    match x {
        x if x >= 10.0 || x == 0.0 => format!("{x:.0}"),
        x if x >= 1.0 => format!("{x:.1}"),
        x => format!("{x:.2}"),
    }
}

/// A time in the unit in which people say it.
fn time(seconds: f64) -> String {
    match seconds {
        s if s.is_nan() || s.is_infinite() => "an unknown time".into(),
        s if s < 1.0 => format!("{} ms", short(1e3 * s)),
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s if s < 172_800.0 => format!("{:.0} h", s / 3600.0),
        s => format!("{:.0} days", s / 86_400.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_left_and_its_causes_are_reported() {
        let before =
            RunStatus { step: 0, time: 0.0, end: 2.0, iterations: 0, impacts: 0, busiest: None };
        let busiest = Some(("floor", 300));
        let now =
            RunStatus { step: 10, time: 0.1, iterations: 900, impacts: 400, busiest, ..before };
        let reported = in_words(&now, &before, Duration::from_secs(5)).expect("a long run");
        assert_eq!(
            reported,
            "5.0 % done after 5 s; about 95 s remain. 500 ms per step: 90 Newton iterations and 40 impacts per step; contact \
             `floor` has 75 % of the impacts"
        );
        let late = RunStatus { time: 1.5, ..now };
        assert_eq!(in_words(&late, &before, Duration::from_secs(5)), None);
    }
}
