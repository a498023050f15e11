//! What acts from outside over a step, known before it is solved: factors of loads, prescribed motions, what holds.

use crate::model::Model;
use crate::model::frozen::{Drive, LoadAction};

/// Loads and motions over a step.
#[derive(Clone, Debug)]
pub struct Forcing {
    /// Acceleration of gravity \[m/s^2\].
    pub gravity: [f64; 2],
    /// Mean factors of the loads, shape (n_load).
    pub factors: Vec<f64>,
    /// Increments of the prescribed motions' courses, shape (n_motion).
    moved: Vec<f64>,
    /// Values to which the courses were followed by the start, shape (n_motion).
    started: Vec<f64>,
    /// Whether each constraint acts, shape (n_constraint).
    pub constrained: Vec<bool>,
    /// Whether each connector acts, shape (n_connector).
    pub connected: Vec<bool>,
}

/// Parts of a step below this share of it take the increments of motions from their rates: differences of values would be
/// round-off, and round-off over so short a time a velocity. What they leave out or add the next longer part makes good.
const SHORT: f64 = 1e-3;
/// Derivatives of motions given as code are taken over this share of a step.
const WIDTH: f64 = 0.02;

impl Forcing {
    /// Room for the loads and motions of `model`.
    pub fn new(model: &Model) -> Self {
        Self {
            gravity: [0.0; 2],
            factors: vec![0.0; model.loads.len()],
            moved: vec![0.0; model.motions.len()],
            started: vec![0.0; model.motions.len()],
            constrained: vec![true; model.constraints.len()],
            connected: vec![true; model.connectors.len()],
        }
    }

    /// Sets what acts over the part `[start, start + h]` of a step of size `step`, motions followed to the values `reached`.
    pub fn set(&mut self, model: &Model, start: f64, h: f64, step: f64, reached: &[f64]) {
        self.set_loads(model, start, h, 1.0);
        for (i, course) in model.motions.iter().enumerate() {
            self.started[i] = reached[i];
            self.moved[i] = if h >= SHORT * step {
                course.value(start + h) - reached[i]
            } else {
                h * course.rate(start + 0.5 * h, WIDTH * step)
            };
        }
        let slack = 0.5 * h.min(SHORT * step);
        let holds = |until: f64| start + slack < until;
        for (flag, c) in self.constrained.iter_mut().zip(&model.constraints) {
            *flag = holds(c.until);
        }
        for (flag, c) in self.connected.iter_mut().zip(&model.connectors) {
            *flag = holds(c.until);
        }
    }

    /// Sets a share of what acts at time zero.
    pub fn set_static(&mut self, model: &Model, share: f64) {
        self.set_loads(model, 0.0, 1e-9, share);
        for (i, course) in model.motions.iter().enumerate() {
            self.started[i] = 0.0;
            self.moved[i] = share * course.value(0.0);
        }
        self.constrained.fill(true);
        self.connected.fill(true);
    }

    /// Takes what motions have brought as their start: nothing moves any further.
    pub fn hold_motions(&mut self) {
        for (started, moved) in self.started.iter_mut().zip(&mut self.moved) {
            *started += std::mem::take(moved);
        }
    }

    /// Takes the increments of the motions into the values `reached`.
    pub fn follow(&self, reached: &mut [f64]) {
        for (reached, moved) in reached.iter_mut().zip(&self.moved) {
            *reached += moved;
        }
    }

    /// Leaves prescribed motions out.
    pub fn rest_motions(&mut self) {
        self.moved.fill(0.0);
    }

    fn set_loads(&mut self, model: &Model, start: f64, h: f64, share: f64) {
        self.gravity = [0.0; 2];
        for (factor, load) in self.factors.iter_mut().zip(&model.loads) {
            *factor = share * load.factor(start, h);
            if let LoadAction::Gravity { acceleration } = load.kind {
                self.gravity[0] += *factor * acceleration[0];
                self.gravity[1] += *factor * acceleration[1];
            }
        }
    }

    /// Increment of a prescribed value over the step.
    pub fn increment(&self, drive: &Drive) -> f64 {
        drive.iter().map(|(motion, amplitude)| amplitude * self.moved[*motion]).sum()
    }

    /// A prescribed value at the start of the step.
    pub fn start(&self, drive: &Drive) -> f64 {
        drive.iter().map(|(motion, amplitude)| amplitude * self.started[*motion]).sum()
    }
}
