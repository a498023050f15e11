//! How long a run will take, and why, in words.

use std::time::{Duration, Instant};

use percuss::RunStatus;

/// Nothing is said of a run that ends within this time \[s\].
const SOON: f64 = 5.0;

/// An estimate is given after this time.
const PATIENCE: Duration = Duration::from_secs(5);

/// Whether a requested accuracy is reached so far is looked at each time that this has passed.
const GLANCE: Duration = Duration::from_millis(500);

/// Fewer impacts per step cost nothing: they are printed as 0.00.
const FEW: f64 = 0.005;

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
    /// When the accuracy is looked at; none if it is not of interest any more.
    glance: Option<Duration>,
    beginning: Option<Beginning>,
}

impl Default for TimeEstimate {
    fn default() -> Self {
        Self { begun: Instant::now(), next: PATIENCE, glance: Some(GLANCE), beginning: None }
    }
}

impl TimeEstimate {
    /// Whether the status of the run is wanted: before the first step, and when an estimate is due.
    pub fn wants(&self) -> bool {
        let elapsed = self.begun.elapsed();
        let glances = self.glance.is_some_and(|glance| elapsed >= glance);
        self.beginning.is_none() || elapsed >= self.next || glances
    }

    /// Takes in the status of the run; the estimate in words, when it is due.
    pub fn look(&mut self, status: &RunStatus<'_>) -> Option<String> {
        let elapsed = self.begun.elapsed();
        let RunStatus { step, time, iterations, impacts, .. } = *status;
        // A run may go on from a checkpoint: what was before is not counted.
        let first = Beginning { step, time, iterations, impacts };
        let Beginning { step, time, iterations, impacts } = *self.beginning.get_or_insert(first);
        let before = RunStatus { step, time, iterations, impacts, busiest: None, ..*status };
        if self.glance.is_some_and(|glance| elapsed >= glance) {
            let missed = unreached(status, &before, elapsed);
            let goes_on = status.control.is_some() && missed.is_none();
            self.glance = goes_on.then_some(elapsed + GLANCE);
            if missed.is_some() {
                return missed;
            }
        }
        if elapsed < self.next {
            return None;
        }
        self.next = 4 * elapsed;
        in_words(status, &before, elapsed)
    }
}

/// That a requested accuracy is not reached, and what the run costs all the same.
fn unreached(status: &RunStatus<'_>, before: &RunStatus<'_>, elapsed: Duration) -> Option<String> {
    let control = status.control.filter(|control| !control.is_reached())?;
    let share = (status.end - before.time) / (status.time - before.time);
    let steps = status.step.saturating_sub(before.step) as f64;
    Some(format!(
        "the requested accuracy of {} % will not be reached: estimated error {} % so far, since steps are not made shorter than a hundredth of the first; at \
         this rate the run takes {:.1e} steps, {}. Request a lower accuracy, or give a time.step",
        short(100.0 * control.accuracy),
        short(100.0 * control.estimate),
        steps * share,
        time(elapsed.as_secs_f64() * share)
    ))
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
    if status.control.is_some() {
        // Only the steps so far tell how many an accuracy takes.
        let all = steps as f64 * (status.end - before.time) / done;
        text += &format!("; at this rate {all:.1e} steps for the requested accuracy");
    }
    let impacts = each(status.impacts.saturating_sub(before.impacts));
    if let Some((name, count)) = status.busiest.filter(|_| impacts >= FEW) {
        text += &format!(
            " and {} impacts per step; contact `{name}` has {} % of the impacts",
            short(impacts),
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
    use percuss::StepControl;

    #[test]
    fn time_left_and_its_causes_are_reported() {
        let before = RunStatus {
            step: 0,
            time: 0.0,
            end: 2.0,
            iterations: 0,
            impacts: 0,
            busiest: None,
            control: None,
        };
        let busiest = Some(("floor", 300));
        let now =
            RunStatus { step: 10, time: 0.1, iterations: 900, impacts: 400, busiest, ..before };
        let reported = in_words(&now, &before, Duration::from_secs(5)).expect("a long run");
        assert_eq!(
            reported,
            "5.0 % done after 5 s; about 95 s remain. 500 ms per step: 90 Newton iterations and 40 impacts per step; contact \
             `floor` has 75 % of the impacts"
        );
        let rare = RunStatus { step: 90_000, impacts: 400, ..now };
        let reported = in_words(&rare, &before, Duration::from_secs(5)).expect("a long run");
        assert!(!reported.contains("impacts"), "{reported}");
        let late = RunStatus { time: 1.5, ..now };
        assert_eq!(in_words(&late, &before, Duration::from_secs(5)), None);
    }

    #[test]
    fn an_accuracy_that_is_not_reached_is_reported_with_its_cost() {
        let none = RunStatus {
            step: 0,
            time: 0.0,
            end: 2.0,
            iterations: 0,
            impacts: 0,
            busiest: None,
            control: None,
        };
        let control = StepControl {
            accuracy: 0.01,
            estimate: 0.035,
            smallest: 2e-8,
            largest: 1e-4,
            mean: 1e-6,
            steps: 10_000,
            refused: 0,
        };
        let now = RunStatus { step: 10_000, time: 0.02, control: Some(control), ..none };
        let second = Duration::from_secs(1);
        assert_eq!(
            unreached(&now, &none, second).expect("it is missed"),
            "the requested accuracy of 1.0 % will not be reached: estimated error 3.5 % so far, since steps are not made shorter than a hundredth of the \
             first; at this rate the run takes 1.0e6 steps, 100 s. Request a lower accuracy, or give a time.step"
        );
        let reached = StepControl { estimate: 0.009, ..control };
        assert_eq!(unreached(&RunStatus { control: Some(reached), ..now }, &none, second), None);
    }
}
