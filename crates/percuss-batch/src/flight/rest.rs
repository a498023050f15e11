//! What a rigid contact did in a part of a step of a run with derivatives.

use super::{Derived, Flight};
use crate::impact::Strike;
use crate::log::{Rest, Struck};
use percuss::internals::run::contact_log::rate_of_rest;
use percuss::internals::scalar::Real;
use percuss::internals::step::contacts::IMPULSIVE;

/// What is known of it before the part is accepted.
pub(super) struct ContactPart {
    /// Number of the projectile \[index of a projectile\], and whether it strikes or rests.
    k: usize,
    how: Strike,
    start: Derived,
    impulse: Derived,
    /// Rates of the gap at start and end, shape (2) \[m/s\].
    rates: [Derived; 2],
    /// Work on beam and projectile, shape (2) \[J\].
    given: [Derived; 2],
    /// Where the projectile is at the start, shape (2) \[m\].
    place: [Derived; 2],
}

impl ContactPart {
    /// Of the projectile that strikes, or stays in contact, in the part solved last.
    pub fn before(flight: &Flight<'_>, k: usize, how: Strike) -> Self {
        let (engine, start) = (&flight.engine, flight.log.time);
        let (guide, state) = (&engine.numbers.guides[k], &engine.guides[k]);
        let force = state.impulse / engine.h;
        Self {
            k,
            how,
            start,
            impulse: state.impulse,
            rates: [state.rate, engine.gap_next(k)[1]],
            given: [force * guide.along(&engine.increment), -(force * state.increment)],
            place: engine.struck(k),
        }
    }

    /// Notes it, the part having been accepted.
    pub fn note(self, flight: &mut Flight<'_>) {
        let Self { k, start, impulse, rates: [before, separation], given, place, .. } = self;
        flight.engine.guides[k].impulse = impulse.constant(0.0);
        let presses = impulse.value > 0.0;
        if self.how == Strike::Stays {
            return self.note_rest(flight, presses);
        }
        if presses {
            let time = start + flight.engine.h * 0.5;
            let approach = -before;
            let struck = Struck { time, impulse, approach, separation, given, place };
            flight.log.guides[k].impacts[0].push(struck);
        }
    }

    fn note_rest(self, flight: &mut Flight<'_>, presses: bool) {
        let Self { k, start, impulse, rates: [rate, _], given, place, .. } = self;
        let (engine, zero) = (&flight.engine, impulse.constant(0.0));
        let (after, place_end) = (engine.guides[k].rate.value, engine.struck(k));
        let all = &mut flight.log.guides[k].rests;
        // The last one goes on while it has no end.
        let goes_on = all.last().is_some_and(|rest| rest.end.is_nan());
        if presses && !goes_on {
            all.push(Rest {
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
        let Some(rest) = all.last_mut().filter(|_| presses || goes_on) else { return };
        rest.impulse += impulse;
        (0..2).for_each(|p| rest.given[p] += given[p]);
        if presses {
            rest.steps += usize::from(engine.h.value >= IMPULSIVE * flight.settings.step);
            rest.place_end = place_end;
        } else {
            rest.end = start.value;
            rest.separation = rate_of_rest(rate.value, after);
        }
    }
}
