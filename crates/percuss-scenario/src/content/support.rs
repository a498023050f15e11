//! What holds beams: supports, joints, springs; and the masses they carry.

use percuss::Component;

use super::function::{Function, FunctionText};
use super::yielding::{HingeHardening, SpringHardening, settle_connector_yield};
use crate::format::{Flag, List, Maybe, Pair};
use crate::measure;
use crate::node::{Body, Reader};
use crate::point::{Anchor, AnchorText, Point, PointText};
use crate::quantity::{Quantity, Vector};
use crate::table::Braces;
use crate::words::{Held, OrEndless, Until};
use crate::write::Writer;

kinds! {
    /// What a support holds.
    pub enum SupportKind by "kind" {
        /// Holds both displacements and the direction of the tangent; the stretch stays free.
        Clamp = "clamp",
        /// Holds both displacements.
        Pin = "pin",
        /// Holds the displacement across `direction`.
        Roller = "roller" {
            /// Direction along which it rolls freely.
            direction: [f64; 2] as Vector<measure::Ratio> = [1.0, 0.0],
        },
        /// Holds the listed components.
        Fix = "fix" {
            /// Components held: 1, 2 (displacements), "rotation", "stretch".
            components: Vec<Component> as List<Held>,
        },
        /// Springs and dampers between the point and where it was in the reference configuration.
        Elastic = "elastic" {
            /// First axis of the springs; the second is across it.
            direction: [f64; 2] as Vector<measure::Ratio> = [1.0, 0.0],
            /// Stiffness along and across `direction` (N/m).
            stiffness: [f64; 2] as Vector<measure::Stiffness> = [0.0, 0.0],
            /// Damping along and across `direction` (N s/m).
            damping: [f64; 2] as Vector<measure::Damping> = [0.0, 0.0],
            /// Stiffness against rotation of the tangent (N m).
            rotational_stiffness: f64 as Quantity<measure::TurnStiffness> = 0.0,
            /// Damping of the rotation of the tangent (N m s).
            rotational_damping: f64 as Quantity<measure::TurnDamping> = 0.0,
        },
        /// A spring that pushes back once the point has moved by `gap` along `direction`.
        Stop = "stop" {
            /// Direction of motion that is stopped.
            direction: [f64; 2] as Vector<measure::Ratio>,
            /// Free way in the reference configuration (m).
            gap: f64 as Quantity<measure::Length> = 0.0,
            /// Stiffness of the stop (N/m).
            stiffness: f64 as Quantity<measure::Stiffness>,
            /// Whether motion against `direction` is stopped after the same way.
            two_sided: bool as Flag = false,
        },
    }
}

table! {
    /// A support to ground.
    pub struct Support {
        /// The point held.
        at: Point as PointText,
        /// Holds until this time (s), or "forever".
        until: f64 as OrEndless<Until> = f64::INFINITY,
        /// Prescribed motion of what is held; at rest if none is given.
        motion: Option<Motion> as Maybe<Braces<Motion>> = None,
    }
    with {
        /// What it holds.
        kind: SupportKind
    }
}

table! {
    /// Prescribed motion of a support: amplitudes times a function of time.
    pub struct Motion {
        /// Displacement (m).
        displacement: [f64; 2] as Vector<measure::Length> = [0.0, 0.0],
        /// Rotation of the tangent, positive counter-clockwise (rad).
        rotation: f64 as Quantity<measure::Angle> = 0.0,
        /// Its time function: "constant" or a table { kind = ... }.
        function: Function as FunctionText = Function::Constant,
    }
}

kinds! {
    /// What a joint shares.
    pub enum JointKind by "kind" {
        /// Position shared, angle between the beams kept.
        Rigid = "rigid",
        /// Position shared.
        Hinge = "hinge" {
            /// Stiffness against a change of the angle (N m).
            stiffness: f64 as Quantity<measure::TurnStiffness> = 0.0,
            /// Damping of a change of the angle (N m s).
            damping: f64 as Quantity<measure::TurnDamping> = 0.0,
            /// Moment at which it yields (N m); without it the hinge is elastic.
            yield_moment: Option<f64> as Maybe<Quantity<measure::Moment>> = None,
            /// How the yield moment grows with plastic rotation; perfectly plastic without.
            hardening: Option<HingeHardening> as Maybe<Braces<HingeHardening>> = None,
            /// Rotation, to either side, at which its spring fails for good (rad); it does not without.
            failure_rotation: Option<f64> as Maybe<Quantity<measure::Angle>> = None,
        },
    }
}

