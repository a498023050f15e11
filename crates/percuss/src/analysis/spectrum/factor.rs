//! Factors of a matrix over the degrees of freedom of a structure.

use super::matrix::{Layout, Matrix, times};
use crate::linalg::elimination::Factors;
use crate::scalar::Wide;

/// A factored matrix.
pub struct Factored<'l> {
    layout: &'l Layout<'l>,
    factors: Factors<'l>,
    /// Negative eigenvalues in the space that supports and joints leave free.
    pub negative: usize,
}

impl Factored<'_> {
    /// Nodal values of the solution for nodal forces.
    pub fn solve(&self, forces: &[[f64; 4]]) -> Vec<[f64; 4]> {
        self.solve_with_multipliers(forces).0
    }

    /// The same with the multipliers of constraints.
    pub fn solve_with_multipliers(&self, forces: &[[f64; 4]]) -> (Vec<[f64; 4]>, Vec<f64>) {
        let Layout { model, pattern, home, hold, free, multiplier, .. } = self.layout;
        let place = |(group, at): (usize, usize)| pattern.first[group] + at;
        let mut x = vec![Wide::ZERO; 4 * model.node_count() + multiplier.len()];
        let freed = |i: usize, f: [Wide; 4]| hold[i].map_or(f, |h| times(&f, &free[h]));
        for (i, f) in forces.iter().enumerate() {
            let at = place(home[i]);
            x[at..at + 4].copy_from_slice(&freed(i, f.map(Wide::from)));
        }
        self.factors.solve(&mut x);
        let node = |i: usize| {
            let at = place(home[i]);
            freed(i, std::array::from_fn(|k| x[at + k])).map(Wide::round)
        };
        let multipliers = multiplier.iter().map(|m| x[place(*m)].round()).collect();
        ((0..model.node_count()).map(node).collect(), multipliers)
    }
}

impl Layout<'_> {
    /// Factors a matrix; with its negative eigenvalues beside those of constraints if `count`. `None` if it is singular.
    pub fn factor(&self, matrix: Matrix, count: bool) -> Option<Factored<'_>> {
        let Matrix { mut values, constrained, .. } = matrix;
        for (h, dofs) in self.model.prescribed.iter().enumerate() {
            let (group, at) = self.home[dofs.node];
            let (start, stride) = self.pattern.place(group, group);
            let place = |r: usize, c: usize| start + (at + r) * stride + at + c;
            let own = (0..4).fold(0.0_f64, |m, k| m.max(values[place(k, k)].round().abs()));
            let scale = if own > 0.0 { own } else { 1.0 };
            for r in 0..4 {
                for c in 0..4 {
                    let one = if r == c { Wide::ONE } else { Wide::ZERO };
                    values[place(r, c)] += (one - self.free[h][r][c]) * scale;
                }
            }
        }
        let factors = Factors::new(&self.pattern, values, count)?;
        let negative = factors.negative.saturating_sub(constrained);
        Some(Factored { layout: self, factors, negative })
    }
}
