//! Linear buckling with springs and stops that just touch: round-off alone would decide whether they act.

use std::fmt;

use crate::analysis::spectrum::{Held, Layout, free_motions};
use crate::analysis::static_search::{StaticSearch, largest, linearized};
use crate::model::Model;
use crate::model::frozen::ConnectorLaw;
use crate::settings::Scheme;
use crate::state::State;

/// Largest displacement at which it is seen what the loads move, as a share of the size of the structure.
const SMALL: f64 = 1e-6;
/// What moves by less than this share of the largest displacement is not moved by the loads.
const MOVED: f64 = 1e-6;
/// Gaps below this share of the length of a spring or the size of the structure are round-off: the spring touches.
pub(super) const TOUCHING: f64 = 1e-9;

/// Springs and stops of a structure in linear buckling that just touch, with different stiffnesses on either side, and that the loads do not move:
/// whether they act is decided by the buckling mode. The lower of both factors is the result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JustTouching {
    /// Their number; those of foundations are counted one by one.
    pub count: usize,
    /// Whether the factor found is that with the smaller of their stiffnesses, as slack ones.
    pub slack: bool,
    /// The lowest factor with the other stiffness; NaN if there is none.
    pub other: f64,
}

impl fmt::Display for JustTouching {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { count, slack, other } = *self;
        let are = match count {
            1 => {
                "1 spring or stop just touches, and the loads do not move it: it counts".to_owned()
            }
            _ => format!(
                "{count} springs and stops just touch, and the loads do not move them: they count"
            ),
        };
        let [this, that] = match slack {
            true => ["slack, which gives the lower factor", "taut"],
            false => ["taut, since the structure has no factor without", "slack"],
        };
        write!(f, "{are} as {this}")?;
        match other.is_nan() {
            true => write!(f, "; as {that} there is no factor"),
            false => {
                let shown = format!("{other:.5e}").parse::<f64>().unwrap_or(other);
                write!(f, "; as {that} the lowest is {shown}")
            }
        }
    }
}

/// The lines that a law follows from the reference configuration to negative and to positive changes, where they differ: what just touches there.
pub(super) fn both_sides(law: &ConnectorLaw, from: f64, scale: f64) -> Option<[ConnectorLaw; 2]> {
    let side = |side: f64| law.stiffness_at(from + 2.0 * side * TOUCHING * scale);
    let stiffness = [-1.0, 1.0].map(side);
    (stiffness[0] != stiffness[1]).then(|| stiffness.map(|one| line(law, from, one)))
}

/// The line through the force of a law in the reference configuration.
pub(super) fn line(law: &ConnectorLaw, from: f64, stiffness: f64) -> ConnectorLaw {
    let force = law.collocated(from, 0.0, 1.0)[0];
    let rest = if stiffness == 0.0 { from } else { from - force / stiffness };
    ConnectorLaw::Linear { stiffness, rest }
}

/// The side to which the linear response of the structure takes each of what just touches, as the index of [`both_sides`]; none where it moves it by
/// round-off alone, or where nothing else holds the structure. `structure` has the smaller of their stiffnesses.
pub(super) fn sides(
    structure: &Model,
    held: &[Held],
    touching: &[(usize, [ConnectorLaw; 2])],
) -> Vec<Option<usize>> {
    let layout = Layout::holding(structure, held.to_vec());
    let Some(mut response) = response(structure, &layout) else {
        return vec![None; touching.len()];
    };
    // So small that changes are linear in it, and larger than the round-off of positions.
    let most = largest(&response);
    let factor = SMALL * structure.extent() / most;
    response.as_flattened_mut().iter_mut().for_each(|c| *c *= factor);
    let still = vec![[0.0; 4]; response.len()];
    let side = |(i, _): &(usize, _)| {
        let connector = &structure.connectors[*i];
        let change = connector.value(&response, 0.0) - connector.value(&still, 0.0);
        let moves = change.abs() > MOVED * SMALL * structure.extent();
        (moves && most > 0.0).then_some(usize::from(change > 0.0))
    };
    touching.iter().map(side).collect()
}

/// The linear response to the loads, shape (nodes, 4) \[m, -\]; none of a mechanism.
fn response(structure: &Model, layout: &Layout<'_>) -> Option<Vec<[f64; 4]>> {
    let rest = State::at_rest(structure, Scheme::EnergyMomentum);
    let unloaded = StaticSearch::at(structure, &rest);
    if !free_motions(layout, &unloaded).motions.is_empty() {
        return None;
    }
    let factored = layout.factor(layout.tangent_with(&unloaded, 0.0), true)?;
    let (response, _) = factored.solve_with_multipliers(&loads(structure, &rest));
    (factored.negative == 0).then_some(response)
}

/// Nodal forces of the loads only: springs may be stressed before they act.
pub(super) fn loads(model: &Model, rest: &State) -> Vec<[f64; 4]> {
    let mut search = linearized(model, rest);
    search.work.multiplier.fill(0.0);
    search.forcing.set_static(model, 1.0);
    search.forcing.rest_motions();
    search.assemble::<false>();
    let loaded = search.work.residual.clone();
    search.forcing.set_static(model, 0.0);
    search.assemble::<false>();
    let difference = |(a, b): (&[f64; 4], &[f64; 4])| std::array::from_fn(|i| b[i] - a[i]);
    loaded.iter().zip(&search.work.residual).map(difference).collect()
}
