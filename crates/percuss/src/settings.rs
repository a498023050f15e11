//! Settings of a transient analysis.

#[doc(hidden)]
pub use crate::model::SAME_INSTANT;
use crate::model::{Fault, Model};

/// Largest number of periods of a load or a motion in a step. From half a period on a step represents only its mean; beyond this limit a unit is
/// probably wrong, and far beyond it the phase of the function is round-off.
const MOST_PERIODS: f64 = 1000.0;
/// Least and largest accuracy that steps are chosen for.
const ACCURACIES: [f64; 2] = [1e-6, 0.2];

/// Time integration scheme.
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

/// Resolution of impacts of rigid projectiles in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ImpactResolution {
    /// The instant of contact is located and the impulse acts in a very short step of its own.
    Event,
    /// The gap is evaluated once per step (the paper).
    TimeStepping {
        /// A gap at or below this counts as closed \[m\].
        closed_tolerance: f64,
    },
}

impl ImpactResolution {
    /// Default of [`ImpactResolution::TimeStepping::closed_tolerance`] \[m\].
    pub const CLOSED_TOLERANCE: f64 = 1e-9;
}

/// Law of impacts on several touching bodies, in [`ImpactResolution::Event`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MultipleImpacts {
    /// All contacts obey the impact law together: one problem for all impulses.
    #[default]
    Simultaneous,
    /// One after another, the fastest approach first: a sequence of impacts from body to body. Equally fast ones are simultaneous.
    Sequential,
}

/// Configuration in which a transient analysis starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Start {
    /// The stress-free reference configuration.
    #[default]
    Reference,
    /// Static equilibrium under the loads that act at time zero.
    Static,
}

/// Settings of a transient analysis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Time at which the analysis ends \[s\].
    pub end: f64,
    /// Time step \[s\]; the first one for a requested accuracy.
    pub step: f64,
    /// Accuracy of peak forces and deflections, relative, for which steps are chosen; all are of the size given if it is none.
    pub accuracy: Option<f64>,
    /// Time integration scheme.
    pub scheme: Scheme,
    /// Resolution of impacts of rigid projectiles.
    pub impacts: ImpactResolution,
    /// Law of impacts on several touching bodies.
    pub multiple_impacts: MultipleImpacts,
    /// Number of steps between recorded rows (impacts are always recorded).
    pub record_every: usize,
    /// Configuration at time zero.
    pub start: Start,
}

impl Settings {
    /// Default settings for a run up to `end` with steps of `step`.
    pub fn new(end: f64, step: f64) -> Self {
        Self {
            end,
            step,
            accuracy: None,
            scheme: Scheme::default(),
            impacts: ImpactResolution::Event,
            multiple_impacts: MultipleImpacts::Simultaneous,
            record_every: 1,
            start: Start::Reference,
        }
    }

    /// Number of steps of the given size up to the end; the last one may be shorter.
    pub fn step_count(&self) -> usize {
        let ratio = self.end / self.step;
        (ratio - SAME_INSTANT * ratio.max(1.0)).ceil().max(1.0) as usize
    }

    /// Instant at which a number of steps are done \[s\].
    #[doc(hidden)]
    pub fn instant(&self, steps: usize) -> f64 {
        (steps as f64 * self.step).min(self.end)
    }

    /// Size of the step that follows a number of steps \[s\]: the given one, or the remaining time.
    #[doc(hidden)]
    pub fn size_behind(&self, steps: usize) -> f64 {
        let size = self.step.min(self.end - steps as f64 * self.step);
        if (size - self.step).abs() <= SAME_INSTANT * self.step { self.step } else { size }
    }
}

