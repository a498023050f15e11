//! External actions over a step, known before it is solved: factors of loads, prescribed motions, active supports.

use crate::model::Model;
use crate::model::frozen::{Drive, LoadAction, LoadData};
use crate::settings::SAME_INSTANT;
use crate::state::Followed;

/// Loads and motions over a step.
#[derive(Clone, Debug, Default)]
pub struct Forcing {
    /// Acceleration of gravity, shape (2) \[m/s^2\].
    pub gravity: [f64; 2],
    /// Factors with which the loads act in the equation of motion, shape (loads) \[-\].
    pub factors: Vec<f64>,
    /// Increments of the prescribed motions' time functions, shape (motions) \[-\].
    moved: Vec<f64>,
    /// Values of the motions' time functions at the start, shape (motions) \[-\].
    started: Vec<f64>,
    /// Derivatives of the time functions at the end, from the left, shape (motions) \[1/s\].
    rates: Vec<f64>,
    /// Second derivatives at the start, from the right, and at the end, from the left, shape (motions, 2) \[1/s^2\].
    second_rates: Vec<[f64; 2]>,
    /// Whether each constraint acts, shape (constraints).
    pub constrained: Vec<bool>,
    /// Whether each connector acts, shape (connectors).
    pub connected: Vec<bool>,
}

/// Parts of a step below this share of it take the increments of motions from their rates: differences of values would be round-off, which in such
/// a short time is a velocity. The next longer part corrects the difference.
const SHORT: f64 = 1e-3;
/// Derivatives of motions given as code are taken over this share of a step.
pub(crate) const WIDTH: f64 = 0.02;

impl Forcing {
    /// Memory for the loads and motions of `model`.
    pub fn new(model: &Model) -> Self {
        Self {
            gravity: [0.0; 2],
            factors: vec![0.0; model.loads.len()],
            moved: vec![0.0; model.motions.len()],
            started: vec![0.0; model.motions.len()],
            rates: vec![0.0; model.motions.len()],
            second_rates: vec![[0.0; 2]; model.motions.len()],
            constrained: vec![true; model.constraints.len()],
            connected: vec![true; model.connectors.len()],
        }
    }

    /// Sets the actions over the part `[start, start + h]` of a step of size `step`, with motions followed to the values and rates `reached`.
    ///
    /// Loads act with their mean over a time h about the instant at which forces balance, at the share `theta`: in the middle of the step it is the
    /// step itself. For any instant the impulse of all steps is that of the load, also of one that begins between two of them, and the order of a
    /// scheme of second order is preserved.
    pub fn set(
        &mut self,
        model: &Model,
        (start, h, theta): (f64, f64, f64),
        step: f64,
        reached: &[Followed],
    ) {
        self.set_loads(model, start + (theta - 0.5) * h, h);
        self.set_motions(model, start, h, step, reached, false);
        let slack = 0.5 * h.min(SHORT * step);
        let holds = |until: f64| start + slack < until;
        for (flag, c) in self.constrained.iter_mut().zip(&model.constraints) {
            *flag = holds(c.until);
        }
        for (flag, c) in self.connected.iter_mut().zip(&model.connectors) {
            *flag = holds(c.until);
        }
    }

    /// Sets the motions only; with `after`, a jump of a rate at the end of the part has been made there.
    pub fn set_motions(
        &mut self,
        model: &Model,
        start: f64,
        h: f64,
        step: f64,
        reached: &[Followed],
        after: bool,
    ) {
        let (end, beside) = (start + h, 2.0 * SAME_INSTANT * step);
        let inside = if after { end + beside } else { end - beside.min(0.5 * h) };
        for (i, function) in model.motions.iter().enumerate() {
            self.started[i] = reached[i].value - reached[i].origin;
            self.rates[i] = function.rate_on(end, inside, WIDTH * step);
            self.second_rates[i] = [
                function.second_rate_on(start, start + beside.min(0.5 * h), 0.5 * step),
                function.second_rate_on(end, inside, 0.5 * step),
            ];
            self.moved[i] = if h >= SHORT * step {
                function.value(end) - reached[i].value
            } else if reached[i].held {
                // A jump of the rate within so short a part is an impulse: velocities change evenly.
                0.5 * h * (reached[i].rate + self.rates[i])
            } else {
                h * function.rate(start + 0.5 * h, WIDTH * step)
            };
        }
    }

