//! Impacts: impulses that obey the contacts' impact law, over an impact interval or, as in the paper, over a whole step.

use super::decider::Part;
use super::solve::Attempt;
use super::solver::Solving;
use super::trial::{PartKind, Trial};
use crate::contact::impact::gives_energy;
use crate::geometry::row::Row;
use crate::model::{ImpactLaw, RigidLaw};
use crate::step::contacts::{ActiveContact, ImpulseLaw, Phase, RigidContact};
use crate::step::newton::Failure;

impl Solving<'_> {
    /// The impact interval of all touching contacts; resting ones remain closed.
    pub fn strike(&mut self, part: &Part) -> Result<Trial, Failure> {
        self.solve_impact(part.interval, part.active.clone(), PartKind::Impact)
    }

    /// A step of the paper's: contacts closed at its start obey the impact law over the whole step.
    pub fn step_in_time(&mut self, part: &Part) -> Result<Trial, Failure> {
        let rests =
            |c: &ActiveContact| -self.state.pairs[c.pair].rate <= self.stick_velocity(c.pair);
        let kind = PartKind::TimeStepping { persistent: part.active.iter().map(rests).collect() };
        let trial = self.solve_impact(part.size, part.active.clone(), kind)?;
        let reached = self.encounters.reached.clone();
        match self.first_passage(&reached) {
            Some(_) => Err(Failure::Passed),
            None => Ok(trial),
        }
    }

    /// Pair `i` as it strikes; without restitution where it sticks.
    pub(super) fn striking(&self, i: usize, sticks: bool) -> ActiveContact {
        let law = self.rigid_law(i);
        let e = |law: RigidLaw| (law.restitution, law.tangential_restitution);
        let (restitution, tangential) = law.filter(|_| !sticks).map_or((0.0, 0.0), e);
        ActiveContact { pair: i, phase: Phase::Impact { restitution, tangential } }
    }

    /// Solves a part with impulses by the contacts' impact law, or by another one if that would create energy.
    pub(super) fn solve_impact(
        &mut self,
        h: f64,
        active: Vec<ActiveContact>,
        kind: PartKind,
    ) -> Result<Trial, Failure> {
        let moreau = |c: &ActiveContact| {
            self.rigid_law(c.pair).is_some_and(|law| law.impact == ImpactLaw::Moreau)
        };
        let laws: &[ImpulseLaw] = if active.iter().any(moreau) {
            &[ImpulseLaw::Moreau, ImpulseLaw::Mean]
        } else {
            &[ImpulseLaw::Newton, ImpulseLaw::Moreau, ImpulseLaw::Mean]
        };
        let mut outcome = Err(Failure::Impact);
        for (k, law) in laws.iter().enumerate() {
            outcome = self.solve(&Attempt::impact(h, *law), &active).map(|()| k > 0);
            // With friction, a law may also have no solution.
            let unsolved = outcome == Err(Failure::Impact);
            if !unsolved && (outcome.is_err() || !self.impulses_give(h, 0.0)) {
                break;
            }
        }
        outcome.map(|fallback_law| Trial { h, active, fallback_law, kind })
    }

    /// Whether the impulses of the last solved step, and previous ones with the given work, create energy.
    pub(super) fn impulses_give(&self, h: f64, before: f64) -> bool {
        let rate = |row: &Row| row.on(&self.state.velocity);
        let rates = |found: &RigidContact| {
            let [normal, tangent] = found.impulse;
            [(normal, rate(&found.normal)), (tangent, rate(&found.tangent))]
        };
        gives_energy(self.work_of_impulses(h) + before, self.work.rigid.iter().flat_map(rates))
    }

    /// Work of the impulses of the step of size `h` solved last \[J\].
    pub(super) fn work_of_impulses(&self, h: f64) -> f64 {
        let work = |found: &RigidContact| {
            let rows = found.impulse.iter().zip([&found.normal, &found.tangent]);
            rows.map(|(impulse, row)| impulse * row.on(&self.work.increment) / h).sum::<f64>()
        };
        self.work.rigid.iter().map(work).sum()
    }
}
