//! Projectiles: guided to a point of a beam, or free in the plane.

use super::law::{Sliding, Smooth};
use crate::format::Maybe;
use crate::measure;
use crate::node::{Body, Reader};
use crate::partner::{Strikes, StrikesText};
use crate::point::{Point, PointText};
use crate::quantity::{Quantity, Vector};
use crate::source::join;
use crate::table::{Braces, Declared};
use crate::write::Writer;

kinds! {
    /// What strikes.
    pub enum ProjectileKind by "kind" {
        /// A mass behind a massless spring.
        Elastic = "elastic" {} with {
            /// Law of the spring.
            law: Smooth
        },
        /// A rigid mass under an impact law.
        Rigid = "rigid" {
            /// Coefficient of restitution, from 0 to 1.
            restitution: f64 as Quantity<measure::Ratio>,
        },
    }
}

kinds! {
    /// Where a projectile touches.
    pub enum Touch by "contact" default "point" {
        /// Guided along a fixed line of flight, it touches a fixed material point of a beam.
        Point = "point" {
            /// The point struck.
            strikes: Point as PointText,
            /// Initial distance from the beam along the line of flight (m).
            standoff: f64 as Quantity<measure::Length> = 0.0,
            /// A second mass behind it.
            rear: Option<Rear> as Maybe<Braces<Rear>> = None,
            /// Mass that the struck point carries in itself (kg): what a blow meets first, however fine the mesh.
            local_mass: f64 as Quantity<measure::Mass> = 0.0,
        },
        /// Free in the plane, it touches whatever it strikes on its surface.
        Surface = "surface" {
            /// A point that it flies at, a name, or a list of names of beams, obstacles and projectiles that may begin with
            /// a point; every beam if nothing is given.
            strikes: Option<Strikes> as Maybe<StrikesText> = None,
            /// Initial distance between its surface and that of the beam along its velocity (m), where it flies at a point.
            standoff: Option<f64> as Maybe<Quantity<measure::Length>> = None,
            /// Its centre at the start (m), where it flies at no point.
            position: Option<[f64; 2]> as Maybe<Vector<measure::Length>> = None,
            /// Radius (m); zero for a point.
            radius: f64 as Quantity<measure::Length> = 0.0,
            /// Moment of inertia about its centre (kg m^2); that of a solid disc if none is given.
            inertia: Option<f64> as Maybe<Quantity<measure::MassInertia>> = None,
            /// Angular velocity at the start, positive counter-clockwise (rad/s).
            spin: f64 as Quantity<measure::Spin> = 0.0,
        } with {
            /// What a rigid one does besides its restitution.
            sliding: Option<Sliding>
        },
    }
}

table! {
    /// A second mass of a projectile, behind the first one on its line of flight.
    pub struct Rear {
        /// Mass (kg).
        mass: f64 as Quantity<measure::Mass>,
        /// Stiffness of the spring between the two, which pushes and pulls (N/m).
        stiffness: f64 as Quantity<measure::Stiffness>,
        /// Damping of the same (N s/m).
        damping: f64 as Quantity<measure::Damping> = 0.0,
    }
}

table! {
    /// A projectile: it strikes a fixed point of a beam, or moves freely and touches what is in its way.
    pub struct Projectile {
        /// Mass (kg); of two masses, that of the front one.
        mass: f64 as Quantity<measure::Mass>,
        /// Initial velocity (m/s).
        velocity: [f64; 2] as Vector<measure::Velocity>,
        /// Line of flight towards the point it strikes; needed only where the velocity is zero.
        direction: Option<[f64; 2]> as Maybe<Vector<measure::Ratio>> = None,
    }
    with {
        /// What strikes.
        kind: ProjectileKind,
        /// Where it touches.
        contact: Touch,
    }
    then settle_projectile
}

/// Only a rigid projectile slides by a law, and a free one begins at a place or flies at a point.
fn settle_projectile(projectile: &mut Projectile, body: &Body<'_>, reader: &mut Reader<'_>) {
    let Touch::Surface { strikes, standoff, sliding, .. } = &mut projectile.contact else { return };
    match projectile.kind {
        ProjectileKind::Rigid { .. } => _ = sliding.get_or_insert_default(),
        ProjectileKind::Elastic { .. } => {
            let keys = Sliding::declared().keys.iter().filter_map(|key| body.get(key.name));
            for node in keys {
                let key = node.path.rsplit('.').next().unwrap_or_default();
                let found = format!("`{key}`, which belongs to kind = \"rigid\"");
                let expected = format!("no `{key}` for kind = \"elastic\"");
                reader.misplaced(&node.path, node.span, found, expected);
            }
        }
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
                let found = "a projectile that flies at no point";
                let expected = "a point in `strikes` instead of `position`, or none of this";
                reader.misplaced(&node.path, node.span, found, expected);
            }
        }
        (None, None) if !unread => {
            let expected = "`position`, its centre at the start, or a point in `strikes` that it \
                            flies at";
            reader.missing(body, "position", "no `position`", expected);
        }
        _ => {}
    }
}
