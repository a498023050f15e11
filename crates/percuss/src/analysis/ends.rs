//! What load steps and paths share: what they begin with, and the equilibrium that they end with.

use super::balance::StaticBalance;
use super::equilibrium::Equilibrium;
use super::foundations;
use super::largest_displacement::LargestDisplacement;
use super::spectrum::{Layout, free_motions};
use super::static_search::StaticSearch;
use super::yields::at_rest;
use crate::error::Error;
use crate::model::Model;
use crate::state::State;
use crate::step::contacts::PressingPair;

/// Rejects overlapping bodies before any load acts.
pub(super) fn refuse_overlaps(search: &StaticSearch) -> Result<(), Error> {
    let overlaps = search.model.overlaps(&search.base.displacement, |_| true);
    overlaps.first().map_or(Ok(()), |fault| Err(Error::overlap(fault.to_string())))
}

/// The result at the increment reached.
pub(super) fn finish(search: &mut StaticSearch, load_steps: usize) -> Equilibrium {
    search.assemble::<false>();
    search.clear_round_off();
    search.foresee(true);
    search.assemble::<false>();
    let mut state = search.state();
    search.contacts.remember_crushing(&mut state);
    let model = search.model;
    let at = |p: &crate::model::frozen::MaterialPoint| p.displacement(&state.displacement);
    let names = model.support_names().map(str::to_owned);
    let forces = search.section_forces(&state);
    let reactions = search.reactions(&state);
    let balance = StaticBalance::new(search, &reactions);
    Equilibrium {
        points: model.points.iter().map(|p| (p.label.clone(), at(p))).collect(),
        rotations: model.rotations(&state.displacement),
        largest_displacement: LargestDisplacement::of(model, &state),
        section_forces: forces.beams,
        point_forces: forces.points,
        element_forces: forces.ends,
        element_points: forces.vertices,
        contact_forces: search.contacts.frame_forces(model, &state),
        load_factors: search.forcing.factors.clone(),
        reactions: names.zip(reactions).collect(),
        contacts: search.contacts.results(model),
        pressed: search
            .contacts
            .forces()
            .map(|(pair, force, row)| PressingPair { pair, row: *row, force })
            .collect(),
        held: search.contacts.held(model, &state),
        yielding: at_rest(model, &state),
        foundations: foundations::at_rest(model, &state),
        failures: Vec::new(),
        balance,
        first_yields: Vec::new(),
        softening: f64::NAN,
        stable: true,
        sliding: Vec::new(),
        load_steps,
        newton_iterations: search.iterations,
        state,
    }
}

/// Whether the structure has stops and would be a mechanism without them.
pub(super) fn leans_on_stops(model: &Model) -> bool {
    let structure = model.structure();
    let rest = State::at_rest(&structure, crate::settings::Scheme::EnergyMomentum);
    let layout = Layout::new(&structure);
    structure.connectors.iter().any(|c| c.law.may_give_way())
        && !free_motions(&layout, &StaticSearch::at(&structure, &rest)).motions.is_empty()
}