    /// Sets a share of the actions at time zero.
    pub fn set_static(&mut self, model: &Model, share: f64) {
        self.set_factors(model, |load| share * load.factor_at_start());
        for (i, function) in model.motions.iter().enumerate() {
            self.started[i] = 0.0;
            self.moved[i] = share * function.value(0.0);
        }
        self.constrained.fill(true);
        self.connected.fill(true);
    }

    /// Sets supports to their state after a run that ended at a time: motions have their last values, and supports whose time has ended are inactive.
    pub fn leave(&mut self, model: &Model, time: f64, reached: &[Followed]) {
        for (started, reached) in self.started.iter_mut().zip(reached) {
            *started = reached.value - reached.origin;
        }
        self.moved.fill(0.0);
        let holds = |until: f64| until >= time * (1.0 - SAME_INSTANT);
        for (flag, c) in self.constrained.iter_mut().zip(&model.constraints) {
            *flag &= holds(c.until);
        }
        for (flag, c) in self.connected.iter_mut().zip(&model.connectors) {
            *flag &= holds(c.until);
        }
    }

    /// Sets the loads that act at an instant, from the right at the start of a run and on both sides of it later, over a time h.
    pub fn set_loads_at(&mut self, model: &Model, time: f64, h: f64) {
        if time > 0.0 {
            self.set_loads(model, time - 0.5 * h, h);
        } else {
            self.set_factors(model, LoadData::factor_at_start);
        }
    }

    /// Makes the current values of the motions their start: the motions end.
    pub fn hold_motions(&mut self) {
        for (started, moved) in self.started.iter_mut().zip(&mut self.moved) {
            *started += std::mem::take(moved);
        }
    }

    /// Adds the increments and rates of the motions to those `reached`.
    pub fn follow(&self, reached: &mut [Followed]) {
        for (i, reached) in reached.iter_mut().enumerate() {
            reached.value += self.moved[i];
            reached.rate = self.rates[i];
        }
    }

    /// Sets the factors of loads that give strains to those of `factors`, shape (loads) \[-\].
    pub fn give_strains(&mut self, model: &Model, factors: &[f64]) {
        for ((own, load), factor) in self.factors.iter_mut().zip(&model.loads).zip(factors) {
            if let LoadAction::Strain { .. } = load.kind {
                *own = *factor;
            }
        }
    }

    /// Leaves prescribed motions out.
    pub fn rest_motions(&mut self) {
        self.moved.fill(0.0);
    }

    /// Sets the mean of the loads over a time h.
    fn set_loads(&mut self, model: &Model, start: f64, h: f64) {
        self.set_factors(model, |load| load.factor(start, h));
    }

    fn set_factors(&mut self, model: &Model, of: impl Fn(&LoadData) -> f64) {
        self.gravity = [0.0; 2];
        for (factor, load) in self.factors.iter_mut().zip(&model.loads) {
            *factor = of(load);
            if let LoadAction::Gravity { acceleration } = load.kind {
                self.gravity[0] += *factor * acceleration[0];
                self.gravity[1] += *factor * acceleration[1];
            }
        }
    }

    /// Rate of a prescribed value at the end of the step, from the left.
    pub fn rate(&self, drive: &Drive) -> f64 {
        drive.iter().map(|(motion, amplitude)| amplitude * self.rates[*motion]).sum()
    }

    /// Second derivatives of a prescribed value at the start of the step, from the right, and at its end, from the left.
    pub fn second_rates(&self, drive: &Drive) -> [f64; 2] {
        let at = |end: usize| {
            let each = drive.iter().map(|(motion, a)| a * self.second_rates[*motion][end]);
            each.sum()
        };
        [at(0), at(1)]
    }

    /// Second derivative of a prescribed value at time zero, from the right.
    pub fn second_rate_at_start(&self, model: &Model, drive: &Drive, step: f64) -> f64 {
        let inside = 2.0 * SAME_INSTANT * step;
        let second = |motion: usize| model.motions[motion].second_rate_on(0.0, inside, 0.5 * step);
        drive.iter().map(|(motion, amplitude)| amplitude * second(*motion)).sum()
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
