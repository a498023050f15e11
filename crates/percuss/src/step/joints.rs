//! Loads of joints of a given strength over a step.

use super::constraint::ConstraintStep;
use super::forcing::Forcing;
use crate::math::vec2::norm;
use crate::model::Model;
use crate::model::frozen::{ConstraintKind, JointLoad};

/// Loads of the joints with a strength from the multipliers of their constraints, in the order of the model, shape (such joints).
pub fn loads(
    model: &Model,
    step: &ConstraintStep,
    multiplier: &[f64],
) -> impl Iterator<Item = JointLoad> {
    (0..model.joints.len()).map(move |joint| {
        let (mut force, mut moment) = ([0.0; 2], 0.0_f64);
        for (c, lambda) in model.constraints.iter().zip(multiplier) {
            if c.joint != Some(joint) {
                continue;
            }
            match &c.kind {
                ConstraintKind::Shared { direction, .. } => {
                    (0..2).for_each(|i| force[i] += lambda * direction[i]);
                }
                _ => moment += lambda * step.couple(c),
            }
        }
        JointLoad { force: norm(force), moment: moment.abs() }
    })
}

impl Forcing {
    /// Releases the constraints of failed joints.
    pub fn part(&mut self, model: &Model, parted: &[bool]) {
        for (flag, c) in self.constrained.iter_mut().zip(&model.constraints) {
            *flag &= !c.joint.is_some_and(|joint| parted[joint]);
        }
    }
}
