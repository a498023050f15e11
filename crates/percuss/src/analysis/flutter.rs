//! Where structures under forces that follow them lose their stability: the least load factor of flutter or divergence.

use super::modes::{Mode, ModeKind, lowest_under};
use super::static_search::{Reached, StaticSearch};
use crate::model::Model;

/// Number of modes in the search.
const MODES: usize = 8;
/// Steps of the load factor up to one, and its growth from step to step beyond.
const STEPS: usize = 10;
const GROWTH: f64 = 1.5;
/// Halvings of the first factor, where that is unstable already.
const HALVINGS: usize = 30;
/// Largest load factor in the search.
const UP_TO: f64 = 1e3;
/// Width of the bracket in the end, as a share of the factor, and evaluations that narrow it.
const NARROW: f64 = 1e-7;
const MOST: usize = 60;
/// Eigenvalues below this share of the largest one considered count as zero.
const ROUND_OFF: f64 = 1e-9;

/// Stability of an equilibrium under follower loads that grow with one factor.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FollowerStability {
    /// Two modes meet at this factor on the loads, and one of them grows beyond.
    Flutter {
        /// Factor on the loads that act at time zero.
        factor: f64,
        /// Frequency at which they meet \[Hz\].
        frequency: f64,
    },
    /// A mode's frequency vanishes at this factor.
    Divergence {
        /// Factor on the loads that act at time zero.
        factor: f64,
    },
    /// Stable at every factor of the search up to this one, in steps of a tenth, and of half the factor beyond one.
    Kept {
        /// Largest factor of the search.
        up_to: f64,
    },
}

/// An equilibrium at a load factor, with its lowest modes.
struct At {
    factor: f64,
    reached: Reached,
    /// Its lowest modes, shape (modes found).
    modes: Vec<Mode>,
}

impl At {
    /// The mode that grows.
    fn growing(&self) -> Option<&Mode> {
        let most = self.modes.iter().fold(0.0_f64, |most, m| most.max(m.eigenvalue.abs()));
        let grows = |m: &&Mode| m.imaginary > 0.0 || m.eigenvalue < -ROUND_OFF * most;
        self.modes.iter().find(grows)
    }

    /// Quantity that passes zero at the onset of instability: the square of half the difference of the two squared frequencies that coincide in
    /// flutter, the lowest of them in divergence. Both are smooth there.
    fn measure(&self, like: &Mode) -> f64 {
        if like.imaginary == 0.0 {
            return self.modes.iter().map(|m| m.eigenvalue).fold(f64::INFINITY, f64::min);
        }
        if let Some(found) = self.modes.iter().find(|m| m.imaginary > 0.0) {
            return -found.imaginary * found.imaginary;
        }
        let mut apart: Vec<f64> =
            self.modes.iter().map(|m| m.eigenvalue - like.eigenvalue).collect();
        apart.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        match apart[..] {
            [a, b, ..] => 0.25 * (a - b) * (a - b),
            _ => f64::NAN,
        }
    }
}

/// Searches for the least factor on the loads at which the structure, without its contacts, loses its stability.
///
/// Equilibria follow the loads in steps; between the last stable and the first unstable one the factor is found by secants in a bracket.
/// A range of factors narrower than a step in which the structure is unstable may be passed over.
pub(super) fn follower_stability(structure: &Model) -> FollowerStability {
    let mut search = StaticSearch::new(structure);
    search.foresee(true);
    let mut last: Option<At> = None;
    let mut start = search.reached();
    for factor in factors() {
        let Some(at) = evaluate(&mut search, &start, factor) else { break };
        if at.growing().is_some() {
            let (stable, unstable) = match last {
                Some(stable) => (Some(stable), at),
                None => halved(&mut search, at),
            };
            return narrowed(&mut search, stable, unstable);
        }
        start = at.reached.clone();
        last = Some(at);
    }
    FollowerStability::Kept { up_to: last.map_or(0.0, |at| at.factor) }
}

/// Interval of factors in which stability is lost, below the first factor of the search.
fn halved(search: &mut StaticSearch, first: At) -> (Option<At>, At) {
    let rest = StaticSearch::new(search.model).reached();
    let mut unstable = first;
    for _ in 0..HALVINGS {
        match evaluate(search, &rest, 0.5 * unstable.factor) {
            Some(at) if at.growing().is_some() => unstable = at,
            stable => return (stable, unstable),
        }
    }
    (None, unstable)
}

/// Factors of the search.
fn factors() -> impl Iterator<Item = f64> {
    let below = (1..=STEPS).map(|k| k as f64 / STEPS as f64);
    let beyond = std::iter::successors(Some(GROWTH), |f| Some(GROWTH * f));
    below.chain(beyond.take_while(|f| *f < UP_TO)).chain([UP_TO])
}

/// The equilibrium at a factor, from another one.
fn evaluate(search: &mut StaticSearch, from: &Reached, factor: f64) -> Option<At> {
    search.go_back(from);
    if !search.solve(factor) {
        return None;
    }
    let modes = lowest_under(search.model, &search.state(), factor, MODES);
    (!modes.is_empty()).then(|| At { factor, reached: search.reached(), modes })
}

/// Where stability is lost between a stable equilibrium and an unstable one.
fn narrowed(search: &mut StaticSearch, stable: Option<At>, unstable: At) -> FollowerStability {
    let (Some(mut low), mut high) = (stable, unstable) else {
        return FollowerStability::Kept { up_to: 0.0 }; // unstable under next to no load: no factor is known
    };
    // Illinois: an end that stays counts half.
    let (mut share_low, mut share_high) = (1.0, 1.0);
    for _ in 0..MOST {
        let width = high.factor - low.factor;
        if width <= NARROW * high.factor {
            break;
        }
        let Some(like) = high.growing().cloned() else { break };
        let (a, b) = (share_low * low.measure(&like), share_high * high.measure(&like));
        let share = a / (a - b);
        // Beside an end, a little inside: the bracket closes from both sides.
        let share = if share.is_finite() { share.clamp(1e-3, 1.0 - 1e-3) } else { 0.5 };
        let Some(at) = evaluate(search, &low.reached, low.factor + share * width) else { break };
        if at.growing().is_some() {
            (high, share_high, share_low) = (at, 1.0, 0.5 * share_low);
        } else {
            (low, share_low, share_high) = (at, 1.0, 0.5 * share_high);
        }
    }
    let factor = 0.5 * (low.factor + high.factor);
    match high.growing() {
        Some(mode) if mode.kind() == ModeKind::Flutter => {
            FollowerStability::Flutter { factor, frequency: mode.frequency() }
        }
        _ => FollowerStability::Divergence { factor },
    }
}
