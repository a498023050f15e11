//! Dead loads: nodal forces and forces on projectiles, for a factor of one and in a step, and their work and impulse.

use std::collections::BTreeMap;

use super::engine::Engine;
use super::numbers::LoadNumbers;
use percuss::Model;
use percuss::internals::ledger::{Ledger, StepWork};
use percuss::internals::model::frozen::LoadAction;
use percuss::internals::scalar::{Number, array};
use percuss::math::vec2::{dot, scale, sub};

/// A load for a factor of one, or the property for which it is not a dead load.
pub fn dead_load(model: &Model, action: &LoadAction) -> Result<LoadNumbers<f64>, &'static str> {
    let mut on_nodes = BTreeMap::<usize, [f64; 4]>::new();
    let mut add = |node: usize, force: [f64; 4]| {
        let sum = on_nodes.entry(node).or_default();
        (0..4).for_each(|i| sum[i] += force[i]);
    };
    let mut on_guides = vec![[0.0; 2]; model.projectiles.len()];
    match action {
        LoadAction::Gravity { acceleration: g } => {
            for (span, k, a, _) in model.each_element() {
                for (node, force) in span.table(k).uniform_force(a, *g) {
                    add(node, force);
                }
            }
            for (force, projectile) in on_guides.iter_mut().zip(&model.projectiles) {
                *force = g.map(|g| model.bodies[projectile.body].mass * g);
            }
        }
        LoadAction::Point { point, force: [f1, f2], moment, follower: false } if *moment == 0.0 => {
            let [n0, n1, n2, n3] = point.shape;
            add(point.node, [n0 * f1, n0 * f2, n1 * f1, n1 * f2]);
            add(point.node + 1, [n2 * f1, n2 * f2, n3 * f1, n3 * f2]);
        }
        LoadAction::Dead { nodal, .. } => nodal.iter().for_each(|(node, force)| add(*node, *force)),
        _ => return Err("moments, and loads that turn with the beam"),
    }
    let (nodes, forces) = on_nodes.into_iter().unzip();
    Ok(LoadNumbers { nodes, forces, on_guides })
}

impl<S: Number> Engine<S> {
    /// Forces of the loads with their factors.
    #[inline(always)]
    pub fn apply_loads(&mut self) {
        let zero = self.h.constant(0.0);
        for applied in &mut self.applied {
            *applied = [zero; 4];
        }
        for guide in &mut self.guides {
            guide.applied = [zero; 2];
        }
        for (load, factor) in self.numbers.loads.iter().zip(&self.load_factors) {
            for (n, force) in load.nodes.iter().zip(&load.forces) {
                for i in 0..4 {
                    self.applied[*n][i] = self.applied[*n][i].add_product(*factor, force[i]);
                }
            }
            for (guide, force) in self.guides.iter_mut().zip(&load.on_guides) {
                for i in 0..2 {
                    guide.applied[i] = guide.applied[i].add_product(*factor, force[i]);
                }
            }
        }
    }

    /// Subtracts them from the residual.
    #[inline(always)]
    pub fn resist_loads(&mut self) {
        for (residual, applied) in self.residual.iter_mut().zip(&self.applied) {
            for i in 0..4 {
                residual[i] = residual[i] - applied[i];
            }
        }
    }
}

impl<S: Number> Engine<S> {
    /// Enters work and impulse of the loads over the step.
    #[inline(always)]
    pub fn enter_loads(&self, ledger: &mut Ledger<S>) {
        if self.numbers.loads.is_empty() {
            return;
        }
        let (h, zero) = (self.h, self.h.constant(0.0));
        let mut sum = StepWork::none(h);
        for (n, force) in self.applied.iter().enumerate() {
            sum.add_nodal(force, self.middle(n), &self.increment[n], h);
        }
        for (guide, state) in self.numbers.guides.iter().zip(&self.guides) {
            let way = state.way + state.increment * 0.5;
            let x: [S; 2] = array(|i| guide.position[i] + guide.direction[i] * way);
            sum.add_force(state.applied, x, scale(state.increment, guide.direction), h);
            // The guide carries the component across the line of motion.
            let along = dot(guide.direction, state.applied);
            ledger.react(h, x, sub(scale(along, guide.direction), state.applied), zero);
        }
        ledger.load(&sum);
    }
}
