//! Values and gradients of constraints.
//!
//! Linear ones are what they are. The angle of a rigid corner, `c = g_a x R g_b`, is quadratic: along its gradient at the
//! midpoint a multiplier does no work, and `c` vanishes at the end of the step.

use super::forcing::Forcing;
use crate::linalg::condensed::BorderVector;
use crate::math::vec2::{add, cross, dot, rot90, scale};
use crate::model::frozen::{Constraint, ConstraintKind, MaterialPoint};
use crate::scalar::Real;

/// A step as constraints see it.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintStep<'a> {
    /// Displacements at the start, shape (nodes, 4) \[m, 1, rad\].
    pub start: &'a [[f64; 4]],
    /// Their increments, shape (nodes, 4) \[m, 1, rad\].
    pub increment: &'a [[f64; 4]],
    /// Prescribed motions.
    pub forcing: &'a Forcing,
    /// Where in the step the forces of constraints are directed: at its middle, in statics at its end.
    pub share: f64,
}

/// `R b` with the rotation of the given cosine and sine.
#[inline(always)]
pub fn turn<S: Real>([cosine, sine]: [S; 2], b: [S; 2]) -> [S; 2] {
    [cosine * b[0] - sine * b[1], sine * b[0] + cosine * b[1]]
}

/// Coefficients of dg_a and dg_b in the derivative of `g_a x R g_b` at the tangents a and b, with the rotation R of the given cosine and
/// sine.
#[inline(always)]
pub fn angle_forms<S: Real>(a: [S; 2], b: [S; 2], [cosine, sine]: [S; 2]) -> [[S; 2]; 2] {
    let ([b1, b2], along) = (rot90(turn([cosine, sine], b)), rot90(a));
    [[-b1, -b2], turn([cosine, -sine], along)]
}

impl<'a> ConstraintStep<'a> {
    /// No step: constraints at a configuration that stands still.
    pub fn at_rest(start: &'a [[f64; 4]], forcing: &'a Forcing) -> Self {
        Self { start, increment: &[], forcing, share: 0.0 }
    }
}

