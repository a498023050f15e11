//! The summary of a run that has ended.

use super::connector_log;
use super::joint_log;
use super::simulation::Simulation;
use super::step_size::StepSizeControl;
use super::yielding;
use crate::analysis::equivalent::equivalent_force;
use crate::math::vec2::{dot, norm, scale};
use crate::summary::*;

impl Simulation<'_> {
    pub(super) fn summary(self, termination: Termination) -> RunSummary {
        let (ledger, audit) = (&self.state.ledger, self.monitor.audit);
        let relative = |value: f64, scale: f64| if value == 0.0 { 0.0 } else { value / scale };
        let effective = self.model.effective_masses();
        let [energy_scale, linear_scale, angular_scale] = ledger.audit_scales();
        let model = self.model;
        let sets = yielding::sets(model, &self.state);
        let mut summary = RunSummary {
            termination,
            time: self.state.time,
            steps: self.state.step,
            solver_steps: self.solver_steps,
            step_cuts: self.step_cuts,
            accumulated_steps: self.accumulated_steps,
            newton_iterations: self.effort.iterations,
            factorizations: self.effort.factorizations,
            rows: self.rows.count,
            step_control: self.step_size.as_ref().map(StepSizeControl::told),
            energy: EnergySummary {
                initial: ledger.energy_initial,
                final_: self.measures.total(),
                work_loads: ledger.work_loads,
                work_supports: ledger.work_supports,
                loss_impacts: ledger.loss_impacts,
                loss_damping: ledger.loss_damping,
                plastic: ledger.loss_plastic,
                hardening: self.measures.hardening,
                failure: ledger.loss_failure,
                scale: energy_scale,
                residual_max: relative(audit.energy, energy_scale),
            },
            momentum: MomentumSummary {
                linear_scale,
                linear_residual_max: relative(audit.linear, linear_scale),
                angular_scale,
                angular_residual_max: relative(audit.angular, angular_scale),
            },
            audit: AuditSummary {
                curvature_drift_max: audit.curvature_drift,
                membrane_drift_max: audit.membrane_drift,
                angular_rate_drift_max: relative(audit.angular_rate_drift, energy_scale),
            },
            projectiles: self.projectiles(),
            contacts: (self.model.contacts.iter().zip(self.monitor.contacts.records).enumerate())
                .map(|(i, (contact, mut record))| {
                    record.intervals_mut().iter_mut().for_each(|c| c.energy.balance());
                    let pairs = || contact.pairs.clone();
                    ContactSummary {
                        name: contact.name.clone(),
                        between: contact.between.clone(),
                        effective_mass: effective.get(i).copied().or(self.struck_masses[i]),
                        equivalent_force: None,
                        no_equivalent_force: None,
                        permanent_penetration: contact.law.permanent(&self.state, pairs()),
                        pressed_in: self.monitor.contacts.pressed[i],
                        carried_crush: contact.law.carried(&self.state, pairs()),
                        record,
                    }
                })
                .collect(),
            contact_residual_max: self.monitor.contacts.residual,
            shared_blows: self.shared_blows,
            points: (self.model.points.iter().zip(self.monitor.points))
                .map(|(p, mut crests)| {
                    crests.iter_mut().for_each(|crest| crest.close(0, self.state.time));
                    PointSummary {
                        name: p.label.clone(),
                        displacement_max: crests.map(|c| Peak { value: c.value, time: c.time }),
                        resolved: crests.map(|c| c.is_resolved(0)),
                    }
                })
                .collect(),
            supports: self.monitor.supports,
            plastic: yielding::summaries(model, &self.state, &self.monitor.yielded, &sets),
            yielding: connector_log::summaries(model, &self.state, &self.monitor.connectors, &sets),
            joints: joint_log::summaries(model, &self.monitor.joints),
            section_forces: self.monitor.section_forces,
        };
        if !model.projectiles.is_empty() {
            let found = equivalent_force(model, self.settings.start, &summary);
            for contact in &mut summary.contacts[..model.projectiles.len()] {
                contact.equivalent_force = found.ok();
                contact.no_equivalent_force = found.err();
            }
        }
        summary
    }

    fn projectiles(&self) -> Vec<ProjectileSummary> {
        let (model, state) = (self.model, &self.state);
        let each = model.striking_bodies().zip(&self.given).map(|(first, given)| {
            let body = &model.bodies[first];
            let v = &state.velocity[model.body_node(first)];
            // At rest at the start, it has a direction only if it is guided.
            let guide = model.projectiles.iter().find(|p| p.body == first).map(|p| p.direction);
            let speed = norm(body.velocity);
            let along = guide.unwrap_or(scale(1.0 / speed, body.velocity));
            let plain = |x: f64| x + 0.0; // no -0.0
            ProjectileSummary {
                name: body.name.clone(),
                velocity_final: [plain(v[0]), plain(v[1])],
                spin_final: plain(v[2]),
                momentum_transferred: if speed > 0.0 || guide.is_some() {
                    plain(dot(along, given.impulse))
                } else {
                    plain(-norm(given.impulse))
                },
                energy_given: plain(given.work),
                energy_received_by_others: plain(given.received),
            }
        });
        each.collect()
    }
}
