//! Equivalent static forces in words.

use percuss::{EquivalentForce, NoEquivalentForce};

use crate::number::quantity;

/// The static force with the peak moment of the impacts, and the one with their peak deflection, or why there is none.
pub(super) fn equivalent(force: &EquivalentForce) -> String {
    let rebound = if force.on_rebound { " on rebound, against the impact" } else { "" };
    let one = |found: Result<f64, NoEquivalentForce>, effect: &str| match found {
        Ok(force) => Some(format!("{} (same peak {effect})", quantity(force, "N"))),
        Err(why) => why.is_reported().then(|| format!("none with the same peak {effect}: {why}")),
    };
    let by_moment = one(force.moment, "moment");
    let by_deflection = one(force.deflection, &format!("deflection{rebound}"));
    let forces = by_moment.into_iter().chain(by_deflection).collect::<Vec<_>>().join(", ");
    let beside = if force.beside_loads { ", beside the permanent loads" } else { "" };
    let elastic = if force.as_if_elastic { ", of the elastic structure" } else { "" };
    format!("equivalent static force: {forces}{beside}{elastic}")
}

/// Why there is no such force.
pub(super) fn without_equivalent(why: &str) -> String {
    format!("no equivalent static force: {why}")
}
