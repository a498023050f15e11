//! Contacts as pairs of a round body and its target.

use super::builder::ModelBuilder;
use super::definition::*;
use super::fault::Fault;
use super::frozen::*;
use super::material_points::locate;
use super::outline::{BeamOutline, beam_centre};
use crate::geometry::pair::{Carrier, Centre, Pair, Target};
use crate::math::vec2::{add, norm, rot90, scale};

/// Least distance along its axis at which a beam touches itself, in elements and in half depths.
const OWN_NEIGHBOURHOOD: [f64; 2] = [2.0, 8.0];

/// Adds the contacts with their pairs; the errors are a fault for each contact with initial interpenetration.
pub(super) fn place(builder: &ModelBuilder, model: &mut Model) -> Result<(), Vec<Fault>> {
    for (i, projectile) in builder.projectiles.iter().enumerate() {
        guided(i, projectile, model);
    }
    for contact in &builder.contacts {
        let between = contact.between.map(|partner| name(builder, partner));
        let first = model.pairs.len();
        let mut pairs = Pairs { builder, model, contact: model.contacts.len(), found: Vec::new() };
        pairs.between(contact);
        let mut found = pairs.found;
        let obstacle = obstacle_of(contact);
        for pair in &mut found {
            pair.obstacle = obstacle;
        }
        if let Some(obstacle) = obstacle.filter(|_| contact.law.is_rigid()) {
            model.supports[model.obstacles[obstacle].support].rigid = true;
        }
        model.pairs.extend(found);
        let (name, law) = (contact.name.clone(), contact.law.clone());
        let pairs = first..model.pairs.len();
        model.contacts.push(ContactData { name, between, law, pairs });
    }
    let rest = vec![[0.0; 4]; model.nodes.len()];
    let faults = model.overlaps(&rest, |_| true);
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

fn guided(i: usize, projectile: &Projectile, model: &mut Model) {
    let data = &model.projectiles[i];
    let (point, body) = (&data.point, data.body);
    let pair = Pair {
        contact: i,
        source: body_centre(model, body),
        target: Target::Guided {
            point: beam_centre(point),
            normal: scale(-1.0, data.direction),
            standoff: projectile.standoff,
        },
        reach: 0.0,
        target_radius: 0.0,
        skips_ends: false,
        obstacle: None,
        movers: [model.beams.len() + body, point.beam],
        source_partner: 1,
        s: point.s,
        at_end: false,
    };
    let law = match &projectile.kind {
        ProjectileKind::Elastic { law } => TouchLaw::Smooth(law.clone()),
        ProjectileKind::Rigid { restitution } => {
            TouchLaw::Rigid(RigidLaw::frictionless(*restitution))
        }
    };
    let between = [point.label.clone(), projectile.name.clone()];
    let pairs = model.pairs.len()..model.pairs.len() + 1;
    model.pairs.push(pair);
    model.contacts.push(ContactData { name: projectile.name.clone(), between, law, pairs });
}

fn obstacle_of(contact: &Contact) -> Option<usize> {
    contact.between.iter().find_map(|partner| match partner {
        ContactPartner::Obstacle(id) => Some(id.0 as usize),
        _ => None,
    })
}

fn name(builder: &ModelBuilder, partner: ContactPartner) -> String {
    match partner {
        ContactPartner::Disc(id) => builder.discs[id.0 as usize].name.clone(),
        ContactPartner::Beam(id) => builder.beams[id.0 as usize].name.clone(),
        ContactPartner::Obstacle(id) => builder.obstacles[id.0 as usize].name.clone(),
    }
}

fn body_centre(model: &Model, body: usize) -> Centre {
    let node = model.body_node(body);
    let carrier = Carrier::Body { offset: [0.0; 2] };
    Centre { position: model.nodes[node].position, node, carrier }
}

/// A rigid shape: its body, and its surface.
#[derive(Clone, Copy)]
enum Rigid {
    Round {
        body: usize,
        /// Its centre, shape (2) \[m\].
        centre: [f64; 2],
        radius: f64,
    },
    Line {
        body: usize,
        /// A point of it, shape (2) \[m\].
        point: [f64; 2],
        /// Unit normal, away from the half-plane behind it, shape (2) \[-\].
        normal: [f64; 2],
    },
    Segment {
        body: usize,
        /// Its ends, shape (2, 2) \[m\].
        ends: [[f64; 2]; 2],
        radius: f64,
    },
}

struct Pairs<'a> {
    builder: &'a ModelBuilder,
    model: &'a Model,
    contact: usize,
    /// The pairs of the contact so far, shape (pairs).
    found: Vec<Pair>,
}

