//! Loads in a step, constant over it except for the rotation of follower loads: a load acts with its mean factor over a time as long as the step,
//! so that its impulse is exact.

use super::forcing::Forcing;
use super::given_strains;
use super::integration::Integration;
use super::tangent::Tangent;
use crate::ledger::StepWork;
use crate::math::vec2::{cross, dot, rot90};
use crate::model::Model;
use crate::model::frozen::{LoadAction, MaterialPoint};
use crate::state::State;

/// Tangent g at a point, at the share `theta` of the step.
pub fn tangent_at(
    p: &MaterialPoint,
    state: &State,
    increment: &[[f64; 4]],
    theta: f64,
) -> [f64; 2] {
    let (u, d) = (p.gradient(&state.displacement), p.gradient(increment));
    std::array::from_fn(|i| p.tangent[i] + u[i] + theta * d[i])
}

/// Subtracts the loads but gravity from the residual, and their tangent if `TANGENT`.
///
/// A moment acts on `dtheta = (g x dg) / a` of the configuration of evaluation.
pub fn apply<const TANGENT: bool>(
    model: &Model,
    state: &State,
    forcing: &Forcing,
    rule: &Integration,
    increment: &[[f64; 4]],
    residual: &mut [[f64; 4]],
    tangent: &mut Tangent,
) {
    let theta = rule.theta();
    if !state.strained.is_empty() {
        let given = (rule, &forcing.factors[..]);
        let chain = tangent.chain_mut();
        given_strains::apply::<TANGENT>(model, (state, increment), given, residual, chain);
    }
    for (load, factor) in model.loads.iter().zip(&forcing.factors) {
        if *factor == 0.0 {
            continue;
        }
        match &load.kind {
            LoadAction::Gravity { .. } | LoadAction::Strain { .. } => {}
            LoadAction::Point { point, force, moment, follower } => {
                if *follower {
                    let g = tangent_at(point, state, increment, theta);
                    let unit = 1.0 / dot(g, g).sqrt();
                    let f = turned(force.map(|f| factor * f * unit), g);
                    point.spread([-f[0], -f[1]], residual);
                    if TANGENT {
                        // d(g/r) = (I - g (x) g / a) dg / r
                        let mut k = turning(force.map(|f| -factor * theta * f * unit));
                        for row in &mut k {
                            let along = dot(*row, g) * unit * unit;
                            (0..2).for_each(|j| row[j] -= along * g[j]);
                        }
                        tangent.chain_mut().add_outer(point.node, &point.shape, &point.slope, &k);
                    }
                } else {
                    point.spread([-factor * force[0], -factor * force[1]], residual);
                }
                let moment = factor * moment;
                if moment != 0.0 {
                    let g = tangent_at(point, state, increment, theta);
                    add_moment::<TANGENT>(point, moment, g, theta, residual, tangent);
                }
            }
            LoadAction::Dead { nodal, .. } => {
                for (node, force) in nodal {
                    (0..4).for_each(|i| residual[*node][i] -= factor * force[i]);
                }
            }
            LoadAction::Follower { points } => {
                for p in points {
                    let g = tangent_at(&p.point, state, increment, theta);
                    let f = turned(p.force.map(|f| factor * f), g);
                    p.point.spread([-f[0], -f[1]], residual);
                    if TANGENT {
                        let k = turning(p.force.map(|f| -factor * theta * f));
                        let (node, n, s) = (p.point.node, &p.point.shape, &p.point.slope);
                        tangent.chain_mut().add_outer(node, n, s, &k);
                    }
                }
            }
        }
    }
}

/// `f_t g + f_n J g`.
pub fn turned(force: [f64; 2], g: [f64; 2]) -> [f64; 2] {
    let across = rot90(g);
    [force[0] * g[0] + force[1] * across[0], force[0] * g[1] + force[1] * across[1]]
}

/// Derivative of [`turned`] with respect to g.
fn turning(force: [f64; 2]) -> [[f64; 2]; 2] {
    [[force[0], -force[1]], [force[1], force[0]]]
}

