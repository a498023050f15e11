//! A contact before its run, and how what is found of it is graded.

use crate::advice::Verdict;
use crate::case::Case;
use percuss::{Model, Settings};

/// Steps of a contact (or a period) that resolve it, and that hardly show it.
pub(super) const STEPS: [f64; 2] = [20.0, 8.0];

/// A contact and how it is to be run.
pub(super) struct PlannedContact<'a> {
    pub model: &'a Model,
    pub settings: &'a Settings,
    pub case: &'a Case<'a>,
}

/// Fine from the first number on, a warning below the second.
pub(super) fn graded(value: f64, [fine, poor]: [f64; 2]) -> Verdict {
    if value >= fine {
        Verdict::Fine
    } else if value >= poor {
        Verdict::Note
    } else {
        Verdict::Warning
    }
}
