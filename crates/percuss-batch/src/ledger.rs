//! Energy and momentum balances of the runs of an ensemble.

use super::engine::Engine;
use super::numbers::SpanNumbers;
use percuss::internals::element::beam::ElementValues;
use percuss::internals::element::energy_momentum::End;
use percuss::internals::element::motion::ElementMeasures;
use percuss::internals::element::point::Strains;
use percuss::internals::ledger::{Audit, Flows, Ledger, Measures, StepWork};
use percuss::internals::scalar::{Number, array};
use percuss::internals::step::damping::{MassDamping, viscous};
use percuss::math::vec2::{cross, scale};

/// Energies and momenta supplied and dissipated since the start, those of the state, and the balance errors.
#[derive(Clone, Copy, Debug)]
pub struct LaneLedger<S> {
    pub sums: Ledger<S>,
    pub now: Measures<S>,
    pub audit: Audit<S>,
}

impl<S: Number> LaneLedger<S> {
    /// Opens the ledger of a state.
    #[inline(always)]
    pub fn open(engine: &Engine<S>) -> Self {
        let now = engine.measure();
        let sums = Ledger::open(&now, &engine.numbers.round_off);
        Self { sums, now, audit: Audit::none(engine.h) }
    }

    /// Copies a lane of another ledger.
    pub fn set_lane(&mut self, lane: usize, from: &Self, from_lane: usize) {
        for (mine, other) in self.numbers().zip({ *from }.numbers()) {
            mine.set_lane(lane, *other, from_lane);
        }
    }

    /// All its numbers.
    #[inline(always)]
    pub(super) fn numbers(&mut self) -> impl Iterator<Item = &mut S> {
        self.sums.numbers().chain(self.now.numbers()).chain(self.audit.numbers())
    }

    /// Enters a solved step: reactions, guides, losses, loads. Returns the sums up to its start for [`LaneLedger::close`].
    #[inline(always)]
    pub fn enter(&mut self, engine: &Engine<S>) -> Flows<S> {
        let h = engine.h;
        let so_far = self.sums.set_aside();
        for (dofs, reaction) in engine.numbers.prescribed.iter().zip(&engine.reactions) {
            let [r1, r2, c1, c2] = *reaction;
            let [x, g] = engine.middle(dofs.node);
            self.sums.react(h, x, [r1, r2], cross(g, [c1, c2]));
        }
        engine.enter_constraints(&mut self.sums);
        engine.enter_springs(&mut self.sums);
        for (guide, state) in engine.numbers.guides.iter().zip(&engine.guides) {
            // The guide carries the couple of a force off the line of motion.
            let push = state.force + state.impulse / h;
            let way = state.way + state.increment * 0.5;
            let own: [S; 2] = array(|i| guide.position[i] + guide.direction[i] * way);
            let (u, d) = (guide.value(&engine.displacement), guide.value(&engine.increment));
            let arm = array(|i| guide.struck[i] + u[i] + d[i] * 0.5 - own[i]);
            self.sums.angular_impulse_supports += h * push * cross(arm, guide.direction);
            // Work of an impulse: L (z0 + z1)/2, the mean rate over the step.
            self.sums.loss_impacts += -(state.impulse * state.gap_change / h);
        }
        engine.enter_loads(&mut self.sums);
        engine.enter_damping(&mut self.sums);
        so_far
    }

    /// Enters the new state and updates the balance errors.
    #[inline(always)]
    pub fn close(&mut self, engine: &Engine<S>, so_far: Flows<S>) {
        let [plastic, viscous] = engine.fibres.taken;
        self.sums.loss_plastic += plastic;
        self.sums.loss_damping += viscous;
        self.sums.put_on(so_far);
        self.now = engine.measure();
        self.sums.rescale(&self.now);
        self.audit.take(&self.sums, &self.now);
    }
}

impl<S: Number> Engine<S> {
    /// Position and tangent of a node in the middle of the step.
    #[inline(always)]
    pub fn middle(&self, n: usize) -> [[S; 2]; 2] {
        let (frame, u, d) = (&self.numbers.nodes[n], &self.displacement[n], &self.increment[n]);
        let at = |i: usize| frame[i] + u[i] + d[i] * 0.5;
        [[at(0), at(1)], [at(2), at(3)]]
    }

    /// Position and tangent of a node.
    #[inline(always)]
    fn place(&self, n: usize) -> [S; 4] {
        array(|i| self.numbers.nodes[n][i] + self.displacement[n][i])
    }

