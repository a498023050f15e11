//! Accumulated impacts: the rest of a step that has reached the Zeno limit.
//!
//! Instants of contact are no longer located. Contacts that would overlap at the end are held over the rest of the step by compressive forces that
//! close their gap at the end. These do not create energy, since the gap closes against them; but they prescribe only a mean rate, and a body that
//! covers half of its distance to a wall ends with a reversed velocity. An impact interval follows in which each contact may cancel the impulse of
//! its force, until the total impulses are those of a plastic impact. They minimise the energy, and zero is admissible, so that they do not create
//! energy either. Friction that has to decrease with the normal impulse may cancel at most its impulse over the step; otherwise it is unchanged.

use super::solve::Attempt;
use super::solver::Solving;
use super::trial::{PartKind, Trial};
use crate::step::contacts::{ActiveContact, ImpulseLaw, Phase};

impl Solving<'_> {
    /// The impact interval after a part with held contacts, in the memory of that part; `None` if they are at rest already, or if no impulses bring
    /// them to rest: then they do not change.
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
