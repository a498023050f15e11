//! Energies and momenta of the runs of an ensemble, and what entered and left them.

use super::engine::{Engine, interpolate};
use super::numbers::SpanNumbers;
use percuss::internals::element::beam::ElementValues;
use percuss::internals::element::energy_momentum::End;
use percuss::internals::element::rotary::{Turn, spin_of_slope};
use percuss::internals::scalar::{Number, array};
use percuss::math::hermite::GAUSS;
use percuss::math::vec2::{add, cross, dot4, sub};

/// Energies and momenta of a state.
#[derive(Clone, Copy, Debug)]
pub struct LaneMeasures<S> {
    /// Energy \[J\].
    pub energy: S,
    /// What hardening has stored of it \[J\].
    pub hardening: S,
    /// Linear momentum, shape (2) \[kg m/s\].
    pub linear: [S; 2],
    /// Sum of its components' magnitudes \[kg m/s\].
    pub linear_size: S,
    /// Angular momentum about the origin, and the sum of its magnitudes \[kg m^2/s\].
    pub angular: S,
    pub angular_size: S,
    /// As [`Measures::angular_rate_drift`](percuss::Measures::angular_rate_drift) \[J\].
    pub angular_rate_drift: S,
}

/// What entered and left since the start, and the largest residuals.
#[derive(Clone, Copy, Debug)]
pub struct LaneLedger<S> {
    pub start: LaneMeasures<S>,
    pub now: LaneMeasures<S>,
    pub energy_scale: S,
    pub linear_scale: S,
    pub angular_scale: S,
    /// Impulse of the supports and guides, shape (2) \[N s\].
    pub impulse: [S; 2],
    /// Their angular impulse \[N m s\].
    pub angular_impulse: S,
    /// Impulse of the loads, shape (2) \[N s\].
    pub impulse_loads: [S; 2],
    /// Their angular impulse \[N m s\].
    pub angular_impulse_loads: S,
    /// Their work \[J\].
    pub work_loads: S,
    pub loss_impacts: S,
    /// Energy that damping took \[J\].
    pub loss_damping: S,
    /// Energy that plastic flow took \[J\].
    pub loss_plastic: S,
    /// Impulse of damping against the ground, shape (2) \[N s\].
    pub impulse_damping: [S; 2],
    /// Its angular impulse \[N m s\].
    pub angular_impulse_damping: S,
    /// Magnitudes of works, impulses and angular impulses, step by step, shape (3) \[J, N s, N m s\].
    pub passed: [S; 3],
    /// Sums up to the last step: work of the loads, impulses of supports and of loads, angular impulses of both, shape (7) \[J, N s, N m s\].
    before: [S; 7],
    pub energy_residual: S,
    pub linear_residual: S,
    pub angular_residual: S,
    /// Largest magnitude of the drift of angular rates \[J\].
    pub angular_rate_drift: S,
}

impl<S: Number> LaneLedger<S> {
    /// Opens the ledger of a state.
    #[inline(always)]
    pub fn open(engine: &Engine<S>) -> Self {
        let zero = engine.h.constant(0.0);
        let start = engine.measure();
        let [energy, linear, angular] = engine.numbers.round_off;
        let mut ledger = Self {
            start,
            now: start,
            energy_scale: energy,
            linear_scale: linear,
            angular_scale: angular,
            impulse: [zero; 2],
            angular_impulse: zero,
            impulse_loads: [zero; 2],
            angular_impulse_loads: zero,
            work_loads: zero,
            loss_impacts: zero,
            loss_damping: zero,
            loss_plastic: zero,
            impulse_damping: [zero; 2],
            angular_impulse_damping: zero,
            passed: [zero; 3],
            before: [zero; 7],
            energy_residual: zero,
            linear_residual: zero,
            angular_residual: zero,
            angular_rate_drift: zero,
        };
        ledger.rescale();
        ledger
    }

    /// Takes over a lane of another ledger.
    pub fn set_lane(&mut self, lane: usize, from: &Self, from_lane: usize) {
        for (mine, other) in self.each().into_iter().zip({ *from }.each()) {
            mine.set_lane(lane, *other, from_lane);
        }
    }

