//! Results of a run. Unset results are NaN.

mod contact;
mod equivalent;
mod forces;
mod foundation;
mod joints;
mod peak;
mod plastic;
mod pulse;
mod step_control;

pub use contact::*;
pub use equivalent::*;
pub use forces::*;
pub use foundation::*;
pub use joints::*;
pub use peak::Peak;
pub use plastic::*;
pub use pulse::*;
pub use step_control::*;

use crate::error::Error;
use crate::inspect::{ContactView, MovingPartner};
use crate::model::Model;

/// Termination of a run.
#[derive(Debug, Default)]
pub enum Termination {
    /// Not run yet.
    #[default]
    Unsolved,
    /// Reached its end.
    Completed,
    /// Stopped by the recorder at the given time \[s\]; everything up to it is recorded.
    Interrupted {
        /// Time reached \[s\].
        time: f64,
    },
    /// No convergence; all steps up to the last accepted one are recorded.
    Failed(Error),
}

/// Energies of a run \[J\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergySummary {
    /// Total energy at the start.
    pub initial: f64,
    /// Total energy at the end.
    pub final_: f64,
    /// Work done by the loads.
    pub work_loads: f64,
    /// Work done by the supports.
    pub work_supports: f64,
    /// Energy lost in impacts and to friction of rigid contacts.
    pub loss_impacts: f64,
    /// Energy dissipated by damping and in smooth contacts; [`RunSummary::loss_contacts`] separates the two.
    pub loss_damping: f64,
    /// Energy dissipated by plastic flow in the run, without the dissipation in the static start.
    pub plastic: f64,
    /// Energy that hardening has stored.
    pub hardening: f64,
    /// Energy that was stored in fibres, springs and hinges that failed.
    pub failure: f64,
    /// Energy scale, the scale of `residual_max`.
    pub scale: f64,
    /// Largest magnitude of the energy residual, relative to `scale`.
    pub residual_max: f64,
}

/// Momentum residuals of a run, support and load impulses taken into the ledger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentumSummary {
    /// Scale of linear momentum \[kg m/s\], the scale of `linear_residual_max`.
    pub linear_scale: f64,
    /// Largest magnitude of the residual of linear momentum, relative.
    pub linear_residual_max: f64,
    /// Scale of angular momentum \[kg m^2/s\], the scale of `angular_residual_max`.
    pub angular_scale: f64,
    /// Largest magnitude of the residual of angular momentum about the origin, relative.
    pub angular_residual_max: f64,
}

/// Quantities that the scheme carries in addition to the motion of the nodes, and their drift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AuditSummary {
    /// Largest distance of the stored bending strain from that of the configuration, zero but for the strain-rate scheme \[1/m\].
    pub curvature_drift_max: f64,
    /// Largest distance of the stored membrane strain from that of the configuration, zero but for the strain-rate scheme \[-\].
    pub membrane_drift_max: f64,
    /// Largest difference between the kinetic energy with the angular rates that follow from the slopes' velocities and that with
    /// the sections' own rates, which is conserved, relative to the scale of energy \[-\].
    pub angular_rate_drift_max: f64,
}

impl AuditSummary {
    /// If [`Self::angular_rate_drift_max`] is more than this, the step does not resolve the motion.
    pub const UNRESOLVED: f64 = 0.01;
    /// Share of its scale from which on the residual of a balance is an error, not round-off.
    pub const JUDGED: f64 = crate::ledger::JUDGED;
}

/// Results of a projectile, guided or free.
#[derive(Clone, Debug, PartialEq)]
pub struct ProjectileSummary {
    /// The user's name for it.
    pub name: String,
    /// Unit vector of its line of motion, from it to the beam, shape (2) \[-\]; none of a free one.
    pub direction: Option<[f64; 2]>,
    /// Name of the point that it strikes; none of a free one.
    pub strikes: Option<String>,
    /// Velocity at the end, shape (2) \[m/s\].
    pub velocity_final: [f64; 2],
    /// Angular velocity at the end \[rad/s\]; zero for a guided one.
    pub spin_final: f64,
    /// Momentum transferred to others through its contacts, along its line of motion or its initial velocity, without the effect of loads. For a
    /// free body at rest at the start the magnitude, negative: it can only receive momentum \[N s\].
    pub momentum_transferred: f64,
    /// Energy transferred by its contacts, negative if it received energy; without loads and internal losses \[J\].
    pub energy_given: f64,
    /// Work of these contacts on its partners \[J\]: less than the transferred energy by the dissipation in them, and by the energy stored in their
    /// springs.
    pub energy_received_by_others: f64,
}

