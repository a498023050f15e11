//! Reason why no equilibrium follows the last one.

use super::spectrum::{Layout, free_motions};
use super::static_search::{StaticSearch, largest};
use crate::error::Error;
use crate::model::StrainMeasure;
use crate::model::frozen::BeamData;
use crate::state::State;

/// Whether a beam moves in any of the motions.
pub(super) fn moves(motions: &[Vec<[f64; 4]>], beam: &BeamData) -> bool {
    motions.iter().any(|x| largest(&x[beam.nodes.clone()]) > 1e-3 * largest(x))
}

/// A beam that can move without strain at the current configuration of the search, with closed contacts kept closed; `None` if contacts may support
/// it, or without stops.
pub(super) fn loose(search: &StaticSearch, state: &State) -> Option<String> {
    let structure = search.model.structure();
    let alone = search.of_structure(&structure, state);
    let free = free_motions(&Layout::new(&structure), &alone).motions;
    let stopped = structure.connectors.iter().any(|c| c.law.may_give_way());
    let beam = structure.beams.iter().find(|beam| moves(&free, beam));
    beam.filter(|_| stopped && search.contacts.is_empty()).map(|beam| beam.name.clone())
}

/// Reason why no equilibrium follows the last one.
pub(super) fn lost(search: &mut StaticSearch, share: f64) -> Error {
    let state = search.state();
    if let Some(name) = loose(search, &state) {
        return Error::nothing_holds(name);
    }
    let forces = search.section_forces(&state).beams;
    for (beam, found) in search.model.beams.iter().zip(&forces) {
        for span in &search.model.spans[beam.spans.clone()] {
            let law = &span.table(0).rows[1].section;
            // M = EI k (1 - 2 (I/A) k^2) is largest at k = 1 / sqrt(6 I/A).
            let most = law.bending * (2.0 / 3.0) / (6.0 * law.bending / law.axial).sqrt();
            let near = found.moment.largest().value.abs() > 0.9 * most;
            if span.measure == StrainMeasure::Green && near {
                return Error::moment_beyond_law(share, beam.name.clone(), most);
            }
        }
    }
    match search.contacts.rigid_ones_matter(search.model) {
        true => Error::unsettled_contacts(share),
        false => Error::no_equilibrium(share),
    }
}
