//! Energies and momenta, and the ledger of what entered and left.

use serde::{Deserialize, Serialize};

use crate::model::Model;

/// What entered and left since the start of the run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// Total energy at the start \[J\].
    pub energy_initial: f64,
    /// Work of the loads, gravity included \[J\].
    pub work_loads: f64,
    /// Work of the supports \[J\].
    pub work_supports: f64,
    /// Energy lost in impacts \[J\].
    pub loss_impacts: f64,
    /// Energy taken by damping \[J\].
    pub loss_damping: f64,
    /// Energy dissipated by plastic flow \[J\].
    pub loss_plastic: f64,
    /// Energy that was stored in fibres, springs and hinges that failed \[J\].
    pub loss_failure: f64,
    /// Linear momentum at the start, shape (2) \[kg m/s\].
    pub linear_initial: [f64; 2],
    /// Angular momentum about the origin at the start \[kg m^2/s\].
    pub angular_initial: f64,
    /// Impulse of the loads, shape (2) \[N s\].
    pub impulse_loads: [f64; 2],
    /// Impulse of the supports, shape (2) \[N s\].
    pub impulse_supports: [f64; 2],
    /// Angular impulse of the loads about the origin \[N m s\].
    pub angular_impulse_loads: f64,
    /// Angular impulse of the supports and of the projectiles' guides about the origin \[N m s\].
    pub angular_impulse_supports: f64,
    /// Impulse of damping forces against the ground, shape (2) \[N s\].
    pub impulse_damping: [f64; 2],
    /// Their angular impulse about the origin \[N m s\].
    pub angular_impulse_damping: f64,
    /// Energy scale: the largest energy so far \[J\].
    pub energy_scale: f64,
    /// Scale of linear momentum: the largest so far \[kg m/s\].
    pub linear_scale: f64,
    /// Scale of angular momentum: the largest so far \[kg m^2/s\].
    pub angular_scale: f64,
    /// Magnitudes of the works, the impulses and the angular impulses of loads and supports, step by step, shape (3) \[J, N s, N m s\]: what
    /// passed through, however little of it stays.
    pub passed: [f64; 3],
    /// What the sums above have lost by rounding, shape (15) \[J, N s, N m s\].
    rest: [f64; FLOWS],
    /// Energy, momentum and angular momentum that are none, shape (3) \[J, kg m/s, kg m^2/s\].
    negligible: [f64; 3],
}

/// Number of sums that flows are entered in.
const FLOWS: usize = 15;

/// Strains that are none.
const NEGLIGIBLE_STRAIN: f64 = 1e-12;

/// What is nothing: energy and momentum of strains and displacements by the last five bits.
#[derive(Clone, Copy, Debug)]
pub struct RoundOff {
    /// Energy \[J\].
    pub energy: f64,
    /// Linear momentum \[kg m/s\].
    pub momentum: f64,
    /// What positions are as large as \[m\].
    pub size: f64,
    /// Energy, momentum and angular momentum that no residual is held against, shape (3) \[J, kg m/s, kg m^2/s\]: what a strain of 1e-12
    /// stores, and a velocity of as much energy carries.
    pub negligible: [f64; 3],
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
        let carried = momentum(stored);
        let negligible = [stored, carried, carried * size];
        Self { energy, momentum: momentum(energy), size, negligible }
    }
}

/// Energies and momenta of a state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measures {
    /// Kinetic energy of the beams \[J\].
    pub kinetic_beams: f64,
    /// Kinetic energy of the projectiles \[J\].
    pub kinetic_projectiles: f64,
    /// Axial strain energy \[J\].
    pub strain_axial: f64,
    /// Bending strain energy \[J\].
    pub strain_bending: f64,
    /// Energy that hardening has stored \[J\].
    pub hardening: f64,
    /// Energy of the contact springs \[J\].
    pub contact: f64,
    /// Energy of springs, elastic supports and stops \[J\].
    pub springs: f64,
    /// Linear momentum, shape (2) \[kg m/s\].
    pub linear: [f64; 2],
    /// Angular momentum about the origin \[kg m^2/s\].
    pub angular: f64,
    /// Largest distance of a stored bending strain from that of the configuration \[1/m\].
    pub curvature_drift: f64,
    /// Largest distance of a stored membrane strain from that of the configuration \[1\].
    pub membrane_drift: f64,
    /// Kinetic energy with the angular rates that follow from the slopes' velocities, less that with the sections' own rates, which is
    /// conserved \[J\].
    pub angular_rate_drift: f64,
    /// Sum of the magnitudes of the bodies' linear momenta and of the elements', these by components \[kg m/s\], a scale: where things move against each
    /// other, momenta vanish together that do not vanish alone.
    pub linear_size: f64,
    /// Sum of the distances from the origin times momenta, and of couples, all by their components' magnitudes \[kg m^2/s\], a scale:
    /// what moves straight towards the origin has no angular momentum, and yet its parts have.
    pub angular_size: f64,
}

