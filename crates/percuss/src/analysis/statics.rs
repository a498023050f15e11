//! Static equilibrium under the loads that act at time zero, and the mechanisms that keep a structure from having one.

use super::balance::{self, StaticBalance};
use super::course::StaticFirstYield;
use super::failure::StaticFailure;
use super::spectrum::{Held, Layout, Stability, free_motions, stability_about, stability_loaded};
use super::static_contacts::{StaticContact, takes_part};
use super::static_loading::Loading;
use super::static_search::{StaticSearch, largest};
use super::yields::{StaticYielding, at_rest};
use crate::error::Error;
use crate::frame::{Frame, FrameForce};
use crate::geometry::row::Row;
use crate::inspect::loose_ends;
use crate::model::frozen::BeamData;
use crate::model::{Fault, Model, StrainMeasure, TouchLaw};
use crate::state::State;
use crate::step::tangent::inner;
use crate::summary::SectionForceSummary;

/// Load steps, as a share of the load: small enough to stay on the branch that starts at rest where a beam has several
/// equilibria (a roll of one turn more or less).
const FIRST_STEP: f64 = 0.1;
/// A mechanism whose stops are open and that has moved by more than this share of its size is one that the loads have turned round, like a
/// weathervane, and no structure that stops hold.
const CARRIED_AWAY: f64 = 0.1;

/// A static equilibrium.
#[derive(Clone, Debug)]
pub struct Equilibrium {
    /// The state of equilibrium, at rest.
    pub state: State,
    /// Displacements of the recorded points, with their names, shape (points, 2) \[m\].
    pub points: Vec<(String, [f64; 2])>,
    /// Section forces of largest magnitude, one entry a beam, shape (beams).
    pub section_forces: Vec<SectionForceSummary>,
    /// Axial force, shear force and moment at the start and the end of every element, shape (elements, 2, 3) \[N, N, N m\].
    pub element_forces: Vec<[[f64; 3]; 2]>,
    /// Forces of everything that presses, on the second of its partners, shape (places where something presses).
    pub contact_forces: Vec<FrameForce>,
    /// Factors of the loads, in the model's order, shape (loads) \[-\].
    pub load_factors: Vec<f64>,
    /// Forces (1, 2) and moment of each support on the structure, with their names, shape (supports, 3) \[N, N m\].
    pub reactions: Vec<(String, [f64; 3])>,
    /// Contacts that take part, in the model's order, shape (contacts).
    pub contacts: Vec<StaticContact>,
    /// Contacts that press, with their forces, shape (pairs that press) \[N\].
    pub(crate) pressed: Vec<(Row, f64)>,
    /// Contacts of beams that press, as they stay closed in small motions, shape (pairs that press).
    pub(crate) held: Vec<Held>,
    /// Springs and hinges that can yield, in the model's order, shape (such springs and hinges).
    pub yielding: Vec<StaticYielding>,
    /// What has failed for good on the way, in its order, shape (such failures).
    pub failures: Vec<StaticFailure>,
    /// What all that acts from outside comes to.
    pub balance: StaticBalance,
    /// Where and under which share of the loads beams first yielded on the way to it, shape (beams); empty at the end of a path.
    pub first_yields: Vec<Option<StaticFirstYield>>,
    /// How many times faster with the loads than in the first load step nodes went where they went fastest: about one of a structure that
    /// stays elastic, and many of one that passes a plastic mechanism; not a number at the end of a path \[1\].
    pub softening: f64,
    /// Whether the structure returns to it: no motion about it grows.
    pub stable: bool,
    /// Beams that contacts alone hold and that can slide along all of them, by name: friction takes no part here, shape (such beams).
    pub sliding: Vec<String>,
    /// Load steps taken.
    pub load_steps: usize,
    /// Newton iterations.
    pub newton_iterations: usize,
}

impl Equilibrium {
    /// The equilibrium as a frame, for drawings.
    pub fn frame(&self) -> Frame<'_> {
        Frame {
            time: 0.0,
            displacement: &self.state.displacement,
            velocity: &self.state.velocity,
            spin: &self.state.spin,
            section_forces: &self.element_forces,
            contact_forces: &self.contact_forces,
            load_factors: &self.load_factors,
        }
    }
}

