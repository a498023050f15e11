//! Several contacts at once: one complementarity problem for the impulses along normals and tangents.
//!
//! Signorini along the normal, `0 <= z_n - bound  perp  L_n >= 0`; Coulomb along the tangent, `-L_t in mu L_n Sgn(z_t - target)`; rates `z = free +
//! W L` with the Delassus operator W. Previous impulses of a contact are included in its conditions. The problem is solved by the proximal-point
//! iteration of the paper (eqs. 14 to 16), contact after contact; if that is slow, by Newton's iteration on the contact states, and if that fails,
//! by Lemke's method, which ends after a finite number of exchanges for any redundancy of contacts. The result is checked against the conditions
//! themselves.

mod direct;
mod problem;
mod statuses;

pub use problem::{Conditions, ImpactProblem, Stalled};

/// Whether impulses increase the energy \[J\] by more than round-off: their work, and each with its previous rate. No impact law may do so; if one
/// does, another one replaces it.
pub fn gives_energy(work: f64, impulses: impl IntoIterator<Item = (f64, f64)>) -> bool {
    /// Relative to the work that the impulses would do at the rates before.
    const ROUND_OFF: f64 = 1e-12;
    let size: f64 = impulses.into_iter().map(|(impulse, rate)| (impulse * rate).abs()).sum();
    work > ROUND_OFF * size
}

impl ImpactProblem {
    /// Sweeps in a round, and how many of them are made before their progress is judged.
    const SWEEPS: i32 = 40;
    const TRIED: i32 = 4;
    const ROUNDS: usize = 60;
    const TOLERANCE: f64 = 4e-16;
    /// Violation of the conditions that is round-off, relative to the largest rate.
    const ACCEPTED: f64 = 1e-13;
    /// Accepted violation for slow iterations, in piles with redundant friction forces; the summary reports it, as any other.
    const TOLERATED: f64 = 1e-6;

    /// Impulses beyond this multiple of the one that stops the heaviest body at every contact belong to wedged bodies.
    const WEDGED: f64 = 10.0;

    /// Allocates memory for `n` contacts.
    pub fn resize(&mut self, n: usize) {
        let none = Conditions { bound: 0.0, friction: 0.0, target: 0.0, carried: [0.0; 2] };
        self.contacts.resize(n, none);
        self.delassus.resize(4 * n * n, 0.0);
        self.free.resize(2 * n, 0.0);
    }

    /// Number of contacts.
    pub fn count(&self) -> usize {
        self.contacts.len()
    }

    /// Rates with the impulses, of all rows.
    fn find_rates(&self, impulses: &[f64], rates: &mut Vec<f64>) {
        rates.clear();
        rates.extend_from_slice(&self.free);
        for (column, impulse) in impulses.iter().enumerate() {
            self.add_impulse(column, *impulse, rates);
        }
    }

    fn add_impulse(&self, column: usize, impulse: f64, rates: &mut [f64]) {
        if impulse != 0.0 {
            let m = 2 * self.count();
            let w = &self.delassus[column * m..(column + 1) * m];
            rates.iter_mut().zip(w).for_each(|(rate, w)| *rate += w * impulse);
        }
    }

    fn diagonal(&self, row: usize) -> f64 {
        self.delassus[row * (2 * self.count() + 1)]
    }

    /// Proximal point of the impulse of row `row` for the current other ones.
    fn prox(&self, row: usize, impulses: &[f64], rates: &[f64]) -> f64 {
        let contact = &self.contacts[row / 2];
        let w = self.diagonal(row);
        if w <= 0.0 {
            return 0.0; // held on both sides
        }
        let next = impulses[row] - (rates[row] - self.goal(row)) / w;
        if row.is_multiple_of(2) {
            return next.max(-contact.carried[0]);
        }
        let [low, high] = contact.friction_limits(impulses[row - 1]);
        next.clamp(low, high)
    }

    /// Rate required by the condition of a row.
    fn goal(&self, row: usize) -> f64 {
        let contact = &self.contacts[row / 2];
        if row.is_multiple_of(2) { contact.bound } else { contact.target }
    }

