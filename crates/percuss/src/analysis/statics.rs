//! Static equilibrium under the loads at time zero, and mechanisms that prevent it.

use super::balance;
use super::ends::{finish, refuse_overlaps};
use super::equilibrium::Equilibrium;
use super::failure::in_words;
use super::lost::{loose, moves};
use super::path::equilibrium_path;
use super::spectrum::{Layout, free_motions};
use super::stability::stability;
use super::static_contacts::takes_part;
use super::static_loading::Loading;
use super::static_search::StaticSearch;
use crate::error::Error;
use crate::inspect::loose_ends;
use crate::linalg::block::inner;
use crate::model::frozen::BeamData;
use crate::model::{Fault, Model};
use crate::settings::PathSettings;
use crate::state::State;

/// Load steps, as a share of the load: small enough to stay on the branch that starts at rest where a beam has several
/// equilibria (a roll of one turn more or less).
const FIRST_STEP: f64 = 0.1;
/// A mechanism whose stops are open and that has moved by more than this share of its size is one that the loads have turned round, like a
/// weathervane, and no structure that stops hold.
const CARRIED_AWAY: f64 = 0.1;

/// Static equilibrium of `model` under the loads at time zero, with the contacts of a transient.
///
/// Newton's iteration in load steps, with smaller ones if it does not converge. A part fails (fibres, springs, hinges, joints of a given strength)
/// at the load factor of its full strength, and its forces are released gradually. Compliant contacts act by their potentials, rigid ones with
/// complementary gap and force, all without friction. Guided projectiles and moving discs are ignored.
///
/// # Errors
/// No convergence even for small load steps: a limit point, or a load without equilibrium. A failure without a following equilibrium. A disc or a
/// beam without support. Bodies that overlap before any load acts.
pub fn equilibrium(model: &Model) -> Result<Equilibrium, Error> {
    equilibrium_in(model, FIRST_STEP)
}

/// The same with load steps of the given share of the loads, where they converge.
///
/// # Errors
/// As [`equilibrium`].
pub fn equilibrium_in(model: &Model, first_step: f64) -> Result<Equilibrium, Error> {
    let structure = model.structure();
    let mut search = StaticSearch::new(model);
    refuse_overlaps(&search)?;
    search.hold_loose_beams();
    search.foresee(true);
    let mut loading = Loading::new(&mut search, first_step.clamp(1e-3, 1.0));
    let brought = loading.bring_up(&structure);
    if (brought.is_err() || loading.is_astray())
        && loading.failures.is_empty()
        && let Some(found) = along_path(model)
    {
        return Ok(found);
    }
    brought?;
    let Loading { stable, steps, failures, course, .. } = loading;
    let mut found = finish(&mut search, steps);
    let after_failures = |error: Error| match failures.last() {
        Some(last) => Error::nothing_left(last.factor, in_words(failures.iter(), false)),
        None => error,
    };
    let moved = found.state.displacement.iter().map(|u| u[0].hypot(u[1])).fold(0.0, f64::max);
    if moved > CARRIED_AWAY * model.extent()
        && let Some(name) = loose(&search, &found.state)
    {
        return Err(after_failures(Error::nothing_holds(name)));
    }
    let checked = balance::check(&search, &found.balance, &found.element_forces);
    checked.map_err(|error| error.after(&in_words(failures.iter(), true)))?;
    found.failures = failures;
    (found.softening, found.first_yields) = (course.softening(), course.first_yields);
    found.stable =
        (stable && !search.contacts.press()) || stability(&structure, &mut search).stable;
    if search.contacts.holds_beams() {
        found.sliding = sliding(&structure, &found);
    }
    Ok(found)
}

/// The equilibrium to which the path from zero load leads, by arcs: beside a bifurcation that small loads across hardly round off, load steps may
/// find the other branch, the unstable one, or none. Only of elastic structures, where the way does not matter, without contacts and motions.
fn along_path(model: &Model) -> Option<Equilibrium> {
    let elastic = !model.is_inelastic() && model.pairs.is_empty() && model.motions.is_empty();
    let path = elastic.then(|| equilibrium_path(model, &PathSettings::default()).ok()).flatten()?;
    let direct = path.reached && path.limit_points.is_empty() && path.failures.is_empty();
    (direct && path.end.stable).then_some(path.end)
}

