//! Accepts a solved step: the only writer of [`State`].

use super::external;
use super::integration::{Integration, Rule};
use super::newton::StepProblem;
use super::workspace::Workspace;
use crate::element::beam::{ElementValues, step_point};
use crate::element::point::Strains;
use crate::element::{rotary, strain_rate};
use crate::math::hermite::GAUSS;
use crate::math::vec2::{add, cross, dot, scale};
use crate::model::Model;
use crate::model::frozen::{Constraint, ContactLaw};
use crate::state::State;

/// Moves `state` to the end of the step solved in `work`, works and impulses into its books.
pub fn commit(
    model: &Model,
    state: &mut State,
    integration: Integration,
    gravity: [f64; 2],
    work: &Workspace,
) {
    let h = integration.h;
    book_loads(model, state, &integration, gravity, work);
    book_supports(model, state, h, work);
    book_contacts(model, state, h, gravity, work);
    advance_histories(model, state, &integration, work);
    advance_nodes(state, &integration, work);
    if matches!(integration.rule, Rule::Alpha(_)) {
        spin_from_velocity(model, state);
    }
    advance_projectiles(model, state, &integration, gravity, work);
    state.multiplier.copy_from_slice(&work.multiplier);
    state.time += h;
}

impl StepProblem<'_> {
    /// Gap rate of projectile `i` at the end of the solved step \[m/s\].
    pub fn gap_rate_next(&self, work: &Workspace, i: usize) -> f64 {
        let p = &self.model.projectiles[i];
        let d = p.point.value(&work.increment);
        let v = p.point.value(&self.state.velocity);
        let h = self.integration.h;
        let beam: f64 = (0..2).map(|k| p.direction[k] * (2.0 * d[k] / h - v[k])).sum();
        let gravity = h * dot(self.gravity, p.direction);
        beam - (self.state.projectiles[i].speed + gravity - work.impulse[i] / p.mass)
    }

    /// Gap of projectile `i` at the end of the solved step \[m\].
    pub fn gap_next(&self, work: &Workspace, i: usize) -> f64 {
        let p = &self.model.projectiles[i];
        let moved = dot(p.direction, p.point.value(&work.increment));
        self.state.gap(self.model, i) + moved - work.travel[i]
    }
}

fn book_loads(
    model: &Model,
    state: &mut State,
    rule: &Integration,
    gravity: [f64; 2],
    work: &Workspace,
) {
    let done =
        external::work(model, state, rule.h, rule.theta(), gravity, &work.increment, &work.travel);
    let books = &mut state.books;
    books.work_loads += done.work;
    books.impulse_loads = add(books.impulse_loads, done.impulse);
    books.angular_impulse_loads += done.angular_impulse;
}

/// Reactions are what the residual leaves at held components, and the multipliers of supports between nodes.
fn book_supports(model: &Model, state: &mut State, h: f64, work: &Workspace) {
    let State { books, displacement, .. } = state;
    for hold in &model.holds {
        let (n, r) = (hold.node, &work.residual[hold.node]);
        let (u, d) = (&displacement[n], &work.increment[n]);
        let mut reaction = [0.0; 4];
        for normal in &hold.normals {
            let along: f64 = (0..4).map(|k| normal[k] * r[k]).sum();
            (0..4).for_each(|k| reaction[k] += along * normal[k]);
        }
        let (force, couple) = ([reaction[0], reaction[1]], [reaction[2], reaction[3]]);
        let x = [0, 1].map(|i| model.nodes[n][i] + u[i] + 0.5 * d[i]);
        let t = model.tangent_at_node(n);
        let g = [0, 1].map(|i| t[i] + u[2 + i] + 0.5 * d[2 + i]);
        books.work_supports += (0..4).map(|k| reaction[k] * d[k]).sum::<f64>();
        books.impulse_supports = add(books.impulse_supports, scale(h, force));
        books.angular_impulse_supports += h * (cross(x, force) + cross(g, couple));
    }
    for (c, multiplier) in model.constraints.iter().zip(&work.multiplier) {
        let Constraint::Held { point, direction, gradient } = c else { continue };
        let force = scale(-multiplier, *direction);
        let mid = |a: [f64; 2], d: [f64; 2]| add(a, scale(0.5, d));
        if *gradient {
            let moved = mid(point.gradient(displacement), point.gradient(&work.increment));
            books.angular_impulse_supports += h * cross(add(point.tangent, moved), force);
        } else {
            let moved = mid(point.value(displacement), point.value(&work.increment));
            books.impulse_supports = add(books.impulse_supports, scale(h, force));
            books.angular_impulse_supports += h * cross(add(point.position, moved), force);
        }
    }
}

