//! Prescribed velocities: fixed components have the velocity of their motion.
//!
//! A scheme computes the velocity at the end of a step from the increment and the velocity at its start. For fixed components, all three are
//! prescribed and agree to second order only; with the velocity of the scheme, the difference would alternate from step to step without decay.
//! Therefore the end of a step has the prescribed velocity (and acceleration), and its lead over that of the scheme enters the inertia of its
//! neighbours: masses have the increment `d + h c/2` with the lead c. Work and angular momentum of the difference belong to the support, and enter
//! the ledger as such.

mod middle;

use super::constraint::ConstraintStep;
use super::end_forces::EndForces;
use super::forcing::Forcing;
use super::integration::{Integration, Rule};
use crate::math::vec2::{add, cross, dot, scale};
use crate::model::Model;
use crate::model::frozen::{ConstraintKind, MaterialPoint};
use crate::state::State;
use middle::{Middle, times_mass};

/// Lead of prescribed velocities and accelerations at the end of a step over those of the scheme.
#[derive(Clone, Debug)]
pub struct Lead {
    /// Nodes that can lead, shape (such nodes) \[index of a node\].
    nodes: Vec<usize>,
    /// First nodes of the elements next to them, shape (such elements) \[index of a node\].
    elements: Vec<usize>,
    /// Whether no element connects a node to the next one, from the state, shape (beam nodes), or empty \[-\].
    parted: Vec<bool>,
    /// Lead in velocity, shape (nodes, 4), empty without prescribed motions \[m/s, 1/s\].
    pub velocity: Vec<[f64; 4]>,
    /// Lead in acceleration, likewise, shape (nodes, 4) \[m/s^2, 1/s^2\].
    pub acceleration: Vec<[f64; 4]>,
}

/// Contribution of the lead to the ledger of a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct LeadWork {
    /// Work of the supports beyond reaction times increment \[J\].
    pub work: f64,
    /// Their angular impulse about the origin beyond that of the reactions \[N m s\].
    pub angular_impulse: f64,
}

/// A prescribed value over a step.
#[derive(Clone, Copy)]
struct PrescribedStep {
    increment: f64,
    /// Velocity and acceleration at the start, as the scheme has them, shape (2) \[unit of the value by s, by s^2\].
    start: [f64; 2],
    /// Velocity at the end, as prescribed.
    rate: f64,
    /// Acceleration at the start and at the end, as prescribed, shape (2) \[unit of the value by s^2\].
    second_rates: [f64; 2],
}

impl PrescribedStep {
    /// Lead in velocity and acceleration.
    ///
    /// The accelerations of generalized-alpha lag behind those of the motion (Arnold, Bruels 2007): weighted by its `alpha_m` they are the true
    /// ones weighted by its `alpha_f`, and so the inertia of fixed components is that of their motion.
    fn lead(&self, rule: &Integration) -> [f64; 2] {
        let (d, [v0, a0], [b0, b1]) = (self.increment, self.start, self.second_rates);
        let a1 = match rule.rule {
            Rule::Alpha(w) if w.alpha_m < 1.0 => {
                ((1.0 - w.alpha_f) * b1 + w.alpha_f * b0 - w.alpha_m * a0) / (1.0 - w.alpha_m)
            }
            _ => b1,
        };
        [self.rate - rule.velocity(d, v0, a0), a1 - rule.acceleration(d, v0, a0)]
    }
}

impl Lead {
    /// None yet.
    pub fn new(model: &Model) -> Self {
        let beams = model.beam_node_count();
        let driven = |drives: &[Vec<(usize, f64)>]| drives.iter().any(|d| !d.is_empty());
        let holds = model.prescribed.iter().filter(|h| h.node < beams && driven(&h.drives));
        let mut nodes: Vec<usize> = holds.map(|h| h.node).collect();
        for c in model.constraints.iter().filter(|c| !c.drive.is_empty()) {
            nodes.extend(super::constraint::nodes(c));
        }
        nodes.sort_unstable();
        nodes.dedup();
        let mut elements: Vec<usize> =
            nodes.iter().flat_map(|n| n.saturating_sub(1)..=*n).collect();
        elements.dedup();
        elements.retain(|a| model.spans.iter().any(|s| s.nodes.contains(a) && a + 1 < s.nodes.end));
        let count = if nodes.is_empty() { 0 } else { model.node_count() };
        let none = vec![[0.0; 4]; count];
        let parted = Vec::new();
        Self { nodes, elements, parted, velocity: none.clone(), acceleration: none }
    }

