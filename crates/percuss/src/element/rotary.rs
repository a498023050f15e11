//! Rotary inertia: the moment `rhoI d(omega)/dt` on the rotation `dtheta = (g x dg) / a` of the tangent.

use super::point::PointResponse;
use crate::math::vec2::{add, cross, dot, middle};
use crate::scalar::{Number, Real};

/// Rotation of the tangent over a step at a point: from `g0` to `g0 + d_g`, through `g` in the middle.
#[derive(Clone, Copy, Debug)]
pub struct Turn<S> {
    /// Tangent at the start, shape (2) \[-\].
    pub g0: [S; 2],
    /// Its increment, shape (2) \[-\].
    pub d_g: [S; 2],
    /// Tangent in the middle, shape (2) \[-\].
    pub g: [S; 2],
    /// `1 / g.g`.
    pub inv_a: S,
}

impl<S: Real> Turn<S> {
    /// From the start and the increment.
    #[inline(always)]
    pub fn new(g0: [S; 2], d_g: [S; 2]) -> Self {
        let g = middle(g0, d_g);
        Self { g0, d_g, g, inv_a: dot(g, g).recip() }
    }

    /// Angle over the step by the rate in its middle, `(g_m x Dg) / a_m`.
    #[inline(always)]
    fn angle(&self) -> S {
        cross(self.g, self.d_g) * self.inv_a
    }

    /// Angular rate in the middle of a step of size `1 / rate`: `w_m = (g_m x Dg) / (a_m h)`.
    #[inline(always)]
    pub fn mean_spin(&self, rate: S) -> S {
        self.angle() * rate
    }

    /// Angular rate at the end of such a step, `w1 = 2 w_m - w0`.
    #[inline(always)]
    pub fn end_spin(&self, rate: S, spin_0: S) -> S {
        let mean = self.mean_spin(rate);
        mean + mean - spin_0
    }

    /// Adds rotary inertia: `rhoI (w1 - w0)/h (g_m x dg)/a_m` with `w1 = 2 w_m - w0`, and mass-proportional damping
    /// `rhoI damping w_m`.
    #[inline(always)]
    pub fn add_inertia<const TANGENT: bool>(
        &self,
        response: &mut PointResponse<S>,
        rotary: S,
        spin_0: S,
        rate: S,
        damping: S,
    ) {
        let (g, inv_a) = (self.g, self.inv_a);
        let twice = rate + rate;
        let damped = twice + damping;
        let angle = self.angle();
        let acceleration = (spin_0 * twice * -1.0).add_product(angle, rate * damped);
        let turned = (rotary * inv_a) * acceleration;
        response.force_g[0] = response.force_g[0].sub_product(turned, g[1]);
        response.force_g[1] = response.force_g[1].add_product(turned, g[0]);
        if TANGENT {
            let moment = rotary * acceleration;
            // d(g_m x Dg) = g0 x dg, d(a_m) = g_m . dg
            let (inertia, g0) = (rotary * damped, self.g0);
            let across = inertia * inv_a * rate;
            let along = across * angle;
            let slope = [
                (across * -g0[1]).sub_product(along, g[0]),
                (across * g0[0]).sub_product(along, g[1]),
            ];
            add_moment_tangent(response, slope, moment, g, inv_a, 0.5);
        }
    }
}

/// Angular rate `(g x g_dot) / a` of a tangent that moves so.
#[inline(always)]
pub fn spin_of_slope<S: Number>(g: [S; 2], g_dot: [S; 2]) -> S {
    cross(g, g_dot) / dot(g, g)
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
    let (normal, turned) = ([-g[1] * inv_a, g[0] * inv_a], moment * inv_a);
    for j in 0..2 {
        let along = slope[j].sub_product(turned, g[j] * (2.0 * theta));
        for i in 0..2 {
            response.tangent[i][j] = response.tangent[i][j].add_product(normal[i], along);
        }
    }
    response.tangent[0][1] += turned * -theta;
    response.tangent[1][0] += turned * theta;
}
