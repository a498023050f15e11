//! Energies and momenta, and their ledger: of one run, of runs in lanes, or with derivatives.

mod audit;
mod measures;
mod numbers;
mod step_work;

use serde::{Deserialize, Serialize};

use crate::math::vec2::{add, cross, scale};
use crate::model::Model;
use crate::scalar::{Number, array};

pub use audit::Audit;
pub use measures::Measures;
use numbers::of_numbers;
pub use step_work::StepWork;

/// Energies and momenta supplied and dissipated since the start of the run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger<S = f64> {
    /// Total energy at the start \[J\].
    pub energy_initial: S,
    /// Work of the loads, gravity included \[J\].
    pub work_loads: S,
    /// Work of the supports \[J\].
    pub work_supports: S,
    /// Energy lost in impacts and to friction of rigid contacts \[J\].
    pub loss_impacts: S,
    /// Energy taken by damping \[J\].
    pub loss_damping: S,
    /// Energy dissipated by plastic flow \[J\].
    pub loss_plastic: S,
    /// Energy that was stored in fibres, springs and hinges that failed \[J\].
    pub loss_failure: S,
    /// Linear momentum at the start, shape (2) \[kg m/s\].
    pub linear_initial: [S; 2],
    /// Angular momentum about the origin at the start \[kg m^2/s\].
    pub angular_initial: S,
    /// Impulse of the loads, shape (2) \[N s\].
    pub impulse_loads: [S; 2],
    /// Impulse of the supports, shape (2) \[N s\].
    pub impulse_supports: [S; 2],
    /// Angular impulse of the loads about the origin \[N m s\].
    pub angular_impulse_loads: S,
    /// Angular impulse of the supports and of the projectiles' guides about the origin \[N m s\].
    pub angular_impulse_supports: S,
    /// Impulse of damping forces against the ground, shape (2) \[N s\].
    pub impulse_damping: [S; 2],
    /// Their angular impulse about the origin \[N m s\].
    pub angular_impulse_damping: S,
    /// Largest magnitude so far of the total energy, of the works and of the losses \[J\]; the scale of residuals is this or the total transfer, see
    /// [`Ledger::audit_scales`].
    pub energy_scale: S,
    /// Scale of linear momentum: the largest so far \[kg m/s\].
    pub linear_scale: S,
    /// Scale of angular momentum: the largest so far \[kg m^2/s\].
    pub angular_scale: S,
    /// Magnitudes of the works of loads and supports, of the impulse and of the angular impulse of every single force of theirs and of dampers to the
    /// ground, summed over the steps, shape (3) \[J, N s, N m s\]: total transfer, whatever the net value. A bar pressed between two walls passes
    /// much, though its supports together pass nothing.
    pub passed: [S; 3],
    /// Rounding errors of the sums above, shape (15) \[J, N s, N m s\].
    rest: Flows<S>,
    /// Energy, momentum and angular momentum that are none, shape (3) \[J, kg m/s, kg m^2/s\].
    negligible: [S; 3],
}

/// Number of sums that flows are entered in.
const FLOWS: usize = 15;

/// Sums that flows are entered in, shape (15) \[J, N s, N m s\].
pub type Flows<S> = [S; FLOWS];

/// Share of its scale from which on the error of a balance is one.
pub const JUDGED: f64 = 1e-8;

/// Strains that are none.
const NEGLIGIBLE_STRAIN: f64 = 1e-12;

/// Negligible values: energy and momentum of strains and displacements by the last five bits.
#[derive(Clone, Copy, Debug)]
pub struct RoundOff<S = f64> {
    /// Energy \[J\].
    pub energy: S,
    /// Linear momentum \[kg m/s\].
    pub momentum: S,
    /// Scale of positions \[m\].
    pub size: S,
    /// Energy, momentum and angular momentum of the least scales of residuals, shape (3) \[J, kg m/s, kg m^2/s\], such that round-off is not judged (see
    /// [`JUDGED`]): that of the energy above, or of a strain of 1e-12, and that of the momentum of a velocity with the energy of strains by the last bit.
    pub negligible: [S; 3],
}

impl RoundOff {
    /// Of a model in steps of size `step`.
    pub fn new(model: &Model, step: f64) -> Self {
        let size = model.position_scale();
        let digit = 32.0 * f64::EPSILON;
        let stretched: f64 = model
            .each_element()
            .map(|(span, k, _, _)| {
                let table = span.table(k);
                table.rows[1].section.axial * table.length
            })
            .sum();
        let moved = model.total_mass * (digit * size / step).powi(2);
        let energy = (stretched * digit * digit + moved).max(f64::MIN_POSITIVE);
        let momentum = |energy: f64| (2.0 * model.total_mass * energy).sqrt();
        let stored = 0.5 * stretched * NEGLIGIBLE_STRAIN.powi(2);
        let carried = momentum(0.5 * stretched * f64::EPSILON.powi(2)) / JUDGED;
        let negligible = [stored.max(energy / JUDGED), carried, carried * size];
        Self { energy, momentum: momentum(energy), size, negligible }
    }
}

