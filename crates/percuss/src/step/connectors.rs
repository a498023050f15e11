//! Springs and dampers over a step.
//!
//! Each acts on a scalar coordinate q of the configuration. The coordinate's change over the step is written exactly as a
//! linear form of the increment, taken at the midpoint; the force along it is the difference quotient of the potential.
//! Its work is the change of the potential, and forms between two points turn with them: energy and momenta stay exact.

mod form;
mod foundation;
mod inelastic;
mod law;

use super::forcing::Forcing;
use super::integration::{Integration, Rule};
use super::tangent::Tangent;
use crate::element::fibre::{FibreState, StressLaw};
use crate::math::vec2::{add, cross, dot, norm, scale, sub};
use crate::model::Model;
use crate::model::frozen::{
    ActsFrom, Connector, ConnectorEnd, Coordinate, MaterialPoint, YieldingLaw,
};
use crate::state::State;
use form::{Blocks, CoordinateForm, add_to, angle_form, distance_form, product};
pub use inelastic::{advanced, bring_to_rest};

/// What a connector does in a step.
#[derive(Clone, Copy, Debug)]
pub struct ConnectorStep {
    /// Force along the coordinate \[N, N m\].
    pub force: f64,
    /// Of it, what the damper carries.
    pub damper: f64,
    /// Change of the coordinate over the step.
    pub change: f64,
    /// Forms of the coordinate's change at both ends, on displacements or slopes, shape (2, 2) \[-\].
    pub forms: [[f64; 2]; 2],
    /// Derivative of the force with respect to the coordinate at the end of the step.
    pub slope: f64,
    /// Derivatives of the forces `force * form` with respect to the ends' increments: by end, end and components, shape (2, 2, 2, 2)
    /// \[N/m, or N m on slopes\].
    tangent: Blocks,
    /// Of them, what comes of the turning of the forms, shape (2, 2, 2, 2) \[N/m, or N m on slopes\].
    turning: Blocks,
}

/// An end of a connector on a beam or a body: its point and whether the coordinate knows the slope there, or the displacement.
pub type Attachment<'a> = (&'a MaterialPoint, bool);

impl Connector {
    /// Its ends on beams alone.
    pub fn on_beams(&self) -> impl Iterator<Item = &MaterialPoint> {
        self.attachments().map(|(_, (point, _))| point).filter(|point| point.body_node().is_none())
    }

    /// Its ends on beams and bodies, with their number.
    pub fn attachments(&self) -> impl Iterator<Item = (usize, Attachment<'_>)> {
        let pair: [Option<Attachment<'_>>; 2] = match &self.coordinate {
            Coordinate::Displacement { point, .. } => [Some((point, false)), None],
            Coordinate::Distance { ends } => ends.each_ref().map(|place| match place {
                ConnectorEnd::Point(p) | ConnectorEnd::Body(p) => Some((p, false)),
                ConnectorEnd::Ground(_) => None,
            }),
            Coordinate::Angle { a, b, .. } => {
                [Some((a.as_ref(), true)), b.as_deref().map(|b| (b, true))]
            }
        };
        pair.into_iter().enumerate().filter_map(|(i, attachment)| Some((i, attachment?)))
    }

    /// The coordinate in a configuration; an angle is the one nearest to `near`. Without prescribed motion.
    pub fn value(&self, u: &[[f64; 4]], near: f64) -> f64 {
        match &self.coordinate {
            Coordinate::Displacement { point, direction, .. } => dot(*direction, point.value(u)),
            Coordinate::Distance { ends } => norm(sub(ends[0].position(u), ends[1].position(u))),
            Coordinate::Angle { .. } => {
                let [a, b] = self.tangents(u);
                let angle = cross(b, a).atan2(dot(b, a));
                let turn = std::f64::consts::TAU;
                angle + turn * ((near - angle) / turn).round()
            }
        }
    }

