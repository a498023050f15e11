//! Impacts that accumulate: what is left of a step in which more have happened than are followed one by one.
//!
//! No instant of contact is located any more. What would end inside something is held over the rest of the step by forces that
//! push and bring its gap to zero at the end. They give no energy, for the gap closes against them; but a mean rate is all that
//! they can prescribe, and what covers half of its way to a wall ends with its velocity turned round. So an impact interval follows, in which
//! each contact may take back what its force gave, until both together are the impulses of a plastic impact. It chooses them by
//! the least energy, and not to act at all is among what it chooses from: it gives none either. Friction that has to shrink with
//! the impulse along the normal may give back some of what it took over the step, but not more; else it is left as it was.

use super::solve::Attempt;
use super::solver::Solving;
use super::trial::{PartKind, Trial};
use crate::step::contacts::{ActiveContact, ImpulseLaw, Phase};

impl Solving<'_> {
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