impl Settings {
    /// Every fault of the settings for `model`; paths are those of the scenario file (`time.step`).
    pub fn validate(&self, model: &Model) -> Vec<Fault> {
        let mut out = Vec::new();
        let mut add = |path: &str, found: String, expected: &str| {
            out.push(Fault::new(path, found, expected));
        };
        let positive = |x: f64| x > 0.0 && x.is_finite();
        if !positive(self.end) {
            add("time.end", format!("{} s", self.end), "an end after time zero");
        }
        if self.accuracy.is_some() && !positive(self.end) {
            // The first step follows from the end.
        } else if !positive(self.step) {
            add("time.step", format!("{} s", self.step), "a step above zero");
        } else if positive(self.end) && self.step > self.end * (1.0 + 1e-9) {
            let found = format!("a step of {} s, longer than the run of {} s", self.step, self.end);
            add("time.step", found, "a step no longer than the run");
        } else if self.end / self.step > 1e12 {
            let found = format!("{:.3e} steps", self.end / self.step);
            add("time.step", found, "a run of at most 1e12 steps");
        }
        if let Some(accuracy) = self.accuracy {
            self.validate_accuracy(accuracy, &mut add);
        }
        if positive(self.step) {
            self.validate_frequencies(model, &mut add);
        }
        if self.record_every == 0 {
            add("record.every", "0".into(), "a row every 1 or more steps");
        }
        if let ImpactResolution::TimeStepping { closed_tolerance } = self.impacts
            && !(closed_tolerance >= 0.0 && closed_tolerance.is_finite())
        {
            let found = format!("{closed_tolerance} m");
            add("time.closed_tolerance", found, "a length of zero or above");
        }
        let located = self.impacts == ImpactResolution::Event;
        if self.multiple_impacts == MultipleImpacts::Sequential && !located {
            let found = "sequential multiple impacts, with a gap that is evaluated once per step";
            let expected = "impacts = \"event\", or multiple_impacts = \"simultaneous\": \
                            a sequence of impacts needs its instant";
            add("time.multiple_impacts", found.into(), expected);
        }
        if let Scheme::GeneralizedAlpha { spectral_radius } = self.scheme
            && !(0.0..=1.0).contains(&spectral_radius)
        {
            let found = spectral_radius.to_string();
            add("integrator.spectral_radius", found, "a radius from 0 to 1");
        }
        if self.scheme != Scheme::EnergyMomentum && model.is_inelastic() {
            let found = "a scheme other than energy-momentum, with yielding, tension-only, \
                         compression-only or fibre sections";
            let expected = "energy-momentum: the work of plastic flow is exact only in it";
            add("integrator.scheme", found.into(), expected);
        }
        if self.scheme != Scheme::EnergyMomentum && model.has_shear() {
            let found = "a scheme other than energy-momentum, with shear-flexible beams";
            let expected = "energy-momentum: no other scheme has their unit vectors";
            add("integrator.scheme", found.into(), expected);
        }
        if self.scheme != Scheme::EnergyMomentum && model.crushes() {
            let found = "a scheme other than energy-momentum, with a contact that crushes";
            let expected = "energy-momentum: the work of crushing is exact only in it";
            add("integrator.scheme", found.into(), expected);
        }
        if self.scheme.advances_accelerations() && model.has_tied_bodies() {
            let found = "a scheme that advances accelerations, with a spring at a projectile";
            let expected = "energy-momentum, strain-rate or midpoint";
            add("integrator.scheme", found.into(), expected);
        }
        if self.scheme.advances_accelerations() && model.has_rigid_contact() {
            let found = "a scheme that advances accelerations, with a rigid contact";
            let expected = "energy-momentum, strain-rate or midpoint: \
                            an impulse has no acceleration";
            add("integrator.scheme", found.into(), expected);
        }
        if self.scheme.advances_accelerations() && model.has_viscous_parts() {
            let found = "a scheme that advances accelerations, with viscous or modal damping";
            let expected = "energy-momentum, strain-rate or midpoint: \
                            their damping work is exact in the balance";
            add("integrator.scheme", found.into(), expected);
        }
        out
    }
}

impl Settings {
    /// Loads and motions with too many periods in a step to be resolved.
    fn validate_frequencies(&self, model: &Model, add: &mut dyn FnMut(&str, String, &str)) {
        let loads = model.loads.iter().map(|load| (format!("load.{}", load.name), &load.function));
        let motions = model.supports.iter().filter_map(|support| {
            let kind = if support.point.is_some() { "support" } else { "obstacle" };
            let function = &model.motions[support.motion?];
            Some((format!("{kind}.{}.motion", support.name), function))
        });
        for (path, function) in loads.chain(motions) {
            let (frequency, most) = (function.frequency(), MOST_PERIODS / self.step);
            if frequency > most {
                let periods = frequency * self.step;
                let found = format!("{frequency:e} Hz, {periods:.1e} periods in a step");
                let expected = format!("at most {MOST_PERIODS} periods in a step: {most:e} Hz");
                add(&format!("{path}.function"), found, &expected);
            }
        }
    }

    /// Faults of an accuracy in place of a step.
    fn validate_accuracy(&self, accuracy: f64, add: &mut dyn FnMut(&str, String, &str)) {
        let path = "time.accuracy";
        let [least, most] = ACCURACIES;
        if !(least..=most).contains(&accuracy) {
            add(path, accuracy.to_string(), "an accuracy from 1e-6 to 0.2");
        }
        if self.impacts != ImpactResolution::Event {
            let found = "an accuracy, with a gap that is evaluated once per step";
            let expected = "impacts = \"event\", or a step: the paper's impacts depend on its size";
            add(path, found.into(), expected);
        }
        if self.scheme.advances_accelerations() {
            let found = "an accuracy, with a scheme that advances accelerations";
            let expected = "energy-momentum, strain-rate or midpoint, or a step: \
                            accelerations carried over belong to steps of one size";
            add(path, found.into(), expected);
        }
    }
}

impl Scheme {
    /// Whether the scheme carries nodal accelerations from step to step (Newmark's family).
    pub fn advances_accelerations(self) -> bool {
        matches!(self, Self::Newmark | Self::GeneralizedAlpha { .. })
    }
}

/// Settings of an equilibrium path by arc length.
#[derive(Clone, Debug, PartialEq)]
pub struct PathSettings {
    /// Load factor of the first point; the arc that leads there is the longest at limit points. Elsewhere the length of arcs is adapted to the
    /// number of corrections.
    pub first: f64,
    /// Most points.
    pub points: usize,
    /// Further condition that ends the path.
    pub end: PathEnd,
}

/// Condition that ends an equilibrium path.
#[derive(Clone, Debug, PartialEq)]
pub enum PathEnd {
    /// A load factor reached for the first time.
    Factor(f64),
    /// A displacement reached.
    Displacement {
        /// Label of a recorded point.
        point: String,
        /// Component, 1 or 2.
        component: usize,
        /// Displacement \[m\].
        value: f64,
    },
}

impl Default for PathSettings {
    fn default() -> Self {
        Self { first: 0.05, points: 500, end: PathEnd::Factor(1.0) }
    }
}
