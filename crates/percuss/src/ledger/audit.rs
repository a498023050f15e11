//! How well the balances close.

use serde::{Deserialize, Serialize};

use super::numbers::of_numbers;
use super::{Ledger, Measures};
use crate::scalar::Number;

/// Largest magnitudes, over the states of a run, of the balance errors and of the drifts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Audit<S = f64> {
    /// Energy that is missing \[J\].
    pub energy: S,
    /// Linear momentum that is missing \[kg m/s\].
    pub linear: S,
    /// Angular momentum that is missing \[kg m^2/s\].
    pub angular: S,
    /// As [`Measures::curvature_drift`] \[1/m\].
    pub curvature_drift: S,
    /// As [`Measures::membrane_drift`] \[-\].
    pub membrane_drift: S,
    /// As [`Measures::angular_rate_drift`] \[J\].
    pub angular_rate_drift: S,
}

impl<S: Number> Audit<S> {
    /// Enters a state.
    #[inline(always)]
    pub fn take(&mut self, ledger: &Ledger<S>, m: &Measures<S>) {
        let [l1, l2] = ledger.linear_residual(m);
        self.energy = larger(self.energy, ledger.energy_residual(m));
        self.linear = larger(self.linear, l1.hypot(l2));
        self.angular = larger(self.angular, ledger.angular_residual(m));
        self.curvature_drift = larger(self.curvature_drift, m.curvature_drift);
        self.membrane_drift = larger(self.membrane_drift, m.membrane_drift);
        self.angular_rate_drift = larger(self.angular_rate_drift, m.angular_rate_drift);
    }
}

of_numbers! {
    Audit: energy linear angular curvature_drift membrane_drift angular_rate_drift;
}

/// The larger magnitude; NaN is kept, so that an invalid balance cannot look correct.
#[inline(always)]
fn larger<S: Number>(a: S, b: S) -> S {
    let b = b.abs();
    S::choose(a.less(b) | !b.at_most(b), b, a)
}
