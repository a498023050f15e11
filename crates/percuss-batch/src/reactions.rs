//! Reactions after an iteration that ends without another evaluation: linear in the last correction, with the tangent of that correction.

use super::engine::Engine;
use percuss::internals::linalg::block::{Block, add_applied};
use percuss::internals::scalar::Number;

impl<S: Number> Engine<S> {
    /// Saves the rows of supported nodes of the last assembled tangent, in the given lanes.
    #[inline(always)]
    pub fn keep_reaction_rows(&mut self, which: S::Mask) {
        let (band, last) = (&self.tangent, self.residual.len() - 1);
        for (rows, dofs) in self.reaction_rows.iter_mut().zip(&self.numbers.prescribed) {
            let n = dofs.node;
            take_block(&mut rows[1], &band.diag[n], which);
            if n > 0 {
                take_block(&mut rows[0], &band.lower[n - 1], which);
            }
            if n < last {
                take_block(&mut rows[2], &band.upper[n], which);
            }
        }
    }

    /// Reactions after the last correction of the given lanes, to first order.
    #[inline(always)]
    pub fn correct_reactions(&mut self, took: S::Mask) {
        let (zero, last) = (self.h.constant(0.0), self.residual.len() - 1);
        for k in 0..self.numbers.prescribed.len() {
            let (dofs, [before, own, after]) =
                (&self.numbers.prescribed[k], &self.reaction_rows[k]);
            let n = dofs.node;
            let mut change = add_applied([zero; 4], own, &self.correction[n]);
            if n > 0 {
                change = add_applied(change, before, &self.correction[n - 1]);
            }
            if n < last {
                change = add_applied(change, after, &self.correction[n + 1]);
            }
            for (guide, state) in self.numbers.guides.iter().zip(&self.guides) {
                if guide.node == n || guide.node + 1 == n {
                    let row = guide.row();
                    for i in 0..4 {
                        change[i] += state.left_over() * row[4 * (n - guide.node) + i];
                    }
                }
            }
            self.add_constraint_change(n, &mut change);
            let mut free = change;
            dofs.project(&mut free);
            for i in 0..4 {
                self.reactions[k][i] += S::choose(took, change[i] - free[i], zero);
            }
        }
    }
}

#[inline(always)]
fn take_block<S: Number>(mine: &mut Block<S>, other: &Block<S>, which: S::Mask) {
    for (mine, other) in mine.as_flattened_mut().iter_mut().zip(other.as_flattened()) {
        *mine = S::choose(which, *other, *mine);
    }
}
