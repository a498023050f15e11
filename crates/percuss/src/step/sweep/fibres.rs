//! Fibres of elements side by side.

use std::any::Any;
use std::fmt;

use pulp::Simd;

use crate::element::fibre::FibreState;
use crate::element::yielding::ElementFibres;
use crate::model::frozen::{Span, SpanFibres};
use crate::scalar::{Lanes, Real};
use crate::state::State;

/// The fibres of a span, with as many elements in a register as the processor supports; the type is known only with its registers.
#[derive(Default)]
pub struct SweptFibres(Option<Box<dyn HeldFibres>>);

/// The fibres without their type.
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
    /// State variables of the fibres at the start of the step, without dissipation, shape (registers of elements, fibres of an element).
    states: Vec<FibreState<Lanes<P>>>,
    /// Elements of the span.
    elements: usize,
    /// One in the lanes of the last register that have an element, zero in the others; none if all have one.
    last: Option<Lanes<P>>,
}

impl SweptFibres {
    /// Whether fibres of a span can share registers: those of its elements are equal in kind.
    pub fn can_hold(span: &Span) -> bool {
        span.fibres.as_ref().is_none_or(|of| of.at.len() == 1)
    }

    /// The fibres, if there are any.
    #[inline(always)]
    pub fn lanes<P: Simd>(&self) -> Option<&FibresInLanes<P>> {
        let held: &dyn Any = &**self.0.as_ref()?;
        held.downcast_ref()
    }

    /// Copies the state variables of the fibres of a span.
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
        let rest = elements % P::F64_LANES;
        let mut present = [0.0; MOST_LANES];
        present[..rest].fill(1.0);
        Self {
            elements,
            last: (rest > 0).then(|| like.load(&present)),
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
        let present = self.last.filter(|_| k + P::F64_LANES > self.elements);
        ElementFibres { laws, fibres, states, present }
    }
}

/// More than the lanes of any vector register.
const MOST_LANES: usize = 8;