fn add_moment<const TANGENT: bool>(
    point: &MaterialPoint,
    moment: f64,
    g: [f64; 2],
    theta: f64,
    residual: &mut [[f64; 4]],
    tangent: &mut Tangent,
) {
    let inv_a = 1.0 / dot(g, g);
    let normal = [-g[1] * inv_a, g[0] * inv_a];
    point.spread_gradient([-moment * normal[0], -moment * normal[1]], residual);
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
        tangent.chain_mut().add_outer(point.node, &point.slope, &point.slope, &k);
    }
}

/// Position and tangent of a node in the middle of a step.
pub fn middle(model: &Model, state: &State, increment: &[[f64; 4]], node: usize) -> [[f64; 2]; 2] {
    let (frame, u, d) = (&model.nodes[node], &state.displacement[node], &increment[node]);
    [
        [0, 1].map(|i| frame.position[i] + u[i] + 0.5 * d[i]),
        [0, 1].map(|i| frame.tangent[i] + u[2 + i] + 0.5 * d[2 + i]),
    ]
}

/// Work and impulse of the loads over a step, including gravity of beams, masses and projectiles; follower loads have their direction at the share
/// `theta` of the step.
pub fn work(
    model: &Model,
    state: &State,
    h: f64,
    theta: f64,
    forcing: &Forcing,
    increment: &[[f64; 4]],
) -> StepWork {
    let mut sum = StepWork::default();
    let add = |p: &MaterialPoint, force: [f64; 2], sum: &mut StepWork| {
        let (u, d) = (p.value(&state.displacement), p.value(increment));
        let x = std::array::from_fn(|i| p.position[i] + u[i] + 0.5 * d[i]);
        sum.add_force(force, x, d, h);
    };
    for (load, factor) in model.loads.iter().zip(&forcing.factors) {
        if *factor == 0.0 {
            continue;
        }
        match &load.kind {
            // For the work of given strains see `given_strains`.
            LoadAction::Gravity { .. } | LoadAction::Strain { .. } => {}
            LoadAction::Point { point, force, moment, follower } => {
                let g = tangent_at(point, state, increment, theta);
                let scaled = force.map(|f| factor * f);
                if *follower {
                    let unit = 1.0 / dot(g, g).sqrt();
                    add(point, turned(scaled.map(|f| f * unit), g), &mut sum);
                } else {
                    add(point, scaled, &mut sum);
                }
                let moment = factor * moment;
                sum.work += moment * cross(g, point.gradient(increment)) / dot(g, g);
                sum.angular_impulse += h * moment;
            }
            LoadAction::Dead { nodal, .. } => {
                for (node, force) in nodal {
                    let force = force.map(|f| factor * f);
                    sum.add_nodal(
                        &force,
                        middle(model, state, increment, *node),
                        &increment[*node],
                        h,
                    );
                }
            }
            LoadAction::Follower { points } => {
                for p in points {
                    let g = tangent_at(&p.point, state, increment, theta);
                    add(&p.point, turned(p.force.map(|f| factor * f), g), &mut sum);
                }
            }
        }
    }
    if forcing.gravity != [0.0; 2] {
        add_gravity(model, state, h, forcing.gravity, increment, &mut sum);
        for mass in &model.masses {
            let force = forcing.gravity.map(|g| mass.mass * g);
            add(&mass.point, force, &mut sum);
        }
    }
    sum
}

fn add_gravity(
    model: &Model,
    state: &State,
    h: f64,
    gravity: [f64; 2],
    increment: &[[f64; 4]],
    sum: &mut StepWork,
) {
    for (span, k, a, _) in model.each_element() {
        for (node, force) in span.table(k).uniform_force(a, gravity) {
            sum.add_nodal(&force, middle(model, state, increment, node), &increment[node], h);
        }
    }
    for (i, body) in model.bodies.iter().enumerate() {
        let force = gravity.map(|g| body.mass * g);
        let node = model.body_node(i);
        let ([x, _], d) = (middle(model, state, increment, node), increment[node]);
        sum.add_force(force, x, [d[0], d[1]], h);
    }
}