    /// Enters the dissipation by material damping of the beams.
    #[inline(always)]
    fn enter_damping(&self, ledger: &mut Ledger<S>) {
        let mut element = 0;
        for span in &self.numbers.spans {
            if span.damped {
                let mut sum = StepWork::none(self.h);
                for k in 0..span.count {
                    let lag = span.retardation / self.h;
                    if span.fibres.is_none() {
                        ledger.loss_damping += self.viscous_loss(span, k, element + k) * lag;
                    }
                    self.mass_damping(span, k, element + k, &mut sum);
                }
                ledger.damp(&sum);
            }
            element += span.count;
        }
    }

    /// Dissipation by viscous damping of an element, without the factor `tau/h`.
    #[inline(always)]
    fn viscous_loss(&self, span: &SpanNumbers<S>, k: usize, element: usize) -> S {
        let (a, table, measure) = (span.first + k, span.table(k), span.measure);
        let (u, d) = (&self.displacement, &self.increment);
        let old = ElementValues::new(&u[a], &u[a + 1]);
        let (at_a, at_b): ([S; 4], [S; 4]) =
            (array(|i| u[a][i] + d[a][i]), array(|i| u[a + 1][i] + d[a + 1][i]));
        let new = ElementValues::new(&at_a, &at_b);
        let (starts, ends) = (&self.start[element], &End::all(measure, &table.rows, &new));
        let change = |j: usize| {
            let reference = &table.rows[j].reference;
            let bent = |end: &End<S>| end.bent(measure, reference).strain;
            let (start, end) = (&starts[j], &ends[j]);
            Strains { membrane: end.membrane - start.membrane, bending: bent(end) - bent(start) }
        };
        let sampled = table.membrane.as_ref().map(|samples| {
            let (s0, s1) = (samples.strains(measure, &old), samples.strains(measure, &new));
            array(|i| s1[i] - s0[i])
        });
        viscous(table, &[change(0), change(1), change(2)], sampled)
    }

    /// Dissipation and impulse of mass-proportional damping of an element.
    #[inline(always)]
    fn mass_damping(&self, span: &SpanNumbers<S>, k: usize, element: usize, sum: &mut StepWork<S>) {
        let (a, table, d) = (span.first + k, span.table(k), &self.increment);
        let rate = self.h.recip();
        let velocity = [array(|i| d[a][i] * rate), array(|i| d[a + 1][i] * rate)];
        let damping = MassDamping { table, coefficient: span.mass_damping, h: self.h };
        let middle = [self.middle(a), self.middle(a + 1)];
        damping.translation(&velocity, middle, [&d[a], &d[a + 1]], sum);
        let [s0, s1, s2] = &self.start[element];
        let step = ElementValues::new(&d[a], &d[a + 1]);
        damping.rotation(&[s0.slope, s1.slope, s2.slope], &step, sum);
    }

    /// Energies and momenta of the state.
    #[inline(always)]
    pub fn measure(&self) -> Measures<S> {
        let mut m = Measures::none(self.h);
        let mut element = 0;
        for span in &self.numbers.spans {
            let mut sums = ElementMeasures::zero(self.h);
            for k in 0..span.count {
                let (a, table) = (span.first + k, span.table(k));
                let (places, spin) = ([self.place(a), self.place(a + 1)], &self.spin[element]);
                let velocity = [self.velocity[a], self.velocity[a + 1]];
                let mut own = ElementMeasures::of_motion(table, &places, &velocity, spin);
                if let Some(fibres) = &span.fibres {
                    let stored = self.fibre_energies((span, fibres), k, element);
                    own.add_fibres(&stored);
                    m.hardening += stored.hardening;
                } else {
                    let u = ElementValues::new(&self.displacement[a], &self.displacement[a + 1]);
                    own.add_strains(table, span.measure, &self.start[element], &u);
                }
                sums.add(&own);
                element += 1;
            }
            m.add_beams(&sums);
        }
        m.springs = self.spring_energy();
        for (guide, state) in self.numbers.guides.iter().zip(&self.guides) {
            let momentum = guide.mass * state.velocity;
            m.kinetic_projectiles += momentum * state.velocity * 0.5;
            m.contact += guide.energy(-state.gap);
            let x = array(|i| guide.position[i] + guide.direction[i] * state.way);
            m.add_momentum(x, scale(momentum, guide.direction), self.h.constant(0.0));
        }
        m
    }

    /// Displacement and velocity of a recorded point.
    #[inline(always)]
    pub fn point(&self, k: usize) -> [[S; 2]; 2] {
        let p = &self.numbers.points[k];
        [p.value(&self.displacement), p.value(&self.velocity)]
    }
}
