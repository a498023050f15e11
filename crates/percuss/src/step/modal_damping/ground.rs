//! Ties of a structure to the ground: supports and springs, as conditions on the motions of a body as a whole.

use crate::math::vec2::{cross, dot, norm, rot90, scale, sub};
use crate::model::Model;
use crate::model::frozen::{ConnectorEnd, ConnectorLaw, ConstraintKind, Coordinate, MaterialPoint};
use crate::state::State;
use crate::step::constraint::ConstraintStep;
use crate::step::forcing::Forcing;
use crate::step::integration::Integration;

/// A step for bodies that move as a whole.
#[derive(Clone, Copy, Debug)]
pub struct StepView<'a> {
    /// The model.
    pub model: &'a Model,
    /// Start of the step.
    pub state: &'a State,
    /// Scheme and size of the step.
    pub rule: &'a Integration,
    /// Supports in the step.
    pub forcing: &'a Forcing,
    /// Increment of the nodal displacements, shape (nodes, 4) \[m, -, rad\].
    pub increment: &'a [[f64; 4]],
}

/// A tie to the ground in the middle of a step.
#[derive(Clone, Copy, Debug)]
pub struct Tie {
    /// Its number among all that the model has.
    pub number: usize,
    /// A supported node of the body.
    pub node: usize,
    /// Its effect on a translation of one and on a rotation about the origin, shape (3) \[-, -, m\].
    pub row: [f64; 3],
    /// Motion of its ground in the step, in the same measure.
    pub moved: f64,
    /// Whether it is never released, never yields and is always closed.
    pub lasts: bool,
    /// Whether its ground can turn the body.
    pub turns: bool,
}

/// Number of ties that a model has, acting or not.
pub fn tie_count(model: &Model) -> usize {
    let held: usize = model.prescribed.iter().map(|dofs| dofs.normals.len()).sum();
    held + model.constraints.len() + model.connectors.len()
}

impl StepView<'_> {
    /// Position and tangent of a beam's node in the middle of the step.
    pub fn node(&self, n: usize) -> [f64; 4] {
        let (frame, u, d) = (&self.model.nodes[n], &self.state.displacement[n], self.increment[n]);
        let at = |k: usize| u[k] + 0.5 * d[k];
        let ([x, y], [g, k]) = (frame.position, frame.tangent);
        [x + at(0), y + at(1), g + at(2), k + at(3)]
    }

    /// The same of a material point.
    fn point(&self, p: &MaterialPoint) -> ([f64; 2], [f64; 2]) {
        let middle = |reference: [f64; 2], u: [f64; 2], d: [f64; 2]| {
            [0, 1].map(|i| reference[i] + u[i] + 0.5 * d[i])
        };
        let (u, d) = (&self.state.displacement, self.increment);
        (
            middle(p.position, p.value(u), p.value(d)),
            middle(p.tangent, p.gradient(u), p.gradient(d)),
        )
    }

    /// Condition of a form on the displacement of a point, or on its tangent.
    fn form(&self, p: &MaterialPoint, form: [f64; 2], gradient: bool) -> [f64; 3] {
        let (x, g) = self.point(p);
        if gradient {
            [0.0, 0.0, dot(form, rot90(g))]
        } else {
            [form[0], form[1], dot(form, rot90(x))]
        }
    }
}

/// Ties that act in a step, in the order of their numbers.
pub fn each_tie(view: &StepView, mut tell: impl FnMut(Tie)) {
    let (model, forcing) = (view.model, view.forcing);
    let mut number = 0;
    for dofs in &model.prescribed {
        for (n, drive) in dofs.normals.iter().zip(&dofs.drives) {
            if dofs.node < model.beam_node_count() {
                let [x1, x2, g1, g2] = view.node(dofs.node);
                let row = [n[0], n[1], n[1] * x1 - n[0] * x2 + n[3] * g1 - n[2] * g2];
                let moved = forcing.increment(drive);
                tell(Tie { number, node: dofs.node, row, moved, lasts: true, turns: false });
            }
            number += 1;
        }
    }
    held(view, number, &mut tell);
    sprung(view, number + model.constraints.len(), &mut tell);
}

/// Supports given by constraints.
fn held(view: &StepView, first: usize, tell: &mut impl FnMut(Tie)) {
    let (forcing, start) = (view.forcing, &view.state.displacement[..]);
    let step = ConstraintStep { start, increment: view.increment, forcing, share: 0.5 };
    for (i, c) in view.model.constraints.iter().enumerate() {
        if c.support.is_none() || !forcing.constrained[i] {
            continue;
        }
        let point = &c.points()[0];
        let (form, gradient) = step.support_form(c);
        let row = view.form(point, form, gradient);
        let by = forcing.increment(&c.drive);
        // A rotation by an angle is, from the middle, one of twice the tangent of half of it.
        let turns = matches!(c.kind, ConstraintKind::Turned { .. });
        let moved = if turns { row[2] * 2.0 * (0.5 * by).tan() } else { by };
        let lasts = c.until == f64::INFINITY;
        tell(Tie { number: first + i, node: point.node, row, moved, lasts, turns });
    }
}

