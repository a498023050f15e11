//! Values and gradients of constraints.
//!
//! Linear ones are exact. The angle of a rigid corner, `c = g_a x R g_b`, is quadratic: along its gradient at the midpoint a multiplier does no
//! work, and `c` vanishes at the end of the step (theory, page 1). So is the unit length of a node's vector, `c = (|g|^2 - 1) / 2`.

use super::forcing::Forcing;
use crate::linalg::condensed::BorderVector;
use crate::math::vec2::{add, cross, dot, rot90, scale};
use crate::model::frozen::{Constraint, ConstraintKind, MaterialPoint};
use crate::scalar::Real;

/// A step for constraints.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintStep<'a, S = f64> {
    /// Displacements at the start, shape (nodes, 4) \[m, -, rad\].
    pub start: &'a [[S; 4]],
    /// Their increments, shape (nodes, 4) \[m, -, rad\].
    pub increment: &'a [[S; 4]],
    /// Prescribed motions.
    pub forcing: &'a Forcing,
    /// Instant of the step for the directions of constraint forces: its middle, in statics its end.
    pub share: f64,
}

/// A gradient on the nodes of a constraint's points, two nodes of the first, two of the second, shape (4, 4) \[-, m, 1/m\].
pub type NodalForm<S> = [[S; 4]; 4];

/// Force of the ground on a point through a constraint, a mean over a step.
#[derive(Clone, Copy, Debug)]
pub struct Reaction<S> {
    /// Position of the point in the middle of the step, shape (2) \[m\].
    pub at: [S; 2],
    /// Force, shape (2) \[N\].
    pub force: [S; 2],
    /// Couple \[N m\].
    pub moment: S,
    /// Work over the step \[J\].
    pub work: S,
}

/// `R b` with the rotation of the given cosine and sine.
#[inline(always)]
pub fn turn<S: Real>([cosine, sine]: [S; 2], b: [S; 2]) -> [S; 2] {
    [cosine * b[0] - sine * b[1], sine * b[0] + cosine * b[1]]
}

/// Coefficients of dg_a and dg_b in the derivative of `g_a x R g_b` at the tangents a and b, with the rotation R of the given cosine and
/// sine.
#[inline(always)]
fn angle_forms<S: Real>(a: [S; 2], b: [S; 2], [cosine, sine]: [S; 2]) -> [[S; 2]; 2] {
    let ([b1, b2], along) = (rot90(turn([cosine, sine], b)), rot90(a));
    [[-b1, -b2], turn([cosine, -sine], along)]
}

/// A point's nodal values interpolated, or their gradient.
#[inline(always)]
fn seen<S: Real>(point: &MaterialPoint<S>, gradient: bool, nodal: &[[S; 4]]) -> [S; 2] {
    if gradient { point.gradient(nodal) } else { point.value(nodal) }
}

impl<'a, S> ConstraintStep<'a, S> {
    /// No step: constraints at rest.
    pub fn at_rest(start: &'a [[S; 4]], forcing: &'a Forcing) -> Self {
        Self { start, increment: &[], forcing, share: 0.0 }
    }
}

