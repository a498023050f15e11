//! Residual and tangent of a span, elements in lanes.

use pulp::{Simd, WithSimd};

use super::{Alike, Sweep, values};
use crate::element::beam::ElementValues;
use crate::element::invariant::InvariantStep;
use crate::element::motion::accelerations;
use crate::linalg::block::{Block, ZERO};
use crate::linalg::chain::Chain;
use crate::math::hermite::GAUSS;
use crate::model::{Model, StrainMeasure};
use crate::scalar::{Lanes, Real, in_lanes};
use crate::step::end_forces::EndForces;
use crate::step::integration::Integration;

/// Residual of a span's elements at an increment, and their tangent if `TANGENT`.
pub struct SpanStep<'a, const TANGENT: bool> {
    pub model: &'a Model,
    /// Number of the span.
    pub span: usize,
    pub rule: &'a Integration,
    /// Acceleration of gravity, shape (2) \[m/s^2\].
    pub gravity: [f64; 2],
    /// Increment of the nodal displacements over the step, shape (nodes, 4) \[m, -, rad\].
    pub increment: &'a [[f64; 4]],
    /// Residual, shape (nodes, 4) \[N, N m\].
    pub residual: &'a mut [[f64; 4]],
    pub chain: &'a mut Chain,
    pub forces: &'a mut EndForces,
}

impl<const TANGENT: bool> SpanStep<'_, TANGENT> {
    /// Evaluates.
    pub fn evaluate(self) {
        self.forces.sweep.evaluated = true;
        in_lanes(self);
    }
}

impl<const TANGENT: bool> WithSimd for SpanStep<'_, TANGENT> {
    type Output = ();
    #[inline(always)]
    fn with_simd<P: Simd>(mut self, family: P) {
        let like = Lanes::new(family, 0.0);
        self.accelerations(like);
        match self.model.spans[self.span].measure {
            StrainMeasure::Green => self.elements(like, StrainMeasure::Green),
            StrainMeasure::Engineering => self.elements(like, StrainMeasure::Engineering),
        }
        self.sum(like);
    }
}

