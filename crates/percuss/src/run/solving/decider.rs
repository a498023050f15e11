//! Parts of steps, and the next one to solve: a state machine without physics.
//!
//! Single runs, runs in lanes and runs with derivatives use it. Its input is the status of the rigid contacts of a run, and their gaps over the
//! solved part; its output is the next part to solve, its acceptance, and the end of the step.

use super::locate::{FirstContact, Seen, Tolerances, Verdict};
use crate::settings::{ImpactResolution, MultipleImpacts, SAME_INSTANT, Settings};
use crate::step::contacts::{ActiveContact, GAP_RESOLUTION, Phase};

/// Length of an impact interval as a share of the step.
pub const IMPACT_INTERVAL: f64 = 1e-6;
/// Contacts with an approach slower than this share of the fastest one so far do not rebound: accumulating impacts end.
pub const STICK: f64 = 1e-6;
/// Neither do those slower than this share of the velocity scale, which is round-off.
const NO_APPROACH: f64 = 1e-12;
/// Neither do those slower than this share of the velocity by gravity in a step: resting piles would rattle over gaps of a picometre.
const CREEP: f64 = 1e-5;
/// Limit of located instants and impacts in one step, after which they count as accumulated: touching contacts stay closed for the rest of it.
const MOST_EVENTS: usize = 128;
/// A step is cut down to this share of its size before the run ends without convergence.
const SMALLEST_SHARE: f64 = 1e-4;

/// Kind of a part of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resolution {
    /// Prescribed velocities jump.
    Jump,
    /// No impact: up to the first contact, or its whole size.
    Free,
    /// Simultaneous impact of all touching contacts.
    Impact,
    /// They strike one after another.
    Sequence,
    /// The Zeno limit of the step is reached: closing contacts are held.
    Accumulated,
    /// As in the paper, gaps are evaluated once, and impulses act over the whole step.
    TimeStepping,
}

/// A part of a step that is to be solved.
#[derive(Clone, Debug)]
pub struct Part {
    /// Kind.
    pub resolution: Resolution,
    /// Its size at most \[s\].
    pub size: f64,
    /// Length of an impact interval in it \[s\]; where failures have cut the step, these are cut likewise.
    pub interval: f64,
    /// Active contacts: those that rest or are held, then those in impact, shape (such contacts).
    pub active: Vec<ActiveContact>,
}

/// A rigid pair in the current state of a run.
#[derive(Clone, Copy, Debug)]
pub struct RigidPair {
    /// The contact.
    pub contact: usize,
    /// Gap \[m\].
    pub gap: f64,
    /// Its rate \[m/s\].
    pub rate: f64,
    /// Whether it remains closed under contact force.
    pub closed: bool,
    /// Fastest approach so far \[m/s\].
    pub approach_max: f64,
    /// Coefficients along normal and tangent, shape (2) \[-\].
    pub restitution: [f64; 2],
}

/// Status of a run within a step.
#[derive(Clone, Debug)]
pub struct Moment {
    /// Completed share of the step \[s\].
    pub offset: f64,
    /// Time to the next instant at which a part has to end \[s\].
    pub cut: f64,
    /// Whether prescribed velocities jump here.
    pub jumps: bool,
    /// The contact that was located here.
    pub located: Option<usize>,
    /// Rigid contacts that are close enough to matter, shape (such contacts).
    pub contacts: Vec<RigidPair>,
    /// Negligible gaps and rates there.
    pub nothing: Negligible,
}

/// Negligible gaps and rates of bodies in contact.
#[derive(Clone, Copy, Debug, Default)]
pub struct Negligible {
    /// Velocities up to this one are none \[m/s\].
    pub rate: f64,
    /// Gaps up to this one are zero between bodies that do not approach \[m\].
    pub gap: f64,
    /// Gaps that differ by no more than this one are equal \[m\].
    pub gap_difference: f64,
}

/// Scales of a run.
#[derive(Clone, Copy, Debug)]
pub struct RunScales {
    /// Size of a step \[s\].
    pub step: f64,
    /// Scale of positions \[m\].
    pub positions: f64,
    /// Magnitude of the acceleration of gravity \[m/s^2\].
    pub gravity: f64,
    /// Largest energy of the run so far \[J\].
    pub energy: f64,
    /// Total mass \[kg\].
    pub mass: f64,
}

impl RunScales {
    /// Negligible gaps and rates in a run of these scales.
    pub fn negligible(&self) -> Negligible {
        let creep = CREEP * self.gravity * self.step;
        let rate = creep.max(NO_APPROACH * (2.0 * self.energy / self.mass).sqrt());
        let gap_difference = GAP_RESOLUTION * self.positions;
        Negligible { rate, gap: gap_difference.max(rate * self.step), gap_difference }
    }
}