    /// All its numbers.
    #[inline(always)]
    pub(super) fn each(&mut self) -> Vec<&mut S> {
        let mut all = Vec::new();
        for m in [&mut self.start, &mut self.now] {
            let [l1, l2] = &mut m.linear;
            let (energy, size) = (&mut m.energy, &mut m.linear_size);
            all.extend([energy, l1, l2, size, &mut m.angular, &mut m.angular_size]);
            all.extend([&mut m.hardening, &mut m.angular_rate_drift]);
        }
        let [i1, i2] = &mut self.impulse;
        let [l1, l2] = &mut self.impulse_loads;
        all.extend([l1, l2, &mut self.angular_impulse_loads, &mut self.work_loads]);
        let [d1, d2] = &mut self.impulse_damping;
        all.extend([d1, d2, &mut self.angular_impulse_damping, &mut self.loss_damping]);
        all.push(&mut self.loss_plastic);
        all.extend([&mut self.energy_scale, &mut self.linear_scale, &mut self.angular_scale]);
        all.extend([i1, i2, &mut self.angular_impulse, &mut self.loss_impacts]);
        all.extend([&mut self.energy_residual, &mut self.linear_residual]);
        all.extend([&mut self.angular_residual, &mut self.angular_rate_drift]);
        all.extend(&mut self.passed);
        all.extend(&mut self.before);
        all
    }

    /// What residuals are relative to, as of a single run.
    pub fn audit_scales(&self, negligible: &[S; 3]) -> [S; 3] {
        let scales = [self.energy_scale, self.linear_scale, self.angular_scale];
        array(|i| scales[i].max(self.passed[i]).max(negligible[i]))
    }

    #[inline(always)]
    fn pass(&mut self) {
        let ([i1, i2], [l1, l2]) = (self.impulse, self.impulse_loads);
        let angular = [self.angular_impulse, self.angular_impulse_loads];
        let now = [self.work_loads, i1, i2, l1, l2, angular[0], angular[1]];
        let [work, i1, i2, l1, l2, a1, a2] = array(|k| (now[k] - self.before[k]).abs());
        self.before = now;
        let passed = [work, i1 + i2 + l1 + l2, a1 + a2];
        self.passed = array(|k| self.passed[k] + passed[k]);
    }

    #[inline(always)]
    fn rescale(&mut self) {
        let m = &self.now;
        let flows = self.loss_impacts.abs().max(self.work_loads.abs());
        let flows = flows.max(self.loss_damping.abs()).max(self.loss_plastic.abs());
        self.energy_scale = self.energy_scale.max(m.energy.abs()).max(flows);
        let impulses = hypot(self.impulse).max(hypot(self.impulse_loads));
        self.linear_scale = self.linear_scale.max(m.linear_size).max(impulses);
        let impulses = self.angular_impulse.abs().max(self.angular_impulse_loads.abs());
        self.angular_scale = self.angular_scale.max(m.angular_size).max(impulses);
    }

    /// Enters a solved step: reactions, guides, losses, loads.
    #[inline(always)]
    pub fn enter(&mut self, engine: &Engine<S>) {
        let h = engine.h;
        for k in 0..engine.reactions.len() {
            let reaction = engine.reactions[k];
            let (x, g) = engine.middle(engine.numbers.prescribed[k].node);
            let moment = cross(g, [reaction[2], reaction[3]]);
            self.impulse = array(|i| self.impulse[i] + h * reaction[i]);
            self.angular_impulse += h * (cross(x, [reaction[0], reaction[1]]) + moment);
        }
        self.enter_constraints(engine);
        self.enter_springs(engine);
        for (guide, state) in engine.numbers.guides.iter().zip(&engine.guides) {
            // The guide carries the couple of a force off the line of flight.
            let push = state.force + state.impulse / h;
            let way = state.way + state.increment * 0.5;
            let own: [S; 2] = array(|i| guide.position[i] + guide.direction[i] * way);
            let (u, d) = (guide.value(&engine.displacement), guide.value(&engine.increment));
            let mut arm = own;
            for i in 0..2 {
                arm[i] = guide.struck[i] + u[i] + d[i] * 0.5 - own[i];
            }
            self.angular_impulse += h * push * cross(arm, guide.direction);
            self.loss_impacts += -(state.impulse * state.gap_change / h);
        }
        if !engine.numbers.loads.is_empty() {
            self.enter_loads(engine);
        }
        let mut element = 0;
        for span in &engine.numbers.spans {
            if span.damped {
                for k in 0..span.count {
                    self.enter_damping(engine, span, k, element + k);
                }
            }
            element += span.count;
        }
    }

