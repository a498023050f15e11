//! Equivalent static forces in words.

use percuss::EquivalentForce;

use crate::number::number;

/// The static force that does what the impacts did at most.
pub(super) fn equivalent(force: &EquivalentForce) -> String {
    let by_moment = number(force.moment);
    let by_deflection = force.deflection.map(|f| format!(", {} N by deflection", number(f)));
    let elastic = match force.as_if_elastic {
        true => ", on the structure as if it stayed elastic",
        false => "",
    };
    let by_deflection = by_deflection.unwrap_or_default();
    format!("equivalent static force {by_moment} N by moment{by_deflection}{elastic}")
}

/// Why there is no such force.
pub(super) fn without_equivalent(why: &str) -> String {
    format!("no equivalent static force: {why}")
}
