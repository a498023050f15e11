//! Pairs that are close enough to touch within a step.
//!
//! A pair with a known gap cannot touch before its movers have travelled this distance. The travel of each mover is summed up step by step; a pair
//! sleeps until the sum of both equals its last known gap. Sleeping changes no result: awake pairs are evaluated in the current configuration.

use serde::{Deserialize, Serialize};

use crate::geometry::axis::{AxisElements, longest_arc};
use crate::geometry::pair::Pair;
use crate::geometry::touch::SearchRegion;
use crate::math::vec2::norm;
use crate::model::Model;
use crate::model::frozen::BeamData;
use crate::state::State;

/// Pairs closer than this stay awake \[m\].
const CLOSE: f64 = 1e-8;
/// Pairs that would wake within this number of steps do not sleep.
const RESTLESS: f64 = 4.0;
/// The growth of an element's control polygon is at most this multiple of the value of [`farthest`] for its beam: twice the largest movement of
/// values and 4/3 of its length times that of slopes.
const STRETCH: f64 = 4.5;
/// Bounds of elements' lengths are updated when they have grown by this share of the beam's longest element.
const LOOSE: f64 = 0.01;

/// Upper bound of the motion of a beam's points for the motion `nodal` of its nodes; `long` is its longest element \[m\].
pub fn farthest(nodal: &[[f64; 4]], long: f64) -> f64 {
    // Components in separate arrays, by their index: the computation uses vector registers at little cost.
    let mut most = [0.0_f64; 4];
    for x in nodal {
        for i in 0..4 {
            let size = x[i].abs();
            most[i] = if size > most[i] { size } else { most[i] };
        }
    }
    // Shape functions of values sum to one; those of slopes reach 4/27 of the length each.
    norm([most[0], most[1]]) + 8.0 / 27.0 * long * norm([most[2], most[3]])
}

/// Upper bound of the motion of a beam's points and of its outline.
pub fn farthest_of(beam: &BeamData, nodal: &[[f64; 4]]) -> f64 {
    let axis = &beam.axis;
    farthest(&nodal[beam.nodes.clone()], axis.longest) + swing(axis, nodal)
}

/// Additional movement by rotation of sections near the ends, where contact points are off the axis. Unit vectors along two derivatives g differ by
/// no more than their difference over their mean length, which is above one half for any realistic strain.
fn swing(axis: &AxisElements, nodal: &[[f64; 4]]) -> f64 {
    let mut most = 0.0_f64;
    for k in axis.at_ends() {
        let element = &axis[k];
        let (a, b) = (&nodal[element.node], &nodal[element.node + 1]);
        let apart = norm([b[0] - a[0], b[1] - a[1]]) * 1.5 / element.length;
        let turn = apart + norm([a[2], a[3]]).max(norm([b[2], b[3]]));
        let [first, last] = element.half_depths;
        most = most.max(2.0 * first.max(last) * turn);
    }
    most
}

/// Lengths that no element exceeds while its nodes move by any share of `increment`, from those where they start.
pub fn longest_arcs(model: &Model, start: &[f64], increment: &[[f64; 4]], arcs: &mut Vec<f64>) {
    arcs.clear();
    arcs.extend(start.iter().zip(&model.beams).map(|(arc, beam)| {
        arc + STRETCH * farthest(&increment[beam.nodes.clone()], beam.axis.longest)
    }));
}

/// Sleeping and waking pairs.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Search {
    /// Travel of each mover since the start, beams then bodies, shape (beams and bodies) \[m\].
    travelled: Vec<f64>,
    /// Sum of both movers' travel at which a pair wakes, shape (pairs) \[m\].
    wake: Vec<f64>,
    /// Travel of any mover, and the least one at which any pair wakes, counted twice \[m\].
    any: f64,
    first: f64,
    /// Travel of the movers in the current step, shape (beams and bodies) \[m\].
    step: Vec<f64>,
    /// The longest of them \[m\].
    longest: f64,
    /// Upper bound of element lengths in the current state, one per beam, shape (beams) \[m\]; empty if no pair is near a face.
    arcs: Vec<f64>,
    /// Their growth with the beams' travel since their computation, as shares of the longest elements, summed up.
    loose: f64,
    /// Pairs evaluated in the current state, shape (such pairs) \[index of a pair\].
    awake: Vec<usize>,
    /// Of these, the ones that are so close that they are evaluated in every step, shape (such pairs) \[index of a pair\]; the others sleep.
    restless: Vec<usize>,
    /// Whether every pair is that of a guided projectile: all of these few pairs are always evaluated.
    guided: bool,
}

impl Search {
    /// Whether it belongs to a model, with valid indices.
    pub fn fits(&self, model: &Model) -> bool {
        let movers = model.beams.len() + model.bodies.len();
        let known = |list: &[usize]| list.iter().all(|pair| *pair < model.pairs.len());
        self.travelled.len() == movers
            && self.step.len() == movers
            && self.wake.len() == model.pairs.len()
            && (self.arcs.is_empty() || self.arcs.len() == model.beams.len())
            && known(&self.awake)
            && known(&self.restless)
    }

