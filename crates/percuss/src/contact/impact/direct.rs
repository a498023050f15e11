//! The impact problem as a linear complementarity problem, for where sweeps are slow.
//!
//! Coulomb's law in the plane is piecewise linear (Anitescu and Potra, *Nonlinear Dynamics* 14, 1997, with two directions): with positive
//! tangential impulses forwards and backwards, and the sliding speed g, `g + z_t >= 0` is complementary to the one forwards, `g - z_t >= 0` to the
//! one backwards, and the unused friction, `mu L_n` minus their sum, to g. The unknowns are the normal impulse and, with friction, these three. The
//! matrix is copositive, so that Lemke's method finds a solution unless wedged contacts have none. Impulses are scaled such that the operator has a
//! unit diagonal, rates such that the largest is of order one.

use super::problem::{Direct, ImpactProblem, Unknown};

impl ImpactProblem {
    /// Replaces impulses with those of Lemke's method, if these meet the conditions better; returns the residual.
    pub(super) fn solve_directly(&mut self, impulses: &mut [f64]) -> f64 {
        let mut direct = std::mem::take(&mut self.direct);
        self.pose(&mut direct);
        let Direct { lemke, matrix, right, values, units, .. } = &mut direct;
        let mut residual = self.residual(impulses);
        let most = self.most();
        // The unit of the lightest is the smallest; its tolerance for heavier bodies is checked below.
        let unit = units.iter().copied().filter(|u| *u > 0.0).fold(f64::INFINITY, f64::min);
        if lemke.solve(matrix, right, most / (unit * self.scale()), values).is_finite() {
            self.read(&mut direct);
            let found = self.residual(&direct.impulses);
            if found < residual && direct.impulses.iter().all(|l| l.abs() <= most) {
                residual = found;
                impulses.copy_from_slice(&direct.impulses);
            }
        }
        self.direct = direct;
        residual
    }

    fn pose(&self, direct: &mut Direct) {
        let Direct { units, unknowns, matrix, right, .. } = direct;
        units.clear();
        units.extend((0..2 * self.count()).map(|row| {
            let looked_at = row.is_multiple_of(2) || self.contacts[row / 2].friction > 0.0;
            let w = self.diagonal(row);
            if looked_at && w > 0.0 { 1.0 / w.sqrt() } else { 0.0 }
        }));
        let pressing = (0..self.count()).filter(|i| units[2 * i] > 0.0);
        let rubbing = pressing.clone().filter(|i| units[2 * i + 1] > 0.0);
        unknowns.clear();
        unknowns.extend(pressing.map(Unknown::Normal));
        for sign in [1.0, -1.0] {
            unknowns.extend(rubbing.clone().map(|i| Unknown::Tangent(i, sign)));
        }
        unknowns.extend(rubbing.map(Unknown::Speed));
        matrix.clear();
        right.clear();
        for row in &*unknowns {
            matrix.extend(unknowns.iter().map(|column| self.entry(units, *row, *column)));
            right.push(self.constant(units, *row));
        }
    }

    /// Change of the complementary variable of the unknown `row` with the unknown `column`.
    fn entry(&self, units: &[f64], row: Unknown, column: Unknown) -> f64 {
        use Unknown::{Normal, Speed, Tangent};
        let w = |a: usize, b: usize| units[a] * self.delassus[a + 2 * self.count() * b] * units[b];
        match (row, column) {
            (Normal(i), Normal(j)) => w(2 * i, 2 * j),
            (Normal(i), Tangent(j, sign)) => sign * w(2 * i, 2 * j + 1),
            (Tangent(i, sign), Normal(j)) => sign * w(2 * i + 1, 2 * j),
            (Tangent(i, a), Tangent(j, b)) => a * b * w(2 * i + 1, 2 * j + 1),
            (Tangent(i, _), Speed(j)) if i == j => 1.0,
            (Speed(i), Tangent(j, _)) if i == j => -1.0,
            (Speed(i), Normal(j)) if i == j => self.slope(units, i),
            (Normal(_) | Tangent(..), Speed(_)) | (Speed(_), _) => 0.0,
        }
    }

    /// Coefficient of friction in the units of the impulses.
    fn slope(&self, units: &[f64], contact: usize) -> f64 {
        self.contacts[contact].friction * units[2 * contact] / units[2 * contact + 1]
    }

    /// Complementary variable of an unknown for vanishing unknowns.
    fn constant(&self, units: &[f64], unknown: Unknown) -> f64 {
        let (row, sign) = match unknown {
            Unknown::Normal(i) => (2 * i, 1.0),
            Unknown::Tangent(i, sign) => (2 * i + 1, sign),
            Unknown::Speed(_) => return 0.0,
        };
        let w = self.delassus[row..].iter().step_by(2 * self.count());
        let carried = self.contacts.iter().flat_map(|c| c.carried);
        let rate = self.free[row] - w.zip(carried).map(|(w, c)| w * c).sum::<f64>();
        sign * units[row] * (rate - self.goal(row)) / self.scale()
    }

    /// Impulses from the solution.
    fn read(&self, direct: &mut Direct) {
        let Direct { impulses, unknowns, values, units, .. } = direct;
        impulses.clear();
        impulses.resize(2 * self.count(), 0.0);
        for (unknown, value) in unknowns.iter().zip(&*values) {
            match *unknown {
                Unknown::Normal(i) => impulses[2 * i] = value * units[2 * i],
                Unknown::Tangent(i, sign) => {
                    impulses[2 * i + 1] += sign * value * units[2 * i + 1];
                }
                Unknown::Speed(_) => {}
            }
        }
        for (i, contact) in self.contacts.iter().enumerate() {
            let most = contact.friction * impulses[2 * i];
            for k in 0..2 {
                let sum = &mut impulses[2 * i + k];
                let kept = if k == 1 { sum.clamp(-most, most) } else { *sum };
                let moves = units[2 * i + k] > 0.0;
                *sum = if moves { kept * self.scale() - contact.carried[k] } else { 0.0 };
            }
        }
    }
}
