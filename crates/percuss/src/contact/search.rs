//! Which pairs are near enough to touch within a step.
//!
//! A pair seen at a gap cannot touch before the two have moved by as much. What each mover has travelled is summed up step by
//! step; a pair sleeps until the sum of both has reached the gap it was last seen at. Sleep changes no result: pairs that wake are
//! looked at where they stand.

use crate::math::vec2::norm;
use crate::model::Model;
use crate::state::State;

/// Pairs nearer than this stay awake \[m\].
const CLOSE: f64 = 1e-8;

/// Sleeping and waking pairs.
#[derive(Clone, Debug, Default)]
pub struct Search {
    /// Way of each mover since the start, beams then bodies \[m\].
    travelled: Vec<f64>,
    /// Sum of both movers' ways at which a pair wakes, shape (n_pair) \[m\].
    wake: Vec<f64>,
    /// Way of any mover, and the least one at which any pair wakes, counted twice \[m\].
    any: f64,
    first: f64,
    /// Ways of the movers in the step at hand \[m\].
    step: Vec<f64>,
    /// Pairs looked at where the state stands.
    awake: Vec<usize>,
}

impl Search {
    /// All pairs awake.
    pub fn new(model: &Model) -> Self {
        let movers = model.beams.len() + model.bodies.len();
        Self {
            travelled: vec![0.0; movers],
            wake: vec![f64::NEG_INFINITY; model.pairs.len()],
            any: 0.0,
            first: f64::NEG_INFINITY,
            step: vec![0.0; movers],
            awake: Vec::new(),
        }
    }

    /// Gathers the pairs that could touch if the nodes moved by `factor` times `nodal`.
    pub fn within(
        &mut self,
        model: &Model,
        nodal: &[[f64; 4]],
        factor: f64,
        near: &mut Vec<usize>,
    ) {
        near.clear();
        if model.pairs.is_empty() {
            return;
        }
        let most = self.measure(model, nodal, factor);
        if self.any + 2.0 * most < self.first {
            return;
        }
        for (i, pair) in model.pairs.iter().enumerate() {
            let way: f64 = pair.movers.iter().map(|m| self.travelled[*m] + self.step[*m]).sum();
            if way >= self.wake[i] {
                near.push(i);
            }
        }
    }

    /// Pairs that were looked at where the state stands; the others are too far apart to matter.
    pub fn awake(&self) -> &[usize] {
        &self.awake
    }

    /// Way of two movers together in the step measured last \[m\].
    pub fn way(&self, movers: &[usize; 2]) -> f64 {
        movers.iter().map(|m| self.step[*m]).sum()
    }

    /// Ways of the movers; returns the longest.
    fn measure(&mut self, model: &Model, nodal: &[[f64; 4]], factor: f64) -> f64 {
        let beams = model.beams.len();
        let mut most = 0.0_f64;
        for (way, beam) in self.step.iter_mut().zip(&model.beams) {
            // Shape functions of values sum to one; those of slopes reach 4/27 of the length each.
            let reach = |x: &[f64; 4]| (norm([x[0], x[1]]), norm([x[2], x[3]]));
            let (mut value, mut slope) = (0.0_f64, 0.0_f64);
            for x in &nodal[beam.nodes.clone()] {
                let (v, s) = reach(x);
                value = value.max(v);
                slope = slope.max(s);
            }
            let long = beam.axis.iter().map(|e| e.length).fold(0.0, f64::max);
            *way = factor * (value + 8.0 / 27.0 * long * slope);
            most = most.max(*way);
        }
        for i in 0..model.bodies.len() {
            let x = &nodal[model.body_node(i)];
            let way = factor * norm([x[0], x[1]]);
            self.step[beams + i] = way;
            most = most.max(way);
        }
        most
    }

    /// A step was accepted in which the nodes moved by `increment`.
    pub fn moved(&mut self, model: &Model, increment: &[[f64; 4]]) {
        if model.pairs.is_empty() {
            return;
        }
        let most = self.measure(model, increment, 1.0);
        for (travelled, step) in self.travelled.iter_mut().zip(&self.step) {
            *travelled += step;
        }
        self.any += 2.0 * most;
    }

    /// Looks at the pairs that have come near, and lets those that have not sleep on.
    pub fn see(&mut self, model: &Model, state: &mut State) {
        self.awake.clear();
        if self.any < self.first {
            return;
        }
        let mut first = f64::INFINITY;
        for (i, pair) in model.pairs.iter().enumerate() {
            let way: f64 = pair.movers.iter().map(|m| self.travelled[*m]).sum();
            if way >= self.wake[i] {
                self.awake.push(i);
                let apart = state.see(model, i);
                self.wake[i] = way + (0.999 * apart - CLOSE).max(0.0);
            }
            first = first.min(self.wake[i] - way);
        }
        self.first = self.any + first;
    }
}
