//! Rigid contacts of a run with derivatives that stay closed.

use super::{Derived, Flight, Horizon, IMPACT_INTERVAL};
use crate::log::Rest;
use crate::numbers::GuideLaw;
use percuss::internals::run::contact_log::rate_of_rest;
use percuss::internals::run::contact_status::{CREEP, NO_APPROACH};
use percuss::internals::scalar::Real;
use percuss::internals::step::contacts::IMPULSIVE;

/// What a rigid contact has come to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TouchingBodies {
    /// Whether it stays closed while it presses.
    pub closed: bool,
    /// Whether it is noted as a time of rest at hand.
    noted: bool,
    /// Fastest approach so far \[m/s\].
    pub approach_max: f64,
}

impl Flight<'_> {
    /// The rigid contact that stays closed, if one does.
    pub(super) fn resting(&self) -> Result<Option<usize>, Horizon> {
        let mut closed = (0..self.touching.len()).filter(|k| self.touching[*k].closed);
        match (closed.next(), closed.next()) {
            (one, None) => Ok(one),
            (_, Some(_)) => Err(self.horizon("there two rigid contacts are closed at once".into())),
        }
    }

    /// A contact that approaches from where it touches, as one does that has let go.
    pub(super) fn touching_again(&self) -> Option<usize> {
        let interval = IMPACT_INTERVAL * self.settings.step;
        self.open_rigid().into_iter().find(|k| {
            let state = &self.engine.guides[*k];
            let rate = state.rate.value;
            rate < 0.0 && state.gap.value < -0.75 * interval * rate
        })
    }

    /// Rigid projectiles whose contacts do not stay closed \[index of a projectile\].
    pub(super) fn open_rigid(&self) -> Vec<usize> {
        let rigid = |k: &usize| self.engine.numbers.guides[*k].law == GuideLaw::Rigid;
        (0..self.engine.guides.len()).filter(rigid).filter(|k| !self.touching[*k].closed).collect()
    }

    /// Approach that is none, by round-off or since gravity gives as much in a step, and the gap that goes with it \[m/s, m\].
    pub(super) fn negligible(&self) -> [f64; 2] {
        let mass = self.engine.numbers.total_mass.value;
        let speed = (2.0 * self.ledger.sums.energy_scale.value / mass).sqrt();
        let creep = CREEP * self.model.gravity() * self.settings.step;
        let rate = creep.max(NO_APPROACH * speed);
        [rate, (1e-12 * self.model.extent()).max(rate * self.settings.step)]
    }

    /// Contacts that touch, at rest but for what is no approach, count as closed.
    pub(super) fn close_at_rest(&mut self) {
        let [rate, gap] = self.negligible();
        for k in self.open_rigid() {
            let state = &self.engine.guides[k];
            self.touching[k].closed = state.gap.value <= gap && state.rate.value.abs() <= rate;
        }
    }

    /// Accepts a part in which a contact may have stayed closed.
    pub(super) fn accept_part(&mut self, rests: Option<usize>) {
        let Some(k) = rests else {
            self.accept();
            return self.close_at_rest();
        };
        let (start, place, given) = (self.log.time, self.engine.struck(k), self.given(k));
        let (impulse, rate) = (self.engine.guides[k].impulse, self.engine.guides[k].rate);
        self.accept();
        let after = self.engine.guides[k].rate.value;
        let place_end = self.engine.struck(k);
        let (presses, touching) = (impulse.value > 0.0, &mut self.touching[k]);
        let log = &mut self.log.guides[k].rests;
        if presses && !touching.noted {
            touching.noted = true;
            let zero = impulse.constant(0.0);
            log.push(Rest {
                start,
                end: f64::NAN,
                impulse: zero,
                approach: if rate.value > 0.0 { zero } else { -rate },
                separation: f64::NAN,
                given: [zero; 2],
                steps: 0,
                place,
                place_end,
            });
        }
        touching.closed = presses;
        if let Some(rest) = log.last_mut().filter(|_| touching.noted) {
            rest.impulse += impulse;
            (0..2).for_each(|p| rest.given[p] += given[p]);
            if presses {
                rest.steps += usize::from(self.engine.h.value >= IMPULSIVE * self.settings.step);
                rest.place_end = place_end;
            } else {
                rest.end = start.value;
                rest.separation = rate_of_rest(rate.value, after);
                touching.noted = false;
            }
        }
        self.engine.guides[k].impulse = impulse.constant(0.0);
        self.close_at_rest();
    }

    /// Work on beam and projectile of the impulse of a contact in the step solved last, shape (2) \[J\].
    pub(super) fn given(&self, k: usize) -> [Derived; 2] {
        let (guide, state) = (&self.engine.numbers.guides[k], &self.engine.guides[k]);
        let force = state.impulse / self.engine.h;
        [force * guide.along(&self.engine.increment), -(force * state.increment)]
    }
}
