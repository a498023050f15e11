//! A contact as hand formulas see it: what meets what, how fast, under which law.

mod struck;

use super::formulas::{
    SingleMassImpact, hertz_impact, linear_impact, pressed_impact, reduced_mass, table_impact,
};
use super::structure::{BeamPlace, first_hit, gravity, nearest};
use percuss::ContactPlace;
use percuss::inspect::{Body, BodyKind, ContactView, MovingPartner, TargetShape};
use percuss::math::vec2::{add, cross, dot, norm, rot90, scale, sub};
use percuss::{Model, Potential, SmoothLaw, TouchLaw};

/// A contact.
#[derive(Clone, Debug)]
pub struct Case<'a> {
    pub name: &'a str,
    /// Number of the contact.
    pub index: usize,
    pub law: &'a TouchLaw,
    /// Number of its projectile, if that is guided.
    pub guided: Option<usize>,
    pub meeting: Meeting<'a>,
}

/// What meets.
#[derive(Clone, Debug)]
pub enum Meeting<'a> {
    /// A projectile or a disc strikes a beam.
    Struck(Struck<'a>),
    /// A disc meets another one or an obstacle.
    Bodies(Bodies),
    /// Points of a beam meet an obstacle or a beam.
    Beams(Beams<'a>),
}

/// A projectile or a disc that strikes a beam.
#[derive(Clone, Debug)]
pub struct Struck<'a> {
    /// Mass that strikes \[kg\].
    pub mass: f64,
    /// Mass behind it \[kg\] and stiffness of the spring between \[N/m\].
    pub rear: Option<Rear>,
    /// Radius \[m\]; none of a guided projectile.
    pub radius: Option<f64>,
    /// Unit vector of the motion towards the beam, shape (2) \[-\].
    pub direction: [f64; 2],
    /// Speed of approach in the motion both start with \[m/s\].
    pub speed: f64,
    /// Relative speed along the beam in that motion, which a contact without friction leaves alone \[m/s\].
    pub sideways: f64,
    /// Free way to the first touch \[m\]; none if it is not seen where they meet.
    pub gap: Option<f64>,
    /// The place struck.
    pub place: BeamPlace<'a>,
}

/// Shares by which something changes an impact.
#[derive(Clone, Copy, Debug)]
pub struct Change {
    /// Of the largest force.
    pub force: f64,
    /// Of the velocity of rebound, where there is one.
    pub rebound: Option<f64>,
}

/// A mass behind a projectile.
#[derive(Clone, Copy, Debug)]
pub struct Rear {
    pub mass: f64,
    pub stiffness: f64,
    pub damping: f64,
}

/// Two bodies, one of which may be an obstacle.
#[derive(Clone, Copy, Debug)]
pub struct Bodies {
    /// Reduced mass \[kg\].
    pub mass: f64,
    /// Relative speed at the start \[m/s\]; that along the normal is no larger.
    pub speed: f64,
    /// Whether both touch at one place whatever happens: not so with a wall of finite length or a clearance.
    pub simple: bool,
    /// Constant force that presses a disc on an obstacle at rest \[N\]; two discs fall together. None where its direction is
    /// not known.
    pub pressed: Option<f64>,
}

/// Points of a beam against something.
#[derive(Clone, Debug)]
pub struct Beams<'a> {
    /// The first beam, at its middle.
    pub place: BeamPlace<'a>,
    /// Normal of the half-plane it meets, if it meets one, shape (2) \[-\].
    pub wall: Option<[f64; 2]>,
    /// Number of the beam, and of the other one if it meets one.
    pub numbers: (usize, Option<usize>),
    /// Velocity of the beam's middle at the start, shape (2) \[m/s\].
    pub velocity: [f64; 2],
}

/// The contact of number `index`; `at` says where its first touch was, if that is known.
pub fn read<'a>(model: &'a Model, index: usize, at: Option<ContactPlace>) -> Option<Case<'a>> {
    let contact = model.contact(index)?;
    let guided = (index < model.guided().len()).then_some(index);
    if is_on_a_spring(model, &contact, guided) {
        return None;
    }
    let meeting = match guided {
        Some(k) => Meeting::Struck(projectile(model, k)?),
        None => meeting(model, &contact, at)?,
    };
    Some(Case { name: contact.name(), index, law: contact.law(), guided, meeting })
}

