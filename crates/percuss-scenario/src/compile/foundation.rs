//! Foundations along beams.

use percuss::Fault;

use super::beams::Beams;
use super::yielding::of_foundation;
use crate::content::{Foundation, FoundationLaw};

/// The foundation of a table.
pub(super) fn definition(
    name: &str,
    table: &Foundation,
    beams: &Beams<'_>,
    faults: &mut Vec<Fault>,
) -> percuss::Foundation {
    let law = match &table.law {
        FoundationLaw::Linear { stiffness, .. } => {
            percuss::FoundationLaw::Linear { stiffness: *stiffness }
        }
        FoundationLaw::Compression { stiffness, gap, .. } => {
            percuss::FoundationLaw::Compression { stiffness: *stiffness, gap: *gap }
        }
        FoundationLaw::Table { deflections, reactions } => percuss::FoundationLaw::Table {
            deflection: deflections.clone(),
            reaction: reactions.clone(),
        },
    };
    percuss::Foundation {
        name: name.to_owned(),
        beam: beams.id(&table.on),
        stretch: table.stretch,
        direction: table.direction,
        law,
        damping: table.damping,
        yielding: of_foundation(name, &table.law, faults),
    }
}
