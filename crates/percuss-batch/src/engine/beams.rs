//! Residual and tangent of the beams, element after element.

use super::Engine;
use percuss::StrainMeasure;
use percuss::internals::element::beam::ElementValues;
use percuss::internals::element::invariant::ElasticStep;
use percuss::internals::element::yielding::{ElementFibres, ElementStep, ElementTurn};
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
            let sums = if FIBRES {
                let Some(fibres) = &span.fibres else { return };
                let (start, increment, h) = (&old, &step, self.h);
                let states = &self.fibres.states[fibres.range(k)];
                let of = ElementFibres { laws: &fibres.laws, fibres: fibres.of(k), states };
                let turn = ElementTurn { starts, spin, rate, damping };
                ElementStep { table, measure, start, increment, h, lag }
                    .sums::<TANGENT>(&of, &turn)
                    .0
            } else {
                let (start, increment) = (old, step);
                let lag = DAMPED.then_some(lag);
                ElasticStep { table, measure, starts, spin, start, increment, rate, lag, damping }
                    .sums::<TANGENT>()
                    .0
            };
            let [mut on_a, mut on_b] = sums.nodal_force();
            table.add_inertia(&start, &end, &mut on_a, &mut on_b);
            for i in 0..4 {
                self.residual[a][i] += on_a[i];
            }
            self.residual[a + 1] = on_b;
            if TANGENT {
                let [aa, ab, ba, bb] = sums.nodal_tangent(&table.mass, inertia_slope);
                for i in 0..4 {
                    for j in 0..4 {
                        self.tangent.diag[a][i][j] += aa[i][j];
                    }
                }
                self.tangent.upper[a] = ab;
                self.tangent.lower[a] = ba;
                self.tangent.diag[a + 1] = bb;
            }
            start = end;
        }
    }

    /// Acceleration of a node in the equation of motion, with what mass-proportional damping adds.
    #[inline(always)]
    fn inertia<const DAMPED: bool>(&self, n: usize, rate: S, damping: S) -> [S; 4] {
        let (d, v) = (&self.increment[n], &self.velocity[n]);
        let mut acceleration = array(|i| (d[i] * rate - v[i]) * (rate + rate));
        if DAMPED {
            for i in 0..4 {
                acceleration[i] += d[i] * rate * damping;
            }
        }
        acceleration
    }
}