    /// What damping takes of an element: `tau/h (EA (Deps)^2 + EI (Dkappa)^2)`, and the work of the forces in proportion to mass.
    #[inline(always)]
    fn enter_damping(
        &mut self,
        engine: &Engine<S>,
        span: &SpanNumbers<S>,
        k: usize,
        element: usize,
    ) {
        let (h, rate, a, table) = (engine.h, engine.h.recip(), span.first + k, span.table(k));
        let (u, d) = (&engine.displacement, &engine.increment);
        let (old, step) =
            (ElementValues::new(&u[a], &u[a + 1]), ElementValues::new(&d[a], &d[a + 1]));
        let (at_a, at_b): ([S; 4], [S; 4]) =
            (array(|i| u[a][i] + d[a][i]), array(|i| u[a + 1][i] + d[a + 1][i]));
        let new = ElementValues::new(&at_a, &at_b);
        let ends = End::all(span.measure, &table.rows, &new);
        let mut viscous = h.constant(0.0);
        for j in 0..GAUSS {
            let (row, start, end) = (&table.rows[j], &engine.start[element][j], &ends[j]);
            let k0 = start.bent(span.measure, &row.reference).strain;
            let k1 = end.bent(span.measure, &row.reference).strain;
            let (stretched, bent, law) = (end.membrane - start.membrane, k1 - k0, &row.weighed);
            if span.fibres.is_none() {
                viscous += law.axial * stretched * stretched + law.bending * bent * bent;
            }
            let turn = Turn::new(add(row.reference.tangent, start.slope), step.at(&row.first));
            let spin = turn.mean_spin(rate);
            let moment = span.mass_damping * law.rotary * spin;
            self.loss_damping += moment * spin * h;
            self.angular_impulse_damping += -(h * moment);
        }
        if let (Some(samples), None) = (&table.membrane, &span.fibres) {
            let (s0, s1) =
                (samples.strains(span.measure, &old), samples.strains(span.measure, &new));
            viscous += samples.energy(array(|i| s1[i] - s0[i])) * 2.0;
        }
        self.loss_damping += viscous * span.retardation * rate;
        let (mut on_a, mut on_b) = ([h.constant(0.0); 4], [h.constant(0.0); 4]);
        table.add_inertia(&d[a], &d[a + 1], &mut on_a, &mut on_b);
        for (n, momentum) in [(a, &on_a), (a + 1, &on_b)] {
            // Impulse against the motion: the force `-c M d/h` over h.
            let impulse: [S; 4] = array(|i| -(span.mass_damping * momentum[i]));
            let (x, g) = engine.middle(n);
            self.loss_damping += -(dot4(&impulse, &d[n]) * rate);
            self.impulse_damping = array(|i| self.impulse_damping[i] + impulse[i]);
            let moment = cross(g, [impulse[2], impulse[3]]);
            self.angular_impulse_damping += cross(x, [impulse[0], impulse[1]]) + moment;
        }
    }

    /// Takes in the new state.
    #[inline(always)]
    pub fn close(&mut self, engine: &Engine<S>) {
        if !engine.fibres.is_empty() {
            let [plastic, viscous] = engine.fibres.taken;
            self.loss_plastic += plastic;
            self.loss_damping += viscous;
        }
        self.now = engine.measure();
        self.rescale();
        self.pass();
        let (start, now) = (&self.start, &self.now);
        let energy = now.energy - start.energy + self.loss_impacts - self.work_loads;
        let energy = energy + self.loss_damping + self.loss_plastic;
        let impulse = add(add(self.impulse, self.impulse_loads), self.impulse_damping);
        let linear = sub(sub(now.linear, start.linear), impulse);
        let angular_impulse =
            self.angular_impulse + self.angular_impulse_loads + self.angular_impulse_damping;
        let angular = now.angular - start.angular - angular_impulse;
        self.energy_residual = self.energy_residual.max(energy.abs());
        self.linear_residual = self.linear_residual.max(hypot(linear));
        self.angular_residual = self.angular_residual.max(angular.abs());
        self.angular_rate_drift = self.angular_rate_drift.max(now.angular_rate_drift.abs());
    }
}

/// Length of a vector; of zero, without derivatives.
#[inline(always)]
fn hypot<S: Number>(x: [S; 2]) -> S {
    (x[0] * x[0] + x[1] * x[1]).sqrt()
}

impl<S: Number> Engine<S> {
    /// Position and tangent of a node in the middle of the step.
    #[inline(always)]
    pub fn middle(&self, n: usize) -> ([S; 2], [S; 2]) {
        let (frame, u, d) = (&self.numbers.nodes[n], &self.displacement[n], &self.increment[n]);
        let at = |i: usize| frame[i] + u[i] + d[i] * 0.5;
        ([at(0), at(1)], [at(2), at(3)])
    }

