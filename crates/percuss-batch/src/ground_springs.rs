//! Elastic supports and stops of an ensemble: springs and dampers from points of the beams to the ground, along fixed directions.

use percuss::internals::model::frozen::{Connector, ConnectorLaw, Coordinate, MaterialPoint};
use percuss::internals::scalar::Number;
use percuss::math::vec2::dot;

/// A spring and damper from a point of a beam to the ground.
#[derive(Clone, Debug)]
pub struct GroundSpringNumbers<S> {
    /// Point of action.
    pub point: MaterialPoint<S>,
    /// Unit vector of the line of action, shape (2) \[-\].
    pub direction: [S; 2],
    /// Force as a function of the displacement along the line.
    pub law: ConnectorLaw<S>,
    /// Force per rate \[N s/m\].
    pub damping: S,
}

/// A spring in the current step.
#[derive(Clone, Copy, Debug)]
pub struct GroundSpringState<S> {
    /// Force of spring and damper \[N\], its slope by the displacement at the end of the step \[N/m\], and the change of the displacement over the
    /// step to which they belong \[m\].
    pub force: S,
    pub slope: S,
    pub change: S,
    /// Slope of the factors in use \[N/m\].
    pub factored: S,
}

impl GroundSpringNumbers<f64> {
    /// Springs of a connector of a model, or the property of it that ensembles do not support.
    pub fn of(c: &Connector) -> Result<Self, &'static str> {
        if c.until < f64::INFINITY {
            return Err("supports for a time");
        }
        let Coordinate::Displacement { point, direction, drive } = &c.coordinate else {
            return Err("springs between points, and rotational springs");
        };
        if !drive.is_empty() {
            return Err("supports that move");
        }
        if c.damping > 0.0 && c.law.side().is_some() {
            return Err("dampers of springs that only push or only pull");
        }
        Ok(Self {
            point: point.clone(),
            direction: *direction,
            law: c.law.clone(),
            damping: c.damping,
        })
    }
}

impl<S: Copy> GroundSpringNumbers<S> {
    /// The same with every number replaced, in a fixed order.
    pub fn map<T: Copy>(&self, f: &mut impl FnMut(S) -> T) -> GroundSpringNumbers<T> {
        GroundSpringNumbers {
            point: self.point.map(f),
            direction: self.direction.map(&mut *f),
            law: self.law.map(f),
            damping: f(self.damping),
        }
    }
}

impl<S: Number> GroundSpringNumbers<S> {
    /// Displacement of its point along its line.
    #[inline(always)]
    pub fn along(&self, nodal: &[[S; 4]]) -> S {
        dot(self.direction, self.point.value(nodal))
    }
}

impl<S: Number> GroundSpringState<S> {
    /// A spring without force.
    pub fn at_rest(zero: S) -> Self {
        Self { force: zero, slope: zero, change: zero, factored: zero }
    }
}

/// Nodal values of a point along a direction, as a form on its two nodes.
#[inline(always)]
pub fn row<S: Number>([n0, n1, n2, n3]: &[S; 4], [e1, e2]: &[S; 2]) -> [S; 8] {
    let (e1, e2) = (*e1, *e2);
    [*n0 * e1, *n0 * e2, *n1 * e1, *n1 * e2, *n2 * e1, *n2 * e2, *n3 * e1, *n3 * e2]
}
