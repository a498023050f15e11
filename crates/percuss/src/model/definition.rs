//! What a user defines: plain structs, handed to the [`ModelBuilder`](super::ModelBuilder).
//!
//! Names are those of the scenario file. All quantities are SI.

use super::time_function::TimeFunction;

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
    /// Retardation time of Kelvin-Voigt damping \[s\]: stresses grow by this time the rate of strains' share.
    pub retardation: f64,
    /// Mass-proportional damping, force per mass and velocity \[1/s\].
    pub mass_damping: f64,
}

impl Material {
    /// An undamped material in the paper's strain measure.
    pub fn new(name: impl Into<String>, young: f64, density: f64) -> Self {
        Self {
            name: name.into(),
            young,
            density,
            strain: StrainMeasure::Green,
            retardation: 0.0,
            mass_damping: 0.0,
        }
    }
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
    /// Depth between the extreme fibres, the centroid half-way \[m\]; without it no fibre strains are reported.
    pub depth: Option<f64>,
    /// Rotary inertia per unit length.
    pub rotary_inertia: RotaryInertia,
    /// Stations of a tapered section; empty for a uniform one, whose values stand above. Area, inertia and depth vary
    /// linearly between stations.
    pub stations: Vec<Station>,
}

/// A tapered section at a fraction of the beam's length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Fraction of the beam's arc length.
    pub at: f64,
    /// Area A \[m^2\].
    pub area: f64,
    /// Second moment of area I \[m^4\].
    pub inertia: f64,
    /// Depth between the extreme fibres \[m\].
    pub depth: Option<f64>,
}

impl Section {
    /// A uniform section of given area and second moment of area.
    pub fn new(name: impl Into<String>, area: f64, inertia: f64) -> Self {
        Self {
            name: name.into(),
            area,
            inertia,
            depth: None,
            rotary_inertia: RotaryInertia::Density,
            stations: Vec::new(),
        }
    }

    /// A section of given depth.
    fn deep(name: impl Into<String>, area: f64, inertia: f64, depth: f64) -> Self {
        Self { depth: Some(depth), ..Self::new(name, area, inertia) }
    }

    /// A rectangle; `depth` lies in the plane of bending.
    pub fn rectangle(name: impl Into<String>, width: f64, depth: f64) -> Self {
        Self::deep(name, width * depth, width * depth.powi(3) / 12.0, depth)
    }

    /// A full circle.
    pub fn circle(name: impl Into<String>, diameter: f64) -> Self {
        let pi = std::f64::consts::PI;
        Self::deep(name, pi * diameter.powi(2) / 4.0, pi * diameter.powi(4) / 64.0, diameter)
    }

    /// A circular tube.
    pub fn tube(name: impl Into<String>, diameter: f64, thickness: f64) -> Self {
        let (pi, inner) = (std::f64::consts::PI, diameter - 2.0 * thickness);
        let area = pi * (diameter.powi(2) - inner.powi(2)) / 4.0;
        Self::deep(name, area, pi * (diameter.powi(4) - inner.powi(4)) / 64.0, diameter)
    }

    /// A doubly symmetric I without fillets, bent about its strong axis.
    pub fn i_shape(name: impl Into<String>, width: f64, depth: f64, flange: f64, web: f64) -> Self {
        let clear = depth - 2.0 * flange;
        let area = 2.0 * width * flange + web * clear;
        let inertia = (width * depth.powi(3) - (width - web) * clear.powi(3)) / 12.0;
        Self::deep(name, area, inertia, depth)
    }

    /// A rectangular box of uniform wall thickness.
    pub fn hollow_box(name: impl Into<String>, width: f64, depth: f64, thickness: f64) -> Self {
        let (w, d) = (width - 2.0 * thickness, depth - 2.0 * thickness);
        let inertia = (width * depth.powi(3) - w * d.powi(3)) / 12.0;
        Self::deep(name, width * depth - w * d, inertia, depth)
    }

    /// Area, second moment of area and depth at a fraction of the beam's length.
    pub(crate) fn at(&self, fraction: f64) -> Station {
        let uniform =
            Station { at: fraction, area: self.area, inertia: self.inertia, depth: self.depth };
        let (Some(first), Some(last)) = (self.stations.first(), self.stations.last()) else {
            return uniform;
        };
        if fraction <= first.at {
            return *first;
        }
        let Some(next) = self.stations.iter().position(|s| s.at >= fraction) else { return *last };
        let (a, b) = (&self.stations[next - 1], &self.stations[next]);
        let f = (fraction - a.at) / (b.at - a.at);
        let mix = |a: f64, b: f64| a + f * (b - a);
        Station {
            at: fraction,
            area: mix(a.area, b.area),
            inertia: mix(a.inertia, b.inertia),
            depth: a.depth.zip(b.depth).map(|(a, b)| mix(a, b)),
        }
    }
}

/// How the points of a beam are joined to a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Curve {
    /// Straight from point to point, with rigid corners.
    #[default]
    Polyline,
    /// A circular arc through three points: start, a point between, end.
    Arc,
    /// A smooth curve through all points: cubic spline over the length along the points, natural ends.
    Spline,
}

/// Size of the finite elements of a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ElementSize {
    /// So many elements in all, shared out by length among the straight parts.
    Number(usize),
    /// Elements no longer than this \[m\].
    Length(f64),
}

/// Elements smaller towards a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grading {
    /// Where the elements are smallest.
    pub towards: Along,
    /// How many times smaller they are there than at the far end; above one.
    pub ratio: f64,
}

