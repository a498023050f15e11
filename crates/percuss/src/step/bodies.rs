//! Rigid bodies: inertia of translation and rotation, and the springs to rear masses.

use super::integration::{Integration, Rule};
use super::tangent::Tangent;
use crate::linalg::block::ZERO;
use crate::math::vec2::dot;
use crate::model::Model;
use crate::model::frozen::BodyKind;
use crate::state::State;

/// A rear mass's spring over a step.
#[derive(Clone, Copy, Debug)]
pub struct RearSpring {
    /// Force, positive in compression \[N\].
    pub force: f64,
    /// Its part in the damper \[N\].
    pub damper: f64,
    /// Increase of the compression over the step \[m\].
    pub change: f64,
}

/// The spring of the rear mass at `node`, whose front is the node before it.
pub fn rear_spring(
    kind: &BodyKind,
    node: usize,
    rule: &Integration,
    u: &[[f64; 4]],
    increment: &[[f64; 4]],
) -> Option<RearSpring> {
    let BodyKind::Rear { direction, stiffness, damping } = *kind else { return None };
    let along =
        |x: &[[f64; 4]]| dot(direction, [x[node][0] - x[node - 1][0], x[node][1] - x[node - 1][1]]);
    let (start, change) = (along(u), along(increment));
    let damper = damping * rule.rate(change, 0.0, 0.0);
    let force = stiffness * (start + rule.theta() * change) + damper;
    Some(RearSpring { force, damper, change })
}

/// Adds the bodies' inertia, gravity on them and their springs to the residual, and their tangent if `TANGENT`.
pub fn apply<const TANGENT: bool>(
    model: &Model,
    state: &State,
    rule: &Integration,
    gravity: [f64; 2],
    increment: &[[f64; 4]],
    residual: &mut [[f64; 4]],
    tangent: &mut Tangent,
) {
    let slope = rule.inertia_slope();
    for (i, body) in model.bodies.iter().enumerate() {
        let node = model.body_node(i);
        let masses = [body.mass, body.mass, body.inertia];
        let (d, v) = (&increment[node], &state.velocity[node]);
        let a = state.acceleration.get(node).unwrap_or(&[0.0; 4]);
        let still = body.kind == BodyKind::Obstacle || rule.rule == Rule::Static;
        residual[node] = [0.0; 4];
        if !still {
            for k in 0..3 {
                let g = gravity.get(k).unwrap_or(&0.0);
                residual[node][k] = masses[k] * (rule.inertia(d[k], v[k], a[k]) - g);
            }
        }
        if TANGENT {
            let mut diagonal = ZERO;
            for k in 0..4 {
                let mass = *masses.get(k).unwrap_or(&body.mass);
                diagonal[k][k] = if still { 1.0 } else { mass * slope };
            }
            let chain = tangent.chain_mut();
            (chain.diag[node], chain.upper[node], chain.lower[node]) = (diagonal, ZERO, ZERO);
        }
        if let Some(spring) = rear_spring(&body.kind, node, rule, &state.displacement, increment) {
            add_spring::<TANGENT>(&body.kind, node, rule, &spring, residual, tangent);
        }
    }
}

fn add_spring<const TANGENT: bool>(
    kind: &BodyKind,
    node: usize,
    rule: &Integration,
    spring: &RearSpring,
    residual: &mut [[f64; 4]],
    tangent: &mut Tangent,
) {
    let BodyKind::Rear { direction, stiffness, damping } = *kind else { return };
    for k in 0..2 {
        residual[node][k] += spring.force * direction[k];
        residual[node - 1][k] -= spring.force * direction[k];
    }
    if TANGENT {
        let factor = stiffness * rule.theta() + damping * rule.rate_slope();
        let mut block = ZERO;
        for r in 0..2 {
            for c in 0..2 {
                block[r][c] = factor * direction[r] * direction[c];
            }
        }
        let negative = block.map(|row| row.map(|x| -x));
        tangent.add_contact(node, node, &block);
        tangent.add_contact(node - 1, node - 1, &block);
        tangent.add_contact(node, node - 1, &negative);
        tangent.add_contact(node - 1, node, &negative);
    }
}