impl Measures {
    /// Total energy \[J\].
    pub fn total(&self) -> f64 {
        self.kinetic_beams
            + self.kinetic_projectiles
            + self.strain_axial
            + self.strain_bending
            + self.hardening
            + self.contact
            + self.springs
    }
}

impl Ledger {
    /// Opens the ledger on an initial state, the scales no smaller than those of round-off.
    pub(crate) fn open(measures: &Measures, round_off: &RoundOff) -> Self {
        let mut ledger = Self {
            energy_initial: measures.total(),
            linear_initial: measures.linear,
            angular_initial: measures.angular,
            energy_scale: round_off.energy,
            linear_scale: round_off.momentum,
            angular_scale: round_off.momentum * round_off.size,
            negligible: round_off.negligible,
            ..Self::default()
        };
        ledger.rescale(measures);
        ledger
    }

    /// Takes a new state into the scales.
    pub(crate) fn rescale(&mut self, m: &Measures) {
        let energy = [
            m.total(),
            self.work_loads,
            self.work_supports,
            self.loss_impacts,
            self.loss_damping,
            self.loss_plastic,
        ]
        .into_iter()
        .fold(0.0, |most: f64, e| most.max(e.abs()));
        self.energy_scale = self.energy_scale.max(energy);
        let impulse = |j: [f64; 2]| j[0].hypot(j[1]);
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

    fn flows(&mut self) -> [&mut f64; FLOWS] {
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

    /// Takes the sums so far aside: what is entered next counts from nothing.
    pub(crate) fn set_aside(&mut self) -> [f64; FLOWS] {
        self.flows().map(std::mem::take)
    }

    /// Adds what has been entered since to sums set aside, without loss by rounding (Kahan 1965, Neumaier 1974): over millions of
    /// steps it would be that of the sums, each time.
    pub(crate) fn put_on(&mut self, so_far: [f64; FLOWS]) {
        let mut rest = self.rest;
        let entered = self.flows().map(|f| *f);
        for (((sum, rest), before), entered) in
            self.flows().into_iter().zip(&mut rest).zip(so_far).zip(entered)
        {
            let entered = entered + *rest;
            *sum = before + entered;
            let larger = before.abs() >= entered.abs();
            let [a, b] = if larger { [before, entered] } else { [entered, before] };
            *rest = (a - *sum) + b;
        }
        self.rest = rest;
        let [work_l, work_s, _, _, l1, l2, s1, s2, _, _, la, sa, ..] = entered.map(f64::abs);
        let passed = [work_l + work_s, l1 + l2 + s1 + s2, la + sa];
        (0..3).for_each(|i| self.passed[i] += passed[i]);
    }

    /// What residuals are relative to: energy \[J\], linear \[kg m/s\] and angular momentum \[kg m^2/s\].
    ///
    /// The largest so far, or what passed through if that is more; no less than what is negligible.
    pub fn audit_scales(&self) -> [f64; 3] {
        let scales = [self.energy_scale, self.linear_scale, self.angular_scale];
        std::array::from_fn(|i| scales[i].max(self.passed[i]).max(self.negligible[i]))
    }

    /// What is missing from the balance of energy \[J\].
    pub fn energy_residual(&self, m: &Measures) -> f64 {
        let [loads, supports, impacts, damping, .., plastic, failure] = self.rest;
        let rest = loads + supports - impacts - damping - plastic - failure;
        let entered = self.energy_initial + self.work_loads + self.work_supports;
        let inelastic = self.loss_plastic + self.loss_failure;
        m.total() - entered + self.loss_impacts + self.loss_damping + inelastic - rest
    }

    /// What is missing from the balance of linear momentum \[kg m/s\].
    pub fn linear_residual(&self, m: &Measures) -> [f64; 2] {
        let rest = |i: usize| self.rest[4 + i] + self.rest[6 + i] + self.rest[8 + i];
        std::array::from_fn(|i| {
            let impulse =
                self.impulse_loads[i] + self.impulse_supports[i] + self.impulse_damping[i];
            m.linear[i] - self.linear_initial[i] - impulse - rest(i)
        })
    }

    /// What is missing from the balance of angular momentum \[kg m^2/s\].
    pub fn angular_residual(&self, m: &Measures) -> f64 {
        let impulse = self.angular_impulse_loads
            + self.angular_impulse_supports
            + self.angular_impulse_damping;
        m.angular - self.angular_initial - impulse - self.rest[10..13].iter().sum::<f64>()
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
            ledger.impulse_supports[1] -= 0.1;
            ledger.put_on(so_far);
        }
        // Added as they come they are 100000.00000133288.
        assert_eq!((ledger.work_loads, ledger.impulse_supports), (1e5, [0.0, -1e5]));
        assert!((ledger.passed[0] - 1e5).abs() < 1e-5 && (ledger.passed[1] - 1e5).abs() < 1e-5);
        let nothing = Measures { linear: [0.0, -1e5], ..Measures::default() };
        assert!(ledger.linear_residual(&nothing)[1].abs() < 1e-11);
        assert!((ledger.energy_residual(&nothing) + 1e5).abs() < 1e-9);
    }
}
