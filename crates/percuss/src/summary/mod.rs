//! What a run amounts to. Unset results are NaN.

mod contact;
mod forces;
mod joints;
mod peak;
mod plastic;
mod step_control;

pub use contact::*;
pub use forces::*;
pub use joints::*;
pub use peak::Peak;
pub use plastic::*;
pub use step_control::*;

use crate::error::Error;

/// How a run ended.
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
    /// Gave up; everything up to the last accepted step is recorded.
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
    /// Energy lost in impacts.
    pub loss_impacts: f64,
    /// Energy taken by damping and in smooth contacts that dissipate; [`RunSummary::loss_contacts`] tells the two apart.
    pub loss_damping: f64,
    /// Energy dissipated by plastic flow in the run, what a preload dissipated before it left out.
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

/// What the scheme carries beside the motion of the nodes, and how far the two have come apart.
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
    /// Where [`Self::angular_rate_drift_max`] is more than this, the step does not resolve the motion.
    pub const UNRESOLVED: f64 = 0.01;
}

/// What became of a projectile, guided or free.
#[derive(Clone, Debug, PartialEq)]
pub struct ProjectileSummary {
    /// The user's name for it.
    pub name: String,
    /// Unit vector of its line of flight, from it to the beam, shape (2) \[-\]; none of a free one.
    pub direction: Option<[f64; 2]>,
    /// Name of the point that it strikes; none of a free one.
    pub strikes: Option<String>,
    /// Velocity at the end, shape (2) \[m/s\].
    pub velocity_final: [f64; 2],
    /// Angular velocity at the end \[rad/s\]; zero for a guided one.
    pub spin_final: f64,
    /// Impulse that it gave to others through its contacts, along its line of flight or its initial velocity: what it lost to them, loads
    /// left out. Of a free body at rest at the start the magnitude, negative: it can only receive \[N s\].
    pub momentum_transferred: f64,
    /// Energy that its contacts took from it, negative if they gave it some; loads and losses inside it left out \[J\].
    pub energy_given: f64,
    /// Work that these contacts did on whatever it touched \[J\]: less than what it gave by what was lost in them, and by what their springs
    /// still hold.
    pub energy_received_by_others: f64,
}

/// The result of a run.
#[derive(Debug)]
pub struct RunSummary {
    /// How it ended.
    pub termination: Termination,
    /// Time reached \[s\].
    pub time: f64,
    /// Steps of the given size completed.
    pub steps: usize,
    /// Steps of the solver, trial and shortened ones included.
    pub solver_steps: usize,
    /// Times a step was cut because Newton's iteration failed.
    pub step_cuts: usize,
    /// Steps with more impacts than are followed one by one: in the rest of each, what struck did so without restitution.
    pub accumulated_steps: usize,
    /// Newton iterations. Runs side by side need others than runs alone: these two tell of the solver, not of the run.
    pub newton_iterations: usize,
    /// Factorisations of the tangent.
    pub factorizations: usize,
    /// Rows recorded.
    pub rows: usize,
    /// Sizes of steps, where an accuracy was asked for in place of one.
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
    /// Blows that several touching bodies shared.
    pub shared_blows: SharedBlows,
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
    /// One entry a joint of a given strength, in the model's order, shape (such joints).
    pub joints: Vec<JointSummary>,
}

impl RunSummary {
    /// Energy that smooth contacts took, by their dissipation and by what crushed in them: a part of [`EnergySummary::loss_damping`]
    /// \[J\]. Of a contact with more than [`ContactRecord::IMPACTS_KEPT`] intervals it is that of the intervals kept.
    pub fn loss_contacts(&self) -> f64 {
        let smooth = self.contacts.iter().filter_map(|contact| match &contact.record {
            ContactRecord::Smooth { intervals, .. } => Some(intervals),
            ContactRecord::Nonsmooth { .. } => None,
        });
        smooth.flatten().map(|interval| interval.energy.lost).sum()
    }
}

impl RunSummary {
    /// Names of the contacts of something that are still closed at the end of the run: those that carry its name, and those that it takes
    /// part in.
    pub fn still_touches<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a str> {
        let of = move |contact: &&ContactSummary| {
            contact.name == name || contact.between.iter().any(|one| one == name)
        };
        let closed = self.contacts.iter().filter(|contact| contact.closed_since().is_some());
        closed.filter(of).map(|contact| contact.name.as_str())
    }
}
