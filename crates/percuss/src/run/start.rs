//! Start of a transient analysis: configuration, velocities, accelerations.

use std::ops::Range;

use super::solving::jumps;
use crate::analysis::static_contacts::hangs;
use crate::analysis::static_search::{stored_strains, unbalanced_forces};
use crate::analysis::{Equilibrium, equilibrium, mechanisms};
use crate::math::vec2::{dot, rot90, scale};
use crate::model::frozen::{BeamData, Body, Coordinate, Drive};
use crate::model::{Fault, InitialMotion, Model};
use crate::settings::{Settings, Start};
use crate::state::State;
use crate::step::contacts::PressingPair;
use crate::step::effective_mass;
use crate::step::forcing::Forcing;
use crate::step::{commit, fibres, given_strains, lead};

/// Values of motions below this share of the size of the model are round-off.
const NOT_MOVED: f64 = 1e-12;

/// Sets initial velocities of the beams \[m/s\]: `velocity(beam, position)` at the nodes of each beam. Slope rates are those of a rigid motion
/// between neighbouring nodes. Steps have the size `step`.
pub fn set_velocities(
    model: &Model,
    step: f64,
    state: &mut State,
    velocity: impl Fn(&str, [f64; 2]) -> [f64; 2],
) {
    for beam in &model.beams {
        for span in &model.spans[beam.spans.clone()] {
            for n in span.nodes.clone() {
                let x = |k: usize| model.nodes[k].position;
                let v = velocity(&beam.name, x(n));
                let (a, b) = if n + 1 < span.nodes.end { (n, n + 1) } else { (n - 1, n) };
                let (va, vb) = (velocity(&beam.name, x(a)), velocity(&beam.name, x(b)));
                let l = span.stations[b - span.nodes.start] - span.stations[a - span.nodes.start];
                let target = &mut state.velocity[n];
                *target = [v[0], v[1], (vb[0] - va[0]) / l, (vb[1] - va[1]) / l];
            }
        }
    }
    settle_velocities(model, step, state);
}

/// Sets the rigid motion of the model for beams and masses, about their current configuration.
pub fn start_moving(model: &Model, step: f64, state: &mut State) {
    if model.is_still() {
        return;
    }
    move_nodes(model, state, 0..model.beam_node_count(), &model.initial_motion);
    for (nodes, motion) in &model.own_motions {
        move_nodes(model, state, nodes.clone(), motion);
    }
    if !model.own_motions.is_empty() && !model.constraints.is_empty() {
        join_velocities(model, state);
    }
    settle_velocities(model, step, state);
}

fn move_nodes(model: &Model, state: &mut State, range: Range<usize>, motion: &InitialMotion) {
    let nodes = model.nodes[range.clone()].iter();
    let both = nodes.zip(&state.displacement[range.clone()]);
    for ((node, u), v) in both.zip(&mut state.velocity[range]) {
        let x = [0, 1].map(|i| node.position[i] + u[i] - motion.about[i]);
        let g = [0, 1].map(|i| node.tangent[i] + u[2 + i]);
        let (x, g) = (scale(motion.spin, rot90(x)), scale(motion.spin, rot90(g)));
        *v = [motion.velocity[0] + x[0], motion.velocity[1] + x[1], g[0], g[1]];
    }
}

/// Connected parts whose initial motions violate their joints start with the nearest admissible ones, in the measure of kinetic energy: those after
/// impulses in the joints.
fn join_velocities(model: &Model, state: &mut State) {
    let structure = model.structure();
    let own = state.of_structure(&structure);
    let Ok(mut mass) = effective_mass::mass_matrix(&structure, &own.displacement) else {
        return;
    };
    let band = effective_mass::mass_band(&structure, &own.displacement);
    let mut velocity = band.multiply(&own.velocity);
    mass.solve_linear(&structure, &mut velocity);
    for (own, joined) in state.velocity.iter_mut().zip(velocity) {
        *own = joined;
    }
}

fn settle_velocities(model: &Model, step: f64, state: &mut State) {
    crate::step::tangent::project(model, &mut state.velocity);
    // Motions at the start were prescribed before: fixed components have their velocities.
    for (function, followed) in model.motions.iter().zip(&mut state.followed) {
        followed.rate = jumps::rate_after(function, 0.0, step);
    }
    let beams = model.beam_node_count();
    for dofs in model.prescribed.iter().filter(|h| h.node < beams) {
        for (normal, drive) in dofs.normals.iter().zip(&dofs.drives) {
            let along: f64 = drive.iter().map(|(m, a)| a * state.followed[*m].rate).sum();
            (0..4).for_each(|k| state.velocity[dofs.node][k] += along * normal[k]);
        }
    }
    commit::spin_from_velocity(model, state);
}