    /// Energies and momenta of the state.
    #[inline(always)]
    pub fn measure(&self) -> LaneMeasures<S> {
        let zero = self.h.constant(0.0);
        let mut m = LaneMeasures {
            energy: zero,
            hardening: zero,
            linear: [zero; 2],
            linear_size: zero,
            angular: zero,
            angular_size: zero,
            angular_rate_drift: zero,
        };
        let mut element = 0;
        for span in &self.numbers.spans {
            let (mut twice, mut linear, mut angular) = (zero, [zero; 2], zero);
            let (mut linear_size, mut angular_size, mut drift) = (zero, zero, zero);
            for k in 0..span.count {
                let (a, table) = (span.first + k, span.table(k));
                let (va, vb) = (&self.velocity[a], &self.velocity[a + 1]);
                let (mut pa, mut pb) = ([zero; 4], [zero; 4]);
                table.add_inertia(va, vb, &mut pa, &mut pb);
                linear_size += (pa[0] + pb[0]).abs() + (pa[1] + pb[1]).abs();
                for (node, p, v) in [(a, &pa, va), (a + 1, &pb, vb)] {
                    let (frame, u) = (&self.numbers.nodes[node], &self.displacement[node]);
                    twice += dot4(p, v);
                    linear = add(linear, [p[0], p[1]]);
                    let at = |i: usize| frame[i] + u[i];
                    angular +=
                        cross([at(0), at(1)], [p[0], p[1]]) + cross([at(2), at(3)], [p[2], p[3]]);
                    let size = |a: S, b: S| a.abs() + b.abs();
                    angular_size += size(at(0), at(1)) * size(p[0], p[1])
                        + size(at(2), at(3)) * size(p[2], p[3]);
                }
                let rates = ElementValues::new(va, vb);
                for j in 0..GAUSS {
                    let (row, at) = (&table.rows[j], &self.start[element][j]);
                    let spin = self.spin[element][j];
                    let law = &row.weighed;
                    let turning = law.rotary * spin;
                    twice = twice.add_product(turning, spin);
                    let tangent = add(row.reference.tangent, at.slope);
                    let of_slope = spin_of_slope(tangent, rates.at(&row.first));
                    drift += law.rotary * (of_slope - spin) * (of_slope + spin);
                    if span.fibres.is_none() {
                        let bending = at.bent(span.measure, &row.reference).strain;
                        twice = twice
                            .add_product(law.axial * at.membrane, at.membrane)
                            .add_product(law.bending * bending, bending);
                    }
                    angular += turning;
                    angular_size += turning.abs();
                }
                if let Some(fibres) = &span.fibres {
                    let stored = self.fibre_energies((span, fibres), k, element);
                    twice += (stored.elastic + stored.hardening) * 2.0;
                    m.hardening += stored.hardening;
                } else if let Some(samples) = &table.membrane {
                    let u = &self.displacement;
                    let values = ElementValues::new(&u[a], &u[a + 1]);
                    twice += samples.energy(samples.strains(span.measure, &values)) * 2.0;
                }
                element += 1;
            }
            m.energy += twice * 0.5;
            m.linear = add(m.linear, linear);
            m.angular += angular;
            m.linear_size += linear_size;
            m.angular_size += angular_size;
            m.angular_rate_drift += drift * 0.5;
        }
        if !self.springs.is_empty() {
            m.energy += self.spring_energy();
        }
        for (guide, state) in self.numbers.guides.iter().zip(&self.guides) {
            let momentum = guide.mass * state.velocity;
            let linear = array(|i| guide.direction[i] * momentum);
            m.energy += momentum * state.velocity * 0.5 + guide.energy(-state.gap);
            let way = state.way;
            let x: [S; 2] = array(|i| guide.position[i] + guide.direction[i] * way);
            m.linear = add(m.linear, linear);
            m.linear_size += hypot(linear);
            // Along its line of flight the way changes nothing.
            m.angular += cross(guide.position, linear);
            m.angular_size += (x[0].abs() + x[1].abs()) * (linear[0].abs() + linear[1].abs());
        }
        m
    }

    /// Displacement and velocity of a recorded point.
    #[inline(always)]
    pub fn point(&self, k: usize) -> [[S; 2]; 2] {
        let p = &self.numbers.points[k];
        [
            interpolate(&p.shape, p.node, &self.displacement),
            interpolate(&p.shape, p.node, &self.velocity),
        ]
    }
}
