//! Failed parts in a static search, and their forces, which are released gradually.

use super::{Motions, StaticSearch, constraint_step};
use crate::analysis::spectrum::metric_of;
use crate::model::frozen::JointLoad;
use crate::step::joints;

/// Stiffness of a fractured element, in the measure of [`metric_of`]: enough for a regular tangent with an unsupported piece, and without a force.
const OF_A_GAP: f64 = 1e-6;

impl StaticSearch<'_> {
    /// Sets a share of the loads, or the force of a push beside all of them \[N\]; torn joints remain torn.
    pub fn set_share(&mut self, share: f64) {
        let loads = match &mut self.push {
            Some(push) => {
                push.force = share;
                1.0
            }
            None => share,
        };
        self.forcing.set_static(self.model, loads);
        match &self.motions {
            Motions::Growing => {}
            Motions::LeftOut => self.forcing.rest_motions(),
            Motions::Left { time, followed } => self.forcing.leave(self.model, *time, followed),
        }
        self.forcing.part(self.model, &self.base.joints_parted);
    }

    /// Forces of joints of a given strength at the current configuration.
    pub fn joint_loads(&self) -> impl Iterator<Item = JointLoad> {
        let step = constraint_step(&self.base, &self.work.increment, &self.forcing);
        joints::loads(self.model, &step, &self.work.multiplier).collect::<Vec<_>>().into_iter()
    }

    /// Displacements at the current configuration, shape (nodes, 4) \[m, -\].
    pub fn displacement(&self) -> Vec<[f64; 4]> {
        let both = self.base.displacement.iter().zip(&self.work.increment);
        both.map(|(u, d)| std::array::from_fn(|i| u[i] + d[i])).collect()
    }

    /// Tears a joint of a given strength.
    pub fn tear(&mut self, joint: usize) {
        self.base.joints_parted[joint] = true;
        self.forcing.part(self.model, &self.base.joints_parted);
        for (c, multiplier) in self.model.constraints.iter().zip(&mut self.work.multiplier) {
            if c.joint == Some(joint) {
                *multiplier = 0.0;
            }
        }
    }

    /// Parts a beam at the element that starts at a node.
    pub fn part_beam(&mut self, node: usize) {
        self.base.part(self.model, node);
        self.weigh_gaps();
    }

    /// The weak stiffness of fractured elements.
    pub(super) fn weigh_gaps(&mut self) {
        self.gaps = None;
        if self.base.parted.is_empty() {
            return;
        }
        let mut gaps = metric_of(self.model, false, |a| self.base.has_parted(a));
        for block in [&mut gaps.diag, &mut gaps.upper, &mut gaps.lower] {
            block.as_flattened_mut().as_flattened_mut().iter_mut().for_each(|k| *k *= OF_A_GAP);
        }
        self.gaps = Some(gaps);
    }

    /// Holds the forces that are unbalanced at the current configuration: [`StaticSearch::let_go`] releases them.
    pub fn withhold(&mut self) {
        self.withheld.clear();
        self.assemble::<false>();
        self.withheld.clone_from(&self.work.residual);
        self.let_go = 0.0;
    }

    /// Ends the holding of forces.
    pub fn release(&mut self) {
        self.withheld.clear();
    }

    /// Subtracts the held forces from the unbalanced forces.
    pub(super) fn hold_back(&mut self) {
        let share = 1.0 - self.let_go;
        for (r, held) in self.work.residual.iter_mut().zip(&self.withheld) {
            (0..4).for_each(|i| r[i] -= share * held[i]);
        }
    }
}
