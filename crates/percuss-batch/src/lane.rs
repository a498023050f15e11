//! A run in a lane: where it stands, what its rigid contact did, and what it expects of the part at hand.

use super::ledger::LaneLedger;
use super::numbers::Numbers;
use super::rigid_log::{ContactPart, RigidLog};
use super::run_progress::{RunProgress, scales};
use percuss::Model;
use percuss::internals::run::decider::{Negligible, RunScales};
use percuss::internals::run::locate::Seen;
use percuss::internals::scalar::Number;
use percuss::internals::settings::Settings;

/// Accelerations are foreseen in parts up to so many times as long as the one before.
const MOST_LONGER: f64 = 2.0;

/// A run of an ensemble.
pub struct LaneRun<'a> {
    /// Its place among all runs asked for.
    pub index: usize,
    pub model: &'a Model,
    pub settings: &'a Settings,
    pub numbers: Numbers<f64>,
}

/// A run in a lane.
pub struct Lane {
    /// Its number among the runs.
    pub run: usize,
    pub progress: RunProgress,
    pub rigid: RigidLog<f64>,
    /// What the run is measured by, its energy apart.
    scales: RunScales,
    /// Size of the part solved last \[s\], and what it says of accelerations: 1 if it was accepted, -1 if not, 0 if it says nothing.
    last: (f64, f64),
    /// Parts of the same size accepted one after another.
    even: usize,
}

impl Lane {
    /// At the start of a run of the given number, whose rigid projectile is the one given.
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

    /// What is no approach and no gap in the run, which is in the lane of the given number, as of a single run.
    #[inline(always)]
    pub fn nothing<S: Number>(&self, ledger: &LaneLedger<S>, lane: usize) -> Negligible {
        RunScales { energy: ledger.sums.energy_scale.lane(lane), ..self.scales }.negligible()
    }

    /// Whether the part solved last is accepted, by what is seen of the rigid contact.
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

    /// How well the impulse meets its conditions, beside the fastest approach of the run so far: slow ones are known to its round-off.
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

    /// Share of the accelerations of the part before that those of the one at hand are taken for, by the square of the sizes.
    pub fn ahead(&self) -> f64 {
        let longer = self.progress.h() / self.last.0;
        let unknown = self.last.1 == 0.0 || self.progress.is_impact() || longer > MOST_LONGER;
        if unknown { 0.0 } else { self.last.1 * longer * longer }
    }

    /// Share of the last change of accelerations that is expected again: all of it behind parts of the same size.
    pub fn trusted(&self) -> f64 {
        f64::from(u8::from(self.even > 0 && self.last == (self.progress.h(), 1.0)))
    }

    /// Whether the contact may press in the part at hand, and the least rate of its gap if it has this one \[m/s\].
    pub fn bound(&self, rate: f64) -> Option<f64> {
        self.progress.contacts[0].phase.map(|phase| phase.least_rate(rate))
    }
}
