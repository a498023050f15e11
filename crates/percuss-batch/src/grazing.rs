//! Contacts and first yield of beams that a small change of the parameters adds to a run or removes from it.

use super::derivative_run::{DerivativeRun, Derived};
use super::yield_log::{Noted, YieldLog};
use percuss::internals::scalar::Real;

/// Event at whose onset the results have a kink.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Onset {
    /// A contact, with its name.
    Contact(String),
    /// First yield of a beam, with its name.
    Yield(String),
}

/// A contact, or the yielding of a beam, that a small change of the parameters adds or removes.
/// There the results have a kink: derivatives are valid only on the side of the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Grazing {
    /// Kind and name of the event.
    pub onset: Onset,
    /// Time \[s\].
    pub time: f64,
    /// Whether the event is absent in the run.
    pub missed: bool,
    /// For every parameter, the change at which the event appears or vanishes, to first order, shape (parameters) \[unit of the parameter\];
    /// infinite without influence.
    pub changes: Vec<f64>,
}

impl DerivativeRun<'_> {
    /// Contacts, misses and beams that can yield with the changes of the parameters at which they vanish or appear.
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
                // The approach velocity is proportional to the square root of the parameter's distance from grazing.
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
