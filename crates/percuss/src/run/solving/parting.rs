//! Fracture of beams at the end of a step, which ends the contact of the fractured elements.

use super::accept::Acceptance;
use crate::contact::search::Search;
use crate::geometry::touch::SearchRegion;

use crate::step::fibres::PartedElement;

impl Acceptance<'_> {
    /// Removes fractured elements from contact; returns the pairs that this has separated. The energy stored in their contacts is lost.
    pub(super) fn part(&mut self, parted: &[PartedElement]) -> Vec<usize> {
        if parted.is_empty() {
            return Vec::new();
        }
        for element in parted {
            self.state.part(self.model, element.node);
        }
        let before: Vec<f64> = self.state.pairs.iter().map(|pair| pair.gap).collect();
        let pressed = self.stored_in_contacts();
        self.solver.search = Search::new(self.model);
        self.solver.search.see(self.model, self.state, SearchRegion::All);
        self.state.ledger.loss_failure += pressed - self.stored_in_contacts();
        let now = self.state.pairs.iter().map(|pair| pair.gap);
        now.zip(before).enumerate().filter(|(_, (now, was))| now != was).map(|(i, _)| i).collect()
    }

    /// Opens the pairs that a fracture has separated.
    pub(super) fn open_parted(&mut self, moved: &[usize]) {
        for &i in moved {
            self.state.pairs[i].closed = false;
            if self.state.located == Some(i) {
                self.state.located = None;
            }
        }
    }

    /// Energy of everything that is pressed together \[J\].
    fn stored_in_contacts(&self) -> f64 {
        let stored =
            self.model.pairs.iter().zip(&self.state.pairs).map(|(pair, seen)| {
                match self.model.contacts[pair.contact].law.smooth() {
                    Some(law) if seen.gap < 0.0 => law.stored(-seen.gap, seen.deepest),
                    _ => 0.0,
                }
            });
        stored.sum()
    }
}
