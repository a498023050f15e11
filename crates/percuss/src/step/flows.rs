//! Flows of a solved step: energy and momentum of loads, supports, damping and impacts.

mod reactions;

use super::bodies::rear_spring;
use super::constraint::ConstraintStep;
use super::damping::{MassDamping, viscous};
use super::external;
use super::forcing::Forcing;
use super::given_strains;
use super::integration::{Integration, Rule};
use super::modal_damping::ModalDamping;
use super::workspace::Workspace;
use crate::element::beam::{ElementValues, step_point};
use crate::element::fibre::FibreLosses;
use crate::element::point::Strains;
use crate::element::strain::strains;
use crate::element::strain_rate;
use crate::geometry::row::Row;
use crate::ledger::StepWork;
use crate::math::vec2::{add, cross, scale};
use crate::model::Model;
use crate::model::frozen::{ConnectorEnd, Coordinate, MaterialPoint, Span};
use crate::scalar::array;
use crate::settings::Scheme;
use crate::state::{Instant, State};
use reactions::{average_reactions, instant, supports_so_far};

/// Enters the step from `state` that is solved in `work`.
pub fn enter(
    model: &Model,
    state: &mut State,
    rule: &Integration,
    (forcing, damping, losses): (&Forcing, &ModalDamping, &FibreLosses),
    work: &Workspace,
) {
    let mut done = external::work(model, state, rule.h, 0.5, forcing, &work.increment);
    done.work += given_strains::work(model, state, rule, forcing, &work.increment);
    state.reacting.begin();
    let so_far = state.ledger.set_aside();
    let before = supports_so_far(state);
    state.ledger.load(&done);
    let led = work.lead.work(model, state, &work.increment, rule);
    let ledger = &mut state.ledger;
    ledger.work_supports += led.work;
    ledger.angular_impulse_supports += led.angular_impulse;
    let mut entry = Entry { model, state, rule, forcing, work };
    entry.prescribed();
    entry.constraints();
    entry.connectors();
    entry.spans();
    entry.modes(damping);
    let ledger = &mut entry.state.ledger;
    ledger.loss_damping += losses.viscous;
    ledger.loss_plastic += losses.plastic;
    ledger.loss_failure += losses.failure;
    entry.rear_masses();
    entry.contacts();
    if let Rule::Alpha(_) = rule.rule {
        average_reactions(state, rule, before);
    } else {
        state.instant = None;
    }
    state.ledger.put_on(so_far);
}

/// Reactions at the start of a step, whose residual is in `work`; those of multipliers are the step's.
pub fn reactions_at_start(
    model: &Model,
    state: &State,
    rule: &Integration,
    forcing: &Forcing,
    work: &Workspace,
) -> Instant {
    let mut scratch = state.clone();
    scratch.reacting.begin();
    let before = supports_so_far(&scratch);
    let mut entry = Entry { model, state: &mut scratch, rule, forcing, work };
    entry.prescribed();
    entry.constraints();
    entry.connectors();
    instant(&scratch, rule.h, before, 0.0)
}

struct Entry<'a> {
    model: &'a Model,
    state: &'a mut State,
    rule: &'a Integration,
    forcing: &'a Forcing,
    work: &'a Workspace,
}

