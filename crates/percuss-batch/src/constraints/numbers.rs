//! The numbers of a constraint, and what it is on nodal values.

use crate::engine::interpolate;
use percuss::internals::model::frozen::{Constraint, ConstraintKind, MaterialPoint};
use percuss::internals::scalar::Real;
use percuss::internals::step::constraint::{angle_forms, turn};
use percuss::math::vec2::{add, cross, dot, scale};

/// What a constraint keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Constrained {
    /// A component of the displacement of a point of a support, or of its gradient.
    Held { gradient: bool },
    /// A component of the position of two points, which they share.
    Shared,
    /// The angle between the tangents at two points.
    Angle,
}

/// A constraint on points of the beams.
#[derive(Clone, Debug)]
pub struct ConstraintNumbers<S> {
    /// What it keeps.
    pub kept: Constrained,
    /// Its points a and b, or the one, shape (1 or 2).
    pub points: Vec<TiedPoint<S>>,
    /// The direction, of unit length, or the cosine and the sine of the rotation from the tangent at b to that at a, shape (2) \[-\].
    pub direction: [S; 2],
}

/// A point of a beam that a constraint ties.
#[derive(Clone, Copy, Debug)]
pub struct TiedPoint<S> {
    /// Node `a` of its element.
    pub node: usize,
    /// Shape functions, on (u_a, u_a', u_b, u_b'), shape (4) \[1, m, 1, m\].
    pub shape: [S; 4],
    /// Their derivatives, shape (4) \[1/m, 1, 1/m, 1\].
    pub slope: [S; 4],
    /// Reference position, shape (2) \[m\].
    pub position: [S; 2],
    /// Reference tangent, shape (2) \[1\].
    pub tangent: [S; 2],
}

impl ConstraintNumbers<f64> {
    /// Those of a constraint of a model, or what about it an ensemble does not know.
    pub fn of(c: &Constraint) -> Result<Self, &'static str> {
        if c.until < f64::INFINITY {
            return Err("supports for a time");
        }
        if c.joint.is_some() {
            return Err("joints of a given strength");
        }
        let (kept, direction) = match &c.kind {
            _ if !c.drive.is_empty() => return Err("supports that move"),
            ConstraintKind::Turned { .. } => return Err("supports that turn"),
            ConstraintKind::Held { direction, gradient, .. } => {
                (Constrained::Held { gradient: *gradient }, *direction)
            }
            ConstraintKind::Shared { direction, .. } => (Constrained::Shared, *direction),
            ConstraintKind::Angle { cosine, sine, .. } => (Constrained::Angle, [*cosine, *sine]),
        };
        Ok(Self { kept, points: c.points().iter().map(TiedPoint::of).collect(), direction })
    }
}

impl TiedPoint<f64> {
    fn of(point: &MaterialPoint) -> Self {
        let MaterialPoint { node, shape, slope, position, tangent, .. } = point;
        Self { node: *node, shape: *shape, slope: *slope, position: *position, tangent: *tangent }
    }
}

impl<S: Copy> ConstraintNumbers<S> {
    /// The same with every number replaced, in a fixed order.
    pub fn map<T: Copy>(&self, f: &mut impl FnMut(S) -> T) -> ConstraintNumbers<T> {
        let point = |p: &TiedPoint<S>| TiedPoint {
            node: p.node,
            shape: p.shape.map(&mut *f),
            slope: p.slope.map(&mut *f),
            position: p.position.map(&mut *f),
            tangent: p.tangent.map(&mut *f),
        };
        let points = self.points.iter().map(point).collect();
        ConstraintNumbers { kept: self.kept, points, direction: self.direction.map(f) }
    }

    /// What it is apart from its numbers: what it keeps, and the first node of the element of each of its points.
    pub fn shape(&self) -> (Constrained, Vec<usize>) {
        (self.kept, self.points.iter().map(|p| p.node).collect())
    }
}

impl<S: Real> TiedPoint<S> {
    /// Tangent after `share` of an increment.
    #[inline(always)]
    fn tangent_at(&self, start: &[[S; 4]], increment: &[[S; 4]], share: S) -> [S; 2] {
        let turned = scale(share, interpolate(&self.slope, self.node, increment));
        add(add(self.tangent, interpolate(&self.slope, self.node, start)), turned)
    }
}

impl<S: Real> ConstraintNumbers<S> {
    /// Whether it is a form on gradients, not on displacements.
    #[inline(always)]
    fn on_gradients(&self) -> bool {
        matches!(self.kept, Constrained::Angle | Constrained::Held { gradient: true })
    }

    /// Shape functions of one of its points, or their derivatives: those it is a form on.
    #[inline(always)]
    pub fn functions<'a>(&self, point: &'a TiedPoint<S>) -> &'a [S; 4] {
        if self.on_gradients() { &point.slope } else { &point.shape }
    }

    /// Forms on the displacements or gradients of its points after `share` of an increment, shape (points, 2) \[1\].
    #[inline(always)]
    pub fn forms(&self, start: &[[S; 4]], increment: &[[S; 4]], share: S) -> [[S; 2]; 2] {
        let direction = self.direction;
        if self.kept != Constrained::Angle {
            return [direction, [-direction[0], -direction[1]]];
        }
        let at = |p: &TiedPoint<S>| p.tangent_at(start, increment, share);
        angle_forms(at(&self.points[0]), at(&self.points[1]), direction)
    }

    /// Forms applied to nodal values.
    #[inline(always)]
    pub fn along(&self, forms: &[[S; 2]; 2], nodal: &[[S; 4]]) -> S {
        let on = |k: usize| {
            let point = &self.points[k];
            dot(forms[k], interpolate(self.functions(point), point.node, nodal))
        };
        if self.points.len() == 1 { on(0) } else { on(0) + on(1) }
    }

    /// Value at displacements: round-off of the steps before \[m, 1\].
    #[inline(always)]
    pub fn value(&self, u: &[[S; 4]]) -> S {
        if self.kept != Constrained::Angle {
            let zero = self.direction[0].constant(0.0);
            return self.along(&self.forms(u, u, zero), u);
        }
        let at = |p: &TiedPoint<S>| add(p.tangent, interpolate(&p.slope, p.node, u));
        cross(at(&self.points[0]), turn(self.direction, at(&self.points[1])))
    }
}
