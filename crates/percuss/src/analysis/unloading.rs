//! What stays when a structure that has yielded is unloaded.

use super::static_search::StaticSearch;
use super::statics::mechanisms;
use crate::element::fibre::StressLaw;
use crate::model::Model;
use crate::state::State;

/// Displacements of the beams' nodes in the equilibrium without loads and contacts that the structure springs back to, its plastic
/// strains as they are, shape (beam nodes, 4); none where supports do not hold it or no such equilibrium is near.
pub fn unloaded(model: &Model, state: &State) -> Option<Vec<[f64; 4]>> {
    let mut structure = model.structure();
    if !mechanisms(model).is_empty() {
        return None;
    }
    for fibres in structure.spans.iter_mut().filter_map(|span| span.fibres.as_mut()) {
        fibres.laws.iter_mut().for_each(|law| *law = law.without_flow());
    }
    for own in structure.connectors.iter_mut().filter_map(|c| c.yielding.as_mut()) {
        own.law = StressLaw::Elastic { young: own.law.young() };
    }
    let start = state.of_structure(&structure);
    let mut search = StaticSearch::at_share(&structure, &start, 0.0);
    search.foresee(true);
    if !search.solve(0.0) {
        return None;
    }
    Some(search.state().displacement)
}