impl ConstraintStep<'_> {
    /// Tangent g at a point after `share` of the increment.
    fn tangent(&self, p: &MaterialPoint, share: f64) -> [f64; 2] {
        let start = add(p.tangent, p.gradient(self.start));
        if self.increment.is_empty() {
            return start;
        }
        add(start, scale(share, p.gradient(self.increment)))
    }

    /// Direction across the tangent that a support turns, after `share` of the step.
    fn across(&self, c: &Constraint, point: &MaterialPoint, share: f64) -> [f64; 2] {
        let angle = self.forcing.start(&c.drive) + share * self.forcing.increment(&c.drive);
        rot90(turn([angle.cos(), angle.sin()], point.tangent))
    }

    /// Tangent to which a support turns a point at the start of the step, and the direction across that at its end.
    pub fn turned(&self, c: &Constraint, point: &MaterialPoint) -> ([f64; 2], [f64; 2]) {
        (scale(-1.0, rot90(self.across(c, point, 0.0))), self.across(c, point, 1.0))
    }

    /// Value of the constraint at the start of the step: round-off of the steps before.
    pub fn start_value(&self, c: &Constraint) -> f64 {
        let u = self.start;
        let g = |p: &MaterialPoint| add(p.tangent, p.gradient(u));
        match &c.kind {
            ConstraintKind::Held { point, direction, gradient } => {
                let value = if *gradient { point.gradient(u) } else { point.value(u) };
                dot(*direction, value) - self.forcing.start(&c.drive)
            }
            ConstraintKind::Turned { point } => dot(self.across(c, point, 0.0), g(point)),
            ConstraintKind::Shared { points, direction } => {
                dot(*direction, points[0].value(u)) - dot(*direction, points[1].value(u))
            }
            ConstraintKind::Angle { points, cosine, sine } => {
                cross(g(&points[0]), turn([*cosine, *sine], g(&points[1])))
            }
        }
    }

    /// Change of the constraint over the step, exactly and without subtracting positions: linear constraints applied to the
    /// increment, products by their difference rule.
    pub fn change(&self, c: &Constraint) -> f64 {
        let d = self.increment;
        match &c.kind {
            ConstraintKind::Held { .. } => self.derivative(c, d) - self.forcing.increment(&c.drive),
            ConstraintKind::Turned { point } => {
                // t1 - t0 = 2 sin(half the angle) J t_m, and (t0 + t1)/2 = cos(half the angle) t_m.
                let half = 0.5 * self.forcing.increment(&c.drive);
                let across = self.across(c, point, 0.5);
                let along = rot90(across);
                half.cos() * dot(across, point.gradient(d))
                    + 2.0 * half.sin() * dot(along, self.tangent(point, 0.5))
            }
            ConstraintKind::Shared { .. } => self.derivative(c, d),
            ConstraintKind::Angle { points, cosine, sine } => {
                let [on_a, on_b] = self.angle_forms(points, [*cosine, *sine], 0.5);
                dot(on_a, points[0].gradient(d)) + dot(on_b, points[1].gradient(d))
            }
        }
    }

    /// Gradients of the constraint on the values or slopes at its points, where its force is directed.
    fn forms(&self, c: &Constraint, share: f64) -> [([f64; 2], bool); 2] {
        let none = ([0.0; 2], false);
        match &c.kind {
            ConstraintKind::Held { direction, gradient, .. } => [(*direction, *gradient), none],
            ConstraintKind::Turned { point } => [(self.across(c, point, share), true), none],
            ConstraintKind::Shared { direction, .. } => {
                [(*direction, false), (scale(-1.0, *direction), false)]
            }
            ConstraintKind::Angle { points, cosine, sine } => {
                let [on_a, on_b] = self.angle_forms(points, [*cosine, *sine], share);
                [(on_a, true), (on_b, true)]
            }
        }
    }

    /// Gradient of a support's constraint where its force is directed, and whether it acts on the slope.
    pub fn support_form(&self, c: &Constraint) -> ([f64; 2], bool) {
        self.forms(c, self.share)[0]
    }

    /// Couple that the constraint of an angle has on its first point for a multiplier of one, zero of the others \[1\].
    pub fn couple(&self, c: &Constraint) -> f64 {
        let ConstraintKind::Angle { points, .. } = &c.kind else { return 0.0 };
        cross(self.tangent(&points[0], self.share), self.forms(c, self.share)[0].0)
    }

    /// Adds `factor` times the gradient of the constraint, where its force is directed, to nodal values.
    pub fn add_gradient(&self, c: &Constraint, factor: f64, nodal: &mut [[f64; 4]]) {
        for (point, (form, gradient)) in c.points().iter().zip(self.forms(c, self.share)) {
            let force = scale(factor, form);
            if gradient {
                point.spread_gradient(force, nodal);
            } else {
                point.spread(force, nodal);
            }
        }
    }

    /// Derivative of the constraint, at the end of the step, in the direction `nodal`.
    pub fn derivative(&self, c: &Constraint, nodal: &[[f64; 4]]) -> f64 {
        let forms = self.forms(c, 1.0);
        let on = |(point, (form, gradient)): (&MaterialPoint, ([f64; 2], bool))| {
            dot(form, if gradient { point.gradient(nodal) } else { point.value(nodal) })
        };
        c.points().iter().zip(forms).map(on).sum()
    }

    /// The gradient where the force is directed, or at the end of the step, in the places of a border vector.
    pub fn border(&self, c: &Constraint, end: bool, vector: &mut BorderVector) {
        for (_, value) in vector.iter_mut() {
            *value = [0.0; 4];
        }
        let share = if end { 1.0 } else { self.share };
        for (point, (form, gradient)) in c.points().iter().zip(self.forms(c, share)) {
            let n = if gradient { &point.slope } else { &point.shape };
            for (offset, node) in [(0, point.node), (2, point.node + 1)] {
                if n[offset] == 0.0 && n[offset + 1] == 0.0 {
                    continue;
                }
                for (k, value) in vector.iter_mut() {
                    if *k == node {
                        for i in 0..2 {
                            value[i] += n[offset] * form[i];
                            value[2 + i] += n[offset + 1] * form[i];
                        }
                    }
                }
            }
        }
    }

    /// Matrix of the derivative of a quadratic constraint's force, times `factor`, between the slopes at its two points:
    /// `dg_a . K dg_b`; `None` for the others.
    pub fn hessian(&self, c: &Constraint, factor: f64) -> Option<[[f64; 2]; 2]> {
        let ConstraintKind::Angle { cosine, sine, .. } = &c.kind else { return None };
        // d(dg_a x R dg_b): a1 (R b)2 - a2 (R b)1.
        let f = factor * self.share;
        Some([[f * sine, f * cosine], [-f * cosine, f * sine]])
    }

    /// The same of the angle between the tangents at two points, after `share` of the step.
    fn angle_forms(
        &self,
        points: &[MaterialPoint; 2],
        rotation: [f64; 2],
        share: f64,
    ) -> [[f64; 2]; 2] {
        let [a, b] = points.each_ref().map(|p| self.tangent(p, share));
        angle_forms(a, b, rotation)
    }
}

/// Nodes that a constraint touches.
pub fn nodes(c: &Constraint) -> Vec<usize> {
    let mut nodes: Vec<usize> = c
        .points()
        .iter()
        .flat_map(|p| {
            [
                (p.node, [p.shape[0], p.shape[1], p.slope[0], p.slope[1]]),
                (p.node + 1, [p.shape[2], p.shape[3], p.slope[2], p.slope[3]]),
            ]
        })
        .filter(|(_, weights)| weights.iter().any(|w| *w != 0.0))
        .map(|(node, _)| node)
        .collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