impl<S: Real> ConstraintStep<'_, S> {
    /// Tangent g at a point after `share` of the increment.
    #[inline(always)]
    fn tangent(&self, p: &MaterialPoint<S>, share: f64) -> [S; 2] {
        let start = add(p.tangent, p.gradient(self.start));
        if self.increment.is_empty() {
            return start;
        }
        let [d1, d2] = p.gradient(self.increment);
        add(start, [d1 * share, d2 * share])
    }

    /// Direction across the tangent that a support turns, after `share` of the step.
    #[inline(always)]
    fn across(&self, c: &Constraint<S>, point: &MaterialPoint<S>, share: f64) -> [S; 2] {
        let angle = self.forcing.start(&c.drive) + share * self.forcing.increment(&c.drive);
        let like = point.tangent[0];
        rot90(turn([like.constant(angle.cos()), like.constant(angle.sin())], point.tangent))
    }

    /// Value of the constraint at the start of the step: round-off of the steps before.
    #[inline(always)]
    pub fn start_value(&self, c: &Constraint<S>) -> S {
        let u = self.start;
        let g = |p: &MaterialPoint<S>| add(p.tangent, p.gradient(u));
        match &c.kind {
            ConstraintKind::Held { point, direction, gradient } => {
                let value = seen(point, *gradient, u);
                dot(*direction, value) - value[0].constant(self.forcing.start(&c.drive))
            }
            ConstraintKind::Turned { point } => dot(self.across(c, point, 0.0), g(point)),
            ConstraintKind::Shared { points, direction } => {
                dot(*direction, points[0].value(u)) - dot(*direction, points[1].value(u))
            }
            ConstraintKind::Angle { points, cosine, sine } => {
                cross(g(&points[0]), turn([*cosine, *sine], g(&points[1])))
            }
            ConstraintKind::Length { point } => {
                let g = g(point);
                (dot(g, g) - g[0].constant(1.0)) * 0.5
            }
        }
    }

    /// Change of the constraint over the step, exactly and without subtracting positions: linear constraints applied to the
    /// increment, products by their difference rule.
    #[inline(always)]
    pub fn change(&self, c: &Constraint<S>) -> S {
        let d = self.increment;
        match &c.kind {
            ConstraintKind::Held { .. } => {
                let derivative = self.derivative(c, d);
                derivative - derivative.constant(self.forcing.increment(&c.drive))
            }
            ConstraintKind::Turned { point } => {
                // t1 - t0 = 2 sin(half the angle) J t_m, and (t0 + t1)/2 = cos(half the angle) t_m.
                let half = 0.5 * self.forcing.increment(&c.drive);
                let across = self.across(c, point, 0.5);
                let along = rot90(across);
                dot(across, point.gradient(d)) * half.cos()
                    + dot(along, self.tangent(point, 0.5)) * (2.0 * half.sin())
            }
            ConstraintKind::Shared { .. } => self.derivative(c, d),
            ConstraintKind::Angle { .. } | ConstraintKind::Length { .. } => self.along(c, 0.5, d),
        }
    }

    /// Gradients of the constraint on the values or slopes at its points after `share` of the step, where its force is directed.
    #[inline(always)]
    fn forms(&self, c: &Constraint<S>, share: f64) -> [([S; 2], bool); 2] {
        match &c.kind {
            ConstraintKind::Held { direction, gradient, .. } => [(*direction, *gradient); 2],
            ConstraintKind::Turned { point } => [(self.across(c, point, share), true); 2],
            ConstraintKind::Length { point } => [(self.tangent(point, share), true); 2],
            ConstraintKind::Shared { direction, .. } => {
                [(*direction, false), ([-direction[0], -direction[1]], false)]
            }
            ConstraintKind::Angle { points, cosine, sine } => {
                let [a, b] = &**points;
                let tangents = (self.tangent(a, share), self.tangent(b, share));
                let [on_a, on_b] = angle_forms(tangents.0, tangents.1, [*cosine, *sine]);
                [(on_a, true), (on_b, true)]
            }
        }
    }

    /// Force of a support on its point through a constraint with the given multiplier.
    #[inline(always)]
    pub fn reaction(&self, c: &Constraint<S>, multiplier: S) -> Reaction<S> {
        let (point, zero) = (&c.points()[0], multiplier.constant(0.0));
        let ([at, tangent], (form, gradient)) =
            (point.middle(self.start, self.increment), self.forms(c, self.share)[0]);
        let force = scale(-multiplier, form);
        let work = dot(force, seen(point, gradient, self.increment));
        if gradient {
            Reaction { at, force: [zero; 2], moment: cross(tangent, force), work }
        } else {
            Reaction { at, force, moment: zero, work }
        }
    }

    /// Adds `factor` times the gradient of the constraint, where its force is directed, to nodal values.
    #[inline(always)]
    pub fn add_gradient(&self, c: &Constraint<S>, factor: S, nodal: &mut [[S; 4]]) {
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
    #[inline(always)]
    pub fn derivative(&self, c: &Constraint<S>, nodal: &[[S; 4]]) -> S {
        self.along(c, 1.0, nodal)
    }

    /// Derivative of the constraint after `share` of the step.
    #[inline(always)]
    fn along(&self, c: &Constraint<S>, share: f64, nodal: &[[S; 4]]) -> S {
        let forms = self.forms(c, share);
        let on = |point: &MaterialPoint<S>, (form, gradient): ([S; 2], bool)| {
            dot(form, seen(point, gradient, nodal))
        };
        match c.points() {
            [a, b] => on(a, forms[0]) + on(b, forms[1]),
            points => on(&points[0], forms[0]),
        }
    }

    /// The gradient after `share` of the step on the nodes of the constraint's points.
    #[inline(always)]
    pub fn nodal_form(&self, c: &Constraint<S>, share: f64) -> NodalForm<S> {
        let forms = self.forms(c, share);
        let mut all = [[forms[0].0[0].constant(0.0); 4]; 4];
        for (k, point) in c.points().iter().enumerate() {
            let ([f1, f2], gradient) = forms[k];
            let [n0, n1, n2, n3] = if gradient { point.slope } else { point.shape };
            all[2 * k] = [n0 * f1, n0 * f2, n1 * f1, n1 * f2];
            all[2 * k + 1] = [n2 * f1, n2 * f2, n3 * f1, n3 * f2];
        }
        all
    }
}

