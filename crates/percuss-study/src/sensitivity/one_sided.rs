//! Contacts, and yielding, that a small change of a parameter makes or ends.

use percuss_batch::{Grazing, Onset};

use super::differentiated::Differentiated;

/// Changes below this share of a parameter are reported where they make or end a contact, or yielding.
const NEAR: f64 = 0.01;

/// A contact, or the yielding of a beam, that is about to appear or to vanish: derivatives by a parameter hold on the side of the run alone.
#[derive(Clone, Debug, PartialEq)]
pub struct OneSided {
    /// What it is.
    pub onset: Onset,
    /// When \[s\].
    pub time: f64,
    /// Whether it would appear; else it would vanish.
    pub appears: bool,
    /// Path of the parameter.
    pub parameter: String,
    /// Change of the parameter that does it, to first order, in its SI unit.
    pub change: f64,
    /// Further touches of the same contact that changes of this parameter below one per cent would make or end.
    pub others: usize,
}

impl OneSided {
    /// What it means, in a sentence.
    pub fn text(&self) -> String {
        let what = if self.appears { "appear" } else { "vanish" };
        let others = match self.others {
            0 => String::new(),
            n => format!(" (and {n} more within 1 %)"),
        };
        let what = match &self.onset {
            Onset::Contact(name) => format!("a contact of `{name}` is about to {what}"),
            Onset::Yield(name) if self.appears => format!("`{name}` is about to yield"),
            Onset::Yield(name) => format!("`{name}` only just yields"),
        };
        format!(
            "{what} at t = {:.6e} s{others}: a change of {} by {:+.2e} is enough, to first order; derivatives by it are one-sided",
            self.time, self.parameter, self.change
        )
    }
}

/// Contacts, and yielding, that a change of a parameter by less than [`NEAR`] of it makes or ends: of each the nearest one.
pub(super) fn one_sided(grazing: &[Grazing], parameters: &[Differentiated]) -> Vec<OneSided> {
    let mut all: Vec<OneSided> = Vec::new();
    for one in grazing {
        for (change, parameter) in one.changes.iter().zip(parameters) {
            if change.abs() > NEAR * parameter.value.abs() || !change.is_finite() {
                continue;
            }
            let found = OneSided {
                onset: one.onset.clone(),
                time: one.time,
                appears: one.missed,
                parameter: parameter.path.clone(),
                change: *change,
                others: 0,
            };
            let like = |known: &&mut OneSided| {
                (&known.onset, &known.parameter) == (&found.onset, &found.parameter)
            };
            match all.iter_mut().find(like) {
                Some(known) => {
                    let others = known.others + 1;
                    if found.change.abs() < known.change.abs() {
                        *known = found;
                    }
                    known.others = others;
                }
                None => all.push(found),
            }
        }
    }
    all
}