impl<S: Copy> RoundOff<S> {
    /// The same with every number replaced, in a fixed order.
    pub fn map<T: Copy>(&self, f: &mut impl FnMut(S) -> T) -> RoundOff<T> {
        RoundOff {
            energy: f(self.energy),
            momentum: f(self.momentum),
            size: f(self.size),
            negligible: self.negligible.map(f),
        }
    }
}

of_numbers! {
    Ledger: energy_initial work_loads work_supports loss_impacts loss_damping loss_plastic loss_failure angular_initial
        angular_impulse_loads angular_impulse_supports angular_impulse_damping energy_scale linear_scale angular_scale;
    linear_initial impulse_loads impulse_supports impulse_damping passed rest negligible
}

#[doc(hidden)]
impl<S: Number> Ledger<S> {
    /// Opens the ledger on an initial state, the scales no smaller than those of round-off.
    #[inline(always)]
    pub fn open(measures: &Measures<S>, round_off: &RoundOff<S>) -> Self {
        let mut ledger = Self {
            energy_initial: measures.total(),
            linear_initial: measures.linear,
            angular_initial: measures.angular,
            energy_scale: round_off.energy,
            linear_scale: round_off.momentum,
            angular_scale: round_off.momentum * round_off.size,
            negligible: round_off.negligible,
            ..Self::none(round_off.energy)
        };
        ledger.rescale(measures);
        ledger
    }

    /// Enters a new state into the scales.
    #[inline(always)]
    pub fn rescale(&mut self, m: &Measures<S>) {
        let impulse = |[j1, j2]: [S; 2]| j1.hypot(j2);
        for energy in [
            m.total(),
            self.work_loads,
            self.work_supports,
            self.loss_impacts,
            self.loss_damping,
            self.loss_plastic,
        ] {
            self.energy_scale = self.energy_scale.max(energy.abs());
        }
        self.linear_scale = self
            .linear_scale
            .max(m.linear_size)
            .max(impulse(self.impulse_loads))
            .max(impulse(self.impulse_supports));
        self.angular_scale = self
            .angular_scale
            .max(m.angular_size)
            .max(self.angular_impulse_loads.abs())
            .max(self.angular_impulse_supports.abs());
    }

    #[inline(always)]
    fn flows(&mut self) -> [&mut S; FLOWS] {
        let [l1, l2] = &mut self.impulse_loads;
        let [s1, s2] = &mut self.impulse_supports;
        let [d1, d2] = &mut self.impulse_damping;
        let angular = [
            &mut self.angular_impulse_loads,
            &mut self.angular_impulse_supports,
            &mut self.angular_impulse_damping,
        ];
        let [la, sa, da] = angular;
        let (work_l, work_s) = (&mut self.work_loads, &mut self.work_supports);
        let (impacts, damping) = (&mut self.loss_impacts, &mut self.loss_damping);
        let (plastic, failure) = (&mut self.loss_plastic, &mut self.loss_failure);
        [work_l, work_s, impacts, damping, l1, l2, s1, s2, d1, d2, la, sa, da, plastic, failure]
    }

    /// Sets the sums so far aside: the next entries start from zero.
    #[inline(always)]
    pub fn set_aside(&mut self) -> Flows<S> {
        let zero = self.energy_scale.constant(0.0);
        let mut so_far = [zero; FLOWS];
        for (flow, so_far) in self.flows().into_iter().zip(&mut so_far) {
            *so_far = std::mem::replace(flow, zero);
        }
        so_far
    }

    /// Adds the entries since then to sums set aside, with compensated rounding (Kahan 1965, Neumaier 1974): over millions of steps each addition
    /// would have the rounding error of the sums.
    #[inline(always)]
    pub fn put_on(&mut self, so_far: Flows<S>) {
        let mut rest = self.rest;
        let mut passed = so_far;
        for (i, sum) in self.flows().into_iter().enumerate() {
            let before = so_far[i];
            passed[i] = sum.abs();
            let entered = *sum + rest[i];
            *sum = before + entered;
            let larger = entered.abs().at_most(before.abs());
            let (a, b) = (S::choose(larger, before, entered), S::choose(larger, entered, before));
            rest[i] = (a - *sum) + b;
        }
        self.rest = rest;
        self.passed[0] += passed[0] + passed[1];
    }

    /// Enters a force and a couple of a support, a guide or the ground at `x` over a step of size `h`.
    #[inline(always)]
    pub fn react(&mut self, h: S, x: [S; 2], force: [S; 2], moment: S) {
        let impulse = scale(h, force);
        let turning = h * (cross(x, force) + moment);
        self.impulse_supports = add(self.impulse_supports, impulse);
        self.angular_impulse_supports += turning;
        self.passed[1] += impulse[0].abs() + impulse[1].abs();
        self.passed[2] += turning.abs();
    }

