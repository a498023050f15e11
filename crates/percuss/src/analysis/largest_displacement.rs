//! Where a structure at rest has moved farthest.

use crate::math::vec2::{dot, norm};
use crate::model::Model;
use crate::model::frozen::Span;
use crate::model::point::combine;
use crate::state::State;
use crate::summary::SAME_SIZE;

/// Pieces of an element at whose ends displacements are looked at.
const PIECES: usize = 8;
/// Halvings of the two pieces beside the largest of them.
const HALVINGS: usize = 40;

/// The largest displacement of all beams.
#[derive(Clone, Debug, PartialEq)]
pub struct LargestDisplacement {
    /// Name of the beam.
    pub beam: String,
    /// Arc length from its start \[m\].
    pub s: f64,
    /// Displacement there, shape (2) \[m\].
    pub displacement: [f64; 2],
}

impl LargestDisplacement {
    /// Its magnitude \[m\].
    pub fn size(&self) -> f64 {
        norm(self.displacement)
    }

    /// That of a state; none without beams. Elements that have parted are gone.
    pub(super) fn of(model: &Model, state: &State) -> Option<Self> {
        let mut most: Option<Self> = None;
        for beam in &model.beams {
            for span in &model.spans[beam.spans.clone()] {
                let whole = |k: &usize| !state.has_parted(span.nodes.start + k);
                for k in (0..span.elements.len()).filter(whole) {
                    let (xi, displacement) = farthest(span, k, state);
                    // Of places that move as far, the first: round-off does not decide.
                    let farther =
                        |most: &Self| norm(displacement) > most.size() * (1.0 + SAME_SIZE);
                    if most.as_ref().is_none_or(farther) {
                        let (a, b) = (span.stations[k], span.stations[k + 1]);
                        let (beam, s) = (beam.name.clone(), a + xi * (b - a));
                        most = Some(Self { beam, s, displacement });
                    }
                }
            }
        }
        most
    }
}

/// The share of the way along an element at which it has moved farthest, and the displacement there \[m\].
fn farthest(span: &Span, k: usize, state: &State) -> (f64, [f64; 2]) {
    let (node, inside) = (span.nodes.start + k, span.inside(k));
    let at = |xi: f64| combine(&state.displacement, node, &inside.axis(xi));
    let places: [f64; PIECES + 1] = std::array::from_fn(|j| j as f64 / PIECES as f64);
    let most =
        places.into_iter().fold(0.0, |m, xi| if norm(at(xi)) > norm(at(m)) { xi } else { m });
    let rises = |xi: f64| dot(at(xi), combine(&state.displacement, node, &inside.along(xi))) > 0.0;
    let piece = 1.0 / PIECES as f64;
    let [mut from, mut to] = [(most - piece).max(0.0), (most + piece).min(1.0)];
    if !rises(from) || rises(to) {
        return (most, at(most));
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        if rises(middle) { from = middle } else { to = middle }
    }
    (to, at(to))
}
