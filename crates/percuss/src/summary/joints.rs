//! Results of joints of a given strength.

use serde::{Deserialize, Serialize};

use super::peak::Peak;

/// A joint that parted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointParting {
    /// End of the step of its failure; the start of a run from an equilibrium in which it is torn \[s\].
    pub time: f64,
    /// Size of the force that it carried over that step, the mean; NaN at the start \[N\].
    pub force: f64,
    /// Size of the moment likewise; zero of a hinge, NaN at the start \[N m\].
    pub moment: f64,
}

/// Result of a joint of a given strength.
#[derive(Clone, Debug, PartialEq)]
pub struct JointSummary {
    /// Its name.
    pub name: String,
    /// Largest force that it carried, the mean over a step without impulses, and the end of that step \[N\].
    pub force_max: Peak,
    /// Largest moment likewise; zero of a hinge \[N m\].
    pub moment_max: Peak,
    /// Time and load of its failure, if it failed.
    pub parted: Option<JointParting>,
}