    /// Tangents at a and, turned to where a's stands in the reference, at b.
    fn tangents(&self, u: &[[f64; 4]]) -> [[f64; 2]; 2] {
        let Coordinate::Angle { a, b, cosine, sine } = &self.coordinate else {
            return [[1.0, 0.0]; 2];
        };
        let g = |p: &MaterialPoint| add(p.tangent, p.gradient(u));
        let turned = |v: [f64; 2]| [cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1]];
        [g(a), b.as_ref().map_or(a.tangent, |b| turned(g(b)))]
    }

    /// Potential at a value of the coordinate, elastic energy where it yields, nothing once it is gone \[J\].
    pub fn potential(&self, q: f64, memories: &[FibreState]) -> f64 {
        match self.memory(memories) {
            Some((_, state)) if state.failed => 0.0,
            Some((YieldingLaw { law: Some(law), .. }, state)) => {
                law.elastic_energy(state, q - self.law.free())
            }
            _ => self.law.energy(q),
        }
    }

    /// Force and its derivative with respect to the coordinate at the end of a step from `q0` by `change`.
    fn force(&self, rule: &Integration, q0: f64, change: f64, memories: &[FibreState]) -> [f64; 2] {
        match self.memory(memories) {
            Some((_, memory)) if memory.failed => return [0.0; 2],
            Some((YieldingLaw { law: Some(law), .. }, memory)) => {
                let from = q0 - self.law.free();
                return inelastic::force(law, memory, rule, [from, from + change]);
            }
            _ => {}
        }
        match rule.rule {
            Rule::Midpoint(_) => self.law.quotient(q0, change),
            Rule::Alpha(_) | Rule::Static => self.law.collocated(q0, change, rule.theta()),
        }
    }

    /// Force of the connector of number `i` in a state, that of its damper included, without the rate of prescribed motions \[N, N m\].
    pub fn force_now(&self, i: usize, state: &State) -> f64 {
        let (q, memories) = (state.coordinates[i], &state.memories[..]);
        let elastic = self.reached_force(q, memories);
        if self.damping == 0.0 || self.has_failed(memories) {
            return elastic;
        }
        let damper = self.damping * self.rate(&state.displacement, &state.velocity);
        self.law.with_damper(q - self.permanent_gap(memories), elastic, damper)
    }

    /// Whether the connector of number `i`, of a law of one side, is open or slack in a state.
    pub fn is_apart(&self, i: usize, state: &State) -> bool {
        let q = state.coordinates[i] - self.permanent_gap(&state.memories);
        match self.law.side() {
            Some((ActsFrom::Above, at)) => q <= at,
            Some((ActsFrom::Below, at)) => q >= at,
            None => false,
        }
    }

    /// By how much the gap of what acts on one side alone has grown by yielding.
    fn permanent_gap(&self, memories: &[FibreState]) -> f64 {
        let one_sided = |own: &YieldingLaw| own.law.as_ref().is_some_and(|l| l.slack().is_some());
        self.memory(memories).filter(|(own, _)| one_sided(own)).map_or(0.0, |(_, m)| m.plastic)
    }

    /// Rate of the coordinate in a configuration with velocities, without prescribed motion.
    fn rate(&self, u: &[[f64; 4]], v: &[[f64; 4]]) -> f64 {
        match &self.coordinate {
            Coordinate::Displacement { point, direction, .. } => dot(*direction, point.value(v)),
            Coordinate::Distance { ends } => {
                let along = sub(ends[0].position(u), ends[1].position(u));
                let apart = sub(ends[0].increment(v), ends[1].increment(v));
                dot(along, apart) / norm(along).max(f64::MIN_POSITIVE)
            }
            Coordinate::Angle { .. } => {
                let (at, moved) = (self.tangents(u), self.tangent_increments(v));
                let turns = |k: usize| cross(at[k], moved[k]) / dot(at[k], at[k]);
                turns(0) - turns(1)
            }
        }
    }

    /// What the connector of number `i` does in the step from a state by the increment.
    pub fn step(
        &self,
        i: usize,
        rule: &Integration,
        forcing: &Forcing,
        state: &State,
        increment: &[[f64; 4]],
    ) -> ConnectorStep {
        let (q0, u) = (state.coordinates[i], &state.displacement[..]);
        let form = match &self.coordinate {
            Coordinate::Displacement { point, direction, drive } => {
                let moved = dot(*direction, point.value(increment));
                CoordinateForm {
                    change: moved - forcing.increment(drive),
                    mean: [*direction, [0.0; 2]],
                    end: [*direction, [0.0; 2]],
                    bend: [[[[0.0; 2]; 2]; 2]; 2],
                }
            }
            Coordinate::Distance { ends } => distance_form(ends, rule, u, increment),
            Coordinate::Angle { b, .. } => {
                let (start, step) = (self.tangents(u), self.tangent_increments(increment));
                angle_form(start, step, b.is_some(), rule, self.turn())
            }
        };
        let [elastic, slope] = self.force(rule, q0, form.change, &state.memories);
        let gone = self.has_failed(&state.memories);
        let rate = if gone { 0.0 } else { rule.lag(self.damping) };
        let reached = q0 - self.permanent_gap(&state.memories);
        let [damper, share] = match rate {
            0.0 => [0.0; 2],
            _ => self.law.damper(rate, [reached, form.change], [elastic, slope]),
        };
        let (force, slope) = (elastic + damper, slope + share);
        let turning = form.bend.map(|row| row.map(|b| b.map(|row| row.map(|k| force * k))));
        let mut tangent = turning;
        add_to(&mut tangent, &product(&form.mean, &form.end, slope));
        let (change, forms) = (form.change, form.mean);
        ConnectorStep { force, damper, change, forms, slope, tangent, turning }
    }

    /// Increments of [`Connector::tangents`].
    fn tangent_increments(&self, increment: &[[f64; 4]]) -> [[f64; 2]; 2] {
        let Coordinate::Angle { a, b, cosine, sine } = &self.coordinate else {
            return [[0.0; 2]; 2];
        };
        let turned = |v: [f64; 2]| [cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1]];
        [a.gradient(increment), b.as_ref().map_or([0.0; 2], |b| turned(b.gradient(increment)))]
    }

    /// Cosine and sine of the rotation that takes the reference tangent of b to that of a.
    fn turn(&self) -> [f64; 2] {
        match &self.coordinate {
            Coordinate::Angle { cosine, sine, .. } => [*cosine, *sine],
            _ => [1.0, 0.0],
        }
    }
}

