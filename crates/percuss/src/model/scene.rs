//! What stands in a model, for drawings of it: outlines, symbols, and the places that these follow.
//!
//! A scene holds what does not change during a run. With the displacements of its [`nodes`](Scene::nodes) at an instant
//! everything in it can be placed: a beam is the Hermite cubic through its stations.

use super::builder::{ModelBuilder, locate};
use super::definition::{
    Anchor, Component, JointKind, LoadKind, ObstacleShape, PointRef, Sides, SupportKind,
};
use super::frozen::{BodyKind, Model, Span};
use super::pairs::clearance_segments;
use crate::math::vec2::{norm, scale};

/// Stations of all beams at most, about: finer meshes are drawn through some of their nodes.
const MOST_STATIONS: usize = 1500;

/// What stands in a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Nodes whose displacements place the scene, among those of the state: of stations, then of bodies.
    pub nodes: Vec<usize>,
    /// Beams, in the order of the model.
    pub beams: Vec<SceneBeam>,
    /// Discs, guided projectiles, obstacles that move.
    pub bodies: Vec<SceneBody>,
    /// Obstacles.
    pub obstacles: Vec<SceneObstacle>,
    /// Supports.
    pub supports: Vec<SceneSupport>,
    /// Joints.
    pub joints: Vec<SceneJoint>,
    /// Springs between two points.
    pub springs: Vec<SceneSpring>,
    /// Point masses.
    pub masses: Vec<SceneMass>,
    /// Loads, in the order of the model.
    pub loads: Vec<SceneLoad>,
    /// Contacts, in the order of the model.
    pub contacts: Vec<SceneContact>,
}

/// A beam as a row of stations.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneBeam {
    /// Name.
    pub name: String,
    /// Stations, start to end; at a corner or a change of section two of them stand at one place.
    pub stations: Vec<DrawnStation>,
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
    /// Position in the reference configuration \[m\].
    pub position: [f64; 2],
    /// Unit tangent in the reference configuration.
    pub tangent: [f64; 2],
    /// Distance of the extreme fibres from the axis \[m\]; NaN if unknown.
    pub half_depth: f64,
    /// Area \[m^2\].
    pub area: f64,
    /// Second moment of area \[m^4\].
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
    /// Position of its centre in the reference configuration \[m\].
    pub position: [f64; 2],
    /// What it is.
    pub shape: BodyShape,
}

/// What a body looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyShape {
    /// A disc, whose third displacement is the angle it has turned.
    Disc {
        /// Radius \[m\].
        radius: f64,
    },
    /// A guided projectile: a point on its line of flight.
    Guided {
        /// Unit vector of the line of flight.
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
    /// Everything behind a straight line.
    HalfPlane {
        /// A point of the line \[m\].
        point: [f64; 2],
        /// Unit normal, out of the obstacle.
        normal: [f64; 2],
    },
    /// A disc.
    Disc {
        /// Centre \[m\].
        centre: [f64; 2],
        /// Radius \[m\].
        radius: f64,
    },
    /// Walls between two ends each.
    Walls {
        /// Ends of each wall \[m\].
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
    /// The point held.
    pub at: OnBeam,
    /// What it is drawn as.
    pub symbol: SupportSymbol,
    /// Whether what it holds is moved as prescribed.
    pub moves: bool,
    /// Holds until this time \[s\]; infinity if for ever.
    pub until: f64,
}

/// Symbol of a support.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SupportSymbol {
    /// Displacements and rotation held.
    Clamp,
    /// Displacements held.
    Pin,
    /// One displacement held; free along the direction.
    Roller {
        /// Unit vector of free motion.
        direction: [f64; 2],
    },
    /// Rotation held, displacements not.
    Guide,
    /// Springs.
    Elastic {
        /// Unit vector of the stiffer one.
        direction: [f64; 2],
    },
    /// A stop after a free way.
    Stop {
        /// Unit vector of the motion stopped.
        direction: [f64; 2],
        /// Free way \[m\].
        gap: f64,
        /// Whether motion the other way is stopped as well.
        two_sided: bool,
    },
}

/// A joint.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneJoint {
    /// Name.
    pub name: String,
    /// Where it is.
    pub at: OnBeam,
    /// Whether the beams turn against each other there.
    pub turns: bool,
}

/// An end of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SceneAnchor {
    /// On a beam.
    Beam(OnBeam),
    /// Fixed in space \[m\].
    Ground([f64; 2]),
}

/// A spring, or damper.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneSpring {
    /// Name.
    pub name: String,
    /// Its ends.
    pub between: [SceneAnchor; 2],
    /// Whether it has stiffness; a mere damper has none.
    pub springs: bool,
}

