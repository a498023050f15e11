//! Definitions of the core from the tables of the file.

use std::collections::BTreeMap;

use percuss::{BeamId, ElementSize, Fault, MaterialId, ModelBuilder, SectionId};

use super::function::function;
use super::section::sections;
use crate::content::{
    self, Anchor, Content, JointKind, LoadKind, ModalRatios, ProjectileKind, SupportKind,
};
use crate::node::count;
use crate::point::Point;
use crate::table::Named;

/// Everything the file defines, and the faults that the core would not find or not find in its place.
pub(super) fn definitions(content: &Content) -> (ModelBuilder, Vec<Fault>) {
    let (mut builder, mut faults) = (ModelBuilder::new(), Vec::new());
    let beams = beams(content, &mut builder, &mut faults);
    let Some(&first) = beams.values().next() else {
        faults.push(Fault::new("beam", "no beam", "at least one beam [beam.NAME]"));
        return (builder, faults);
    };
    // The reader has checked the names; after a fault of reading any beam will do.
    let beam = |name: &str| beams.get(name).copied().unwrap_or(first);
    let point = |p: &Point| percuss::PointRef {
        label: p.label.clone(),
        beam: beam(&p.beam),
        along: p.along,
    };
    for Named { name, table } in &content.support {
        builder.support(percuss::Support {
            name: name.clone(),
            at: point(&table.at),
            kind: support_kind(&table.kind),
            motion: table.motion.as_ref().map(|motion| percuss::Motion {
                displacement: motion.displacement,
                rotation: motion.rotation,
                function: function(
                    &format!("support.{name}.motion.function"),
                    &motion.function,
                    &mut faults,
                ),
            }),
            until: table.until,
        });
    }
    for Named { name, table } in &content.joint {
        let between = [point(&table.between[0]), point(&table.between[1])];
        let kind = joint_kind(&table.kind);
        builder.joint(percuss::Joint { name: name.clone(), kind, between });
    }
    for Named { name, table } in &content.spring {
        let anchor = |anchor: &Anchor| match anchor {
            Anchor::Point(p) => percuss::Anchor::Point(point(p)),
            Anchor::Ground(place) => percuss::Anchor::Ground(*place),
        };
        builder.spring(percuss::Spring {
            name: name.clone(),
            between: [anchor(&table.between[0]), anchor(&table.between[1])],
            stiffness: table.stiffness,
            damping: table.damping,
            length: table.length,
        });
    }
    for Named { name, table } in &content.mass {
        builder.point_mass(percuss::PointMass {
            name: name.clone(),
            at: point(&table.at),
            mass: table.mass,
            rotary_inertia: table.rotary_inertia,
        });
    }
    for Named { name, table } in &content.projectile {
        builder.projectile(percuss::Projectile {
            name: name.clone(),
            kind: projectile_kind(&table.kind),
            mass: table.mass,
            velocity: table.velocity,
            direction: table.direction,
            strikes: point(&table.strikes),
            standoff: table.standoff,
            rear: None,
            local_mass: 0.0,
        });
    }
    for Named { name, table } in &content.load {
        let course = function(&format!("load.{name}.function"), &table.function, &mut faults);
        builder.load(percuss::Load {
            name: name.clone(),
            kind: load_kind(&table.kind, &point, &beam),
            function: course,
            from: table.from,
            until: table.until,
        });
    }
    let end = content.path.until.iter().map(|reach| &reach.point);
    for at in content.record.points.iter().chain(end) {
        builder.record_point(point(at));
    }
    let content::InitialMotion { velocity, spin, about } = content.initial;
    builder.initial_motion(percuss::InitialMotion { velocity, spin, about });
    builder.modal_damping(ratios(&content.damping, &mut faults));
    (builder, faults)
}

