//! Block elimination of sparse systems in [`Wide`] numbers, with the signs of the pivots.
//!
//! Stiffness of a mesh of n elements has a condition of n^4: from some thousand elements on, factors in f64 do not resolve the lowest modes.
//! Unknowns form groups (a node; a joint's nodes with the multipliers of its constraints), which are eliminated in an order of least degree. Pivots
//! are exchanged within groups. For a symmetric matrix the number of negative eigenvalues of the pivot blocks is that of the matrix (Sylvester's
//! law of inertia).

use super::ordering::{least_degree, neighbours};
use super::wide_block::{inverse, negatives, sub_product};
use crate::scalar::Wide;

/// Order and places of a sparse matrix of blocks, found once.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Unknowns of each group, shape (groups) \[number of unknowns\].
    sizes: Vec<usize>,
    /// First unknown of each group, shape (groups) \[index of an unknown\].
    pub first: Vec<usize>,
    /// Groups in the order of their elimination, shape (groups) \[index of a group\].
    order: Vec<usize>,
    /// Place of each group in that order, shape (groups) \[index in `order`\].
    rank: Vec<usize>,
    /// Remaining groups coupled with a group at its elimination, in the order of their elimination, by group, shape (groups, such groups) \[index
    /// of a group\].
    later: Vec<Vec<usize>>,
    /// Place of a group's diagonal block in the values, shape (groups) \[index of a value\]; blocks to the right and below follow, pair by
    /// pair.
    start: Vec<usize>,
    total: usize,
}

impl Pattern {
    /// Groups of the given sizes, coupled in the given pairs.
    pub fn new(sizes: Vec<usize>, couplings: impl Iterator<Item = (usize, usize)>) -> Self {
        let n = sizes.len();
        let (order, mut later) = least_degree(&sizes, neighbours(n, couplings));
        let mut rank = vec![0; n];
        order.iter().enumerate().for_each(|(i, g)| rank[*g] = i);
        let mut start = vec![0; n];
        let mut total = 0;
        for g in &order {
            later[*g].sort_unstable_by_key(|j| rank[*j]);
            start[*g] = total;
            total += sizes[*g] * sizes[*g];
            total += later[*g].iter().map(|j| 2 * sizes[*g] * sizes[*j]).sum::<usize>();
        }
        let first = sizes.iter().scan(0, |at, s| Some(std::mem::replace(at, *at + s))).collect();
        Self { sizes, first, order, rank, later, start, total }
    }

    /// Number of values of a matrix.
    pub fn value_count(&self) -> usize {
        self.total
    }

    /// Place of the block between two groups: its first value, the step from row to row.
    pub fn place(&self, row: usize, column: usize) -> (usize, usize) {
        let size = |g: usize| self.sizes[g];
        if row == column {
            return (self.start[row], size(row));
        }
        let upper = self.rank[row] < self.rank[column];
        let (early, late) = if upper { (row, column) } else { (column, row) };
        let (own, mut at) = (size(early), self.start[early] + size(early) * size(early));
        for j in &self.later[early] {
            if *j == late {
                break;
            }
            at += 2 * own * size(*j);
        }
        if upper { (at, size(late)) } else { (at + own * size(late), own) }
    }
}

/// Factors of a matrix.
#[derive(Clone, Debug)]
pub struct Factors<'p> {
    pattern: &'p Pattern,
    /// The factors, in the order of the pattern, shape (values of the pattern) \[unit of the matrix\].
    values: Vec<Wide>,
    /// Number of negative eigenvalues of the matrix, if it is symmetric and they are requested.
    pub negative: usize,
}

impl<'p> Factors<'p> {
    /// Factors `values`; `None` if a pivot block is singular to the last digit.
    pub fn new(pattern: &'p Pattern, mut values: Vec<Wide>, count: bool) -> Option<Self> {
        let mut negative = 0;
        let (mut own, mut right, mut scratch) = (Vec::new(), Vec::new(), Vec::new());
        for g in &pattern.order {
            let (s, start) = (pattern.sizes[*g], pattern.start[*g]);
            let later = &pattern.later[*g];
            let end =
                start + s * s + later.iter().map(|j| 2 * s * pattern.sizes[*j]).sum::<usize>();
            own.clear();
            own.extend_from_slice(&values[start..end]);
            let (pivot, beyond) = own.split_at_mut(s * s);
            if count {
                negative += negatives(pivot, s, &mut scratch)?;
            }
            inverse(pivot, s).then_some(())?;
            // D^-1 U replaces U.
            let mut at = 0;
            for j in later {
                let m = pattern.sizes[*j];
                right.clear();
                right.resize(s * m, Wide::ZERO);
                sub_product(&mut right, m, pivot, &beyond[at..at + s * m], s, s, m);
                right.iter().zip(&mut beyond[at..at + s * m]).for_each(|(r, b)| *b = -*r);
                at += 2 * s * m;
            }
            let mut at_row = 0;
            for i in later {
                let rows = pattern.sizes[*i];
                let lower = at_row + s * rows;
                let mut at_column = 0;
                for j in later {
                    let columns = pattern.sizes[*j];
                    let (place, stride) = pattern.place(*i, *j);
                    let target = &mut values[place..];
                    let (l, u) = (&beyond[lower..], &beyond[at_column..]);
                    sub_product(target, stride, l, u, rows, s, columns);
                    at_column += 2 * s * columns;
                }
                at_row += 2 * s * rows;
            }
            values[start..end].copy_from_slice(&own);
        }
        Some(Self { pattern, values, negative })
    }