/// Static equilibrium of `model` under the loads that act at time zero, with the contacts a transient knows.
///
/// Newton's iteration in load steps, smaller ones where it does not converge. What fails on the way (fibres, springs, hinges, joints
/// of a given strength) does so at the load factor at which it bears its whole strength, and what it gave is let go slowly. Compliant contacts press by their potentials, rigid
/// ones as gap and force are complementary, all without friction. Guided projectiles and discs on their way take no part.
///
/// # Errors
/// Convergence lost even for small load steps: a limit point, or a load no equilibrium can carry. Something fails that leaves none.
/// A disc or a beam that nothing holds. One thing inside another before any load acts.
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
    loading.bring_up(&structure)?;
    let Loading { stable, steps, failures, course, .. } = loading;
    let mut found = finish(&mut search, steps);
    let moved = found.state.displacement.iter().map(|u| u[0].hypot(u[1])).fold(0.0, f64::max);
    if moved > CARRIED_AWAY * model.extent()
        && let Some(name) = loose(&search, &found.state)
    {
        return Err(Error::nothing_holds(name));
    }
    found.failures = failures;
    (found.softening, found.first_yields) = (course.softening(), course.first_yields);
    balance::check(&search, &found)?;
    found.stable =
        (stable && !search.contacts.press()) || stability(&structure, &mut search).stable;
    if search.contacts.holds_beams() {
        found.sliding = sliding(&structure, &found);
    }
    Ok(found)
}

/// Beams that can be shifted with what presses on them staying closed.
fn sliding(structure: &Model, found: &Equilibrium) -> Vec<String> {
    let state = found.state.of_structure(structure);
    let layout = Layout::holding(structure, found.held.clone());
    let free = free_motions(&layout, &StaticSearch::at(structure, &state)).motions;
    let shifts = without(&free, |_, component| component >= 2);
    let slides = |beam: &&BeamData| moves(&shifts, beam);
    structure.beams.iter().filter(slides).map(|beam| beam.name.clone()).collect()
}

/// Whether a beam takes part in any of the motions.
pub(super) fn moves(motions: &[Vec<[f64; 4]>], beam: &BeamData) -> bool {
    motions.iter().any(|x| largest(&x[beam.nodes.clone()]) > 1e-3 * largest(x))
}

/// Refuses what is inside something else before any load acts.
pub(super) fn refuse_overlaps(search: &StaticSearch) -> Result<(), Error> {
    let overlaps = search.model.overlaps(&search.base.displacement, |_| true);
    overlaps.first().map_or(Ok(()), |fault| Err(Error::overlap(fault.to_string())))
}

/// Whether the equilibrium reached is stable, by the tangent with which it is loaded on, what presses held closed; `structure` is the
/// beams alone.
pub(super) fn stability(structure: &Model, search: &mut StaticSearch) -> Stability {
    let told = |stable: bool| Stability { stable, negative: None };
    search.foresee(true);
    let press = search.contacts.press();
    if press && search.contacts.has_discs() {
        return told(search.is_stable_touching());
    }
    search.assemble::<true>();
    let state = search.state();
    let held = if press { search.contacts.held(search.model, &state) } else { Vec::new() };
    let alone = search.of_structure(structure, &state);
    if !search.model.is_inelastic() {
        return stability_about(structure, &alone, held);
    }
    if press {
        return told(search.is_stable_touching());
    }
    stability_loaded(structure, &alone, &search.work.tangent)
        .unwrap_or_else(|| told(search.is_stable_touching()))
}

