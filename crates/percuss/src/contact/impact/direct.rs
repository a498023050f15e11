//! Direct solutions of the impact problem, for where sweeps are slow.

use super::ImpactProblem;
use crate::linalg::dense::DenseLu;

/// Room for the direct solution.
#[derive(Clone, Debug, Default)]
pub(super) struct Direct {
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

impl ImpactProblem {
    /// Impulses beyond so many times what stops the heaviest at every contact are of things that wedge each other.
    const WEDGED: f64 = 10.0;
    /// Changes of what the contacts do, in a row.
    const CHANGES: usize = 20;
    /// Direct solutions in a row, where friction changes its limits.
    const TRIALS: usize = 30;

    /// Comes nearer to a solution, if it can.
    pub(super) fn improve(&mut self, impulses: &mut [f64], frictional: bool) {
        if !frictional || !self.improve_by_status(impulses) {
            self.improve_by_limits(impulses, frictional);
        }
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
    fn improve_by_limits(&mut self, impulses: &mut [f64], frictional: bool) {
        let mut direct = std::mem::take(&mut self.direct);
        direct.impulses.clear();
        direct.impulses.extend_from_slice(impulses);
        let mut best = self.residual(impulses);
        for trial in 0..if frictional { Self::TRIALS } else { 1 } {
            // Limits half way between the last two, once it is clear that they swing.
            let ease = if trial < Self::TRIALS / 3 { 1.0 } else { 0.5 };
            self.set_limits(&mut direct, if trial == 0 { 1.0 } else { ease });
            if !self.solve_bounded(&mut direct) {
                eprintln!("WEDGED");
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
