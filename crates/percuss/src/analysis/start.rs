//! Where a transient analysis starts: configuration, velocities, accelerations.

use super::simulation::Simulation;
use super::static_search::StaticSearch;
use super::statics::{equilibrium, mechanisms};
use crate::contact::effective_mass;
use crate::error::Error;
use crate::math::vec2::{dot, rot90, scale};
use crate::model::frozen::{BeamData, Body, BodyKind};
use crate::model::{Fault, InitialMotion, Model};
use crate::settings::{Settings, Start};
use crate::state::State;
use crate::step::commit;
use crate::step::tangent::project_node;

/// The reference configuration at rest, that of a beam in flight too: as it would vibrate at rest.
///
/// # Errors
/// What overlaps.
pub fn reference_state(model: &Model) -> Result<State, Vec<Fault>> {
    let mut state = Simulation::about(model, &Settings::new(1.0, 1.0))?.state().clone();
    state.velocity.fill([0.0; 4]);
    state.spin.iter_mut().for_each(|spin| spin.fill(0.0));
    Ok(state)
}

impl Simulation<'_> {
    /// Gives the beams initial velocities \[m/s\]: `velocity(beam, position)` at the nodes of each beam. Slope rates are those
    /// of a rigid motion between neighbouring nodes. Opens the books anew.
    pub fn set_velocities(&mut self, velocity: impl Fn(&str, [f64; 2]) -> [f64; 2]) {
        for beam in &self.model.beams {
            for span in &self.model.spans[beam.spans.clone()] {
                for n in span.nodes.clone() {
                    let x = |k: usize| self.model.nodes[k].position;
                    let v = velocity(&beam.name, x(n));
                    let (a, b) = if n + 1 < span.nodes.end { (n, n + 1) } else { (n - 1, n) };
                    let (va, vb) = (velocity(&beam.name, x(a)), velocity(&beam.name, x(b)));
                    let l =
                        span.stations[b - span.nodes.start] - span.stations[a - span.nodes.start];
                    let target = &mut self.state.velocity[n];
                    *target = [v[0], v[1], (vb[0] - va[0]) / l, (vb[1] - va[1]) / l];
                }
            }
        }
        self.settle_velocities();
        self.open();
    }

    /// Gives beams and masses the rigid motion of the model, about the configuration they stand in.
    pub(super) fn start_moving(&mut self) {
        let motion = self.model.initial_motion;
        if motion == InitialMotion::default() {
            return;
        }
        let state = &mut self.state;
        let beams = self.model.beam_node_count();
        let nodes = self.model.nodes[..beams].iter();
        for ((node, u), v) in nodes.zip(&state.displacement).zip(&mut state.velocity) {
            let x = [0, 1].map(|i| node.position[i] + u[i] - motion.about[i]);
            let g = [0, 1].map(|i| node.tangent[i] + u[2 + i]);
            let (x, g) = (scale(motion.spin, rot90(x)), scale(motion.spin, rot90(g)));
            *v = [motion.velocity[0] + x[0], motion.velocity[1] + x[1], g[0], g[1]];
        }
        self.settle_velocities();
    }

    fn settle_velocities(&mut self) {
        crate::step::tangent::project(self.model, &mut self.state.velocity);
        commit::spin_from_velocity(self.model, &mut self.state);
    }

    /// Turns every velocity round: without losses the motion runs back. Opens the books anew.
    pub fn reverse(&mut self) {
        for v in &mut self.state.velocity {
            *v = v.map(|c| -c);
        }
        for w in &mut self.state.spin {
            *w = w.map(|c| -c);
        }
        for w in &mut self.state.mass_spin {
            *w = -*w;
        }
        self.state.step = 0;
        self.state.time = 0.0;
        self.open();
    }

    /// Accelerations under the loads and stresses of the initial state.
    pub(super) fn initial_acceleration(&mut self) {
        let model = self.model;
        let step = self.settings.step;
        self.forcing.set(model, 0.0, step, step, &self.state.followed);
        let forcing = &self.forcing;
        let (structure, beams) = (model.structure(), model.beam_node_count());
        let state = self.state.of_structure(&structure);
        let Ok(mut mass) = effective_mass::mass_matrix(&structure, &state.displacement) else {
            return;
        };
        let mut search = StaticSearch::at(&structure, &state);
        search.forcing.clone_from(forcing);
        search.forcing.rest_motions();
        search.work.multiplier.fill(0.0);
        search.assemble::<false>();
        let mut force = search.work.residual;
        for f in &mut force {
            *f = f.map(|c| -c);
        }
        mass.solve_linear(&structure, &mut force);
        // Bodies fall freely: nothing touches, and no spring is pressed.
        let falling =
            |b: &Body| if b.kind == BodyKind::Obstacle { [0.0; 2] } else { forcing.gravity };
        force.extend(model.bodies.iter().map(falling).map(|g| [g[0], g[1], 0.0, 0.0]));
        for hold in model.holds.iter().filter(|h| h.node >= beams) {
            project_node(hold, &mut force[hold.node]);
        }
        self.state.acceleration = force;
    }
}

/// A fault for each beam without mass. Inertia is all that tells a velocity from the forces: where a node has none its
/// velocity is no result, whatever the step.
pub(super) fn massless(model: &Model) -> Vec<Fault> {
    let without = |beam: &&BeamData| {
        model.spans[beam.spans.clone()].iter().any(|s| s.tables.iter().any(|t| t.mass[0][0] == 0.0))
    };
    let fault = |beam: &BeamData| {
        let found =
            format!("no mass: the nodes of `{}` have no inertia to move in time with", beam.name);
        let expected = "a density above zero for a run in time (statics and modes do without)";
        Fault::new(format!("beam.{}", beam.name), found, expected)
    };
    model.beams.iter().filter(without).map(fault).collect()
}

/// The reference configuration or static equilibrium, projectiles as far from it as they stand off, and its reactions.
pub(super) fn initial_state(
    model: &Model,
    settings: &Settings,
) -> Result<(State, Vec<[f64; 3]>), Vec<Fault>> {
    let mut state = State::at_rest(model, settings.scheme);
    let mut reactions = vec![[0.0; 3]; model.supports.len()];
    if settings.start == Start::Static {
        let fault = |e: Error| {
            let found = format!("loads that no equilibrium was found for ({e})");
            vec![Fault::new(
                "time.start",
                found,
                "loads at time zero that the structure carries at rest",
            )]
        };
        let loose = mechanisms(model);
        if !loose.is_empty() {
            return Err(loose);
        }
        let found = equilibrium(model).map_err(fault)?;
        reactions = found.reactions.iter().map(|(_, r)| *r).collect();
        let found = found.state;
        state.displacement.copy_from_slice(&found.displacement);
        state.multiplier = found.multiplier;
        state.coordinates = found.coordinates;
        // Projectiles stand off from where their points have moved to.
        for p in &model.projectiles {
            let moved = dot(p.direction, p.point.value(&state.displacement));
            for node in (0..=usize::from(p.has_rear)).map(|k| model.body_node(p.body + k)) {
                let [x, y] = scale(moved, p.direction);
                state.displacement[node] = [x, y, 0.0, 0.0];
            }
        }
        if !state.strain.is_empty() {
            stored_strains(model, &mut state);
        }
    }
    Ok((state, reactions))
}

/// Stores the strains of the configuration, for the scheme that keeps them.
fn stored_strains(model: &Model, state: &mut State) {
    let structure = model.structure();
    let mut search = StaticSearch::at(&structure, &state.of_structure(&structure));
    search.foresee(true);
    state.strain = search.base.strain;
}
