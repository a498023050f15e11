//! Jumps of prescribed velocities.
//!
//! If the rate of a motion jumps, its fixed components receive an impulse, and the rest of the structure the consistent one. Steps are cut there as
//! at the release of a support, and the jump is made in an impact interval, a very short step of its own, whose impulses are separated from forces
//! like those of impacts.

use super::decider::{IMPACT_INTERVAL, Part};
use super::solve::Attempt;
use super::solver::{Solver, Solving};
use super::trial::{PartKind, Trial};
use crate::model::{Model, PreparedFunction};
use crate::settings::SAME_INSTANT;
use crate::step::forcing::WIDTH;
use crate::step::newton::Failure;

/// Jumps below this share of the rates are none.
const NO_JUMP: f64 = 1e-9;

/// Times at which steps are cut, increasing: releases of supports, or jumps of prescribed rates at the end of the impact interval that begins there
/// \[s\].
pub fn cuts(model: &Model, step: f64) -> Vec<f64> {
    let mut times: Vec<f64> = model.releases().collect();
    for drive in model.structural_drives() {
        let jumps = drive.iter().flat_map(|(motion, _)| model.motions[*motion].rate_jumps(step));
        times.extend(jumps.map(|t| t - IMPACT_INTERVAL * step).filter(|t| *t > 0.0));
    }
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// Rate of a time function right after a time.
pub fn rate_after(function: &PreparedFunction, time: f64, step: f64) -> f64 {
    function.rate_on(time, time + 2.0 * SAME_INSTANT * step, WIDTH * step)
}

impl Solver {
    /// Time to the next cut that is not the end of a part that ends at `time`, of a step of the given size \[s\].
    pub fn time_to_cut(&self, time: f64, step: f64) -> f64 {
        let next = self.cuts.partition_point(|t| t - time <= SAME_INSTANT * step);
        self.cuts.get(next).map_or(f64::INFINITY, |t| t - time)
    }
}

impl Solving<'_> {
    /// Whether the rate of a motion jumps at this instant.
    pub(super) fn velocities_jump(&self) -> bool {
        if self.work.lead.is_empty() {
            return false;
        }
        let (time, slack) = (self.state.time, SAME_INSTANT * self.settings.step);
        let known = self.cuts.partition_point(|t| *t < time - slack);
        let cut = self.cuts.get(known).is_some_and(|t| *t <= time + slack);
        let begins = self.state.step == 0 && self.state.offset == 0.0;
        (cut || begins) && self.rates_jump()
    }

    fn rates_jump(&self) -> bool {
        let (time, step) = (self.state.time, self.settings.step);
        let motions = self.model.motions.iter().zip(&self.state.followed);
        motions.filter(|(_, followed)| followed.held).any(|(function, followed)| {
            // A run begins with the jump, any other impact interval ends with it.
            let jump = if time > 0.0 { time + self.impact_interval() } else { time };
            let rate = rate_after(function, jump, step);
            (rate - followed.rate).abs() > NO_JUMP * rate.abs().max(followed.rate.abs())
        })
    }

    /// The impact interval in which prescribed velocities jump; resting contacts stay closed.
    pub fn jump(&mut self, part: &Part) -> Result<Trial, Failure> {
        let (h, mut active) = (part.interval, part.active.clone());
        self.solve_resting(&Attempt { jumps: true, ..Attempt::free(h) }, &mut active)?;
        Ok(Trial { h, active, fallback_law: false, kind: PartKind::Jump })
    }
}
