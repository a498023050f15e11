//! Fracture of beams at the end of a step, which ends the contact of the fractured elements.

use super::accept::Acceptance;
use super::trial::Separated;
use crate::contact::search::Search;
use crate::geometry::touch::SearchRegion;

use crate::step::fibres::PartedElement;

impl Acceptance<'_> {
    /// Removes fractured elements from contact; returns the pairs that this has separated. The energy stored in their contacts is lost.
    pub(super) fn part(&mut self, parted: &[PartedElement]) -> Vec<Separated> {
        if parted.is_empty() {
            return Vec::new();
        }
        for element in parted {
            self.state.part(self.model, element.node);
        }
        let before = self.state.pairs.clone();
        let pressed = self.stored_in_contacts();
        self.solver.search = Search::new(self.model);
        self.solver.search.see(self.model, self.state, SearchRegion::All);
        self.state.ledger.loss_failure += pressed - self.stored_in_contacts();
        let now = self.state.pairs.iter().zip(before).enumerate();
        let moved = now.filter(|(_, (now, before))| now.gap != before.gap);
        moved.map(|(pair, (_, before))| Separated { pair, before }).collect()
    }

    /// Opens the pairs that a fracture has separated.
    pub(super) fn open_parted(&mut self, moved: &[Separated]) {
        for i in moved.iter().map(|separated| separated.pair) {
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
