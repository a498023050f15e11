//! One run with its derivatives, in mid-flight.

mod rest;

use super::commit::Accept;
use super::engine::Engine;
use super::impact::Strike;
use super::ledger::LaneLedger;
use super::log::{Log, Struck};
use super::newton::LaneNewton;
use super::numbers::Numbers;
use super::sensitivity::{Grazing, Horizon, Onset};
use super::yield_log::{Noted, YieldLog};
use percuss::Model;
use percuss::internals::run::contact_status::STICK;
use percuss::internals::scalar::{Dual, Real};
use percuss::internals::settings::{SAME_INSTANT, Settings};
use percuss::math::roots;
use rest::TouchingBodies;

/// Parameters differentiated at once.
pub const TOGETHER: usize = 4;
/// A number with its derivatives; the last one is with respect to the size of the step at hand.
pub type Derived = Dual<{ TOGETHER + 1 }>;

/// Length of an impact interval as a share of the step, and to what share of it an instant is located.
const IMPACT_INTERVAL: f64 = 1e-6;
const LOCATED: f64 = 1e-3;
/// Impacts in one step beyond which they accumulate.
const MOST_IMPACTS: usize = 64;

/// A run in mid-flight.
pub struct Flight<'a> {
    model: &'a Model,
    settings: &'a Settings,
    /// Time at which it ends \[s\].
    end: Derived,
    pub engine: Engine<Derived>,
    pub ledger: LaneLedger<Derived>,
    pub log: Log<Derived>,
    pub search: LaneNewton<Derived>,
    pub solver_steps: usize,
    /// What the contacts have come to, shape (guided projectiles).
    touching: Vec<TouchingBodies>,
    /// Projectiles that came near without touching: number, time, gap, shape (such projectiles) \[index of a projectile, s, m\].
    misses: Vec<(usize, Derived, Derived)>,
}

impl<'a> Flight<'a> {
    /// At the start of a run that ends at `end`.
    pub fn new(
        model: &'a Model,
        settings: &'a Settings,
        numbers: Numbers<Derived>,
        end: Derived,
    ) -> Self {
        let mut engine = Engine::new(numbers);
        engine.apply_loads();
        let mut search = LaneNewton::idle(engine.h);
        search.set_run(0, true);
        let (ledger, log) = (LaneLedger::open(&engine), Log::new(&engine));
        let touching = vec![TouchingBodies::default(); engine.guides.len()];
        let misses = Vec::new();
        Self {
            model,
            settings,
            end,
            engine,
            ledger,
            log,
            search,
            solver_steps: 0,
            touching,
            misses,
        }
    }

    /// Runs to the end, or as far as derivatives are known.
    ///
    /// # Errors
    /// How far that is.
    pub fn run(&mut self) -> Result<(), Horizon> {
        self.close_at_rest();
        let zero = self.engine.h.constant(0.0);
        let (step, end) = (self.settings.step, self.settings.end);
        let (mut offset, count) = (zero, self.settings.step_count());
        for k in 0..count {
            let target = step.min(end - k as f64 * step);
            let target = if (target - step).abs() <= SAME_INSTANT * step { step } else { target };
            let (mut target, mut until) =
                (zero.constant(target), zero.constant(((k + 1) as f64 * step).min(end)));
            if k + 1 == count {
                // The last step is as long as the run is.
                (target.slope, until.slope) = (self.end.slope, self.end.slope);
            }
            offset = self.advance(target, offset)? - target;
            self.log.time = until + offset;
        }
        for (k, guide) in self.engine.guides.iter().enumerate() {
            // What still approaches may touch before the end in a run beside this one.
            if guide.gap.value > 0.0 && guide.rate.value < 0.0 {
                self.misses.push((k, self.log.time, guide.gap));
            }
        }
        Ok(())
    }

