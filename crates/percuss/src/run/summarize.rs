//! The summary of a run that has ended.

use super::observing::connector_log;
use super::observing::contact_log::ContactLog;
use super::observing::crest::Crest;
use super::observing::given::Given;
use super::observing::joint_log;
use super::observing::monitor::Monitor;
use super::observing::yielding;
use super::solving::solver::{Counts, StateView};
use crate::analysis::equivalent::equivalent_force;
use crate::analysis::section_forces;
use crate::ledger::Measures;
use crate::math::vec2::{dot, norm, scale};
use crate::model::Model;
use crate::settings::SAME_INSTANT;
use crate::state::State;
use crate::step::effective_mass::EffectiveMass;
use crate::summary::*;

/// A run that has ended.
pub struct Ended<'a> {
    /// Its status.
    pub at: StateView<'a>,
    /// Energies and momenta there.
    pub measures: &'a Measures,
    /// Its counts.
    pub counts: Counts,
    /// Rows recorded.
    pub rows: usize,
    /// Data on the sizes of steps chosen for an accuracy.
    pub step_control: Option<StepControl>,
    /// Collected data.
    pub monitor: Monitor,
}

/// The summary of a run that has ended.
pub fn summarize(run: Ended<'_>, termination: Termination) -> RunSummary {
    let Ended { at, measures, counts, rows, step_control, monitor } = run;
    let StateView { model, settings, state } = at;
    let ledger = &state.ledger;
    let relative = |value: f64, scale: f64| if value == 0.0 { 0.0 } else { value / scale };
    let [energy_scale, linear_scale, angular_scale] = ledger.audit_scales();
    let audit = monitor.audit;
    let sets = yielding::sets(model, state);
    let contact_residual_max = monitor.contacts.residual;
    let mut summary = RunSummary {
        termination,
        time: state.time,
        steps: state.step,
        solver_steps: counts.solver_steps,
        step_cuts: counts.step_cuts,
        accumulated_steps: counts.accumulated_steps,
        newton_iterations: counts.effort.iterations,
        factorizations: counts.effort.factorizations,
        rows,
        step_control,
        energy: EnergySummary {
            initial: ledger.energy_initial,
            final_: measures.total(),
            work_loads: ledger.work_loads,
            work_supports: ledger.work_supports,
            loss_impacts: ledger.loss_impacts,
            loss_damping: ledger.loss_damping,
            plastic: ledger.loss_plastic,
            hardening: measures.hardening,
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
        projectiles: projectiles(model, state, &monitor.given),
        contacts: contacts(at, monitor.contacts, &monitor.struck_masses),
        contact_residual_max,
        multiple_impacts: monitor.multiple_impacts,
        points: points(at, monitor.points),
        supports: monitor.supports,
        plastic: yielding::summaries(model, state, &monitor.yielded, &sets),
        yielding: connector_log::summaries(model, state, &monitor.connectors, &sets),
        foundations: monitor.foundations,
        joints: joint_log::summaries(model, &monitor.joints),
        pulses: monitor.pulses.summaries(model),
        section_forces: in_order(monitor.section_forces),
    };
    if !model.projectiles.is_empty() {
        let found = equivalent_force(model, settings.start, &summary);
        for contact in &mut summary.contacts[..model.projectiles.len()] {
            contact.equivalent_force = found.as_ref().ok().copied();
            contact.no_equivalent_force = found.as_ref().err().cloned();
        }
    }
    summary
}

/// Section forces with the places of their envelopes in order.
fn in_order(mut beams: Vec<SectionForceSummary>) -> Vec<SectionForceSummary> {
    section_forces::ordered(&mut beams);
    beams
}

fn contacts(
    at: StateView<'_>,
    log: ContactLog,
    struck_masses: &[Option<EffectiveMass>],
) -> Vec<ContactSummary> {
    let StateView { model, settings, state } = at;
    let effective = model.effective_masses();
    let last_instant = state.time - SAME_INSTANT * settings.step;
    let round_off = AuditSummary::JUDGED * state.ledger.audit_scales()[0];
    let sliding = |i| log.sliding(i).map(|sliding| sliding.without_round_off(round_off));
    let sliding: Vec<_> = (0..model.contacts.len()).map(sliding).collect();
    (model.contacts.iter().zip(log.records).enumerate())
        .map(|(i, (contact, mut record))| {
            remove_closing_since(&mut record, last_instant);
            record.intervals_mut().iter_mut().for_each(|c| c.energy.balance());
            let pairs = || contact.pairs.clone();
            ContactSummary {
                name: contact.name.clone(),
                between: contact.between.clone(),
                effective_mass: effective.get(i).copied().or(struck_masses[i]),
                equivalent_force: None,
                no_equivalent_force: None,
                permanent_penetration: contact.law.permanent(state, pairs()),
                pressed_in: log.pressed[i],
                sliding: sliding[i],
                carried_crush: contact.law.carried(state, pairs()),
                record,
            }
        })
        .collect()
}

/// Removes the interval of a smooth contact that begins no earlier than this and has not ended: the penetration of a contact that closes at the
/// very end of a run is round-off.
fn remove_closing_since(record: &mut ContactRecord, time: f64) {
    if let ContactRecord::Smooth { peak_force, intervals } = record
        && intervals.pop_if(|last| last.end.is_nan() && last.start >= time).is_some()
        && intervals.is_empty()
    {
        *peak_force = Peak::default();
    }
}

fn points(at: StateView<'_>, crests: Vec<[Crest<f64>; 2]>) -> Vec<PointSummary> {
    (at.model.points.iter().zip(crests))
        .map(|(p, mut crests)| {
            crests.iter_mut().for_each(|crest| crest.close(0, at.state.time));
            PointSummary {
                name: p.label.clone(),
                displacement_max: crests.map(|c| Peak { value: c.value, time: c.time }),
                resolved: crests.map(|c| c.is_resolved(0)),
                relative_to_base: at.model.has_accelerated_base(),
            }
        })
        .collect()
}

fn projectiles(model: &Model, state: &State, given: &[Given]) -> Vec<ProjectileSummary> {
    let each = model.striking_bodies().zip(given).map(|(first, given)| {
        let body = &model.bodies[first];
        let v = &state.velocity[model.body_node(first)];
        // At rest at the start, it has a direction only if it is guided.
        let guide = model.projectiles.iter().find(|p| p.body == first);
        let (direction, speed) = (guide.map(|p| p.direction), norm(body.velocity));
        let along = direction.unwrap_or(scale(1.0 / speed, body.velocity));
        let plain = |x: f64| x + 0.0; // no -0.0
        ProjectileSummary {
            name: body.name.clone(),
            direction,
            strikes: guide.map(|p| p.point.label.clone()),
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
