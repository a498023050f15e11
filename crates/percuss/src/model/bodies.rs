//! Rigid bodies: the masses of guided projectiles, discs, obstacles.

use super::builder::ModelBuilder;
use super::check;
use super::connect::drive;
use super::definition::*;
use super::frozen::*;
use super::material_points::locate;
use super::time_function::PreparedFunction;
use crate::element::beam::NodeFrame;
use crate::math::vec2::{norm, rot90, scale, sub};

/// Adds the bodies after the beams' nodes, with their guides and prescribed motions.
pub(super) fn place(builder: &ModelBuilder, model: &mut Model) {
    for projectile in &builder.projectiles {
        guided(projectile, model);
    }
    for disc in &builder.discs {
        let own = 0.5 * disc.mass * disc.radius * disc.radius;
        model.total_mass += disc.mass;
        push(
            model,
            disc.position,
            Body {
                name: disc.name.clone(),
                kind: BodyKind::Disc { radius: disc.radius },
                mass: disc.mass,
                // A point has no arm: any inertia will do.
                inertia: disc.inertia.unwrap_or(if own > 0.0 { own } else { disc.mass }),
                velocity: disc.velocity,
                spin: disc.spin,
            },
        );
    }
    for item in &builder.obstacles {
        obstacle(item, model);
    }
    if model.node_count() == 1 && !builder.springs.is_empty() {
        ground(model); // a point of a spring lies between two nodes
    }
}

fn push(model: &mut Model, position: [f64; 2], body: Body) -> usize {
    model.nodes.push(NodeFrame { position, tangent: [0.0; 2] });
    model.bodies.push(body);
    model.nodes.len() - 1
}

fn guided(projectile: &Projectile, model: &mut Model) {
    let point = locate(model, &projectile.strikes);
    let line = check::line_of_motion(projectile).unwrap_or([f64::NAN; 2]);
    let direction = scale(1.0 / norm(line), line);
    let position = sub(point.position, scale(projectile.standoff, direction));
    let front = Body {
        name: projectile.name.clone(),
        kind: BodyKind::Guided,
        mass: projectile.mass,
        inertia: projectile.mass,
        velocity: projectile.velocity,
        spin: 0.0,
    };
    let rear = projectile.rear.map(|rear| Body {
        kind: BodyKind::Rear { direction, stiffness: rear.stiffness, damping: rear.damping },
        mass: rear.mass,
        inertia: rear.mass,
        ..front.clone()
    });
    let has_rear = rear.is_some();
    let body = model.bodies.len();
    for body in [Some(front), rear].into_iter().flatten() {
        model.total_mass += body.mass;
        let node = push(model, position, body);
        let across = rot90(direction);
        let mut guide = PrescribedDofs::new(node, None);
        for normal in [[across[0], across[1], 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
        {
            guide.hold(normal, Vec::new());
        }
        model.prescribed.push(guide);
    }
    if projectile.local_mass > 0.0 {
        model.total_mass += projectile.local_mass;
        let mass = projectile.local_mass;
        model.masses.push(MassData { point: point.clone(), mass, rotary_inertia: 0.0 });
    }
    model.projectiles.push(ProjectileData { body, has_rear, direction, point });
}

fn obstacle(item: &Obstacle, model: &mut Model) {
    let position = match &item.shape {
        ObstacleShape::HalfPlane { point, .. } => *point,
        ObstacleShape::Disc { centre, .. } => *centre,
        ObstacleShape::Segment { ends: [a, b], .. } => [0, 1].map(|i| 0.5 * (a[i] + b[i])),
        ObstacleShape::Clearance { at, .. } => locate(model, at).position,
    };
    let motion = item.motion.as_ref().map(|motion| {
        model.motions.push(PreparedFunction::new(&motion.function));
        model.motions.len() - 1
    });
    let body = match &item.motion {
        Some(given) => held_body(model, &item.name, position, motion, given.displacement),
        None => ground(model),
    };
    let support = model.supports.len();
    let (name, until) = (item.name.clone(), f64::INFINITY);
    // Its contacts follow.
    let (stops, rigid) = (false, false);
    model.supports.push(SupportData { name, point: None, until, motion, stops, rigid });
    model.obstacles.push(ObstacleData { body, support, position });
}

/// The body of all fixed obstacles.
fn ground(model: &mut Model) -> usize {
    let known = |b: &Body| b.kind == BodyKind::Obstacle && b.name.is_empty();
    let found = model.bodies.iter().position(known);
    found.unwrap_or_else(|| held_body(model, "", [0.0; 2], None, [0.0; 2]))
}

/// A body that is fixed or moves as prescribed.
fn held_body(
    model: &mut Model,
    name: &str,
    position: [f64; 2],
    motion: Option<usize>,
    displacement: [f64; 2],
) -> usize {
    let body = Body {
        name: name.into(),
        kind: BodyKind::Obstacle,
        mass: 0.0,
        inertia: 0.0,
        velocity: [0.0; 2],
        spin: 0.0,
    };
    let node = push(model, position, body);
    let along = |i: usize| drive(motion, displacement[i]);
    let mut all = PrescribedDofs::new(node, None);
    for (i, drive) in [along(0), along(1), Vec::new(), Vec::new()].into_iter().enumerate() {
        all.hold(std::array::from_fn(|k| f64::from(u8::from(i == k))), drive);
    }
    model.prescribed.push(all);
    model.bodies.len() - 1
}
