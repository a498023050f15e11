//! The only writer of the state of an ensemble: the current step becomes the start of the next one.

use super::engine::Engine;
use super::ledger::LaneLedger;
use super::log::Log;
use super::sections::Sections;
use percuss::internals::element::beam::ElementValues;
use percuss::internals::element::energy_momentum::End;
use percuss::internals::scalar::{Number, Task};

/// Accepts the solved step in the lanes of the mask `go`: ledger, state and record. The record of the other lanes does not change; their state and
/// ledger are restored by [`SavedLanes`](super::saved_lanes::SavedLanes).
pub struct Accept<'a, 'm, S: Number> {
    pub engine: &'a mut Engine<S>,
    pub ledger: &'a mut LaneLedger<S>,
    pub log: &'a mut Log<S>,
    /// Section forces, if they are requested.
    pub sections: Option<&'a mut Sections<'m, S>>,
    /// Lanes whose step is accepted; all if `None`.
    pub go: Option<S::Mask>,
}

impl<S: Number> Accept<'_, '_, S> {
    /// Accepts the step.
    #[inline(always)]
    pub fn accept(self) {
        self.engine.h.apart(self);
    }
}

impl<S: Number> Task for Accept<'_, '_, S> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { engine, ledger, log, sections, go } = self;
        if !S::DERIVES
            && let Some(sections) = sections
        {
            sections.take(engine, log.time, go);
        }
        let so_far = ledger.enter(engine);
        engine.commit();
        if let Some(go) = go {
            log.keep(go);
        }
        log.end(engine);
        if let Some(go) = go {
            log.restore(go);
        }
        ledger.close(engine, so_far);
    }
}

impl<S: Number> Engine<S> {
    /// Accepts the current step.
    #[inline(always)]
    fn commit(&mut self) {
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
        self.arrive(rate);
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

    /// Gauss points and their angular rates at the end of the step, from the displacements.
    #[inline(always)]
    fn arrive(&mut self, rate: S) {
        let mut element = 0;
        for span in &self.numbers.spans {
            for k in 0..span.count {
                let (a, table) = (span.first + k, span.table(k));
                let (u, d) = (&self.displacement, &self.increment);
                let values = ElementValues::new(&u[a], &u[a + 1]);
                let step = ElementValues::new(&d[a], &d[a + 1]);
                let (start, spin) = (&mut self.start[element], &mut self.spin[element]);
                let of = (span.measure, &table.rows);
                End::arrive(of, (start, spin), &values, &step, rate);
                element += 1;
            }
        }
    }
}
