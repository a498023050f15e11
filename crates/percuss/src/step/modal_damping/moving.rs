//! Modes that rotate with their bodies, and the motion of bodies as a whole.

use super::ModalDamping;
use super::bodies::Bodies;
use super::ground::{Freedom, StepView, Tie, about, each_tie, moment, turn_between};
use crate::ledger::StepWork;
use crate::linalg::block::inner;
use crate::math::vec2::dot4;
use crate::model::Model;
use crate::state::State;
use crate::step::constraint::turn;
use crate::step::external::middle;

/// Vectors of modal damping in the middle of a step, and the contribution of moving supports.
#[derive(Clone, Debug, Default)]
pub struct MovingModes {
    bodies: Bodies,
    /// `P^T Q M phi`, shape (modes, nodes, 4) \[kg^(1/2), kg^(1/2) m\].
    vectors: Vec<Vec<[f64; 4]>>,
    /// Change of each mode's coordinate with the supports, shape (modes) \[kg^(1/2) m\].
    followed: Vec<f64>,
}

/// Effect of modal damping in a step.
#[derive(Clone, Copy, Debug)]
pub struct ModalFlow {
    /// Work, impulse and angular impulse of its forces on the structure.
    pub done: StepWork,
    /// Dissipated energy \[J\].
    pub loss: f64,
    /// Its part supplied by moving supports \[J\].
    pub brought: f64,
}

/// A body in the middle of a step.
#[derive(Clone, Debug)]
struct BodyMiddle {
    /// A point near it, the centre of its rotation, shape (2) \[m\].
    centre: [f64; 2],
    length: f64,
    freedom: Freedom,
    /// Cosine and sine of its rotation since the start, shape (2) \[-\].
    turned: [f64; 2],
    /// Motions that are free, in (a, w L), orthonormal in the inner product of the mass, shape (free motions, 3) \[kg^(-1/2)\].
    free: Vec<[f64; 3]>,
}

impl BodyMiddle {
    /// Nodal value of a motion of the body as a whole, at a node of given position and tangent.
    fn motion(&self, x: &[f64; 4], y: &[f64; 3]) -> [f64; 4] {
        let w = y[2] / self.length;
        let (x1, x2) = (x[0] - self.centre[0], x[1] - self.centre[1]);
        [y[0] - w * x2, y[1] + w * x1, -w * x[3], w * x[2]]
    }
}

/// Nodal values turned.
fn turned(by: [f64; 2], v: &[f64; 4]) -> [f64; 4] {
    let ([a, b], [c, d]) = (turn(by, [v[0], v[1]]), turn(by, [v[2], v[3]]));
    [a, b, c, d]
}

impl MovingModes {
    /// The vectors of each mode in the middle of the step, shape (modes, nodes, 4) \[kg^(1/2), kg^(1/2) m\].
    pub fn vectors<'a>(&'a self, damping: &'a ModalDamping) -> &'a [Vec<[f64; 4]>] {
        if damping.moves { &self.vectors } else { &damping.vectors }
    }

    /// Enters an increment.
    pub fn set(&mut self, damping: &ModalDamping, view: &StepView) {
        if damping.is_empty() || !damping.moves {
            return;
        }
        self.bodies.follow(damping, view);
        let x: Vec<[f64; 4]> = (0..damping.start.len()).map(|n| view.node(n)).collect();
        let (ties, mut middles) = self.middles(view, &x);
        let weighed = self.weigh(damping, &x, &mut middles);
        self.vectors.clone_from(&damping.vectors);
        self.followed.clear();
        for (k, vector) in self.vectors.iter_mut().enumerate() {
            project(vector, &self.bodies, &x, &middles, &weighed);
            let mut followed = 0.0;
            for ((v, x), body) in vector.iter().zip(&x).zip(&self.bodies.of_node) {
                let middle = &middles[*body];
                if middle.freedom.given != [0.0; 3] {
                    let by = middle.motion(x, &middle.freedom.given);
                    followed += dot4(v, &by);
                }
            }
            // The structure follows relative motions of supports statically.
            for tie in &ties {
                let middle = &middles[self.bodies.of_node[tie.node]];
                let row = about(tie.row, middle.centre, middle.length);
                let given: f64 = row.iter().zip(&middle.freedom.given).map(|(a, b)| a * b).sum();
                followed +=
                    damping.followed[k].get(tie.number).unwrap_or(&0.0) * (tie.moved - given);
            }
            self.followed.push(followed);
        }
    }

    /// The share of a mode that is motion of bodies as a whole, from 0 to 1 at the start; the vector is `M phi`.
    pub fn rigid_share(damping: &ModalDamping, view: &StepView, vector: &[[f64; 4]]) -> f64 {
        let mut own = Self::default();
        own.bodies.follow(damping, view);
        let (_, mut middles) = own.middles(view, &damping.start);
        own.weigh(damping, &damping.start, &mut middles);
        let mut parts: Vec<Vec<f64>> = middles.iter().map(|m| vec![0.0; m.free.len()]).collect();
        for ((v, x), body) in vector.iter().zip(&damping.start).zip(&own.bodies.of_node) {
            for (part, free) in parts[*body].iter_mut().zip(&middles[*body].free) {
                let by = middles[*body].motion(x, free);
                *part += dot4(v, &by);
            }
        }
        parts.iter().flatten().map(|p| p * p).sum()
    }

