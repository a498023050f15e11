//! Solutions against products.

use super::super::block::Block;
use super::*;

/// A matrix with two chains of 6 and 5 nodes, couplings and constraints, and its product with a vector.
fn sample(couplings: &[(usize, usize)], border: &[BorderPattern]) -> Condensed {
    let mut seed = 7_u64;
    let mut next = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
    };
    let mut fill = |diagonal: f64| -> Block {
        std::array::from_fn(|r| {
            std::array::from_fn(|c| next() + if r == c { diagonal } else { 0.0 })
        })
    };
    let n = 11;
    let mut a = Condensed::new(n, |i| i != 5, couplings, border);
    for i in 0..n {
        a.chain.diag[i] = fill(5.0);
        if i != 5 && i + 1 < n {
            (a.chain.upper[i], a.chain.lower[i]) = (fill(0.0), fill(0.0));
        }
    }
    for coupling in &mut a.couplings {
        coupling.2 = fill(0.0);
    }
    let values: Vec<[f64; 4]> = (0..100).map(|_| fill(1.0)[0]).collect();
    let mut k = 0;
    for vector in a.columns.iter_mut().chain(&mut a.rows) {
        for (_, value) in vector {
            *value = values[k];
            k += 1;
        }
    }
    a
}

fn multiply(a: &Condensed, x: &[[f64; 4]], border: &[f64]) -> (Vec<[f64; 4]>, Vec<f64>) {
    let mut y = a.chain.multiply(x);
    for (i, j, block) in &a.couplings {
        let add = block::apply(block, &x[*j]);
        (0..4).for_each(|k| y[*i][k] += add[k]);
    }
    for (column, b) in a.columns.iter().zip(border) {
        for (node, c) in column {
            (0..4).for_each(|k| y[*node][k] += c[k] * b);
        }
    }
    let inner = |row: &BorderVector| -> f64 {
        row.iter().map(|(node, c)| (0..4).map(|k| c[k] * x[*node][k]).sum::<f64>()).sum()
    };
    (y, a.rows.iter().map(inner).collect())
}

fn check(couplings: &[(usize, usize)], border: &[Vec<usize>]) {
    for permanent in [true, false] {
        let pattern = |nodes: &Vec<usize>| BorderPattern { nodes: nodes.clone(), permanent };
        check_with(couplings, &border.iter().map(pattern).collect::<Vec<_>>());
    }
}

fn check_with(couplings: &[(usize, usize)], border: &[BorderPattern]) {
    let a = sample(couplings, border);
    let b: Vec<[f64; 4]> = (0..11).map(|i| [1.0, f64::from(i), -2.0, 0.5]).collect();
    let c: Vec<f64> = (0..border.len()).map(|i| 1.0 - i as f64).collect();
    let (mut x, mut l) = (b.clone(), c.clone());
    let mut lu = a.clone();
    lu.factor().unwrap();
    lu.solve(&mut x, &mut l);
    let (y, d) = multiply(&a, &x, &l);
    for (y, b) in y.iter().zip(&b) {
        (0..4).for_each(|k| assert!((y[k] - b[k]).abs() < 1e-10, "{couplings:?} {border:?}"));
    }
    d.iter().zip(&c).for_each(|(d, c)| assert!((d - c).abs() < 1e-10));
}

#[test]
fn solutions_satisfy_the_system() {
    check(&[], &[]);
    check(&[], &[vec![5, 6]]);
    check(&[(2, 8), (8, 2)], &[]);
    check(&[(2, 8), (8, 2)], &[vec![0, 10], vec![2, 3, 8]]);
    // Large enough for the sparse interface system.
    check(
        &[(0, 10), (10, 0), (3, 7), (7, 3), (4, 7), (7, 4), (1, 9), (9, 1), (2, 5), (5, 2)],
        &[vec![0, 6], vec![1], vec![3, 4, 9], vec![3, 8]],
    );
}
