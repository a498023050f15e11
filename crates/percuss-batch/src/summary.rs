//! The summary of a run of an ensemble.

use super::engine::Engine;
use super::ledger::LaneLedger;
use super::log::{Closed, Log, Top};
use super::newton::LaneNewton;
use super::numbers::GuideLaw;
use super::yield_log;
use percuss::Model;
use percuss::State;
use percuss::internals::element::fibre::FibreState;
use percuss::internals::run::crest::{Crest, at_last};
use percuss::internals::run::yielding;
use percuss::internals::scalar::Number;
use percuss::internals::step::effective_mass::EffectiveMass;
use percuss::*;

/// State and records of a lane from which its summary is computed.
pub struct SummaryInput<'a, S: Number> {
    pub model: &'a Model,
    pub engine: &'a Engine<S>,
    pub ledger: &'a LaneLedger<S>,
    pub log: &'a Log<S>,
    pub search: &'a LaneNewton<S>,
    pub lane: usize,
    /// Steps of the given size, those of them in which impacts accumulated, steps of the solver, rows that a recorder would receive.
    pub steps: usize,
    pub accumulated_steps: usize,
    pub solver_steps: usize,
    pub rows: usize,
    /// Record of a rigid contact, given its number and the reading.
    pub rigid: &'a dyn Fn(usize, &Reading<S>) -> ContactRecord,
    /// Largest violation of the impulses' conditions.
    pub residual: f64,
}

/// Conversion of the numbers of a lane to those of a summary.
pub struct Reading<'a, S> {
    /// Value of a number in a lane, or one of its derivatives.
    pub read: &'a dyn Fn(S) -> f64,
    /// Numbers that depend only on the model, or their derivatives, shape (guided projectiles).
    pub fixed: &'a [Fixed],
    /// Whether derivatives are read. Measures of numerical errors have none: they are NaN.
    pub derivative: bool,
}

/// Results for a guided projectile that depend only on the model.
#[derive(Clone, Copy, Debug)]
pub struct Fixed {
    pub mass: EffectiveMass,
    /// Arc length of the struck point \[m\].
    pub s: f64,
}

impl Fixed {
    /// Of every projectile.
    pub fn all(model: &Model) -> Vec<Self> {
        let both = model.effective_masses().into_iter().zip(&model.projectiles);
        both.map(|(mass, projectile)| Self { mass, s: projectile.point.s }).collect()
    }

    /// Its numbers.
    pub fn numbers(&self) -> [f64; 3] {
        [self.mass.on_mesh, self.mass.limit, self.s]
    }

    /// The same of given numbers.
    pub fn from([on_mesh, limit, s]: [f64; 3]) -> Self {
        Self { mass: EffectiveMass { on_mesh, limit }, s }
    }
}

