//! Energies and momenta of a state.

use crate::element::beam::{ElementTable, ElementValues};
use crate::element::strain::strains;
use crate::ledger::Measures;
use crate::math::vec2::{add, cross, dot, scale};
use crate::model::frozen::{BodyKind, Span};
use crate::model::{Model, TouchLaw};
use crate::state::State;
use crate::step::fibres::energies;

impl Measures {
    /// Measures the state of a model; only the pairs that are `awake` can be pressed together.
    pub(crate) fn of(model: &Model, state: &State, awake: &[usize]) -> Self {
        let mut m = Self::default();
        for span in &model.spans {
            m.add_span(model, state, span);
        }
        m.add_masses(model, state);
        m.add_bodies(model, state);
        m.add_contacts(model, state, awake);
        for (c, q) in model.connectors.iter().zip(&state.coordinates) {
            m.springs += c.potential(*q);
        }
        m
    }

    fn add_span(&mut self, model: &Model, state: &State, span: &Span) {
        let stored = !state.strain.is_empty();
        let (mut linear, mut angular) = ([0.0; 2], 0.0);
        let (mut linear_size, mut angular_size) = (0.0, 0.0);
        let (mut translation, mut rotation, mut axial, mut bending) = (0.0, 0.0, 0.0, 0.0);
        for (k, e) in span.elements.clone().enumerate() {
            let (a, table) = (span.nodes.start + k, span.table(k));
            let u = ElementValues::new(&state.displacement[a], &state.displacement[a + 1]);
            let momentum = momentum(table, &state.velocity[a], &state.velocity[a + 1]);
            let [pa, pb] = &momentum;
            linear_size += (pa[0] + pb[0]).abs() + (pa[1] + pb[1]).abs();
            for (node, p) in [(a, &momentum[0]), (a + 1, &momentum[1])] {
                let (frame, u, v) =
                    (&model.nodes[node], &state.displacement[node], &state.velocity[node]);
                translation += p[0] * v[0] + p[1] * v[1] + p[2] * v[2] + p[3] * v[3];
                linear = add(linear, [p[0], p[1]]);
                let x = add(frame.position, [u[0], u[1]]);
                let slope = add(frame.tangent, [u[2], u[3]]);
                angular += cross(x, [p[0], p[1]]) + cross(slope, [p[2], p[3]]);
                angular_size += size(x) * size([p[0], p[1]]) + size(slope) * size([p[2], p[3]]);
            }
            if span.fibres.is_some() {
                let [stretching, others, hardening] = energies(state, span, k, &u);
                axial += 2.0 * stretching;
                bending += 2.0 * others;
                self.hardening += hardening;
            }
            for (j, row) in table.rows.iter().enumerate() {
                let (slope, bend) = (u.at(&row.first), add(row.bend, u.at(&row.second)));
                let s = strains(span.measure, row.tangent, row.curvature, slope, bend);
                let (mut eps, mut kappa) = (s.membrane, s.bending);
                if stored {
                    [eps, kappa] = state.strain[e][j];
                    self.curvature_drift = self.curvature_drift.max((kappa - s.bending).abs());
                    if table.membrane.is_none() {
                        self.membrane_drift = self.membrane_drift.max((eps - s.membrane).abs());
                    }
                }
                let spin = state.spin[e][j];
                rotation += row.weighed.rotary * spin * spin;
                if span.fibres.is_none() {
                    axial += row.weighed.axial * eps * eps;
                    bending += row.weighed.bending * kappa * kappa;
                }
                angular += row.weighed.rotary * spin;
                angular_size += (row.weighed.rotary * spin).abs();
            }
            if let (Some(samples), None) = (&table.membrane, &span.fibres) {
                let mut eps = samples.strains(span.measure, &u);
                if stored {
                    for (eps, stored) in eps.iter_mut().zip(&state.strain[e]) {
                        self.membrane_drift = self.membrane_drift.max((*eps - stored[0]).abs());
                        *eps = stored[0];
                    }
                }
                axial += 2.0 * samples.energy(eps);
            }
        }
        self.kinetic_beams += 0.5 * (translation + rotation);
        self.strain_axial += 0.5 * axial;
        self.strain_bending += 0.5 * bending;
        self.linear = add(self.linear, linear);
        self.angular += angular;
        self.linear_size += linear_size;
        self.angular_size += angular_size;
    }

    fn add_momentum(&mut self, x: [f64; 2], linear: [f64; 2], turning: f64) {
        self.linear = add(self.linear, linear);
        self.angular += cross(x, linear) + turning;
        self.linear_size += linear[0].hypot(linear[1]);
        self.angular_size += size(x) * size(linear) + turning.abs();
    }

    fn add_masses(&mut self, model: &Model, state: &State) {
        for (mass, spin) in model.masses.iter().zip(&state.mass_spin) {
            let p = &mass.point;
            let v = p.value(&state.velocity);
            let turning = mass.rotary_inertia * spin;
            self.kinetic_beams += 0.5 * (mass.mass * (v[0] * v[0] + v[1] * v[1]) + turning * spin);
            let linear = scale(mass.mass, v);
            let x = add(p.position, p.value(&state.displacement));
            self.add_momentum(x, linear, turning);
        }
    }

    fn add_bodies(&mut self, model: &Model, state: &State) {
        for (i, body) in model.bodies.iter().enumerate() {
            let node = model.body_node(i);
            let (u, v) = (&state.displacement[node], &state.velocity[node]);
            if let BodyKind::Rear { direction, stiffness, .. } = body.kind {
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
            let gap = state.pairs[i].gap;
            if let (true, TouchLaw::Smooth(law)) =
                (gap < 0.0, &model.contacts[model.pairs[i].contact].law)
            {
                self.contact += law.potential.energy(-gap);
            }
        }
    }
}

/// Sum of the components' magnitudes.
fn size(v: [f64; 2]) -> f64 {
    v[0].abs() + v[1].abs()
}

/// `M v` of an element, per node.
fn momentum(table: &ElementTable, a: &[f64; 4], b: &[f64; 4]) -> [[f64; 4]; 2] {
    let mut out = [[0.0; 4]; 2];
    for i in 0..2 {
        let v = [a[i], a[2 + i], b[i], b[2 + i]];
        let p = table.mass.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + row[3] * v[3]);
        out[0][i] = p[0];
        out[0][2 + i] = p[1];
        out[1][i] = p[2];
        out[1][2 + i] = p[3];
    }
    out
}
