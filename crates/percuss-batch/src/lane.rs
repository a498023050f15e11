//! A run in a lane: its progress, the record of its rigid contact, and the prediction for the current part.

use super::ledger::LaneLedger;
use super::numbers::Numbers;
use super::rigid_log::{ContactPart, RigidLog};
use super::run_progress::{RunProgress, scales};
use percuss::Model;
use percuss::internals::run::decider::{Negligible, RunScales};
use percuss::internals::run::locate::Seen;
use percuss::internals::scalar::Number;
use percuss::internals::settings::Settings;

/// Accelerations are extrapolated to parts up to so many times as long as the previous one.
const MOST_LONGER: f64 = 2.0;

/// A run of an ensemble.
pub struct LaneRun<'a> {
    /// Index among all requested runs.
    pub index: usize,
    pub model: &'a Model,
    pub settings: &'a Settings,
    pub numbers: Numbers<f64>,
}

/// A run in a lane.
pub struct Lane {
    /// Index among the runs of the same shape.
    pub run: usize,
    pub progress: RunProgress,
    pub rigid: RigidLog<f64>,
    /// Scales of the run, without its energy.
    scales: RunScales,
    /// Size of the part solved last \[s\], and the sign of its accelerations: 1 if it was accepted, -1 if not, 0 if they are unknown.
    last: (f64, f64),
    /// Number of consecutive accepted parts of the same size.
    even: usize,
}

impl Lane {
    /// The start of the run of the given number, with the given rigid projectile.
    pub fn new(number: usize, run: &LaneRun, guide: Option<usize>) -> Self {
        let (settings, model) = (run.settings, run.model);
        let scales = scales(model, settings);
        let restitution = guide.map(|k| run.numbers.guides[k].restitution);
        Self {
            run: number,
            progress: RunProgress::new(settings, scales.positions, restitution.as_slice()),
            rigid: RigidLog::new(0.0),
            scales,
            last: (settings.step, 0.0),
            even: 0,
        }
    }

    /// Negligible approach velocity and gap of the run, in the lane of the given number, as in a single run.
    #[inline(always)]
    pub fn nothing<S: Number>(&self, ledger: &LaneLedger<S>, lane: usize) -> Negligible {
        RunScales { energy: ledger.sums.energy_scale.lane(lane), ..self.scales }.negligible()
    }

    /// Whether the part solved last is accepted, from gap and rate of the rigid contact.
    pub fn judge(&mut self, seen: &[Seen], failed: bool) -> bool {
        self.progress.solver_steps += 1;
        let even = self.last == (self.progress.h(), 1.0);
        self.even = if even { self.even + 1 } else { 0 };
        self.last = (self.progress.h(), 1.0);
        let goes = !failed && self.progress.judge(seen);
        if !goes {
            self.last.1 = -1.0;
        } else if self.progress.is_impact() {
            self.last.1 = 0.0;
        }
        goes
    }

    /// Violation of the impulse's conditions relative to the fastest approach of the run so far, whose round-off limits the accuracy of slow impacts.
    pub fn weigh(&mut self, part: &ContactPart<f64>, opening: f64, bound: f64) {
        let mobility = 2.0 * opening / (part.h * part.h);
        let miss = part.after - bound;
        let miss = if part.impulse > 0.0 { miss.abs() } else { (-miss).max(0.0) };
        let free = part.after - mobility * part.impulse;
        let fastest = self.progress.contacts[0].approach_max;
        let scale = free.abs().max(bound.abs()).max(fastest);
        if scale > 0.0 {
            self.rigid.residual = self.rigid.residual.max(miss / scale);
        }
    }

    /// Accelerations of the current part relative to those of the previous part, times the ratio of the squared sizes.
    pub fn ahead(&self) -> f64 {
        let longer = self.progress.h() / self.last.0;
        let unknown = self.last.1 == 0.0 || self.progress.is_impact() || longer > MOST_LONGER;
        if unknown { 0.0 } else { self.last.1 * longer * longer }
    }

    /// Share of the last change of accelerations that is extrapolated: all of it after parts of the same size.
    pub fn trusted(&self) -> f64 {
        f64::from(u8::from(self.even > 0 && self.last == (self.progress.h(), 1.0)))
    }

    /// Whether the contact may press in the current part, and the least rate of its gap for the present rate `rate` \[m/s\].
    pub fn bound(&self, rate: f64) -> Option<f64> {
        self.progress.contacts[0].phase.map(|phase| phase.least_rate(rate))
    }
}
