//! Contacts, and the yielding of beams, that are about to appear or to vanish in a run.

use super::derivative_run::{DerivativeRun, Derived};
use super::yield_log::{Noted, YieldLog};
use percuss::internals::scalar::Real;

/// What begins with a kink in the results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Onset {
    /// A contact, by its name.
    Contact(String),
    /// That a beam yields, by its name.
    Yield(String),
}

/// A contact, or the yielding of a beam, that is about to appear or to vanish.
///
/// Where it does, results have a kink: derivatives hold on the side of the run alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Grazing {
    /// What it is.
    pub onset: Onset,
    /// When \[s\].
    pub time: f64,
    /// Whether the run misses it; else it has it.
    pub missed: bool,
    /// For every parameter, the change that would just bring or end it, to first order, shape (parameters) \[unit of the parameter\];
    /// infinite where it has no say.
    pub changes: Vec<f64>,
}

impl DerivativeRun<'_> {
    /// Contacts, misses and beams that can yield with the changes of the parameters that would end or begin them.
    pub fn grazing(&self, parameters: usize) -> Vec<Grazing> {
        let mut all = Vec::new();
        let mut add = |onset: Onset, time: Derived, missed: bool, left: Derived, power: f64| {
            let change = |slope: f64| -left.value / (power * slope);
            let changes = left.slope[..parameters].iter().map(|s| change(*s)).collect();
            all.push(Grazing { onset, time: time.value, missed, changes });
        };
        let contact = |k: usize| Onset::Contact(self.model.contacts[k].name.clone());
        for k in 0..self.log.guides.len() {
            for closed in self.log.intervals(&self.engine, k, 0) {
                add(contact(k), closed.start, false, closed.deepest.value, 1.0);
            }
        }
        for (k, log) in self.rigid_logs.iter().enumerate() {
            for struck in &log.impacts {
                // The velocity of approach falls with the root of what a parameter is away from grazing.
                add(contact(k), struck.time, false, struck.approach, 2.0);
            }
        }
        for (k, time, gap) in &self.misses {
            add(contact(*k), *time, true, *gap, 1.0);
        }
        for (beam, logs) in self.yields(self.model) {
            let onset = Onset::Yield(beam.name.clone());
            let larger = |a: Noted<Derived>, b: Noted<Derived>| {
                if a.value.value < b.value.value { b } else { a }
            };
            let most =
                |of: fn(&YieldLog<Derived>) -> Noted<Derived>| logs.iter().map(of).reduce(larger);
            let (Some(flowed), Some(near)) = (most(|l| l.accumulated), most(|l| l.near)) else {
                continue;
            };
            if flowed.value.value > 0.0 {
                add(onset, flowed.time, false, flowed.value, 1.0);
            } else if near.value.value > 0.0 {
                let left = near.value.constant(1.0) - near.value;
                add(onset, near.time, true, left, 1.0);
            }
        }
        all
    }
}
