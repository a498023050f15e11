//! Where the runs of an ensemble stand, kept while those go on whose part of a step is accepted.

use super::engine::Engine;
use super::ledger::LaneLedger;
use percuss::internals::scalar::Number;

/// The numbers of a state and its ledger, shape (such numbers) \[unit of each\].
#[derive(Clone, Debug)]
pub struct Stand<S>(pub Vec<S>);

impl<S: Number> Stand<S> {
    /// Keeps it.
    #[inline(always)]
    pub fn keep(&mut self, engine: &mut Engine<S>, ledger: &mut LaneLedger<S>) {
        self.0.clear();
        engine.each_of_state(|x| self.0.push(*x));
        self.0.extend(ledger.numbers().map(|x| *x));
    }

    /// Puts all lanes but those that `go` back to where they stood.
    #[inline(always)]
    pub fn put_back(&self, engine: &mut Engine<S>, ledger: &mut LaneLedger<S>, go: S::Mask) {
        let mut kept = self.0.iter();
        engine.each_of_state(|x| {
            if let Some(kept) = kept.next() {
                *x = S::choose(go, *x, *kept);
            }
        });
        for (now, kept) in ledger.numbers().zip(kept) {
            *now = S::choose(go, *now, *kept);
        }
    }
}