    fn rows(&self) -> impl Iterator<Item = usize> + use<'_> {
        (0..2 * self.count())
            .filter(|row| row.is_multiple_of(2) || self.contacts[row / 2].friction > 0.0)
    }

    /// Solves for the impulses in place, starting from the current values.
    ///
    /// # Errors
    /// [`Stalled`] if no impulses were found that meet the conditions.
    pub fn solve(&mut self, impulses: &mut [f64]) -> Result<(), Stalled> {
        let mut known = self.delassus.iter().chain(&self.free).chain(impulses.iter());
        if !known.all(|x| x.is_finite()) {
            return Err(Stalled); // an iteration that has run away
        }
        let single = self.count() == 1 && self.contacts[0].friction == 0.0;
        let enough = Self::ACCEPTED * self.scale();
        for round in 0..Self::ROUNDS {
            let converged = self.sweeps(impulses, round == 0);
            if !impulses.iter().all(|x| x.is_finite()) {
                return Err(Stalled);
            }
            if converged || single || self.residual(impulses) <= enough {
                return Ok(());
            }
            let solved = round == 0
                && (self.follow_statuses(impulses) <= enough
                    || self.solve_directly(impulses) <= enough);
            if solved {
                return Ok(());
            }
        }
        if self.residual(impulses) <= Self::TOLERATED * self.scale() {
            Ok(())
        } else {
            Err(Stalled)
        }
    }

    /// A round of sweeps; returns whether they have converged. Impatient sweeps end as soon as divergence is clear.
    fn sweeps(&mut self, impulses: &mut [f64], impatient: bool) -> bool {
        let mut rates = std::mem::take(&mut self.rates);
        self.find_rates(impulses, &mut rates);
        let mut before = f64::INFINITY;
        for left in (0..Self::SWEEPS).rev() {
            let moved = self.sweep(impulses, &mut rates);
            if moved <= Self::TOLERANCE {
                before = 0.0;
                break;
            }
            let slow = moved * (moved / before).powi(left) > Self::TOLERANCE;
            if slow && impatient && left < Self::SWEEPS - Self::TRIED {
                break;
            }
            before = moved;
        }
        self.rates = rates;
        before == 0.0
    }

    /// One sweep; returns the largest change of an impulse relative to the largest impulse.
    fn sweep(&self, impulses: &mut [f64], rates: &mut [f64]) -> f64 {
        let (mut change, mut size) = (0.0_f64, 0.0_f64);
        for row in self.rows() {
            let next = self.prox(row, impulses, rates);
            let step = next - impulses[row];
            self.add_impulse(row, step, rates);
            impulses[row] = next;
            change = change.max(step.abs());
            size = size.max(next.abs());
        }
        if change == 0.0 { 0.0 } else { change / size.max(f64::MIN_POSITIVE) }
    }

    /// Largest rate in the problem \[m/s\].
    pub fn scale(&self) -> f64 {
        let bounds = self.contacts.iter().flat_map(|c| [c.bound, c.target]);
        let rows = self.rows().map(|r| self.free[r]);
        rows.chain(bounds).fold(0.0_f64, |m, x| m.max(x.abs()))
    }

    /// Impulse beyond which a solution is none \[N s\]: contacts that wedge each other can carry any without motion.
    fn most(&self) -> f64 {
        let stops = self.rows().map(|r| self.diagonal(r)).filter(|w| *w > 0.0);
        Self::WEDGED * self.count() as f64 * self.scale() / stops.fold(f64::MAX, f64::min)
    }

    /// Largest violation of the conditions, as a rate \[m/s\].
    pub fn residual(&self, impulses: &[f64]) -> f64 {
        let mut rates = Vec::new();
        self.find_rates(impulses, &mut rates);
        let miss = |row: usize| {
            let apart = (self.prox(row, impulses, &rates) - impulses[row]).abs();
            let pulls = if row.is_multiple_of(2) {
                -impulses[row] - self.contacts[row / 2].carried[0]
            } else {
                0.0
            };
            apart.max(pulls) * self.diagonal(row)
        };
        self.rows().map(miss).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A problem with a random symmetric Delassus operator of rank `rank`.
    fn random(n: usize, rank: usize, friction: f64, seed: u64) -> ImpactProblem {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
        };
        let m = 2 * n;
        let factor: Vec<f64> = (0..m * rank).map(|_| next()).collect();
        let mut problem = ImpactProblem::default();
        problem.resize(n);
        for i in 0..m {
            for j in 0..m {
                problem.delassus[i * m + j] =
                    (0..rank).map(|k| factor[i * rank + k] * factor[j * rank + k]).sum();
            }
        }
        // Rates the masses behind the operator can have.
        let velocity: Vec<f64> = (0..rank).map(|_| next()).collect();
        for i in 0..m {
            problem.free[i] = (0..rank).map(|k| factor[i * rank + k] * velocity[k]).sum();
        }
        for i in 0..n {
            // Newton's law: the velocity turned round and halved meets it, so that there is a solution.
            let bound = -0.5 * problem.free[2 * i];
            problem.contacts[i] = Conditions { bound, friction, target: 0.0, carried: [0.0; 2] };
        }
        problem
    }

    #[test]
    fn one_contact_has_the_closed_form() {
        let mut problem = ImpactProblem::default();
        problem.resize(1);
        problem.delassus[0] = 0.02;
        problem.free[0] = -3.0;
        problem.contacts[0].bound = 1.5;
        let mut impulse = [0.0; 2];
        problem.solve(&mut impulse).unwrap();
        assert!((impulse[0] - 4.5 / 0.02).abs() < 1e-12);
    }

    #[test]
    fn a_block_that_slides_or_sticks_obeys_coulomb() {
        for (push, sticks) in [(0.1, true), (2.0, false)] {
            let mut problem = ImpactProblem::default();
            problem.resize(1);
            problem.delassus = vec![1.0, 0.0, 0.0, 1.0];
            problem.free = vec![-1.0, push];
            problem.contacts[0].friction = 0.3;
            let mut impulse = [0.0; 2];
            problem.solve(&mut impulse).unwrap();
            assert!((impulse[0] - 1.0).abs() < 1e-14);
            let expected = if sticks { -push } else { -0.3 };
            assert!((impulse[1] - expected).abs() < 1e-14);
        }
    }

    #[test]
    fn carried_impulses_count_for_sign_and_friction() {
        // Leaves at 1 m/s after an impulse of 3; taking back 1 brings it to rest. Friction carried 0.9 of at most 0.3 times 3.
        for (carried, rate, friction) in [(3.0, 0.0, 0.6), (0.4, 0.6, 0.0)] {
            let mut problem = ImpactProblem::default();
            problem.resize(1);
            problem.delassus = vec![1.0, 0.0, 0.0, 1.0];
            problem.free = vec![1.0, -2.0];
            problem.contacts[0].friction = 0.3;
            problem.contacts[0].carried = [carried, 0.3 * carried];
            let mut impulse = [0.0; 2];
            problem.solve(&mut impulse).unwrap();
            let mut rates = Vec::new();
            problem.find_rates(&impulse, &mut rates);
            assert!((rates[0] - rate).abs() < 1e-14);
            assert!((impulse[1] + 0.3 * carried - friction).abs() < 1e-14, "{impulse:?}");
        }
    }

    /// The work of an impulse `(1 + e) m v` against a wall is `(e^2 - 1) m v^2 / 2`.
    #[test]
    fn impulses_give_energy_where_restitution_is_above_one_by_more_than_round_off() {
        let (m, v) = (3.0, -7.0);
        for (e, gives) in
            [(0.0, false), (0.9, false), (1.0, false), (1.0 + 1e-14, false), (1.0 + 1e-11, true)]
        {
            let impulse = -(1.0 + e) * m * v;
            let work = 0.5 * impulse * (v - e * v);
            assert_eq!(gives_energy(work, [(impulse, v)]), gives, "{e}");
        }
        assert!(!gives_energy(0.0, []));
    }

    #[test]
    fn hundreds_of_redundant_contacts_with_friction_meet_their_conditions() {
        for (n, rank, friction, seed) in [
            (120, 60, 0.0, 1),
            (120, 300, 0.0, 2),
            (40, 160, 0.4, 3),
            (60, 240, 0.3, 4),
            (8, 12, 0.9, 5),
        ] {
            let mut problem = random(n, rank, friction, seed);
            let mut impulses = vec![0.0; 2 * n];
            let solved = problem.solve(&mut impulses);
            let residual = problem.residual(&impulses) / problem.scale();
            assert!(solved.is_ok() && residual <= 1e-10, "{n} {rank} {friction}: {residual:e}");
            assert!(
                (0..n).all(|i| impulses[2 * i + 1].abs() <= friction * impulses[2 * i] + 1e-15)
            );
        }
    }

    #[test]
    fn plastic_impacts_with_friction_have_a_solution_however_redundant() {
        let mut worst = 0.0_f64;
        for seed in 0..400 {
            let n = 4 + seed as usize % 17;
            let (rank, friction) = (n + seed as usize % (n + 1), 0.1 + 0.23 * (seed % 9) as f64);
            let mut problem = random(n, rank, friction, 1000 + seed);
            problem.contacts.iter_mut().for_each(|c| c.bound = 0.0);
            let mut impulses = vec![0.0; 2 * n];
            let solved = problem.solve(&mut impulses);
            let residual = problem.residual(&impulses) / problem.scale();
            assert!(solved.is_ok(), "{seed}: {n} contacts, rank {rank}, {friction}: {residual:e}");
            worst = worst.max(residual);
        }
        assert!(worst <= 1e-11, "{worst:e}");
    }

    #[test]
    fn the_direct_solution_helps_where_sweeps_crawl() {
        // A chain of equal masses fixed at one end: sweeps alone need thousands of rounds.
        let n = 200;
        let mut problem = ImpactProblem::default();
        problem.resize(n);
        let m = 2 * n;
        for i in 0..n {
            problem.delassus[2 * i * m + 2 * i] = 2.0;
            if i > 0 {
                problem.delassus[2 * i * m + 2 * (i - 1)] = -1.0;
                problem.delassus[2 * (i - 1) * m + 2 * i] = -1.0;
            }
        }
        problem.free[2 * (n - 1)] = -1.0;
        let mut impulses = vec![0.0; m];
        problem.solve(&mut impulses).unwrap();
        assert!(problem.residual(&impulses) <= 1e-13);
        // The condition number is 4e4, and redundancy is met by a shift of 1e-13.
        assert!((impulses[0] - 1.0 / (n as f64 + 1.0)).abs() < 1e-10, "{}", impulses[0]);
    }
}
