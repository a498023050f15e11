//! The linear complementarity problem: `w = M x + q`, `0 <= w  perp  x >= 0`.
//!
//! Lemke's method (Cottle, Pang, Stone, *The Linear Complementarity Problem*): an additional variable, the cover, makes all values positive; it is
//! removed by exchanging variables with their complements, one pair at a time. Ties are broken lexicographically, as if q were `q + (e, e^2, e^3,
//! ...)`, so that no basis occurs twice and the method ends. The last basis is solved again: the solution has no round-off of the exchanges. The
//! matrix may be singular; round-off can then make or break ties and lead to a wrong basis. The result is therefore checked, and other covers are
//! tried if it is wrong.

use super::dense::DenseLu;

/// Memory for Lemke's method; reused from one problem to the next.
#[derive(Clone, Debug, Default)]
pub struct Lemke {
    n: usize,
    tied: f64,
    /// A row for each basic variable: its value, and its coefficients of the variables outside the basis, shape (n, n + 2) \[-\].
    rows: Vec<f64>,
    /// The basic variable of each row, shape (n).
    basis: Vec<Variable>,
    /// The variable of each column outside the basis, shape (n + 1).
    outside: Vec<Variable>,
    /// Row in which each w is basic, or column that it has outside the basis, shape (n).
    places: Vec<TableauPlace>,
    /// Rows that are equal in the ratio test, shape (such rows) \[index of a row\].
    ties: Vec<usize>,
    /// The row exchanged last, shape (n + 2) \[-\].
    pivot_row: Vec<f64>,
    lu: DenseLu,
    /// The matrix among the x that are basic at the end, row by row, shape (basic x, basic x) \[-\].
    matrix: Vec<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Variable {
    W(usize),
    X(usize),
    /// Coefficients of the cover, which makes all values positive.
    Cover,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum TableauPlace {
    Row(usize),
    Column(usize),
}

impl Lemke {
    /// Coefficients below this are round-off, for data of order one.
    const ROUND_OFF: f64 = 1e-11;
    /// Ratios that differ by less are equal, in turns.
    const TIED: [f64; 2] = [1e-13, 1e-11];
    /// Covers that are tried.
    const COVERS: usize = 6;
    /// Violation of the conditions that is round-off, for data of order one.
    const SOLVED: f64 = 1e-14;

    /// Solves for x up to `most`, given the matrix row by row and q, both of order one; returns the largest violation of the conditions, relative
    /// to the largest x if that is above one, infinite without a solution. For copositive matrices there is then no such solution, except for
    /// round-off.
    pub fn solve(&mut self, matrix: &[f64], q: &[f64], most: f64, x: &mut Vec<f64>) -> f64 {
        let mut least = f64::INFINITY;
        let mut found = Vec::new();
        for cover in 0..Self::COVERS {
            self.begin(matrix, q, cover);
            if !self.drive_out_cover(q) {
                continue;
            }
            self.finish(matrix, q, &mut found);
            let violation = violation(matrix, q, &found);
            if violation < least && found.iter().all(|x| *x <= most) {
                least = violation;
                std::mem::swap(x, &mut found);
            }
            if least <= Self::SOLVED {
                break;
            }
        }
        least
    }

    fn drive_out_cover(&mut self, q: &[f64]) -> bool {
        let n = self.n;
        // The row that needs the cover most; none if q solves the problem.
        let need = |i: usize| -q[i] / self.coefficient(i, n);
        let most = (0..n).max_by(|a, b| need(*a).total_cmp(&need(*b)));
        let Some(mut row) = most.filter(|i| q[*i] < 0.0) else { return true };
        let mut column = n;
        for _ in 0..50 * n + 50 {
            column = match self.exchange(row, column) {
                Variable::Cover => return true,
                Variable::W(i) => self.column_of(Variable::X(i)),
                Variable::X(i) => self.column_of(Variable::W(i)),
            };
            match self.leaving(column) {
                Some(next) => row = next,
                None => return false,
            }
        }
        false
    }

    /// The basis of all w, with the `cover`-th cover: ones first, then unrelated numbers between 1/2 and 3/2.
    fn begin(&mut self, matrix: &[f64], q: &[f64], cover: usize) {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let n = q.len();
        self.n = n;
        self.tied = Self::TIED[cover % Self::TIED.len()];
        self.rows.clear();
        for i in 0..n {
            self.rows.push(q[i]);
            self.rows.extend_from_slice(&matrix[i * n..(i + 1) * n]);
            let share = (GOLDEN * (i * cover) as f64).fract();
            self.rows.push(if cover == 0 { 1.0 } else { 0.5 + share });
        }
        self.basis.clear();
        self.basis.extend((0..n).map(Variable::W));
        self.outside.clear();
        self.outside.extend((0..n).map(Variable::X));
        self.outside.push(Variable::Cover);
        self.places.clear();
        self.places.extend((0..n).map(TableauPlace::Row));
    }

    fn column_of(&self, variable: Variable) -> usize {
        self.outside.iter().position(|v| *v == variable).expect("complement of what has just left")
    }

    fn value(&self, row: usize) -> f64 {
        self.rows[row * (self.n + 2)]
    }

    fn coefficient(&self, row: usize, column: usize) -> f64 {
        self.rows[row * (self.n + 2) + 1 + column]
    }

    /// The row whose variable is the first to vanish as that of `column` grows.
    fn leaving(&mut self, column: usize) -> Option<usize> {
        let mut ties = std::mem::take(&mut self.ties);
        ties.clear();
        ties.extend((0..self.n).filter(|i| self.coefficient(*i, column) < -Self::ROUND_OFF));
        self.keep_least(&mut ties, column, |lemke, row| lemke.value(row));
        let found = match ties.iter().find(|i| self.basis[**i] == Variable::Cover) {
            Some(row) => Some(*row),
            None => {
                for k in 0..self.n {
                    if ties.len() <= 1 {
                        break;
                    }
                    self.keep_least(&mut ties, column, |lemke, row| lemke.perturbation(row, k));
                }
                ties.first().copied()
            }
        };
        self.ties = ties;
        found
    }

    /// Keeps the rows whose `part` allows the variable of `column` the least.
    fn keep_least(&self, rows: &mut Vec<usize>, column: usize, part: impl Fn(&Self, usize) -> f64) {
        let ratio = |row: usize| -part(self, row) / self.coefficient(row, column);
        let least = rows.iter().map(|r| ratio(*r)).fold(f64::INFINITY, f64::min);
        rows.retain(|r| ratio(*r) <= least + self.tied * least.abs().max(1.0));
    }

    /// Coefficient of the `k`-th power of the perturbation in a basic variable.
    fn perturbation(&self, row: usize, k: usize) -> f64 {
        match self.places[k] {
            TableauPlace::Row(own) => f64::from(own == row),
            TableauPlace::Column(column) => -self.coefficient(row, column),
        }
    }

    /// Exchanges the basic variable of a row with that of a column outside; returns the variable that left the basis.
    fn exchange(&mut self, row: usize, column: usize) -> Variable {
        let (width, at) = (self.n + 2, column + 1);
        let pivot = self.rows[row * width + at];
        self.pivot_row.clear();
        self.pivot_row.extend(self.rows[row * width..(row + 1) * width].iter().map(|a| -a / pivot));
        self.pivot_row[at] = 1.0 / pivot;
        for (i, other) in self.rows.chunks_exact_mut(width).enumerate() {
            if i == row {
                other.copy_from_slice(&self.pivot_row);
                continue;
            }
            let factor = std::mem::take(&mut other[at]);
            if factor != 0.0 {
                other.iter_mut().zip(&self.pivot_row).for_each(|(a, p)| *a += factor * p);
            }
        }
        let left = std::mem::replace(&mut self.basis[row], self.outside[column]);
        self.outside[column] = left;
        if let Variable::W(i) = left {
            self.places[i] = TableauPlace::Column(column);
        }
        if let Variable::W(i) = self.basis[row] {
            self.places[i] = TableauPlace::Row(row);
        }
        left
    }

    /// Values of x in the basis reached, from a factorisation of its own where that can be had.
    fn finish(&mut self, matrix: &[f64], q: &[f64], x: &mut Vec<f64>) {
        let n = self.n;
        x.clear();
        x.resize(n, 0.0);
        for (row, variable) in self.basis.iter().enumerate() {
            if let Variable::X(i) = variable {
                x[*i] = self.rows[row * (n + 2)].max(0.0);
            }
        }
        // Of each pair one is in the basis now: x where w is outside.
        let outside = |i: &usize| matches!(self.places[*i], TableauPlace::Column(_));
        let active: Vec<usize> = (0..n).filter(outside).collect();
        self.matrix.clear();
        for i in &active {
            self.matrix.extend(active.iter().map(|j| matrix[i * n + j]));
        }
        if !self.lu.factor(active.len(), &self.matrix) {
            return;
        }
        let mut right: Vec<f64> = active.iter().map(|i| -q[*i]).collect();
        self.lu.solve(&mut right);
        if right.iter().all(|x| x.is_finite()) {
            active.iter().zip(&right).for_each(|(i, value)| x[*i] = value.max(0.0));
        }
    }
}

/// Largest violation of the conditions, relative to the largest x where that is above one.
fn violation(matrix: &[f64], q: &[f64], x: &[f64]) -> f64 {
    let n = q.len();
    let size = x.iter().fold(1.0_f64, |m, x| m.max(*x));
    let miss = |i: usize| {
        let w = q[i] + matrix[i * n..(i + 1) * n].iter().zip(x).map(|(m, x)| m * x).sum::<f64>();
        w.min(x[i]).abs()
    };
    (0..n).map(miss).fold(0.0, f64::max) / size
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_problem_with_one_solution() {
        // 2 x1 + x2 = 5, x1 + 2 x2 = 6.
        let (matrix, q) = ([2.0, 1.0, 1.0, 2.0], [-5.0, -6.0]);
        let mut x = Vec::new();
        assert!(Lemke::default().solve(&matrix, &q, 1e9, &mut x) < 1e-13);
        assert!((x[0] - 4.0 / 3.0).abs() < 1e-15 && (x[1] - 7.0 / 3.0).abs() < 1e-15, "{x:?}");
    }

    #[test]
    fn a_ray_tells_that_nothing_solves_it() {
        // w_1 = -1 whatever x is.
        let mut x = Vec::new();
        assert_eq!(
            Lemke::default().solve(&[0.0, 0.0, 0.0, 1.0], &[-1.0, 1.0], 1e9, &mut x),
            f64::INFINITY
        );
    }

    #[test]
    fn solutions_too_large_are_none() {
        let mut x = Vec::new();
        assert_eq!(Lemke::default().solve(&[1e-6], &[-1.0], 1e5, &mut x), f64::INFINITY);
        assert!(Lemke::default().solve(&[1e-6], &[-1.0], 1e7, &mut x) < 1e-15);
    }

    #[test]
    fn many_equal_rows_do_not_cycle() {
        // Rank one, all rows equal: every basis is degenerate.
        for n in [2, 7, 40] {
            let (matrix, q) = (vec![1.0; n * n], vec![-1.0; n]);
            let mut x = Vec::new();
            assert!(Lemke::default().solve(&matrix, &q, 1e9, &mut x) < 1e-13);
            assert!(violation(&matrix, &q, &x) < 1e-14);
        }
    }

    #[test]
    fn chains_of_hundreds() {
        let n = 300;
        let mut matrix = vec![0.0; n * n];
        for i in 0..n {
            matrix[i * n + i] = 1.0;
            if i > 0 {
                matrix[i * n + i - 1] = -0.5;
                matrix[(i - 1) * n + i] = -0.5;
            }
        }
        let q: Vec<f64> = (0..n).map(|i| if i % 7 < 4 { -1.0 } else { 0.9 }).collect();
        let mut x = Vec::new();
        assert!(Lemke::default().solve(&matrix, &q, 1e9, &mut x) < 1e-13);
        assert!(violation(&matrix, &q, &x) < 1e-13);
    }
}
