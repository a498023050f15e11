//! What a run amounts to. Unset results are NaN.

use crate::contact::effective_mass::EffectiveMass;
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

/// A largest value and when it occurred.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// The value of largest magnitude, signed.
    pub value: f64,
    /// Its time \[s\].
    pub time: f64,
}

impl Default for Peak {
    fn default() -> Self {
        Self { value: f64::NAN, time: f64::NAN }
    }
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
    /// Largest energy in play, the scale of `residual_max`.
    pub scale: f64,
    /// Largest magnitude of the energy residual, relative to `scale`.
    pub residual_max: f64,
}

/// Momentum residuals of a run, support and load impulses taken into the books.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentumSummary {
    /// Largest linear momentum in play \[kg m/s\], the scale of `linear_residual_max`.
    pub linear_scale: f64,
    /// Largest magnitude of the residual of linear momentum, relative.
    pub linear_residual_max: f64,
    /// Largest angular momentum in play \[kg m^2/s\], the scale of `angular_residual_max`.
    pub angular_scale: f64,
    /// Largest magnitude of the residual of angular momentum about the origin, relative.
    pub angular_residual_max: f64,
}

/// Distance of stored strains from the configuration (non-zero for the strain-rate scheme only).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AuditSummary {
    /// Largest distance of the stored bending strain from that of the configuration \[1/m\].
    pub curvature_drift_max: f64,
    /// Largest distance of the stored membrane strain from that of the configuration \[1\].
    pub membrane_drift_max: f64,
}

/// What became of a projectile.
#[derive(Clone, Debug, PartialEq)]
pub struct ProjectileSummary {
    /// The user's name for it.
    pub name: String,
    /// Velocity at the end \[m/s\].
    pub velocity_final: [f64; 2],
    /// Momentum given away, along the line of flight \[kg m/s\].
    pub momentum_transferred: f64,
    /// Kinetic energy given away \[J\].
    pub energy_transferred: f64,
}

/// One closed interval of a smooth contact, resolved within the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactInterval {
    /// Start \[s\].
    pub start: f64,
    /// End \[s\]; NaN if still closed at the end of the run.
    pub end: f64,
    /// Impulse handed over in it \[N s\].
    pub impulse: f64,
}

/// One impact of a rigid projectile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Time \[s\].
    pub time: f64,
    /// Impulse \[N s\].
    pub impulse: f64,
    /// Relative velocity before, positive when approaching \[m/s\].
    pub approach_velocity: f64,
    /// Relative velocity after, positive when separating \[m/s\].
    pub separation_velocity: f64,
    /// Energy lost \[J\].
    pub energy_lost: f64,
}

/// What happened between a projectile and the point it strikes.
#[derive(Clone, Debug, PartialEq)]
pub enum ContactRecord {
    /// Of an elastic projectile.
    Smooth {
        /// Largest force \[N\].
        peak_force: Peak,
        /// Closed intervals.
        intervals: Vec<ContactInterval>,
    },
    /// Of a rigid projectile.
    Nonsmooth {
        /// Impacts, in order; the first [`ContactRecord::IMPACTS_KEPT`] of them.
        impacts: Vec<Impact>,
        /// Number of impacts, kept or not.
        impact_count: usize,
        /// Impulse of all impacts and of persistent contact \[N s\].
        impulse_total: f64,
        /// Intervals in which the contact stayed closed (persistent contact); impulse included.
        intervals: Vec<ContactInterval>,
    },
}

impl ContactRecord {
    /// So many impacts (or intervals) of one contact are kept in the summary, so that memory does not grow with the run.
    pub const IMPACTS_KEPT: usize = 10_000;
}

/// Contact of one projectile.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSummary {
    /// The projectile's name.
    pub name: String,
    /// Effective mass of the struck point.
    pub effective_mass: EffectiveMass,
    /// What happened.
    pub record: ContactRecord,
}

/// Extremes of a recorded point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointSummary {
    /// The user's words for it.
    pub name: String,
    /// Displacements of largest magnitude, signed, per component.
    pub displacement_max: [Peak; 2],
}

/// A largest section force, where and when it occurred.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionPeak {
    /// The value of largest magnitude, signed.
    pub value: f64,
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Its time \[s\].
    pub time: f64,
}

impl Default for SectionPeak {
    fn default() -> Self {
        Self { value: f64::NAN, s: f64::NAN, time: f64::NAN }
    }
}

/// Largest section forces of a beam, over its length and over time.
///
/// True resultants. The moment is extrapolated linearly from the Gauss points of an element to its ends, the axial force is the
/// mean over an element, the shear force follows from the moment's slope, `-M' / nu`, without the share of rotary inertia.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionForceSummary {
    /// The beam's name.
    pub name: String,
    /// Axial force, positive in tension \[N\].
    pub axial_max: SectionPeak,
    /// Shear force \[N\].
    pub shear_max: SectionPeak,
    /// Bending moment, positive where it turns the tangent counter-clockwise along the beam \[N m\].
    pub moment_max: SectionPeak,
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
    /// Newton iterations.
    pub newton_iterations: usize,
    /// Factorisations of the tangent.
    pub factorizations: usize,
    /// Rows recorded.
    pub rows: usize,
    /// Energies.
    pub energy: EnergySummary,
    /// Momenta.
    pub momentum: MomentumSummary,
    /// Drift of stored strains.
    pub audit: AuditSummary,
    /// One entry a projectile, in the model's order.
    pub projectiles: Vec<ProjectileSummary>,
    /// One entry a projectile, in the model's order.
    pub contacts: Vec<ContactSummary>,
    /// One entry a recorded point.
    pub points: Vec<PointSummary>,
    /// One entry a beam.
    pub section_forces: Vec<SectionForceSummary>,
}