/// Reverses every velocity, at the beginning of a run.
pub fn reverse(state: &mut State) {
    for v in &mut state.velocity {
        *v = v.map(|c| -c);
    }
    for w in &mut state.spin {
        *w = w.map(|c| -c);
    }
    for w in &mut state.mass_spin {
        *w = -*w;
    }
    state.step = 0;
    state.time = 0.0;
}

/// Accelerations under the loads and stresses of the initial state, in which contacts press with the forces given.
pub fn initial_acceleration(model: &Model, step: f64, state: &mut State, pressed: &[PressingPair]) {
    let mut forcing = Forcing::new(model);
    forcing.set(model, (0.0, step, 0.5), step, &state.followed);
    forcing.set_loads_at(model, 0.0, step);
    let forcing = &forcing;
    let (structure, beams) = (model.structure(), model.beam_node_count());
    let own = state.of_structure(&structure);
    let Ok(mut mass) = effective_mass::mass_matrix(&structure, &own.displacement) else {
        return;
    };
    let mut force = unbalanced_forces(&structure, &own, forcing);
    // Prescribed accelerations are taken to the other side.
    let mut prescribed = vec![[0.0; 4]; beams];
    for dofs in structure.prescribed.iter() {
        for (normal, drive) in dofs.normals.iter().zip(&dofs.drives) {
            let along = forcing.second_rate_at_start(model, drive, step);
            (0..4).for_each(|k| prescribed[dofs.node][k] += along * normal[k]);
        }
    }
    let mut inertia = vec![[0.0; 4]; beams];
    lead::add_inertia_of(&structure, &own.displacement, &prescribed, &mut inertia);
    for (f, m) in force.iter_mut().zip(&inertia) {
        (0..4).for_each(|k| f[k] -= m[k]);
    }
    let mut contact_forces = vec![[0.0; 4]; model.node_count()];
    pressed.iter().for_each(|one| one.row.spread(one.force, &mut contact_forces));
    for (f, contact) in force.iter_mut().zip(&contact_forces) {
        (0..4).for_each(|i| f[i] += contact[i]);
    }
    mass.solve_linear(&structure, &mut force);
    for (f, a) in force.iter_mut().zip(&prescribed) {
        (0..4).for_each(|k| f[k] += a[k]);
    }
    // Bodies fall freely, except for the contact forces of an equilibrium: no spring is compressed.
    let falling = |b: &Body| if b.kind.is_obstacle() { [0.0; 2] } else { forcing.gravity };
    force.extend(model.bodies.iter().map(falling).map(|g| [g[0], g[1], 0.0, 0.0]));
    for (body, (a, f)) in
        model.bodies.iter().zip(force[beams..].iter_mut().zip(&contact_forces[beams..]))
    {
        if body.mass > 0.0 {
            (0..2).for_each(|i| a[i] += f[i] / body.mass);
        }
    }
    for dofs in model.prescribed.iter().filter(|h| h.node >= beams) {
        dofs.project(&mut force[dofs.node]);
    }
    state.acceleration = force;
}

/// A fault for each beam without mass, which statics and modes support but no run in time. Velocities depend on inertia: the velocity of a node
/// without inertia is no result, for any step.
pub fn massless(model: &Model) -> Vec<Fault> {
    let without = |beam: &&BeamData| {
        model.spans[beam.spans.clone()].iter().any(|s| s.tables.iter().any(|t| t.mass[0][0] == 0.0))
    };
    let fault = |beam: &BeamData| {
        let found = format!("no mass: the nodes of `{}` have no inertia", beam.name);
        let expected = "a density above zero for a run in time (statics and modes do without)";
        Fault::new(format!("beam.{}", beam.name), found, expected)
    };
    model.beams.iter().filter(without).map(fault).collect()
}

/// Start of a run.
pub struct Initial {
    pub state: State,
    /// Reactions of the supports, shape (supports, 3) \[N, N m\].
    pub reactions: Vec<[f64; 3]>,
    /// Contacts of an equilibrium that press, with their forces, shape (such contacts) \[N\]; empty for the reference configuration.
    pub pressed: Vec<PressingPair>,
}

/// The reference configuration, in which supports have not moved.
pub fn reference(model: &Model, settings: &Settings) -> Initial {
    let mut state = State::at_rest(model, settings.scheme);
    state.strained = given_strains::factors_at(model, 0.0);
    let reactions = vec![[0.0; 3]; model.supports.len()];
    Initial { state, reactions, pressed: Vec::new() }
}

