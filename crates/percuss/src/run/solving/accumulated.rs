//! Impacts that accumulate: what is left of a step in which more have happened than are followed one by one.
//!
//! No instant of contact is located any more. What would end inside something is held over the rest of the step by forces that
//! push and bring its gap to zero at the end. They give no energy, for the gap closes against them; but a mean rate is all that
//! they can prescribe, and what covers half of its way to a wall ends with its velocity turned round. So an impact interval follows, in which
//! each contact may take back what its force gave, until both together are the impulses of a plastic impact. It chooses them by
//! the least energy, and not to act at all is among what it chooses from: it gives none either. Friction that has to shrink with
//! the impulse along the normal may give back some of what it took over the step, but not more; else it is left as it was.

use super::budget::Part;
use super::solve::Attempt;
use super::solver::Solving;
use super::trial::{PartKind, Trial};
use crate::step::contacts::{ActiveContact, ImpulseLaw, Phase};
use crate::step::newton::Failure;

impl Solving<'_> {
    /// A part, of its whole size, in which no rigid contact ends inside another: those that would are held.
    pub fn hold(&mut self, part: &Part) -> Result<Trial, Failure> {
        let h = part.size;
        let mut active = self.resting();
        let closes = |i: &usize| {
            let pair = &self.state.pairs[*i];
            !pair.closed && pair.gap + h * pair.rate < 0.0
        };
        active.extend(self.rigid().into_iter().filter(closes).map(ActiveContact::resting));
        loop {
            self.solve_resting(&Attempt::free(h), &mut active)?;
            let mut others = self.open_contacts();
            others.retain(|i| active.iter().all(|contact| contact.pair != *i));
            let depth = -self.gap_resolution();
            let gap = |i: &usize| self.gap_next(h, *i)[0];
            if others.iter().all(|i| gap(i) >= depth) {
                return match self.first_passage(&others) {
                    Some(_) => Err(Failure::Passed),
                    None => Ok(Trial { h, active, fallback_law: false, kind: PartKind::Held }),
                };
            }
            // Those that are inside by less than gaps can tell come along: which is deeper is round-off.
            let inside: Vec<usize> = others.iter().filter(|i| gap(i) < 0.0).copied().collect();
            active.extend(inside.into_iter().map(ActiveContact::resting));
        }
    }

    /// The impact interval after a part in which contacts were held, in the room of that; none if they are at rest already, or if no impulses bring them
    /// to rest: then they stay as they are.
    pub fn plastic_post_step(&mut self, held: &Trial) -> Option<Trial> {
        let settles = |contact: &ActiveContact, impulse: [f64; 2]| {
            let phase = Phase::PlasticPostStep { carried: impulse };
            (impulse[0] > 0.0).then_some(ActiveContact { phase, ..*contact })
        };
        let found = held.active.iter().zip(&self.work.rigid);
        let active: Vec<_> = found.filter_map(|(c, found)| settles(c, found.impulse)).collect();
        let rests =
            |c: &ActiveContact| self.state.pairs[c.pair].rate.abs() <= self.stick_velocity(c.pair);
        if active.iter().all(rests) {
            return None;
        }
        let (h, before) = (self.impact_interval(), self.work_of_impulses(held.h));
        let settled = [ImpulseLaw::Newton, ImpulseLaw::Mean].into_iter().any(|law| {
            let solved = self.solve(&Attempt::impact(h, law), &active);
            solved.is_ok() && !self.impulses_give(h, before)
        });
        let trial = Trial { h, active, fallback_law: false, kind: PartKind::PlasticPostStep };
        settled.then_some(trial)
    }
}
