//! Permanent deflection of a structure that has yielded.

use super::lost::moves;
use super::spectrum::{Layout, free_motions};
use super::static_search::StaticSearch;
use crate::element::fibre::FibreState;
use crate::math::vec2::sub;
use crate::model::Model;
use crate::model::frozen::{BeamData, Connector, Coordinate, Drive};
use crate::state::State;
use crate::summary::{NoPermanentSet, PermanentSet, SetOfBeam};

/// Supports that have moved by less than this share of the size of the structure count as unmoved, and likewise rotations.
const UNMOVED: f64 = 1e-12;

/// Permanent deflection of each beam: distance of its nodes from their positions without plastic strains after removal of loads and contacts, with
/// supports at their current position, shape (beams).
///
/// The structure has the connections of the end of the run: released supports and torn joints are removed. Zero without yielding.
pub fn permanent_sets(model: &Model, state: &State) -> Vec<Result<PermanentSet, NoPermanentSet>> {
    let structure = without_flow(model);
    let start = state.of_structure(&structure);
    let mut search = StaticSearch::as_left(&structure, &start);
    let free = free_motions(&Layout::new(&structure), &search);
    let stays = has_yielded(&start).then(|| stays(&mut search, free.stops));
    let of_beam = |beam: &BeamData| {
        if moves(&free.motions, beam) {
            let parted = beam.nodes.clone().any(|node| parts_after(&structure, &start, beam, node));
            return Err(if parted { NoPermanentSet::Parted } else { NoPermanentSet::NotHeld });
        }
        match &stays {
            None => Ok(PermanentSet { s: f64::NAN, displacement: [0.0; 2] }),
            Some(None) => Err(NoPermanentSet::NoEquilibrium),
            Some(Some(nodal)) => farthest(&structure, beam, nodal),
        }
    };
    structure.beams.iter().map(of_beam).collect()
}

/// The largest permanent set of the beams that a spring or hinge acts on, of those that have one.
pub fn set_beside(
    model: &Model,
    connector: &Connector,
    sets: &[Result<PermanentSet, NoPermanentSet>],
) -> Result<SetOfBeam, NoPermanentSet> {
    let beams = connector.on_beams().map(|point| point.beam);
    let of =
        |beam: usize| sets[beam].map(|set| SetOfBeam { beam: model.beams[beam].name.clone(), set });
    let larger = |a: Result<SetOfBeam, _>, b: Result<SetOfBeam, _>| match (&a, &b) {
        (Ok(own), Ok(other)) if other.set.size() > own.set.size() => b,
        (Err(_), Ok(_)) => b,
        _ => a,
    };
    beams.map(of).reduce(larger).unwrap_or(Err(NoPermanentSet::NotHeld))
}

/// Whether an element of a beam that starts at a node has parted.
fn parts_after(model: &Model, state: &State, beam: &BeamData, node: usize) -> bool {
    let ends =
        |node: usize| model.spans[beam.spans.clone()].iter().any(|s| s.nodes.end == node + 1);
    state.has_parted(node) && !ends(node)
}

/// The structure alone, its plastic strains as they are for good.
fn without_flow(model: &Model) -> Model {
    let mut structure = model.structure();
    for fibres in structure.spans.iter_mut().filter_map(|span| span.fibres.as_mut()) {
        fibres.laws.iter_mut().for_each(|law| *law = law.without_flow());
    }
    let yielding = structure.connectors.iter_mut().filter_map(|c| c.yielding.as_mut());
    for law in yielding.filter_map(|own| own.law.as_mut()) {
        *law = law.without_flow();
    }
    structure
}

fn has_yielded(state: &State) -> bool {
    state.fibres.iter().chain(&state.memories).any(|memory| memory.accumulated > 0.0)
}

/// Permanent displacements of nodes, shape (nodes, 2) \[m\]; `None` without a nearby unloaded equilibrium. Stops keep unsupported parts in place.
fn stays(search: &mut StaticSearch, stops: Vec<(usize, usize)>) -> Option<Vec<[f64; 2]>> {
    search.contacts.hold_loosely(search.model, stops);
    let unloaded = at_rest(search)?;
    if rests_in_reference(search) {
        return Some(unloaded);
    }
    let straight = |memory: &mut FibreState| (memory.plastic, memory.accumulated) = (0.0, 0.0);
    search.base.fibres.iter_mut().for_each(straight);
    search.base.memories.iter_mut().for_each(straight);
    let unyielded = at_rest(search)?;
    Some(unloaded.iter().zip(&unyielded).map(|(a, b)| sub(*a, *b)).collect())
}

/// Displacements of the nodes in the unloaded equilibrium nearest to the current configuration, shape (nodes, 2) \[m\].
fn at_rest(search: &mut StaticSearch) -> Option<Vec<[f64; 2]>> {
    search.foresee(true);
    let start = search.reached();
    let found = search.solve(0.0) || search.relax_from(&start, 0.0);
    found.then(|| search.displacement().iter().map(|u| [u[0], u[1]]).collect())
}

/// Whether the reference configuration is an equilibrium without loads and plastic strains: supports have their initial position, and springs have
/// no force there.
fn rests_in_reference(search: &StaticSearch) -> bool {
    let (model, forcing) = (search.model, &search.forcing);
    let none = UNMOVED * search.size();
    let unmoved = |drive: &Drive| forcing.start(drive).abs() <= none;
    let reference = vec![[0.0; 4]; model.node_count()];
    let unyielded = vec![FibreState::default(); model.memory_count()];
    let constraints = model.constraints.iter().zip(&forcing.constrained);
    let connectors = model.connectors.iter().zip(&forcing.connected);
    model.prescribed.iter().flat_map(|dofs| &dofs.drives).all(unmoved)
        && constraints.filter(|(_, holds)| **holds).all(|(c, _)| unmoved(&c.drive))
        && connectors.filter(|(_, holds)| **holds).all(|(c, _)| {
            let still = match &c.coordinate {
                Coordinate::Displacement { drive, .. } => unmoved(drive),
                _ => true,
            };
            still && c.potential(c.value(&reference, 0.0), &unyielded) == 0.0
        })
}

/// The node of a beam with the largest permanent displacement.
fn farthest(
    model: &Model,
    beam: &BeamData,
    stays: &[[f64; 2]],
) -> Result<PermanentSet, NoPermanentSet> {
    let nodes = model.spans[beam.spans.clone()]
        .iter()
        .flat_map(|span| span.nodes.clone().zip(span.stations.iter().copied()));
    let sets = nodes.map(|(n, s)| PermanentSet { s, displacement: stays[n] });
    let farthest = sets.max_by(|a, b| a.size().total_cmp(&b.size()));
    farthest.ok_or(NoPermanentSet::NoEquilibrium)
}
