//! Elastic supports and stops of an ensemble: springs and dampers from points of the beams to the ground, along fixed directions.
//!
//! The same forces as those of single runs ([`step::connectors`](percuss::internals::step::connectors)): the difference quotient of the potential.

use super::engine::Engine;
use percuss::internals::ledger::Ledger;
use percuss::internals::model::frozen::{Connector, ConnectorLaw, Coordinate, MaterialPoint};
use percuss::internals::scalar::Number;
use percuss::math::vec2::{dot, scale};

/// A spring and damper from a point of a beam to the ground.
#[derive(Clone, Debug)]
pub struct GroundSpringNumbers<S> {
    /// The point it acts on.
    pub point: MaterialPoint<S>,
    /// Line it acts along, unit vector, shape (2) \[-\].
    pub direction: [S; 2],
    /// Its force over the displacement along the line.
    pub law: ConnectorLaw<S>,
    /// Force per rate \[N s/m\].
    pub damping: S,
}

/// A spring in the step at hand.
#[derive(Clone, Copy, Debug)]
pub struct GroundSpringState<S> {
    /// Force of spring and damper \[N\], its slope by the displacement at the end of the step \[N/m\], and the change of the displacement
    /// over the step that they go with \[m\].
    force: S,
    slope: S,
    change: S,
    /// Slope of the factors in use \[N/m\].
    factored: S,
}

impl GroundSpringNumbers<f64> {
    /// Those of a connector of a model, or what about it an ensemble does not know.
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
        Ok(Self { point: point.clone(), direction: *direction, law: c.law, damping: c.damping })
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
    fn along(&self, nodal: &[[S; 4]]) -> S {
        dot(self.direction, self.point.value(nodal))
    }
}

impl<S: Number> GroundSpringState<S> {
    /// Without force.
    pub fn at_rest(zero: S) -> Self {
        Self { force: zero, slope: zero, change: zero, factored: zero }
    }
}

impl<S: Number> Engine<S> {
    /// What a spring does at the increment as it stands.
    #[inline(always)]
    fn see_spring(&self, k: usize) -> GroundSpringState<S> {
        let spring = &self.numbers.springs[k];
        let change = spring.along(&self.increment);
        let [elastic, slope] = spring.law.quotient(spring.along(&self.displacement), change);
        let lag = spring.damping / self.h;
        let (force, slope) = (elastic + lag * change, slope + lag);
        GroundSpringState { force, slope, change, factored: self.springs[k].factored }
    }

    /// Forces of the springs, and their tangent if `TANGENT`.
    #[inline(always)]
    pub fn push_springs<const TANGENT: bool>(&mut self) {
        for k in 0..self.springs.len() {
            let state = self.see_spring(k);
            self.springs[k] = state;
            let spring = &self.numbers.springs[k];
            let point = &spring.point;
            point.spread(scale(state.force, spring.direction), &mut self.residual);
            if TANGENT {
                let row = row(&point.shape, &spring.direction);
                self.tangent.add_square(point.node, &row, state.slope);
            }
        }
    }

    /// Takes the slopes of the tangent assembled last for those of the factors in use, in the given lanes.
    #[inline(always)]
    pub fn factor_springs(&mut self, which: S::Mask) {
        for state in &mut self.springs {
            state.factored = S::choose(which, state.slope, state.factored);
        }
    }

    /// Lanes in which no spring but for an impulse of `small` has another force than the factors foresaw when the correction was taken:
    /// none has opened or closed.
    #[inline(always)]
    pub fn springs_foreseen(&self, small: S) -> S::Mask {
        let mut all = !small.less(small);
        for (k, before) in self.springs.iter().enumerate() {
            if self.numbers.springs[k].law.is_one_sided() {
                let now = self.see_spring(k);
                let foreseen = before.force + before.factored * (now.change - before.change);
                all = all & ((now.force - foreseen) * self.h).abs().at_most(small);
            }
        }
        all
    }

    /// Energy of the springs \[J\].
    #[inline(always)]
    pub fn spring_energy(&self) -> S {
        let zero = self.h.constant(0.0);
        let each = self.numbers.springs.iter();
        each.fold(zero, |sum, s| sum + s.law.energy(s.along(&self.displacement)))
    }

    /// Enters the impulses of the ground and the losses of the dampers over the step.
    #[inline(always)]
    pub fn enter_springs(&self, ledger: &mut Ledger<S>) {
        let (u, d) = (&self.displacement, &self.increment);
        for (k, spring) in self.numbers.springs.iter().enumerate() {
            let state = self.see_spring(k);
            ledger.loss_damping += spring.damping / self.h * state.change * state.change;
            let [x, _] = spring.point.middle(u, d);
            let force = scale(-state.force, spring.direction);
            ledger.react(self.h, x, force, self.h.constant(0.0));
        }
    }
}

/// Nodal values of a point along a direction, as a form on its two nodes.
#[inline(always)]
pub fn row<S: Number>([n0, n1, n2, n3]: &[S; 4], [e1, e2]: &[S; 2]) -> [S; 8] {
    let (e1, e2) = (*e1, *e2);
    [*n0 * e1, *n0 * e2, *n1 * e1, *n1 * e2, *n2 * e1, *n2 * e2, *n3 * e1, *n3 * e2]
}
