//! Smooth contact laws: a potential of the penetration p, and additional dissipation.

use crate::math::hermite::{GAUSS_WEIGHTS, gauss_points};
use crate::model::{ContactForce, Potential, PotentialFunction, SmoothLaw};
use crate::scalar::Number;

/// Force over a step and its derivative with respect to the penetration at its end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepForce {
    /// Force \[N\].
    pub force: f64,
    /// Its dissipative part \[N\].
    pub dissipated: f64,
    /// Derivative with respect to the penetration at the end of the step \[N/m\].
    pub slope: f64,
}

/// A force as a function of the penetration, given for non-negative penetration, and zero without penetration.
pub trait ForceCurve<S: Number> {
    /// Force at a penetration \[N\].
    fn at(&self, p: S) -> S;
    /// Its slope at a penetration above zero \[N/m\].
    fn slope(&self, p: S) -> S;
    /// `(V(q1) - V(q0)) / (q1 - q0)` with its potential V, without subtracting potentials \[N\]; one of the two is above zero.
    fn mean(&self, q0: S, q1: S) -> S;

    /// Force over a step from penetration `p0` to `p1`, and its slope by `p1`: in place of `F = R1 p` of the paper's eq. (3) the difference
    /// quotient `(V(p1) - V(p0)) / (p1 - p0)` of the potential, which vanishes without penetration (theory, page 3).
    #[inline(always)]
    fn quotient(&self, p0: S, p1: S) -> [S; 2] {
        let zero = p1.constant(0.0);
        let (q0, q1) = (p0.max(zero), p1.max(zero));
        let (sum, step) = (q0 + q1, p1 - p0);
        let touches = !sum.at_most(zero);
        // Share of the path over the step with penetration.
        let opens = p0.less(zero) | p1.less(zero);
        let force = || {
            let share = S::either(opens, || (q1 - q0) / step, || p1.constant(1.0));
            self.mean(q0, q1) * share
        };
        let force = S::either(touches, force, || zero);
        let close = step.abs().at_most(sum * CLOSE);
        let slope = || {
            let near = || self.slope(sum * 0.5) * 0.5;
            S::either(close, near, || (self.at(q1) - force) / step)
        };
        [force, S::either(touches, slope, || zero)]
    }
}

/// A force in proportion to a power of the penetration.
#[derive(Clone, Copy, Debug)]
pub enum PowerLaw<S> {
    /// `k p`, of a stiffness \[N/m\].
    Linear(S),
    /// `K p^(3/2)` (Hertz) \[N/m^1.5\].
    Hertz(S),
}

impl<S: Number> PowerLaw<S> {
    /// Potential at a penetration that is not negative \[J\].
    #[inline(always)]
    pub fn energy(self, p: S) -> S {
        match self {
            Self::Linear(stiffness) => stiffness * 0.5 * p * p,
            Self::Hertz(stiffness) => stiffness * 0.4 * p * p * p.sqrt(),
        }
    }
}

impl<S: Number> ForceCurve<S> for PowerLaw<S> {
    #[inline(always)]
    fn at(&self, p: S) -> S {
        match *self {
            Self::Linear(stiffness) => stiffness * p,
            Self::Hertz(stiffness) => stiffness * p * p.sqrt(),
        }
    }

    #[inline(always)]
    fn slope(&self, p: S) -> S {
        match *self {
            Self::Linear(stiffness) => stiffness,
            Self::Hertz(stiffness) => stiffness * 1.5 * p.sqrt(),
        }
    }

    #[inline(always)]
    fn mean(&self, q0: S, q1: S) -> S {
        match *self {
            Self::Linear(stiffness) => stiffness * 0.5 * (q0 + q1),
            Self::Hertz(stiffness) => {
                // (a^5 - b^5) / (a^2 - b^2), divided out.
                let (a, b) = (q1.sqrt(), q0.sqrt());
                let (a2, ab, b2) = (a * a, a * b, b * b);
                stiffness * 0.4 * (a2 * a2 + ab * (a2 + ab + b2) + b2 * b2) / (a + b)
            }
        }
    }
}

impl ForceCurve<f64> for Potential {
    fn at(&self, p: f64) -> f64 {
        match self {
            Self::Linear { stiffness } => PowerLaw::Linear(*stiffness).at(p),
            Self::Hertz { stiffness } => PowerLaw::Hertz(*stiffness).at(p),
            Self::Table { penetration, force } => line(penetration, force, p),
            Self::Function(own) => (own.force)(p),
        }
    }

    fn slope(&self, p: f64) -> f64 {
        match self {
            Self::Linear { stiffness } => PowerLaw::Linear(*stiffness).slope(p),
            Self::Hertz { stiffness } => PowerLaw::Hertz(*stiffness).slope(p),
            Self::Table { penetration, force } => {
                let k = interval(penetration, p);
                (force[k + 1] - force[k]) / (penetration[k + 1] - penetration[k])
            }
            Self::Function(own) => {
                let e = 1e-6 * p;
                ((own.force)(p + e) - (own.force)(p - e)) / (2.0 * e)
            }
        }
    }

