//! Contents of a model for drawings of it: outlines, symbols, and their points.
//!
//! A scene holds the data that do not change during a run. With the displacements of its [`nodes`](Scene::nodes) at an instant everything in it can
//! be placed: a beam is the Hermite cubic through its stations.

/// Stations of all beams at most, about: finer meshes are drawn through some of their nodes.
pub(super) const MOST_STATIONS: usize = 1500;

/// Contents of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Nodes whose displacements place the scene, among those of the state: of stations, then of bodies, shape (stations and bodies)
    /// \[index of a node\].
    pub nodes: Vec<usize>,
    /// Beams, in the order of the model, shape (beams).
    pub beams: Vec<SceneBeam>,
    /// Discs, guided projectiles, obstacles that move, shape (such bodies).
    pub bodies: Vec<SceneBody>,
    /// Obstacles, shape (obstacles).
    pub obstacles: Vec<SceneObstacle>,
    /// Supports, shape (supports).
    pub supports: Vec<SceneSupport>,
    /// Joints, shape (joints).
    pub joints: Vec<SceneJoint>,
    /// Springs between two points, shape (such springs).
    pub springs: Vec<SceneSpring>,
    /// Foundations, shape (foundations).
    pub foundations: Vec<SceneFoundation>,
    /// Point masses, shape (point masses).
    pub masses: Vec<SceneMass>,
    /// Loads, in the order of the model, shape (loads).
    pub loads: Vec<SceneLoad>,
    /// Contacts, in the order of the model, shape (contacts).
    pub contacts: Vec<SceneContact>,
}

/// A beam as a row of stations.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneBeam {
    /// Name.
    pub name: String,
    /// Stations, start to end, shape (stations); at a corner or a change of section two of them coincide.
    pub stations: Vec<DrawnStation>,
    /// Radii of the arcs from either face to its start and its end, zero where it ends straight across, shape (2) \[m\].
    pub roundings: [f64; 2],
    /// Whether it is shear-flexible: the tangents of its stations, and their displacements, are the normals of its sections.
    pub shear_flexible: bool,
    /// Of a shear-flexible beam the share of bending in the difference of chord and mean normal of the interval that begins at each station, the rest
    /// being shear (`InsideField` of its elements), shape (stations) \[-\]; empty for a slender one.
    pub bent: Vec<f64>,
}

/// A node of a beam through which it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnStation {
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Element that begins here; at the end of a span the one that ends here.
    pub element: usize,
    /// Whether a span ends here.
    pub ends_span: bool,
    /// Position in the reference configuration, shape (2) \[m\].
    pub position: [f64; 2],
    /// Unit tangent in the reference configuration, shape (2) \[-\].
    pub tangent: [f64; 2],
    /// Distance of the extreme fibres from the axis \[m\]; NaN if unknown.
    pub half_depth: f64,
    /// Area \[m^2\].
    pub area: f64,
    /// Second moment of area, for stresses \[m^4\]; NaN if the section can yield, and stress does not follow from forces.
    pub inertia: f64,
}

/// A place on a beam that follows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnBeam {
    /// Number of the beam.
    pub beam: usize,
    /// Arc length from its start \[m\].
    pub s: f64,
}

/// A body that moves.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneBody {
    /// Name.
    pub name: String,
    /// Position of its centre in the reference configuration, shape (2) \[m\].
    pub position: [f64; 2],
    /// Kind.
    pub shape: BodyShape,
}

/// Shape of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyShape {
    /// A disc, whose third displacement is the angle it has turned.
    Disc {
        /// Radius \[m\].
        radius: f64,
    },
    /// A guided projectile: a point on its line of motion.
    Guided {
        /// Unit vector of the line of motion, shape (2) \[-\].
        direction: [f64; 2],
        /// Whether it strikes with a spring.
        elastic: bool,
        /// The point it strikes.
        strikes: OnBeam,
        /// Initial distance from it \[m\].
        standoff: f64,
    },
    /// The rear mass of the guided projectile before it in the list.
    Rear,
    /// An obstacle that moves.
    Obstacle,
}

/// An obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneObstacle {
    /// Name.
    pub name: String,
    /// Its body among [`Scene::bodies`], if it moves.
    pub body: Option<usize>,
    /// Its outline in the reference configuration.
    pub outline: ObstacleOutline,
}

