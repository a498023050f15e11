//! Whether an equilibrium is stable.

use super::modes;
use super::spectrum::{Held, Layout, metric};
use super::static_search::StaticSearch;
use crate::model::Model;
use crate::step::tangent::Tangent;

/// Stiffness below this share of that of bending counts as none.
pub(super) const NEUTRAL: f64 = 1e-6;

/// Whether an equilibrium is stable.
#[derive(Clone, Copy, Debug)]
pub struct Stability {
    /// Whether all motions about it are stable.
    pub stable: bool,
    /// Motions against which there is no stiffness but the opposite, if they were counted.
    pub negative: Option<usize>,
}

impl Stability {
    fn counted(negative: Option<usize>) -> Self {
        Self { stable: negative == Some(0), negative }
    }
}

/// Whether all motions of a structure about the equilibrium of `search` are stable; open contacts are ignored.
///
/// With a potential of forces, stiffness decides: no pivot is negative, except round-off relative to the bending stiffness. Density has no
/// influence. With follower forces, motions may grow although the stiffness is positive (flutter), and frequencies decide.
pub fn stability_about(model: &Model, search: &StaticSearch, held: Vec<Held>) -> Stability {
    /// Eigenvalues below this share of the largest one considered count as zero.
    const ROUND_OFF: f64 = 1e-9;
    /// Number of modes considered if frequencies decide.
    const MODES: usize = 8;
    let layout = Layout::holding(model, held.clone());
    let mut tangent = layout.tangent(search);
    if !layout.is_symmetric(&tangent) {
        let modes = modes::lowest(model, &search.base, held, MODES);
        let most = modes.iter().fold(0.0_f64, |most, m| most.max(m.eigenvalue.abs()));
        let floor = ROUND_OFF * most;
        let stable = modes.iter().all(|m| m.imaginary == 0.0 && m.eigenvalue >= -floor);
        return Stability { stable, negative: None };
    }
    layout.add_band(&mut tangent, &metric(model, false), NEUTRAL);
    Stability::counted(layout.factor(tangent, true).map(|f| f.negative))
}

/// The same with an assembled tangent, that of further loading for beams that yield; `None` if it is not symmetric.
pub fn stability_loaded(
    model: &Model,
    search: &StaticSearch,
    tangent: &Tangent,
) -> Option<Stability> {
    let layout = Layout::new(model);
    let mut matrix = layout.assembled(search, tangent);
    if !layout.is_symmetric(&matrix) {
        return None;
    }
    layout.add_band(&mut matrix, &metric(model, false), NEUTRAL);
    Some(Stability::counted(layout.factor(matrix, true).map(|f| f.negative)))
}

/// Whether the current equilibrium is stable, by the tangent of further loading with active contacts kept closed; `structure` is the beams alone.
pub(super) fn stability(structure: &Model, search: &mut StaticSearch) -> Stability {
    let plain = |stable: bool| Stability { stable, negative: None };
    search.foresee(true);
    let press = search.contacts.press();
    if press && search.contacts.has_discs() {
        return plain(search.is_stable_touching());
    }
    search.assemble::<true>();
    let state = search.state();
    let held = if press { search.contacts.held(search.model, &state) } else { Vec::new() };
    let alone = search.of_structure(structure, &state);
    if !search.model.is_inelastic() {
        return stability_about(structure, &alone, held);
    }
    if press {
        return plain(search.is_stable_touching());
    }
    stability_loaded(structure, &alone, &search.work.tangent)
        .unwrap_or_else(|| plain(search.is_stable_touching()))
}
