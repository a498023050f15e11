//! What a user defines: plain structs, handed to the [`ModelBuilder`](super::ModelBuilder).
//!
//! Names are those of the scenario file. All quantities are SI.

/// Index of a material, given by [`ModelBuilder::material`](super::ModelBuilder::material).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MaterialId(pub(crate) u32);

/// Index of a section, given by [`ModelBuilder::section`](super::ModelBuilder::section).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SectionId(pub(crate) u32);

/// Index of a beam, given by [`ModelBuilder::beam`](super::ModelBuilder::beam).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BeamId(pub(crate) u32);

/// Which strains the strain energy `EA eps^2 / 2 + EI kappa^2 / 2` is written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StrainMeasure {
    /// The paper's: `eps = (|x'|^2 - 1) / 2`, `kappa = n'.x' - N'.X'` (Green-type).
    #[default]
    Green,
    /// Reissner's: `eps = |x'| - 1`, `kappa = -(theta' - theta0')`; what most other codes use.
    Engineering,
}

/// Material of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The user's name for it.
    pub name: String,
    /// Young's modulus E \[Pa\].
    pub young: f64,
    /// Density rho \[kg/m^3\].
    pub density: f64,
    /// Strain measure of its strain energy.
    pub strain: StrainMeasure,
}

/// Rotary inertia per unit length of a section, rhoI \[kg m\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum RotaryInertia {
    /// `density * inertia`.
    #[default]
    Density,
    /// None: an Euler-Bernoulli beam in the narrow sense.
    Neglected,
    /// Given directly \[kg m\].
    Given(f64),
}

/// Cross section of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// The user's name for it.
    pub name: String,
    /// Area A \[m^2\].
    pub area: f64,
    /// Second moment of area I \[m^4\].
    pub inertia: f64,
    /// Rotary inertia per unit length.
    pub rotary_inertia: RotaryInertia,
}

/// A straight beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// The user's name for it.
    pub name: String,
    /// Points the centre line runs through \[m\]; two for a straight beam.
    pub points: Vec<[f64; 2]>,
    /// Number of finite elements.
    pub elements: usize,
    /// Its material.
    pub material: MaterialId,
    /// Its section.
    pub section: SectionId,
}

/// Where along a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Along {
    /// Fraction of the arc length, 0 at the start, 1 at the end.
    Fraction(f64),
    /// Arc length from the start \[m\].
    Distance(f64),
}

/// A material point of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct PointRef {
    /// The user's words for it, as they appear in names of results: `girder.mid`, `girder@0.25`.
    pub label: String,
    /// The beam.
    pub beam: BeamId,
    /// Where along it.
    pub along: Along,
}

/// A component of the motion of a beam's point that a support can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Displacement along e1.
    Displacement1,
    /// Displacement along e2.
    Displacement2,
    /// Direction of the tangent (what a clamp holds besides the displacements).
    Rotation,
    /// Slope component along the reference tangent.
    Stretch,
}

/// What a support holds.
#[derive(Clone, Debug, PartialEq)]
pub enum SupportKind {
    /// Both displacements and the direction of the tangent; the stretch stays free.
    Clamp,
    /// Both displacements.
    Pin,
    /// The displacement across `direction`, along which the support rolls freely.
    Roller {
        /// Direction of free motion; need not be of unit length.
        direction: [f64; 2],
    },
    /// The listed components.
    Fix {
        /// Components held.
        components: Vec<Component>,
    },
}

/// A support to ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Support {
    /// The user's name for it.
    pub name: String,
    /// The point held.
    pub at: PointRef,
    /// What is held there.
    pub kind: SupportKind,
}

/// How two beams are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Positions shared and the angle between the tangents kept.
    Rigid,
    /// Positions shared.
    Hinge,
}

/// A joint between two points of beams, which must coincide in the reference configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The user's name for it.
    pub name: String,
    /// What is shared.
    pub kind: JointKind,
    /// The two points joined.
    pub between: [PointRef; 2],
}

/// How the force of an elastic projectile is evaluated over a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactForce {
    /// Difference quotient of the spring's potential: conserves energy through opening and closing.
    #[default]
    Conserving,
    /// The paper's: the spring's force at the midpoint of the step.
    Midpoint,
}

/// What strikes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProjectileKind {
    /// A mass behind a massless linear spring.
    Elastic {
        /// Spring stiffness \[N/m\].
        stiffness: f64,
        /// Evaluation of the contact force.
        force: ContactForce,
    },
    /// A rigid mass under Newton's impact law.
    Rigid {
        /// Coefficient of restitution in \[0, 1\].
        restitution: f64,
    },
}

/// A projectile: it moves along a fixed line of flight and strikes a material point of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Projectile {
    /// The user's name for it.
    pub name: String,
    /// Elastic or rigid.
    pub kind: ProjectileKind,
    /// Mass \[kg\].
    pub mass: f64,
    /// Initial velocity \[m/s\].
    pub velocity: [f64; 2],
    /// Line of flight towards the beam; needed only where the velocity is zero. Need not be of unit length.
    pub direction: Option<[f64; 2]>,
    /// The material point struck.
    pub strikes: PointRef,
    /// Initial distance between projectile (or spring tip) and beam along the line of flight \[m\].
    pub standoff: f64,
}

/// What a load applies.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadKind {
    /// Gravity on every beam and projectile.
    Gravity {
        /// Acceleration \[m/s^2\].
        acceleration: [f64; 2],
    },
    /// A dead force and a moment at a point of a beam.
    Point {
        /// The loaded point.
        at: PointRef,
        /// Force \[N\].
        force: [f64; 2],
        /// Moment, positive counter-clockwise \[N m\].
        moment: f64,
    },
}

/// A load, constant while it acts.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    /// The user's name for it.
    pub name: String,
    /// What it applies.
    pub kind: LoadKind,
    /// Acts from this time on \[s\].
    pub from: f64,
    /// Acts until this time \[s\]; infinity if it never ends.
    pub until: f64,
}
