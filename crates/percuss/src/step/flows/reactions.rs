//! Reactions of an instant, and means over a step between two of them.

use crate::state::{Instant, State};
use crate::step::integration::Integration;

/// Impulse and angular impulse of all supports and guides so far.
pub(super) fn supports_so_far(state: &State) -> [f64; 3] {
    let [x, y] = state.ledger.impulse_supports;
    [x, y, state.ledger.angular_impulse_supports]
}

/// Reactions that the current part has entered in the ledger, as those of an instant.
pub(super) fn instant(state: &State, h: f64, before: [f64; 3], since: f64) -> Instant {
    let mut reactions = vec![[0.0; 3]; state.reactions.len()];
    for (support, before) in state.reacting.list() {
        let now = &state.reactions[*support];
        reactions[*support] = std::array::from_fn(|i| (now[i] - before[i]) / h);
    }
    let now = supports_so_far(state);
    let total = std::array::from_fn(|i| (now[i] - before[i]) / h);
    Instant { since, reactions, total }
}

/// Schemes that advance accelerations balance forces at an instant late in the step: mean reactions over it are on the line through those of this
/// instant and of the previous one.
pub(super) fn average_reactions(state: &mut State, rule: &Integration, before: [f64; 3]) {
    let (h, theta) = (rule.h, rule.theta());
    let now = instant(state, h, before, (1.0 - theta) * h);
    if let Some(last) = state.instant.take() {
        let share = (theta - 0.5) * h / (theta * h + last.since);
        let back = |now: f64, last: f64| h * share * (now - last);
        for k in 0..now.reactions.len() {
            let (r, l) = (now.reactions[k], last.reactions[k]);
            if r != l {
                let own = state.reaction_mut(k);
                (0..3).for_each(|i| own[i] -= back(r[i], l[i]));
            }
        }
        let (t, l) = (now.total, last.total);
        let ledger = &mut state.ledger;
        (0..2).for_each(|i| ledger.impulse_supports[i] -= back(t[i], l[i]));
        ledger.angular_impulse_supports -= back(t[2], l[2]);
    }
    state.instant = Some(now);
}