    /// Contacts, misses and beams that can yield with the changes of the parameters that would end or begin them.
    pub fn grazing(&self, parameters: usize) -> Vec<Grazing> {
        let mut all = Vec::new();
        let mut add = |onset: Onset, time: Derived, missed: bool, left: Derived, power: f64| {
            let change = |slope: f64| -left.value / (power * slope);
            let changes = left.slope[..parameters].iter().map(|s| change(*s)).collect();
            all.push(Grazing { onset, time: time.value, missed, changes });
        };
        let contact = |k: usize| Onset::Contact(self.model.contacts[k].name.clone());
        for (k, log) in self.log.guides.iter().enumerate() {
            for closed in self.log.intervals(&self.engine, k, 0) {
                add(contact(k), closed.start, false, closed.deepest.value, 1.0);
            }
            for struck in &log.impacts[0] {
                // The velocity of approach falls with the root of what a parameter is away from grazing.
                add(contact(k), struck.time, false, struck.approach, 2.0);
            }
        }
        for (k, time, gap) in &self.misses {
            add(contact(*k), *time, true, *gap, 1.0);
        }
        for (beam, logs) in self.yields(self.model) {
            let onset = Onset::Yield(beam.name.clone());
            let larger = |a: Noted<Derived>, b: Noted<Derived>| {
                if a.value.value < b.value.value { b } else { a }
            };
            let most =
                |of: fn(&YieldLog<Derived>) -> Noted<Derived>| logs.iter().map(of).reduce(larger);
            let (Some(flowed), Some(near)) = (most(|l| l.accumulated), most(|l| l.near)) else {
                continue;
            };
            if flowed.value.value > 0.0 {
                add(onset, flowed.time, false, flowed.value, 1.0);
            } else if near.value.value > 0.0 {
                let left = near.value.constant(1.0) - near.value;
                add(onset, near.time, true, left, 1.0);
            }
        }
        all
    }

    /// Advances by a step of the given size, less what is done of it; returns what is done then.
    fn advance(&mut self, target: Derived, mut offset: Derived) -> Result<Derived, Horizon> {
        let mut last = None;
        for _ in 0..MOST_IMPACTS {
            let left = target - offset;
            if left.value <= SAME_INSTANT * target.value {
                return Ok(offset);
            }
            let rests = self.resting()?;
            let struck = match self.touching_again() {
                Some(k) => Some(k),
                None => {
                    self.log.begin(&self.engine);
                    let held = rests.map(|k| (k, Strike::Stays));
                    self.solve(left, held)?;
                    let struck = self.first_contact(left, held)?;
                    offset += self.engine.h;
                    self.accept_part(rests);
                    if self.engine.fibres.failing {
                        return Err(self.horizon("there a fibre fails".into()));
                    }
                    struck
                }
            };
            if let Some(k) = struck {
                offset += self.impact_interval(k, rests)?;
                last = struck;
            }
        }
        let name = last.map_or("", |k| &self.model.contacts[k].name);
        Err(self.horizon(format!("impacts of `{name}` accumulate there")))
    }

    /// Derivatives end where the run stands.
    fn horizon(&self, why: String) -> Horizon {
        Horizon { time: self.log.time.value, why }
    }

    fn solve(&mut self, h: Derived, striking: Option<(usize, Strike)>) -> Result<(), Horizon> {
        self.solver_steps += 1;
        self.engine.h = h;
        self.engine.striking = striking;
        self.engine.constraints.impulsive = striking.is_some_and(|(_, how)| how != Strike::Stays);
        self.engine.solve(&self.ledger, &mut self.search);
        match self.search.failed {
            true => Err(self.horizon("there the step has to be cut".into())),
            false => Ok(()),
        }
    }

    fn accept(&mut self) {
        let (engine, ledger, log) = (&mut self.engine, &mut self.ledger, &mut self.log);
        Accept { engine, ledger, log, go: None }.accept();
        if self.engine.striking.is_none() {
            self.misses.extend(self.log.passes(&self.engine));
        }
        self.log.time += self.engine.h;
    }