table! {
    /// What a joint carries at most.
    pub struct JointStrength {
        /// Size of the force (N); any without.
        force: Option<f64> as Maybe<Quantity<measure::Force>> = None,
        /// Size of the moment, of a rigid joint (N m); any without.
        moment: Option<f64> as Maybe<Quantity<measure::Moment>> = None,
    }
}

table! {
    /// A joint between two beams.
    pub struct Joint {
        /// The two points joined; they must lie at the same place.
        between: [Point; 2] as Pair<PointText>,
        /// What it carries at most: after a step over which the mean force or moment was larger it holds no longer; it never parts without.
        strength: Option<JointStrength> as Maybe<Braces<JointStrength>> = None,
    }
    with {
        /// What is shared.
        kind: JointKind
    }
    then settle_joint
}

fn settle_joint(_: &mut Joint, body: &Body<'_>, reader: &mut Reader<'_>) {
    settle_connector_yield(["yield_moment", "hardening", "failure_rotation"], body, reader);
}

kinds! {
    /// How the force of a spring follows from its extension: the distance of its ends less the length without force.
    pub enum SpringLaw by "law" default "linear" {
        /// In proportion to it: it pulls and pushes.
        Linear = "linear" {
            /// Stiffness (N/m).
            stiffness: f64 as Quantity<measure::Stiffness>,
        },
        /// Tension only, from a slack on: ropes, hooks, slender braces.
        Tension = "tension" {
            /// Stiffness (N/m).
            stiffness: f64 as Quantity<measure::Stiffness>,
            /// Extension up to which it is slack (m).
            slack: f64 as Quantity<measure::Length> = 0.0,
        },
        /// Compression only, behind a gap: buffers, clearances.
        Compression = "compression" {
            /// Stiffness (N/m).
            stiffness: f64 as Quantity<measure::Stiffness>,
            /// Shortening up to which it is open (m).
            gap: f64 as Quantity<measure::Length> = 0.0,
        },
        /// Along straight lines between given values, and on beyond the first and the last one.
        Table = "table" {
            /// Extensions, increasing; shortenings are negative (m).
            extensions: Vec<f64> as List<Quantity<measure::Length>>,
            /// Forces there (N), positive in tension, zero without extension; they may fall.
            forces: Vec<f64> as List<Quantity<measure::Force>>,
        },
    }
}

table! {
    /// A spring and damper between two points; it acts along the line between them.
    pub struct Spring {
        /// Its ends: points on beams, names of projectiles (their centres), or places on the ground as [x, y] (m).
        between: [Anchor; 2] as Pair<AnchorText>,
        /// Damping (N s/m); of a spring of tension or compression alone it acts where the spring does.
        damping: f64 as Quantity<measure::Damping> = 0.0,
        /// Length without force (m); that of the reference configuration if none is given.
        length: Option<f64> as Maybe<Quantity<measure::Length>> = None,
        /// Magnitude of the force, its damper's included, at which it breaks (N): after a step over which the mean was larger it is gone; it never
        /// does without.
        strength: Option<f64> as Maybe<Quantity<measure::Force>> = None,
        /// Force at which it yields, in tension and compression (N), of a linear one; without it the spring is elastic.
        yield_force: Option<f64> as Maybe<Quantity<measure::Force>> = None,
        /// How the yield force grows with plastic extension; perfectly plastic without.
        hardening: Option<SpringHardening> as Maybe<Braces<SpringHardening>> = None,
        /// Extension or shortening, from the length without force, at which it fails for good (m); it does not without.
        failure_extension: Option<f64> as Maybe<Quantity<measure::Length>> = None,
    }
    with {
        /// Its law.
        law: SpringLaw
    }
    then settle_spring
}

fn settle_spring(_: &mut Spring, body: &Body<'_>, reader: &mut Reader<'_>) {
    settle_connector_yield(["yield_force", "hardening", "failure_extension"], body, reader);
}

table! {
    /// A mass at a point of a beam.
    pub struct PointMass {
        /// The point that carries it.
        at: Point as PointText,
        /// Mass (kg).
        mass: f64 as Quantity<measure::Mass>,
        /// Moment of inertia about the point, turning with the tangent (kg m^2).
        rotary_inertia: f64 as Quantity<measure::MassInertia> = 0.0,
    }
}
