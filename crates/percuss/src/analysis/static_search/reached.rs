//! Results of an equilibrium: its state, stability, section forces and reactions.

use super::{INVERSE_ITERATIONS, Motions, RULE, Reached, StaticSearch, constraint_step, largest};
use crate::analysis::section_forces::{self, Acting, Lines};
use crate::analysis::spectrum::{metric, random, size};
use crate::frame::SectionPoint;
use crate::linalg::block::inner;
use crate::math::vec2::{add, cross, scale};
use crate::model::Model;
use crate::model::frozen::{Connector, Coordinate, MaterialPoint};
use crate::state::State;
use crate::step::connectors::ConnectorStep;
use crate::step::tangent::project;
use crate::step::workspace::Workspace;
use crate::step::{connectors, external, fibres};
use crate::summary::{PointForces, SectionForceSummary};

/// Share of the largest displacement, and of the largest force, below which others are round-off.
const NOTHING: f64 = 1e-30;

/// Section forces of an equilibrium.
pub struct ReachedForces {
    /// Those of largest magnitude, shape (beams).
    pub beams: Vec<SectionForceSummary>,
    /// Those at the recorded points, shape (points).
    pub points: Vec<PointForces>,
    /// Axial force, shear force and moment at the ends of every element, shape (elements, 2, 3) \[N, N, N m\].
    pub ends: Vec<[[f64; 3]; 2]>,
    /// Vertices of the section forces along all elements, shape (vertices).
    pub vertices: Vec<SectionPoint>,
}