    /// Solves in place.
    pub fn solve(&self, x: &mut [Wide]) {
        let p = self.pattern;
        let mut pivoted: Vec<Wide> = Vec::new();
        for g in &p.order {
            let (s, start, first) = (p.sizes[*g], p.start[*g], p.first[*g]);
            pivoted.clear();
            pivoted.resize(s, Wide::ZERO);
            sub_product(&mut pivoted, 1, &self.values[start..], &x[first..first + s], s, s, 1);
            let mut at = start + s * s;
            for j in &p.later[*g] {
                let m = p.sizes[*j];
                // Minus the solution so far: it adds.
                let lower = &self.values[at + s * m..];
                for r in 0..m {
                    let mut sum = x[p.first[*j] + r];
                    for c in 0..s {
                        sum += lower[r * s + c] * pivoted[c];
                    }
                    x[p.first[*j] + r] = sum;
                }
                at += 2 * s * m;
            }
            (0..s).for_each(|k| x[first + k] = -pivoted[k]);
        }
        for g in p.order.iter().rev() {
            let (s, first) = (p.sizes[*g], p.first[*g]);
            let mut at = p.start[*g] + s * s;
            for j in &p.later[*g] {
                let m = p.sizes[*j];
                for r in 0..s {
                    let mut sum = x[first + r];
                    for c in 0..m {
                        sum -= self.values[at + r * m + c] * x[p.first[*j] + c];
                    }
                    x[first + r] = sum;
                }
                at += 2 * s * m;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Groups of sizes 1 to 3 in a ring with chords, symmetric, some of it negative.
    #[test]
    fn solves_and_counts_what_is_negative() {
        let sizes: Vec<usize> = (0..9).map(|i| 1 + i % 3).collect();
        let pairs = || (0..9).map(|i| (i, (i + 1) % 9)).chain([(0, 4), (2, 7)]);
        let pattern = Pattern::new(sizes.clone(), pairs());
        let n: usize = sizes.iter().sum();
        let mut dense = nalgebra::DMatrix::<f64>::zeros(n, n);
        let mut values = vec![Wide::ZERO; pattern.value_count()];
        let mut seed = 7_u64;
        let mut next = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
        };
        for (a, b) in pairs().chain((0..9).map(|i| (i, i))) {
            for r in 0..sizes[a] {
                for c in 0..sizes[b] {
                    let (i, j) = (pattern.first[a] + r, pattern.first[b] + c);
                    let v = next();
                    (dense[(i, j)], dense[(j, i)]) = (v, v);
                }
            }
        }
        for (a, b) in pairs().flat_map(|(a, b)| [(a, b), (b, a)]).chain((0..9).map(|i| (i, i))) {
            let (place, stride) = pattern.place(a, b);
            for r in 0..sizes[a] {
                for c in 0..sizes[b] {
                    let value = dense[(pattern.first[a] + r, pattern.first[b] + c)];
                    values[place + r * stride + c] = Wide::from(value);
                }
            }
        }
        let factors = Factors::new(&pattern, values, true).unwrap();
        let below = dense.clone().symmetric_eigenvalues().iter().filter(|e| **e < 0.0).count();
        assert_eq!(factors.negative, below);
        let given: Vec<f64> = (0..n).map(|i| i as f64 - 3.0).collect();
        let mut x: Vec<Wide> = given.iter().map(|v| Wide::from(*v)).collect();
        factors.solve(&mut x);
        let x = nalgebra::DVector::from_iterator(n, x.iter().map(|v| v.round()));
        for (left, right) in (dense * x).iter().zip(&given) {
            assert!((left - right).abs() < 1e-12);
        }
    }
}
