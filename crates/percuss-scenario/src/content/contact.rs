//! Obstacles and contacts.

use percuss::Sides;

use super::function::{Function, FunctionText};
use super::law::Law;
use crate::format::{Count, Maybe, Pair};
use crate::measure;
use crate::node::{Body, Reader};
use crate::partner::{Partner, PartnerName};
use crate::point::{Point, PointText};
use crate::quantity::{Quantity, Vector};
use crate::table::Braces;
use crate::words::{SidesOf, Word};
use crate::write::Writer;

kinds! {
    /// Shape of an obstacle.
    pub enum ObstacleKind by "kind" {
        /// Everything behind a straight line.
        HalfPlane = "half-plane" {
            /// A point of the line (m).
            point: [f64; 2] as Vector<measure::Length>,
            /// Outward normal of the obstacle.
            normal: [f64; 2] as Vector<measure::Ratio>,
        },
        /// A wall of finite length with round ends, with contact on both sides.
        Wall = "wall" {
            /// Its ends (m).
            ends: [[f64; 2]; 2] as Pair<Vector<measure::Length>>,
            /// Thickness (m).
            thickness: f64 as Quantity<measure::Length> = 0.0,
        },
        /// A disc.
        Disc = "disc" {
            /// Centre (m).
            centre: [f64; 2] as Vector<measure::Length>,
            /// Radius (m).
            radius: f64 as Quantity<measure::Length>,
        },
        /// A support of finite width around a beam, with clearance.
        Clearance = "clearance" {
            /// The point of the beam in the middle of it.
            at: Point as PointText,
            /// Extent along the beam (m).
            width: f64 as Quantity<measure::Length>,
            /// Initial gap between the surface of the beam and either side (m).
            gap: f64 as Quantity<measure::Length>,
            /// Sides of the beam on which it is.
            sides: Sides as Word<SidesOf> = Sides::Both,
        },
    }
}

table! {
    /// Obstacle: fixed, or with prescribed motion.
    pub struct Obstacle {
        /// Prescribed motion, from the reference configuration; fixed if none is given.
        motion: Option<Shift> as Maybe<Braces<Shift>> = None,
    }
    with {
        /// Its shape.
        kind: ObstacleKind
    }
}

table! {
    /// Prescribed motion of an obstacle: an amplitude times a function of time.
    pub struct Shift {
        /// Displacement (m).
        displacement: [f64; 2] as Vector<measure::Length> = [0.0, 0.0],
        /// Its time function: "constant" or a table { kind = ... }.
        function: Function as FunctionText = Function::Constant,
    }
    not {
        rotation: "a `displacement`: an obstacle does not turn",
    }
}

table! {
    /// Contact between two bodies.
    pub struct Contact {
        /// Their names: beams, obstacles, projectiles with contact = "surface"; twice the same beam for one that touches itself.
        between: [Partner; 2] as Pair<PartnerName>,
        /// Contact points in each element of a beam, except for contact with projectiles.
        points_per_element: usize as Count = percuss::Contact::POINTS_PER_ELEMENT,
    }
    with {
        /// Contact law: compliant ("linear", "hertz", "table", "given") or rigid (nonsmooth).
        law: Law
    }
}
