//! The law of a spring: its energy, and its force over a step.

use crate::contact::law::{ForceCurve, PowerLaw};
use crate::model::frozen::{ActsFrom, ConnectorLaw, ForceTable};
use crate::scalar::Number;

#[doc(hidden)]
impl<S: Number> ConnectorLaw<S> {
    /// Potential at a value of the coordinate \[J\].
    #[inline(always)]
    pub fn energy(&self, q: S) -> S {
        match self {
            Self::Linear { stiffness, rest } => PowerLaw::Linear(*stiffness).energy(q - *rest),
            Self::OneSided { stiffness, .. } => {
                let p = self.closed_by(q);
                PowerLaw::Linear(*stiffness).energy(p.max(p.constant(0.0)))
            }
            Self::Tabulated { table, rest } => table.energy(q - *rest),
        }
    }

    /// Force over a step from `q0` by `change`, the difference quotient of the potential (theory, page 1), and its slope by the end.
    #[inline(always)]
    pub fn quotient(&self, q0: S, change: S) -> [S; 2] {
        match self {
            Self::Linear { .. } => self.collocated(q0, change, 0.5),
            Self::OneSided { stiffness, from, .. } => {
                let (law, p0) = (PowerLaw::Linear(*stiffness), self.closed_by(q0));
                match from {
                    ActsFrom::Above => law.quotient(p0, p0 + change),
                    ActsFrom::Below => {
                        let [force, slope] = law.quotient(p0, p0 - change);
                        [-force, slope]
                    }
                }
            }
            Self::Tabulated { table, rest } => table.quotient(q0 - *rest, change),
        }
    }

    /// Force after the share `theta` of a step, and its slope by the end of the step.
    #[inline(always)]
    pub fn collocated(&self, q0: S, change: S, theta: f64) -> [S; 2] {
        match self {
            Self::Linear { stiffness, rest } => {
                [*stiffness * (q0 + change * theta - *rest), *stiffness * theta]
            }
            Self::OneSided { stiffness, from, .. } => {
                let (zero, p0) = (q0.constant(0.0), self.closed_by(q0));
                let p = match from {
                    ActsFrom::Above => p0 + change * theta,
                    ActsFrom::Below => p0 - change * theta,
                };
                let presses = zero.less(p);
                let force = S::choose(presses, *stiffness * p, zero);
                let slope = S::choose(presses, *stiffness * theta, zero);
                match from {
                    ActsFrom::Above => [force, slope],
                    ActsFrom::Below => [-force, slope],
                }
            }
            Self::Tabulated { table, rest } => {
                let [force, slope] = table.at(q0 - *rest + change * theta);
                [force, slope * theta]
            }
        }
    }

    /// Stiffness at a value of the coordinate.
    pub fn stiffness_at(&self, q: S) -> S {
        self.collocated(q, q.constant(0.0), 1.0)[1]
    }

    /// Force of a damper beside the law over a step from `q0` by `change`, and its slope by the end: of the damping over the step size, beside the
    /// law's own force and slope over the step.
    ///
    /// What acts on one side alone is damped there alone, and force and damper together keep the sign of the law: a rope does not push, a bed does
    /// not pull. Where the sum would, the damper takes all that the law gives: it dissipates the potential energy that is set free.
    #[inline(always)]
    pub fn damper(&self, rate: S, [q0, change]: [S; 2], [force, slope]: [S; 2]) -> [S; 2] {
        let Some((from, at)) = self.side() else { return [rate * change, rate] };
        let (sign, zero) = (from.sign(), q0.constant(0.0));
        let p0 = (q0 - at) * sign;
        let p1 = p0 + change * sign;
        let (starts, ends) = (zero.less(p0), zero.less(p1));
        let crossing = (p1.max(zero) - p0.max(zero)) * sign;
        let damper = rate * S::choose(starts & ends, change, crossing);
        let cut = ((force + damper) * sign).less(zero);
        let own = S::choose(ends, rate, zero);
        [S::choose(cut, zero - force, damper), S::choose(cut, zero - slope, own)]
    }

