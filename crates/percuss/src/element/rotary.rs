//! Rotary inertia: the moment `rhoI d(omega)/dt` on the rotation `dtheta = (g x dg) / a` of the tangent.

use super::point::PointResponse;
use crate::math::vec2::{add, cross, dot, rot90};
use crate::scalar::Real;

/// Angular rate at the midpoint of a step from g0 to g0 + dg: `w_m = (g_m x Dg) / (a_m h)`.
#[inline(always)]
pub fn mean_spin<S: Real>(g0: [S; 2], d_g: [S; 2], h: S) -> S {
    let g = [g0[0] + d_g[0] * 0.5, g0[1] + d_g[1] * 0.5];
    cross(g, d_g) / (dot(g, g) * h)
}

/// Adds rotary inertia over a step: `rhoI (w1 - w0)/h (g_m x dg)/a_m` with `w1 = 2 w_m - w0`, and mass-proportional damping
/// `rhoI damping w_m`; returns `w_m`.
#[inline(always)]
pub fn add_step<S: Real, const TANGENT: bool>(
    response: &mut PointResponse<S>,
    rotary: S,
    g0: [S; 2],
    d_g: [S; 2],
    spin_0: S,
    h: S,
    damping: f64,
) -> S {
    let rate = h.recip();
    let g = [g0[0] + d_g[0] * 0.5, g0[1] + d_g[1] * 0.5];
    let inv_a = dot(g, g).recip();
    let spin = cross(g, d_g) * inv_a * rate;
    let moment = rotary * ((spin - spin_0) * (rate + rate) + spin * damping);
    let normal = [-g[1] * inv_a, g[0] * inv_a];
    response.force_g = add(response.force_g, [moment * normal[0], moment * normal[1]]);
    if TANGENT {
        // d(g_m x Dg) = g0 x dg, d(a_m) = g_m . dg
        let g0_turned = rot90(g0);
        let d_spin = [
            (g0_turned[0] * rate - spin * g[0]) * inv_a,
            (g0_turned[1] * rate - spin * g[1]) * inv_a,
        ];
        let inertia = rotary * (rate + rate + rate.constant(damping));
        add_moment_tangent(
            response,
            [inertia * d_spin[0], inertia * d_spin[1]],
            moment,
            g,
            inv_a,
            0.5,
        );
    }
    spin
}

/// Adds rotary inertia at one configuration: `rhoI theta_ddot (g x dg)/a` with
/// `theta_ddot = (g x g_ddot)/a - 2 (g x g_dot)(g . g_dot)/a^2`.
///
/// `theta`, `d_rate`, `d_acceleration` are the derivatives of g, g_dot, g_ddot with respect to g at the end of the step.
#[inline(always)]
pub fn add_collocated<S: Real, const TANGENT: bool>(
    response: &mut PointResponse<S>,
    rotary: S,
    g: [S; 2],
    g_dot: [S; 2],
    g_ddot: [S; 2],
    [theta, d_rate, d_acceleration]: [f64; 3],
) {
    let inv_a = dot(g, g).recip();
    let (turn, stretch) = (cross(g, g_dot) * inv_a, dot(g, g_dot) * inv_a);
    let acceleration = cross(g, g_ddot) * inv_a;
    let moment = rotary * (acceleration - turn * stretch * 2.0);
    let normal = [-g[1] * inv_a, g[0] * inv_a];
    response.force_g = add(response.force_g, [moment * normal[0], moment * normal[1]]);
    if TANGENT {
        let zero = turn.constant(0.0);
        let mut slope = [zero; 2];
        for j in 0..2 {
            // Unit increment along j of g at the end of the step.
            let mut unit = [zero; 2];
            unit[j] = turn.constant(1.0);
            let d_inv_a = dot(g, unit) * inv_a * (-2.0 * theta); // relative change of 1/a
            let d_turn =
                (cross(unit, g_dot) * theta + cross(g, unit) * d_rate) * inv_a + turn * d_inv_a;
            let d_stretch =
                (dot(unit, g_dot) * theta + dot(g, unit) * d_rate) * inv_a + stretch * d_inv_a;
            let d_acc = (cross(unit, g_ddot) * theta + cross(g, unit) * d_acceleration) * inv_a
                + acceleration * d_inv_a;
            slope[j] = rotary * (d_acc - (d_turn * stretch + turn * d_stretch) * 2.0);
        }
        add_moment_tangent(response, slope, moment, g, inv_a, theta);
    }
}

/// Tangent of `moment J g / a`, where `d moment = slope . dg` and g moves by `theta dg`.
#[inline(always)]
pub fn add_moment_tangent<S: Real>(
    response: &mut PointResponse<S>,
    slope: [S; 2],
    moment: S,
    g: [S; 2],
    inv_a: S,
    theta: f64,
) {
    let normal = [-g[1] * inv_a, g[0] * inv_a];
    let turned = moment * inv_a * theta;
    for i in 0..2 {
        for j in 0..2 {
            response.tangent[i][j] +=
                normal[i] * (slope[j] - moment * inv_a * g[j] * (2.0 * theta));
        }
    }
    response.tangent[0][1] += -turned;
    response.tangent[1][0] += turned;
}
