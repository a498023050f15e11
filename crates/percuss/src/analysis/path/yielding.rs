//! First yields along an equilibrium path: arcs end at a first yield, since the path has a kink there.

use super::tracer::{Mark, Tracer};
use crate::analysis::yields::{self, PathYield};

/// An arc that ends no further than this share beyond a first yield is not cut.
const NEAR: f64 = 0.98;
/// Least length of a cut arc, as a share of the first.
const SHORT: f64 = 1e-3;
/// Distance of the end of a cut arc beyond it, relative.
const BEYOND: f64 = 1e-6;

/// Result of the last arc.
pub(super) enum Yielded {
    /// First yields, in their order, shape (those on the arc); most arcs have none.
    Here(Vec<PathYield>),
    /// The first of them is well before its end: the arc that leads there.
    Before(f64),
}

impl Tracer<'_> {
    /// Whether parts that yielded on the way to a later point have yielded here.
    pub(super) fn has_yielded(&mut self, one: &PathYield) -> bool {
        let here = self.search.reached();
        let mut all = self.search.model.yielding();
        all.any(|(.., own)| own.name == one.name && here.memories[own.memory].accumulated > 0.0)
    }

    /// First yields from a mark along an arc, `first` the first one of the path.
    pub(super) fn yielded(&mut self, before: &Mark, arc: f64, first: f64) -> Yielded {
        if self.search.model.memory_count() == 0 {
            return Yielded::Here(Vec::new());
        }
        let here = self.mark();
        let differs = |(a, b): (&_, &_)| a != b;
        if !before.reached.memories.iter().zip(&here.reached.memories).any(differs) {
            return Yielded::Here(Vec::new());
        }
        self.back_to(before);
        let known = self.prepare();
        let rate = self.response.nodal.clone();
        let length = self.inner(&rate, &rate).sqrt();
        self.back_to(&here);
        let places = [&before.reached, &here.reached];
        let moved = (&rate[..], arc / length);
        let found = yields::between(self.search.model, &self.search.base, places, moved);
        let to = found.first().map_or(f64::INFINITY, |crossing| crossing.rise.abs() * length);
        let cut = (to * (1.0 + BEYOND)).max(SHORT * first);
        if known && cut < NEAR * arc {
            return Yielded::Before(cut);
        }
        let range = [before.factor, here.factor];
        let [least, most] = [range[0].min(range[1]), range[0].max(range[1])];
        let factor = |rise: f64| match (before.factor + rise).clamp(least, most) {
            factor if known && factor.is_finite() => factor,
            _ => here.factor,
        };
        let recorded = |one: &yields::Crossing| PathYield {
            name: one.own.name.clone(),
            factor: factor(one.rise),
        };
        Yielded::Here(found.iter().map(recorded).collect())
    }
}