    /// The sum of its force at a value of the coordinate and of the force of a damper at that instant, as in [`Self::damper`].
    pub fn with_damper(&self, q: S, force: S, damper: S) -> S {
        let Some((from, at)) = self.side() else { return force + damper };
        let (sign, zero) = (from.sign(), q.constant(0.0));
        let sum = ((force + damper) * sign).max(zero) * sign;
        S::choose(zero.less((q - at) * sign), sum, zero)
    }

    /// By how much what acts on one side alone has closed, negative while it is open; of other laws the coordinate itself.
    #[inline(always)]
    fn closed_by(&self, q: S) -> S {
        match self {
            Self::OneSided { gap, from: ActsFrom::Above, .. } => q - *gap,
            Self::OneSided { gap, from: ActsFrom::Below, .. } => *gap - q,
            _ => q,
        }
    }
}

/// A force along straight lines is a line and, from each bend on, one more: `F(e) = s e + sum d <e - x> + sum d <x - e>`, each with a potential
/// of its own.
impl<S: Number> ForceTable<S> {
    fn energy(&self, e: S) -> S {
        let bend = |sum: S, change: S, p: S, sign: f64| {
            sum + PowerLaw::Linear(change).energy(p.max(p.constant(0.0))) * sign
        };
        let line = PowerLaw::Linear(self.slope).energy(e);
        let above = self.above.iter().fold(line, |sum, [x, d]| bend(sum, *d, e - *x, 1.0));
        self.below.iter().fold(above, |sum, [x, d]| bend(sum, *d, *x - e, -1.0))
    }

    fn quotient(&self, e0: S, change: S) -> [S; 2] {
        let mut sum = [self.slope * (e0 + change * 0.5), self.slope * 0.5];
        for [x, d] in &self.above {
            let p0 = e0 - *x;
            let [force, slope] = PowerLaw::Linear(*d).quotient(p0, p0 + change);
            sum = [sum[0] + force, sum[1] + slope];
        }
        for [x, d] in &self.below {
            let p0 = *x - e0;
            let [force, slope] = PowerLaw::Linear(*d).quotient(p0, p0 - change);
            sum = [sum[0] + force, sum[1] - slope];
        }
        sum
    }

    /// Force and its slope at an extension.
    fn at(&self, e: S) -> [S; 2] {
        let zero = e.constant(0.0);
        let mut sum = [self.slope * e, self.slope];
        let mut add = |p: S, d: S, sign: f64| {
            let open = zero.less(p);
            sum[0] += S::choose(open, d * p, zero);
            sum[1] += S::choose(open, d * sign, zero);
        };
        self.above.iter().for_each(|[x, d]| add(e - *x, *d, 1.0));
        self.below.iter().for_each(|[x, d]| add(*x - e, *d, -1.0));
        sum
    }
}

impl ForceTable {
    /// From points of increasing extension; without extension there is no force. Beyond the first and the last point the force stays as it is
    /// there: both are bends, with no slope on their outer side.
    pub fn new(extension: &[f64], force: &[f64]) -> Self {
        // Slope below the point of number k.
        let slope = |k: usize| match k == 0 || k == extension.len() {
            true => 0.0,
            false => (force[k] - force[k - 1]) / (extension[k] - extension[k - 1]),
        };
        let before = extension.iter().filter(|x| **x < 0.0).count();
        let bend = |k: usize| [extension[k], slope(k + 1) - slope(k)];
        let (below, above) = (0..extension.len()).map(bend).partition(|[x, _]| *x < 0.0);
        Self { slope: slope(before), above, below, side: side(extension, force) }
    }
}

/// The side of a table with forces of one sign alone, and the extension up to which there is none.
fn side(extension: &[f64], force: &[f64]) -> Option<(ActsFrom, f64)> {
    let any = |sign: f64| force.iter().any(|f| f * sign > 0.0);
    let free = |x: Option<&f64>| x.copied().unwrap_or(0.0);
    match [any(1.0), any(-1.0)] {
        [true, false] => {
            let first = force.iter().position(|f| *f > 0.0)?;
            let before = first.checked_sub(1).and_then(|k| extension.get(k));
            Some((ActsFrom::Above, free(before).max(0.0)))
        }
        [false, true] => {
            let last = force.iter().rposition(|f| *f < 0.0)?;
            Some((ActsFrom::Below, free(extension.get(last + 1)).min(0.0)))
        }
        _ => None,
    }
}