/// Beams that can slide with their active contacts closed.
fn sliding(structure: &Model, found: &Equilibrium) -> Vec<String> {
    let state = found.state.of_structure(structure);
    let layout = Layout::holding(structure, found.held.clone());
    let free = free_motions(&layout, &StaticSearch::at(structure, &state)).motions;
    let shifts = without(&free, |_, component| component >= 2);
    let slides = |beam: &&BeamData| moves(&shifts, beam);
    structure.beams.iter().filter(slides).map(|beam| beam.name.clone()).collect()
}

/// A fault for each beam that can move without strain despite supports and joints and cannot be supported otherwise: from the rank deficiency of
/// the stiffness matrix, for any stiffness and density.
///
/// Beams with a contact or a stop may rest on a body; [`equilibrium`] decides whether they do.
pub fn mechanisms(model: &Model) -> Vec<Fault> {
    let beams = model.beams.len();
    let apart = loose_ends(model);
    let mut touchable = vec![false; beams];
    for pair in model.pairs.iter().filter(|pair| takes_part(model, pair)) {
        pair.movers.iter().filter(|m| **m < beams).for_each(|m| touchable[*m] = true);
    }
    for stop in model.connectors.iter().filter(|c| c.law.may_give_way()) {
        stop.on_beams().for_each(|point| touchable[point.beam] = true);
    }
    let model = &model.structure();
    let rest = State::at_rest(model, crate::settings::Scheme::EnergyMomentum);
    let layout = Layout::new(model);
    let loose = free_motions(&layout, &StaticSearch::at(model, &rest)).motions;
    let loose = without(&loose, |node, _| {
        model.beams.iter().zip(&touchable).any(|(b, t)| *t && b.nodes.contains(&node))
    });
    let fault = |(index, beam): (usize, &BeamData)| {
        let mut found = format!("a mechanism: `{}` can move without strain", beam.name);
        let mut expected = "supports and joints that fix every beam".to_owned();
        if let Some(one) = apart.iter().find(|one| one.beams.contains(&index)) {
            let [a, b] = &one.ends;
            found += &format!(", and the coincident ends `{a}` and `{b}` are not connected");
            expected += &format!(": {}", one.joint());
        }
        Fault::new(format!("beam.{}", beam.name), found, expected)
    };
    let all = model.beams.iter().enumerate();
    all.filter(|(_, beam)| moves(&loose, beam)).map(fault).collect()
}

/// Motions, or their sums, with zero values of some components of nodes.
fn without(
    motions: &[Vec<[f64; 4]>],
    is_still: impl Fn(usize, usize) -> bool,
) -> Vec<Vec<[f64; 4]>> {
    const STILL: f64 = 1e-12;
    let n = motions.len();
    let product = |a: &[[f64; 4]], b: &[[f64; 4]]| {
        let product = |node: usize| {
            let still = (0..4).filter(|k| is_still(node, *k));
            still.map(|k| a[node][k] * b[node][k]).sum::<f64>()
        };
        (0..a.len()).map(product).sum::<f64>()
    };
    let gram = nalgebra::DMatrix::from_fn(n, n, |i, j| product(&motions[i], &motions[j]));
    let all: f64 = motions.iter().map(|x| inner(x, x)).sum();
    if gram.trace() == 0.0 {
        return motions.to_vec();
    }
    let eigen = nalgebra::SymmetricEigen::new(gram);
    let still = (0..n).filter(|k| eigen.eigenvalues[*k] <= STILL * all);
    let sum = |k: usize| {
        let mut out = vec![[0.0; 4]; motions[0].len()];
        for (x, share) in motions.iter().zip(eigen.eigenvectors.column(k).iter()) {
            for (out, x) in out.iter_mut().zip(x) {
                (0..4).for_each(|i| out[i] += share * x[i]);
            }
        }
        out
    };
    still.map(sum).collect()
}
