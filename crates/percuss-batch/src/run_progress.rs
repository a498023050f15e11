//! Progress of a run by parts of steps, as in a single run: its time, and its rigid contacts.
//!
//! The [`Decider`] sets the parts. For the solver every part is a step of some size with some contacts that press; each run decides separately
//! whether a part is accepted and which part follows.

use percuss::Model;
use percuss::internals::run::decider::{
    Decider, Moment, Negligible, Resolution, RigidPair, RunScales,
};
use percuss::internals::run::locate::{Seen, Verdict};
use percuss::internals::settings::Settings;
use percuss::internals::step::contacts::Phase;

/// Scales of a run, without its energy.
pub fn scales(model: &Model, settings: &Settings) -> RunScales {
    RunScales {
        step: settings.step,
        positions: model.position_scale(),
        gravity: model.gravity(),
        energy: 0.0,
        mass: model.total_mass,
    }
}

/// A rigid contact of a run.
#[derive(Clone, Copy, Debug)]
pub struct Touching {
    restitution: f64,
    pub closed: bool,
    /// Fastest approach so far \[m/s\].
    pub approach_max: f64,
    /// Its phase in the current part; `None` for an open contact.
    pub phase: Option<Phase>,
}

impl Touching {
    /// Whether the contact rests in the current part.
    pub fn rests(&self) -> bool {
        matches!(self.phase, Some(Phase::Resting { .. }))
    }

    /// Whether the current part is an impact of this contact.
    pub fn strikes(&self) -> bool {
        matches!(self.phase, Some(Phase::Impact { .. }))
    }
}

/// Progress of a run through its steps.
#[derive(Clone, Debug)]
pub struct RunProgress {
    settings: Settings,
    decider: Decider,
    /// Number of steps of the run, of completed steps, and of completed steps with accumulated impacts.
    count: usize,
    pub steps: usize,
    pub accumulated_steps: usize,
    /// Time at the start of the current part, and completed share of its step \[s\].
    pub time: f64,
    pub offset: f64,
    /// The contact that was located at the end of the previous part, or of the current one \[index of a rigid contact\].
    pub located: Option<usize>,
    /// Rigid contacts, shape (rigid contacts).
    pub contacts: Vec<Touching>,
    /// Number of rows that a recorder would receive, and the time of the last one \[s\].
    pub rows: usize,
    row_time: f64,
    /// Number of solved parts, including trials.
    pub solver_steps: usize,
}

impl RunProgress {
    /// The start of a run whose rigid contacts have the given coefficients of restitution; `positions` is the scale of positions \[m\].
    pub fn new(settings: &Settings, positions: f64, rigid: &[f64]) -> Self {
        let contact = |restitution: &f64| Touching {
            restitution: *restitution,
            closed: false,
            approach_max: 0.0,
            phase: None,
        };
        Self {
            decider: Decider::new(settings, positions, settings.size_behind(0)),
            settings: *settings,
            count: settings.step_count(),
            steps: 0,
            accumulated_steps: 0,
            time: 0.0,
            offset: 0.0,
            located: None,
            contacts: rigid.iter().map(contact).collect(),
            rows: 1,
            row_time: 0.0,
            solver_steps: 0,
        }
    }

    /// Whether the run is complete.
    pub fn is_over(&self) -> bool {
        self.steps == self.count
    }

    /// Whether impacts accumulate now or have accumulated before.
    pub fn has_accumulated(&self) -> bool {
        self.accumulated_steps > 0 || self.decider.accumulates()
    }

    /// Size of the part to be solved \[s\].
    pub fn h(&self) -> f64 {
        self.decider.h()
    }

    /// Whether the part is the whole remainder of the step.
    pub fn is_whole(&self) -> bool {
        !self.is_impact() && self.decider.h() == self.decider.part.size
    }

    /// Whether the current part is an impact interval.
    pub fn is_impact(&self) -> bool {
        matches!(self.decider.part.resolution, Resolution::Impact | Resolution::Sequence)
    }

