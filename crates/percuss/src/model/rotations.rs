//! Rotations of recorded points: of the sections there, counter-clockwise from the reference.

use std::f64::consts::TAU;

use super::frozen::Model;
use super::point::MaterialPoint;
use crate::math::vec2::{add, cross, dot};

impl Model {
    /// Rotations of the recorded points under these displacements, shape (points) \[rad\]: they begin within half a turn at the start of
    /// each beam and are continuous along it, so that a strip that is rolled up has turned more than once at its end.
    pub(crate) fn rotations(&self, displacement: &[[f64; 4]]) -> Vec<f64> {
        let along = |point: &MaterialPoint| {
            let before = self.beams[point.beam].nodes.start..=point.node;
            let angle = before.fold(0.0, |angle, node| {
                let ([_, _, a, b], t) = (displacement[node], self.nodes[node].tangent);
                continued(turn(t, add(t, [a, b])), angle)
            });
            continued(point.rotation(displacement), angle)
        };
        self.points.iter().map(along).collect()
    }
}

impl MaterialPoint {
    /// Rotation of the section there, within half a turn \[rad\].
    pub(crate) fn rotation(&self, displacement: &[[f64; 4]]) -> f64 {
        turn(self.tangent, add(self.tangent, self.gradient(displacement)))
    }
}

/// An angle that is known but for whole turns, as near to another one as these allow \[rad\].
pub(crate) fn continued(angle: f64, near: f64) -> f64 {
    angle + TAU * ((near - angle) / TAU).round()
}

/// Angle from one direction to another, within half a turn \[rad\].
fn turn(from: [f64; 2], to: [f64; 2]) -> f64 {
    cross(from, to).atan2(dot(from, to))
}
