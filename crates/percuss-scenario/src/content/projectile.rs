//! Projectiles: guided along a line, or free in the plane.

use super::law::{Sliding, Smooth};
use crate::format::Maybe;
use crate::measure;
use crate::node::{Body, Reader};
use crate::partner::{Strikes, StrikesText};
use crate::point::{Point, PointText};
use crate::quantity::{Quantity, Vector};
use crate::source::join;
use crate::table::Braces;
use crate::write::Writer;

kinds! {
    /// Contact of a projectile: compliant or rigid (nonsmooth).
    pub enum ProjectileKind by "kind" {
        /// Compliant contact: rigid mass with a contact spring.
        Elastic = "elastic" {} with {
            /// Law of the contact spring.
            law: Smooth
        },
        /// Rigid (nonsmooth) contact: rigid mass with restitution and friction.
        Rigid = "rigid" {
            /// Coefficient of restitution, from 0 to 1.
            restitution: f64 as Quantity<measure::Ratio>,
        },
    }
}

kinds! {
    /// Guided to a point of a beam, or free with contact on its surface.
    pub enum Touch by "contact" default "point" {
        /// Guided along a fixed line, in contact with a fixed material point of a beam.
        Point = "point" {
            /// Contact target: the point of a beam that it strikes.
            strikes: Point as PointText,
            /// Initial gap to the beam along the line of motion (m).
            standoff: f64 as Quantity<measure::Length> = 0.0,
            /// Secondary (trailing) mass behind it, on a spring.
            rear: Option<Rear> as Maybe<Braces<Rear>> = None,
            /// Added nodal mass at the struck point (kg), which makes rigid impacts independent of the mesh.
            local_mass: f64 as Quantity<measure::Mass> = 0.0,
        },
        /// Free in the plane, with contact on the surfaces of its targets.
        Surface = "surface" {
            /// Contact targets: a point, a name, or a list of names of beams, obstacles and projectiles that may begin with
            /// a point; all beams if omitted.
            strikes: Option<Strikes> as Maybe<StrikesText> = None,
            /// Initial gap between the surfaces along the velocity (m), for a point target.
            standoff: Option<f64> as Maybe<Quantity<measure::Length>> = None,
            /// Its centre at the start (m), without a point target.
            position: Option<[f64; 2]> as Maybe<Vector<measure::Length>> = None,
            /// Radius (m); zero for a point.
            radius: f64 as Quantity<measure::Length> = 0.0,
            /// Moment of inertia about its centre (kg m^2); that of a solid disc if none is given.
            inertia: Option<f64> as Maybe<Quantity<measure::MassInertia>> = None,
            /// Angular velocity at the start, positive counter-clockwise (rad/s).
            spin: f64 as Quantity<measure::Spin> = 0.0,
        } with {
            /// Friction and tangential restitution of a rigid contact.
            sliding: Option<Sliding>
        },
    }
}

table! {
    /// Secondary (trailing) mass of a projectile, behind the first one on its line of motion.
    pub struct Rear {
        /// Mass (kg).
        mass: f64 as Quantity<measure::Mass>,
        /// Stiffness of the spring between the two masses, in tension and compression (N/m).
        stiffness: f64 as Quantity<measure::Stiffness>,
        /// Damping of the spring (N s/m).
        damping: f64 as Quantity<measure::Damping> = 0.0,
    }
}

table! {
    /// Projectile: a rigid mass, guided to a point of a beam or free in the plane.
    pub struct Projectile {
        /// Mass (kg); of two masses, that of the front one.
        mass: f64 as Quantity<measure::Mass>,
        /// Initial velocity (m/s).
        velocity: [f64; 2] as Vector<measure::Velocity>,
        /// Direction of motion towards the target point; needed only where the velocity is zero.
        direction: Option<[f64; 2]> as Maybe<Vector<measure::Ratio>> = None,
    }
    with {
        /// Compliant ("elastic") or rigid (nonsmooth) contact of the mass, which is rigid in both.
        kind: ProjectileKind,
        /// Guided to a point, or free with contact on its surface.
        contact: Touch,
    }
    only Sliding: "kind" = "rigid"
    then settle_projectile
}

/// A rigid contact has friction, and a free projectile has a position or a target point.
fn settle_projectile(projectile: &mut Projectile, body: &Body<'_>, reader: &mut Reader<'_>) {
    let Touch::Surface { strikes, standoff, sliding, .. } = &mut projectile.contact else { return };
    if matches!(projectile.kind, ProjectileKind::Rigid { .. }) {
        sliding.get_or_insert_default();
    }
    let point = strikes.as_ref().and_then(|strikes| strikes.point.as_ref());
    if point.is_some() {
        standoff.get_or_insert(0.0);
    }
    let unread = reader.tainted.contains(&join(&body.path, "strikes"));
    match (body.get("position"), point) {
        (Some(position), Some(Point { label, .. })) => {
            let found = format!("`position` besides the point {label} in `strikes`");
            reader.misplaced(&position.path, position.span, found, "one of the two");
        }
        (Some(_), None) if !unread => {
            for node in ["standoff", "direction"].into_iter().filter_map(|key| body.get(key)) {
                let found = "a projectile without a target point";
                let expected = "a point in `strikes` instead of `position`, or none of this";
                reader.misplaced(&node.path, node.span, found, expected);
            }
        }
        (None, None) if !unread => {
            let expected = "`position`, its centre at the start, or a target point in `strikes`";
            reader.missing(body, "position", "no `position`", expected);
        }
        _ => {}
    }
}
