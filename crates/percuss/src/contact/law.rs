//! The contact spring of an elastic projectile, defined by its potential `k <p>^2 / 2` of the penetration p.

use crate::model::ContactForce;

/// Potential of the spring at penetration `p` \[J\].
pub fn potential(stiffness: f64, p: f64) -> f64 {
    let p = p.max(0.0);
    0.5 * stiffness * p * p
}

/// Force of the spring at penetration `p` \[N\].
pub fn force(stiffness: f64, p: f64) -> f64 {
    stiffness * p.max(0.0)
}

/// Force over a step and its derivative with respect to the penetration at its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepForce {
    /// Force \[N\].
    pub force: f64,
    /// Derivative with respect to the penetration at the end of the step \[N/m\].
    pub slope: f64,
}

/// Force over a step that starts with penetration `p0` and ends with `p1`.
///
/// Conserving: `(V(p1) - V(p0)) / (p1 - p0)`, whose work is the change of the potential exactly.
/// Midpoint: the force at `(p0 + p1)/2` (the paper, section 2.2).
pub fn step_force(kind: ContactForce, stiffness: f64, p0: f64, p1: f64) -> StepForce {
    match kind {
        ContactForce::Conserving | ContactForce::PlainGradient => conserving(stiffness, p0, p1),
        ContactForce::Midpoint => collocated(stiffness, p0, p1, 0.5),
    }
}

/// Force at `p0 + theta (p1 - p0)`.
pub fn collocated(stiffness: f64, p0: f64, p1: f64, theta: f64) -> StepForce {
    let p = p0 + theta * (p1 - p0);
    StepForce { force: force(stiffness, p), slope: if p > 0.0 { theta * stiffness } else { 0.0 } }
}

fn conserving(stiffness: f64, p0: f64, p1: f64) -> StepForce {
    let (q0, q1) = (p0.max(0.0), p1.max(0.0));
    let half = 0.5 * stiffness;
    if q0 > 0.0 && q1 > 0.0 {
        return StepForce { force: half * (q0 + q1), slope: half };
    }
    if q0 == 0.0 && q1 == 0.0 {
        return StepForce { force: 0.0, slope: 0.0 };
    }
    // Opening or closing: p0 and p1 lie on either side of zero, so p1 - p0 is no difference of close numbers.
    let step = p1 - p0;
    let force = half * (q0 + q1) * ((q1 - q0) / step);
    StepForce { force, slope: (stiffness * q1 - force) / step }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_of_the_conserving_force_is_the_change_of_the_potential() {
        let k = 7.5e5;
        for (p0, p1) in [(0.1, 0.12), (-0.01, 0.02), (0.02, -0.01), (-0.1, -0.2), (0.0, 1e-12)] {
            let work = step_force(ContactForce::Conserving, k, p0, p1).force * (p1 - p0);
            let change = potential(k, p1) - potential(k, p0);
            assert!((work - change).abs() <= 1e-15 * k * p0.abs().max(p1.abs()).powi(2));
        }
    }

    #[test]
    fn slopes_are_derivatives() {
        let k = 7.5e5;
        for kind in [ContactForce::Conserving, ContactForce::Midpoint] {
            for (p0, p1) in [(0.1, 0.12), (-0.01, 0.02), (0.02, -0.01), (-0.1, -0.2)] {
                let f = |p1: f64| step_force(kind, k, p0, p1).force;
                let difference = (f(p1 + 1e-6) - f(p1 - 1e-6)) / 2e-6;
                let slope = step_force(kind, k, p0, p1).slope;
                assert!((slope - difference).abs() < 1e-6 * k, "{kind:?} {p0} {p1}");
            }
        }
    }
}