    fn mean(&self, q0: f64, q1: f64) -> f64 {
        match self {
            Self::Linear { stiffness } => PowerLaw::Linear(*stiffness).mean(q0, q1),
            Self::Hertz { stiffness } => PowerLaw::Hertz(*stiffness).mean(q0, q1),
            Self::Table { penetration, force } => {
                let (low, high) = (q0.min(q1), q0.max(q1));
                if high == low {
                    return line(penetration, force, low);
                }
                let (first, last) = (interval(penetration, low), interval(penetration, high));
                let mut sum = 0.0;
                for k in first..=last {
                    let a = if k == first { low } else { penetration[k] };
                    let b = if k == last { high } else { penetration[k + 1] };
                    let f = |p| line(penetration, force, p);
                    sum += 0.5 * (b - a) / (high - low) * (f(a) + f(b));
                }
                sum
            }
            Self::Function(own) => own.mean_force(q0, q1),
        }
    }
}

impl Potential {
    /// Potential at penetration `p` \[J\].
    pub fn energy(&self, p: f64) -> f64 {
        let p = p.max(0.0);
        match self {
            Self::Linear { stiffness } => PowerLaw::Linear(*stiffness).energy(p),
            Self::Hertz { stiffness } => PowerLaw::Hertz(*stiffness).energy(p),
            Self::Table { .. } => p * self.mean(0.0, p),
            Self::Function(own) => (own.energy)(p) - own.rest,
        }
    }

    /// Force at penetration `p` \[N\].
    pub fn force(&self, p: f64) -> f64 {
        self.at(p.max(0.0))
    }

    /// Stiffness at penetration `p` \[N/m\]; zero outside.
    pub fn stiffness(&self, p: f64) -> f64 {
        if p <= 0.0 { 0.0 } else { self.slope(p) }
    }

    /// Force over a step from penetration `p0` to `p1`: the difference quotient of the potential.
    pub fn quotient(&self, p0: f64, p1: f64) -> StepForce {
        let [force, slope] = ForceCurve::quotient(self, p0, p1);
        StepForce { force, dissipated: 0.0, slope }
    }

    /// Force at `p0 + theta (p1 - p0)`.
    pub fn collocated(&self, p0: f64, p1: f64, theta: f64) -> StepForce {
        let p = p0 + theta * (p1 - p0);
        StepForce { force: self.force(p), dissipated: 0.0, slope: theta * self.stiffness(p) }
    }
}

/// Penetrations closer to each other than this share of their sum are not subtracted.
pub(super) const CLOSE: f64 = 1e-6;
/// Difference of two potentials that rounding can cause, relative to the larger one.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

impl PotentialFunction {
    /// The difference quotient of the energies; if it differs from the mean force only by rounding, the mean force, which does the same work
    /// without loss of digits in short steps \[N\].
    fn mean_force(&self, q0: f64, q1: f64) -> f64 {
        let step = q1 - q0;
        let points = gauss_points().into_iter().zip(GAUSS_WEIGHTS);
        let mean: f64 = points.map(|(x, w)| w * (self.force)(q0 + x * step)).sum();
        if step.abs() <= CLOSE * (q0 + q1) {
            return mean;
        }
        let (a, b) = ((self.energy)(q0) - self.rest, (self.energy)(q1) - self.rest);
        let rounding = ROUNDING * (a.abs().max(b.abs()) + self.rest.abs());
        if (b - a - mean * step).abs() <= rounding { mean } else { (b - a) / step }
    }
}

/// The interval of a table that contains `p`; the last one is unbounded.
fn interval(penetration: &[f64], p: f64) -> usize {
    penetration.partition_point(|x| *x <= p).clamp(1, penetration.len() - 1) - 1
}

fn line(penetration: &[f64], force: &[f64], p: f64) -> f64 {
    let k = interval(penetration, p);
    let slope = (force[k + 1] - force[k]) / (penetration[k + 1] - penetration[k]);
    force[k] + slope * (p - penetration[k])
}