    /// All pairs awake.
    pub fn new(model: &Model) -> Self {
        let movers = model.beams.len() + model.bodies.len();
        Self {
            travelled: vec![0.0; movers],
            wake: vec![f64::NEG_INFINITY; model.pairs.len()],
            any: 0.0,
            first: f64::NEG_INFINITY,
            step: vec![0.0; movers],
            longest: 0.0,
            arcs: Vec::new(),
            loose: 0.0,
            awake: Vec::new(),
            restless: Vec::new(),
            guided: model.pairs.len() == model.projectiles.len(),
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
        if self.guided {
            return near.extend(0..model.pairs.len());
        }
        self.measure(model, nodal, factor);
        if self.any + 2.0 * self.longest < self.first {
            return near.extend_from_slice(&self.restless);
        }
        for (i, pair) in model.pairs.iter().enumerate() {
            let way: f64 = pair.movers.iter().map(|m| self.travelled[*m] + self.step[*m]).sum();
            if way >= self.wake[i] || self.restless.binary_search(&i).is_ok() {
                near.push(i);
            }
        }
    }

    /// Travel of the movers, and the longest.
    fn measure(&mut self, model: &Model, nodal: &[[f64; 4]], factor: f64) {
        let beams = model.beams.len();
        let mut most = 0.0_f64;
        for (way, beam) in self.step.iter_mut().zip(&model.beams) {
            *way = factor * farthest_of(beam, nodal);
            most = most.max(*way);
        }
        let first = model.beam_node_count();
        for (way, x) in self.step[beams..].iter_mut().zip(&nodal[first..]) {
            *way = factor * norm([x[0], x[1]]);
            most = most.max(*way);
        }
        self.longest = most;
    }

    /// Accepts the last step of [`Search::within`].
    pub fn moved(&mut self, model: &Model) {
        for (travelled, step) in self.travelled.iter_mut().zip(&self.step) {
            *travelled += step;
        }
        self.any += 2.0 * self.longest;
        for ((arc, way), beam) in self.arcs.iter_mut().zip(&self.step).zip(&model.beams) {
            *arc += STRETCH * way;
            self.loose += STRETCH * way / beam.axis.longest;
        }
    }

    /// Evaluates the pairs that have come close, with their closest points within `reach` of the stored ones; the others continue to sleep.
    pub fn see(&mut self, model: &Model, state: &mut State, reach: SearchRegion) {
        self.awake.clear();
        let mut restless = std::mem::take(&mut self.restless);
        if self.guided {
            (0..model.pairs.len()).for_each(|i| self.see_one(model, state, i, reach));
        } else if self.any < self.first {
            restless.iter().for_each(|i| self.see_one(model, state, *i, reach));
        } else {
            self.first = f64::INFINITY;
            for (i, pair) in model.pairs.iter().enumerate() {
                let way = self.way_of(pair);
                if way >= self.wake[i] || restless.binary_search(&i).is_ok() {
                    self.see_one(model, state, i, reach);
                } else {
                    self.first = self.first.min(self.any + self.wake[i] - way);
                }
            }
        }
        restless.clear();
        for k in 0..self.awake.len() {
            let i = self.awake[k];
            let pair = &model.pairs[i];
            let left = self.wake[i] - self.way_of(pair);
            if left <= RESTLESS * self.way(&pair.movers) {
                restless.push(i);
            } else {
                self.first = self.first.min(self.any + left);
            }
        }
        self.restless = restless;
        self.measure_arcs(model, state);
    }

    /// Bounds the beams' elements if a pair is near a face.
    fn measure_arcs(&mut self, model: &Model, state: &State) {
        let on_face = |i: &usize| model.pairs[*i].target.is_outline();
        let wanted = self.restless.iter().any(on_face);
        if wanted && !self.arcs.is_empty() && self.loose < LOOSE {
            return;
        }
        self.loose = 0.0;
        self.arcs.clear();
        if wanted {
            let at = state.configuration();
            let arc = |b: &BeamData| longest_arc(&b.axis, &model.nodes, &at);
            self.arcs.extend(model.beams.iter().map(arc));
        }
    }

    fn see_one(&mut self, model: &Model, state: &mut State, i: usize, reach: SearchRegion) {
        self.awake.push(i);
        let apart = state.see(model, i, reach);
        self.wake[i] = self.way_of(&model.pairs[i]) + (0.999 * apart - CLOSE).max(0.0);
    }

    /// Upper bound of element lengths in the current state, one per beam; empty if no pair is near a face \[m\].
    pub fn arcs(&self) -> &[f64] {
        &self.arcs
    }

    fn way_of(&self, pair: &Pair) -> f64 {
        pair.movers.iter().map(|m| self.travelled[*m]).sum()
    }

    /// Pairs evaluated in the current state; the others are too far apart to matter.
    pub fn awake(&self) -> &[usize] {
        &self.awake
    }

    /// Least gap that a sleeping pair can have \[m\]; `None` if it is awake.
    pub fn least_gap(&self, pair: &Pair, i: usize) -> Option<f64> {
        if self.awake.binary_search(&i).is_ok() {
            return None;
        }
        Some(self.wake[i] - self.way_of(pair))
    }

    /// Total travel of two movers in the last measured step \[m\].
    pub fn way(&self, movers: &[usize; 2]) -> f64 {
        movers.iter().map(|m| self.step[*m]).sum()
    }
}
