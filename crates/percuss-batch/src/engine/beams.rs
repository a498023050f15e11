//! Residual and tangent of the beams, element after element.

use super::Engine;
use crate::band::Band;
use crate::numbers::SpanNumbers;
use percuss::StrainMeasure;
use percuss::internals::element::beam::{ElementTable, ElementValues};
use percuss::internals::element::invariant::InvariantStep;
use percuss::internals::element::motion::accelerations;
use percuss::internals::linalg::chain::add_element;
use percuss::internals::scalar::{Number, array};

impl<S: Number> Engine<S> {
    /// Residual and tangent of the beams.
    #[inline(always)]
    pub(super) fn beams<const TANGENT: bool>(&mut self) {
        let mut element = 0;
        for i in 0..self.numbers.spans.len() {
            // Spans without damping have separate code for each measure, without a branch at every Gauss point.
            let span = &self.numbers.spans[i];
            match (span.measure, span.damped, span.fibres.is_some()) {
                (measure, _, true) => self.span::<TANGENT, true, true>(i, element, measure),
                // Derivatives do not need this speed; their code would be a third of the machine code.
                (measure, damped, _) if damped || S::DERIVES => {
                    self.span::<TANGENT, true, false>(i, element, measure);
                }
                (StrainMeasure::Green, _, _) => {
                    self.span::<TANGENT, false, false>(i, element, StrainMeasure::Green);
                }
                (StrainMeasure::Engineering, _, _) => {
                    self.span::<TANGENT, false, false>(i, element, StrainMeasure::Engineering);
                }
            }
            element += self.numbers.spans[i].count;
        }
    }

    /// Residual and tangent of a span, whose first element is the one of the given number.
    #[inline(always)]
    fn span<const TANGENT: bool, const DAMPED: bool, const FIBRES: bool>(
        &mut self,
        i: usize,
        first: usize,
        measure: StrainMeasure,
    ) {
        let span = &self.numbers.spans[i];
        let zero = self.h.constant(0.0);
        let rate = self.h.recip();
        let twice = rate + rate;
        let (lag, damping) =
            if DAMPED { (span.retardation * rate, span.mass_damping) } else { (zero, zero) };
        let inertia_slope = (twice + damping) * rate;
        self.residual[span.first] = [zero; 4];
        if TANGENT {
            self.tangent.diag[span.first] = [[zero; 4]; 4];
        }
        let mut start = self.inertia::<DAMPED>(span.first, rate, damping);
        for k in 0..span.count {
            let (a, element, table) = (span.first + k, first + k, span.table(k));
            let end = self.inertia::<DAMPED>(a + 1, rate, damping);
            let fibres = match &span.fibres {
                Some(fibres) if FIBRES => Some(self.element_fibres(fibres, k)),
                _ => None,
            };
            let lag = DAMPED.then_some(lag);
            let step = self.invariant_step((table, a, element), measure, rate, (lag, damping));
            let (sums, _) = step.sums::<TANGENT>(fibres.as_ref());
            let [mut on_a, mut on_b] = sums.nodal_force();
            table.add_inertia(&start, &end, &mut on_a, &mut on_b);
            for i in 0..4 {
                self.residual[a][i] += on_a[i];
            }
            self.residual[a + 1] = on_b;
            if TANGENT {
                let Band { diag, upper, lower } = &mut self.tangent;
                let blocks = sums.nodal_tangent(&table.mass, inertia_slope);
                add_element([diag, upper, lower], a, &blocks);
            }
            start = end;
        }
    }

    /// An element over the current step: its table, first node and number, and its damping.
    #[inline(always)]
    fn invariant_step<'a>(
        &'a self,
        (table, a, element): (&'a ElementTable<S>, usize, usize),
        measure: StrainMeasure,
        rate: S,
        (lag, damping): (Option<S>, S),
    ) -> InvariantStep<'a, S> {
        let (u, d) = (&self.displacement, &self.increment);
        InvariantStep {
            table,
            measure,
            starts: &self.start[element],
            spin: &self.spin[element],
            start: ElementValues::new(&u[a], &u[a + 1]),
            increment: ElementValues::new(&d[a], &d[a + 1]),
            h: self.h,
            rate,
            lag,
            damping,
        }
    }

    /// Forces on the nodes of an element, of the given number in its span and among all, at the current increment; without translational inertia,
    /// with rotary inertia.
    #[inline(always)]
    pub fn internal_force(&self, span: &SpanNumbers<S>, k: usize, element: usize) -> [[S; 4]; 2] {
        let rate = self.h.recip();
        let fibres = span.fibres.as_ref().map(|fibres| self.element_fibres(fibres, k));
        let lag = (span.damped || fibres.is_some()).then_some(span.retardation * rate);
        let at = (span.table(k), span.first + k, element);
        let step = self.invariant_step(at, span.measure, rate, (lag, span.mass_damping));
        step.sums::<false>(fibres.as_ref()).0.nodal_force()
    }

    /// Acceleration of a node of a span in the equation of motion, with the term of mass-proportional damping.
    #[inline(always)]
    pub fn inertia_in(&self, span: &SpanNumbers<S>, n: usize) -> [S; 4] {
        self.inertia::<true>(n, self.h.recip(), span.mass_damping)
    }

    /// Acceleration of a node in the equation of motion, with the term of mass-proportional damping.
    #[inline(always)]
    fn inertia<const DAMPED: bool>(&self, n: usize, rate: S, damping: S) -> [S; 4] {
        let mean = array(|i| self.increment[n][i] * rate);
        accelerations(mean, &self.velocity[n], rate, DAMPED.then_some(damping))
    }
}