impl Negligible {
    /// Contacts with an approach up to this one do not rebound if the fastest one so far was `approach_max` \[m/s\].
    pub fn stick_velocity(&self, approach_max: f64) -> f64 {
        (STICK * approach_max).max(self.rate)
    }

    /// Whether a contact with this gap and rate touches and is at rest: then it counts as closed.
    pub fn is_at_rest(&self, gap: f64, rate: f64) -> bool {
        gap <= self.gap && rate.abs() <= self.rate
    }
}

impl RigidPair {
    /// It strikes, without restitution where it approaches too slowly to bounce.
    fn striking(&self, nothing: &Negligible) -> ActiveContact {
        let sticks = -self.rate <= nothing.stick_velocity(self.approach_max);
        let [restitution, tangential] = if sticks { [0.0; 2] } else { self.restitution };
        ActiveContact { pair: self.contact, phase: Phase::Impact { restitution, tangential } }
    }
}

/// The decisions of one step.
#[derive(Clone, Debug)]
pub struct Decider {
    /// Size of steps, and time of the end \[s\].
    step: f64,
    end: f64,
    impacts: ImpactResolution,
    sequential: bool,
    /// Scale of positions \[m\].
    positions: f64,
    /// Size of this step: the given one, or the remaining time of the run \[s\].
    target: f64,
    /// Size of its next part at most \[s\].
    size: f64,
    /// Instants located and impacts that it may still have.
    events_left: usize,
    /// The current part.
    pub part: Part,
    nothing: Negligible,
    search: FirstContact,
}

impl Decider {
    /// The start of a step of the given size, with the scale of positions.
    pub fn new(settings: &Settings, positions: f64, target: f64) -> Self {
        let part =
            Part { resolution: Resolution::Free, size: 0.0, interval: 0.0, active: Vec::new() };
        Self {
            step: settings.step,
            end: settings.end,
            impacts: settings.impacts,
            sequential: settings.multiple_impacts == MultipleImpacts::Sequential,
            positions,
            target,
            size: target,
            events_left: MOST_EVENTS,
            part,
            nothing: Negligible::default(),
            search: FirstContact::default(),
        }
    }

    /// The same after the Zeno limit.
    pub fn exhausted(self) -> Self {
        Self { events_left: 0, ..self }
    }

    /// Continues with a step of the given size.
    pub fn open(&mut self, target: f64) {
        (self.target, self.size, self.events_left) = (target, target, MOST_EVENTS);
    }

    /// Whether a part of the step remains, `offset` of it completed.
    pub fn remains(&self, offset: f64) -> bool {
        offset < self.target * (1.0 - SAME_INSTANT)
    }

    /// Whether impacts accumulate: the step has reached the Zeno limit.
    pub fn accumulates(&self) -> bool {
        self.events_left == 0
    }

    /// Size of the step \[s\].
    pub fn target(&self) -> f64 {
        self.target
    }

    /// Size of the next solution: of the part, of a trial of it, or an impact interval \[s\].
    pub fn h(&self) -> f64 {
        match self.part.resolution {
            Resolution::Free => self.search.h,
            Resolution::Accumulated | Resolution::TimeStepping => self.part.size,
            Resolution::Jump | Resolution::Impact | Resolution::Sequence => self.part.interval,
        }
    }

    /// Whether the last solution updates the open contacts under observation: not during the location of one of them.
    pub fn updates_open_contacts(&self) -> bool {
        self.part.resolution != Resolution::Free || self.search.is_whole()
    }

    /// Whether the step continues after the current state; then its next part is set.
    pub fn goes_on(&mut self, at: &Moment) -> bool {
        if !self.remains(at.offset) {
            return false;
        }
        self.nothing = at.nothing;
        let part = &mut self.part;
        part.size = self.size.min(self.target - at.offset).min(at.cut);
        part.interval = IMPACT_INTERVAL * self.step * (self.size / self.target);
        let resting = at.contacts.iter().filter(|c| c.closed);
        part.active.clear();
        part.active.extend(resting.map(|c| ActiveContact::resting(c.contact)));
        let resolution = match self.impacts {
            _ if at.jumps => Resolution::Jump,
            ImpactResolution::TimeStepping { closed_tolerance } => {
                self.close_in_time_step(at, closed_tolerance);
                Resolution::TimeStepping
            }
            ImpactResolution::Event if self.events_left == 0 => {
                self.hold_closing(at);
                Resolution::Accumulated
            }
            ImpactResolution::Event => self.strike_touching(at),
        };
        self.part.resolution = resolution;
        let Self { step, positions, .. } = *self;
        let tolerances =
            Tolerances { interval: IMPACT_INTERVAL * step, positions, no_gap: at.nothing.gap };
        self.search.begin(self.part.size, tolerances);
        true
    }