/// Outline of an obstacle.
#[derive(Clone, Debug, PartialEq)]
pub enum ObstacleOutline {
    /// The half-plane behind a straight line.
    HalfPlane {
        /// A point of the line, shape (2) \[m\].
        point: [f64; 2],
        /// Unit normal, out of the obstacle, shape (2) \[-\].
        normal: [f64; 2],
    },
    /// A disc.
    Disc {
        /// Centre, shape (2) \[m\].
        centre: [f64; 2],
        /// Radius \[m\].
        radius: f64,
    },
    /// Walls between two ends each.
    Walls {
        /// Ends of each wall, shape (walls, 2, 2) \[m\].
        ends: Vec<[[f64; 2]; 2]>,
        /// Thickness \[m\].
        thickness: f64,
    },
}

/// A support.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneSupport {
    /// Name.
    pub name: String,
    /// The supported point.
    pub at: OnBeam,
    /// Kind of symbol.
    pub symbol: SupportSymbol,
    /// Whether its fixed components move as prescribed.
    pub moves: bool,
    /// Active until this time \[s\]; infinity if permanent.
    pub until: f64,
}

/// Symbol of a support.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SupportSymbol {
    /// Displacements and rotation fixed.
    Clamp,
    /// Displacements fixed.
    Pin,
    /// One displacement fixed; free along the direction.
    Roller {
        /// Unit vector of free motion, shape (2) \[-\].
        direction: [f64; 2],
    },
    /// Rotation fixed, displacements free.
    Guide,
    /// Springs.
    Elastic {
        /// Unit vector of the stiffer one, shape (2) \[-\].
        direction: [f64; 2],
    },
    /// A stop after a gap.
    Stop {
        /// Unit vector of the motion stopped, shape (2) \[-\].
        direction: [f64; 2],
        /// Gap \[m\].
        gap: f64,
        /// Whether motion in the opposite direction is stopped as well.
        two_sided: bool,
    },
}

/// A joint.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneJoint {
    /// Name.
    pub name: String,
    /// Position.
    pub at: OnBeam,
    /// Whether the beams turn against each other there.
    pub turns: bool,
}

/// An end of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SceneAnchor {
    /// On a beam.
    Beam(OnBeam),
    /// At the centre of a body, by its number.
    Body(usize),
    /// Fixed in space, shape (2) \[m\].
    Ground([f64; 2]),
}

/// A spring, or damper.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneSpring {
    /// Name.
    pub name: String,
    /// Its ends, shape (2).
    pub between: [SceneAnchor; 2],
    /// Whether it has stiffness; a mere damper has none.
    pub springs: bool,
}

/// A foundation along a stretch of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFoundation {
    /// Name.
    pub name: String,
    /// The beam.
    pub beam: usize,
    /// From and to, arc length, shape (2) \[m\].
    pub stretch: [f64; 2],
    /// Unit vector in which it pushes the beam, shape (2) \[-\]; none if that is the normal of the beam.
    pub direction: Option<[f64; 2]>,
    /// Whether the beam can lift off.
    pub lifts: bool,
}

/// A point mass.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneMass {
    /// Name.
    pub name: String,
    /// Position.
    pub at: OnBeam,
    /// Mass \[kg\].
    pub mass: f64,
}

/// A load.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneLoad {
    /// Name.
    pub name: String,
    /// Load for a factor of one.
    pub kind: SceneLoadKind,
    /// Whether it turns with the tangent.
    pub follower: bool,
}

/// Kind of a load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SceneLoadKind {
    /// Gravity.
    Gravity {
        /// Acceleration, shape (2) \[m/s^2\].
        acceleration: [f64; 2],
    },
    /// Acceleration of the base.
    Base {
        /// Acceleration, shape (2) \[m/s^2\].
        acceleration: [f64; 2],
    },
    /// A force and a moment at a point.
    Point {
        /// Position.
        at: OnBeam,
        /// Force, shape (2) \[N\]; along (tangent, normal) if it follows.
        force: [f64; 2],
        /// Moment \[N m\].
        moment: f64,
    },
    /// Strains without forces, of heat or shrinkage.
    Strain {
        /// The beam.
        beam: usize,
        /// From and to, arc length, shape (2) \[m\].
        stretch: [f64; 2],
    },
    /// A force per length.
    Distributed {
        /// The beam.
        beam: usize,
        /// From and to, arc length, shape (2) \[m\].
        stretch: [f64; 2],
        /// At both ends, shape (2, 2) \[N/m\].
        force: [[f64; 2]; 2],
    },
}

/// A contact.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneContact {
    /// Name.
    pub name: String,
    /// Its two partners, shape (2).
    pub between: [String; 2],
    /// Whether its law is set-valued.
    pub rigid: bool,
}
