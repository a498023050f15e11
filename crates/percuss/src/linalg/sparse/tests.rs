use super::*;

/// Entries of a matrix: row, column, value; those given twice add up.
fn matrix(n: usize, entries: &[(usize, usize, f64)]) -> SparseLu {
    let pattern: Vec<_> = entries.iter().map(|(row, column, _)| (*row, *column)).collect();
    let mut lu = SparseLu::new(n, &pattern);
    for (row, column, value) in entries {
        let place = lu.place(*row, *column);
        lu.values[place] += value;
    }
    lu
}

/// Largest residual of a solution, relative to the terms of its row.
fn residual(n: usize, entries: &[(usize, usize, f64)], lu: &SparseLu) -> f64 {
    let b: Vec<f64> = (0..n).map(|i| 1.0 + (i % 7) as f64).collect();
    let mut x = b.clone();
    lu.solve(&mut x);
    let (mut left, mut size) = (b.iter().map(|b| -b).collect::<Vec<f64>>(), b);
    for (row, column, value) in entries {
        left[*row] += value * x[*column];
        size[*row] += (value * x[*column]).abs();
    }
    left.iter().zip(size).map(|(left, size)| (left / size).abs()).fold(0.0, f64::max)
}

#[test]
fn solves_a_saddle_with_zeros_on_its_diagonal() {
    let a = [(0, 0, 2.0), (0, 2, 1.0), (1, 1, 3.0), (1, 2, 1.0), (2, 0, 1.0), (2, 1, 1.0)];
    let mut lu = matrix(3, &a);
    assert!(lu.factor());
    assert!(residual(3, &a, &lu) < 1e-15);
}

#[test]
fn pivots_are_sought_where_those_on_the_diagonal_are_none() {
    // Pairs of coupled unknowns, each with an entry in the row of the other.
    let mut a = Vec::new();
    for k in 0..30 {
        let (i, j) = (2 * k, 2 * k + 1);
        a.extend([(i, j, 3.0), (j, i, 2.0), (i, i, 0.0), (j, j, 0.0)]);
        if k > 0 {
            a.extend([(i, i - 1, 0.5), (i - 1, i, -0.25), (j, i - 2, 0.3)]);
        }
    }
    let mut lu = matrix(60, &a);
    assert!(lu.factor());
    assert!(lu.sought.is_some());
    assert!(residual(60, &a, &lu) < 1e-14);
}

#[test]
fn solves_random_unsymmetric_systems_of_structures() {
    let mut seed = 7_u64;
    let mut next = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) as f64 / (1_u64 << 30) as f64 - 1.0
    };
    for (bays, storeys, dominance) in [(3, 5, 8.0), (10, 20, 8.0), (4, 4, 0.0), (7, 3, 0.5)] {
        const FREE: usize = 4;
        let node = |bay: usize, storey: usize| FREE * (storey * (bays + 1) + bay);
        let n = node(0, storeys);
        let mut a = Vec::new();
        let mut tie = |from: usize, to: usize, more: f64| {
            for i in 0..FREE {
                for j in 0..FREE {
                    let share = if i == j && from == to { more } else { 0.0 };
                    a.push((from + i, to + j, next() + share));
                }
            }
        };
        for storey in 0..storeys {
            for bay in 0..=bays {
                tie(node(bay, storey), node(bay, storey), dominance);
                for (b, s) in [(bay + 1, storey), (bay, storey + 1)] {
                    if b <= bays && s < storeys {
                        tie(node(bay, storey), node(b, s), 0.0);
                        tie(node(b, s), node(bay, storey), 0.0);
                    }
                }
            }
        }
        let mut lu = matrix(n, &a);
        assert!(lu.factor());
        let good = dominance > 1.0;
        assert!(!good || lu.sought.is_none(), "{bays} bays, {storeys} storeys");
        let left = residual(n, &a, &lu);
        assert!(left < 1e-11, "{bays} bays, {storeys} storeys: {left:e}");
    }
}

#[test]
fn a_singular_matrix_has_no_factors() {
    let mut a = vec![(0, 0, 1.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, 1.0)];
    a.extend((2..50).map(|i| (i, i, 1.0)));
    let mut lu = matrix(50, &a);
    assert!(!lu.factor());
    let mut x = vec![1.0; 50];
    lu.solve(&mut x);
    assert!(x.iter().all(|x| x.is_nan()));
    // A matrix of the same pattern that is not singular has some again.
    let place = lu.place(1, 1);
    lu.values.fill(0.0);
    lu.values[place] = 9.0;
    for i in (0..50).filter(|i| *i != 1) {
        let place = lu.place(i, i);
        lu.values[place] = 1.0;
    }
    assert!(lu.factor());
}
