//! Values and gradients of constraints.
//!
//! Linear ones are what they are. The angle of a rigid corner, `c = g_a x R g_b`, is quadratic: along its gradient at the
//! midpoint a multiplier does no work, and `c` vanishes at the end of the step.

use crate::math::vec2::{add, cross, dot, rot90, scale};
use crate::model::frozen::{Constraint, MaterialPoint};

/// `R b` with the rotation of the given cosine and sine.
fn turn(cosine: f64, sine: f64, b: [f64; 2]) -> [f64; 2] {
    [cosine * b[0] - sine * b[1], sine * b[0] + cosine * b[1]]
}

/// Tangent g at a point after `share` of the increment.
fn tangent(p: &MaterialPoint, u: &[[f64; 4]], increment: &[[f64; 4]], share: f64) -> [f64; 2] {
    add(p.tangent, add(p.gradient(u), scale(share, p.gradient(increment))))
}

/// Value of the constraint at the start of the step: round-off of the steps before.
pub fn start_value(c: &Constraint, u: &[[f64; 4]]) -> f64 {
    match c {
        Constraint::Held { point, direction, gradient } => {
            dot(*direction, if *gradient { point.gradient(u) } else { point.value(u) })
        }
        Constraint::Shared { points, direction } => {
            dot(*direction, points[0].value(u)) - dot(*direction, points[1].value(u))
        }
        Constraint::Angle { points, cosine, sine } => {
            let g = |p: &MaterialPoint| add(p.tangent, p.gradient(u));
            cross(g(&points[0]), turn(*cosine, *sine, g(&points[1])))
        }
    }
}

/// Change of the constraint over the step, exactly and without subtracting positions: linear constraints applied to the
/// increment, the quadratic one by its gradient at the midpoint.
pub fn change(c: &Constraint, u: &[[f64; 4]], increment: &[[f64; 4]]) -> f64 {
    match c {
        Constraint::Angle { points, cosine, sine } => {
            let [on_a, on_b] = angle_forms(points, *cosine, *sine, u, increment, 0.5);
            dot(on_a, points[0].gradient(increment)) + dot(on_b, points[1].gradient(increment))
        }
        linear => derivative(linear, u, increment, increment),
    }
}

/// Adds `factor` times the gradient of the constraint, taken after `share` of the increment, to nodal values.
pub fn add_gradient(
    c: &Constraint,
    u: &[[f64; 4]],
    increment: &[[f64; 4]],
    share: f64,
    factor: f64,
    nodal: &mut [[f64; 4]],
) {
    match c {
        Constraint::Held { point, direction, gradient: false } => {
            point.spread(scale(factor, *direction), nodal);
        }
        Constraint::Held { point, direction, gradient: true } => {
            point.spread_gradient(scale(factor, *direction), nodal);
        }
        Constraint::Shared { points, direction } => {
            points[0].spread(scale(factor, *direction), nodal);
            points[1].spread(scale(-factor, *direction), nodal);
        }
        Constraint::Angle { points, cosine, sine } => {
            let [on_a, on_b] = angle_forms(points, *cosine, *sine, u, increment, share);
            points[0].spread_gradient(scale(factor, on_a), nodal);
            points[1].spread_gradient(scale(factor, on_b), nodal);
        }
    }
}

/// Derivative of the constraint, at the end of the step, in the direction `nodal`.
pub fn derivative(
    c: &Constraint,
    u: &[[f64; 4]],
    increment: &[[f64; 4]],
    nodal: &[[f64; 4]],
) -> f64 {
    match c {
        Constraint::Held { point, direction, gradient: false } => {
            dot(*direction, point.value(nodal))
        }
        Constraint::Held { point, direction, gradient: true } => {
            dot(*direction, point.gradient(nodal))
        }
        Constraint::Shared { points, direction } => {
            dot(*direction, points[0].value(nodal)) - dot(*direction, points[1].value(nodal))
        }
        Constraint::Angle { points, cosine, sine } => {
            let [on_a, on_b] = angle_forms(points, *cosine, *sine, u, increment, 1.0);
            dot(on_a, points[0].gradient(nodal)) + dot(on_b, points[1].gradient(nodal))
        }
    }
}

/// Coefficients of dg_a and dg_b in the derivative of `g_a x R g_b`.
fn angle_forms(
    points: &[MaterialPoint; 2],
    cosine: f64,
    sine: f64,
    u: &[[f64; 4]],
    increment: &[[f64; 4]],
    share: f64,
) -> [[f64; 2]; 2] {
    let a = tangent(&points[0], u, increment, share);
    let b = turn(cosine, sine, tangent(&points[1], u, increment, share));
    [scale(-1.0, rot90(b)), turn(cosine, -sine, rot90(a))]
}
