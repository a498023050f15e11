//! Status of rigid contacts (touching, resting, about to close) within a step, for decisions.

use super::decider::{IMPACT_INTERVAL, Moment, Negligible, RigidPair, RunScales};
use super::locate::Seen;
use super::solver::Solving;
use crate::model::{RigidLaw, TouchLaw};
use crate::step::contacts::ActiveContact;

impl Solving<'_> {
    /// Status of the run, `cut` before the next instant at which a part has to end \[s\].
    pub(super) fn moment(&self, cut: f64) -> Moment {
        let status = |i: usize| {
            let (pair, law) = (&self.state.pairs[i], self.rigid_law(i)?);
            let restitution = [law.restitution, law.tangential_restitution];
            let (gap, rate, closed) = (pair.gap, pair.rate, pair.closed);
            let approach_max = pair.approach_max;
            Some(RigidPair { contact: i, gap, rate, closed, approach_max, restitution })
        };
        Moment {
            offset: self.state.offset,
            cut,
            jumps: self.velocities_jump(),
            located: self.state.located,
            contacts: self.search.awake().iter().filter_map(|i| status(*i)).collect(),
            nothing: self.nothing(),
        }
    }

    /// Negligible gaps and rates of bodies in contact.
    pub(super) fn nothing(&self) -> Negligible {
        let scales = RunScales {
            step: self.settings.step,
            positions: self.positions,
            gravity: self.model.gravity(),
            energy: self.state.ledger.energy_scale,
            mass: self.model.total_mass,
        };
        scales.negligible()
    }

    /// Open rigid pairs that could touch within the step solved last.
    pub(super) fn open_contacts(&self) -> Vec<usize> {
        let open = |i: &usize| self.rigid_law(*i).is_some() && !self.state.pairs[*i].closed;
        self.encounters.reached.iter().copied().filter(open).collect()
    }

    /// The gap of pair `i` over the step of size `h` solved last.
    pub(super) fn seen_over(&self, h: f64, i: usize) -> Seen {
        let pair = self.seen(i);
        Seen { contact: i, start: [pair.gap, pair.rate], end: self.gap_next(h, i) }
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

    /// Rigid pairs that are close enough to matter in the current state.
    pub(super) fn rigid(&self) -> Vec<usize> {
        let awake = self.search.awake().iter().copied();
        awake.filter(|i| self.rigid_law(*i).is_some()).collect()
    }

    /// Rigid pairs with a negligible gap and approach velocity: they count as closed.
    pub(super) fn at_rest(&self) -> Vec<usize> {
        let rigid = self.rigid();
        if rigid.is_empty() {
            return rigid;
        }
        let nothing = self.nothing();
        let rests = |i: &usize| {
            let pair = &self.state.pairs[*i];
            nothing.is_at_rest(pair.gap, pair.rate)
        };
        rigid.into_iter().filter(rests).collect()
    }

    /// Approach velocities of pair `i` up to this one do not bounce \[m/s\].
    pub(super) fn stick_velocity(&self, i: usize) -> f64 {
        self.nothing().stick_velocity(self.state.pairs[i].approach_max)
    }

    /// Contacts that remain closed.
    pub(super) fn resting(&self) -> Vec<ActiveContact> {
        let closed = self.rigid().into_iter().filter(|i| self.state.pairs[*i].closed);
        closed.map(ActiveContact::resting).collect()
    }
}
