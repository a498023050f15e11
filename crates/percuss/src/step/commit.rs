//! Accepts a solved step: the only writer of [`State`].

use super::connectors;
use super::fibres::{self, PartedElement};
use super::flows::enter;
use super::forcing::{Forcing, WIDTH};
use super::given_strains;
use super::integration::{Integration, Rule};
use super::modal_damping::ModalDamping;
use super::workspace::Workspace;
use crate::element::beam::{ElementValues, step_point};
use crate::element::point::Strains;
use crate::element::rotary::{Turn, spin_of_slope};
use crate::element::strain_rate;
use crate::math::hermite::{self, GAUSS};
use crate::math::vec2::{add, cross, dot};
use crate::model::Model;
use crate::model::frozen::{BodyKind, Connector, Coordinate};
use crate::state::State;

/// Moves `state` to the end of the step solved in `work`, works and impulses into its ledger; returns the elements without fibres at its end, and
/// whether any fibre has yielded.
pub fn commit(
    model: &Model,
    state: &mut State,
    integration: Integration,
    forcing: &Forcing,
    damping: &ModalDamping,
    work: &Workspace,
) -> (Vec<PartedElement>, bool) {
    let h = integration.h;
    // Entered with the other flows, below.
    let (increment, sweep) = (&work.increment, &work.beams.sweep);
    let (mut losses, parted) = fibres::advance(model, state, &integration, increment, sweep);
    let moved = (forcing, &work.increment[..]);
    let memories = connectors::advanced(model, state, &integration, moved, &mut losses);
    enter(model, state, &integration, (forcing, damping, &losses), work);
    state.memories = memories;
    advance_histories(model, state, &integration, work);
    advance_masses(model, state, &integration, work);
    let State { displacement, spin, mass_spin, .. } = &mut *state;
    work.lead.add_spins(model, displacement, &work.increment, spin, mass_spin);
    let before = std::mem::take(&mut state.coordinates);
    advance_nodes(state, &integration, work);
    spin_of_vectors(model, state);
    state.coordinates = coordinates(model, state, forcing, &before, work);
    if matches!(integration.rule, Rule::Alpha(_)) {
        spin_from_velocity(model, state);
    }
    forcing.follow(&mut state.followed);
    state.multiplier.copy_from_slice(&work.multiplier);
    state.time += h;
    state.strained = given_strains::factors_at(model, state.time);
    (parted, losses.yielded)
}

/// Sets the velocities of obstacles to those of their motions, for any integration rule; steps have the size `step`.
pub fn steer_obstacles(model: &Model, state: &mut State, step: f64) {
    let (time, width) = (state.time, WIDTH * step);
    for dofs in model.prescribed.iter().rev() {
        let Some(body) = dofs.node.checked_sub(model.beam_node_count()) else { break };
        if model.bodies[body].kind != BodyKind::Obstacle {
            break;
        }
        if dofs.drives.iter().all(Vec::is_empty) {
            continue; // it does not move
        }
        let rate = |motion: usize| model.motions[motion].rate(time, width);
        let mut velocity = [0.0; 4];
        for (normal, drive) in dofs.normals.iter().zip(&dofs.drives) {
            let along: f64 = drive.iter().map(|(m, a)| a * rate(*m)).sum();
            (0..4).for_each(|k| velocity[k] += along * normal[k]);
        }
        state.velocity[dofs.node] = velocity;
    }
}

/// Coordinates of the connectors after a step: those of the configuration, with prescribed motions summed up.
fn coordinates(
    model: &Model,
    state: &State,
    forcing: &Forcing,
    before: &[f64],
    work: &Workspace,
) -> Vec<f64> {
    let end = |(i, c): (usize, &Connector)| match &c.coordinate {
        _ if !forcing.connected[i] => c.law.free(),
        Coordinate::Displacement { point, direction, drive } if !drive.is_empty() => {
            before[i] + dot(*direction, point.value(&work.increment)) - forcing.increment(drive)
        }
        _ => c.value(&state.displacement, before[i]),
    };
    model.connectors.iter().enumerate().map(end).collect()
}

