//! Supports, joints, springs and point masses.

use percuss::Component;

use super::function::{Function, FunctionText};
use super::yielding::{HingeHardening, SpringHardening, settle_connector_yield};
use crate::format::{Flag, List, Maybe, Pair};
use crate::measure;
use crate::node::{Body, Reader};
use crate::point::{Anchor, AnchorText, JointEnd, Point, PointText};
use crate::quantity::{Quantity, Vector};
use crate::table::Braces;
use crate::words::{Held, OrEndless, Until};
use crate::write::Writer;

kinds! {
    /// Kind of a support.
    pub enum SupportKind by "kind" {
        /// Fixes both displacements and the rotation of the tangent; the stretch is free.
        Clamp = "clamp",
        /// Fixes both displacements.
        Pin = "pin",
        /// Fixes the displacement across `direction`.
        Roller = "roller" {
            /// Direction along which it rolls freely.
            direction: [f64; 2] as Vector<measure::Ratio> = [1.0, 0.0],
        },
        /// Partial fixity: fixes the listed degrees of freedom.
        Fix = "fix" {
            /// Degrees of freedom that are fixed: 1, 2 (displacements), "rotation", "stretch".
            components: Vec<Component> as List<Held>,
        },
        /// Springs and dampers between the point and its place in the reference configuration.
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
        /// One-sided spring (stop) that acts once the point has moved by `gap` along `direction`.
        Stop = "stop" {
            /// Direction of motion that is stopped.
            direction: [f64; 2] as Vector<measure::Ratio>,
            /// Initial gap in the reference configuration (m).
            gap: f64 as Quantity<measure::Length> = 0.0,
            /// Stiffness of the stop (N/m).
            stiffness: f64 as Quantity<measure::Stiffness>,
            /// Whether motion against `direction` is stopped after the same gap.
            two_sided: bool as Flag = false,
        },
    }
}

table! {
    /// A support to ground.
    pub struct Support {
        /// The supported point.
        at: Point as PointText,
        /// Active until this time (s), or "forever".
        until: f64 as OrEndless<Until> = f64::INFINITY,
        /// Prescribed motion of the fixed components, from the reference configuration; at rest if none is given. Where it is not zero at time zero,
        /// the structure starts in equilibrium with it.
        motion: Option<Motion> as Maybe<Braces<Motion>> = None,
    }
    with {
        /// Its kind.
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
    /// Kind of a joint.
    pub enum JointKind by "kind" {
        /// Rigid: common position, constant angle between the beams.
        Rigid = "rigid",
        /// Hinge: common position, free rotation, with a rotational spring and damper if given.
        Hinge = "hinge" {
            /// Stiffness against a change of the angle (N m).
            stiffness: f64 as Quantity<measure::TurnStiffness> = 0.0,
            /// Damping of a change of the angle (N m s).
            damping: f64 as Quantity<measure::TurnDamping> = 0.0,
            /// Yield moment (N m); elastic if omitted.
            yield_moment: Option<f64> as Maybe<Quantity<measure::Moment>> = None,
            /// Hardening with plastic rotation; perfectly plastic if omitted.
            hardening: Option<HingeHardening> as Maybe<Braces<HingeHardening>> = None,
            /// Rotation, to either side, at which its spring fails permanently (rad); no failure if omitted.
            failure_rotation: Option<f64> as Maybe<Quantity<measure::Angle>> = None,
        },
    }
}

table! {
    /// Breakaway strength of a joint.
    pub struct JointStrength {
        /// Largest force (N); no limit if omitted.
        force: Option<f64> as Maybe<Quantity<measure::Force>> = None,
        /// Largest moment, of a rigid joint (N m); no limit if omitted.
        moment: Option<f64> as Maybe<Quantity<measure::Moment>> = None,
    }
}

table! {
    /// A joint between two beams.
    pub struct Joint {
        /// The two connected points of beams, which must coincide. A projectile is connected by a stiff spring.
        between: [Point; 2] as Pair<JointEnd>,
        /// Breakaway strength: the joint fails after a step whose mean force or moment exceeds it; no failure if omitted.
        strength: Option<JointStrength> as Maybe<Braces<JointStrength>> = None,
    }
    with {
        /// Its kind.
        kind: JointKind
    }
    then settle_joint
}

fn settle_joint(joint: &mut Joint, body: &Body<'_>, reader: &mut Reader<'_>) {
    if !matches!(joint.kind, JointKind::Hinge { .. }) {
        return; // these keys belong to another kind, which is reported
    }
    settle_connector_yield(["yield_moment", "hardening", "failure_rotation"], body, reader);
}

kinds! {
    /// How the force of a spring follows from its extension.
    pub enum SpringLaw by "law" default "linear" {
        /// In proportion to it: it pulls and pushes.
        Linear = "linear" {
            /// Stiffness (N/m).
            stiffness: f64 as Quantity<measure::Stiffness>,
            /// Yield force, in tension and compression (N); elastic if omitted.
            yield_force: Option<f64> as Maybe<Quantity<measure::Force>> = None,
            /// Hardening with plastic extension; perfectly plastic if omitted.
            hardening: Option<SpringHardening> as Maybe<Braces<SpringHardening>> = None,
            /// Extension or shortening, from the unstrained length, at which it fails permanently (m); no failure if omitted.
            failure_extension: Option<f64> as Maybe<Quantity<measure::Length>> = None,
        },
        /// Tension only, from a slack on: ropes, hooks, slender braces; stiffness times the extension beyond the slack.
        Tension = "tension" {
            /// Stiffness (N/m).
            stiffness: f64 as Quantity<measure::Stiffness>,
            /// Extension up to which it is slack (m).
            slack: f64 as Quantity<measure::Length> = 0.0,
        },
        /// Compression only, behind a gap: buffers, clearances; stiffness times the shortening beyond the gap.
        Compression = "compression" {
            /// Stiffness (N/m).
            stiffness: f64 as Quantity<measure::Stiffness>,
            /// Shortening up to which it is open (m).
            gap: f64 as Quantity<measure::Length> = 0.0,
        },
        /// Along straight lines between given values; beyond the first and the last one the force keeps its value there.
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
        /// Unstrained length (m); that of the reference configuration if none is given.
        length: Option<f64> as Maybe<Quantity<measure::Length>> = None,
        /// Breaking force, damper included (N): the spring fails after a step whose mean force is larger in magnitude; without it it does not break.
        strength: Option<f64> as Maybe<Quantity<measure::Force>> = None,
    }
    with {
        /// Its law: how the force follows from the extension, which is the distance of its ends less `length`.
        law: SpringLaw
    }
    then settle_spring
}

fn settle_spring(spring: &mut Spring, body: &Body<'_>, reader: &mut Reader<'_>) {
    if !matches!(spring.law, SpringLaw::Linear { .. }) {
        return; // these keys belong to another law, which is reported
    }
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
