//! How a transient analysis is carried out.

/// Time integration scheme (theory, section 3).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Scheme {
    /// Energy-momentum through invariants: no strain history, conserves energy and both momenta.
    #[default]
    EnergyMomentum,
    /// Energy-momentum with strains advanced by their midpoint rates (the paper, eq. 5).
    StrainRate,
    /// Implicit midpoint rule.
    Midpoint,
    /// Newmark's average acceleration (1/4, 1/2).
    Newmark,
    /// Generalized-alpha (Chung and Hulbert 1993).
    GeneralizedAlpha {
        /// Spectral radius at infinite frequency, in \[0, 1\].
        spectral_radius: f64,
    },
}

/// How impacts of rigid projectiles are resolved in time (theory, section 5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ImpactResolution {
    /// The instant of contact is located and the impulse acts in a very short step of its own.
    Event,
    /// The gap is looked at once per step (the paper).
    TimeStepping {
        /// A gap at or below this counts as closed \[m\].
        closed_tolerance: f64,
    },
}

impl ImpactResolution {
    /// Default of [`ImpactResolution::TimeStepping::closed_tolerance`] \[m\].
    pub const CLOSED_TOLERANCE: f64 = 1e-9;
}

/// Settings of a transient analysis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Time at which the analysis ends \[s\].
    pub end: f64,
    /// Time step \[s\].
    pub step: f64,
    /// Time integration scheme.
    pub scheme: Scheme,
    /// Resolution of impacts of rigid projectiles.
    pub impacts: ImpactResolution,
    /// A row is recorded every so many steps (and at every impact).
    pub record_every: usize,
}

impl Settings {
    /// Default settings for a run up to `end` with steps of `step`.
    pub fn new(end: f64, step: f64) -> Self {
        Self {
            end,
            step,
            scheme: Scheme::default(),
            impacts: ImpactResolution::Event,
            record_every: 1,
        }
    }
}