/// Angular rates of point masses.
fn advance_masses(model: &Model, state: &mut State, rule: &Integration, work: &Workspace) {
    for (i, mass) in model.masses.iter().enumerate() {
        let p = &mass.point;
        let g0 = add(p.tangent, p.gradient(&state.displacement));
        let turn = Turn::new(g0, p.gradient(&work.increment));
        state.mass_spin[i] = turn.end_spin(rule.h.recip(), state.mass_spin[i]);
    }
}

fn advance_histories(model: &Model, state: &mut State, rule: &Integration, work: &Workspace) {
    if matches!(rule.rule, Rule::Alpha(_)) {
        return;
    }
    if rule.sweeps() {
        for (_, _, a, element) in model.each_element() {
            // Sections of fractured elements no longer rotate.
            if !state.has_parted(a) {
                state.spin[element] = work.beams.sweep.end_spin(element);
            }
        }
        return;
    }
    for (span, k, a, element) in model.each_element() {
        let table = span.table(k);
        let u = &state.displacement;
        let old = ElementValues::new(&u[a], &u[a + 1]);
        let step = ElementValues::new(&work.increment[a], &work.increment[a + 1]);
        for j in 0..GAUSS {
            let point = step_point(&table.rows[j], &old, &step);
            let g0 = add(point.reference.tangent, point.slope_0);
            let spin = &mut state.spin[element][j];
            *spin = Turn::new(g0, point.d_slope).end_spin(rule.h.recip(), *spin);
            if let Some(stored) = state.strain.get_mut(element) {
                let [membrane, bending] = stored[j];
                let old = Strains { membrane, bending };
                let new = strain_rate::advance(&table.rows[j].weighed, &point, old);
                // Slender elements store membrane strains elsewhere; see below.
                let slender = table.membrane.is_some();
                stored[j] = [if slender { membrane } else { new.membrane }, new.bending];
            }
        }
        if let (Some(samples), Some(stored)) = (&table.membrane, state.strain.get_mut(element)) {
            // Stored are the membrane strains at the sampling points.
            for (sample, stored) in samples.step(&old, &step).iter().zip(stored) {
                stored[0] += sample.midpoint_change(span.measure);
            }
        }
    }
}

fn advance_nodes(state: &mut State, rule: &Integration, work: &Workspace) {
    let State { displacement, velocity, acceleration, .. } = &mut *state;
    rule.advance_all(&work.increment, displacement, velocity, acceleration);
    for (v, lead) in state.velocity.iter_mut().zip(&work.lead.velocity) {
        (0..4).for_each(|i| v[i] += lead[i]);
    }
    if matches!(rule.rule, Rule::Alpha(_)) {
        for (a, lead) in state.acceleration.iter_mut().zip(&work.lead.acceleration) {
            (0..4).for_each(|i| a[i] += lead[i]);
        }
    }
}

/// Angular rates in shear-flexible elements, between those of the vectors of their nodes, `d x d_dot`.
fn spin_of_vectors(model: &Model, state: &mut State) {
    let State { displacement, velocity, spin, .. } = state;
    for span in model.spans.iter().filter(|span| span.shear.is_some()) {
        let rate = |n: usize| {
            let ([d1, d2], u, v) = (model.nodes[n].tangent, &displacement[n], &velocity[n]);
            cross([d1 + u[2], d2 + u[3]], [v[2], v[3]])
        };
        for (k, element) in span.elements.clone().enumerate() {
            let (a, b) = (rate(span.nodes.start + k), rate(span.nodes.start + k + 1));
            spin[element] = hermite::gauss_points().map(|xi| a + xi * (b - a));
        }
    }
}

/// Angular rates `(g x g_dot) / a` of the configuration and its velocity.
pub fn spin_from_velocity(model: &Model, state: &mut State) {
    for (span, k, a, element) in model.each_element() {
        for (j, row) in span.table(k).rows.iter().enumerate() {
            let at =
                |nodal: &[[f64; 4]]| ElementValues::new(&nodal[a], &nodal[a + 1]).at(&row.first);
            let g = add(row.reference.tangent, at(&state.displacement));
            state.spin[element][j] = spin_of_slope(g, at(&state.velocity));
        }
    }
    spin_of_vectors(model, state);
    for (i, mass) in model.masses.iter().enumerate() {
        let p = &mass.point;
        let g = add(p.tangent, p.gradient(&state.displacement));
        state.mass_spin[i] = spin_of_slope(g, p.gradient(&state.velocity));
    }
}
