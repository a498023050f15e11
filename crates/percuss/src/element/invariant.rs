//! An element over a step of the invariant energy-momentum scheme (theory, page 2), elastic or with a fibre section (page 6): its share of
//! the integrals of the paper's eqs. (4) and (9), without the inertia of translation.

use super::beam::{ElementSums, ElementTable, ElementValues};
use super::energy_momentum::{End, PointStep, Quotients, Step};
use super::point::SectionLaw;
use super::strain::StrainMeasure;
use super::yielding::{ElementFibres, ElementStep, ElementTurn};
use crate::math::hermite::GAUSS;
use crate::scalar::Number;

/// A step of an element.
#[derive(Clone, Copy, Debug)]
pub struct InvariantStep<'a, S> {
    /// The element.
    pub table: &'a ElementTable<S>,
    /// Its strain measure.
    pub measure: StrainMeasure,
    /// Its Gauss points at the start, shape (Gauss points).
    pub starts: &'a [End<S>; GAUSS],
    /// Angular rates of their tangents at the start, shape (Gauss points) \[rad/s\].
    pub spin: &'a [S; GAUSS],
    /// Nodal values at the start, which only slender and fibre elements use, and their increments.
    pub start: ElementValues<S>,
    pub increment: ElementValues<S>,
    /// Size of the step \[s\], and one over it \[1/s\].
    pub h: S,
    pub rate: S,
    /// Retardation time over the step size; none of an undamped material.
    pub lag: Option<S>,
    /// Mass-proportional damping \[1/s\].
    pub damping: S,
}

impl<S: Number> InvariantStep<'_, S> {
    /// Forces but for the inertia of translation, their tangent if `TANGENT`, and the angular rates at the end of the step; of its fibres,
    /// if it has any.
    #[inline(always)]
    pub fn sums<const TANGENT: bool>(
        &self,
        fibres: Option<&ElementFibres<S>>,
    ) -> (ElementSums<S>, [S; GAUSS]) {
        let Some(fibres) = fibres else { return self.elastic::<TANGENT>() };
        let Self { table, measure, starts, spin, h, rate, damping, .. } = *self;
        let (start, increment) = (&self.start, &self.increment);
        let lag = self.lag.unwrap_or(h.constant(0.0));
        ElementStep { table, measure, start, increment, h, lag }
            .sums::<TANGENT>(fibres, &ElementTurn { starts, spin, rate, damping })
    }

    #[inline(always)]
    fn elastic<const TANGENT: bool>(&self) -> (ElementSums<S>, [S; GAUSS]) {
        let Self { table, measure, starts, rate, lag, damping, .. } = *self;
        let mut sums = ElementSums::zero(rate);
        let ([r0, r1, r2], [s0, s1, s2], step) = (&table.rows, starts, &self.increment);
        let ways = [
            PointStep::new(r0, s0, step),
            PointStep::new(r1, s1, step),
            PointStep::new(r2, s2, step),
        ];
        let quotients = Quotients::of(measure, &ways);
        let mut spin = *self.spin;
        for j in 0..GAUSS {
            let row = &table.rows[j];
            let new = Step::new(measure, &ways[j], &quotients[j]);
            let law = SectionLaw { measure, ..row.weighed };
            let mut point = new.response::<TANGENT>(&law, &starts[j], lag);
            new.turn.add_inertia::<TANGENT>(&mut point, law.rotary, spin[j], rate, damping);
            sums.add::<TANGENT>(row, &point);
            spin[j] = new.turn.end_spin(rate, spin[j]);
        }
        if let Some(samples) = &table.membrane {
            let [s0, s1, s2] = &samples.step(&self.start, &self.increment);
            let points = [
                s0.invariant(measure, lag),
                s1.invariant(measure, lag),
                s2.invariant(measure, lag),
            ];
            samples.add::<TANGENT>(&points, 0.5, &mut sums);
        }
        (sums, spin)
    }
}
