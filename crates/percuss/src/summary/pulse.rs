//! How well steps resolve the largest force of a contact, a stop, a spring or a foundation, and whether it is final.

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
    /// A foundation of compression alone or along a table, by its name.
    Foundation(String),
}

/// The largest force of a contact, or of a stop, a spring or a foundation that can be open or slack, and the steps about it. Of a foundation it is
/// the place with the largest reaction per length.
#[derive(Clone, Debug, PartialEq)]
pub struct PulseSummary {
    /// What has it.
    pub of: PulseOf,
    /// Largest force, of a contact the mean over a step, of others at the end of one \[N\]; of a foundation per length \[N/m\].
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
    /// Largest force to which a damper jumped where a gap closed or a rope tautened, `c v` with the closing velocity v, and when: at the end of the
    /// step it has fallen already \[N\], of a foundation per length \[N/m\]. NaN without damper, and of contacts.
    pub onset: Peak,
    /// Duration of a constant force as large as this one with the impulse of the closed interval: it falls within that time \[s\]; NaN with it.
    pub falls: f64,
    /// Time of the last closing, if it is closed at the end of the run with the largest force since then: more may follow \[s\]. NaN otherwise, where
    /// it bears from the start on, and of contacts, see [`ContactSummary::cut_short`](super::ContactSummary::cut_short).
    pub rises_since: f64,
}
