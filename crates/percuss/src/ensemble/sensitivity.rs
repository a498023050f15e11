//! Derivatives of a run's results with respect to its parameters: forward differentiation of every operation of the run.
//!
//! The numbers of the frozen model enter with their derivatives; these follow through each step by the linearised step
//! itself. Where an impact is located, the instant moves with the parameters, too: it is a number with derivatives like any
//! other, which gives the jump of the derivatives across the impact (the saltation).

use super::books::Books;
use super::engine::Engine;
use super::log::{Log, Struck};
use super::newton::Search;
use super::numbers::{GuideLaw, Numbers};
use super::shape::{Shape, numbers};
use super::summary::Telling;
use crate::math::roots;
use crate::model::Model;
use crate::scalar::{Dual, Real};
use crate::settings::{SAME_INSTANT, Settings};
use crate::summary::{RunSummary, Termination};

/// Parameters differentiated at once.
const TOGETHER: usize = 4;
/// A number with its derivatives; the last one is with respect to the size of the step at hand.
type Derived = Dual<{ TOGETHER + 1 }>;

/// Length of a pulse as a share of the step, and to what share of it an instant is located.
const PULSE: f64 = 1e-6;
const LOCATED: f64 = 1e-3;
/// Impacts in one step beyond which they accumulate.
const MOST_IMPACTS: usize = 64;

/// A parameter, by the models that it makes.
#[derive(Clone, Debug)]
pub struct Variation {
    /// The model with the parameter less twice, less once, plus once, plus twice its change. What a model is made of is a
    /// smooth function of its parameters: its derivative is the fourth-order difference.
    pub models: [Model; 4],
    /// Change of the parameter.
    pub change: f64,
}

/// A contact that is about to appear or to vanish.
///
/// Where it does, results have a kink: derivatives hold on the side of the run alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Grazing {
    /// Name of the contact.
    pub contact: String,
    /// When \[s\].
    pub time: f64,
    /// Whether the run misses the contact, by so much gap \[m\]; else it has it.
    pub missed_by: Option<f64>,
    /// For every parameter, the change that would just make it touch, or miss, to first order; infinite where it has no say.
    pub changes: Vec<f64>,
}

/// Why a run has no derivatives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Undifferentiated {
    /// Something of model, settings or parameters, or something that happens in the run, has no derivatives here.
    Refused(String),
    /// The run itself fails.
    Failed(String),
}