impl<const TANGENT: bool> SpanStep<'_, TANGENT> {
    /// Accelerations of the nodes in the equation of motion, less gravity, with the term of mass-proportional damping.
    #[inline(always)]
    fn accelerations<P: Simd>(&mut self, like: Lanes<P>) {
        let span = &self.model.spans[self.span];
        let Sweep { velocity, increment, inertia, .. } = &mut self.forces.sweep;
        let nodes = span.nodes.clone();
        increment.gather(nodes.start, &self.increment[nodes.clone()]);
        let h = like.constant(self.rule.h);
        let rate = h.recip();
        let damping = like.constant(span.mass_damping);
        for n in nodes.step_by(P::F64_LANES) {
            let mut mean: [Lanes<P>; 4] = increment.load_row(like, n);
            for d in &mut mean {
                // d/h as the divider rounds it: velocities are made of the same.
                let near = *d * rate;
                *d = near.add_product(d.sub_product(near, h), rate);
            }
            let mut a = accelerations(mean, &velocity.load_row(like, n), rate, Some(damping));
            for i in 0..2 {
                a[i] = a[i] - like.constant(self.gravity[i]);
            }
            (0..4).for_each(|i| inertia.store(i, n, a[i]));
        }
    }

    #[inline(always)]
    fn elements<P: Simd>(&mut self, like: Lanes<P>, measure: StrainMeasure) {
        let span = &self.model.spans[self.span];
        if TANGENT {
            self.chain.diag[span.nodes.start] = ZERO;
        }
        let h = like.constant(self.rule.h);
        let rate = h.recip();
        let lag = like.constant(self.rule.lag(span.retardation));
        let damping = like.constant(span.mass_damping);
        let slope = self.rule.inertia_slope() + span.mass_damping * self.rule.rate_slope();
        let mut table = span.tables[0].map(&mut Alike(like));
        let count = span.elements.len();
        for k in (0..count).step_by(P::F64_LANES) {
            let sweep = &mut self.forces.sweep;
            if let Some(own) = sweep.table((self.span, span), k, like) {
                table = own;
            }
            let (a, element) = (span.nodes.start + k, span.elements.start + k);
            // Others have their start at their Gauss points.
            let start = match table.membrane {
                Some(_) => values(&sweep.displacement, like, a),
                None => ElementValues { chord: [like; 2], slope_a: [like; 2], slope_b: [like; 2] },
            };
            let (table, increment) = (&table, values(&sweep.increment, like, a));
            let starts = &sweep.starts(like, element);
            let spin = &sweep.spin.load_row(like, element);
            let fibres = sweep.fibres[self.span].lanes::<P>().map(|fibres| fibres.of(k));
            let lag = (span.retardation > 0.0).then_some(lag);
            let step = InvariantStep {
                table,
                measure,
                starts,
                spin,
                start,
                increment,
                h,
                rate,
                lag,
                damping,
            };
            let (sums, spin) = step.sums::<TANGENT>(fibres.as_ref());
            let [mut on_a, mut on_b] = sums.nodal_force();
            let acceleration =
                [sweep.inertia.load_row(like, a), sweep.inertia.load_row(like, a + 1)];
            table.add_inertia(&acceleration[0], &acceleration[1], &mut on_a, &mut on_b);
            for i in 0..4 {
                sweep.forces.store(i, element, on_a[i]);
                sweep.forces.store(4 + i, element, on_b[i]);
            }
            if TANGENT {
                let blocks = sums.nodal_tangent(&table.mass, like.constant(slope));
                spread(&blocks, a, P::F64_LANES.min(count - k), self.chain);
            } else {
                for j in 0..GAUSS {
                    sweep.end_spin.store(j, element, spin[j]);
                }
            }
        }
    }

    /// Sums the forces up at the nodes: of the element before a node, then of the one after it.
    #[inline(always)]
    fn sum<P: Simd>(&mut self, like: Lanes<P>) {
        let span = &self.model.spans[self.span];
        let (sweep, count) = (&self.forces.sweep, span.elements.len());
        let (first, last) = (span.elements.start, span.elements.end - 1);
        let residual = &mut self.residual[span.nodes.clone()];
        residual[0] = sweep.on_nodes(first)[0].map(|force| 0.0 + force);
        residual[count] = sweep.on_nodes(last)[1];
        for k in (1..count).step_by(P::F64_LANES) {
            let before: [Lanes<P>; 8] = sweep.forces.load_row(like, first + k - 1);
            let behind: [Lanes<P>; 4] = sweep.forces.load_row(like, first + k);
            let mut sums = behind;
            for i in 0..4 {
                sums[i] = before[4 + i] + behind[i];
            }
            for (lane, own) in residual[k..count].iter_mut().take(P::F64_LANES).enumerate() {
                *own = [sums[0].at(lane), sums[1].at(lane), sums[2].at(lane), sums[3].at(lane)];
            }
        }
    }
}

/// Spreads the tangents of `count` elements from node `a` on over the band.
#[inline(always)]
fn spread<P: Simd>(blocks: &[[[Lanes<P>; 4]; 4]; 4], a: usize, count: usize, chain: &mut Chain) {
    let [aa, ab, ba, bb] = blocks;
    for lane in 0..count {
        let n = a + lane;
        for i in 0..4 {
            for j in 0..4 {
                chain.diag[n][i][j] += aa[i][j].at(lane);
            }
        }
        set_block(&mut chain.upper[n], ab, lane);
        set_block(&mut chain.lower[n], ba, lane);
        set_block(&mut chain.diag[n + 1], bb, lane);
    }
}

#[inline(always)]
fn set_block<P: Simd>(target: &mut Block, block: &[[Lanes<P>; 4]; 4], lane: usize) {
    for i in 0..4 {
        for j in 0..4 {
            target[i][j] = block[i][j].at(lane);
        }
    }
}