    /// Number of motions as a whole that ties leave free, and whether any body can ever move as a whole.
    pub fn freedoms(damping: &ModalDamping, view: &StepView) -> (usize, bool) {
        let mut own = Self::default();
        own.bodies.follow(damping, view);
        let (ties, middles) = own.middles(view, &damping.start);
        let free = middles.iter().map(|m| 3 - m.freedom.held).sum();
        let lasting: Vec<Tie> = ties.iter().filter(|tie| tie.lasts).copied().collect();
        let always = own.freedom(&lasting, &damping.start).iter().all(|(_, f)| f.held == 3);
        (free, !always)
    }

    /// Bodies in the middle of the step, without their masses, and the ties that act.
    fn middles(&self, view: &StepView, x: &[[f64; 4]]) -> (Vec<Tie>, Vec<BodyMiddle>) {
        let mut ties = Vec::new();
        each_tie(view, |tie| ties.push(tie));
        let freedom = self.freedom(&ties, x);
        let mut turns: Vec<bool> =
            freedom.iter().map(|(_, f)| f.free().iter().any(|y| y[2] != 0.0)).collect();
        for tie in ties.iter().filter(|tie| tie.turns) {
            turns[self.bodies.of_node[tie.node]] = true;
        }
        let [along, across] = &self.bodies.weighed;
        let mut fit = vec![[0.0; 2]; turns.len()];
        for (n, (x, body)) in x.iter().zip(&self.bodies.of_node).enumerate() {
            let centre = freedom[*body].0;
            let x = [x[0] - centre[0], x[1] - centre[1], x[2], x[3]];
            fit[*body][0] += dot4(&along[n], &x);
            fit[*body][1] += dot4(&across[n], &x);
        }
        let middle = |(body, (centre, freedom)): (usize, ([f64; 2], Freedom))| {
            let [along, across] = fit[body];
            let turned = if turns[body] { turn_between(along, across) } else { [1.0, 0.0] };
            let length = self.bodies.lengths[body];
            BodyMiddle { centre, length, freedom, turned, free: Vec::new() }
        };
        (ties, freedom.into_iter().enumerate().map(middle).collect())
    }

    /// Centre of each body, and the motions that the ties prescribe and leave free about it.
    fn freedom(&self, ties: &[Tie], x: &[[f64; 4]]) -> Vec<([f64; 2], Freedom)> {
        let count = self.bodies.count();
        let mut sums = vec![[0.0; 3]; count];
        for (x, body) in x.iter().zip(&self.bodies.of_node) {
            let sum = &mut sums[*body];
            *sum = [sum[0] + x[0], sum[1] + x[1], sum[2] + 1.0];
        }
        let centres: Vec<[f64; 2]> = sums.iter().map(|s| [s[0] / s[2], s[1] / s[2]]).collect();
        let mut conditions = vec![Vec::new(); count];
        for tie in ties {
            let body = self.bodies.of_node[tie.node];
            let row = about(tie.row, centres[body], self.bodies.lengths[body]);
            if row != [0.0; 3] {
                conditions[body].push((row, tie.moved));
            }
        }
        centres.into_iter().zip(conditions.iter().map(|c| Freedom::new(c))).collect()
    }

    /// Free motions of each body orthonormal in the inner product of the mass, and their products with it, shape (3, nodes of beams, 4)
    /// \[kg^(1/2), kg^(1/2) m\].
    fn weigh(
        &self,
        damping: &ModalDamping,
        x: &[[f64; 4]],
        middles: &mut [BodyMiddle],
    ) -> [Vec<[f64; 4]>; 3] {
        if middles.iter().all(|m| m.freedom.held == 3) {
            return Default::default();
        }
        let of_node = &self.bodies.of_node;
        let weighed: [Vec<[f64; 4]>; 3] = std::array::from_fn(|k| {
            // Q M Q^T R: the mass turns with the body.
            let back = |(x, body): (&[f64; 4], &usize)| {
                let middle = &middles[*body];
                let mut y = [0.0; 3];
                y[k] = 1.0;
                turned([middle.turned[0], -middle.turned[1]], &middle.motion(x, &y))
            };
            let columns: Vec<[f64; 4]> = x.iter().zip(of_node).map(back).collect();
            let mut image = damping.mass.multiply(&columns);
            for (v, body) in image.iter_mut().zip(of_node) {
                *v = turned(middles[*body].turned, v);
            }
            image
        });
        let grams = weighed.each_ref().map(|column| resultants(column, &self.bodies, x, middles));
        for (body, middle) in middles.iter_mut().enumerate() {
            let gram = grams.each_ref().map(|rows| rows[body]);
            middle.free = orthonormal(&middle.freedom.free(), &gram);
        }
        weighed
    }

