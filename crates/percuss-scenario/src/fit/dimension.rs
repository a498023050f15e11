//! Dimensions of the units of channels.

use crate::units;

/// Dimension of an SI unit as channels spell it.
pub(super) fn dimension(unit: &str) -> units::Dimension {
    match unit {
        "" | "1" => units::Dimension::default(),
        _ => units::parse(&format!("1 {unit}")).map(|one| one.dimension).unwrap_or_default(),
    }
}
