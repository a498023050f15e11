//! The state of a run between two steps, from which its remaining duration is estimated.

use super::contact_log::ContactLog;
use crate::run::solving::solver::StateView;
use crate::summary::{ContactRecord, StepControl};

/// Progress of a run between two steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunStatus<'a> {
    /// Steps made.
    pub step: usize,
    /// Time reached \[s\].
    pub time: f64,
    /// Time at which the run ends \[s\].
    pub end: f64,
    /// Corrections of Newton's iteration so far.
    pub iterations: usize,
    /// Impacts, and closings of contacts under smooth laws, so far.
    pub impacts: usize,
    /// The contact that most of them are of, and how many; none before the first one.
    pub busiest: Option<(&'a str, usize)>,
    /// Sizes of steps so far, if they are chosen for an accuracy.
    pub control: Option<StepControl>,
}

impl<'a> RunStatus<'a> {
    /// The status of a run in a state, with its log of contacts.
    pub(in crate::run) fn of(
        at: StateView<'a>,
        contacts: &ContactLog,
        iterations: usize,
        control: Option<StepControl>,
    ) -> Self {
        let counts = contacts.records.iter().map(|record| match record {
            ContactRecord::Smooth { intervals, .. } => intervals.len(),
            ContactRecord::Nonsmooth { impact_count, .. } => *impact_count,
        });
        let named = at.model.contacts.iter().map(|contact| contact.name.as_str()).zip(counts);
        let (mut impacts, mut busiest) = (0, None);
        for (name, count) in named.filter(|(_, count)| *count > 0) {
            impacts += count;
            if busiest.is_none_or(|(_, most)| count > most) {
                busiest = Some((name, count));
            }
        }
        let StateView { state, settings, .. } = at;
        let (step, time, end) = (state.step, state.time, settings.end);
        Self { step, time, end, iterations, impacts, busiest, control }
    }
}
