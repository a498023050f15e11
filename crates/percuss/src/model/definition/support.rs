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
    /// Both displacements and the direction of the tangent; the stretch is free.
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
        /// Fixed components, shape (components held).
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
        /// Gap in the reference configuration \[m\].
        gap: f64,
        /// Stiffness of the stop \[N/m\].
        stiffness: f64,
        /// Whether motion opposite to `direction` is stopped after the same gap.
        two_sided: bool,
    },
}

/// Prescribed motion of the fixed components, from the reference configuration: amplitudes times a function of time. If that is not zero at time zero,
/// a run starts in equilibrium with the supports that have moved.
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
    /// The supported point.
    pub at: PointRef,
    /// Kind of support.
    pub kind: SupportKind,
    /// Prescribed motion; at rest if there is none.
    pub motion: Option<Motion>,
    /// Active until this time \[s\]; infinity if permanent.
    pub until: f64,
}

impl Support {
    /// A permanent support without prescribed motion.
    pub fn new(name: impl Into<String>, at: PointRef, kind: SupportKind) -> Self {
        Self { name: name.into(), at, kind, motion: None, until: f64::INFINITY }
    }
}

/// Kind of connection of two beams.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// Rigid joint: common position and constant angle between the tangents.
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
    /// The centre of a projectile or a disc, by its name.
    Projectile(String),
    /// A point fixed in space, shape (2) \[m\].
    Ground([f64; 2]),
}

/// How the force of a spring follows from its extension, the distance of its ends less the length without force.
#[derive(Clone, Debug, PartialEq)]
pub enum SpringLaw {
    /// In proportion to it, pulling and pushing.
    Linear {
        /// Stiffness \[N/m\].
        stiffness: f64,
    },
    /// It pulls once it is extended by `slack` (a hook, a rope) and never pushes.
    Tension {
        /// Stiffness \[N/m\].
        stiffness: f64,
        /// Extension up to which it is slack \[m\].
        slack: f64,
    },
    /// It pushes once it is shortened by `gap` (a buffer behind a clearance) and never pulls.
    Compression {
        /// Stiffness \[N/m\].
        stiffness: f64,
        /// Shortening up to which it is open \[m\].
        gap: f64,
    },
    /// Along straight lines between given values; beyond the first and the last one the force keeps its value there.
    Table {
        /// Extensions, increasing; shortenings are negative, shape (points) \[m\].
        extension: Vec<f64>,
        /// Forces there, positive in tension, zero without extension; they may fall, shape (points) \[N\].
        force: Vec<f64>,
    },
}

impl SpringLaw {
    /// Stiffness of a law that has one; of a table zero \[N/m\].
    pub fn stiffness(&self) -> f64 {
        match *self {
            Self::Linear { stiffness }
            | Self::Tension { stiffness, .. }
            | Self::Compression { stiffness, .. } => stiffness,
            Self::Table { .. } => 0.0,
        }
    }
}

/// A spring and damper between two points; it acts along the line between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// The user's name for it.
    pub name: String,
    /// Its ends, shape (2).
    pub between: [Anchor; 2],
    /// Its force over its extension.
    pub law: SpringLaw,
    /// Damping, of a law of tension or compression alone where that acts \[N s/m\].
    pub damping: f64,
    /// Length without force \[m\]; that of the reference configuration if none is given.
    pub length: Option<f64>,
    /// Magnitude of the force, damper included, at which it breaks: after a step whose mean force is larger it has failed \[N\]; it does not break
    /// without.
    pub strength: Option<f64>,
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