impl SmoothLaw {
    /// Force over a step of size `h` from penetration `p0` to `p1` of the midpoint family; `deepest` is the deepest penetration so far, for laws
    /// with crushing \[m\].
    ///
    /// The dissipative part is `f chi (p1 - p0) / h` with f the elastic force of the same step; the sum is limited to compression. Its work is
    /// never negative.
    pub fn step_force(&self, [p0, p1]: [f64; 2], deepest: f64, h: f64) -> StepForce {
        let elastic = match (self.unloading, self.force) {
            (Some(slope), _) => self.crushing(slope, [p0, p1], deepest),
            (None, ContactForce::Midpoint) => self.potential.collocated(p0, p1, 0.5),
            (None, _) => self.potential.quotient(p0, p1),
        };
        if self.dissipation == 0.0 {
            return elastic;
        }
        let rate = self.dissipation / h;
        let factor = 1.0 + rate * (p1 - p0);
        if factor <= 0.0 {
            let dissipated = elastic.dissipated - elastic.force;
            return StepForce { force: 0.0, dissipated, slope: 0.0 };
        }
        StepForce {
            force: elastic.force * factor,
            dissipated: elastic.dissipated + elastic.force * (factor - 1.0),
            slope: elastic.slope * factor + elastic.force * rate,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn potentials() -> [Potential; 5] {
        [
            Potential::Linear { stiffness: 7.5e5 },
            Potential::Hertz { stiffness: 2e6 },
            Potential::Table {
                penetration: vec![0.0, 0.01, 0.05, 0.06],
                force: vec![0.0, 2e3, 5e3, 2e4],
            },
            Potential::function(|p| 1e6 * p.powi(3), |p| 3e6 * p * p),
            Potential::function(|p| 4e4 * (0.5 * p).sinh().powi(2), |p| 2e4 * p.sinh()),
        ]
    }

    const STEPS: [(f64, f64); 8] = [
        (0.1, 0.12),
        (-0.01, 0.02),
        (0.02, -0.01),
        (-0.1, -0.2),
        (0.0, 1e-9),
        (0.03, 0.03 + 1e-9),
        (0.055, 0.004),
        (0.005, 0.009),
    ];

    #[test]
    fn work_of_the_quotient_is_the_change_of_the_potential() {
        for law in potentials() {
            for (p0, p1) in STEPS {
                let work = law.quotient(p0, p1).force * (p1 - p0);
                let change = law.energy(p1) - law.energy(p0);
                let scale = law.energy(p0.max(p1)).max(law.energy(0.1) * 1e-6);
                assert!((work - change).abs() <= 4e-15 * scale, "{law:?} {p0} {p1}");
            }
        }
    }

    #[test]
    fn forces_are_derivatives_of_potentials_and_slopes_of_forces() {
        for law in potentials() {
            for p in [-0.1, 0.005, 0.03, 0.07] {
                let e = 1e-6;
                let force = (law.energy(p + e) - law.energy(p - e)) / (2.0 * e);
                assert!((law.force(p) - force).abs() <= 1e-5 * (1.0 + force), "{law:?} {p}");
            }
            for chi in [0.0, 0.3] {
                for force in [ContactForce::Conserving, ContactForce::Midpoint] {
                    let law =
                        SmoothLaw { dissipation: chi, force, ..SmoothLaw::elastic(law.clone()) };
                    for (p0, p1) in STEPS {
                        let e = 1e-8;
                        if [p0, p1, 0.5 * (p0 + p1)].iter().any(|p| p.abs() < 2.0 * e) {
                            continue;
                        }
                        let f = |p1: f64| law.step_force([p0, p1], 0.0, 0.1).force;
                        let difference = (f(p1 + e) - f(p1 - e)) / (2.0 * e);
                        let slope = law.step_force([p0, p1], 0.0, 0.1).slope;
                        let scale = 1e-4 * law.potential.stiffness(0.1);
                        assert!((slope - difference).abs() <= scale, "{law:?} {p0} {p1}");
                    }
                }
            }
        }
    }

    #[test]
    fn dissipation_takes_and_never_pulls() {
        for potential in potentials() {
            let law = SmoothLaw { dissipation: 2.0, ..SmoothLaw::elastic(potential) };
            for (p0, p1) in STEPS {
                let step = law.step_force([p0, p1], 0.0, 0.01);
                assert!(step.force >= 0.0 && step.dissipated * (p1 - p0) >= 0.0);
            }
        }
    }

    #[test]
    fn bodies_part_with_the_coefficient_that_the_dissipation_was_chosen_for() {
        let (mass, speed) = (0.3, 2.0);
        for potential in potentials() {
            for e in [0.95, 0.7, 0.3] {
                let dissipation = crate::model::hunt_crossley(e, speed);
                let law = SmoothLaw { dissipation, ..SmoothLaw::elastic(potential.clone()) };
                // Explicit midpoint steps of m p'' = -f (1 + chi p').
                let (mut p, mut v, h) = (0.0, speed, 2e-8);
                loop {
                    let a =
                        |p: f64, v: f64| -law.potential.force(p) * (1.0 + dissipation * v) / mass;
                    let (pm, vm) = (p + 0.5 * h * v, v + 0.5 * h * a(p, v));
                    (p, v) = (p + h * vm, v + h * a(pm, vm));
                    if p <= 0.0 {
                        break;
                    }
                }
                assert!((-v / speed - e).abs() < 1e-4, "{law:?}: {} for {e}", -v / speed);
            }
        }
    }
}