/// Whether a spring acts on a projectile of a contact: no formula knows of that.
pub fn is_on_a_spring(model: &Model, contact: &ContactView<'_>, guided: Option<usize>) -> bool {
    let tied = |name: &str| model.connectors().any(|c| c.projectiles().any(|own| own == name));
    if let Some(projectile) = guided.and_then(|k| model.guided().nth(k)) {
        return tied(&projectile.body.name);
    }
    contact.pairs().next().is_some_and(|(partners, _)| {
        partners.into_iter().any(|partner| match partner {
            MovingPartner::Body(k) => tied(&model.bodies()[k].name),
            MovingPartner::Beam(_) => false,
        })
    })
}

fn projectile(model: &Model, k: usize) -> Option<Struck<'_>> {
    let data = model.guided().nth(k)?;
    let body = data.body;
    let rear = match data.rear {
        Some(Body { mass, kind: BodyKind::Rear { stiffness, damping, .. }, .. }) => {
            Some(Rear { mass: *mass, stiffness: *stiffness, damping: *damping })
        }
        _ => None,
    };
    let place = BeamPlace::new(model, data.point.beam, data.point.s);
    let (_, target) = model.contact(k)?.pairs().next()?;
    let gap = match target {
        TargetShape::Guided { standoff } => Some(standoff),
        _ => None,
    };
    let relative = sub(body.velocity, beam_velocity(model, data.point.beam, data.point.position));
    Some(Struck {
        mass: body.mass,
        rear,
        radius: None,
        direction: data.direction,
        speed: dot(relative, data.direction),
        sideways: 0.0,
        gap,
        place,
    })
}

/// Velocity that the beams' motion at the start gives a position \[m/s\].
fn beam_velocity(model: &Model, beam: usize, position: [f64; 2]) -> [f64; 2] {
    let motion = model.initial_motion_of(beam);
    add(motion.velocity, scale(motion.spin, rot90(sub(position, motion.about))))
}

/// What meets in a contact between two named things.
fn meeting<'a>(
    model: &'a Model,
    contact: &ContactView<'a>,
    at: Option<ContactPlace>,
) -> Option<Meeting<'a>> {
    let ([a, b], target) = contact.pairs().next()?;
    let beam = |partner| match partner {
        MovingPartner::Beam(beam) => Some(beam),
        MovingPartner::Body(_) => None,
    };
    let body = |partner| match partner {
        MovingPartner::Body(k) => Some((k, &model.bodies()[k])),
        MovingPartner::Beam(_) => None,
    };
    match (body(a), body(b)) {
        (Some(one), Some(two)) => bodies(model, [one, two], &target, at),
        (Some((k, disc)), None) | (None, Some((k, disc))) if is_disc(disc) => {
            struck_by_disc(model, k, beam(a).or(beam(b))?, at)
        }
        _ => {
            let other = beam(a).and(beam(b)).filter(|b| beam(a) != Some(*b));
            points_of_beams(model, beam(a).or(beam(b))?, other, &target)
        }
    }
}

fn is_disc(body: &Body) -> bool {
    matches!(body.kind, BodyKind::Disc { .. })
}

fn bodies<'a>(
    model: &Model,
    two: [(usize, &Body); 2],
    target: &TargetShape,
    at: Option<ContactPlace>,
) -> Option<Meeting<'a>> {
    let masses = two.map(|(_, body)| if is_disc(body) { body.mass } else { f64::INFINITY });
    let moves = |(k, body): (usize, &Body)| {
        // An obstacle that is moved as prescribed is no rigid wall at rest.
        !is_disc(body) && model.prescribed_of_body(k).is_some_and(|dofs| dofs.moves)
    };
    if two.into_iter().any(moves) {
        return None;
    }
    let speed = norm(sub(two[0].1.velocity, two[1].1.velocity));
    let simple = matches!(target, TargetShape::Line { .. } | TargetShape::Round);
    let mass = reduced_mass(masses);
    let pressed = pressed(model, two, target, at).map(|pull| mass * pull);
    Some(Meeting::Bodies(Bodies { mass, speed, simple, pressed }))
}

/// Acceleration of gravity that presses a disc on an obstacle \[m/s^2\]; none where the normal is not known.
fn pressed(
    model: &Model,
    two: [(usize, &Body); 2],
    target: &TargetShape,
    at: Option<ContactPlace>,
) -> Option<f64> {
    let pull = gravity(model).0;
    if two.iter().all(|(_, body)| is_disc(body)) || norm(pull) == 0.0 {
        return Some(0.0);
    }
    if let TargetShape::Line { normal } = target {
        return Some(-dot(pull, *normal));
    }
    // From the disc to where it touches; it has flown there in a parabola, so that only a place on a straight one tells.
    let (k, disc) = two.into_iter().find(|(_, body)| is_disc(body))?;
    let way = sub(at?.position, model.body_position(k));
    let straight =
        [way, disc.velocity].iter().all(|v| cross(*v, pull).abs() <= 1e-6 * norm(*v) * norm(pull));
    (straight && norm(way) > 0.0).then(|| dot(pull, way) / norm(way))
}