impl Pairs<'_> {
    fn between(&mut self, contact: &Contact) {
        let points = contact.points_per_element;
        match contact.between {
            [ContactPartner::Beam(a), ContactPartner::Beam(b)] if a == b => {
                self.itself(a.0 as usize, points)
            }
            [ContactPartner::Beam(a), ContactPartner::Beam(b)] => {
                let (a, b) = (a.0 as usize, b.0 as usize);
                self.points_on_axis(a, b, points, 0, false);
                // If both end in points or are round, ends of `b` are in pairs already, as sources or through the ends of `a`.
                self.points_on_axis(b, a, points, 1, true);
            }
            [ContactPartner::Beam(beam), other] => {
                self.beam_and_rigid(beam.0 as usize, 0, other, points)
            }
            [other, ContactPartner::Beam(beam)] => {
                self.beam_and_rigid(beam.0 as usize, 1, other, points)
            }
            [a, b] => {
                let (ours, theirs) = (self.shapes(a), self.shapes(b));
                for x in &ours {
                    for y in &theirs {
                        match x {
                            Rigid::Round { .. } => self.rigid_pair(x, y, 0),
                            _ => self.rigid_pair(y, x, 1),
                        }
                    }
                }
            }
        }
    }

    /// Surface of a disc or an obstacle.
    fn shapes(&self, partner: ContactPartner) -> Vec<Rigid> {
        match partner {
            ContactPartner::Beam(_) => Vec::new(),
            ContactPartner::Disc(id) => {
                let is_disc = |b: &Body| b.kind.is_disc();
                let first = self.model.bodies.iter().position(is_disc).unwrap_or_default();
                let body = first + id.0 as usize;
                let disc = &self.builder.discs[id.0 as usize];
                vec![Rigid::Round { body, centre: disc.position, radius: disc.radius }]
            }
            ContactPartner::Obstacle(id) => {
                let ObstacleData { body, .. } = self.model.obstacles[id.0 as usize];
                match &self.builder.obstacles[id.0 as usize].shape {
                    ObstacleShape::HalfPlane { point, normal } => {
                        let normal = scale(1.0 / norm(*normal), *normal);
                        vec![Rigid::Line { body, point: *point, normal }]
                    }
                    ObstacleShape::Disc { centre, radius } => {
                        vec![Rigid::Round { body, centre: *centre, radius: *radius }]
                    }
                    ObstacleShape::Segment { ends, thickness } => {
                        vec![Rigid::Segment { body, ends: *ends, radius: 0.5 * thickness }]
                    }
                    ObstacleShape::Clearance { at, width, gap, sides } => {
                        self.clearance(body, at, *width, *gap, *sides)
                    }
                }
            }
        }
    }

    fn clearance(
        &self,
        body: usize,
        at: &PointRef,
        width: f64,
        gap: f64,
        sides: Sides,
    ) -> Vec<Rigid> {
        let point = locate(self.model, at);
        let sides: &[f64] = match sides {
            Sides::Both => &[1.0, -1.0],
            Sides::Left => &[1.0],
            Sides::Right => &[-1.0],
        };
        let segments = clearance_segments(self.model, &point, width, gap, sides);
        segments.into_iter().map(|ends| Rigid::Segment { body, ends, radius: 0.0 }).collect()
    }

    fn offset_centre(&self, body: usize, place: [f64; 2]) -> Centre {
        let centre = body_centre(self.model, body);
        let offset = [0, 1].map(|i| place[i] - centre.position[i]);
        Centre { position: place, carrier: Carrier::Body { offset }, ..centre }
    }

    fn target(&self, shape: &Rigid) -> (Target, f64, usize) {
        match shape {
            Rigid::Round { body, centre, radius } => {
                (Target::Round { centre: self.offset_centre(*body, *centre) }, *radius, *body)
            }
            Rigid::Line { body, point, normal } => {
                let point = self.offset_centre(*body, *point);
                (Target::Line { point, normal: *normal }, 0.0, *body)
            }
            Rigid::Segment { body, ends, radius } => {
                let ends = ends.map(|end| self.offset_centre(*body, end));
                (Target::Segment { ends }, *radius, *body)
            }
        }
    }

    fn rigid_pair(&mut self, source: &Rigid, target: &Rigid, source_partner: usize) {
        let Rigid::Round { body, centre, radius } = source else { return };
        let (shape, target_radius, other) = self.target(target);
        let beams = self.model.beams.len();
        self.found.push(Pair {
            contact: self.contact,
            source: self.offset_centre(*body, *centre),
            target: shape,
            reach: radius + target_radius,
            target_radius,
            skips_ends: false,
            obstacle: None,
            movers: [beams + body, beams + other],
            source_partner,
            s: f64::NAN,
            at_end: false,
        });
    }

    /// A beam and a disc or obstacle; `beam_partner` is the number of the beam among the two.
    fn beam_and_rigid(
        &mut self,
        beam: usize,
        beam_partner: usize,
        other: ContactPartner,
        points: usize,
    ) {
        let outline = BeamOutline::exact(self.builder, self.model, beam);
        let axis = outline.target([0, 0]);
        let sources = outline.sources(points);
        for shape in self.shapes(other) {
            match &shape {
                Rigid::Round { body, centre, radius } => {
                    let source = self.offset_centre(*body, *centre);
                    let pair = self.on_axis(source, *radius, *body, axis.clone(), beam);
                    self.found.push(Pair { source_partner: 1 - beam_partner, ..pair });
                }
                Rigid::Line { .. } | Rigid::Segment { .. } => {
                    let (target, target_radius, body) = self.target(&shape);
                    for source in &sources {
                        self.found.push(Pair {
                            contact: self.contact,
                            source: source.centre,
                            target: target.clone(),
                            reach: source.radius + target_radius,
                            target_radius,
                            skips_ends: false,
                            obstacle: None,
                            movers: [beam, self.model.beams.len() + body],
                            source_partner: beam_partner,
                            s: source.s,
                            at_end: source.at_end,
                        });
                    }
                    if let Rigid::Segment { ends, radius, .. } = &shape {
                        for end in ends {
                            let source = self.offset_centre(body, *end);
                            let pair = self.on_axis(source, *radius, body, axis.clone(), beam);
                            // If the beam ends in a point, it is a source already.
                            let source_partner = 1 - beam_partner;
                            self.found.push(Pair { skips_ends: true, source_partner, ..pair });
                        }
                    }
                }
            }
        }
    }

    fn on_axis(
        &self,
        source: Centre,
        radius: f64,
        body: usize,
        target: Target,
        beam: usize,
    ) -> Pair {
        Pair {
            contact: self.contact,
            source,
            target,
            reach: radius,
            target_radius: 0.0,
            skips_ends: false,
            obstacle: None,
            movers: [self.model.beams.len() + body, beam],
            source_partner: 0,
            s: f64::NAN,
            at_end: false,
        }
    }

    /// Points of one beam against the axis of another.
    fn points_on_axis(
        &mut self,
        from: usize,
        onto: usize,
        points: usize,
        source_partner: usize,
        skips_ends: bool,
    ) {
        let target = BeamOutline::rounded(self.builder, self.model, onto).target([0, 0]);
        for source in BeamOutline::rounded(self.builder, self.model, from).sources(points) {
            self.found.push(Pair {
                contact: self.contact,
                source: source.centre,
                target: target.clone(),
                reach: source.radius,
                target_radius: 0.0,
                skips_ends,
                obstacle: None,
                movers: [from, onto],
                source_partner,
                s: source.s,
                at_end: source.at_end,
            });
        }
    }

    /// Points of a beam against its own axis, but for their neighbourhood.
    fn itself(&mut self, beam: usize, points: usize) {
        let axis = &self.model.beams[beam].axis;
        let first = self.found.len();
        self.points_on_axis(beam, beam, points, 0, true);
        let deep = axis.iter().flat_map(|e| e.half_depths).fold(0.0, f64::max);
        let long = axis.iter().map(|e| e.length).fold(0.0, f64::max);
        let apart = (OWN_NEIGHBOURHOOD[0] * long).max(OWN_NEIGHBOURHOOD[1] * deep);
        for pair in &mut self.found[first..] {
            let skip = [
                axis.partition_point(|e| e.s + e.length <= pair.s - apart),
                axis.partition_point(|e| e.s < pair.s + apart),
            ];
            pair.target.leave_out(skip);
            // Of two touching ends, one is the source.
            pair.skips_ends = pair.s > 0.5 * self.model.beams[beam].length;
        }
    }
}

/// Ends of the segments around a point of a beam, with a free path to its surface, on the given sides \[m\].
pub(super) fn clearance_segments(
    model: &Model,
    point: &MaterialPoint,
    width: f64,
    gap: f64,
    sides: &[f64],
) -> Vec<[[f64; 2]; 2]> {
    let away = gap + half_depth(model, point);
    let (along, across) = (scale(0.5 * width, point.tangent), rot90(point.tangent));
    let segment = |side: &f64| {
        let middle = add(point.position, scale(side * away, across));
        [-1.0, 1.0].map(|end| add(middle, scale(end, along)))
    };
    sides.iter().map(segment).collect()
}

/// Half depth at a point; zero where the section has none.
fn half_depth(model: &Model, point: &MaterialPoint) -> f64 {
    let axis = &model.beams[point.beam].axis;
    let element = axis.iter().find(|e| e.node == point.node);
    element.map_or(0.0, |e| e.half_depth(((point.s - e.s) / e.length).clamp(0.0, 1.0)))
}
