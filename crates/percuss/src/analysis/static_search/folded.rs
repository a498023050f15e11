//! Elements that Newton's iteration has folded.

use super::StaticSearch;
use crate::math::vec2::dot;

impl StaticSearch<'_> {
    /// Number of slender elements whose axis runs backwards at an end, against the tangent in the middle: it turns by more than half a turn, or a
    /// tangent is reversed. Strains are known at a few places, and such an element may have none there: a long correction can lead to it, and it
    /// is no equilibrium of a beam.
    pub(super) fn folded(&self) -> usize {
        let Self { model, base, work, .. } = self;
        let is_folded = |a: usize, length: f64| {
            let at = |n: usize, i: usize| base.displacement[n][i] + work.increment[n][i];
            let [ga, gb] = [a, a + 1].map(|n| -> [f64; 2] {
                std::array::from_fn(|i| model.nodes[n].tangent[i] + at(n, 2 + i))
            });
            let middle: [f64; 2] = std::array::from_fn(|i| {
                let (pa, pb) = (model.nodes[a].position[i], model.nodes[a + 1].position[i]);
                1.5 * (pb - pa + at(a + 1, i) - at(a, i)) / length - 0.25 * (ga[i] + gb[i])
            });
            dot(middle, ga) < 0.0 || dot(middle, gb) < 0.0
        };
        let all = model.each_element();
        let slender = all.filter(|(span, _, a, _)| span.shear.is_none() && !base.has_parted(*a));
        slender.filter(|(span, k, a, _)| is_folded(*a, span.table(*k).length)).count()
    }
}