    /// Gap of a rigid projectile half an impact interval after the end of the step solved last.
    fn ahead(&self, k: usize) -> Derived {
        let [gap, rate] = self.engine.gap_next(k);
        let half = 0.5 * IMPACT_INTERVAL * self.settings.step;
        if rate.value < 0.0 { gap + rate * half } else { gap }
    }

    /// The rigid projectile that touches first within the step solved last, if one does; the step up to that instant is then
    /// the one solved last.
    fn first_contact(
        &mut self,
        size: Derived,
        held: Option<(usize, Strike)>,
    ) -> Result<Option<usize>, Horizon> {
        let all = self.open_rigid();
        let least = |flight: &Self| {
            let each = all.iter().map(|k| (flight.ahead(*k), *k));
            each.min_by(|a, b| a.0.value.total_cmp(&b.0.value))
        };
        let Some((end, _)) = least(self).filter(|(ahead, _)| ahead.value <= 0.0) else {
            return Ok(None);
        };
        let rate = all.iter().map(|k| self.engine.guides[*k].rate.value.abs()).fold(0.0, f64::max);
        let interval = IMPACT_INTERVAL * self.settings.step;
        let start =
            all.iter().map(|k| self.engine.guides[*k].gap.value).fold(f64::INFINITY, f64::min);
        let start = (start - 0.5 * interval * rate).max(LOCATED * interval * rate);
        let guess = size.value * start / (start - end.value);
        let tolerance = LOCATED * interval;
        let instant = roots::bracketed(
            (0.0, start),
            (size.value, end.value),
            guess,
            tolerance,
            tolerance * rate,
            |t| {
                self.solve(size.constant(t), held)?;
                let (ahead, k) = least(self).expect("a rigid projectile");
                let approaches = self.engine.gap_next(k)[1].value < 0.0;
                let open = ahead.value.max(2.0 * tolerance * rate);
                Ok::<f64, Horizon>(if approaches { ahead.value } else { open })
            },
        )?;
        let (_, k) = least(self).expect("a rigid projectile");
        // The instant moves with the parameters so that the gap ahead stays what it is.
        let mut h = size.constant(instant);
        h.slope[TOGETHER] = 1.0;
        self.solve(h, held)?;
        let ahead = self.ahead(k).slope;
        for (own, by) in h.slope.iter_mut().zip(ahead) {
            *own = -by / ahead[TOGETHER];
        }
        h.slope[TOGETHER] = 0.0;
        self.solve(h, held)?;
        Ok(Some(k))
    }

    /// The impact interval in which the impulse of a projectile acts; returns its length.
    fn impact_interval(&mut self, k: usize, rests: Option<usize>) -> Result<Derived, Horizon> {
        if self.touching[rests.unwrap_or(k)].closed {
            return Err(
                self.horizon("there something strikes while another contact is closed".into())
            );
        }
        let h = self.engine.h.constant(IMPACT_INTERVAL * self.settings.step);
        self.log.begin(&self.engine);
        let start = self.log.time;
        let approach = -self.engine.guides[k].rate;
        let stick = (STICK * self.touching[k].approach_max).max(self.negligible()[0]);
        let how = if approach.value <= stick { Strike::Sticks } else { Strike::Rebounds };
        self.solve(h, Some((k, how)))?;
        let state = &self.engine.guides[k];
        let struck = Struck {
            time: start + h * 0.5,
            impulse: state.impulse,
            approach,
            separation: self.engine.gap_next(k)[1],
            given: self.given(k),
            place: self.engine.struck(k),
        };
        if struck.impulse.value > 0.0 {
            self.log.guides[k].impacts[0].push(struck);
        }
        self.accept();
        self.engine.guides[k].impulse = h.constant(0.0);
        let restitution = self.engine.numbers.guides[k].stiffness.value;
        let touching = &mut self.touching[k];
        touching.approach_max = touching.approach_max.max(approach.value);
        touching.closed = how == Strike::Sticks || restitution == 0.0;
        self.close_at_rest();
        Ok(h)
    }
}