    /// Adds the damping forces of an increment in a step of size `h` to a residual.
    pub fn apply(
        &self,
        damping: &ModalDamping,
        increment: &[[f64; 4]],
        h: f64,
        residual: &mut [[f64; 4]],
    ) {
        for (k, vector) in self.vectors(damping).iter().enumerate() {
            let force = damping.rates[k] * self.moved(k, vector, increment) / h;
            for (target, v) in residual.iter_mut().zip(vector) {
                (0..4).for_each(|i| target[i] += force * v[i]);
            }
        }
    }

    /// Change of a mode's coordinate, relative to rigid motion and supports.
    fn moved(&self, k: usize, vector: &[[f64; 4]], increment: &[[f64; 4]]) -> f64 {
        inner(vector, increment) - self.followed.get(k).unwrap_or(&0.0)
    }

    /// Effect of the damping in a step by an increment from a state.
    pub fn flow(
        &self,
        model: &Model,
        damping: &ModalDamping,
        state: &State,
        increment: &[[f64; 4]],
        h: f64,
    ) -> ModalFlow {
        let mut force = vec![[0.0; 4]; increment.len()];
        self.apply(damping, increment, h, &mut force);
        let mut done = StepWork::default();
        for (node, f) in force.iter().enumerate() {
            let place = middle(model, state, increment, node);
            done.add_nodal(&f.map(|x| -x), place, &increment[node], h);
        }
        let (mut loss, mut brought) = (0.0, 0.0);
        for (k, vector) in self.vectors(damping).iter().enumerate() {
            let moved = self.moved(k, vector, increment);
            loss += damping.rates[k] / h * moved * moved;
            brought -= damping.rates[k] / h * moved * self.followed.get(k).unwrap_or(&0.0);
        }
        ModalFlow { done, loss, brought }
    }
}

/// Resultant and moment over length of nodal forces on each body, about its centre, shape (bodies, 3).
fn resultants(
    forces: &[[f64; 4]],
    bodies: &Bodies,
    x: &[[f64; 4]],
    middles: &[BodyMiddle],
) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; middles.len()];
    for ((v, x), body) in forces.iter().zip(x).zip(&bodies.of_node) {
        let (middle, sum) = (&middles[*body], &mut sums[*body]);
        let about = moment(x, middle.centre, v) / middle.length;
        *sum = [sum[0] + v[0], sum[1] + v[1], sum[2] + about];
    }
    sums
}

/// Motions made orthonormal in the inner product of a matrix.
fn orthonormal(motions: &[[f64; 3]], gram: &[[f64; 3]; 3]) -> Vec<[f64; 3]> {
    let product = |a: &[f64; 3], b: &[f64; 3]| -> f64 {
        (0..3).map(|i| a[i] * (0..3).map(|j| gram[i][j] * b[j]).sum::<f64>()).sum()
    };
    let mut out: Vec<[f64; 3]> = Vec::new();
    for motion in motions {
        let mut y = *motion;
        for _ in 0..2 {
            for other in &out {
                let along = product(&y, other);
                (0..3).for_each(|i| y[i] -= along * other[i]);
            }
        }
        let size = product(&y, &y).sqrt();
        if size > 0.0 {
            out.push(y.map(|c| c / size));
        }
    }
    out
}

/// Rotates a vector with the bodies and subtracts its resultants against their free motions: `P^T Q v`.
fn project(
    vector: &mut [[f64; 4]],
    bodies: &Bodies,
    x: &[[f64; 4]],
    middles: &[BodyMiddle],
    weighed: &[Vec<[f64; 4]>; 3],
) {
    for (v, body) in vector.iter_mut().zip(&bodies.of_node) {
        if middles[*body].turned != [1.0, 0.0] {
            *v = turned(middles[*body].turned, v);
        }
    }
    // Twice: the remainder of resultants of round-off size is round-off of round-off.
    for _ in 0..2 {
        let sums = resultants(vector, bodies, x, middles);
        let taken: Vec<[f64; 3]> = middles.iter().zip(&sums).map(|(m, s)| taken(m, s)).collect();
        for (n, (v, body)) in vector.iter_mut().zip(&bodies.of_node).enumerate() {
            if middles[*body].free.is_empty() {
                continue;
            }
            for (column, share) in weighed.iter().zip(&taken[*body]) {
                (0..4).for_each(|i| v[i] -= share * column[n][i]);
            }
        }
    }
}

/// Motion whose momenta have given resultants against the free motions.
fn taken(middle: &BodyMiddle, resultants: &[f64; 3]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for free in &middle.free {
        let along: f64 = free.iter().zip(resultants).map(|(a, b)| a * b).sum();
        (0..3).for_each(|i| sum[i] += along * free[i]);
    }
    sum
}
