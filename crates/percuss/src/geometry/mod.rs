//! Geometry of contact: round bodies and their targets, the closest point of a target, the gap and its derivatives.
//!
//! It is independent of the model: positions of beams are provided through [`Axes`].

pub mod axis;
pub mod configuration;
pub mod dents;
pub mod edge;
pub mod pair;
pub mod placed;
pub mod row;
pub mod touch;
pub mod turning;

use crate::element::beam::NodeFrame;
use axis::AxisElements;

/// The axes of all beams in the reference configuration.
pub trait Axes {
    /// Frames of all nodes, shape (nodes).
    fn frames(&self) -> &[NodeFrame];

    /// Elements of the axis of a beam.
    fn axis(&self, beam: usize) -> &AxisElements;
}
