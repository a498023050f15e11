//! Fibres of elements side by side.

use std::any::Any;
use std::fmt;

use pulp::{Simd, WithSimd};

use super::{Alike, Sweep, values};
use crate::element::fibre::{FibreFlow, FibreState};
use crate::element::yielding::{ElementFibres, ElementStep};
use crate::math::hermite::GAUSS;
use crate::model::frozen::{Span, SpanFibres};
use crate::scalar::{Lanes, Mask, Number, Real, in_lanes};
use crate::state::State;
use crate::step::fibres::FibreLosses;
use crate::step::integration::Integration;

/// The fibres of a span, so many elements in a register as the processor takes; of what type, is known only where its registers are.
#[derive(Default)]
pub struct SweptFibres(Option<Box<dyn HeldFibres>>);

/// What is held without its type.
trait HeldFibres: Any + Send + Sync {
    fn copy(&self) -> Box<dyn HeldFibres>;
}

impl<P: Simd> HeldFibres for FibresInLanes<P> {
    fn copy(&self) -> Box<dyn HeldFibres> {
        Box::new(self.clone())
    }
}

impl Clone for SweptFibres {
    fn clone(&self) -> Self {
        Self(self.0.as_ref().map(|held| (**held).copy()))
    }
}

impl fmt::Debug for SweptFibres {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_tuple("SweptFibres").field(&self.0.is_some()).finish()
    }
}

/// The fibres of a span in the registers of a processor family.
#[derive(Clone, Debug)]
pub struct FibresInLanes<P: Simd> {
    /// Laws and layout, the same in every lane.
    of: SpanFibres<Lanes<P>>,
    /// What the fibres remember at the start of the step, dissipation apart, shape (registers of elements, fibres of an element).
    states: Vec<FibreState<Lanes<P>>>,
}

impl SweptFibres {
    /// Whether fibres of a span can stand side by side: those of its elements are alike.
    pub fn can_hold(span: &Span) -> bool {
        span.fibres.as_ref().is_none_or(|of| of.at.len() == 1 && span.tables.len() == 1)
    }

    /// The fibres, if there are any.
    #[inline(always)]
    pub fn lanes<P: Simd>(&self) -> Option<&FibresInLanes<P>> {
        let held: &dyn Any = &**self.0.as_ref()?;
        held.downcast_ref()
    }

    /// Takes in what the fibres of a span remember.
    pub fn begin<P: Simd>(&mut self, span: &Span, state: &State, like: Lanes<P>) {
        let Some(of) = &span.fibres else { return };
        if self.lanes::<P>().is_none() {
            self.0 = Some(Box::new(FibresInLanes::new(of, span.elements.len(), like)));
        }
        let Some(held) = &mut self.0 else { return };
        let held: &mut dyn Any = &mut **held;
        if let Some(fibres) = held.downcast_mut::<FibresInLanes<P>>() {
            fibres.take_in(&state.fibres[of.first..][..span.elements.len() * of.count], like);
        }
    }
}

impl<P: Simd> FibresInLanes<P> {
    fn new(of: &SpanFibres, elements: usize, like: Lanes<P>) -> Self {
        let fresh =
            FibreState { plastic: like, accumulated: like, dissipated: like, failed: false };
        let registers = elements.div_ceil(P::F64_LANES);
        Self {
            of: of.map(&mut |number| like.constant(number)),
            states: vec![fresh; registers * of.count],
        }
    }

    fn take_in(&mut self, all: &[FibreState], like: Lanes<P>) {
        let count = self.of.count;
        let registers = self.states.chunks_exact_mut(count);
        for (register, own) in registers.zip(all.chunks(count * P::F64_LANES)) {
            for (i, fibre) in register.iter_mut().enumerate() {
                let (mut plastic, mut accumulated) = ([0.0; MOST_LANES], [0.0; MOST_LANES]);
                for (lane, state) in own[i..].iter().step_by(count).enumerate() {
                    (plastic[lane], accumulated[lane]) = (state.plastic, state.accumulated);
                }
                fibre.plastic = like.load(&plastic);
                fibre.accumulated = like.load(&accumulated);
            }
        }
    }

    /// Those of the elements from number `k` of the span on.
    #[inline(always)]
    pub fn of(&self, k: usize) -> ElementFibres<'_, Lanes<P>> {
        let (laws, fibres) = (&self.of.laws, self.of.of(k));
        let states = &self.states[k / P::F64_LANES * self.of.count..][..self.of.count];
        ElementFibres { laws, fibres, states }
    }
}

/// More than any vector register holds.
const MOST_LANES: usize = 8;

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
    /// Advances; returns elements in which a fibre has come to its failure strain, numbers in the span.
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
        let table = &span.tables[0].map(&mut Alike(like));
        let h = like.constant(rule.h);
        let lag = like.constant(rule.lag(span.retardation));
        let count = span.elements.len();
        for k in (0..count).step_by(P::F64_LANES) {
            let a = span.nodes.start + k;
            let start = &values(&sweep.displacement, like, a);
            let increment = &values(&sweep.increment, like, a);
            let measure = span.measure;
            let [from, to] = ElementStep { table, measure, start, increment, h, lag }.strains();
            let fibres = held.of(k);
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