impl StaticSearch<'_> {
    /// The current equilibrium; plastic strains up to it are accepted.
    pub fn reached(&mut self) -> Reached {
        if self.model.is_inelastic() {
            let displacement = self.displacement();
            fibres::bring_to_rest(self.model, &displacement, &mut self.base.fibres);
            let State { coordinates, memories, .. } = &mut self.base;
            connectors::bring_to_rest(self.model, &displacement, coordinates, memories);
        }
        Reached {
            increment: self.work.increment.clone(),
            multiplier: self.work.multiplier.clone(),
            contacts: self.contacts.clone(),
            fibres: self.base.fibres.clone(),
            memories: self.base.memories.clone(),
            joints_parted: self.base.joints_parted.clone(),
            parted: self.base.parted.clone(),
        }
    }

    /// Sets displacements and forces of constraints that are round-off to zero: in a part without load, such as one behind a joint that has failed,
    /// Newton's corrections become ever smaller. The residual must be that of the current configuration.
    pub fn clear_round_off(&mut self) {
        let clear = |values: &mut [f64], most: f64| {
            values.iter_mut().filter(|x| x.abs() < NOTHING * most).for_each(|x| *x = 0.0);
        };
        let moved = largest(&self.displacement());
        let work = &mut self.work;
        clear(work.increment.as_flattened_mut(), moved);
        let force = work.multiplier.iter().fold(largest(&work.residual), |m, x| m.max(x.abs()));
        clear(&mut work.multiplier, force);
    }

    /// Returns to a stored configuration.
    pub fn go_back(&mut self, place: &Reached) {
        self.work.increment.copy_from_slice(&place.increment);
        self.work.multiplier.copy_from_slice(&place.multiplier);
        self.contacts.clone_from(&place.contacts);
        self.base.fibres.clone_from(&place.fibres);
        self.base.memories.clone_from(&place.memories);
        self.base.joints_parted.clone_from(&place.joints_parted);
        if self.base.parted != place.parted {
            self.base.parted.clone_from(&place.parted);
            self.weigh_gaps();
        }
        self.foresee(true);
    }

    /// Whether all motions about the current equilibrium are stable, with closed contacts kept closed: by the sign of the lowest eigenvalue of the
    /// tangent, found by inverse iteration.
    pub fn is_stable_touching(&mut self) -> bool {
        let model = self.model;
        self.foresee(true);
        self.contacts.hold();
        self.assemble::<true>();
        self.contacts.without_springs(&mut self.work.tangent);
        // Normalised by stiffness: density has no influence.
        let mut mass = metric(model, false);
        self.contacts.measure_bodies(&mut mass, model);
        let longest = model.beams.iter().map(|b| b.length).fold(0.0, f64::max);
        let shift = if longest > 0.0 { (size(model) / longest).powi(4) } else { 1.0 };
        self.work.tangent.chain_mut().add_scaled(&mass, shift);
        if self.factor_assembled().is_err() {
            return false;
        }
        let mut x = random(model.node_count(), &mut 1);
        project(model, &mut x);
        let mut lowest = f64::INFINITY;
        for _ in 0..INVERSE_ITERATIONS {
            let mut y = mass.multiply(&x);
            let weight = inner(&x, &y);
            self.work.tangent.solve_linear(model, &mut y);
            // The inverse's Rayleigh quotient.
            let inverse = inner(&mass.multiply(&x), &y) / weight;
            lowest = 1.0 / inverse - shift;
            let size = inner(&y, &mass.multiply(&y)).sqrt();
            y.as_flattened_mut().iter_mut().for_each(|c| *c /= size);
            x = y;
        }
        lowest > -1e-6 * shift
    }

    /// A search of the beams alone at the state reached, under the same loads.
    pub fn of_structure<'s>(&self, structure: &'s Model, state: &State) -> StaticSearch<'s> {
        let mut alone = StaticSearch::at(structure, &state.of_structure(structure));
        alone.forcing.clone_from(&self.forcing);
        alone.forcing.hold_motions();
        alone
    }

    /// Loads at the current configuration, without weights: nodal forces, shape (nodes, 2) \[N\].
    pub fn applied(&mut self) -> Vec<[f64; 2]> {
        let Self { model, base, work, forcing, .. } = self;
        let mut nodal = vec![[0.0; 4]; model.node_count()];
        let (increment, tangent) = (&work.increment, &mut work.tangent);
        external::apply::<false>(model, base, forcing, &RULE, increment, &mut nodal, tangent);
        nodal.iter().map(|f| [-f[0], -f[1]]).collect()
    }

    /// Forces of connector `i` at the current configuration.
    pub fn connector_step(&self, i: usize, connector: &Connector) -> ConnectorStep {
        connector.step(i, &RULE, &self.forcing, &self.base, &self.work.increment)
    }

    /// The state reached, at rest.
    pub fn state(&self) -> State {
        let mut state = State { displacement: self.displacement(), ..self.base.clone() };
        state.multiplier.clone_from(&self.work.multiplier);
        if self.model.gives_strains() {
            state.strained.clone_from(&self.forcing.factors);
        }
        let step = |(c, q0): (&Connector, &f64)| {
            let moved = match &c.coordinate {
                Coordinate::Displacement { drive, .. } => {
                    self.forcing.start(drive) + self.forcing.increment(drive)
                }
                _ => 0.0,
            };
            c.value(&state.displacement, *q0) - moved
        };
        state.coordinates =
            self.model.connectors.iter().zip(&self.base.coordinates).map(step).collect();
        if let Motions::Growing = self.motions {
            // Supports have moved to where motions begin.
            state.followed.iter_mut().for_each(|followed| followed.origin = 0.0);
        }
        state.strain.clear();
        self.contacts.enter(&mut state);
        state
    }

    /// Section forces in the state reached.
    pub fn section_forces(&mut self, state: &State) -> ReachedForces {
        self.assemble::<false>();
        let Workspace { increment, beams, .. } = &self.work;
        let acting =
            Acting { state: &self.base, increment, rule: &RULE, beams, forcing: &self.forcing };
        let (mut lines, mut beams) = (Lines::default(), section_forces::unset(self.model));
        let pressed = self.contacts.forces().map(|(_, force, row)| ([row; 2], [force, 0.0]));
        let pushed = self.push.as_ref().map(|push| ([&push.row; 2], [push.force, 0.0]));
        let pressed = pressed.chain(pushed);
        lines.set(self.model, &acting, pressed);
        section_forces::update(self.model, &lines, state, &mut beams);
        section_forces::ordered(&mut beams);
        let at = |point| section_forces::at_point(self.model, &lines, state, point);
        let mut vertices = Vec::new();
        lines.vertices(self.model, &beams, &mut vertices);
        ReachedForces {
            vertices,
            beams,
            points: self.model.points.iter().map(at).collect(),
            ends: lines.ends(self.model.element_count()).collect(),
        }
    }

    /// Force and moment of each support on the structure; the residual must be that of the state reached.
    pub fn reactions(&self, state: &State) -> Vec<[f64; 3]> {
        let (model, work) = (self.model, &self.work);
        let mut out = vec![[0.0; 3]; model.supports.len()];
        let mut enter = |support: Option<usize>, force: [f64; 2], moment: f64| {
            if let Some(s) = support {
                out[s] = [out[s][0] + force[0], out[s][1] + force[1], out[s][2] + moment];
            }
        };
        let g_at = |p: &MaterialPoint| add(p.tangent, p.gradient(&state.displacement));
        for dofs in &model.prescribed {
            let mut r = [0.0; 4];
            for n in &dofs.normals {
                let along: f64 = (0..4).map(|k| n[k] * work.residual[dofs.node][k]).sum();
                (0..4).for_each(|k| r[k] += along * n[k]);
            }
            let u = &state.displacement[dofs.node];
            let g = add(model.nodes[dofs.node].tangent, [u[2], u[3]]);
            enter(dofs.support, [r[0], r[1]], cross(g, [r[2], r[3]]));
        }
        let step = constraint_step(&self.base, &work.increment, &self.forcing);
        for (c, multiplier) in model.constraints.iter().zip(&work.multiplier) {
            let (form, gradient) = step.support_form(c);
            let force = scale(-multiplier, form);
            if gradient {
                enter(c.support, [0.0; 2], cross(g_at(&c.points()[0]), force));
            } else {
                enter(c.support, force, 0.0);
            }
        }
        for (i, c) in model.connectors.iter().enumerate() {
            let step = self.connector_step(i, c);
            let force = scale(-step.force, step.forms[0]);
            match &c.coordinate {
                Coordinate::Angle { a, .. } => enter(c.support, [0.0; 2], cross(g_at(a), force)),
                _ => enter(c.support, force, 0.0),
            }
        }
        self.contacts.add_reactions(model, &mut out);
        out
    }
}
