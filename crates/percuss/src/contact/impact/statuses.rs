//! Newton's iteration on the states of the contacts: open, sticking or sliding. It needs a few small linear systems if it converges, which it
//! mostly does after the sweeps; redundant contacts with friction can prevent it.

use super::problem::{ImpactProblem, Newton, Status};

/// Shift of the diagonal that makes redundant contacts solvable, relative to it.
const REDUNDANT: f64 = 1e-13;

impl ImpactProblem {
    /// Changes of contact states; a convergent iteration needs one to five.
    const CHANGES: usize = 8;

    /// Newton's iteration on the states of the contacts; the impulses with the least violation are stored. Returns the residual.
    pub(super) fn follow_statuses(&mut self, impulses: &mut [f64]) -> f64 {
        let mut newton = std::mem::take(&mut self.newton);
        newton.impulses.clear();
        newton.impulses.extend_from_slice(impulses);
        let enough = Self::ACCEPTED * self.scale();
        let most = self.most();
        let mut best = self.residual(impulses);
        for _ in 0..Self::CHANGES {
            self.find_rates(&newton.impulses, &mut newton.rates);
            let Newton { impulses: from, rates, statuses, .. } = &mut newton;
            statuses.clear();
            statuses.extend((0..self.count()).map(|i| self.status(i, from, rates)));
            if !self.solve_statuses(&mut newton) {
                break;
            }
            if newton.impulses.iter().any(|l| l.abs() > most) {
                break;
            }
            let left = self.residual(&newton.impulses);
            if left < best {
                best = left;
                impulses.copy_from_slice(&newton.impulses);
            }
            if best <= enough {
                break;
            }
        }
        self.newton = newton;
        best
    }

    /// State of contact `i` from the proximal points of its impulses.
    fn status(&self, i: usize, impulses: &[f64], rates: &[f64]) -> Status {
        let contact = &self.contacts[i];
        let toward = |row: usize, goal: f64| {
            let carried = contact.carried[row % 2];
            carried + impulses[row] - (rates[row] - goal) / self.diagonal(row)
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

    /// Impulses for which each contact has its assumed state.
    fn solve_statuses(&self, newton: &mut Newton) -> bool {
        let m = 2 * self.count();
        let Newton { lu, impulses, rates, matrix, right, statuses, sought } = newton;
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
        // Unknowns are relative to the values that cancel the previous impulses; sliding impulses are proportional to the normal impulse.
        matrix.clear();
        right.clear();
        self.find_rates(impulses, rates);
        for &row in &*sought {
            for &column in &*sought {
                let (i, w) = (column / 2, |column: usize| self.delassus[row + column * m]);
                let along = match statuses[i] {
                    Status::Slides(sign) if column.is_multiple_of(2) => {
                        sign * self.contacts[i].friction * w(column + 1)
                    }
                    _ => 0.0,
                };
                let shift = if column == row { REDUNDANT * w(row) } else { 0.0 };
                matrix.push(w(column) + along + shift);
            }
            right.push(self.goal(row) - rates[row]);
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
}