/// Adds materials, sections and beams; returns the beams by name.
fn beams<'c>(
    content: &'c Content,
    builder: &mut ModelBuilder,
    faults: &mut Vec<Fault>,
) -> BTreeMap<&'c str, BeamId> {
    let mut materials = BTreeMap::new();
    for Named { name, table } in &content.material {
        // Values that could not be read are told of already.
        let (young, density) = (table.young.unwrap_or(1.0), table.density.unwrap_or(1.0));
        let material = percuss::Material {
            strain: table.strain,
            retardation: table.retardation,
            mass_damping: table.mass_damping,
            ..percuss::Material::new(name.as_str(), young, density)
        };
        materials.insert(name.as_str(), builder.material(material));
    }
    let mut ids = BTreeMap::new();
    for (section, Named { name, .. }) in sections(content, faults).into_iter().zip(&content.section)
    {
        ids.insert(name.as_str(), builder.section(section));
    }
    let mut beams = BTreeMap::new();
    for Named { name, table } in &content.beam {
        let material = materials.get(table.material.as_str()).copied();
        let section = ids.get(table.section.as_str()).copied();
        let (material, section) = stand_ins(name, material, section, builder);
        let change = |change: &content::Change| percuss::Change {
            at: change.at,
            material: change.material.as_ref().and_then(|m| materials.get(m.as_str()).copied()),
            section: change.section.as_ref().and_then(|s| ids.get(s.as_str()).copied()),
        };
        let grading = table.grading.as_ref();
        let beam = percuss::Beam {
            name: name.clone(),
            points: table.points.clone(),
            curve: table.curve,
            mesh: percuss::Mesh {
                size: match (table.elements, table.element_length) {
                    (None, Some(length)) => ElementSize::Length(length),
                    (elements, _) => ElementSize::Number(elements.unwrap_or(1)),
                },
                grading: grading.map(|g| percuss::Grading { towards: g.towards, ratio: g.ratio }),
            },
            material,
            section,
            changes: table.changes.iter().map(change).collect(),
        };
        beams.insert(name.as_str(), builder.beam(beam));
    }
    beams
}

/// A material and a section for a beam whose own could not be read, under names no file can give.
fn stand_ins(
    beam: &str,
    material: Option<MaterialId>,
    section: Option<SectionId>,
    builder: &mut ModelBuilder,
) -> (MaterialId, SectionId) {
    let name = format!(" {beam}");
    let material = material
        .unwrap_or_else(|| builder.material(percuss::Material::new(name.as_str(), 1.0, 1.0)));
    let section =
        section.unwrap_or_else(|| builder.section(percuss::Section::new(name.as_str(), 1.0, 1.0)));
    (material, section)
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
        JointKind::Hinge { stiffness: 0.0, damping: 0.0 } => percuss::JointKind::Hinge,
        JointKind::Hinge { stiffness, damping } => {
            percuss::JointKind::ElasticHinge { stiffness, damping }
        }
    }
}

fn projectile_kind(kind: &ProjectileKind) -> percuss::ProjectileKind {
    match *kind {
        ProjectileKind::Elastic { stiffness, force } => {
            let potential = percuss::Potential::Linear { stiffness };
            let law = percuss::SmoothLaw { force, ..percuss::SmoothLaw::elastic(potential) };
            percuss::ProjectileKind::Elastic { law }
        }
        ProjectileKind::Rigid { restitution } => percuss::ProjectileKind::Rigid { restitution },
    }
}

fn load_kind(
    kind: &LoadKind,
    point: &impl Fn(&Point) -> percuss::PointRef,
    beam: &impl Fn(&str) -> BeamId,
) -> percuss::LoadKind {
    match kind {
        LoadKind::Gravity { acceleration } => {
            percuss::LoadKind::Gravity { acceleration: *acceleration }
        }
        LoadKind::Point { at, force, moment, follower } => percuss::LoadKind::Point {
            at: point(at),
            force: *force,
            moment: *moment,
            follower: *follower,
        },
        LoadKind::Distributed { on, stretch, force, force_end, follower } => {
            percuss::LoadKind::Distributed {
                beam: beam(on),
                stretch: *stretch,
                force: [*force, force_end.unwrap_or(*force)],
                follower: *follower,
            }
        }
    }
}
