//! Definitions of the core from the tables of the file.

use percuss::{Fault, ModelBuilder};

use super::beams::Beams;
use super::function::function;
use super::{contact, foundation, law, yielding};
use crate::content::{
    self, Anchor, Content, JointKind, LoadKind, ModalRatios, ProjectileKind, SpringLaw,
    SupportKind, Touch,
};
use crate::given::Given;
use crate::node::count;
use crate::table::Named;

/// Everything the file defines, and the faults that the core would not find or not find in its place.
pub(super) fn definitions(content: &Content, given: Option<&Given>) -> (ModelBuilder, Vec<Fault>) {
    let (mut builder, mut faults) = (ModelBuilder::new(), Vec::new());
    let beams = Beams::add(content, &mut builder, &mut faults);
    supports(content, given, &beams, &mut builder, &mut faults);
    connections(content, &beams, &mut builder, &mut faults);
    for Named { name, table } in &content.foundation {
        builder.foundation(foundation::definition(name, table, &beams, &mut faults));
    }
    guided(content, given, &beams, &mut builder, &mut faults);
    contact::add(content, given, &beams, &mut builder, &mut faults);
    loads(content, given, &beams, &mut builder, &mut faults);
    let end = content.path.until.iter().map(|reach| &reach.point);
    for at in content.record.points.iter().chain(end) {
        builder.record_point(beams.point(at));
    }
    builder.initial_motion(motion(&content.initial.all));
    for Named { name, table } in &content.initial.of {
        builder.initial_motion_of(name.as_str(), motion(table));
    }
    builder.modal_damping(ratios(&content.damping, &mut faults));
    (builder, faults)
}

fn motion(motion: &content::InitialMotion) -> percuss::InitialMotion {
    let content::InitialMotion { velocity, spin, about } = *motion;
    percuss::InitialMotion { velocity, spin, about }
}

fn supports(
    content: &Content,
    given: Option<&Given>,
    beams: &Beams<'_>,
    builder: &mut ModelBuilder,
    faults: &mut Vec<Fault>,
) {
    for Named { name, table } in &content.support {
        let path = format!("support.{name}.motion.function");
        let motion = table.motion.as_ref().map(|motion| percuss::Motion {
            displacement: motion.displacement,
            rotation: motion.rotation,
            function: function(&path, &motion.function, given, faults),
        });
        builder.support(percuss::Support {
            name: name.clone(),
            at: beams.point(&table.at),
            kind: support_kind(&table.kind),
            motion,
            until: table.until,
        });
    }
}

/// Joints, springs and point masses.
fn connections(
    content: &Content,
    beams: &Beams<'_>,
    builder: &mut ModelBuilder,
    faults: &mut Vec<Fault>,
) {
    for Named { name, table } in &content.joint {
        let between = [0, 1].map(|i| beams.point(&table.between[i]));
        let kind = joint_kind(&table.kind);
        let yielding = yielding::of_joint(name, &table.kind, faults);
        let strength = table
            .strength
            .as_ref()
            .map(|given| percuss::JointStrength { force: given.force, moment: given.moment });
        builder.joint(percuss::Joint { name: name.clone(), kind, between, yielding, strength });
    }
    for Named { name, table } in &content.spring {
        let anchor = |anchor: &Anchor| match anchor {
            Anchor::Point(point) => percuss::Anchor::Point(beams.point(point)),
            Anchor::Projectile(name) => percuss::Anchor::Projectile(name.clone()),
            Anchor::Ground(place) => percuss::Anchor::Ground(*place),
        };
        builder.spring(percuss::Spring {
            name: name.clone(),
            between: [anchor(&table.between[0]), anchor(&table.between[1])],
            law: spring_law(&table.law),
            damping: table.damping,
            length: table.length,
            strength: table.strength,
            yielding: yielding::of_spring(name, &table.law, faults),
        });
    }
    for Named { name, table } in &content.mass {
        builder.point_mass(percuss::PointMass {
            name: name.clone(),
            at: beams.point(&table.at),
            mass: table.mass,
            rotary_inertia: table.rotary_inertia,
        });
    }
}

fn spring_law(law: &SpringLaw) -> percuss::SpringLaw {
    match law {
        SpringLaw::Linear { stiffness, .. } => percuss::SpringLaw::Linear { stiffness: *stiffness },
        SpringLaw::Tension { stiffness, slack } => {
            percuss::SpringLaw::Tension { stiffness: *stiffness, slack: *slack }
        }
        SpringLaw::Compression { stiffness, gap } => {
            percuss::SpringLaw::Compression { stiffness: *stiffness, gap: *gap }
        }
        SpringLaw::Table { extensions, forces } => {
            percuss::SpringLaw::Table { extension: extensions.clone(), force: forces.clone() }
        }
    }
}