/// The result of a run.
#[derive(Debug)]
pub struct RunSummary {
    /// Termination.
    pub termination: Termination,
    /// Time reached \[s\].
    pub time: f64,
    /// Steps of the given size completed.
    pub steps: usize,
    /// Steps of the solver, trial and shortened ones included.
    pub solver_steps: usize,
    /// Times a step was cut because Newton's iteration failed.
    pub step_cuts: usize,
    /// Steps at the Zeno limit: the remaining impacts of each are plastic.
    pub accumulated_steps: usize,
    /// Newton iterations. Runs in lanes need other numbers than single runs: these two describe the solver, not the run.
    pub newton_iterations: usize,
    /// Factorisations of the tangent.
    pub factorizations: usize,
    /// Rows recorded.
    pub rows: usize,
    /// Sizes of steps, for a requested accuracy in place of a step.
    pub step_control: Option<StepControl>,
    /// Energies.
    pub energy: EnergySummary,
    /// Momenta.
    pub momentum: MomentumSummary,
    /// Drift of stored strains and of angular rates.
    pub audit: AuditSummary,
    /// One entry a guided projectile, then one a disc, in the model's order, shape (guided projectiles and discs).
    pub projectiles: Vec<ProjectileSummary>,
    /// One entry a guided projectile, then one a contact, in the model's order, shape (guided projectiles and contacts).
    pub contacts: Vec<ContactSummary>,
    /// Largest violation of the contacts' complementarity conditions, as a velocity relative to the largest one \[-\].
    pub contact_residual_max: f64,
    /// Impacts on several touching bodies at once.
    pub multiple_impacts: MultipleImpactSummary,
    /// One entry a recorded point, shape (recorded points).
    pub points: Vec<PointSummary>,
    /// One entry a support, in the model's order, shape (supports).
    pub supports: Vec<SupportSummary>,
    /// One entry a beam, shape (beams).
    pub section_forces: Vec<SectionForceSummary>,
    /// One entry a beam that can yield, shape (beams that can yield).
    pub plastic: Vec<PlasticSummary>,
    /// One entry a spring or hinge that can yield, shape (such springs and hinges).
    pub yielding: Vec<YieldingSummary>,
    /// One entry a foundation, in the model's order, shape (foundations).
    pub foundations: Vec<FoundationSummary>,
    /// One entry a joint of a given strength, in the model's order, shape (such joints).
    pub joints: Vec<JointSummary>,
    /// Steps about the largest force: one entry a contact under a smooth law, then one a stop or a spring that can be open or slack, in the
    /// model's order, shape (such contacts, stops and springs); empty for runs in lanes.
    pub pulses: Vec<PulseSummary>,
}

impl RunSummary {
    /// Energy dissipated in smooth contacts, by their damping and by crushing: a part of [`EnergySummary::loss_damping`] \[J\]. For a contact with
    /// more than [`ContactRecord::IMPACTS_KEPT`] intervals it is that of the stored intervals.
    pub fn loss_contacts(&self) -> f64 {
        let smooth = self.contacts.iter().filter_map(|contact| match &contact.record {
            ContactRecord::Smooth { intervals, .. } => Some(intervals),
            ContactRecord::Nonsmooth { .. } => None,
        });
        smooth.flatten().map(|interval| interval.energy.lost - interval.energy.failure).sum()
    }
}

/// What makes reactions and shear forces grow without limit as mesh and step are refined: it gives a point of a slender beam a velocity at once,
/// and the waves that it sends out have no shortest length but that of the elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WithoutLimit {
    /// A rigid contact of a beam with an impact, by its number.
    Impact(usize),
    /// A support whose prescribed velocity jumps, by its number.
    Jump(usize),
}

impl WithoutLimit {
    /// Jumps of a prescribed velocity above this share of the largest one count; splines leave smaller ones at their ends.
    const JUMP: f64 = 0.05;
}

impl RunSummary {
    /// What leaves the reactions and shear forces of the run without a limit, in the model's order.
    pub fn forces_without_limit(&self, model: &Model) -> Vec<WithoutLimit> {
        let struck = |(view, contact): (ContactView<'_>, &ContactSummary)| {
            let is_beam = |partner: &MovingPartner| matches!(partner, MovingPartner::Beam(_));
            let on_beam = view.pairs().any(|(partners, _)| partners.iter().any(is_beam));
            let strikes =
                matches!(contact.record, ContactRecord::Nonsmooth { impact_count: 1.., .. });
            on_beam && strikes
        };
        let contacts = model.contacts().zip(&self.contacts).enumerate();
        let contacts =
            contacts.filter(|(_, both)| struck(*both)).map(|(k, _)| WithoutLimit::Impact(k));
        let jumps = model.supports().enumerate();
        let jumps = jumps.filter(|(_, view)| view.jump > WithoutLimit::JUMP);
        contacts.chain(jumps.map(|(k, _)| WithoutLimit::Jump(k))).collect()
    }

    /// Stops, springs and foundations that closed during the run and are closed at its end with the largest force since then, and the time at which
    /// they closed \[s\]: their largest force may follow. This is the one rule for them, in runs (W016) as in studies.
    pub fn still_rising(&self) -> impl Iterator<Item = (PulseOf, f64)> {
        let pulses = self.pulses.iter().filter(|pulse| !pulse.rises_since.is_nan());
        pulses.map(|pulse| (pulse.of.clone(), pulse.rises_since))
    }

    /// Names of the contacts of a body or beam that are still closed at the end of the run: those with its name, and those in which it is a partner.
    pub fn still_touches<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a str> {
        let of = move |contact: &&ContactSummary| {
            contact.name == name || contact.between.iter().any(|one| one == name)
        };
        let closed = self.contacts.iter().filter(|contact| contact.closed_since().is_some());
        closed.filter(of).map(|contact| contact.name.as_str())
    }
}