    /// Whether there are no prescribed motions.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Computes the lead in a step from `state`.
    pub fn set(&mut self, model: &Model, state: &State, rule: &Integration, forcing: &Forcing) {
        for n in &self.nodes {
            (self.velocity[*n], self.acceleration[*n]) = ([0.0; 4], [0.0; 4]);
        }
        if self.is_empty() || rule.rule == Rule::Static {
            return;
        }
        self.parted.clone_from(&state.parted);
        let beams = model.beam_node_count();
        for dofs in model.prescribed.iter().filter(|h| h.node < beams) {
            if dofs.drives.iter().all(Vec::is_empty) {
                continue;
            }
            let n = dofs.node;
            for (normal, drive) in dofs.normals.iter().zip(&dofs.drives) {
                let on = |x: &[f64; 4]| (0..4).map(|k| normal[k] * x[k]).sum::<f64>();
                let prescribed = PrescribedStep {
                    increment: forcing.increment(drive),
                    start: [on(&state.velocity[n]), state.acceleration.get(n).map_or(0.0, on)],
                    rate: forcing.rate(drive),
                    second_rates: forcing.second_rates(drive),
                };
                let [v, a] = prescribed.lead(rule);
                for k in 0..4 {
                    self.velocity[n][k] += v * normal[k];
                    self.acceleration[n][k] += a * normal[k];
                }
            }
        }
        self.set_constraints(model, state, rule, forcing);
    }

    /// Lead at supports with multipliers.
    fn set_constraints(
        &mut self,
        model: &Model,
        state: &State,
        rule: &Integration,
        forcing: &Forcing,
    ) {
        let step = ConstraintStep::at_rest(&state.displacement, forcing);
        for (c, acts) in model.constraints.iter().zip(&forcing.constrained) {
            if !acts || c.drive.is_empty() {
                continue;
            }
            let (turn, rate, second_rates) = (
                forcing.increment(&c.drive),
                forcing.rate(&c.drive),
                forcing.second_rates(&c.drive),
            );
            let none: &[[f64; 4]] = &[];
            let accelerations =
                if state.acceleration.is_empty() { none } else { &state.acceleration };
            match &c.kind {
                ConstraintKind::Held { point, direction, gradient: false } => {
                    let on = |x: &[[f64; 4]]| {
                        if x.is_empty() { 0.0 } else { dot(*direction, point.value(x)) }
                    };
                    let start = [on(&state.velocity), on(accelerations)];
                    let held = PrescribedStep { increment: turn, start, rate, second_rates };
                    let weights = [point.shape[0], point.shape[2]];
                    self.add(point.node, 0, weights, *direction, held.lead(rule));
                }
                ConstraintKind::Turned { point } => {
                    // g = stretch t: with the angle, its component across the tangent at the end is prescribed but for the stretch.
                    let (t0, across) = step.turned(c, point);
                    let stretch = dot(t0, add(point.tangent, point.gradient(&state.displacement)));
                    let stretching = dot(t0, point.gradient(&state.velocity));
                    let at_end = stretch + rule.h * stretching;
                    let on = |x: &[[f64; 4]]| {
                        if x.is_empty() { 0.0 } else { dot(across, point.gradient(x)) }
                    };
                    let start = [on(&state.velocity), on(accelerations)];
                    let [before, after] = second_rates;
                    let held = PrescribedStep {
                        increment: stretch * turn.sin(),
                        start,
                        rate: at_end * rate,
                        second_rates: [
                            stretch * before + 2.0 * stretching * start[0] / stretch,
                            at_end * after + 2.0 * stretching * rate,
                        ],
                    };
                    let weights = [point.slope[1], point.slope[3]];
                    self.add(point.node, 2, weights, across, held.lead(rule));
                }
                _ => {}
            }
        }
    }

    /// Adds a lead along a direction to the displacements or slopes at the two nodes of a point, so that the point has it.
    fn add(
        &mut self,
        node: usize,
        first: usize,
        weights: [f64; 2],
        along: [f64; 2],
        lead: [f64; 2],
    ) {
        let size: f64 = weights.iter().map(|w| w * w).sum();
        for (k, w) in weights.iter().enumerate().filter(|(_, w)| **w != 0.0) {
            for i in 0..2 {
                self.velocity[node + k][first + i] += lead[0] * w / size * along[i];
                self.acceleration[node + k][first + i] += lead[1] * w / size * along[i];
            }
        }
    }

    /// Adds the inertia of the lead to the residual and, of the elements, to the forces on their ends. How it depends on the increment,
    /// at third order in the step, the tangent leaves out.
    pub fn add_inertia(
        &self,
        model: &Model,
        start: &[[f64; 4]],
        increment: &[[f64; 4]],
        rule: &Integration,
        sums: (&mut [[f64; 4]], &mut EndForces),
    ) {
        let (residual, ends) = sums;
        if self.is_empty() {
            return;
        }
        let (field, factor) = match rule.rule {
            Rule::Midpoint(_) => (&self.velocity, rule.h.recip()),
            Rule::Alpha(w) => (&self.acceleration, 1.0 - w.alpha_m),
            Rule::Static => return,
        };
        let theta = rule.theta();
        let at = Middle { model, start, increment, share: theta, parted: &self.parted };
        for a in &self.elements {
            at.add_element_inertia(*a, field, factor, residual, ends);
        }
        for n in &self.nodes {
            ends.add_inertia(model, *n, &field[*n].map(|x| factor * x));
        }
        for (i, mass) in model.masses.iter().enumerate() {
            let p = &mass.point;
            p.spread(scale(factor * mass.mass, p.value(field)), residual);
            let (g, turning) = at.mass_turning(i, field);
            let moment = factor * mass.rotary_inertia * turning;
            p.spread_gradient(scale(moment / dot(g, g), [-g[1], g[0]]), residual);
        }
    }

