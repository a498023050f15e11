//! State and stepping of one run with its derivatives.

mod columns;
mod plastic;

use super::column::{ColumnSample, Found};
use super::commit::Accept;
use super::drive::rigid_guides;
use super::engine::Engine;
use super::horizon::Horizon;
use super::impact::Press;
use super::known_columns::KnownColumns;
use super::ledger::LaneLedger;
use super::log::Log;
use super::newton::LaneNewton;
use super::numbers::Numbers;
use super::rigid_log::RigidLog;
use super::run_progress::{RunProgress, scales};
use super::value_solver::{SolvesValues, value_solver};
use percuss::Model;
use percuss::internals::contact::impact::gives_energy;
use percuss::internals::run::decider::{IMPACT_INTERVAL, Negligible, RunScales};
use percuss::internals::run::locate::Seen;
use percuss::internals::scalar::{Dual, Number, Real};
use percuss::internals::settings::Settings;
use percuss::internals::step::contacts::{IMPULSIVE, Phase};

/// Parameters differentiated at once: with the size of the step as many as a register of most processors has numbers.
pub const TOGETHER: usize = 3;
/// A number with its derivatives; the last one is with respect to the size of the current step.
pub type Derived = Dual<{ TOGETHER + 1 }>;

/// A run with its derivatives between two parts of steps.
pub struct DerivativeRun<'a> {
    pub model: &'a Model,
    settings: &'a Settings,
    /// Time at which it ends \[s\].
    end: Derived,
    pub engine: Engine<Derived>,
    pub ledger: LaneLedger<Derived>,
    pub log: Log<Derived>,
    /// Corrections and factorisations of the run.
    pub search: LaneNewton<Derived>,
    /// Solver of the values of a step, and of the factors for its derivatives.
    values: Box<dyn SolvesValues<Derived>>,
    /// Time and contacts of the run, from its values without derivatives.
    pub progress: RunProgress,
    /// Rigid projectiles, shape (rigid contacts) \[index of a projectile\].
    rigid: Vec<usize>,
    /// Records of their contacts, shape (guided projectiles).
    pub rigid_logs: Vec<RigidLog<Derived>>,
    /// Completed share of the current step \[s\].
    offset: Derived,
    /// Projectiles that came near without touching: number, time, gap, shape (such projectiles) \[index of a projectile, s, m\].
    pub misses: Vec<(usize, Derived, Derived)>,
    /// Numbers taken from the columns of its history.
    columns: KnownColumns<Derived>,
}

impl<'a> DerivativeRun<'a> {
    /// At the start of a run that ends at `end` and takes samples from its history.
    pub fn new(
        (model, settings): (&'a Model, &'a Settings),
        numbers: Numbers<Derived>,
        end: Derived,
        samples: &[ColumnSample],
    ) -> Self {
        let mut engine = Engine::new(numbers);
        engine.apply_loads();
        let (values, search) = (value_solver(&engine.numbers), LaneNewton::idle(engine.h));
        let (ledger, log) = (LaneLedger::open(&engine), Log::new(&engine));
        let rigid: Vec<usize> = rigid_guides(&engine.numbers).collect();
        let restitution = |k: &usize| engine.numbers.guides[*k].restitution.value;
        let restitutions: Vec<f64> = rigid.iter().map(restitution).collect();
        let progress = RunProgress::new(settings, model.position_scale(), &restitutions);
        engine.press = rigid.first().map(|k| Press::new(&engine.numbers, *k));
        let offset = engine.h.constant(0.0);
        Self {
            model,
            settings,
            end,
            rigid_logs: vec![RigidLog::new(offset); engine.guides.len()],
            engine,
            ledger,
            log,
            search,
            values,
            progress,
            rigid,
            offset,
            misses: Vec::new(),
            columns: KnownColumns::new(samples, model, offset),
        }
    }