/// Loss of impacts, and the couple by which a projectile's guide answers a contact point off its line of flight.
fn book_contacts(model: &Model, state: &mut State, h: f64, gravity: [f64; 2], work: &Workspace) {
    for (i, p) in model.projectiles.iter().enumerate() {
        let impulse = match p.law {
            ContactLaw::Spring { .. } => h * work.force[i],
            ContactLaw::Unilateral { .. } => work.impulse[i],
        };
        if impulse == 0.0 {
            continue;
        }
        let d = p.point.value(&work.increment);
        let moved = add(p.point.value(&state.displacement), scale(0.5, d));
        let arm = add(add(p.point.position, moved), scale(-1.0, p.position));
        state.books.angular_impulse_supports += impulse * cross(arm, p.direction);
        if matches!(p.law, ContactLaw::Unilateral { .. }) {
            // Work of the impulse: L (z0 + z1)/2, the mean gap rate over the step.
            let speed = state.projectiles[i].speed + 0.5 * h * dot(gravity, p.direction)
                - 0.5 * impulse / p.mass;
            let mean_rate = dot(p.direction, d) / h - speed;
            state.books.loss_impacts -= impulse * mean_rate;
        }
    }
}

fn advance_histories(model: &Model, state: &mut State, rule: &Integration, work: &Workspace) {
    if matches!(rule.rule, Rule::Alpha(_)) {
        return;
    }
    for beam in &model.beams {
        for (k, element) in beam.elements.clone().enumerate() {
            let a = beam.nodes.start + k;
            let u = &state.displacement;
            let old = ElementValues::new(&u[a], &u[a + 1]);
            let step = ElementValues::new(&work.increment[a], &work.increment[a + 1]);
            for j in 0..GAUSS {
                let point = step_point(&beam.table, &beam.table.rows[j], &old, &step);
                let g0 = add(point.tangent, point.slope_0);
                let mean = rotary::mean_spin(g0, point.d_slope, rule.h);
                let spin = &mut state.spin[element][j];
                *spin = 2.0 * mean - *spin;
                if let Some(stored) = state.strain.get_mut(element) {
                    let [membrane, bending] = stored[j];
                    let old = Strains { membrane, bending };
                    let new = strain_rate::advance(&beam.law, &point, old);
                    stored[j] = [new.membrane, new.bending];
                }
            }
        }
    }
}

fn advance_nodes(state: &mut State, rule: &Integration, work: &Workspace) {
    for (n, d) in work.increment.iter().enumerate() {
        let a0 = state.acceleration.get(n).copied().unwrap_or([0.0; 4]);
        for i in 0..4 {
            let v0 = state.velocity[n][i];
            state.displacement[n][i] += d[i];
            state.velocity[n][i] = rule.velocity(d[i], v0, a0[i]);
            if let Some(a) = state.acceleration.get_mut(n) {
                a[i] = rule.acceleration(d[i], v0, a0[i]);
            }
        }
    }
}

/// Angular rates `(g x g_dot) / a` of the configuration and its velocity.
pub fn spin_from_velocity(model: &Model, state: &mut State) {
    for beam in &model.beams {
        for (k, element) in beam.elements.clone().enumerate() {
            let a = beam.nodes.start + k;
            let at = |nodal: &[[f64; 4]], j: usize| {
                ElementValues::new(&nodal[a], &nodal[a + 1]).at(&beam.table.rows[j].first)
            };
            for j in 0..GAUSS {
                let g = add(beam.table.tangent, at(&state.displacement, j));
                let rate = at(&state.velocity, j);
                state.spin[element][j] = cross(g, rate) / dot(g, g);
            }
        }
    }
}

fn advance_projectiles(
    model: &Model,
    state: &mut State,
    rule: &Integration,
    gravity: [f64; 2],
    work: &Workspace,
) {
    for (i, p) in model.projectiles.iter().enumerate() {
        let s = &mut state.projectiles[i];
        let d = work.travel[i];
        match p.law {
            ContactLaw::Spring { .. } => {
                let (v0, a0) = (s.speed, s.acceleration);
                s.speed = rule.velocity(d, v0, a0);
                s.acceleration = rule.acceleration(d, v0, a0);
            }
            ContactLaw::Unilateral { .. } => {
                s.speed += rule.h * dot(gravity, p.direction) - work.impulse[i] / p.mass;
            }
        }
        s.travel += d;
    }
}