impl ActsFrom {
    /// Sign of its forces, and of the changes of the coordinate that increase them.
    fn sign(self) -> f64 {
        match self {
            Self::Above => 1.0,
            Self::Below => -1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laws() -> Vec<ConnectorLaw> {
        let (stiffness, gap) = (3.0e4, 0.2);
        let table = ForceTable::new(
            &[-0.3, -0.1, 0.0, 0.05, 0.2, 0.4],
            &[-900.0, -100.0, 0.0, 400.0, 250.0, 150.0],
        );
        vec![
            ConnectorLaw::Linear { stiffness, rest: gap },
            ConnectorLaw::OneSided { stiffness, gap, from: ActsFrom::Above },
            ConnectorLaw::OneSided { stiffness, gap, from: ActsFrom::Below },
            ConnectorLaw::Tabulated { table, rest: 0.15 },
        ]
    }

    /// The table of [`laws`] by its lines.
    fn line(e: f64) -> f64 {
        match e {
            e if e < -0.3 => -900.0,
            e if e < -0.1 => -100.0 + 4000.0 * (e + 0.1),
            e if e < 0.0 => 1000.0 * e,
            e if e < 0.05 => 8000.0 * e,
            e if e < 0.2 => 400.0 - 1000.0 * (e - 0.05),
            e if e < 0.4 => 250.0 - 500.0 * (e - 0.2),
            _ => 150.0,
        }
    }

    #[test]
    fn a_table_gives_its_lines_and_keeps_its_last_forces_beyond_them() {
        let ConnectorLaw::Tabulated { table, .. } = &laws()[3] else { unreachable!() };
        for k in -60..=60 {
            let e = 0.01 * f64::from(k) + 0.003;
            let [force, slope] = table.at(e);
            assert!((force - line(e)).abs() < 1e-10, "{e}: {force} {}", line(e));
            let given = (line(e + 1e-6) - line(e - 1e-6)) / 2e-6;
            assert!((slope - given).abs() < 1e-4, "{e}: {slope} {given}");
        }
        assert_eq!(table.energy(0.0), 0.0);
    }

    /// Tables that begin, end or lie away from zero: no force on the other side.
    #[test]
    fn a_table_on_one_side_acts_there_alone() {
        for (extension, force, expected) in [
            ([0.0, 0.1], [0.0, 50.0], [0.0, 0.0, 0.0, 25.0, 50.0]),
            ([0.05, 0.1], [0.0, 50.0], [0.0, 0.0, 0.0, 0.0, 50.0]),
            ([-0.1, 0.0], [-50.0, 0.0], [-50.0, -25.0, 0.0, 0.0, 0.0]),
            ([-0.1, -0.05], [-50.0, 0.0], [-50.0, 0.0, 0.0, 0.0, 0.0]),
        ] {
            let table = ForceTable::new(&extension, &force);
            for (e, expected) in [-0.3, -0.05, 0.0, 0.05, 0.3].into_iter().zip(expected) {
                let [force, _] = table.at(e);
                assert!((force - expected).abs() < 1e-10, "{extension:?} {e}: {force}");
            }
        }
    }

    /// The work of the force over a step is the difference of the potential, and the slope that of the force by the end.
    #[test]
    fn forces_over_a_step_do_the_work_of_the_potential() {
        for law in laws() {
            for (q0, change) in [
                (0.0, 0.1),
                (0.1, 0.3),
                (0.3, -0.25),
                (0.19, 0.02),
                (0.35, 0.2),
                (-0.3, 0.9),
                (0.3, 0.6),
                (0.7, 0.1),
                (0.2, 1e-9),
            ] {
                let [force, slope] = law.quotient(q0, change);
                let work = law.energy(q0 + change) - law.energy(q0);
                assert!((force * change - work).abs() < 1e-12 * 1e4, "{law:?} {q0} {change}");
                let e = 1e-7 * (1.0 + change.abs());
                let beside = |d: f64| law.quotient(q0, change + d)[0];
                let given = (beside(e) - beside(-e)) / (2.0 * e);
                if change.abs() > 1e-6 {
                    assert!((slope - given).abs() < 1e-2, "{law:?} {q0} {change}: {slope} {given}");
                }
            }
        }
    }

    /// A damper beside a spring of one side takes energy there alone.
    #[test]
    fn dampers_act_where_their_spring_does() {
        for (law, q0, change, moved) in [
            (&above(), 0.0, 0.1, 0.0),
            (&above(), 0.1, 0.4, 0.3),
            (&above(), 0.5, -0.4, -0.3),
            (&above(), 0.3, 0.1, 0.1),
            (&below(), 0.3, 0.1, 0.0),
            (&below(), 0.3, -0.4, -0.3),
            (&below(), 0.0, -0.1, -0.1),
        ] {
            // Weak enough for the spring's force to be larger.
            let found = law.damper(1e-3, [q0, change], law.quotient(q0, change));
            assert!((found[0] - 1e-3 * moved).abs() < 1e-17, "{law:?} {q0} {change}: {found:?}");
            assert!(found[0] * change >= 0.0);
        }
    }

    fn above() -> ConnectorLaw {
        ConnectorLaw::OneSided { stiffness: 1.0, gap: 0.2, from: ActsFrom::Above }
    }

    fn below() -> ConnectorLaw {
        ConnectorLaw::OneSided { stiffness: 1.0, gap: 0.2, from: ActsFrom::Below }
    }

    fn tabulated(extension: &[f64], force: &[f64]) -> ConnectorLaw {
        ConnectorLaw::Tabulated { table: ForceTable::new(extension, force), rest: 0.2 }
    }

    /// Force and damper together have the sign of the law over any step and at any instant, and the damper never gives energy; the slope is that of
    /// the sum.
    #[test]
    fn force_and_damper_keep_the_sign_of_their_law() {
        let laws = [
            (above(), 1.0),
            (below(), -1.0),
            (tabulated(&[0.0, 0.1, 0.3], &[0.0, 2.0, 0.5]), 1.0),
            (tabulated(&[-0.3, -0.1, 0.0], &[-2.0, -0.5, 0.0]), -1.0),
        ];
        for (law, sign) in &laws {
            for step in 0..400 {
                let q0 = 0.02 * f64::from(step % 20);
                let change = 0.04 * f64::from(step / 20 - 10) + 0.003;
                for rate in [0.1, 1.0, 30.0] {
                    let sum = |change: f64| {
                        let own = law.quotient(q0, change);
                        let damper = law.damper(rate, [q0, change], own);
                        [0, 1].map(|i| own[i] + damper[i])
                    };
                    let [force, slope] = sum(change);
                    assert!(force * sign >= 0.0, "{law:?} {q0} {change} {rate}: {force}");
                    let loss = law.damper(rate, [q0, change], law.quotient(q0, change))[0] * change;
                    assert!(loss >= -1e-15, "{law:?} {q0} {change} {rate}: {loss}");
                    let e = 1e-8;
                    let given = (sum(change + e)[0] - sum(change - e)[0]) / (2.0 * e);
                    assert!((slope - given).abs() < 1e-4 * (1.0 + rate), "{law:?} {q0} {change}");
                    let now = law.collocated(q0, 0.0, 1.0)[0];
                    assert!(law.with_damper(q0, now, rate * change) * sign >= 0.0);
                }
            }
        }
    }

    #[test]
    fn a_table_of_one_sign_is_of_one_side() {
        for (extension, force, expected) in [
            (&[0.0, 0.1][..], &[0.0, 50.0][..], Some((ActsFrom::Above, 0.0))),
            (&[0.05, 0.1], &[0.0, 50.0], Some((ActsFrom::Above, 0.05))),
            (&[-0.1, 0.0], &[-50.0, 0.0], Some((ActsFrom::Below, 0.0))),
            (&[-0.1, -0.05, 0.2], &[-50.0, 0.0, 0.0], Some((ActsFrom::Below, -0.05))),
            (&[-0.1, 0.0, 0.1], &[-50.0, 0.0, 1.0], None),
            (&[0.0, 0.1], &[0.0, 0.0], None),
        ] {
            assert_eq!(ForceTable::new(extension, force).side, expected, "{extension:?}");
        }
    }
}
