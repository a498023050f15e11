//! The only writer of the state of an ensemble: the step at hand becomes the start of the next one.

use super::engine::Engine;
use crate::element::beam::ElementValues;
use crate::element::energy_momentum::End;
use crate::math::hermite::GAUSS;
use crate::scalar::Number;

impl<S: Number> Engine<S> {
    /// Accepts the step at hand.
    #[inline(always)]
    pub fn commit(&mut self) {
        let rate = self.h.recip();
        let twice = rate + rate;
        for n in 0..self.increment.len() {
            let (u, v) = (&mut self.displacement[n], &mut self.velocity[n]);
            let d = &self.increment[n];
            for i in 0..4 {
                u[i] += d[i];
                v[i] = d[i] * twice - v[i];
            }
        }
        self.arrive(twice);
        self.advance_fibres();
        self.constraints.commit();
        for k in 0..self.guides.len() {
            let (guide, state) = (&self.numbers.guides[k], &mut self.guides[k]);
            state.way += state.increment;
            state.velocity = state.increment * twice - state.velocity;
            state.gap += state.gap_change;
            state.rate = guide.along(&self.velocity) - state.velocity;
        }
    }

    /// Gauss points as the displacements have them at the end of the step, and their angular rates there; `twice` is 2/h.
    #[inline(always)]
    fn arrive(&mut self, twice: S) {
        let mut element = 0;
        for span in &self.numbers.spans {
            for k in 0..span.count {
                let (a, table) = (span.first + k, span.table(k));
                let (u, d) = (&self.displacement, &self.increment);
                let values = ElementValues::new(&u[a], &u[a + 1]);
                let step = ElementValues::new(&d[a], &d[a + 1]);
                let (start, spin) = (&mut self.start[element], &mut self.spin[element]);
                let (ends, angles) = End::after(span.measure, &table.rows, start, &values, &step);
                *start = ends;
                for j in 0..GAUSS {
                    spin[j] = (angles[j] * twice) - spin[j];
                }
                element += 1;
            }
        }
    }
}
