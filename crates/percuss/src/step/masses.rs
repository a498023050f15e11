//! Masses at points: inertia of translation and rotation.

use super::integration::{Integration, Rule};
use super::tangent::Tangent;
use crate::element::point::PointResponse;
use crate::element::rotary::{self, Turn};
use crate::math::vec2::{add, scale};
use crate::model::Model;
use crate::model::frozen::MassData;
use crate::state::State;

/// Adds the inertia of point masses, gravity on them included, to the residual, and its tangent if `TANGENT`.
pub fn apply<const TANGENT: bool>(
    model: &Model,
    state: &State,
    rule: &Integration,
    gravity: [f64; 2],
    increment: &[[f64; 4]],
    residual: &mut [[f64; 4]],
    tangent: &mut Tangent,
) {
    for (i, mass) in model.masses.iter().enumerate() {
        let p = &mass.point;
        p.spread(inertia(mass, state, rule, gravity, increment), residual);
        let turning = rotary_response::<TANGENT>(mass, state, i, rule, increment);
        if let Some(response) = &turning {
            p.spread_gradient(response.force_g, residual);
        }
        if TANGENT {
            let m = mass.mass * rule.inertia_slope();
            tangent.chain_mut().add_outer(p.node, &p.shape, &p.shape, &[[m, 0.0], [0.0, m]]);
            if let Some(response) = &turning {
                let t = &response.tangent;
                let k = [[t[0][0], t[0][1]], [t[1][0], t[1][1]]];
                tangent.chain_mut().add_outer(p.node, &p.slope, &p.slope, &k);
            }
        }
    }
}

/// Inertia of a point mass over a step, less its weight \[N\].
pub fn inertia(
    mass: &MassData,
    state: &State,
    rule: &Integration,
    gravity: [f64; 2],
    increment: &[[f64; 4]],
) -> [f64; 2] {
    let p = &mass.point;
    let (d, v) = (p.value(increment), p.value(&state.velocity));
    let a = if state.acceleration.is_empty() { [0.0; 2] } else { p.value(&state.acceleration) };
    [0, 1].map(|k| mass.mass * (rule.inertia(d[k], v[k], a[k]) - gravity[k]))
}

/// Inertia moment along its tangent of the mass of number `i` \[N m\], if it has rotary inertia.
pub fn turning(
    mass: &MassData,
    state: &State,
    i: usize,
    rule: &Integration,
    increment: &[[f64; 4]],
) -> Option<[f64; 2]> {
    rotary_response::<false>(mass, state, i, rule, increment).map(|response| response.force_g)
}

fn rotary_response<const TANGENT: bool>(
    mass: &MassData,
    state: &State,
    i: usize,
    rule: &Integration,
    increment: &[[f64; 4]],
) -> Option<PointResponse<f64>> {
    if mass.rotary_inertia == 0.0 {
        return None;
    }
    let p = &mass.point;
    let mut response =
        PointResponse { force_g: [0.0; 2], force_p: [0.0; 2], tangent: [[0.0; 4]; 4] };
    let g0 = add(p.tangent, p.gradient(&state.displacement));
    let d = p.gradient(increment);
    match rule.rule {
        Rule::Midpoint(_) => {
            let (rotary, spin) = (mass.rotary_inertia, state.mass_spin[i]);
            Turn::new(g0, d).add_inertia::<TANGENT>(
                &mut response,
                rotary,
                spin,
                rule.h.recip(),
                0.0,
            );
        }
        Rule::Alpha(w) => {
            let theta = rule.theta();
            let (v0, a0) = (p.gradient(&state.velocity), p.gradient(&state.acceleration));
            let g = add(g0, scale(theta, d));
            let g_dot = [0, 1].map(|k| rule.rate(d[k], v0[k], a0[k]));
            let g_ddot = [0, 1].map(|k| rule.inertia(d[k], v0[k], a0[k]));
            let slopes = [theta, theta * w.gamma / (w.beta * rule.h), rule.inertia_slope()];
            rotary::add_collocated::<f64, TANGENT>(
                &mut response,
                mass.rotary_inertia,
                g,
                g_dot,
                g_ddot,
                slopes,
            );
        }
        Rule::Static => return None,
    }
    Some(response)
}
