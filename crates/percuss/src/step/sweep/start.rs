//! The start of a step, elements in lanes: its Gauss points, energies and momenta.

use pulp::{Simd, WithSimd};

use super::{Alike, Sweep, values};
use crate::element::energy_momentum::End;
use crate::element::motion::ElementMeasures;
use crate::element::yielding::gauss_strains;
use crate::model::Model;
use crate::model::frozen::Span;
use crate::scalar::{Lanes, in_lanes};
use crate::state::State;
use crate::step::columns::Columns;

impl Sweep {
    /// Enters a state, the start of the next step.
    pub fn begin(&mut self, model: &Model, state: &State) {
        in_lanes(Begin { sweep: self, model, state });
        self.begun = true;
    }

    /// The same unless it has been done.
    pub fn begin_once(&mut self, model: &Model, state: &State) {
        if !self.begun {
            self.begin(model, state);
        }
        debug_assert!(
            (0..model.element_count()).all(|e| self.spin.row(e) == state.spin[e])
                && (0..model.beam_node_count()).all(|n| {
                    let at = |nodal: &Columns| nodal.row::<4>(n);
                    at(&self.displacement) == state.displacement[n]
                        && at(&self.velocity) == state.velocity[n]
                }),
            "the state was changed since"
        );
    }

    /// The state is about to change.
    pub fn end(&mut self) {
        self.begun = false;
    }

    /// Energies and momenta of a span in the entered state, and the energy stored in hardening \[J\].
    pub fn measure(&mut self, model: &Model, span: usize) -> (ElementMeasures<f64>, f64) {
        in_lanes(Measure { span: &model.spans[span], number: span, sweep: self })
    }

    /// Positions and tangents of nodes from `n` on.
    #[inline(always)]
    fn place<P: Simd>(&self, like: Lanes<P>, n: usize) -> [Lanes<P>; 4] {
        let mut place: [Lanes<P>; 4] = self.frames.load_row(like, n);
        for i in 0..4 {
            place[i] += self.displacement.load(like, i, n);
        }
        place
    }
}

/// See [`Sweep::begin`].
pub struct Begin<'a> {
    pub sweep: &'a mut Sweep,
    pub model: &'a Model,
    pub state: &'a State,
}

impl WithSimd for Begin<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<P: Simd>(self, family: P) {
        let Self { sweep, model, state } = self;
        let (like, nodes) = (Lanes::new(family, 0.0), model.beam_node_count());
        sweep.displacement.gather(0, &state.displacement[..nodes]);
        sweep.velocity.gather(0, &state.velocity[..nodes]);
        sweep.spin.gather(0, &state.spin);
        for (i, span) in model.spans.iter().enumerate() {
            sweep.carries_force[i] = span.fibres.as_ref().is_none_or(|own| {
                let mut all = state.fibres[own.first..][..span.elements.len() * own.count].iter();
                all.all(|fibre| !fibre.failed)
            });
            if !sweep.has(i) {
                continue;
            }
            sweep.fibres[i].begin(span, state, like);
            let mut table = span.tables[0].map(&mut Alike(like));
            for k in (0..span.elements.len()).step_by(P::F64_LANES) {
                if let Some(own) = sweep.table((i, span), k, like) {
                    table = own;
                }
                let u = values(&sweep.displacement, like, span.nodes.start + k);
                let ends = End::all(span.measure, &table.rows, &u);
                for (j, end) in ends.iter().enumerate() {
                    sweep.set_start(span.elements.start + k, j, end);
                }
            }
        }
    }
}

/// See [`Sweep::measure`].
pub struct Measure<'a> {
    pub sweep: &'a mut Sweep,
    pub span: &'a Span,
    pub number: usize,
}

impl WithSimd for Measure<'_> {
    type Output = (ElementMeasures<f64>, f64);
    #[inline(always)]
    fn with_simd<P: Simd>(self, family: P) -> Self::Output {
        let Self { sweep, span, number } = self;
        let like = Lanes::new(family, 0.0);
        let mut table = span.tables[0].map(&mut Alike(like));
        let count = span.elements.len();
        let (mut sums, mut hardening) = (ElementMeasures::zero(0.0), 0.0);
        for k in (0..count).step_by(P::F64_LANES) {
            if let Some(own) = sweep.table((number, span), k, like) {
                table = own;
            }
            let (a, element) = (span.nodes.start + k, span.elements.start + k);
            let places = [sweep.place(like, a), sweep.place(like, a + 1)];
            let velocity = [sweep.velocity.load_row(like, a), sweep.velocity.load_row(like, a + 1)];
            let spin = sweep.spin.load_row(like, element);
            let mut own = ElementMeasures::of_motion(&table, &places, &velocity, &spin);
            let u = values(&sweep.displacement, like, a);
            if let Some(fibres) = sweep.fibres[number].lanes::<P>() {
                let strains = gauss_strains(&table, span.measure, &u);
                let stored = fibres.of(k).energies(&table, &strains);
                own.add_fibres(&stored);
                (0..P::F64_LANES.min(count - k)).for_each(|i| hardening += stored.hardening.at(i));
            } else {
                own.add_strains(&table, span.measure, &sweep.starts(like, element), &u);
            }
            // Element by element, for any registers.
            for lane in 0..P::F64_LANES.min(count - k) {
                sums.add(&ElementMeasures {
                    translation: own.translation.at(lane),
                    rotation: own.rotation.at(lane),
                    rate_drift: own.rate_drift.at(lane),
                    axial: own.axial.at(lane),
                    bending: own.bending.at(lane),
                    linear: [own.linear[0].at(lane), own.linear[1].at(lane)],
                    linear_size: own.linear_size.at(lane),
                    angular: own.angular.at(lane),
                    angular_size: own.angular_size.at(lane),
                });
            }
        }
        (sums, hardening)
    }
}