/// Projectiles that are guided to a point.
fn guided(
    content: &Content,
    given: Option<&Given>,
    beams: &Beams<'_>,
    builder: &mut ModelBuilder,
    faults: &mut Vec<Fault>,
) {
    for Named { name, table } in &content.projectile {
        let Touch::Point { strikes, standoff, rear, local_mass } = &table.contact else { continue };
        let kind = match &table.kind {
            ProjectileKind::Elastic { law } => {
                let law = law::smooth(&format!("projectile.{name}"), law, given, faults);
                percuss::ProjectileKind::Elastic { law }
            }
            ProjectileKind::Rigid { restitution } => {
                percuss::ProjectileKind::Rigid { restitution: *restitution }
            }
        };
        let rear = rear.as_ref().map(|rear| percuss::RearMass {
            mass: rear.mass,
            stiffness: rear.stiffness,
            damping: rear.damping,
        });
        builder.projectile(percuss::Projectile {
            name: name.clone(),
            kind,
            mass: table.mass,
            velocity: table.velocity,
            direction: table.direction,
            strikes: beams.point(strikes),
            standoff: *standoff,
            rear,
            local_mass: *local_mass,
        });
    }
}

fn loads(
    content: &Content,
    given: Option<&Given>,
    beams: &Beams<'_>,
    builder: &mut ModelBuilder,
    faults: &mut Vec<Fault>,
) {
    for Named { name, table } in &content.load {
        builder.load(percuss::Load {
            name: name.clone(),
            kind: load_kind(&table.kind, beams),
            function: function(&format!("load.{name}.function"), &table.function, given, faults),
            from: table.from,
            until: table.until,
        });
    }
}

/// Most modes that one ratio may damp.
const MODES: usize = 10_000;

fn ratios(damping: &content::Damping, faults: &mut Vec<Fault>) -> Vec<f64> {
    match (&damping.modal, damping.modes) {
        (ModalRatios::Each(ratios), _) => ratios.clone(),
        (ModalRatios::All(ratio), Some(modes)) if (1..=MODES).contains(&modes) => {
            vec![*ratio; modes]
        }
        (ModalRatios::All(_), modes) => {
            let found = count(modes.unwrap_or_default(), "mode");
            let expected = format!("from 1 to {MODES} modes");
            faults.push(Fault::new("damping.modes", found, expected));
            Vec::new()
        }
    }
}

fn support_kind(kind: &SupportKind) -> percuss::SupportKind {
    match kind.clone() {
        SupportKind::Clamp => percuss::SupportKind::Clamp,
        SupportKind::Pin => percuss::SupportKind::Pin,
        SupportKind::Roller { direction } => percuss::SupportKind::Roller { direction },
        SupportKind::Fix { components } => percuss::SupportKind::Fix { components },
        SupportKind::Elastic {
            direction,
            stiffness,
            damping,
            rotational_stiffness,
            rotational_damping,
        } => percuss::SupportKind::Elastic {
            direction,
            stiffness,
            damping,
            rotational_stiffness,
            rotational_damping,
        },
        SupportKind::Stop { direction, gap, stiffness, two_sided } => {
            percuss::SupportKind::Stop { direction, gap, stiffness, two_sided }
        }
    }
}

fn joint_kind(kind: &JointKind) -> percuss::JointKind {
    match *kind {
        JointKind::Rigid => percuss::JointKind::Rigid,
        JointKind::Hinge { stiffness: 0.0, damping: 0.0, yield_moment: None, .. } => {
            percuss::JointKind::Hinge
        }
        JointKind::Hinge { stiffness, damping, .. } => {
            percuss::JointKind::ElasticHinge { stiffness, damping }
        }
    }
}

fn load_kind(kind: &LoadKind, beams: &Beams<'_>) -> percuss::LoadKind {
    match kind {
        LoadKind::Gravity { acceleration } => {
            percuss::LoadKind::Gravity { acceleration: *acceleration }
        }
        LoadKind::Base { acceleration } => percuss::LoadKind::Base { acceleration: *acceleration },
        LoadKind::Point { at, force, moment, follower } => percuss::LoadKind::Point {
            at: beams.point(at),
            force: *force,
            moment: *moment,
            follower: *follower,
        },
        LoadKind::Temperature { on, stretch, change, gradient } => percuss::LoadKind::Temperature {
            beam: beams.id(on),
            stretch: *stretch,
            change: *change,
            gradient: *gradient,
        },
        LoadKind::Strain { on, stretch, strain, curvature } => percuss::LoadKind::Strain {
            beam: beams.id(on),
            stretch: *stretch,
            strain: *strain,
            curvature: *curvature,
        },
        LoadKind::Distributed { on, stretch, force, force_end, follower } => {
            percuss::LoadKind::Distributed {
                beam: beams.id(on),
                stretch: *stretch,
                force: [*force, force_end.unwrap_or(*force)],
                follower: *follower,
            }
        }
    }
}