/// Springs to the ground, where they act.
fn sprung(view: &StepView, first: usize, tell: &mut impl FnMut(Tie)) {
    let (model, state, forcing) = (view.model, view.state, view.forcing);
    for (i, c) in model.connectors.iter().enumerate() {
        let to_ground = match &c.coordinate {
            Coordinate::Displacement { .. } => true,
            Coordinate::Distance { ends } => {
                let ground = |end: &ConnectorEnd| matches!(end, ConnectorEnd::Ground(_));
                ends.iter().any(ground) && c.on_beams().next().is_some()
            }
            Coordinate::Angle { b, .. } => b.is_none(),
        };
        if !to_ground || !acts(view, i) {
            continue;
        }
        let drive = match &c.coordinate {
            Coordinate::Displacement { drive, .. } => forcing.increment(drive),
            _ => 0.0,
        };
        let step = c.step(i, view.rule, forcing, state, view.increment);
        let lasts = c.until == f64::INFINITY
            && c.yielding.is_none()
            && matches!(c.law, ConnectorLaw::Linear { .. });
        for (end, (point, gradient)) in c.attachments() {
            let row = view.form(point, step.forms[end], gradient);
            tell(Tie {
                number: first + i,
                node: point.node,
                row,
                moved: drive,
                lasts,
                turns: false,
            });
        }
    }
}

/// Whether a spring has stiffness at the start of a step.
pub(super) fn acts(view: &StepView, i: usize) -> bool {
    let c = &view.model.connectors[i];
    let stiff = c.law.stiffness_at(view.state.coordinates[i]) > 0.0;
    stiff && view.forcing.connected[i] && !c.has_failed(&view.state.memories)
}

/// Motions of a body as a whole that its ties prescribe and leave free, in (a, w L), with a translation a, a rotation w and a length L.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Freedom {
    /// Motion prescribed by the ties, shape (3) \[m\].
    pub given: [f64; 3],
    /// Orthonormal fixed directions, shape (3, 3) \[-\]; the first `held` of them.
    directions: [[f64; 3]; 3],
    /// Number of fixed directions.
    pub held: usize,
}

/// Conditions that differ by less than this share from a sum of others are redundant.
const SAME: f64 = 1e-6;

fn dot3(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a` without its parts along orthonormal directions.
fn rest(mut a: [f64; 3], directions: &[[f64; 3]]) -> [f64; 3] {
    for _ in 0..2 {
        for e in directions {
            let along = dot3(&a, e);
            (0..3).for_each(|i| a[i] -= along * e[i]);
        }
    }
    a
}

impl Freedom {
    /// From conditions about a centre, each with its motion; the independent ones are used, best first.
    pub fn new(conditions: &[([f64; 3], f64)]) -> Self {
        let mut own = Self::default();
        while own.held < 3 {
            let known = &own.directions[..own.held];
            let mut best: Option<([f64; 3], f64, f64)> = None;
            for (row, moved) in conditions {
                let size = dot3(row, row).sqrt();
                let new = rest(row.map(|c| c / size), known);
                let share = dot3(&new, &new).sqrt();
                // The first of equals, so that round-off does not decide.
                if share > SAME && best.is_none_or(|(_, most, _)| share > 1.001 * most) {
                    let missing = (moved - dot3(row, &own.given)) / size;
                    best = Some((new.map(|c| c / share), share, missing / share));
                }
            }
            let Some((direction, _, by)) = best else { break };
            (0..3).for_each(|i| own.given[i] += by * direction[i]);
            own.directions[own.held] = direction;
            own.held += 1;
        }
        own
    }

    /// Orthonormal directions that are free, shape (3 less those held, 3) \[-\].
    pub fn free(&self) -> Vec<[f64; 3]> {
        let mut all = self.directions[..self.held].to_vec();
        while all.len() < 3 {
            let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            let mut left = axes.map(|axis| rest(axis, &all));
            left.sort_by(|a, b| dot3(b, b).total_cmp(&dot3(a, a)));
            let size = dot3(&left[0], &left[0]).sqrt();
            all.push(left[0].map(|c| c / size));
        }
        all.split_off(self.held)
    }
}

/// A condition about a centre in place of the origin, with rotations times a length in place of rotations.
pub(super) fn about(row: [f64; 3], centre: [f64; 2], length: f64) -> [f64; 3] {
    // w J (x - c) = w J x - w J c.
    let moment = row[2] - dot([row[0], row[1]], rot90(centre));
    [row[0], row[1], moment / length]
}

/// Cosine and sine of the rotation with parts along and across a direction.
pub(super) fn turn_between(along: f64, across: f64) -> [f64; 2] {
    let size = norm([along, across]);
    if size > 0.0 { scale(1.0 / size, [along, across]) } else { [1.0, 0.0] }
}

/// Distance between two positions \[m\].
pub(super) fn apart(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    norm(sub([a[0], a[1]], [b[0], b[1]]))
}

/// Moment of nodal forces about a centre: `(x - c) x f + g x f'`.
pub(super) fn moment(x: &[f64; 4], centre: [f64; 2], f: &[f64; 4]) -> f64 {
    cross(sub([x[0], x[1]], centre), [f[0], f[1]]) + cross([x[2], x[3]], [f[2], f[3]])
}