impl ConnectorEnd {
    /// Position in a configuration \[m\].
    pub fn position(&self, u: &[[f64; 4]]) -> [f64; 2] {
        match self {
            Self::Point(p) | Self::Body(p) => add(p.position, p.value(u)),
            Self::Ground(x) => *x,
        }
    }

    fn increment(&self, increment: &[[f64; 4]]) -> [f64; 2] {
        match self {
            Self::Point(p) | Self::Body(p) => p.value(increment),
            Self::Ground(_) => [0.0; 2],
        }
    }
}

/// Adds the part of the connectors' tangent that comes of their forces' turning; gives `each` the others' stiffness, of those that
/// have yielded the elastic one, with which they unload.
pub fn apply_turning(
    model: &Model,
    state: &State,
    rule: &Integration,
    forcing: &Forcing,
    tangent: &mut Tangent,
    mut each: impl FnMut(&Connector, &ConnectorStep),
) {
    let still = vec![[0.0; 4]; state.displacement.len()];
    for (i, connector) in model.connectors.iter().enumerate() {
        if !forcing.connected[i] {
            continue;
        }
        let mut step = connector.step(i, rule, forcing, state, &still);
        if let Some((own, memory)) = connector.memory(&state.memories) {
            let extension = state.coordinates[i] - connector.law.free();
            let elastic = own.law.as_ref().map_or(step.slope, StressLaw::young);
            let gapes = own.law.as_ref().is_some_and(|law| law.is_slack(memory, extension));
            step.slope = if memory.failed || gapes { 0.0 } else { elastic };
        }
        tangent.add_connector(i, connector, &step.turning);
        each(connector, &step);
    }
}

/// Adds the connectors' forces to the residual, and their tangent if `TANGENT`.
pub fn apply<const TANGENT: bool>(
    model: &Model,
    state: &State,
    rule: &Integration,
    forcing: &Forcing,
    increment: &[[f64; 4]],
    residual: &mut [[f64; 4]],
    tangent: &mut Tangent,
) {
    for (i, connector) in model.connectors.iter().enumerate() {
        if !forcing.connected[i] {
            continue;
        }
        let step = connector.step(i, rule, forcing, state, increment);
        for (g, (point, gradient)) in connector.attachments() {
            let force = scale(step.force, step.forms[g]);
            if gradient {
                point.spread_gradient(force, residual);
            } else {
                point.spread(force, residual);
            }
        }
        if TANGENT {
            tangent.add_connector(i, connector, &step.tangent);
        }
    }
}