    /// Open contacts that would close within the next three quarters of an impact interval are in the impact; and the one just located, with all
    /// others whose gaps are equal within their accuracy, or that close within an interval of its instant: their order follows from round-off, and
    /// impulses last as long, so they close together.
    fn strike_touching(&mut self, at: &Moment) -> Resolution {
        let interval = IMPACT_INTERVAL * self.step;
        let located = at.located.and_then(|k| at.contacts.iter().find(|c| c.contact == k));
        let touches = |c: &&RigidPair| {
            let way = |intervals: f64| -intervals * interval * c.rate;
            // The located instant is the middle of the next interval.
            let close = match located {
                Some(one) => {
                    let farthest = one.gap + at.nothing.gap_difference;
                    one.contact == c.contact || c.gap < way(1.5).max(farthest)
                }
                None => c.gap < way(0.75),
            };
            !c.closed && c.rate < 0.0 && close
        };
        let resting = self.part.active.len();
        let touching = at.contacts.iter().filter(touches);
        self.part.active.extend(touching.map(|c| c.striking(&at.nothing)));
        match self.sequential {
            _ if self.part.active.len() == resting => Resolution::Free,
            true => Resolution::Sequence,
            false => Resolution::Impact,
        }
    }

    /// Contacts are held over the part in which they would close.
    fn hold_closing(&mut self, at: &Moment) {
        let closes = |c: &&RigidPair| !c.closed && c.gap + self.part.size * c.rate < 0.0;
        let held = at.contacts.iter().filter(closes);
        self.part.active.extend(held.map(|c| ActiveContact::resting(c.contact)));
    }

    /// In the paper's steps contacts that are closed, by this gap, are in the impact. A separating contact is not: an impulse would create energy.
    fn close_in_time_step(&mut self, at: &Moment, closed: f64) {
        let strikes =
            |c: &&RigidPair| c.gap <= closed && c.rate <= at.nothing.stick_velocity(c.approach_max);
        self.part.active.clear();
        self.part.active.extend(at.contacts.iter().filter(strikes).map(|c| {
            let [restitution, tangential] = c.restitution;
            ActiveContact { pair: c.contact, phase: Phase::Impact { restitution, tangential } }
        }));
    }

    /// Verdict on the contacts that could close, from the last solution; `passed` is the share of it at which the first of the given ones has
    /// passed through a body. More contacts may have become active.
    pub fn judge(
        &mut self,
        seen: &[Seen],
        passed: impl FnOnce(&[usize]) -> Option<f64>,
    ) -> Verdict {
        let active = &mut self.part.active;
        let is_open = |s: &&Seen| active.iter().all(|c| c.pair != s.contact);
        let open: Vec<Seen> = seen.iter().filter(is_open).copied().collect();
        let contacts = |open: &[Seen]| -> Vec<usize> { open.iter().map(|s| s.contact).collect() };
        match self.part.resolution {
            Resolution::Free => self.search.judge(&open, || passed(&contacts(&open))),
            Resolution::Accumulated => {
                let depth = -self.nothing.gap_difference;
                if open.iter().all(|s| s.end[0] >= depth) {
                    let passed = passed(&contacts(&open)).is_some();
                    return if passed { Verdict::Passed } else { Verdict::Ends { located: None } };
                }
                // Contacts with a penetration within the accuracy of gaps are included: which is deeper is round-off.
                let inside = open.iter().filter(|s| s.end[0] < 0.0);
                active.extend(inside.map(|s| ActiveContact::resting(s.contact)));
                Verdict::Again
            }
            _ => Verdict::Ends { located: None },
        }
    }

    /// Subtracts an accepted part; after one of its whole size the next may be larger again. A part that ends at an instant of contact, or is an
    /// impact (an event), contains no information on the size that failed before.
    pub fn spend(&mut self, event: bool) {
        if event {
            self.events_left = self.events_left.saturating_sub(1);
        } else {
            self.size = (2.0 * self.size).min(self.target);
        }
    }

    /// Cuts the current part, which has failed, in half; returns whether further cuts are allowed.
    pub fn halve(&mut self) -> bool {
        self.size = 0.5 * self.part.size;
        self.size >= SMALLEST_SHARE * self.step
    }

    /// Ends the step so long after its beginning at the latest.
    pub fn end_at(&mut self, target: f64) {
        if target < self.target {
            self.target = target;
            self.size = self.size.min(target);
        }
    }

    /// Ends the step, the run's `steps`-th, at `time`, `offset` of it completed: both for the start of the next one. Its end is on the grid of
    /// steps, or after an impact that exceeded it.
    pub fn close(&self, steps: usize, time: f64, offset: f64) -> (f64, f64) {
        let offset = offset - self.target;
        let offset = if offset.abs() <= SAME_INSTANT * self.step { 0.0 } else { offset };
        // Never backwards, not even by the last bit, after an impact at the end of the step.
        let grid = (steps as f64 * self.step).min(self.end) + offset;
        (if offset > 0.0 { grid.max(time) } else { grid }, offset)
    }
}

#[cfg(test)]
mod tests;
