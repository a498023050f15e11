//! Loads.

use super::super::time_function::TimeFunction;
use super::{Along, BeamId, PointRef};

/// Kind of a load.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadKind {
    /// Gravity on every beam, point mass and projectile.
    Gravity {
        /// Acceleration, shape (2) \[m/s^2\].
        acceleration: [f64; 2],
    },
    /// An acceleration of the base: of the ground, and of all supports and obstacles with it. Positions, displacements, velocities, energies and
    /// momenta are those against the base, so that nothing drifts away with it: everything that has mass is pushed the other way by
    /// mass times this acceleration. Reactions are those of the true motion. Outside the times of its table it is zero.
    Base {
        /// Acceleration of the base, shape (2) \[m/s^2\].
        acceleration: [f64; 2],
    },
    /// A force and a moment at a point of a beam.
    Point {
        /// The loaded point.
        at: PointRef,
        /// Force, shape (2) \[N\]; along (e1, e2), or along (tangent, normal) if it follows.
        force: [f64; 2],
        /// Moment, positive counter-clockwise \[N m\].
        moment: f64,
        /// Whether the force turns with the tangent.
        follower: bool,
    },
    /// A strain and a curvature that a stretch of a beam would take without forces, as by shrinkage.
    Strain {
        /// The beam.
        beam: BeamId,
        /// Ends of the stretch, shape (2).
        stretch: [Along; 2],
        /// Elongation per length, in the strain measure of the material \[-\].
        strain: f64,
        /// Change of the direction of the tangent per length, counter-clockwise along the beam \[1/m\].
        curvature: f64,
    },
    /// A change of the temperature of a stretch of a beam, from that of the reference configuration, with the expansion of its materials.
    Temperature {
        /// The beam.
        beam: BeamId,
        /// Ends of the stretch, shape (2).
        stretch: [Along; 2],
        /// Change on the axis \[K\].
        change: f64,
        /// Rise of the temperature per depth, along the normal to the left of the beam's direction: towards the top fibre \[K/m\].
        gradient: f64,
    },
    /// A force per length along a stretch of a beam, varying linearly between its ends.
    Distributed {
        /// The beam.
        beam: BeamId,
        /// Ends of the stretch, shape (2).
        stretch: [Along; 2],
        /// Force per length at both ends, shape (2, 2) \[N/m\]. Dead: along (e1, e2), per reference length. Follower: along (tangent,
        /// normal), per current length; a pressure is a follower along the normal.
        force: [[f64; 2]; 2],
        /// Whether it turns with the tangent.
        follower: bool,
    },
}

/// A load: its kind, times a function of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    /// The user's name for it.
    pub name: String,
    /// Its kind.
    pub kind: LoadKind,
    /// Its time function, beginning at `from`.
    pub function: TimeFunction,
    /// Acts from this time on \[s\].
    pub from: f64,
    /// Acts until this time \[s\]; infinity if it never ends.
    pub until: f64,
}

impl Load {
    /// A constant load of unlimited duration.
    pub fn new(name: impl Into<String>, kind: LoadKind) -> Self {
        let (from, until) = (0.0, f64::INFINITY);
        Self { name: name.into(), kind, function: TimeFunction::Constant, from, until }
    }
}