impl ConstraintStep<'_> {
    /// Tangent to which a support turns a point at the start of the step, and the direction across that at its end.
    pub fn turned(&self, c: &Constraint, point: &MaterialPoint) -> ([f64; 2], [f64; 2]) {
        (scale(-1.0, rot90(self.across(c, point, 0.0))), self.across(c, point, 1.0))
    }

    /// Gradient of a support's constraint where its force is directed, and whether it acts on the slope.
    pub fn support_form(&self, c: &Constraint) -> ([f64; 2], bool) {
        self.forms(c, self.share)[0]
    }

    /// Couple that the constraint of an angle has on its first point for a multiplier of one, zero of the others \[-\].
    pub fn couple(&self, c: &Constraint) -> f64 {
        let ConstraintKind::Angle { points, .. } = &c.kind else { return 0.0 };
        cross(self.tangent(&points[0], self.share), self.forms(c, self.share)[0].0)
    }

    /// The gradient where the force is directed, or at the end of the step, in the places of a border vector.
    pub fn border(&self, c: &Constraint, end: bool, vector: &mut BorderVector) {
        let share = if end { 1.0 } else { self.share };
        if let (ConstraintKind::Length { point }, [(_, value)]) = (&c.kind, &mut vector[..]) {
            let [d1, d2] = self.tangent(point, share);
            *value = [0.0, 0.0, d1, d2];
            return;
        }
        for (_, value) in vector.iter_mut() {
            *value = [0.0; 4];
        }
        let form = self.nodal_form(c, share);
        for (node, on) in point_nodes(c).zip(&form) {
            for (_, value) in vector.iter_mut().filter(|(k, _)| *k == node) {
                (0..4).for_each(|i| value[i] += on[i]);
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
}

/// Nodes of a constraint's points, two a point.
#[inline(always)]
pub fn point_nodes<S>(c: &Constraint<S>) -> impl Iterator<Item = usize> {
    c.points().iter().flat_map(|p| [p.node, p.node + 1])
}

/// The node whose vector has unit length by a constraint at its point; the point has no other node's share.
#[inline(always)]
pub fn node_of_length(point: &MaterialPoint) -> usize {
    if point.slope[1] == 0.0 { point.node + 1 } else { point.node }
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
