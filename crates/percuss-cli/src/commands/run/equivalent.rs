//! Equivalent static forces in words.

use percuss::EquivalentForce;

use crate::number::quantity;

/// The static force with the peak moment of the impacts, and the one with their peak deflection.
pub(super) fn equivalent(force: &EquivalentForce) -> String {
    let by_moment = quantity(force.moment, "N");
    let by_deflection =
        force.deflection.map(|f| format!(", {} (same peak deflection)", quantity(f, "N")));
    let elastic = if force.as_if_elastic { ", elastic structure assumed" } else { "" };
    let by_deflection = by_deflection.unwrap_or_default();
    format!("equivalent static force: {by_moment} (same peak moment){by_deflection}{elastic}")
}

/// Why there is no such force.
pub(super) fn without_equivalent(why: &str) -> String {
    format!("no equivalent static force: {why}")
}
