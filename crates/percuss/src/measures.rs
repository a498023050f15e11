//! Energies and momenta of a state.

use crate::element::beam::ElementValues;
use crate::element::motion::ElementMeasures;
use crate::element::rotary::spin_of_slope;
use crate::element::strain::strains;
use crate::ledger::Measures;
use crate::math::vec2::{add, dot, scale};
use crate::model::Model;
use crate::model::frozen::{Behind, Span};
use crate::state::{PairState, State};
use crate::step::fibres::energies;
use crate::step::given_strains;
use crate::step::sweep::Sweep;

impl Measures {
    /// Measures the state of a model; only the pairs that are `awake` can be pressed together.
    pub(crate) fn of(model: &Model, state: &State, awake: &[usize], sweep: &mut Sweep) -> Self {
        let mut m = Self::default();
        // Stored strains are evaluated one by one.
        let swept = state.strain.is_empty();
        if swept {
            sweep.begin(model, state);
        }
        for (i, span) in model.spans.iter().enumerate() {
            let (sums, hardening) = match swept && sweep.has(i) {
                true => sweep.measure(model, i),
                false => m.span(model, state, span),
            };
            m.add_beams(&sums);
            m.hardening += hardening;
        }
        if state.is_strained() {
            let [axial, bending] =
                given_strains::energy(model, &state.displacement, &state.strained);
            m.strain_axial += axial;
            m.strain_bending += bending;
        }
        m.add_masses(model, state);
        m.add_bodies(model, state);
        m.add_contacts(model, state, awake);
        for (c, q) in model.connectors.iter().zip(&state.coordinates) {
            m.springs += c.potential(*q, &state.memories);
            m.hardening += c.hardening_energy(&state.memories);
        }
        m
    }

    /// Sums over a span, element by element, and the energy stored in hardening \[J\].
    fn span(&mut self, model: &Model, state: &State, span: &Span) -> (ElementMeasures<f64>, f64) {
        let stored = !state.strain.is_empty();
        let (mut sums, mut hardening) = (ElementMeasures::zero(0.0), 0.0);
        for (k, e) in span.elements.clone().enumerate() {
            let (a, table) = (span.nodes.start + k, span.table(k));
            let place = |n: usize| {
                let (frame, u) = (&model.nodes[n], &state.displacement[n]);
                let (x, g) = (frame.position, frame.tangent);
                [x[0] + u[0], x[1] + u[1], g[0] + u[2], g[1] + u[3]]
            };
            let velocity = [state.velocity[a], state.velocity[a + 1]];
            let mut own = ElementMeasures::of_motion(
                table,
                &[place(a), place(a + 1)],
                &velocity,
                &state.spin[e],
            );
            if state.has_parted(a) {
                // Its sections no longer rotate.
                own.rate_drift = 0.0;
            }
            let u = ElementValues::new(&state.displacement[a], &state.displacement[a + 1]);
            if let Some(fibres) = &span.fibres {
                let stored = energies(state, (span, fibres), k, &u);
                own.add_fibres(&stored);
                hardening += stored.hardening;
            }
            for (j, row) in table.rows.iter().enumerate() {
                let (slope, bend) = (u.at(&row.first), u.at(&row.second));
                let s = strains(span.measure, &row.reference, slope, bend);
                let (mut eps, mut kappa) = (s.membrane, s.bending);
                if stored {
                    [eps, kappa] = state.strain[e][j];
                    self.curvature_drift = self.curvature_drift.max((kappa - s.bending).abs());
                    if table.membrane.is_none() {
                        self.membrane_drift = self.membrane_drift.max((eps - s.membrane).abs());
                    }
                }
                if span.fibres.is_none() {
                    own.axial += row.weighed.axial * eps * eps;
                    own.bending += row.weighed.bending * kappa * kappa;
                }
            }
            if let Some(shear) = span.shear_at(k).filter(|_| !state.has_parted(a)) {
                let [axial, sheared, bent] = shear.energies(&u);
                own.bending += sheared;
                if span.fibres.is_none() {
                    own.axial += axial;
                    own.bending += bent;
                }
                self.strain_shear += 0.5 * sheared * shear.shear_share();
            }
            if let (Some(samples), None) = (&table.membrane, &span.fibres) {
                let mut eps = samples.strains(span.measure, &u);
                if stored {
                    for (eps, stored) in eps.iter_mut().zip(&state.strain[e]) {
                        self.membrane_drift = self.membrane_drift.max((*eps - stored[0]).abs());
                        *eps = stored[0];
                    }
                }
                own.axial += 2.0 * samples.energy(eps);
            }
            sums.add(&own);
        }
        (sums, hardening)
    }

    fn add_masses(&mut self, model: &Model, state: &State) {
        for (mass, spin) in model.masses.iter().zip(&state.mass_spin) {
            let p = &mass.point;
            let v = p.value(&state.velocity);
            let turning = mass.rotary_inertia * spin;
            self.kinetic_beams += 0.5 * (mass.mass * (v[0] * v[0] + v[1] * v[1]) + turning * spin);
            let of_slope = spin_of_slope(
                add(p.tangent, p.gradient(&state.displacement)),
                p.gradient(&state.velocity),
            );
            let drift = (of_slope - spin) * (of_slope + spin);
            self.angular_rate_drift += 0.5 * mass.rotary_inertia * drift;
            let linear = scale(mass.mass, v);
            let x = add(p.position, p.value(&state.displacement));
            self.add_momentum(x, linear, turning);
        }
    }

    fn add_bodies(&mut self, model: &Model, state: &State) {
        for (i, body) in model.bodies.iter().enumerate() {
            let node = model.body_node(i);
            let (u, v) = (&state.displacement[node], &state.velocity[node]);
            if let Some(Behind { direction, stiffness, .. }) = body.kind.behind() {
                let front = &state.displacement[node - 1];
                let pressed = dot(direction, [u[0] - front[0], u[1] - front[1]]);
                self.springs += 0.5 * stiffness * pressed * pressed;
            }
            if body.mass == 0.0 {
                continue;
            }
            let turning = body.inertia * v[2];
            self.kinetic_projectiles +=
                0.5 * (body.mass * (v[0] * v[0] + v[1] * v[1]) + turning * v[2]);
            let linear = scale(body.mass, [v[0], v[1]]);
            let x = add(model.nodes[node].position, [u[0], u[1]]);
            self.add_momentum(x, linear, turning);
        }
    }

    fn add_contacts(&mut self, model: &Model, state: &State, awake: &[usize]) {
        for &i in awake {
            let PairState { gap, deepest, .. } = state.pairs[i];
            if let (true, Some(law)) =
                (gap < 0.0, model.contacts[model.pairs[i].contact].law.smooth())
            {
                self.contact += law.stored(-gap, deepest);
            }
        }
    }
}