/// The reference configuration or static equilibrium, with projectiles at their standoff from it, and its reactions.
///
/// Supports are where their prescribed motions begin, as in statics: where that is not in their reference, the structure starts in equilibrium with
/// them, without loads unless the start is a static one.
pub fn initial_state(model: &Model, settings: &Settings) -> Result<Initial, Vec<Fault>> {
    let mut initial = reference(model, settings);
    if settings.start == Start::Static {
        let loose = mechanisms(model);
        if !loose.is_empty() {
            return Err(loose);
        }
        let found = equilibrium(model).map_err(|e| {
            let found = format!("loads without an equilibrium ({e})");
            let expected = "loads at time zero that the structure carries at rest";
            vec![Fault::new("time.start", found, expected)]
        })?;
        start_from(model, found, &mut initial);
    } else if let Some(support) = moved_at_start(model) {
        let mut unloaded = model.structure();
        unloaded.loads.clear();
        let refused = |why: &str| {
            let found = format!("not zero at time zero, and {why}");
            let expected = "a function that begins at zero: the structure starts at rest where its supports are";
            vec![Fault::new(format!("support.{support}.motion"), found, expected)]
        };
        if !mechanisms(&unloaded).is_empty() {
            return Err(refused("supports and joints do not fix every beam"));
        }
        let found = equilibrium(&unloaded).map_err(|e| refused(&format!("no equilibrium: {e}")))?;
        start_from(model, found, &mut initial);
        initial.state = initial.state.with_coordinates(model);
    }
    Ok(initial)
}

/// A support whose prescribed motion has another value than zero at time zero, by name.
fn moved_at_start(model: &Model) -> Option<&str> {
    let values: Vec<f64> = model.motions.iter().map(|function| function.value(0.0)).collect();
    let least = NOT_MOVED * model.extent().max(f64::MIN_POSITIVE);
    let moves = |drive: &Drive| {
        drive.iter().map(|(motion, amplitude)| amplitude * values[*motion]).sum::<f64>().abs()
            > least
    };
    let beams = model.beam_node_count();
    let held = model.prescribed.iter().filter(|dofs| dofs.node < beams);
    let held = held.filter(|dofs| dofs.drives.iter().any(moves)).map(|dofs| dofs.support);
    let tied = model.constraints.iter().filter(|c| moves(&c.drive)).map(|c| c.support);
    let sprung = model.connectors.iter().filter(
        |c| matches!(&c.coordinate, Coordinate::Displacement { drive, .. } if moves(drive)),
    );
    let supports = held.chain(tied).chain(sprung.map(|c| c.support));
    supports.flatten().map(|support| model.supports[support].name.as_str()).next()
}

/// Enters an equilibrium as the start of a run; one of the structure alone leaves bodies and contacts as they are.
fn start_from(model: &Model, found: Equilibrium, initial: &mut Initial) {
    initial.reactions = found.reactions.iter().map(|(_, r)| *r).collect();
    initial.pressed = found.pressed;
    let (state, found) = (&mut initial.state, found.state);
    state.displacement[..found.displacement.len()].copy_from_slice(&found.displacement);
    state.followed.iter_mut().for_each(|followed| followed.origin = 0.0);
    state.multiplier = found.multiplier;
    state.coordinates = found.coordinates;
    state.fibres = found.fibres;
    let parted: Vec<usize> = fibres::parted(model, &state.fibres).collect();
    parted.into_iter().for_each(|node| state.part(model, node));
    state.memories = found.memories;
    state.joints_parted = found.joints_parted;
    if found.pairs.len() == state.pairs.len() {
        state.pairs = found.pairs;
    }
    // Standoffs of projectiles are relative to the moved points; those on springs are in equilibrium where they are.
    for p in model.projectiles.iter().filter(|p| !hangs(model, p.body)) {
        let moved = dot(p.direction, p.point.value(&state.displacement));
        for node in (0..=usize::from(p.has_rear)).map(|k| model.body_node(p.body + k)) {
            let [x, y] = scale(moved, p.direction);
            state.displacement[node] = [x, y, 0.0, 0.0];
        }
    }
    if !state.strain.is_empty() {
        keep_strains(model, state);
    }
}

/// Stores the strains of the configuration, for the scheme with stored strains.
fn keep_strains(model: &Model, state: &mut State) {
    let structure = model.structure();
    state.strain = stored_strains(&structure, &state.of_structure(&structure));
}
