//! Which rigid contacts touch, rest or could close, and what a part of a step is therefore solved as.

use super::solver::Solving;
use crate::model::{RigidLaw, TouchLaw};
use crate::settings::{ImpactResolution, MultipleImpacts};
use crate::step::contacts::{ActiveContact, GAP_RESOLUTION};

/// Length of an impact interval as a share of the step.
pub const IMPACT_INTERVAL: f64 = 1e-6;
/// Approach slower than this share of the fastest one so far does not bounce: accumulating impacts end.
pub const STICK: f64 = 1e-6;
/// Nor does approach slower than this share of the velocity scale, which is round-off.
pub const NO_APPROACH: f64 = 1e-12;
/// Nor does approach slower than this share of what gravity gives in a step: piles at rest would rattle over gaps of a picometre.
pub const CREEP: f64 = 1e-5;

/// What a part of a step is solved as.
#[derive(Clone, Debug)]
pub enum Resolution {
    /// Prescribed velocities jump.
    Jump,
    /// Nothing touches: up to the first contact, or its whole size.
    Free,
    /// These pairs touch, shape (pairs) \[index of a pair\]; all strike at once.
    Impact(Vec<usize>),
    /// These pairs touch, shape (pairs) \[index of a pair\]; they strike one after another.
    Sequence(Vec<usize>),
    /// Too many impacts have happened in the step for them to be followed one by one.
    Accumulated,
    /// As in the paper, gaps are looked at once.
    TimeStepping {
        /// Those below this one are closed \[m\].
        closed: f64,
    },
}

impl Solving<'_> {
    /// What the next part of a step, which may still have so many events, is solved as where the state stands.
    pub fn resolution(&self, events_left: usize) -> Resolution {
        if self.velocities_jump() {
            return Resolution::Jump;
        }
        if let ImpactResolution::TimeStepping { closed_tolerance: closed } = self.settings.impacts {
            return Resolution::TimeStepping { closed };
        }
        if events_left == 0 {
            return Resolution::Accumulated;
        }
        let touching = self.touching();
        match self.settings.multiple_impacts {
            _ if touching.is_empty() => Resolution::Free,
            MultipleImpacts::Sequential => Resolution::Sequence(touching),
            _ => Resolution::Impact(touching),
        }
    }

    /// Law of pair `i`, if it is a rigid one.
    pub(super) fn rigid_law(&self, i: usize) -> Option<RigidLaw> {
        match &self.model.contacts[self.model.pairs[i].contact].law {
            TouchLaw::Rigid(law) => Some(*law),
            TouchLaw::Smooth(_) => None,
        }
    }

    /// Length of an impact interval \[s\].
    pub(super) fn impact_interval(&self) -> f64 {
        IMPACT_INTERVAL * self.settings.step
    }

    /// Rigid pairs near enough to matter where the state stands.
    pub(super) fn rigid(&self) -> Vec<usize> {
        let awake = self.search.awake().iter().copied();
        awake.filter(|i| self.rigid_law(*i).is_some()).collect()
    }

    /// Rigid pairs that touch, at rest but for what is no approach: they count as closed.
    pub(super) fn at_rest(&self) -> Vec<usize> {
        let rigid = self.rigid();
        if rigid.is_empty() {
            return rigid;
        }
        let (slow, reach) = (self.no_approach(), self.no_gap());
        let rests = |i: &usize| {
            let pair = &self.state.pairs[*i];
            pair.gap <= reach && pair.rate.abs() <= slow
        };
        rigid.into_iter().filter(rests).collect()
    }

    /// Open contacts that would close within the next three quarters of an impact interval; and the one just located, with all others
    /// that are no farther as gaps can tell, or close within an interval of its instant: which of these is first follows from round-off, and
    /// impulses last as long, so they close together.
    fn touching(&self) -> Vec<usize> {
        let (interval, resolution) = (self.impact_interval(), self.gap_resolution());
        let near = |i: &usize| {
            let pair = &self.state.pairs[*i];
            let way = |intervals: f64| -intervals * interval * pair.rate;
            // The instant located is the middle of the interval to come.
            let close = match self.state.located {
                Some(located) => {
                    let nearest = self.state.pairs[located].gap;
                    located == *i || pair.gap < way(1.5).max(nearest + resolution)
                }
                None => pair.gap < way(0.75),
            };
            !pair.closed && pair.rate < 0.0 && close
        };
        self.rigid().into_iter().filter(near).collect()
    }

    /// Approach velocities of pair `i` up to this one do not bounce \[m/s\].
    pub(super) fn stick_velocity(&self, i: usize) -> f64 {
        (STICK * self.state.pairs[i].approach_max).max(self.no_approach())
    }

    /// Velocities up to this one are none between things that touch \[m/s\].
    pub(super) fn no_approach(&self) -> f64 {
        let creep = CREEP * self.model.gravity() * self.settings.step;
        creep.max(NO_APPROACH * self.velocity_scale())
    }

    /// Gaps up to this one are none between things that do not approach \[m\].
    pub(super) fn no_gap(&self) -> f64 {
        self.gap_resolution().max(self.no_approach() * self.settings.step)
    }

    /// Gaps that differ by no more than this one are equal \[m\].
    pub(super) fn gap_resolution(&self) -> f64 {
        GAP_RESOLUTION * self.positions
    }

    /// Velocity that goes with the largest energy of the run so far \[m/s\].
    fn velocity_scale(&self) -> f64 {
        (2.0 * self.state.ledger.energy_scale / self.model.total_mass).sqrt()
    }

    /// Contacts that stay closed.
    pub(super) fn resting(&self) -> Vec<ActiveContact> {
        let closed = self.rigid().into_iter().filter(|i| self.state.pairs[*i].closed);
        closed.map(ActiveContact::resting).collect()
    }
}
