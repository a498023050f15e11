//! Loads in a step, constant over it: a load that acts for a share of the step acts with that share, so that its impulse
//! is exact.

use crate::linalg::chain::Chain;
use crate::math::vec2::{cross, dot};
use crate::model::Model;
use crate::model::frozen::{PointLoadData, share};
use crate::state::State;

/// Acceleration of gravity in the step `[start, start + h]`.
pub fn gravity(model: &Model, start: f64, h: f64) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for g in &model.gravity {
        let share = share(g.from, g.until, start, h);
        sum[0] += share * g.acceleration[0];
        sum[1] += share * g.acceleration[1];
    }
    sum
}

/// Tangent g at a load's point, `theta` of the way through the step.
fn tangent_at(load: &PointLoadData, state: &State, increment: &[[f64; 4]], theta: f64) -> [f64; 2] {
    let (u, d) = (load.point.gradient(&state.displacement), load.point.gradient(increment));
    std::array::from_fn(|i| load.point.tangent[i] + u[i] + theta * d[i])
}

/// Subtracts the point loads from the residual, and their tangent (a moment follows the rotation) if `TANGENT`.
///
/// A moment acts on `dtheta = (g x dg) / a` of the configuration of evaluation.
pub fn apply<const TANGENT: bool>(
    model: &Model,
    state: &State,
    h: f64,
    theta: f64,
    increment: &[[f64; 4]],
    residual: &mut [[f64; 4]],
    chain: &mut Chain,
) {
    for load in &model.point_loads {
        let share = share(load.from, load.until, state.time, h);
        if share == 0.0 {
            continue;
        }
        load.point.spread([-share * load.force[0], -share * load.force[1]], residual);
        let moment = share * load.moment;
        if moment == 0.0 {
            continue;
        }
        let g = tangent_at(load, state, increment, theta);
        let inv_a = 1.0 / dot(g, g);
        let normal = [-g[1] * inv_a, g[0] * inv_a];
        load.point.spread_gradient([-moment * normal[0], -moment * normal[1]], residual);
        if TANGENT {
            let turned = moment * inv_a * theta;
            let mut k = [[0.0; 2]; 2];
            for i in 0..2 {
                for j in 0..2 {
                    k[i][j] = moment * normal[i] * inv_a * g[j] * 2.0 * theta;
                }
            }
            k[0][1] += turned;
            k[1][0] -= turned;
            chain.add_outer(load.point.node, &load.point.slope, &load.point.slope, &k);
        }
    }
}

/// Work, impulse and angular impulse of the loads over a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct LoadWork {
    /// Work \[J\].
    pub work: f64,
    /// Impulse \[N s\].
    pub impulse: [f64; 2],
    /// Angular impulse about the origin \[N m s\].
    pub angular_impulse: f64,
}

impl LoadWork {
    /// Adds a force at position `x`, moved by `d` over a step of size `h`.
    pub fn add_force(&mut self, force: [f64; 2], x: [f64; 2], d: [f64; 2], h: f64) {
        self.work += dot(force, d);
        self.impulse[0] += h * force[0];
        self.impulse[1] += h * force[1];
        self.angular_impulse += h * cross(x, force);
    }
}

/// What the loads did over a step, beams' and projectiles' gravity included.
pub fn work(
    model: &Model,
    state: &State,
    h: f64,
    theta: f64,
    gravity: [f64; 2],
    increment: &[[f64; 4]],
    travel: &[f64],
) -> LoadWork {
    let mut sum = LoadWork::default();
    for load in &model.point_loads {
        let share = share(load.from, load.until, state.time, h);
        let p = &load.point;
        let (u, d) = (p.value(&state.displacement), p.value(increment));
        let x = std::array::from_fn(|i| p.position[i] + u[i] + 0.5 * d[i]);
        sum.add_force([share * load.force[0], share * load.force[1]], x, d, h);
        let g = tangent_at(load, state, increment, theta);
        let moment = share * load.moment;
        sum.work += moment * cross(g, p.gradient(increment)) / dot(g, g);
        sum.angular_impulse += h * moment;
    }
    if gravity != [0.0; 2] {
        add_gravity(model, state, h, gravity, increment, travel, &mut sum);
    }
    sum
}

fn add_gravity(
    model: &Model,
    state: &State,
    h: f64,
    gravity: [f64; 2],
    increment: &[[f64; 4]],
    travel: &[f64],
    sum: &mut LoadWork,
) {
    for beam in &model.beams {
        let m = &beam.table.mass;
        for a in beam.nodes.start..beam.nodes.end - 1 {
            // Consistent nodal weights of a uniform acceleration: columns of positions summed.
            for (k, node) in [(0, a), (2, a + 1)] {
                let on_value = m[k][0] + m[k][2];
                let on_slope = m[k + 1][0] + m[k + 1][2];
                let (u, d) = (&state.displacement[node], &increment[node]);
                let x = model.nodes[node];
                let position = [x[0] + u[0] + 0.5 * d[0], x[1] + u[1] + 0.5 * d[1]];
                let force = [on_value * gravity[0], on_value * gravity[1]];
                sum.add_force(force, position, [d[0], d[1]], h);
                // Slope parts: no net force, but work and moment.
                let t = beam.table.tangent;
                let slope = [t[0] + u[2] + 0.5 * d[2], t[1] + u[3] + 0.5 * d[3]];
                let couple = [on_slope * gravity[0], on_slope * gravity[1]];
                sum.work += dot(couple, [d[2], d[3]]);
                sum.angular_impulse += h * cross(slope, couple);
            }
        }
    }
    for (i, p) in model.projectiles.iter().enumerate() {
        let along = p.mass * dot(gravity, p.direction);
        sum.work += along * travel[i];
        sum.impulse[0] += h * along * p.direction[0];
        sum.impulse[1] += h * along * p.direction[1];
        sum.angular_impulse += h * along * cross(p.position, p.direction);
    }
}
