//! Rotation of the gradient of a gap with its nodes.

use super::configuration::Configuration;
use super::pair::Pair;
use super::row::Row;
pub use super::row::Turning;
use super::touch::{Bend, COINCIDENT, Touch};
use crate::math::vec2::{dot, rot90, scale};

impl Pair {
    /// Rotation of the gap's gradient with its nodes; `None` where it is constant. The contribution of points off an axis is in
    /// [`Pair::section_turnings`].
    ///
    /// With A the motion across the normal and O the rotation of the axis at the closest point, both as forms, the second derivative of the gap is
    /// `A (x) A / d` at a distance d from a fixed closest point. One that slides by `(l A + d O) / (l^2 - d n.x'')`, l = across . x', contributes
    /// its share (theory, page 8). An edge that rotates by O gives `A (x) O + O (x) A - d O (x) O`.
    pub fn turning(&self, touch: &Touch, at: &Configuration) -> Option<Turning> {
        let turns = match touch.bend {
            Bend::Flat => false,
            Bend::Round { distance } => distance.abs() > COINCIDENT,
            Bend::Edge { .. } | Bend::Curve { .. } => true,
        };
        if !turns {
            return None;
        }
        let n = touch.normal;
        let across = rot90(n);
        let mut forms = [Row::default(); 2];
        self.source.add_force(&mut forms[0], across, at);
        touch.closest.add_force(&mut forms[0], scale(-1.0, across), at);
        let weights = match touch.bend {
            Bend::Round { distance } => [[1.0 / distance, 0.0], [0.0; 2]],
            Bend::Edge { distance } => {
                touch.closest.add_turn(&mut forms[1], 1.0, at);
                [[0.0, 1.0], [1.0, -distance]]
            }
            Bend::Curve { distance, tangent, bend } => {
                // Across the normal; on a tapered beam the tangent is not.
                let level = dot(across, tangent);
                let turns = dot(n, bend);
                let slack = level * level - distance * turns;
                if slack <= 1e-3 * level * level {
                    return None;
                }
                touch.closest.add_slope(&mut forms[1], n);
                let mixed = -level / slack;
                [[-turns / slack, mixed], [mixed, -distance / slack]]
            }
            Bend::Flat => return None,
        };
        Some(Turning { forms, weights })
    }

    /// Contribution of the rotation of sections if source or closest point are off an axis.
    pub fn section_turnings(&self, touch: &Touch, at: &Configuration) -> [Option<Turning>; 2] {
        let n = touch.normal;
        [self.source.turning(n, at), touch.closest.turning(scale(-1.0, n), at)]
    }
}
