//! Several contacts at once: one complementarity problem for the impulses along normals and tangents.
//!
//! Signorini along the normal, `0 <= z_n - bound  perp  L_n >= 0`; Coulomb along the tangent,
//! `-L_t in mu L_n Sgn(z_t - target)`; rates `z = free + W L` with the Delassus operator W. Solved by the proximal-point iteration of
//! the paper (eqs. 14 to 16), contact after contact. A contact may have carried impulses before, which its conditions then count in. Where that is slow, direct solutions take over: Newton's iteration on what each contact does, open, sticking or sliding, which
//! needs a few linear systems where it converges; where it does not, with the limits of friction held, the problem is to find the minimum of a convex quadratic function in a box, which an active set finds in a finite number of
//! linear systems; sweeps go on from there. What is returned has been checked against the conditions themselves.

use crate::linalg::dense::DenseLu;

/// A contact of the problem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditions {
    /// Least rate of the gap \[m/s\].
    pub bound: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Sliding rate of a contact that sticks \[m/s\].
    pub target: f64,
    /// Impulses along normal and tangent that it has carried already: signs and limits of friction are those of the sums \[N s\].
    pub carried: [f64; 2],
}

impl Conditions {
    /// Least and largest impulse along the tangent for one along the normal; none but what takes back what was carried if the
    /// contact does not press.
    fn friction_limits(&self, normal: f64) -> [f64; 2] {
        let most = (self.friction * (normal + self.carried[0])).max(0.0);
        [-most - self.carried[1], most - self.carried[1]]
    }
}

/// The problem: rows 2 i and 2 i + 1 belong to normal and tangent of contact i.
#[derive(Clone, Debug, Default)]
pub struct ImpactProblem {
    /// Contacts.
    pub contacts: Vec<Conditions>,
    /// Delassus operator, shape (2 n, 2 n), row by row; without friction the rows of the tangent are not looked at \[1/kg\].
    pub delassus: Vec<f64>,
    /// Rates without impulses, shape (2 n) \[m/s\].
    pub free: Vec<f64>,
    direct: Direct,
}

/// Room for the direct solution.
#[derive(Clone, Debug, Default)]
struct Direct {
    lu: DenseLu,
    impulses: Vec<f64>,
    /// Least and largest impulse of each row.
    limits: Vec<[f64; 2]>,
    /// Rows between their limits.
    free: Vec<usize>,
    matrix: Vec<f64>,
    right: Vec<f64>,
    statuses: Vec<Status>,
    /// Rows of the impulses sought.
    sought: Vec<usize>,
}

/// What a contact does.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Status {
    Open,
    Sticks,
    /// Its tangential impulse is at its limit, the upper one for 1, the lower one for -1.
    Slides(f64),
}

/// Shift of the diagonal that makes redundant contacts solvable, relative to it.
const REDUNDANT: f64 = 1e-13;

/// The iteration stalled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stalled;

impl ImpactProblem {
    /// Sweeps between two direct solutions.
    const SWEEPS: usize = 40;
    const ROUNDS: usize = 60;
    /// Impulses beyond so many times what stops the heaviest at every contact are of things that wedge each other.
    const WEDGED: f64 = 10.0;
    /// Changes of what the contacts do, in a row.
    const CHANGES: usize = 20;
    /// Direct solutions in a row, where friction changes its limits.
    const TRIALS: usize = 30;
    const TOLERANCE: f64 = 4e-16;
    /// Violation of the conditions that is round-off, relative to the largest rate.
    const ACCEPTED: f64 = 1e-12;
    /// Violation that is accepted where the iterations crawl, in piles that friction holds in more ways than one; the summary tells
    /// it, as any other.
    const TOLERATED: f64 = 1e-6;

    /// Makes room for `n` contacts.
    pub fn resize(&mut self, n: usize) {
        let none = Conditions { bound: 0.0, friction: 0.0, target: 0.0, carried: [0.0; 2] };
        self.contacts.resize(n, none);
        self.delassus.resize(4 * n * n, 0.0);
        self.free.resize(2 * n, 0.0);
    }

    /// Number of contacts.
    pub fn len(&self) -> usize {
        self.contacts.len()
    }

    fn rate(&self, row: usize, impulses: &[f64]) -> f64 {
        let m = 2 * self.len();
        let w = &self.delassus[row * m..(row + 1) * m];
        self.free[row] + w.iter().zip(impulses).map(|(w, l)| w * l).sum::<f64>()
    }

    fn diagonal(&self, row: usize) -> f64 {
        self.delassus[row * (2 * self.len() + 1)]
    }

