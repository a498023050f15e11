//! Loads.

use percuss::Along;

use super::function::{Function, FunctionText};
use crate::format::{Flag, Maybe, Pair};
use crate::measure;
use crate::name::{BeamName, NameOf};
use crate::node::{Body, Reader};
use crate::point::{Place, Point, PointText};
use crate::quantity::{Quantity, Vector};
use crate::words::{OrEndless, Until};
use crate::write::Writer;

kinds! {
    /// Kind of a load.
    pub enum LoadKind by "kind" {
        /// Gravity on every beam, point mass and projectile.
        Gravity = "gravity" {
            /// Acceleration (m/s^2).
            acceleration: [f64; 2] as Vector<measure::Acceleration>,
        },
        /// A force and a moment at a point.
        Point = "point" {
            /// The point loaded.
            at: Point as PointText,
            /// Force (N): along e1 and e2, or along tangent and normal if it follows.
            force: [f64; 2] as Vector<measure::Force> = [0.0, 0.0],
            /// Moment, positive counter-clockwise (N m).
            moment: f64 as Quantity<measure::Moment> = 0.0,
            /// Whether the force turns with the tangent.
            follower: bool as Flag = false,
        },
        /// A force per length along a stretch of a beam, varying linearly between its ends.
        Distributed = "distributed" {
            /// Name of the beam.
            on: String as NameOf<BeamName>,
            /// Ends of the stretch: each "start", "mid", "end", a fraction or a length.
            stretch: [Along; 2] as Pair<Place> = [Along::Fraction(0.0), Along::Fraction(1.0)],
            /// Force per length at the start of the stretch (N/m): along e1 and e2, or along tangent and normal
            /// if it follows; a pressure follows along the normal.
            force: [f64; 2] as Vector<measure::LineForce>,
            /// Force per length at the end of the stretch (N/m); the same if none is given.
            force_end: Option<[f64; 2]> as Maybe<Vector<measure::LineForce>> = None,
            /// Whether the force turns with the tangent.
            follower: bool as Flag = false,
        },
    }
}

table! {
    /// A load, times a function of time while it acts.
    pub struct Load {
        /// Start of the load (s).
        from: f64 as Quantity<measure::Time> = 0.0,
        /// End of the load (s), or "forever".
        until: f64 as OrEndless<Until> = f64::INFINITY,
        /// Its time function, with the time since `from`: "constant" or a table { kind = ... }.
        function: Function as FunctionText = Function::Constant,
    }
    with {
        /// Its kind.
        kind: LoadKind
    }
}
