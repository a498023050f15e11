//! How a run goes, in words.

use std::time::{Duration, Instant};

use percuss::Pace;

/// Runs that are over sooner than this after they are looked at need no words.
const SOON: f64 = 5.0;

/// A run that takes longer than this says how it goes.
const PATIENCE: Duration = Duration::from_secs(5);

/// What is remembered of a run's beginning, as far as it outlives the run.
#[derive(Clone, Copy, Debug)]
struct Beginning {
    step: usize,
    time: f64,
    iterations: usize,
    impacts: usize,
}

/// Watches a run, and tells after a few seconds, and again after four times as long, how long it will take and why.
#[derive(Debug)]
pub struct PaceWatch {
    begun: Instant,
    next: Duration,
    beginning: Option<Beginning>,
}

impl Default for PaceWatch {
    fn default() -> Self {
        Self { begun: Instant::now(), next: PATIENCE, beginning: None }
    }
}

impl PaceWatch {
    /// Whether the pace is to be looked at: before the first step, and when it may be told.
    pub fn wants(&self) -> bool {
        self.beginning.is_none() || self.begun.elapsed() >= self.next
    }

    /// Looks at the pace; what is to be told of it.
    pub fn look(&mut self, pace: &Pace<'_>) -> Option<String> {
        let elapsed = self.begun.elapsed();
        let Pace { step, time, iterations, impacts, .. } = *pace;
        // A run may go on from a checkpoint: what was before is not counted.
        let first = Beginning { step, time, iterations, impacts };
        let Beginning { step, time, iterations, impacts } = *self.beginning.get_or_insert(first);
        if elapsed < self.next {
            return None;
        }
        self.next = 4 * elapsed;
        let before = Pace { step, time, iterations, impacts, busiest: None, ..*pace };
        pace_in_words(pace, &before, elapsed)
    }
}

/// How long a run will take as it goes, and why: `None` where it is over soon. `before` was its pace when it began, so long ago.
fn pace_in_words(pace: &Pace<'_>, before: &Pace<'_>, elapsed: Duration) -> Option<String> {
    let seconds = elapsed.as_secs_f64();
    let steps = pace.step.saturating_sub(before.step).max(1);
    let done = pace.time - before.time;
    let left = seconds * (pace.end - pace.time) / done;
    if left < SOON {
        return None;
    }
    let each = |count: usize| count as f64 / steps as f64;
    let corrections = each(pace.iterations.saturating_sub(before.iterations));
    let mut text = format!(
        "{} % of the run took {}, so that about {} are left: {} a step, {} corrections",
        short(100.0 * pace.time / pace.end),
        time(seconds),
        time(left),
        time(seconds / steps as f64),
        short(corrections)
    );
    let impacts = pace.impacts.saturating_sub(before.impacts);
    if let Some((name, count)) = pace.busiest.filter(|_| impacts > 0) {
        text += &format!(
            ", {} impacts, of all so far {} % in contact `{name}`",
            short(each(impacts)),
            short(share(count, pace))
        );
    }
    Some(text)
}

fn share(count: usize, pace: &Pace<'_>) -> f64 {
    100.0 * count as f64 / pace.impacts.max(1) as f64
}

/// Two digits or so.
fn short(x: f64) -> String {
    if x >= 10.0 || x == 0.0 { format!("{x:.0}") } else { format!("{x:.2}") }
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
    fn time_left_and_its_causes_are_told() {
        let before =
            Pace { step: 0, time: 0.0, end: 2.0, iterations: 0, impacts: 0, busiest: None };
        let busiest = Some(("floor", 300));
        let now = Pace { step: 10, time: 0.1, iterations: 900, impacts: 400, busiest, ..before };
        let told = pace_in_words(&now, &before, Duration::from_secs(5)).expect("a long run");
        assert_eq!(
            told,
            "5.00 % of the run took 5 s, so that about 95 s are left: 500 ms a step, 90 corrections, 40 impacts, of all so far \
             75 % in contact `floor`"
        );
        let late = Pace { time: 1.5, ..now };
        assert_eq!(pace_in_words(&late, &before, Duration::from_secs(5)), None);
    }
}