    /// Begins the next part with the given gaps and their rates, shape (rigid contacts, 2) \[m, m/s\].
    pub fn begin(&mut self, gaps: impl Iterator<Item = [f64; 2]>, negligible: Negligible) {
        let pair = |(contact, (c, [gap, rate])): (usize, (&Touching, [f64; 2]))| {
            let (closed, approach_max) = (c.closed, c.approach_max);
            RigidPair {
                contact,
                gap,
                rate,
                closed,
                approach_max,
                restitution: [c.restitution, 0.0],
            }
        };
        let moment = Moment {
            offset: self.offset,
            cut: f64::INFINITY,
            jumps: false,
            located: self.located.take(),
            contacts: self.contacts.iter().zip(gaps).enumerate().map(pair).collect(),
            nothing: negligible,
        };
        self.decider.goes_on(&moment);
        self.note_phases();
    }

    fn note_phases(&mut self) {
        self.contacts.iter_mut().for_each(|c| c.phase = None);
        for active in &self.decider.part.active {
            self.contacts[active.pair].phase = Some(active.phase);
        }
    }

    /// Whether the part solved last is accepted, given the contacts, shape (rigid contacts); if not, the next trial becomes the current part.
    pub fn judge(&mut self, seen: &[Seen]) -> bool {
        let verdict = self.decider.judge(seen, |_| None);
        self.note_phases();
        if let Verdict::Ends { located } = verdict {
            self.located = located;
        }
        verdict != Verdict::Again
    }

    /// Whether the part solved last is an impact, given the impulses, shape (rigid contacts) \[N s\]: there are rows before and after it.
    pub fn has_struck(&self, impulses: &[f64]) -> bool {
        self.contacts.iter().zip(impulses).any(|(c, i)| c.strikes() && *i > 0.0)
    }

    /// Number of rows with that before an impact in the part solved last, given the impulses, shape (rigid contacts) \[N s\].
    pub fn rows_with(&self, impulses: &[f64]) -> usize {
        self.rows + usize::from(self.has_struck(impulses) && self.time > self.row_time)
    }

    /// Accepts the current part with the given contacts and impulses, shape (rigid contacts).
    pub fn accept(&mut self, seen: &[Seen], impulses: &[f64], negligible: Negligible) {
        let h = self.h();
        self.decider.spend(self.is_impact() || self.located.is_some());
        let strikes = self.has_struck(impulses);
        if strikes {
            self.row();
        }
        let held = self.decider.part.resolution == Resolution::Accumulated;
        for ((contact, seen), impulse) in self.contacts.iter_mut().zip(seen).zip(impulses) {
            let Some(phase) = contact.phase else { continue };
            if held || contact.strikes() {
                contact.approach_max = contact.approach_max.max(-seen.start[1]);
            }
            contact.closed = phase.closes(*impulse);
        }
        self.close_at_rest(seen.iter().map(|s| s.end), negligible);
        self.time += h;
        self.offset += h;
        if strikes {
            self.row();
        }
        self.end_step();
    }

    /// Marks contacts with a negligible gap and rate as closed; gaps and their rates have the shape (rigid contacts, 2) \[m, m/s\].
    pub fn close_at_rest(&mut self, gaps: impl Iterator<Item = [f64; 2]>, negligible: Negligible) {
        for (contact, [gap, rate]) in self.contacts.iter_mut().zip(gaps) {
            contact.closed |= negligible.is_at_rest(gap, rate);
        }
    }

    /// Counts a row, unless this instant has one.
    fn row(&mut self) {
        if self.time > self.row_time {
            self.rows += 1;
            self.row_time = self.time;
        }
    }

    /// Ends the step if no part of it remains.
    #[inline(always)]
    fn end_step(&mut self) {
        if self.decider.remains(self.offset) {
            return;
        }
        self.steps += 1;
        self.accumulated_steps += usize::from(self.decider.accumulates());
        (self.time, self.offset) = self.decider.close(self.steps, self.time, self.offset);
        if self.steps.is_multiple_of(self.settings.record_every) || self.is_over() {
            self.row();
        }
        self.decider.open(self.settings.size_behind(self.steps));
    }
}