    /// Proximal point of the impulse of row `row`, the others as they stand.
    fn prox(&self, row: usize, impulses: &[f64]) -> f64 {
        let contact = &self.contacts[row / 2];
        let w = self.diagonal(row);
        if w <= 0.0 {
            return 0.0; // held on both sides
        }
        if row.is_multiple_of(2) {
            let next = impulses[row] - (self.rate(row, impulses) - contact.bound) / w;
            return next.max(-contact.carried[0]);
        }
        let [low, high] = contact.friction_limits(impulses[row - 1]);
        (impulses[row] - (self.rate(row, impulses) - contact.target) / w).clamp(low, high)
    }

    fn rows(&self) -> impl Iterator<Item = usize> + use<'_> {
        (0..2 * self.len())
            .filter(|row| row.is_multiple_of(2) || self.contacts[row / 2].friction > 0.0)
    }

    /// Solves for the impulses in place, starting from what stands there.
    ///
    /// # Errors
    /// [`Stalled`] if no impulses were found that meet the conditions.
    pub fn solve(&mut self, impulses: &mut [f64]) -> Result<(), Stalled> {
        let mut known = self.delassus.iter().chain(&self.free).chain(impulses.iter());
        if !known.all(|x| x.is_finite()) {
            return Err(Stalled); // an iteration that has run away
        }
        let frictional = self.contacts.iter().any(|c| c.friction > 0.0);
        let single = self.len() == 1 && self.contacts[0].friction == 0.0;
        for round in 0..Self::ROUNDS {
            for _ in 0..Self::SWEEPS {
                let moved = self.sweep(impulses);
                if single || moved <= Self::TOLERANCE {
                    return Ok(());
                }
            }
            if !impulses.iter().all(|x| x.is_finite()) {
                return Err(Stalled);
            }
            let enough = match round {
                0..10 => 0.1 * Self::ACCEPTED,
                10..20 => 10.0 * Self::ACCEPTED,
                _ => Self::TOLERATED,
            };
            if self.residual(impulses) <= enough * self.scale() {
                return Ok(());
            }
            if !frictional || !self.improve_by_status(impulses) {
                self.improve(impulses);
            }
        }
        if self.residual(impulses) <= Self::TOLERATED * self.scale() {
            Ok(())
        } else {
            Err(Stalled)
        }
    }

    /// One sweep; returns the largest change of an impulse relative to the largest impulse.
    fn sweep(&self, impulses: &mut [f64]) -> f64 {
        let (mut change, mut size) = (0.0_f64, 0.0_f64);
        for row in self.rows() {
            let next = self.prox(row, impulses);
            change = change.max((next - impulses[row]).abs());
            size = size.max(next.abs());
            impulses[row] = next;
        }
        if change == 0.0 { 0.0 } else { change / size.max(f64::MIN_POSITIVE) }
    }

    /// Largest rate in the problem \[m/s\].
    pub fn scale(&self) -> f64 {
        let bounds = self.contacts.iter().flat_map(|c| [c.bound, c.target]);
        let rows = self.rows().map(|r| self.free[r]);
        rows.chain(bounds).fold(0.0_f64, |m, x| m.max(x.abs()))
    }

    /// Largest violation of the conditions, as a rate \[m/s\].
    pub fn residual(&self, impulses: &[f64]) -> f64 {
        let miss = |row: usize| {
            let apart = (self.prox(row, impulses) - impulses[row]).abs() * self.diagonal(row);
            if row.is_multiple_of(2) {
                let pulls = -impulses[row] - self.contacts[row / 2].carried[0];
                apart.max(pulls * self.diagonal(row))
            } else {
                apart
            }
        };
        self.rows().map(miss).fold(0.0, f64::max)
    }

    /// Newton's iteration on what the contacts do; kept is what meets the conditions best. Tells whether that does.
    fn improve_by_status(&mut self, impulses: &mut [f64]) -> bool {
        let mut direct = std::mem::take(&mut self.direct);
        direct.impulses.clear();
        direct.impulses.extend_from_slice(impulses);
        let enough = 0.1 * Self::ACCEPTED * self.scale();
        let stops = self.rows().map(|r| self.diagonal(r)).filter(|w| *w > 0.0);
        let most = Self::WEDGED * self.len() as f64 * self.scale() / stops.fold(f64::MAX, f64::min);
        let mut best = self.residual(impulses);
        for _ in 0..Self::CHANGES {
            direct.statuses.clear();
            direct.statuses.extend((0..self.len()).map(|i| self.status(i, &direct.impulses)));
            if !self.solve_statuses(&mut direct) {
                break;
            }
            // Contacts that wedge each other can carry any impulse without motion: a solution of that kind is none.
            if direct.impulses.iter().any(|l| l.abs() > most) {
                break;
            }
            let left = self.residual(&direct.impulses);
            if left < best {
                best = left;
                impulses.copy_from_slice(&direct.impulses);
            }
            if best <= enough {
                break;
            }
        }
        self.direct = direct;
        best <= enough
    }

    /// What contact `i` does by the proximal points of its impulses.
    fn status(&self, i: usize, impulses: &[f64]) -> Status {
        let contact = &self.contacts[i];
        let toward = |row: usize, goal: f64| {
            let carried = contact.carried[row % 2];
            carried + impulses[row] - (self.rate(row, impulses) - goal) / self.diagonal(row)
        };
        let (n, t) = (2 * i, 2 * i + 1);
        if self.diagonal(n) <= 0.0 || toward(n, contact.bound) <= 0.0 {
            return Status::Open;
        }
        if contact.friction <= 0.0 || self.diagonal(t) <= 0.0 {
            return Status::Slides(0.0);
        }
        let most = contact.friction * toward(n, contact.bound);
        let along = toward(t, contact.target);
        if along.abs() <= most { Status::Sticks } else { Status::Slides(along.signum()) }
    }

    /// Impulses for which each contact does what it is said to do.
    fn solve_statuses(&self, direct: &mut Direct) -> bool {
        let m = 2 * self.len();
        let Direct { lu, impulses, matrix, right, statuses, sought, .. } = direct;
        sought.clear();
        for (i, status) in statuses.iter().enumerate() {
            let contact = &self.contacts[i];
            impulses[2 * i] = -contact.carried[0];
            impulses[2 * i + 1] = -contact.carried[1];
            match status {
                Status::Open => {}
                Status::Sticks => sought.extend([2 * i, 2 * i + 1]),
                Status::Slides(_) => sought.push(2 * i),
            }
        }
        // What is sought stands above what would leave nothing of what was carried; sliding goes with its normal impulse.
        matrix.clear();
        right.clear();
        for &row in &*sought {
            let w = &self.delassus[row * m..(row + 1) * m];
            for &column in &*sought {
                let i = column / 2;
                let along = match statuses[i] {
                    Status::Slides(sign) if column.is_multiple_of(2) => {
                        sign * self.contacts[i].friction * w[column + 1]
                    }
                    _ => 0.0,
                };
                let shift = if column == row { REDUNDANT * w[row] } else { 0.0 };
                matrix.push(w[column] + along + shift);
            }
            right.push(self.goal(row) - self.rate(row, impulses));
        }
        if !lu.factor(sought.len(), matrix) {
            return false;
        }
        lu.solve(right);
        for (row, change) in sought.iter().zip(&*right) {
            impulses[*row] += change;
            if let (Status::Slides(sign), 0) = (statuses[row / 2], row % 2) {
                impulses[row + 1] += sign * self.contacts[row / 2].friction * change;
            }
        }
        right.iter().all(|x| x.is_finite())
    }

    /// Direct solutions, the limits of friction being those of the one before; kept is what meets the conditions best.
    fn improve(&mut self, impulses: &mut [f64]) {
        let mut direct = std::mem::take(&mut self.direct);
        direct.impulses.clear();
        direct.impulses.extend_from_slice(impulses);
        let mut best = self.residual(impulses);
        let frictional = self.contacts.iter().any(|c| c.friction > 0.0);
        for trial in 0..if frictional { Self::TRIALS } else { 1 } {
            // Limits half way between the last two, once it is clear that they swing.
            let ease = if trial < Self::TRIALS / 3 { 1.0 } else { 0.5 };
            self.set_limits(&mut direct, if trial == 0 { 1.0 } else { ease });
            if !self.solve_bounded(&mut direct) {
                break;
            }
            let left = self.residual(&direct.impulses);
            if left < best {
                best = left;
                impulses.copy_from_slice(&direct.impulses);
            }
            if left <= 0.1 * Self::ACCEPTED * self.scale() {
                break;
            }
        }
        self.direct = direct;
    }

    /// Limits of the impulses, those of friction by a share `ease` of the way from the last ones.
    fn set_limits(&self, direct: &mut Direct, ease: f64) {
        direct.limits.resize(2 * self.len(), [0.0; 2]);
        for (i, contact) in self.contacts.iter().enumerate() {
            let now = contact.friction_limits(direct.impulses[2 * i]);
            let between = |k: usize| {
                let before = direct.limits[2 * i + 1][k];
                let known = ease < 1.0 && before.is_finite();
                if known { before + ease * (now[k] - before) } else { now[k] }
            };
            let low = between(0);
            let high = between(1).max(low); // round-off
            direct.limits[2 * i] = [-contact.carried[0], f64::INFINITY];
            direct.limits[2 * i + 1] = [low, high];
            direct.impulses[2 * i + 1] = direct.impulses[2 * i + 1].clamp(low, high);
        }
    }

    /// `W L = goal - free` where impulses lie between their limits: the minimum of a convex quadratic function in a box, by an
    /// active set that takes in or leaves out one row at a time. It ends, however redundant the contacts are.
    fn solve_bounded(&self, direct: &mut Direct) -> bool {
        let rows: Vec<usize> = self.rows().filter(|r| self.diagonal(*r) > 0.0).collect();
        let inside =
            |d: &Direct, r: usize| d.impulses[r] > d.limits[r][0] && d.impulses[r] < d.limits[r][1];
        direct.free = rows.iter().copied().filter(|r| inside(direct, *r)).collect();
        let tolerance = 0.01 * Self::ACCEPTED * self.scale();
        for _ in 0..8 * rows.len() + 8 {
            match self.step_to_limits(direct) {
                None => return false,
                Some(true) => {}
                Some(false) => continue,
            }
            // The row whose rate asks most to be let go of its limit.
            let pull = |r: usize| {
                let miss = self.goal(r) - self.rate(r, &direct.impulses);
                let [low, high] = direct.limits[r];
                let held = high > low && !direct.free.contains(&r);
                let wanted = if direct.impulses[r] <= low { miss } else { -miss };
                if held { wanted } else { 0.0 }
            };
            let worst = rows.iter().copied().max_by(|a, b| pull(*a).total_cmp(&pull(*b)));
            match worst.filter(|r| pull(*r) > tolerance) {
                Some(row) => direct.free.push(row),
                None => return true,
            }
        }
        false
    }

    /// Rate that a row asks for.
    fn goal(&self, row: usize) -> f64 {
        let contact = &self.contacts[row / 2];
        if row.is_multiple_of(2) { contact.bound } else { contact.target }
    }

    /// Goes to the solution of the free rows, or as far towards it as the first limit, whose row is held from then on; tells
    /// whether it got there.
    fn step_to_limits(&self, direct: &mut Direct) -> Option<bool> {
        let (m, k) = (2 * self.len(), direct.free.len());
        direct.matrix.clear();
        direct.right.clear();
        for row in &direct.free {
            let w = &self.delassus[row * m..(row + 1) * m];
            direct.matrix.extend(direct.free.iter().map(|column| w[*column]));
            // Redundant contacts make the matrix singular; any of their solutions will do.
            let last = direct.matrix.len() - k;
            let own = direct.right.len();
            direct.matrix[last + own] += REDUNDANT * w[*row];
            direct.right.push(self.goal(*row) - self.rate(*row, &direct.impulses));
        }
        if !direct.lu.factor(k, &direct.matrix) {
            return None;
        }
        direct.lu.solve(&mut direct.right);
        if !direct.right.iter().all(|x| x.is_finite()) {
            return None;
        }
        let (mut share, mut blocked) = (1.0, None);
        for (at, (row, change)) in direct.free.iter().zip(&direct.right).enumerate() {
            let [low, high] = direct.limits[*row];
            let room = if *change < 0.0 { low } else { high } - direct.impulses[*row];
            if room.abs() < share * change.abs() {
                (share, blocked) = (room / change, Some(at));
            }
        }
        for (row, change) in direct.free.iter().zip(&direct.right) {
            let [low, high] = direct.limits[*row];
            let moved = direct.impulses[*row] + share * change;
            direct.impulses[*row] = moved.clamp(low, high);
        }
        if let Some(at) = blocked {
            let row = direct.free.swap_remove(at);
            let [low, high] = direct.limits[row];
            direct.impulses[row] = if direct.right[at] < 0.0 { low } else { high };
        }
        Some(blocked.is_none())
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
    fn what_was_carried_counts_for_sign_and_friction() {
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
            assert!((problem.rate(0, &impulse) - rate).abs() < 1e-14);
            assert!((impulse[1] + 0.3 * carried - friction).abs() < 1e-14, "{impulse:?}");
        }
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
    fn the_direct_solution_helps_where_sweeps_crawl() {
        // A chain of equal masses held at one end: sweeps alone take thousands of rounds.
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
