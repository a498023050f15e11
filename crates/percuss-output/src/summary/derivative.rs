//! Numbers of a summary by their path, differentiated.

use percuss::{ContactInterval, ContactRecord, Impact, RunSummary};

use super::pick::{SummaryPath, pick};

/// Keys of what measures errors of the computation.
const ERRORS: [&str; 8] = [
    "residual_max",
    "linear_residual_max",
    "angular_residual_max",
    "contact_residual_max",
    "curvature_drift_max",
    "membrane_drift_max",
    "angular_rate_drift_max",
    "penetration",
];

impl SummaryPath {
    /// Whether the number is a count: of steps, of impacts.
    pub fn is_count(&self, run: &RunSummary) -> bool {
        self.value_in(run).is_some_and(|value| value.is_u64())
    }

    /// Whether the number measures errors of the computation.
    pub fn is_of_errors(&self) -> bool {
        let mut steps = self.keys.iter().map(String::as_str).chain([self.path()]);
        steps.any(|key| ERRORS.contains(&key))
    }

    /// The contact, the list and the entry of an event whose coefficient of restitution this is.
    fn restitution_of(&self) -> Option<(&str, usize)> {
        match self.keys.as_slice() {
            [list, index, last] if last == "restitution" => Some((list, index.parse().ok()?)),
            _ => None,
        }
    }
}

/// Derivatives of the numbers at these paths, from a summary whose numbers are derivatives of those of `run`; NaN where there is none.
pub fn pick_derivatives(
    paths: &[SummaryPath],
    run: &RunSummary,
    derivative: &RunSummary,
) -> Vec<f64> {
    let all = pick(paths, derivative);
    let each = paths.iter().zip(all).map(|(path, number)| match path.restitution_of() {
        // A quotient: what the summary makes of two derivatives is not its derivative.
        Some((list, index)) => restitution_derivative(path, list, index, run, derivative),
        None if path.is_count(run) => f64::NAN,
        None => number,
    });
    each.collect()
}

fn restitution_derivative(
    path: &SummaryPath,
    list: &str,
    index: usize,
    run: &RunSummary,
    derivative: &RunSummary,
) -> f64 {
    let [own, by] = [run, derivative].map(|run| {
        let record = run.contacts.iter().find(|c| c.name == path.name).map(|c| &c.record);
        let (impacts, intervals): (&[Impact], &[ContactInterval]) = match record {
            Some(ContactRecord::Smooth { intervals, .. }) => (&[], intervals),
            Some(ContactRecord::Nonsmooth { impacts, intervals, .. }) => (impacts, intervals),
            None => (&[], &[]),
        };
        let (impacts, intervals) =
            if list == "impacts" { (impacts, &[][..]) } else { (&[][..], intervals) };
        (impacts.get(index), intervals.get(index))
    });
    let found = match (own, by) {
        ((Some(own), _), (Some(by), _)) => own.restitution_derivative(by),
        ((_, Some(own)), (_, Some(by))) => own.restitution_derivative(by),
        _ => return f64::NAN,
    };
    found.unwrap_or(f64::NAN)
}