    /// Adds the rotation by the lead to the spins at the end of the step.
    pub fn add_spins(
        &self,
        model: &Model,
        start: &[[f64; 4]],
        increment: &[[f64; 4]],
        spin: &mut [[f64; 3]],
        mass_spin: &mut [f64],
    ) {
        if self.is_empty() {
            return;
        }
        let at = Middle { model, start, increment, share: 0.5, parted: &self.parted };
        for a in &self.elements {
            let (span, k) = model.element_of(*a);
            for (j, own) in spin[span.elements.start + k].iter_mut().enumerate() {
                *own += at.turning(*a, j, &self.velocity);
            }
        }
        for (i, own) in mass_spin.iter_mut().enumerate() {
            *own += at.mass_turning(i, &self.velocity).1;
        }
    }

    /// Work and angular impulse of the supports on account of the lead, in a step of the midpoint rule that starts at `state`.
    pub fn work(
        &self,
        model: &Model,
        state: &State,
        increment: &[[f64; 4]],
        rule: &Integration,
    ) -> LeadWork {
        let mut sum = LeadWork::default();
        if self.is_empty() || !matches!(rule.rule, Rule::Midpoint(_)) {
            return sum;
        }
        let (start, parted) = (&state.displacement[..], &self.parted[..]);
        let at = Middle { model, start, increment, share: 0.5, parted };
        let gain = |n: usize| -> [f64; 4] {
            let (v, c) = (&state.velocity[n], &self.velocity[n]);
            std::array::from_fn(|i| rule.velocity(increment[n][i], v[i], 0.0) + c[i] - v[i])
        };
        let mean = |n: usize, gain: &[f64; 4]| -> [f64; 4] {
            std::array::from_fn(|i| state.velocity[n][i] + 0.5 * gain[i])
        };
        for &a in &self.elements {
            let (table, e) = at.element(a);
            let (ga, gb) = (gain(a), gain(a + 1));
            let force = times_mass(table, &ga, &gb);
            let momentum = times_mass(table, &mean(a, &ga), &mean(a + 1, &gb));
            for k in 0..2 {
                let (c, f, p) = (&self.velocity[a + k], &force[k], &momentum[k]);
                sum.work += 0.5 * (0..4).map(|i| c[i] * f[i]).sum::<f64>();
                let arms = cross([c[0], c[1]], [p[0], p[1]]) + cross([c[2], c[3]], [p[2], p[3]]);
                sum.angular_impulse -= 0.5 * rule.h * arms;
            }
            for (j, row) in table.rows.iter().enumerate() {
                let turning = at.turning(a, j, &self.velocity);
                let turned = at.turning(a, j, increment) / rule.h;
                let spun = 2.0 * (turned - state.spin[e][j]) + turning;
                sum.work += 0.5 * turning * row.weighed.rotary * spun;
            }
        }
        for (i, mass) in model.masses.iter().enumerate() {
            let p: &MaterialPoint = &mass.point;
            let (c, v, d) = (p.value(&self.velocity), p.value(&state.velocity), p.value(increment));
            let gain = [0, 1].map(|i| rule.velocity(d[i], v[i], 0.0) + c[i] - v[i]);
            sum.work += 0.5 * mass.mass * dot(c, gain);
            let momentum = scale(mass.mass, add(v, scale(0.5, gain)));
            sum.angular_impulse -= 0.5 * rule.h * cross(c, momentum);
            let turning = at.mass_turning(i, &self.velocity).1;
            let turned = at.mass_turning(i, increment).1 / rule.h;
            let spun = 2.0 * (turned - state.mass_spin[i]) + turning;
            sum.work += 0.5 * turning * mass.rotary_inertia * spun;
        }
        sum
    }
}

/// Inertia of the prescribed accelerations `field` of a configuration, added to nodal forces.
pub fn add_inertia_of(model: &Model, u: &[[f64; 4]], field: &[[f64; 4]], nodal: &mut [[f64; 4]]) {
    let mut lead = Lead::new(model);
    if lead.is_empty() {
        return;
    }
    lead.velocity.copy_from_slice(field);
    let rule = Integration::new(crate::settings::Scheme::Midpoint, 1.0);
    let ends = &mut EndForces::default();
    lead.add_inertia(model, u, &vec![[0.0; 4]; u.len()], &rule, (nodal, ends));
}
