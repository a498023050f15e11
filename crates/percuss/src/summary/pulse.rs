//! How well steps resolve the largest force of a contact, a stop or a spring.

use super::peak::Peak;

/// What has the force.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PulseOf {
    /// A contact under a smooth law, by its number in [`RunSummary::contacts`](super::RunSummary::contacts).
    Contact(usize),
    /// A stop, by the name of the support.
    Stop(String),
    /// A spring that acts on one side or along a table, by its name.
    Spring(String),
}

/// The largest force of a contact, a stop or a spring that can be open or slack, and the steps about it.
#[derive(Clone, Debug, PartialEq)]
pub struct PulseSummary {
    /// What has it.
    pub of: PulseOf,
    /// Largest force, of a contact the mean over a step, of others at the end of one \[N\].
    pub force: Peak,
    /// Work of this force over the deformation with it, half their product \[J\]; NaN of contacts.
    pub energy: f64,
    /// Steps of the half wave with the bend that the force has about its largest value, at least one; infinite where it is straight there,
    /// NaN where too few steps follow or it was never closed \[-\].
    pub steps: f64,
    /// Size of these steps \[s\]; NaN with them.
    pub step: f64,
    /// Duration of the closed interval by its impulse, closing velocity and stiffness, `pi sqrt(J / (2 v k))`: the half period of the mass
    /// `J / (2 v)`, which rebounds with the same velocity, on the spring; NaN of contacts, and where it was closed from the start \[s\].
    pub lasts: f64,
}
