//! What has failed on the way to an equilibrium, and the forces that it gave, which are let go slowly.

use super::{Motions, StaticSearch, constraint_step};
use crate::analysis::spectrum::metric_of;
use crate::model::frozen::JointLoad;
use crate::step::joints;

/// Stiffness of an element that has parted, in the measure of [`metric_of`]: enough for a tangent where a piece hangs on nothing, and
/// no force.
const OF_A_GAP: f64 = 1e-6;

impl StaticSearch<'_> {
    /// Sets a share of the loads; what has torn stays so.
    pub fn set_share(&mut self, share: f64) {
        self.forcing.set_static(self.model, share);
        match &self.motions {
            Motions::Growing => {}
            Motions::LeftOut => self.forcing.rest_motions(),
            Motions::Left { time, followed } => self.forcing.leave(self.model, *time, followed),
        }
        self.forcing.part(self.model, &self.base.joints_parted);
    }

    /// What joints of a given strength carry where the search stands.
    pub fn joint_loads(&self) -> impl Iterator<Item = JointLoad> {
        let step = constraint_step(&self.base, &self.work.increment, &self.forcing);
        joints::loads(self.model, &step, &self.work.multiplier).collect::<Vec<_>>().into_iter()
    }

    /// Displacements where the search stands, shape (nodes, 4) \[m, -\].
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

    /// The weak stiffness of what has parted.
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

    /// Takes the forces that are unbalanced where the search stands for held: [`StaticSearch::let_go`] lets them go.
    pub fn withhold(&mut self) {
        self.withheld.clear();
        self.assemble::<false>();
        self.withheld.clone_from(&self.work.residual);
        self.let_go = 0.0;
    }

    /// Nothing is withheld any more.
    pub fn release(&mut self) {
        self.withheld.clear();
    }

    /// Takes what is withheld off the unbalanced forces.
    pub(super) fn hold_back(&mut self) {
        let share = 1.0 - self.let_go;
        for (r, held) in self.work.residual.iter_mut().zip(&self.withheld) {
            (0..4).for_each(|i| r[i] -= share * held[i]);
        }
    }
}