impl std::fmt::Display for Undifferentiated {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Refused(why) | Self::Failed(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for Undifferentiated {}

impl From<String> for Undifferentiated {
    fn from(why: String) -> Self {
        Self::Refused(why)
    }
}

/// A run and its derivatives.
#[derive(Debug)]
pub struct Sensitivities {
    /// Values; section forces and reactions are left out.
    pub summary: RunSummary,
    /// For every parameter, a summary whose numbers are the derivatives of those of `summary`. Residuals, scales and counts are
    /// those of the run itself.
    pub derivatives: Vec<RunSummary>,
    /// Contacts of the run and contacts it misses, each with the changes of the parameters that would end or begin it.
    pub grazing: Vec<Grazing>,
}

/// Runs a model and differentiates its results.
///
/// # Errors
/// In words, what stands against it: a part of the model or the settings that ensembles do not know, a parameter that changes
/// more than numbers, an iteration that fails, impacts that accumulate or a contact that stays closed.
pub fn sensitivities(
    model: &Model,
    settings: &Settings,
    variations: &[Variation],
) -> Result<Sensitivities, Undifferentiated> {
    if let Some(fault) = settings.validate(model).first() {
        return Err(fault.to_string().into());
    }
    let known = |model: &Model| {
        if model.loads.iter().any(|load| !load.is_steady()) {
            let why = "derivatives are not known for loads that change in time".to_owned();
            return Err(Undifferentiated::from(why));
        }
        let refused = |what| format!("derivatives are not known for {what}").into();
        numbers(model, settings).map_err(refused)
    };
    let base = known(model)?;
    let shape = Shape::of(&base);
    let mut slopes = Vec::new();
    for (i, variation) in variations.iter().enumerate() {
        let mut flat = Vec::new();
        for varied in &variation.models {
            let numbers = known(varied)?;
            if Shape::of(&numbers) != shape {
                let why = format!("parameter {} changes the mesh, not numbers alone", i + 1);
                return Err(why.into());
            }
            flat.push(numbers.flat());
        }
        slopes.push(difference(&flat, variation.change));
    }
    let mut found = run(model, settings, &base, &[])?;
    for chunk in slopes.chunks(TOGETHER) {
        let part = run(model, settings, &base, chunk)?;
        found.summary = part.summary;
        found.derivatives.extend(part.derivatives);
        for (all, more) in found.grazing.iter_mut().zip(part.grazing) {
            all.changes.extend(more.changes);
        }
    }
    Ok(found)
}

/// Fourth-order central difference.
fn difference(flat: &[Vec<f64>], change: f64) -> Vec<f64> {
    let at = |i: usize| -> f64 {
        let [far_below, below, above, far_above] = [0, 1, 2, 3].map(|k: usize| flat[k][i]);
        if far_below.is_nan() {
            return 0.0;
        }
        (8.0 * (above - below) - (far_above - far_below)) / (12.0 * change)
    };
    (0..flat[0].len()).map(at).collect()
}

/// One run with up to [`TOGETHER`] derivatives.
fn run(
    model: &Model,
    settings: &Settings,
    base: &Numbers<f64>,
    slopes: &[Vec<f64>],
) -> Result<Sensitivities, Undifferentiated> {
    let derived = |(i, value): (usize, f64)| {
        let mut slope = [0.0; TOGETHER + 1];
        slopes.iter().zip(&mut slope).for_each(|(from, to)| *to = from[i]);
        Dual { value, slope }
    };
    let flat: Vec<Derived> = base.flat().into_iter().enumerate().map(derived).collect();
    let mut flight = Flight::new(base.with(&flat), settings);
    flight.run()?;
    let telling = Telling {
        model,
        engine: &flight.engine,
        books: &flight.books,
        log: &flight.log,
        search: &flight.search,
        lane: 0,
        steps: settings.step_count(),
        solver_steps: flight.solver_steps,
    };
    let summary = telling.summary(Termination::Completed, &|x: Derived| x.value);
    let derivative = |j: usize| telling.summary(Termination::Completed, &|x: Derived| x.slope[j]);
    let derivatives = (0..slopes.len()).map(derivative).collect();
    Ok(Sensitivities { summary, derivatives, grazing: flight.grazing(model, slopes.len()) })
}

/// A run in mid-flight.
struct Flight<'a> {
    settings: &'a Settings,
    engine: Engine<Derived>,
    books: Books<Derived>,
    log: Log<Derived>,
    search: Search<Derived>,
    solver_steps: usize,
    /// Projectiles that came near without touching: number, time, gap.
    misses: Vec<(usize, Derived, Derived)>,
}

impl<'a> Flight<'a> {
    fn new(numbers: Numbers<Derived>, settings: &'a Settings) -> Self {
        let mut engine = Engine::new(numbers);
        engine.apply_loads();
        let mut search = Search::idle(engine.h);
        search.set_run(0, true);
        let (books, log) = (Books::open(&engine), Log::new(&engine));
        Self { settings, engine, books, log, search, solver_steps: 0, misses: Vec::new() }
    }

    fn run(&mut self) -> Result<(), Undifferentiated> {
        let zero = self.engine.h.constant(0.0);
        let (step, end) = (self.settings.step, self.settings.end);
        let (mut offset, count) = (zero, self.settings.step_count());
        for k in 0..count {
            let target = step.min(end - k as f64 * step);
            let target = if (target - step).abs() <= SAME_INSTANT * step { step } else { target };
            offset = self.advance(target, offset)?;
            offset = offset - zero.constant(target);
            self.log.time = zero.constant(((k + 1) as f64 * step).min(end)) + offset;
        }
        for (k, guide) in self.engine.guides.iter().enumerate() {
            // What still approaches may touch before the end in a run beside this one.
            if guide.gap.value > 0.0 && guide.rate.value < 0.0 {
                self.misses.push((k, self.log.time, guide.gap));
            }
        }
        Ok(())
    }

    /// Contacts and misses with the changes of the parameters that would end or begin them.
    fn grazing(&self, model: &Model, parameters: usize) -> Vec<Grazing> {
        let mut all = Vec::new();
        let mut add = |k: usize, time: f64, missed: bool, left: Derived, power: f64| {
            let change = |slope: f64| -left.value / (power * slope);
            all.push(Grazing {
                contact: model.contacts[k].name.clone(),
                time,
                missed_by: missed.then_some(left.value),
                changes: left.slope[..parameters].iter().map(|s| change(*s)).collect(),
            });
        };
        for (k, log) in self.log.guides.iter().enumerate() {
            for closed in self.log.intervals(&self.engine, k, 0) {
                add(k, closed.start.value, false, closed.deepest.value, 1.0);
            }
            for struck in &log.impacts[0] {
                // The velocity of approach falls with the root of what a parameter is away from grazing.
                add(k, struck.time.value, false, struck.approach, 2.0);
            }
        }
        self.misses.iter().for_each(|(k, time, gap)| add(*k, time.value, true, *gap, 1.0));
        all
    }

