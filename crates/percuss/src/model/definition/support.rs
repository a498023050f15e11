//! Supports, joints, springs, point masses, and the motion a structure starts in.

use super::super::time_function::TimeFunction;
use super::{Plasticity, PointRef};

/// A component of the motion of a beam's point that a support can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Displacement along e1.
    Displacement1,
    /// Displacement along e2.
    Displacement2,
    /// Direction of the tangent (fixed by a clamp in addition to the displacements).
    Rotation,
    /// Slope component along the reference tangent.
    Stretch,
}

/// Kind of a support.
#[derive(Clone, Debug, PartialEq)]
pub enum SupportKind {
    /// Both displacements and the direction of the tangent; the stretch stays free.
    Clamp,
    /// Both displacements.
    Pin,
    /// The displacement across `direction`, along which the support rolls freely.
    Roller {
        /// Direction of free motion, shape (2) \[-\]; need not be of unit length.
        direction: [f64; 2],
    },
    /// The listed components.
    Fix {
        /// Components held, shape (components held).
        components: Vec<Component>,
    },
    /// Springs and dampers between the point and where it was in the reference configuration.
    Elastic {
        /// First axis of the springs, shape (2) \[-\]; need not be of unit length. The second is across it.
        direction: [f64; 2],
        /// Stiffness along and across `direction`, shape (2) \[N/m\].
        stiffness: [f64; 2],
        /// Damping along and across `direction`, shape (2) \[N s/m\].
        damping: [f64; 2],
        /// Stiffness against rotation of the tangent \[N m\].
        rotational_stiffness: f64,
        /// Damping of the rotation of the tangent \[N m s\].
        rotational_damping: f64,
    },
    /// A spring that acts after a displacement of the point by `gap` along `direction`.
    Stop {
        /// Direction of motion that is stopped, shape (2) \[-\]; need not be of unit length.
        direction: [f64; 2],
        /// Free way in the reference configuration \[m\].
        gap: f64,
        /// Stiffness of the stop \[N/m\].
        stiffness: f64,
        /// Whether motion against `direction` is stopped after the same way.
        two_sided: bool,
    },
}

/// Prescribed motion of the fixed components: amplitudes times a function of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Displacement, shape (2) \[m\].
    pub displacement: [f64; 2],
    /// Rotation of the tangent, positive counter-clockwise \[rad\].
    pub rotation: f64,
    /// Its time function.
    pub function: TimeFunction,
}

/// A support to ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Support {
    /// The user's name for it.
    pub name: String,
    /// The point held.
    pub at: PointRef,
    /// Kind of support.
    pub kind: SupportKind,
    /// Prescribed motion; at rest if there is none.
    pub motion: Option<Motion>,
    /// Holds until this time \[s\]; infinity if for ever.
    pub until: f64,
}

impl Support {
    /// A support at rest that holds for ever.
    pub fn new(name: impl Into<String>, at: PointRef, kind: SupportKind) -> Self {
        Self { name: name.into(), at, kind, motion: None, until: f64::INFINITY }
    }
}

/// How two beams are joined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// Positions shared and the angle between the tangents kept.
    Rigid,
    /// Positions shared.
    Hinge,
    /// Positions shared, with a spring and a damper between the tangents.
    ElasticHinge {
        /// Stiffness against a change of the angle \[N m\].
        stiffness: f64,
        /// Damping of a change of the angle \[N m s\].
        damping: f64,
    },
}

/// Strength of a joint: it fails after a step in which its load has exceeded it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointStrength {
    /// Size of the force \[N\]; any if none is given.
    pub force: Option<f64>,
    /// Size of the moment, of a rigid joint \[N m\]; any if none is given.
    pub moment: Option<f64>,
}

/// A joint between two points of beams, which must coincide in the reference configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The user's name for it.
    pub name: String,
    /// Kind of connection.
    pub kind: JointKind,
    /// The two points joined, shape (2).
    pub between: [PointRef; 2],
    /// Yield law of an elastic hinge, if any: moments \[N m\] and rotations \[rad\] in place of stresses and strains.
    pub yielding: Option<Plasticity>,
    /// Strength, if any: of a rigid joint or a hinge without a spring.
    pub strength: Option<JointStrength>,
}

impl Joint {
    /// A joint that neither yields nor parts.
    pub fn new(name: impl Into<String>, kind: JointKind, between: [PointRef; 2]) -> Self {
        Self { name: name.into(), kind, between, yielding: None, strength: None }
    }
}

/// An end of a spring.
#[derive(Clone, Debug, PartialEq)]
pub enum Anchor {
    /// A point of a beam.
    Point(PointRef),
    /// A point fixed in space, shape (2) \[m\].
    Ground([f64; 2]),
}

/// A spring and damper between two points, in tension and compression along the line between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// The user's name for it.
    pub name: String,
    /// Its ends, shape (2).
    pub between: [Anchor; 2],
    /// Stiffness \[N/m\].
    pub stiffness: f64,
    /// Damping \[N s/m\].
    pub damping: f64,
    /// Length without force \[m\]; that of the reference configuration if none is given.
    pub length: Option<f64>,
    /// Yield law, if any: forces \[N\] and extensions \[m\] in place of stresses and strains.
    pub yielding: Option<Plasticity>,
}

/// A mass at a point of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct PointMass {
    /// The user's name for it.
    pub name: String,
    /// The point that carries it.
    pub at: PointRef,
    /// Mass \[kg\].
    pub mass: f64,
    /// Moment of inertia about the point, turning with the tangent \[kg m^2\].
    pub rotary_inertia: f64,
}

/// Rigid motion in which all beams and point masses start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InitialMotion {
    /// Velocity of the point `about`, shape (2) \[m/s\].
    pub velocity: [f64; 2],
    /// Angular velocity, positive counter-clockwise \[rad/s\].
    pub spin: f64,
    /// Centre of the rotation, shape (2) \[m\].
    pub about: [f64; 2],
}
