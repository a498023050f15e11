//! The scene of a model.

use super::builder::ModelBuilder;
use super::definition::{
    Anchor, Component, JointKind, LoadKind, ObstacleShape, PointRef, Sides, SupportKind,
};
use super::frozen::{BodyKind, Model, Span};
use super::material_points::locate;
use super::outline::BeamOutline;
use super::pairs::clearance_segments;
use super::scene::*;
use crate::element::shear::ShearTable;
use crate::math::vec2::{norm, scale};

impl ModelBuilder {
    /// Contents of the model that was built from these definitions.
    pub fn scene(&self, model: &Model) -> Scene {
        let mut scene = Scene::default();
        for (i, beam) in model.beams.iter().enumerate() {
            let stride = model.element_count().div_ceil(MOST_STATIONS).max(1);
            let mut stations = Vec::new();
            for span in &model.spans[beam.spans.clone()] {
                for k in drawn(span, stride) {
                    stations.push(station(model, span, k));
                    scene.nodes.push(span.nodes.start + k);
                }
            }
            let roundings = BeamOutline::exact(self, model, i).roundings();
            let shear_flexible = model.spans[beam.spans.clone()].iter().any(|s| s.shear.is_some());
            let name = beam.name.clone();
            let bent = match shear_flexible {
                true => bent_shares(model, i, &stations),
                false => Vec::new(),
            };
            scene.beams.push(SceneBeam { name, stations, roundings, shear_flexible, bent });
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
            Anchor::Projectile(name) => {
                let own = |i: &usize| model.bodies[*i].name == *name;
                SceneAnchor::Body(model.striking_bodies().find(own).unwrap_or_default())
            }
            Anchor::Ground(place) => SceneAnchor::Ground(*place),
        };
        let spring = |s: &super::definition::Spring| SceneSpring {
            name: s.name.clone(),
            between: [anchor(&s.between[0]), anchor(&s.between[1])],
            springs: s.law != super::definition::SpringLaw::Linear { stiffness: 0.0 },
        };
        scene.springs = self.springs.iter().map(spring).collect();
        let foundation = |f: &super::definition::Foundation| {
            let end = |along| PointRef { label: String::new(), beam: f.beam, along };
            SceneFoundation {
                name: f.name.clone(),
                beam: f.beam.0 as usize,
                stretch: f.stretch.map(|along| on_beam(model, &end(along)).s),
                direction: f.direction.map(unit),
                lifts: matches!(f.law, super::definition::FoundationLaw::Compression { .. }),
            }
        };
        scene.foundations = self.foundations.iter().map(foundation).collect();
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
            rigid: c.law.is_rigid(),
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
                LoadKind::Base { acceleration } => {
                    (SceneLoadKind::Base { acceleration: *acceleration }, false)
                }
                LoadKind::Point { at, force, moment, follower } => {
                    let at = on_beam(model, at);
                    (SceneLoadKind::Point { at, force: *force, moment: *moment }, *follower)
                }
                LoadKind::Strain { beam, stretch, .. }
                | LoadKind::Temperature { beam, stretch, .. } => {
                    let place = |along| PointRef { label: String::new(), beam: *beam, along };
                    let stretch = stretch.map(|along| on_beam(model, &place(along)).s);
                    (SceneLoadKind::Strain { beam: beam.0 as usize, stretch }, false)
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

/// Share of bending in the intervals that begin at stations: of an element, or of several as one.
fn bent_shares(model: &Model, beam: usize, stations: &[DrawnStation]) -> Vec<f64> {
    let spans = &model.spans[model.beams[beam].spans.clone()];
    let share = |k: usize| {
        let (from, to) = (&stations[k], stations.get(k + 1).unwrap_or(&stations[k]));
        let length = to.s - from.s;
        let span = spans.iter().find(|span| span.elements.contains(&from.element))?;
        let section = span.section.at(from.s + 0.5 * length);
        (length > 0.0).then(|| ShearTable::bent_share(length, &section))
    };
    (0..stations.len()).map(|k| share(k).unwrap_or(0.0)).collect()
}

fn station(model: &Model, span: &Span, k: usize) -> DrawnStation {
    let frame = &model.nodes[span.nodes.start + k];
    let ends = k == span.elements.len();
    let element = if ends { k - 1 } else { k };
    let section = span.section_at(element, if ends { 1.0 } else { 0.0 });
    DrawnStation {
        s: span.stations[k],
        element: span.elements.start + element,
        ends_span: ends,
        position: frame.position,
        tangent: frame.tangent,
        half_depth: section.half_depth,
        area: section.area,
        // Stress does not follow from forces after possible yielding.
        inertia: if span.fibres.is_some() { f64::NAN } else { section.inertia },
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