fn struck_by_disc(
    model: &Model,
    disc: usize,
    beam: usize,
    at: Option<ContactPlace>,
) -> Option<Meeting<'_>> {
    let body = &model.bodies()[disc];
    let BodyKind::Disc { radius } = body.kind else { return None };
    let data = model.beam(beam);
    let centre = model.body_position(disc);
    let middle = BeamPlace::new(model, beam, 0.5 * data.length());
    let relative = sub(body.velocity, beam_velocity(model, beam, centre));
    let speed = norm(relative);
    let seen = if speed > 0.0 { first_hit(model, data, centre, relative) } else { None };
    let s = match (at, seen) {
        (Some(place), _) if place.s.is_finite() => place.s,
        (Some(place), _) if place.position[0].is_finite() => nearest(model, data, place.position),
        (_, Some([s, _])) => s,
        _ => middle.s,
    };
    let place = BeamPlace::new(model, beam, s);
    // The force of the contact acts across the beam, however obliquely the disc flies.
    let across = rot90(place.tangent());
    let towards = dot(relative, across);
    let direction = scale(1.0_f64.copysign(towards), across);
    let half_depth = if place.half_depth().is_nan() { 0.0 } else { place.half_depth() };
    let steep = towards.abs() > 1e-3 * speed && speed > 0.0;
    let gap = seen.filter(|_| steep);
    let gap = gap.map(|[_, time]| (time * towards.abs() - radius - half_depth).max(0.0));
    Some(Meeting::Struck(Struck {
        mass: body.mass,
        rear: None,
        radius: (radius > 0.0).then_some(radius),
        direction,
        speed: towards.abs(),
        sideways: dot(relative, place.tangent()).abs(),
        gap,
        place,
    }))
}

fn points_of_beams<'a>(
    model: &'a Model,
    beam: usize,
    other: Option<usize>,
    target: &TargetShape,
) -> Option<Meeting<'a>> {
    let place = BeamPlace::in_the_middle(model, beam);
    let wall = match target {
        TargetShape::Line { normal } => Some(*normal),
        _ => None,
    };
    let velocity = beam_velocity(model, beam, place.position());
    Some(Meeting::Beams(Beams { place, wall, numbers: (beam, other), velocity }))
}

/// Force of a smooth law at a penetration and its rate \[N\].
pub fn force(law: &SmoothLaw, p: f64, rate: f64) -> f64 {
    (law.potential.force(p) * (1.0 + law.dissipation * rate)).max(0.0)
}

/// Contacts shorter than this share of the lowest mode's period are no case for one mass and one spring.
const SHORTEST: f64 = 0.25;

/// Stiffness of a linear spring without losses.
pub fn linear_stiffness(law: &TouchLaw) -> Option<f64> {
    let law = law.smooth().filter(|law| law.dissipation == 0.0 && law.unloading.is_none())?;
    match law.potential {
        Potential::Linear { stiffness } => Some(stiffness),
        _ => None,
    }
}

/// The impact of a mass on a rigid target under a smooth law, its losses left out, while the force `pressed` \[N\] presses it on; none
/// under a set-valued law, or at no speed where the speed matters.
pub fn rigid_impact(
    law: &TouchLaw,
    mass: f64,
    speed: f64,
    pressed: f64,
) -> Option<SingleMassImpact> {
    let law = law.smooth()?;
    if law.unloading.is_some() {
        return None; // what crushes opens otherwise than it closes
    }
    if pressed != 0.0 && !matches!(law.potential, Potential::Function(_)) {
        let (energy, force) = (|p| law.potential.energy(p), |p| law.potential.force(p));
        return pressed_impact(energy, force, mass, speed, pressed);
    }
    let impact = match &law.potential {
        Potential::Linear { stiffness } => linear_impact(mass, *stiffness, speed),
        Potential::Hertz { stiffness } => hertz_impact(mass, *stiffness, speed),
        Potential::Table { penetration, force } if speed > 0.0 => {
            table_impact(penetration, force, mass, speed)
        }
        Potential::Table { .. } | Potential::Function(_) => return None,
    };
    (impact.duration.is_finite() && impact.duration > 0.0).then_some(impact)
}
