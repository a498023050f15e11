//! Fibres over a step, elements in lanes.

use pulp::{Simd, WithSimd};

use super::{Alike, Sweep, values};
use crate::element::fibre::{FibreFlow, FibreLosses};
use crate::element::yielding::ElementStep;
use crate::math::hermite::GAUSS;
use crate::model::frozen::Span;
use crate::scalar::{Lanes, Mask, Number, Real, in_lanes};
use crate::state::State;
use crate::step::integration::Integration;

/// Moves the fibres of a swept span to the end of the step that was evaluated last.
pub struct AdvanceFibres<'a> {
    pub sweep: &'a Sweep,
    pub span: &'a Span,
    /// Number of the span.
    pub number: usize,
    pub state: &'a mut State,
    pub rule: &'a Integration,
    pub losses: &'a mut FibreLosses,
}

impl AdvanceFibres<'_> {
    /// Advances; returns elements in which a fibre has reached its failure strain, numbers in the span.
    pub fn advance(self) -> Vec<usize> {
        in_lanes(self)
    }
}

impl WithSimd for AdvanceFibres<'_> {
    type Output = Vec<usize>;
    #[inline(always)]
    fn with_simd<P: Simd>(self, family: P) -> Vec<usize> {
        let Self { sweep, span, number, state, rule, losses } = self;
        let mut failing = Vec::new();
        let (Some(held), Some(own)) = (sweep.fibres[number].lanes::<P>(), &span.fibres) else {
            return failing;
        };
        let like = Lanes::new(family, 0.0);
        let mut table = span.tables[0].map(&mut Alike(like));
        let h = like.constant(rule.h);
        let lag = like.constant(rule.lag(span.retardation));
        let count = span.elements.len();
        for k in (0..count).step_by(P::F64_LANES) {
            if let Some(own) = sweep.table((number, span), k, like) {
                table = own;
            }
            let table = &table;
            let a = span.nodes.start + k;
            let start = &values(&sweep.displacement, like, a);
            let increment = &values(&sweep.increment, like, a);
            let measure = span.measure;
            let [from, to] = ElementStep { table, measure, start, increment, h, lag }.strains();
            let fibres = held.of(k);
            let [from, to] = [from, to].map(|strains| strains.map(|one| fibres.strained(one)));
            let elements = 0..P::F64_LANES.min(count - k);
            let mut flow = FibreFlow::beside([like; 2]);
            let mut i = 0;
            for j in 0..GAUSS {
                let weight = table.rows[j].weight;
                for fibre in &fibres.fibres[j] {
                    let law = &fibres.laws[fibre.law];
                    let before = fibres.states[i];
                    let mut after = before;
                    let on = (weight, [from[j], to[j]]);
                    let plastic = flow.advance((law, fibre), &mut after, on, (h, lag));
                    if before.accumulated.less(after.accumulated).any() {
                        losses.yielded = true;
                        for lane in elements.clone() {
                            let state = &mut state.fibres[own.range(k + lane)][i];
                            state.plastic = after.plastic.at(lane);
                            state.accumulated = after.accumulated.at(lane);
                            state.dissipated += plastic.at(lane);
                        }
                    }
                    i += 1;
                }
            }
            for lane in elements {
                losses.plastic += flow.taken[0].at(lane);
                losses.viscous += flow.taken[1].at(lane);
                if flow.failing.lane(lane) {
                    failing.push(k + lane);
                }
            }
        }
        failing
    }
}