/// How a beam is divided into finite elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mesh {
    /// Size of the elements.
    pub size: ElementSize,
    /// Grading; even if there is none.
    pub grading: Option<Grading>,
}

impl Mesh {
    /// So many elements of equal length.
    pub fn even(elements: usize) -> Self {
        Self { size: ElementSize::Number(elements), grading: None }
    }
}

/// From a point on, a beam has another material or section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Where it begins.
    pub at: Along,
    /// Material from there on; the one before if none is given.
    pub material: Option<MaterialId>,
    /// Section from there on; the one before if none is given.
    pub section: Option<SectionId>,
}

/// A beam: a centre line with material, section and mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// The user's name for it.
    pub name: String,
    /// Points the centre line runs through \[m\].
    pub points: Vec<[f64; 2]>,
    /// How the points are joined.
    pub curve: Curve,
    /// Its finite elements.
    pub mesh: Mesh,
    /// Its material, up to the first change.
    pub material: MaterialId,
    /// Its section, up to the first change.
    pub section: SectionId,
    /// Changes of material and section, in the order of their places.
    pub changes: Vec<Change>,
}

impl Beam {
    /// A uniform beam through `points`, straight between them, of `elements` elements.
    pub fn new(
        name: impl Into<String>,
        points: &[[f64; 2]],
        elements: usize,
        material: MaterialId,
        section: SectionId,
    ) -> Self {
        Self {
            name: name.into(),
            points: points.to_vec(),
            curve: Curve::Polyline,
            mesh: Mesh::even(elements),
            material,
            section,
            changes: Vec::new(),
        }
    }
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
    /// Springs and dampers between the point and where it was in the reference configuration.
    Elastic {
        /// First axis of the springs; need not be of unit length. The second is across it.
        direction: [f64; 2],
        /// Stiffness along and across `direction` \[N/m\].
        stiffness: [f64; 2],
        /// Damping along and across `direction` \[N s/m\].
        damping: [f64; 2],
        /// Stiffness against rotation of the tangent \[N m\].
        rotational_stiffness: f64,
        /// Damping of the rotation of the tangent \[N m s\].
        rotational_damping: f64,
    },
    /// A spring that pushes back once the point has moved by `gap` along `direction`.
    Stop {
        /// Direction of motion that is stopped; need not be of unit length.
        direction: [f64; 2],
        /// Free way in the reference configuration \[m\].
        gap: f64,
        /// Stiffness of the stop \[N/m\].
        stiffness: f64,
        /// Whether motion against `direction` is stopped after the same way.
        two_sided: bool,
    },
}

/// Prescribed motion of what a support holds: amplitudes times a function of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Displacement \[m\].
    pub displacement: [f64; 2],
    /// Rotation of the tangent, positive counter-clockwise \[rad\].
    pub rotation: f64,
    /// Its course.
    pub function: TimeFunction,
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

/// An end of a spring.
#[derive(Clone, Debug, PartialEq)]
pub enum Anchor {
    /// A point of a beam.
    Point(PointRef),
    /// A point fixed in space \[m\].
    Ground([f64; 2]),
}

/// A spring and damper between two points; it pulls and pushes along the line between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// The user's name for it.
    pub name: String,
    /// Its ends.
    pub between: [Anchor; 2],
    /// Stiffness \[N/m\].
    pub stiffness: f64,
    /// Damping \[N s/m\].
    pub damping: f64,
    /// Length without force \[m\]; that of the reference configuration if none is given.
    pub length: Option<f64>,
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
    /// Velocity of the point `about` \[m/s\].
    pub velocity: [f64; 2],
    /// Angular velocity, positive counter-clockwise \[rad/s\].
    pub spin: f64,
    /// Centre of the rotation \[m\].
    pub about: [f64; 2],
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
    /// Gravity on every beam, point mass and projectile.
    Gravity {
        /// Acceleration \[m/s^2\].
        acceleration: [f64; 2],
    },
    /// A force and a moment at a point of a beam.
    Point {
        /// The loaded point.
        at: PointRef,
        /// Force \[N\]; along (e1, e2), or along (tangent, normal) if it follows.
        force: [f64; 2],
        /// Moment, positive counter-clockwise \[N m\].
        moment: f64,
        /// Whether the force turns with the tangent.
        follower: bool,
    },
    /// A force per length along a stretch of a beam, varying linearly between its ends.
    Distributed {
        /// The beam.
        beam: BeamId,
        /// Ends of the stretch.
        stretch: [Along; 2],
        /// Force per length at both ends \[N/m\]. Dead: along (e1, e2), per reference length. Follower: along (tangent, normal),
        /// per current length; a pressure is a follower along the normal.
        force: [[f64; 2]; 2],
        /// Whether it turns with the tangent.
        follower: bool,
    },
}

/// A load: what it applies, times a function of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    /// The user's name for it.
    pub name: String,
    /// What it applies.
    pub kind: LoadKind,
    /// Its course, beginning at `from`.
    pub function: TimeFunction,
    /// Acts from this time on \[s\].
    pub from: f64,
    /// Acts until this time \[s\]; infinity if it never ends.
    pub until: f64,
}

impl Load {
    /// A constant load that acts for ever.
    pub fn new(name: impl Into<String>, kind: LoadKind) -> Self {
        let (from, until) = (0.0, f64::INFINITY);
        Self { name: name.into(), kind, function: TimeFunction::Constant, from, until }
    }
}
