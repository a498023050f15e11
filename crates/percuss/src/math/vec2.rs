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

/// `a . b`.
#[inline(always)]
pub fn dot<S: Real>(a: [S; 2], b: [S; 2]) -> S {
    a[0] * b[0] + a[1] * b[1]
}

/// `a x b = a1 b2 - a2 b1`.
#[inline(always)]
pub fn cross<S: Real>(a: [S; 2], b: [S; 2]) -> S {
    a[0] * b[1] - a[1] * b[0]
}

/// `J a`: `a` rotated by +90 degrees.
#[inline(always)]
pub fn rot90<S: Real>(a: [S; 2]) -> [S; 2] {
    [-a[1], a[0]]
}

/// `|a|`. (Not by `hypot`, which guards against overflow and takes ten times as long.)
#[inline(always)]
pub fn norm(a: [f64; 2]) -> f64 {
    (a[0] * a[0] + a[1] * a[1]).sqrt()
}