/// The result at the increment reached.
pub(super) fn finish(search: &mut StaticSearch, load_steps: usize) -> Equilibrium {
    search.foresee(true);
    search.assemble::<false>();
    let mut state = search.state();
    search.contacts.remember_crushing(&mut state);
    let model = search.model;
    let at = |p: &crate::model::frozen::MaterialPoint| p.value(&state.displacement);
    let names = model.support_names().map(str::to_owned);
    let (section_forces, element_forces) = search.section_forces(&state);
    let reactions = search.reactions(&state);
    let balance = StaticBalance::new(search, &reactions);
    Equilibrium {
        points: model.points.iter().map(|p| (p.label.clone(), at(p))).collect(),
        section_forces,
        element_forces,
        contact_forces: search.contacts.frame_forces(model, &state),
        load_factors: search.forcing.factors.clone(),
        reactions: names.zip(reactions).collect(),
        contacts: search.contacts.results(model),
        pressed: search.contacts.forces().map(|(_, force, row)| (*row, force)).collect(),
        held: search.contacts.held(model, &state),
        yielding: at_rest(model, &state),
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
    structure.connectors.iter().any(|c| c.law.is_one_sided())
        && !free_motions(&layout, &StaticSearch::at(&structure, &rest)).motions.is_empty()
}

/// A beam that can move without being strained where the search stands, what is closed there closed; nothing
/// where contacts may hold it, or where there are no stops.
fn loose(search: &StaticSearch, state: &State) -> Option<String> {
    let structure = search.model.structure();
    let alone = search.of_structure(&structure, state);
    let free = free_motions(&Layout::new(&structure), &alone).motions;
    let stopped = structure.connectors.iter().any(|c| c.law.is_one_sided());
    let beam = structure.beams.iter().find(|beam| moves(&free, beam));
    beam.filter(|_| stopped && search.contacts.is_empty()).map(|beam| beam.name.clone())
}

/// Why no equilibrium follows the last one found.
pub(super) fn lost(search: &mut StaticSearch, share: f64) -> Error {
    let state = search.state();
    if let Some(name) = loose(search, &state) {
        return Error::nothing_holds(name);
    }
    let (forces, _) = search.section_forces(&state);
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
    let mut laws = search.model.contacts.iter().map(|contact| &contact.law);
    match laws.any(|law| matches!(law, TouchLaw::Rigid(_))) {
        true => Error::unsettled_contacts(share),
        false => Error::no_equilibrium(share),
    }
}

/// A fault for each beam that supports and joints leave free to move without strain and that nothing can be held by: what the rank
/// of the stiffness matrix lacks, whatever stiffness and density are.
///
/// Beams that have a contact or a stop may rest on something; whether they do [`equilibrium`] tells.
pub fn mechanisms(model: &Model) -> Vec<Fault> {
    let beams = model.beams.len();
    let apart = loose_ends(model);
    let mut touchable = vec![false; beams];
    for pair in model.pairs.iter().filter(|pair| takes_part(model, pair)) {
        pair.movers.iter().filter(|m| **m < beams).for_each(|m| touchable[*m] = true);
    }
    for stop in model.connectors.iter().filter(|c| c.law.is_one_sided()) {
        stop.attachments().for_each(|(_, (point, _))| touchable[point.beam] = true);
    }
    let model = &model.structure();
    let rest = State::at_rest(model, crate::settings::Scheme::EnergyMomentum);
    let layout = Layout::new(model);
    let loose = free_motions(&layout, &StaticSearch::at(model, &rest)).motions;
    let loose = without(&loose, |node, _| {
        model.beams.iter().zip(&touchable).any(|(b, t)| *t && b.nodes.contains(&node))
    });
    let fault = |(index, beam): (usize, &BeamData)| {
        let mut found = format!("a mechanism: `{}` can move without being strained", beam.name);
        let mut expected = "supports and joints that hold every beam".to_owned();
        if let Some(one) = apart.iter().find(|one| one.beams.contains(&index)) {
            let [a, b] = &one.ends;
            found += &format!(", and nothing joins `{a}` and `{b}`, which lie at one place");
            expected += &format!(": {}", one.joint());
        }
        Fault::new(format!("beam.{}", beam.name), found, expected)
    };
    let all = model.beams.iter().enumerate();
    all.filter(|(_, beam)| moves(&loose, beam)).map(fault).collect()
}

/// Those of the motions, or their sums, that leave some components of nodes at rest.
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
