//! Plane vectors as `[S; 2]`.

use crate::scalar::Real;

/// `a + b`.
#[inline(always)]
pub fn add<S: Real>(a: [S; 2], b: [S; 2]) -> [S; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// `a - b`.
#[inline(always)]
pub fn sub<S: Real>(a: [S; 2], b: [S; 2]) -> [S; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// `s a`.
#[inline(always)]
pub fn scale<S: Real>(s: S, a: [S; 2]) -> [S; 2] {
    [s * a[0], s * a[1]]
}

/// `a + d / 2`.
#[inline(always)]
pub fn middle<S: Real>(a: [S; 2], d: [S; 2]) -> [S; 2] {
    [a[0].add_scaled(d[0], 0.5), a[1].add_scaled(d[1], 0.5)]
}

/// `a . b`.
#[inline(always)]
pub fn dot<S: Real>(a: [S; 2], b: [S; 2]) -> S {
    (a[0] * b[0]).add_product(a[1], b[1])
}

/// `a . b` of two nodes' values.
#[inline(always)]
pub fn dot4<S: Real>(a: &[S; 4], b: &[S; 4]) -> S {
    (a[0] * b[0]).add_product(a[1], b[1]).add_product(a[2], b[2]).add_product(a[3], b[3])
}

/// `a x b = a1 b2 - a2 b1`.
#[inline(always)]
pub fn cross<S: Real>(a: [S; 2], b: [S; 2]) -> S {
    (a[0] * b[1]).sub_product(a[1], b[0])
}

/// `J a`: `a` rotated by +90 degrees.
#[inline(always)]
pub fn rot90<S: Real>(a: [S; 2]) -> [S; 2] {
    [-a[1], a[0]]
}

/// `|a|`. (Not with `hypot`, which prevents overflow and takes ten times as long.)
#[inline(always)]
pub fn norm(a: [f64; 2]) -> f64 {
    (a[0] * a[0] + a[1] * a[1]).sqrt()
}