impl Entry<'_> {
    /// Position and tangent of a point in the middle of the step.
    fn middle(&self, p: &MaterialPoint) -> [[f64; 2]; 2] {
        p.middle(&self.state.displacement, &self.work.increment)
    }

    /// Enters a force and a couple of a support, a guide or the ground on a point; supports have reactions of their own.
    fn reaction(&mut self, support: Option<usize>, x: [f64; 2], force: [f64; 2], moment: f64) {
        let h = self.rule.h;
        self.state.ledger.react(h, x, force, moment);
        let Some(support) = support else { return };
        let own = self.state.reaction_mut(support);
        own[0] += h * force[0];
        own[1] += h * force[1];
        own[2] += h * moment;
    }

    /// Reactions at nodes are the residual at fixed components.
    fn prescribed(&mut self) {
        let (model, work) = (self.model, self.work);
        for dofs in &model.prescribed {
            let (n, r) = (dofs.node, &work.residual[dofs.node]);
            let [x, g] = external::middle(model, self.state, &work.increment, n);
            let mut reaction = [0.0; 4];
            for normal in &dofs.normals {
                let along: f64 = (0..4).map(|k| normal[k] * r[k]).sum();
                (0..4).for_each(|k| reaction[k] += along * normal[k]);
            }
            let d = &work.increment[n];
            let moment = if n < model.beam_node_count() {
                cross(g, [reaction[2], reaction[3]])
            } else {
                reaction[2]
            };
            self.state.ledger.work_supports += (0..4).map(|k| reaction[k] * d[k]).sum::<f64>();
            self.reaction(dofs.support, x, [reaction[0], reaction[1]], moment);
        }
    }

    /// Multipliers of supports between nodes, for a time, or turning a tangent.
    fn constraints(&mut self) {
        let (model, work, forcing) = (self.model, self.work, self.forcing);
        for (c, multiplier) in model.constraints.iter().zip(&work.multiplier) {
            if c.support.is_none() {
                continue;
            }
            let start = &self.state.displacement;
            let step = ConstraintStep { start, increment: &work.increment, forcing, share: 0.5 };
            let r = step.reaction(c, *multiplier);
            self.state.ledger.work_supports += r.work;
            self.reaction(c.support, r.at, r.force, r.moment);
        }
    }

    /// Dampers; forces of the ground, and its work where it moves.
    fn connectors(&mut self) {
        let (model, work, forcing) = (self.model, self.work, self.forcing);
        for (i, c) in model.connectors.iter().enumerate() {
            if !forcing.connected[i] {
                // A released support takes the energy of its springs with it.
                self.state.ledger.work_supports -=
                    c.potential(self.state.coordinates[i], &self.state.memories);
                continue;
            }
            let step = c.step(i, self.rule, forcing, self.state, &work.increment);
            self.state.ledger.loss_damping += step.damper * step.change;
            let force = |g: usize| scale(-step.force, step.forms[g]);
            match &c.coordinate {
                Coordinate::Displacement { point, drive, .. } => {
                    self.state.ledger.work_supports -= step.force * forcing.increment(drive);
                    let [x, _] = self.middle(point);
                    self.reaction(c.support, x, force(0), 0.0);
                }
                Coordinate::Angle { a, b: None, .. } => {
                    let [x, g] = self.middle(a);
                    self.reaction(c.support, x, [0.0; 2], cross(g, force(0)));
                }
                Coordinate::Angle { .. } => {}
                Coordinate::Distance { ends } => {
                    for (k, (end, other)) in
                        [(&ends[0], &ends[1]), (&ends[1], &ends[0])].iter().enumerate()
                    {
                        if let (
                            ConnectorEnd::Point(p) | ConnectorEnd::Body(p),
                            ConnectorEnd::Ground(_),
                        ) = (end, other)
                        {
                            let [x, _] = self.middle(p);
                            self.reaction(None, x, force(k), 0.0);
                        }
                    }
                }
            }
        }
    }

    /// Damping of the beams' materials.
    fn spans(&mut self) {
        let (model, h) = (self.model, self.rule.h);
        let mut sum = StepWork::default();
        for span in model.spans.iter().filter(|s| s.is_damped()) {
            for k in 0..span.elements.len() {
                if span.mass_damping > 0.0 {
                    self.mass_damping(span, k, &mut sum);
                }
                // That of fibres is known already.
                let sheared = span.shear.is_some() && !self.state.has_parted(span.nodes.start + k);
                if span.retardation > 0.0 && (span.fibres.is_none() || sheared) {
                    self.state.ledger.loss_damping +=
                        self.viscous_loss(span, k) * span.retardation / h;
                }
            }
        }
        self.state.ledger.damp(&sum);
    }

    fn mass_damping(&self, span: &Span, k: usize, sum: &mut StepWork) {
        let (h, a, table) = (self.rule.h, span.nodes.start + k, span.table(k));
        let (u, d) = (&self.state.displacement, &self.work.increment);
        let velocity = [a, a + 1].map(|n| {
            let a0 = self.state.acceleration.get(n).unwrap_or(&[0.0; 4]);
            array(|i| self.rule.rate(d[n][i], self.state.velocity[n][i], a0[i]))
        });
        let middle = [a, a + 1].map(|n| external::middle(self.model, self.state, d, n));
        let damping = MassDamping { table, coefficient: span.mass_damping, h };
        damping.translation(&velocity, middle, [&d[a], &d[a + 1]], sum);
        if self.state.has_parted(a) {
            return; // its sections turn on undamped
        }
        let old = ElementValues::new(&u[a], &u[a + 1]);
        let slopes = table.rows.each_ref().map(|row| old.at(&row.first));
        damping.rotation(&slopes, &ElementValues::new(&d[a], &d[a + 1]), sum);
    }

    /// Viscous dissipation of an element, of one of fibres by shear alone, without the factor `tau/h`, for the changes of strain in the scheme.
    fn viscous_loss(&self, span: &Span, k: usize) -> f64 {
        let (a, table) = (span.nodes.start + k, span.table(k));
        let (u, d) = (&self.state.displacement, &self.work.increment);
        let (old, step) =
            (ElementValues::new(&u[a], &u[a + 1]), ElementValues::new(&d[a], &d[a + 1]));
        let [at_a, at_b] = [a, a + 1].map(|n| array(|i| u[n][i] + d[n][i]));
        let end = ElementValues::new(&at_a, &at_b);
        if let Some(shear) = span.shear_at(k) {
            return match span.fibres {
                Some(_) => shear.viscous_loss_across(&old, &end),
                None => shear.viscous_loss(&old, &end),
            };
        }
        let invariant =
            Integration::new(Scheme::EnergyMomentum, self.rule.h).rule == self.rule.rule;
        let changes = table.rows.each_ref().map(|row| {
            if invariant {
                let at = |u: &ElementValues<f64>| {
                    let (slope, bend) = (u.at(&row.first), u.at(&row.second));
                    strains(span.measure, &row.reference, slope, bend)
                };
                let (s0, s1) = (at(&old), at(&end));
                Strains { membrane: s1.membrane - s0.membrane, bending: s1.bending - s0.bending }
            } else {
                let none = Strains { membrane: 0.0, bending: 0.0 };
                strain_rate::advance(&row.weighed, &step_point(row, &old, &step), none)
            }
        });
        let sampled = table.membrane.as_ref().map(|samples| {
            if invariant {
                let at = |u| samples.strains(span.measure, u);
                let (s0, s1) = (at(&old), at(&end));
                array(|i| s1[i] - s0[i])
            } else {
                samples.step(&old, &step).map(|s| s.midpoint_change(span.measure))
            }
        });
        viscous(table, &changes, sampled)
    }

    /// Damping of modes.
    fn modes(&mut self, damping: &ModalDamping) {
        if damping.is_empty() {
            return;
        }
        let (model, h, work) = (self.model, self.rule.h, self.work);
        let flow = work.modal.flow(model, damping, self.state, &work.increment, h);
        let ledger = &mut self.state.ledger;
        ledger.loss_damping += flow.loss;
        ledger.work_supports += flow.brought;
        ledger.impulse_damping = add(ledger.impulse_damping, flow.done.impulse);
        ledger.angular_impulse_damping += flow.done.angular_impulse;
    }

    /// Springs to rear masses.
    fn rear_masses(&mut self) {
        for (i, body) in self.model.bodies.iter().enumerate() {
            let (node, u) = (self.model.body_node(i), &self.state.displacement);
            if let Some(spring) = rear_spring(&body.kind, node, self.rule, u, &self.work.increment)
            {
                self.state.ledger.loss_damping += spring.damper * spring.change;
            }
        }
    }

    /// Reaction of the obstacle of a pair, if there is one, to an impulse along a row.
    fn obstacle(&mut self, pair: usize, row: &Row, impulse: f64) {
        let Some(obstacle) = self.model.pairs[pair].obstacle.filter(|_| impulse != 0.0) else {
            return;
        };
        let data = &self.model.obstacles[obstacle];
        let node = self.model.body_node(data.body);
        let c = row.at(node);
        let arm = [0, 1].map(|i| data.position[i] - self.model.nodes[node].position[i]);
        let own = self.state.reaction_mut(data.support);
        // The impulse on one body is opposite to that on the other.
        own[0] -= impulse * c[0];
        own[1] -= impulse * c[1];
        own[2] -= impulse * (c[2] - cross(arm, [c[0], c[1]]));
    }

    /// Loss of impacts, and of smooth contacts that dissipate.
    fn contacts(&mut self) {
        let work = self.work;
        for contact in &work.smooth {
            self.obstacle(contact.pair, &contact.row, contact.force.force * self.rule.h);
        }
        for (k, found) in work.rigid.iter().enumerate() {
            self.obstacle(work.rigid_pairs[k], &found.normal, found.impulse[0]);
            self.obstacle(work.rigid_pairs[k], &found.tangent, found.impulse[1]);
        }
        let ledger = &mut self.state.ledger;
        for contact in &work.smooth {
            if contact.force.dissipated != 0.0 {
                let closed = -contact.row.on(&work.increment);
                ledger.loss_damping += contact.force.dissipated * closed;
            }
        }
        for contact in &work.rigid {
            // Work of an impulse: L (z0 + z1)/2, the mean rate over the step.
            let mean = |row: &Row| row.on(&work.increment) / self.rule.h;
            let [normal, tangent] = contact.impulse;
            ledger.loss_impacts -= normal * mean(&contact.normal);
            if tangent != 0.0 {
                ledger.loss_impacts -= tangent * mean(&contact.tangent);
            }
        }
    }
}