/// A point mass.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneMass {
    /// Name.
    pub name: String,
    /// Where it is.
    pub at: OnBeam,
    /// Mass \[kg\].
    pub mass: f64,
}

/// A load.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneLoad {
    /// Name.
    pub name: String,
    /// What it applies for a factor of one.
    pub kind: SceneLoadKind,
    /// Whether it turns with the tangent.
    pub follower: bool,
}

/// What a load applies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SceneLoadKind {
    /// Gravity.
    Gravity {
        /// Acceleration \[m/s^2\].
        acceleration: [f64; 2],
    },
    /// A force and a moment at a point.
    Point {
        /// Where.
        at: OnBeam,
        /// Force \[N\]; along (tangent, normal) if it follows.
        force: [f64; 2],
        /// Moment \[N m\].
        moment: f64,
    },
    /// A force per length.
    Distributed {
        /// The beam.
        beam: usize,
        /// From and to \[m\].
        stretch: [f64; 2],
        /// At both ends \[N/m\].
        force: [[f64; 2]; 2],
    },
}

/// A contact.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneContact {
    /// Name.
    pub name: String,
    /// Its two partners.
    pub between: [String; 2],
    /// Whether its law is set-valued.
    pub rigid: bool,
}

impl ModelBuilder {
    /// What stands in the model that was built from these definitions.
    pub fn scene(&self, model: &Model) -> Scene {
        let mut scene = Scene::default();
        for beam in &model.beams {
            let stride = model.element_count().div_ceil(MOST_STATIONS).max(1);
            let mut stations = Vec::new();
            for span in &model.spans[beam.spans.clone()] {
                for k in drawn(span, stride) {
                    stations.push(station(model, span, k));
                    scene.nodes.push(span.nodes.start + k);
                }
            }
            scene.beams.push(SceneBeam { name: beam.name.clone(), stations });
        }
        self.scene_bodies(model, &mut scene);
        self.scene_obstacles(model, &mut scene);
        scene.supports = self.scene_supports(model);
        let joint = |j: &super::definition::Joint| SceneJoint {
            name: j.name.clone(),
            at: on_beam(model, &j.between[0]),
            turns: j.kind != JointKind::Rigid,
        };
        scene.joints = self.joints.iter().map(joint).collect();
        let anchor = |anchor: &Anchor| match anchor {
            Anchor::Point(at) => SceneAnchor::Beam(on_beam(model, at)),
            Anchor::Ground(place) => SceneAnchor::Ground(*place),
        };
        let spring = |s: &super::definition::Spring| SceneSpring {
            name: s.name.clone(),
            between: [anchor(&s.between[0]), anchor(&s.between[1])],
            springs: s.stiffness > 0.0,
        };
        scene.springs = self.springs.iter().map(spring).collect();
        let mass = |m: &super::definition::PointMass| SceneMass {
            name: m.name.clone(),
            at: on_beam(model, &m.at),
            mass: m.mass,
        };
        scene.masses = self.masses.iter().map(mass).collect();
        scene.loads = self.scene_loads(model);
        let contact = |c: &super::frozen::ContactData| SceneContact {
            name: c.name.clone(),
            between: c.between.clone(),
            rigid: matches!(c.law, super::definition::TouchLaw::Rigid(_)),
        };
        scene.contacts = model.contacts.iter().map(contact).collect();
        scene
    }

    fn scene_bodies(&self, model: &Model, scene: &mut Scene) {
        for (i, body) in model.bodies.iter().enumerate() {
            let guided = || {
                let place = model.projectiles.iter().position(|p| p.body == i);
                place.map(|k| (&self.projectiles[k], model.projectiles[k].direction))
            };
            let shape = match body.kind {
                BodyKind::Disc { radius } => BodyShape::Disc { radius },
                BodyKind::Rear { .. } => BodyShape::Rear,
                BodyKind::Obstacle if body.name.is_empty() => continue, // the ground
                BodyKind::Obstacle => BodyShape::Obstacle,
                BodyKind::Guided => {
                    let Some((given, direction)) = guided() else { continue };
                    let elastic =
                        matches!(given.kind, super::definition::ProjectileKind::Elastic { .. });
                    let strikes = on_beam(model, &given.strikes);
                    BodyShape::Guided { direction, elastic, strikes, standoff: given.standoff }
                }
            };
            let node = model.body_node(i);
            scene.nodes.push(node);
            let position = model.nodes[node].position;
            scene.bodies.push(SceneBody { name: body.name.clone(), position, shape });
        }
    }

