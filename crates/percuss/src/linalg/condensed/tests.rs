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
        let pattern =
            |nodes: &Vec<usize>| BorderPattern { nodes: nodes.clone(), permanent, in_band: false };
        check_with(couplings, &border.iter().map(pattern).collect::<Vec<_>>());
    }
}

/// Checks the solution, and returns it with the multipliers.
fn check_with(couplings: &[(usize, usize)], border: &[BorderPattern]) -> (Vec<[f64; 4]>, Vec<f64>) {
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
    (x, l)
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

/// A constraint at each of some nodes, reduced inside the band and as one of the border, beside other constraints; `within` of them remain in the band.
fn check_in_band(
    couplings: &[(usize, usize)],
    others: &[Vec<usize>],
    nodes: &[usize],
    within: usize,
) {
    let patterns = |in_band: bool| -> Vec<BorderPattern> {
        let pattern =
            |nodes: Vec<usize>, in_band| BorderPattern { nodes, permanent: true, in_band };
        let others = others.iter().map(|nodes| pattern(nodes.clone(), false));
        others.chain(nodes.iter().map(|node| pattern(vec![*node], in_band))).collect()
    };
    assert_eq!(sample(couplings, &patterns(true)).nodal.len(), within);
    let [(x, l), (y, m)] = [true, false].map(|in_band| check_with(couplings, &patterns(in_band)));
    let (x, y) = (x.as_flattened().iter().chain(&l), y.as_flattened().iter().chain(&m));
    let most = y.clone().fold(1.0_f64, |most, y| most.max(y.abs()));
    x.zip(y).for_each(|(x, y)| assert!((x - y).abs() < 1e-12 * most, "{x} {y}"));
}

#[test]
fn constraints_at_single_nodes_are_reduced_inside_the_band() {
    let all: Vec<usize> = (0..11).collect();
    check_in_band(&[], &[], &all, 11);
    check_in_band(&[], &[], &[0, 3, 4, 10], 4);
    check_in_band(&[], &[vec![5, 6]], &all, 9);
    check_in_band(&[(2, 8), (8, 2)], &[], &all, 9);
    check_in_band(&[(2, 8), (8, 2)], &[vec![0, 10], vec![2, 3, 8]], &all, 6);
}

#[test]
fn a_constraint_without_coefficients_is_singular() {
    let pattern = BorderPattern { nodes: vec![3], permanent: true, in_band: true };
    let mut a = sample(&[], &[pattern]);
    a.rows[0][0].1 = [0.0; 4];
    assert_eq!(a.factor(), Err(None));
}
