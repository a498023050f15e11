//! Foundations along beams.

use percuss::{Fault, ModelBuilder};

use super::beams::Beams;
use super::yielding::of_foundation;
use crate::content::{Content, FoundationLaw};
use crate::table::Named;

/// Adds the foundations.
pub(super) fn add(
    content: &Content,
    beams: &Beams<'_>,
    builder: &mut ModelBuilder,
    faults: &mut Vec<Fault>,
) {
    for Named { name, table } in &content.foundation {
        builder.foundation(percuss::Foundation {
            name: name.clone(),
            beam: beams.id(&table.on),
            stretch: table.stretch,
            direction: table.direction,
            law: match &table.law {
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
            },
            damping: table.damping,
            yielding: of_foundation(name, &table.law, faults),
        });
    }
}