    fn scene_obstacles(&self, model: &Model, scene: &mut Scene) {
        for item in &self.obstacles {
            let outline = match &item.shape {
                ObstacleShape::HalfPlane { point, normal } => {
                    ObstacleOutline::HalfPlane { point: *point, normal: unit(*normal) }
                }
                ObstacleShape::Disc { centre, radius } => {
                    ObstacleOutline::Disc { centre: *centre, radius: *radius }
                }
                ObstacleShape::Segment { ends, thickness } => {
                    ObstacleOutline::Walls { ends: vec![*ends], thickness: *thickness }
                }
                ObstacleShape::Clearance { at, width, gap, sides } => {
                    let sides: &[f64] = match sides {
                        Sides::Both => &[1.0, -1.0],
                        Sides::Left => &[1.0],
                        Sides::Right => &[-1.0],
                    };
                    let point = locate(model, at);
                    let ends = clearance_segments(model, &point, *width, *gap, sides);
                    ObstacleOutline::Walls { ends, thickness: 0.0 }
                }
            };
            let moving = |b: &SceneBody| b.name == item.name && b.shape == BodyShape::Obstacle;
            let body = scene.bodies.iter().position(moving);
            scene.obstacles.push(SceneObstacle { name: item.name.clone(), body, outline });
        }
    }

    fn scene_supports(&self, model: &Model) -> Vec<SceneSupport> {
        let each = self.supports.iter().map(|support| SceneSupport {
            name: support.name.clone(),
            at: on_beam(model, &support.at),
            symbol: symbol(&support.kind),
            moves: support.motion.is_some(),
            until: support.until,
        });
        each.collect()
    }

    fn scene_loads(&self, model: &Model) -> Vec<SceneLoad> {
        let each = self.loads.iter().map(|load| {
            let (kind, follower) = match &load.kind {
                LoadKind::Gravity { acceleration } => {
                    (SceneLoadKind::Gravity { acceleration: *acceleration }, false)
                }
                LoadKind::Point { at, force, moment, follower } => {
                    let at = on_beam(model, at);
                    (SceneLoadKind::Point { at, force: *force, moment: *moment }, *follower)
                }
                LoadKind::Distributed { beam, stretch, force, follower } => {
                    let place = |along| PointRef { label: String::new(), beam: *beam, along };
                    let stretch = stretch.map(|along| on_beam(model, &place(along)).s);
                    let beam = beam.0 as usize;
                    (SceneLoadKind::Distributed { beam, stretch, force: *force }, *follower)
                }
            };
            SceneLoad { name: load.name.clone(), kind, follower }
        });
        each.collect()
    }
}

/// Numbers of a span's nodes through which it is drawn: every so manieth, and both ends.
fn drawn(span: &Span, stride: usize) -> impl Iterator<Item = usize> {
    let last = span.elements.len();
    (0..last).step_by(stride).chain([last])
}

fn station(model: &Model, span: &Span, k: usize) -> DrawnStation {
    let frame = &model.nodes[span.nodes.start + k];
    let ends = k == span.elements.len();
    let element = if ends { k - 1 } else { k };
    let sections = span.sections(element);
    let section = &sections[if ends { 2 } else { 0 }];
    let young = section.law.axial / section.area;
    DrawnStation {
        s: span.stations[k],
        element: span.elements.start + element,
        ends_span: ends,
        position: frame.position,
        tangent: frame.tangent,
        half_depth: section.half_depth,
        area: section.area,
        inertia: section.law.bending / young,
    }
}

fn on_beam(model: &Model, at: &PointRef) -> OnBeam {
    let point = locate(model, at);
    OnBeam { beam: point.beam, s: point.s }
}

fn symbol(kind: &SupportKind) -> SupportSymbol {
    match kind {
        SupportKind::Clamp => SupportSymbol::Clamp,
        SupportKind::Pin => SupportSymbol::Pin,
        SupportKind::Roller { direction } => SupportSymbol::Roller { direction: unit(*direction) },
        SupportKind::Fix { components } => {
            let holds = |c: Component| components.contains(&c);
            let turned = holds(Component::Rotation);
            match (holds(Component::Displacement1), holds(Component::Displacement2)) {
                (true, true) if turned => SupportSymbol::Clamp,
                (true, true) => SupportSymbol::Pin,
                (true, false) => SupportSymbol::Roller { direction: [0.0, 1.0] },
                (false, true) => SupportSymbol::Roller { direction: [1.0, 0.0] },
                (false, false) => SupportSymbol::Guide,
            }
        }
        SupportKind::Elastic { direction, stiffness, .. } => {
            let [x, y] = unit(*direction);
            let along = stiffness[0] >= stiffness[1];
            SupportSymbol::Elastic { direction: if along { [x, y] } else { [-y, x] } }
        }
        SupportKind::Stop { direction, gap, two_sided, .. } => {
            SupportSymbol::Stop { direction: unit(*direction), gap: *gap, two_sided: *two_sided }
        }
    }
}

fn unit(v: [f64; 2]) -> [f64; 2] {
    scale(1.0 / norm(v), v)
}