    /// Enters work and impulse of loads.
    #[inline(always)]
    pub fn load(&mut self, done: &StepWork<S>) {
        self.work_loads += done.work;
        self.impulse_loads = add(self.impulse_loads, done.impulse);
        self.angular_impulse_loads += done.angular_impulse;
        self.pass(done);
    }

    /// Enters the magnitudes of forces into the total transfer.
    #[inline(always)]
    fn pass(&mut self, done: &StepWork<S>) {
        self.passed[1] += done.passed[0];
        self.passed[2] += done.passed[1];
    }

    /// Enters the damping forces against the ground: their work is a loss.
    #[inline(always)]
    pub fn damp(&mut self, done: &StepWork<S>) {
        self.loss_damping = self.loss_damping - done.work;
        self.impulse_damping = add(self.impulse_damping, done.impulse);
        self.angular_impulse_damping += done.angular_impulse;
        self.pass(done);
    }
}

impl<S: Number> Ledger<S> {
    /// Reference values of residuals: energy \[J\], linear \[kg m/s\] and angular momentum \[kg m^2/s\].
    ///
    /// The largest value so far, or the total transfer if that is larger; no less than the negligible value.
    pub fn audit_scales(&self) -> [S; 3] {
        let scales = [self.energy_scale, self.linear_scale, self.angular_scale];
        array(|i| scales[i].max(self.passed[i]).max(self.negligible[i]))
    }

    /// Error of the energy balance \[J\].
    #[inline(always)]
    pub fn energy_residual(&self, m: &Measures<S>) -> S {
        let [loads, supports, impacts, damping, .., plastic, failure] = self.rest;
        let rest = loads + supports - impacts - damping - plastic - failure;
        let entered = self.energy_initial + self.work_loads + self.work_supports;
        let inelastic = self.loss_plastic + self.loss_failure;
        m.total() - entered + self.loss_impacts + self.loss_damping + inelastic - rest
    }

    /// Error of the balance of linear momentum \[kg m/s\].
    #[inline(always)]
    pub fn linear_residual(&self, m: &Measures<S>) -> [S; 2] {
        array(|i| {
            let rest = self.rest[4 + i] + self.rest[6 + i] + self.rest[8 + i];
            let impulse =
                self.impulse_loads[i] + self.impulse_supports[i] + self.impulse_damping[i];
            m.linear[i] - self.linear_initial[i] - impulse - rest
        })
    }

    /// Error of the balance of angular momentum \[kg m^2/s\].
    #[inline(always)]
    pub fn angular_residual(&self, m: &Measures<S>) -> S {
        let impulse = self.angular_impulse_loads
            + self.angular_impulse_supports
            + self.angular_impulse_damping;
        let rest = self.rest[10] + self.rest[11] + self.rest[12];
        m.angular - self.angular_initial - impulse - rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_a_million_steps_lose_nothing() {
        let mut ledger = Ledger::default();
        for _ in 0..1_000_000 {
            let so_far = ledger.set_aside();
            ledger.work_loads += 0.1;
            ledger.react(1.0, [0.0; 2], [0.0, -0.1], 0.0);
            ledger.put_on(so_far);
        }
        // Added as they come they are 100000.00000133288.
        assert_eq!((ledger.work_loads, ledger.impulse_supports), (1e5, [0.0, -1e5]));
        assert!((ledger.passed[0] - 1e5).abs() < 1e-5 && (ledger.passed[1] - 1e5).abs() < 1e-5);
        let nothing = Measures { linear: [0.0, -1e5], ..Measures::default() };
        assert!(ledger.linear_residual(&nothing)[1].abs() < 1e-11);
        assert!((ledger.energy_residual(&nothing) + 1e5).abs() < 1e-9);
    }

    /// Two supports that press against each other pass as much as each of them, though together they pass nothing.
    #[test]
    fn forces_that_balance_pass_all_the_same() {
        let mut ledger = Ledger::default();
        let so_far = ledger.set_aside();
        ledger.react(0.5, [0.0; 2], [1e5, 0.0], 0.0);
        ledger.react(0.5, [2.0, 0.0], [-1e5, 0.0], 0.0);
        let mut loads = StepWork::none(0.0);
        loads.add_force([3.0, 0.0], [0.0, 2.0], [0.0; 2], 1.0);
        loads.add_force([-3.0, 0.0], [0.0, 2.0], [0.0; 2], 1.0);
        ledger.load(&loads);
        ledger.put_on(so_far);
        assert_eq!(ledger.impulse_supports, [0.0; 2]);
        assert_eq!(ledger.passed, [0.0, 1e5 + 6.0, 12.0]);
    }
}
