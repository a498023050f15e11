//! Residual and tangent of the beams, element after element.

use super::Engine;
use crate::band::Band;
use percuss::StrainMeasure;
use percuss::internals::element::beam::ElementValues;
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
            // What has no damping has code of its own for each measure, without a branch at every Gauss point.
            let span = &self.numbers.spans[i];
            match (span.measure, span.damped, span.fibres.is_some()) {
                (measure, _, true) => self.span::<TANGENT, true, true>(i, element, measure),
                // Derivatives need no speed of that kind, and are a third of the machine code.
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
            let step = ElementValues::new(&self.increment[a], &self.increment[a + 1]);
            let u = &self.displacement;
            let old = ElementValues::new(&u[a], &u[a + 1]);
            let (starts, spin) = (&self.start[element], &self.spin[element]);
            let fibres = match &span.fibres {
                Some(fibres) if FIBRES => Some(self.element_fibres(fibres, k)),
                _ => None,
            };
            let (h, lag) = (self.h, DAMPED.then_some(lag));
            let step = InvariantStep {
                table,
                measure,
                starts,
                spin,
                start: old,
                increment: step,
                h,
                rate,
                lag,
                damping,
            };
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

    /// Acceleration of a node in the equation of motion, with what mass-proportional damping adds.
    #[inline(always)]
    fn inertia<const DAMPED: bool>(&self, n: usize, rate: S, damping: S) -> [S; 4] {
        let mean = array(|i| self.increment[n][i] * rate);
        accelerations(mean, &self.velocity[n], rate, DAMPED.then_some(damping))
    }
}
