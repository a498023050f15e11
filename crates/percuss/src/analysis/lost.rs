//! Reason why no equilibrium follows the last one.

use super::spectrum::{Layout, free_motions};
use super::static_search::{StaticSearch, largest};
use crate::error::Error;
use crate::model::frozen::BeamData;
use crate::model::{Model, StrainMeasure};
use crate::state::State;

/// A part whose displacements are less than this share of the largest ones of a motion does not move in it.
const MOVES: f64 = 1e-3;

/// Whether a beam moves in any of the motions.
pub(super) fn moves(motions: &[Vec<[f64; 4]>], beam: &BeamData) -> bool {
    motions.iter().any(|x| largest(&x[beam.nodes.clone()]) > MOVES * largest(x))
}

/// A beam that can move without strain at the current configuration of the search, with closed contacts kept closed, where a stop or a spring of one
/// side could end this motion and is open; `None` if contacts may support it.
pub(super) fn loose(search: &StaticSearch, state: &State) -> Option<String> {
    if !search.contacts.is_empty() {
        return None;
    }
    let structure = search.model.structure();
    let alone = search.of_structure(&structure, state);
    let mut free = free_motions(&Layout::new(&structure), &alone).motions;
    free.retain(|motion| moves_a_stop(&structure, motion));
    structure.beams.iter().find(|beam| moves(&free, beam)).map(|beam| beam.name.clone())
}

/// Whether a motion moves a point of a beam at a stop or a spring that may give way.
fn moves_a_stop(structure: &Model, motion: &[[f64; 4]]) -> bool {
    let stops = structure.connectors.iter().filter(|c| c.law.may_give_way());
    let least = MOVES * largest(motion);
    stops.flat_map(|c| c.on_beams()).any(|point| {
        let [x, y] = point.value(motion);
        x.abs().max(y.abs()) > least
    })
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