    /// The samples with the times to which they belong, if the run has them and their derivatives are known, shape (samples).
    pub fn samples(&self) -> impl Iterator<Item = Option<Found<Derived>>> + '_ {
        self.columns.found()
    }

    /// Runs to the end, or to the horizon of the derivatives.
    ///
    /// # Errors
    /// The horizon of the derivatives, if it is earlier than the end.
    pub fn run(&mut self) -> Result<(), Horizon> {
        let (gaps, negligible) = (self.gaps_and_rates(), self.negligible());
        self.progress.close_at_rest(gaps.into_iter(), negligible);
        self.row();
        while !self.progress.is_over() {
            let (gaps, negligible) = (self.gaps_and_rates(), self.negligible());
            self.progress.begin(gaps.into_iter(), negligible);
            self.advance()?;
        }
        for (k, guide) in self.engine.guides.iter().enumerate() {
            // A projectile that still approaches may touch before the end in a neighbouring run.
            if guide.gap.value > 0.0 && guide.rate.value < 0.0 {
                self.misses.push((k, self.log.time, guide.gap));
            }
        }
        Ok(())
    }

    /// Gaps of the rigid contacts and their rates, shape (rigid contacts, 2) \[m, m/s\].
    fn gaps_and_rates(&self) -> Vec<[f64; 2]> {
        let guides = self.rigid.iter().map(|k| &self.engine.guides[*k]);
        guides.map(|g| [g.gap.value, g.rate.value]).collect()
    }

    /// The same at the start and at the end of the part solved last, shape (rigid contacts).
    fn seen(&self) -> Vec<Seen> {
        let seen = |(contact, (k, start)): (usize, (&usize, [f64; 2]))| {
            let end = self.engine.gap_next(*k).map(|x| x.value);
            Seen { contact, start, end }
        };
        self.rigid.iter().zip(self.gaps_and_rates()).enumerate().map(seen).collect()
    }

    /// Negligible gaps and rates of bodies in contact.
    fn negligible(&self) -> Negligible {
        let energy = self.ledger.sums.energy_scale.value;
        RunScales { energy, ..scales(self.model, self.settings) }.negligible()
    }

    /// Sets the contact that may press in the current part in the engine, if there is one.
    fn set_press(&mut self) -> Result<(), Horizon> {
        let contacts = self.progress.contacts.iter().zip(&self.rigid);
        let mut active = contacts.filter_map(|(c, k)| Some((c.phase?, *k)));
        let (first, second) = (active.next(), active.next());
        if second.is_some() {
            return Err(self.horizon("where several rigid contacts are closed at once".into()));
        }
        let Some(press) = &mut self.engine.press else { return Ok(()) };
        press.which = first.is_some();
        if let Some((phase, k)) = first {
            let (own, rate) =
                (self.engine.numbers.guides[k].restitution, self.engine.guides[k].rate);
            let zero = rate.constant(0.0);
            press.guide = k;
            press.bound = match phase {
                Phase::Impact { restitution, .. } if restitution == own.value => -(own * rate),
                // The opening rate at the start: the gap at the end is then that at the start.
                Phase::Resting { .. } => -rate.max(zero),
                Phase::Impact { .. } | Phase::PlasticPostStep { .. } => zero,
            };
        }
        Ok(())
    }

    /// The projectile that may press in the current part, if there is one \[index of a projectile\].
    fn pressing(&self) -> Option<usize> {
        self.engine.press.as_ref().filter(|press| press.which).map(|press| press.guide)
    }

    /// Size of the current step, and time at its end \[s\]; the last one ends at the end of the run.
    fn step(&self) -> [Derived; 2] {
        let (settings, steps) = (self.settings, self.progress.steps);
        let until = ((steps + 1) as f64 * settings.step).min(settings.end);
        let mut both = [settings.size_behind(steps), until].map(|x| self.end.constant(x));
        if steps + 1 == settings.step_count() {
            both.iter_mut().for_each(|x| x.slope = self.end.slope);
        }
        both
    }

    /// Solves the current part and accepts it.
    fn advance(&mut self) -> Result<(), Horizon> {
        let [target, until] = self.step();
        self.log.begin(&self.engine);
        let mut h;
        loop {
            self.set_press()?;
            h = target.constant(self.progress.h());
            if self.progress.is_whole() {
                h.slope = (target - self.offset).slope;
            }
            self.solve(h)?;
            if self.progress.judge(&self.seen()) {
                break;
            }
        }
        if let Some(k) = self.progress.located {
            h = self.follow_instant(self.rigid[k])?;
        }
        self.check_gain()?;
        let (mut seen, steps) = (self.seen(), self.progress.steps);
        let impulse = |k: &usize| self.engine.guides[*k].impulse.value;
        let impulses: Vec<f64> = self.rigid.iter().map(impulse).collect();
        if self.progress.has_struck(&impulses) {
            self.row();
        }
        let rows = self.progress.rows_with(&impulses);
        self.accept();
        for (seen, gaps) in seen.iter_mut().zip(self.gaps_and_rates()) {
            seen.end = gaps;
        }
        self.progress.accept(&seen, &impulses, self.negligible());
        self.offset += h;
        if self.progress.steps > steps {
            self.offset = self.offset - target;
            self.log.time = until + self.offset;
        }
        (self.offset.value, self.log.time.value) = (self.progress.offset, self.progress.time);
        if self.progress.rows > rows {
            self.row();
        }
        match self.engine.fibres.failing {
            true => Err(self.horizon("where a fibre fails".into())),
            false => Ok(()),
        }
    }

    /// Horizon of the derivatives at the current time.
    fn horizon(&self, why: String) -> Horizon {
        Horizon { time: self.log.time.value, why }
    }

    fn solve(&mut self, h: Derived) -> Result<(), Horizon> {
        self.progress.solver_steps += 1;
        self.engine.h = h;
        self.engine.constraints.impulsive = self.progress.is_impact();
        if !self.values.solve(&mut self.engine, &self.ledger) {
            return Err(self.horizon("where the step has to be cut".into()));
        }
        self.engine.follow();
        let effort = self.values.effort().map(|count| h.constant(count));
        [self.search.iterations, self.search.factorizations] = effort;
        Ok(())
    }

    /// Horizon if an impulse would increase the energy: Moreau's law replaces the law of the contact there.
    fn check_gain(&self) -> Result<(), Horizon> {
        let Some(k) = self.pressing().filter(|_| self.progress.is_impact()) else { return Ok(()) };
        let state = &self.engine.guides[k];
        let work = (state.impulse * state.gap_change / self.engine.h).value;
        match gives_energy(work, [(state.impulse.value, state.rate.value)]) {
            true => Err(self.horizon("where Newton's law would increase the energy".into())),
            false => Ok(()),
        }
    }

    /// Moves the run to the end of the part solved last, and records its contact.
    fn accept(&mut self) {
        let pressing = self.pressing().map(|k| (k, self.engine.guides[k].rate));
        let (engine, ledger, log) = (&mut self.engine, &mut self.ledger, &mut self.log);
        Accept { engine, ledger, log, sections: None, go: None }.accept();
        if pressing.is_none() {
            self.misses.extend(self.log.passes(&self.engine));
        }
        if let Some((k, before)) = pressing {
            let impulsive = self.engine.h.value < IMPULSIVE * self.settings.step;
            let (part, rests) = (self.engine.part(k, before), !self.progress.is_impact());
            self.rigid_logs[k].take(&part, self.log.time, rests, impulsive);
            self.engine.guides[k].impulse = before.constant(0.0);
        }
        self.log.time += self.engine.h;
        for k in &self.rigid {
            self.rigid_logs[*k].see(self.engine.guides[*k].gap.value, self.log.time.value);
        }
    }

    /// The instant at which a projectile was located, as the size of the part solved last: it moves with the parameters so that the gap half an
    /// impact interval ahead is constant. The part is solved once more with it.
    fn follow_instant(&mut self, k: usize) -> Result<Derived, Horizon> {
        let mut h = self.engine.h;
        h.slope[TOGETHER] = 1.0;
        self.solve(h)?;
        let [gap, rate] = self.engine.gap_next(k);
        let half = 0.5 * IMPACT_INTERVAL * self.settings.step;
        let ahead = if rate.value < 0.0 { gap + rate * half } else { gap }.slope;
        for (own, by) in h.slope.iter_mut().zip(ahead) {
            *own = -by / ahead[TOGETHER];
        }
        h.slope[TOGETHER] = 0.0;
        self.solve(h)?;
        Ok(h)
    }
}