    /// Advances by a step of the given size, less what is done of it; returns what is done then.
    fn advance(&mut self, target: f64, mut offset: Derived) -> Result<Derived, Undifferentiated> {
        for _ in 0..MOST_IMPACTS {
            let left = offset.constant(target) - offset;
            if left.value <= SAME_INSTANT * target {
                return Ok(offset);
            }
            self.log.begin(&self.engine);
            self.solve(left, None)?;
            let struck = self.first_contact(left)?;
            offset += self.engine.h;
            self.accept();
            if let Some(k) = struck {
                offset += self.pulse(k)?;
            }
        }
        Err(format!("impacts accumulate at t = {} s", self.log.time.value).into())
    }

    fn solve(&mut self, h: Derived, striking: Option<usize>) -> Result<(), Undifferentiated> {
        self.solver_steps += 1;
        self.engine.h = h;
        self.engine.striking = striking;
        self.engine.solve(&self.books, &mut self.search);
        match self.search.failed {
            true => {
                let why = format!("the iteration fails at t = {} s", self.log.time.value);
                Err(Undifferentiated::Failed(why))
            }
            false => Ok(()),
        }
    }

    fn accept(&mut self) {
        self.books.book(&self.engine);
        self.engine.commit();
        self.log.end(&self.engine);
        if self.engine.striking.is_none() {
            self.misses.extend(self.log.passes(&self.engine));
        }
        self.books.close(&self.engine);
        self.log.time += self.engine.h;
    }

    /// Gap of a rigid projectile half a pulse after the end of the step solved last.
    fn ahead(&self, k: usize) -> Derived {
        let [gap, rate] = self.engine.gap_next(k);
        let half = 0.5 * PULSE * self.settings.step;
        if rate.value < 0.0 { gap + rate * half } else { gap }
    }

    /// The rigid projectile that touches first within the step solved last, if one does; the step up to that instant is then
    /// the one solved last.
    fn first_contact(&mut self, size: Derived) -> Result<Option<usize>, Undifferentiated> {
        let rigid = |k: &usize| self.engine.numbers.guides[*k].law == GuideLaw::Rigid;
        let all: Vec<usize> = (0..self.engine.guides.len()).filter(rigid).collect();
        let least = |flight: &Self| {
            let each = all.iter().map(|k| (flight.ahead(*k), *k));
            each.min_by(|a, b| a.0.value.total_cmp(&b.0.value))
        };
        let Some((end, _)) = least(self).filter(|(ahead, _)| ahead.value <= 0.0) else {
            return Ok(None);
        };
        let rate = all.iter().map(|k| self.engine.guides[*k].rate.value.abs()).fold(0.0, f64::max);
        let pulse = PULSE * self.settings.step;
        let start =
            all.iter().map(|k| self.engine.guides[*k].gap.value).fold(f64::INFINITY, f64::min);
        let start = (start - 0.5 * pulse * rate).max(LOCATED * pulse * rate);
        let guess = size.value * start / (start - end.value);
        let tolerance = LOCATED * pulse;
        let instant = roots::bracketed(
            (0.0, start),
            (size.value, end.value),
            guess,
            tolerance,
            tolerance * rate,
            |t| {
                self.solve(size.constant(t), None)?;
                let (ahead, k) = least(self).expect("a rigid projectile");
                let approaches = self.engine.gap_next(k)[1].value < 0.0;
                let open = ahead.value.max(2.0 * tolerance * rate);
                Ok::<f64, Undifferentiated>(if approaches { ahead.value } else { open })
            },
        )?;
        let (_, k) = least(self).expect("a rigid projectile");
        // The instant moves with the parameters so that the gap ahead stays what it is.
        let mut h = size.constant(instant);
        h.slope[TOGETHER] = 1.0;
        self.solve(h, None)?;
        let ahead = self.ahead(k).slope;
        for (own, by) in h.slope.iter_mut().zip(ahead) {
            *own = -by / ahead[TOGETHER];
        }
        h.slope[TOGETHER] = 0.0;
        self.solve(h, None)?;
        Ok(Some(k))
    }

    /// The pulse in which the impulse of a projectile acts; returns its length.
    fn pulse(&mut self, k: usize) -> Result<Derived, Undifferentiated> {
        let h = self.engine.h.constant(PULSE * self.settings.step);
        if self.engine.numbers.guides[k].stiffness.value == 0.0 {
            return Err(format!("a contact stays closed at t = {} s", self.log.time.value).into());
        }
        self.log.begin(&self.engine);
        let start = self.log.time;
        self.solve(h, Some(k))?;
        let (guide, state) = (&self.engine.numbers.guides[k], &self.engine.guides[k]);
        let force = state.impulse / h;
        let given = [force * guide.along(&self.engine.increment), -(force * state.increment)];
        let struck = Struck {
            time: start + h * 0.5,
            impulse: state.impulse,
            approach: -state.rate,
            separation: self.engine.gap_next(k)[1],
            given,
            place: self.engine.struck(k),
        };
        self.log.guides[k].impacts[0].push(struck);
        self.accept();
        self.engine.guides[k].impulse = h.constant(0.0);
        Ok(h)
    }
}
