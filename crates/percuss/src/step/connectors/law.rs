//! The law of a spring: its energy, and its force over a step.

use crate::contact::law::{ForceCurve, PowerLaw};
use crate::model::frozen::ConnectorLaw;
use crate::scalar::Number;

#[doc(hidden)]
impl<S: Number> ConnectorLaw<S> {
    /// Potential at a value of the coordinate \[J\].
    #[inline(always)]
    pub fn energy(self, q: S) -> S {
        let extension = q - self.free();
        match self {
            Self::Linear { stiffness, .. } => PowerLaw::Linear(stiffness).energy(extension),
            Self::OneSided { stiffness, .. } => {
                PowerLaw::Linear(stiffness).energy(extension.max(q.constant(0.0)))
            }
        }
    }

    /// Force over a step from `q0` by `change`, the difference quotient of the potential (theory, section 4), and its slope by the end.
    #[inline(always)]
    pub fn quotient(self, q0: S, change: S) -> [S; 2] {
        match self {
            Self::Linear { .. } => self.collocated(q0, change, 0.5),
            Self::OneSided { stiffness, gap } => {
                PowerLaw::Linear(stiffness).quotient(q0 - gap, q0 - gap + change)
            }
        }
    }

    /// Force after the share `theta` of a step, and its slope by the end of the step.
    #[inline(always)]
    pub fn collocated(self, q0: S, change: S, theta: f64) -> [S; 2] {
        match self {
            Self::Linear { stiffness, rest } => {
                [stiffness * (q0 + change * theta - rest), stiffness * theta]
            }
            Self::OneSided { stiffness, gap } => {
                let zero = q0.constant(0.0);
                let p0 = q0 - gap;
                let p = p0 + (p0 + change - p0) * theta;
                let presses = zero.less(p);
                [
                    S::choose(presses, stiffness * p, zero),
                    S::choose(presses, stiffness * theta, zero),
                ]
            }
        }
    }
}