impl<S: Number> SummaryInput<'_, S> {
    /// The summary; section forces and reactions are unset.
    pub fn summary(&self, termination: Termination, reading: &Reading<S>) -> RunSummary {
        let (model, read) = (self.model, reading.read);
        let LaneLedger { sums, now, audit } = self.ledger;
        let error = |value: f64| if reading.derivative { f64::NAN } else { value };
        let relative = |value: S, scale: S| {
            let (value, scale) = (value.lane(self.lane), scale.lane(self.lane));
            error(if value == 0.0 { 0.0 } else { value / scale })
        };
        let [energy_scale, linear_scale, angular_scale] = sums.audit_scales();
        RunSummary {
            termination,
            time: read(self.log.time),
            steps: self.steps,
            solver_steps: self.solver_steps,
            step_cuts: 0,
            accumulated_steps: self.accumulated_steps,
            step_control: None,
            newton_iterations: self.search.iterations.lane(self.lane) as usize,
            factorizations: self.search.factorizations.lane(self.lane) as usize,
            rows: self.rows,
            energy: EnergySummary {
                initial: read(sums.energy_initial),
                final_: read(now.total()),
                work_loads: read(sums.work_loads),
                work_supports: 0.0,
                loss_impacts: read(sums.loss_impacts),
                loss_damping: read(sums.loss_damping),
                plastic: read(sums.loss_plastic),
                hardening: read(now.hardening),
                failure: 0.0,
                scale: read(energy_scale),
                residual_max: relative(audit.energy, energy_scale),
            },
            momentum: MomentumSummary {
                linear_scale: read(linear_scale),
                linear_residual_max: relative(audit.linear, linear_scale),
                angular_scale: read(angular_scale),
                angular_residual_max: relative(audit.angular, angular_scale),
            },
            audit: AuditSummary {
                curvature_drift_max: error(0.0),
                membrane_drift_max: error(0.0),
                angular_rate_drift_max: relative(audit.angular_rate_drift, energy_scale),
            },
            projectiles: self.projectiles(read),
            contacts: (model.contacts.iter().enumerate())
                .map(|(k, contact)| ContactSummary {
                    name: contact.name.clone(),
                    between: contact.between.clone(),
                    effective_mass: reading.fixed.get(k).map(|fixed| fixed.mass),
                    permanent_penetration: None,
                    carried_crush: None,
                    pressed_in: None,
                    sliding: None,
                    equivalent_force: None,
                    no_equivalent_force: None,
                    record: self.record(k, reading),
                })
                .collect(),
            contact_residual_max: error(self.residual),
            multiple_impacts: MultipleImpactSummary::default(),
            points: (model.points.iter().zip(&self.log.points))
                .map(|(p, crests)| {
                    let mut crests = *crests;
                    crests.iter_mut().for_each(|crest| crest.close(self.lane, self.log.time));
                    let peak = |c: &Crest<S>| Peak { value: read(c.value), time: read(c.time) };
                    PointSummary {
                        name: p.label.clone(),
                        displacement_max: crests.map(|c| peak(&c)),
                        resolved: crests.map(|c| c.is_resolved(self.lane)),
                        relative_to_base: model.has_accelerated_base(),
                    }
                })
                .collect(),
            supports: Vec::new(),
            foundations: Vec::new(),
            section_forces: Vec::new(),
            plastic: self.plastic(reading.derivative),
            yielding: Vec::new(),
            joints: Vec::new(),
            pulses: Vec::new(),
        }
    }

    /// Results of beams that can yield; their derivatives are computed elsewhere.
    fn plastic(&self, derivative: bool) -> Vec<PlasticSummary> {
        if derivative || self.log.yields.is_empty() {
            return Vec::new();
        }
        let lane = self.lane;
        let value = |x: S| x.lane(lane);
        let fibre = |from: &FibreState<S>| FibreState {
            plastic: value(from.plastic),
            accumulated: value(from.accumulated),
            dissipated: value(from.dissipated),
            failed: from.failed,
        };
        let displacement = self.engine.displacement.iter().map(|u| u.map(value));
        let fibres = self.engine.fibres.states.iter().map(fibre);
        let state = State::at_rest_at(self.model, displacement, fibres);
        let records = yield_log::records(self.model, &self.log.yields, lane);
        let sets = yielding::sets(self.model, &state);
        yielding::summaries(self.model, &state, &records, &sets)
    }

    fn projectiles(&self, read: &dyn Fn(S) -> f64) -> Vec<ProjectileSummary> {
        let guides = self.engine.numbers.guides.iter().zip(&self.engine.guides);
        let each = guides.zip(&self.model.projectiles).zip(&self.log.guides);
        let each = each.map(|(((guide, state), data), log)| ProjectileSummary {
            name: self.model.bodies[data.body].name.clone(),
            direction: Some(data.direction),
            strikes: Some(data.point.label.clone()),
            velocity_final: guide.direction.map(|e| read(e * state.velocity) + 0.0),
            spin_final: 0.0,
            momentum_transferred: read(log.given[0]) + 0.0,
            energy_given: read(log.given[1]) + 0.0,
            energy_received_by_others: read(log.given[2]) + 0.0,
        });
        each.collect()
    }

    fn record(&self, k: usize, reading: &Reading<S>) -> ContactRecord {
        let read = reading.read;
        let (guide, log) = (&self.engine.numbers.guides[k], &self.log.guides[k]);
        if guide.law == GuideLaw::Rigid {
            return (self.rigid)(k, reading);
        }
        // The peak of a damped force is not that of the penetration.
        let of = |value: S| if guide.damped { value * f64::NAN } else { value };
        let force = |top: &Top<S>| Top {
            value: of(guide.reaction(top.value)),
            time: of(at_last(top.time, self.log.time)),
        };
        let closed = self.log.intervals(self.engine, k, self.lane);
        let touched = !closed.is_empty();
        ContactRecord::Smooth {
            peak_force: if touched { peak(&force(&log.deepest), read) } else { Peak::default() },
            intervals: closed
                .iter()
                .take(ContactRecord::IMPACTS_KEPT)
                .map(|c| self.interval(k, c, peak(&force(&c.deepest), read), reading))
                .collect(),
        }
    }

    fn interval(
        &self,
        k: usize,
        closed: &Closed<S>,
        peak_force: Peak,
        reading: &Reading<S>,
    ) -> ContactInterval {
        let read = reading.read;
        let mut interval = ContactInterval {
            start: read(closed.start),
            end: read(closed.end),
            impulse: read(closed.impulse),
            tangential_impulse: f64::NAN,
            peak_force,
            approach_velocity: read(closed.approach),
            // A contact that has separated cannot have a velocity of approach.
            separation_velocity: if closed.separation.lane(self.lane) < 0.0 {
                f64::NAN
            } else {
                read(closed.separation)
            },
            steps: closed.steps.lane(self.lane) as usize,
            steady: self.is_steady(closed),
            one_point: true,
            torn: false,
            place: reading.place(k, closed.place),
            place_end: reading.place(k, closed.place_end),
            energy: EnergySplit {
                given: closed.given.map(read),
                lost: if self.engine.numbers.guides[k].damped { f64::NAN } else { 0.0 },
                failure: 0.0,
                stored: read(closed.stored),
                scheme: 0.0,
            },
        };
        interval.energy.balance();
        interval
    }

    /// Whether the gap's rate changed by less than itself in the steps before and after an interval.
    fn is_steady(&self, closed: &Closed<S>) -> bool {
        let rates = [closed.approach, closed.separation].map(|v| v.lane(self.lane));
        let changes = closed.changes.map(|v| v.lane(self.lane).abs());
        let parted = rates[1].is_nan() || changes[1] <= rates[1];
        changes[0] <= rates[0].abs() && parted
    }
}

impl<S: Number> Reading<'_, S> {
    fn place(&self, k: usize, position: [S; 2]) -> ContactPlace {
        ContactPlace { s: self.fixed[k].s, position: position.map(self.read) }
    }
}

fn peak<S: Number>(top: &Top<S>, read: &dyn Fn(S) -> f64) -> Peak {
    Peak { value: read(top.value), time: read(top.time) }
}
