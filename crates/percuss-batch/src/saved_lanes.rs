//! Copy of the state of all lanes, from which lanes are restored whose part of a step is not accepted.

use super::engine::Engine;
use super::ledger::LaneLedger;
use percuss::internals::scalar::Number;

/// The numbers of a state and its ledger, shape (such numbers) \[unit of each\].
#[derive(Clone, Debug)]
pub struct SavedLanes<S>(pub Vec<S>);

impl<S: Number> SavedLanes<S> {
    /// Saves the state and the ledger of all lanes.
    #[inline(always)]
    pub fn save(&mut self, engine: &mut Engine<S>, ledger: &mut LaneLedger<S>) {
        self.0.clear();
        engine.each_of_state(|x| self.0.push(*x));
        self.0.extend(ledger.numbers().map(|x| *x));
    }

    /// Restores all lanes except those of the mask `go`, whose part is accepted.
    #[inline(always)]
    pub fn restore(&self, engine: &mut Engine<S>, ledger: &mut LaneLedger<S>, go: S::Mask) {
        let mut saved = self.0.iter();
        engine.each_of_state(|x| {
            if let Some(saved) = saved.next() {
                *x = S::choose(go, *x, *saved);
            }
        });
        for (now, saved) in ledger.numbers().zip(saved) {
            *now = S::choose(go, *now, *saved);
        }
    }
}
