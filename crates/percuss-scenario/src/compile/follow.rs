//! Which faults of the model follow from faults of reading.

use std::collections::BTreeSet;

use percuss::Fault;

use crate::content::{
    Anchor, Beam, Content, LoadKind, ObstacleKind, Partner, PartnerKind, Shape, Touch,
};
use crate::table::Named;

/// Beams of at most so many elements are enough to find the faults that do not depend on the mesh.
const ELEMENTS: usize = 64;

/// The beam with a mesh that costs little, and all the faults that the fine one has.
pub(super) fn coarsen(beam: &mut Beam) {
    let enough = ELEMENTS + beam.points.len() + beam.changes.len();
    let steps = beam.points.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]));
    let length: f64 = steps.sum();
    beam.elements = beam.elements.map(|n| n.min(enough));
    beam.element_length = beam.element_length.map(|h| match h > 0.0 {
        true => h.max(length / enough as f64),
        false => h,
    });
}

/// Removes the faults that may come of placeholders at the `tainted` paths.
pub(super) fn keep_valid(content: &Content, tainted: &BTreeSet<String>, faults: &mut Vec<Fault>) {
    let mut tainted = tainted.clone();
    for Named { name, table } in &content.section {
        let Shape::Tapered { sections, .. } = &table.shape else { continue };
        let bad = |of: &String| tainted.iter().any(|t| t.starts_with(&format!("section.{of}.")));
        if sections.iter().any(bad) {
            tainted.insert(format!("section.{name}"));
        }
    }
    faults.retain(|fault| {
        !tainted.iter().any(|path| follows(&fault.path, path))
            && !mentions(content, &fault.path).iter().any(|beam| {
                let line = |key: &str| tainted.contains(&format!("beam.{beam}.{key}"));
                beam.is_empty() || line("points") || line("curve")
            })
    });
}

/// Whether a fault at `fault` may come from a placeholder at `tainted`.
fn follows(fault: &str, tainted: &str) -> bool {
    let ((table, key), bad_table) = (split(fault), split(tainted).0);
    let within = |inner: &str, outer: &str| {
        inner == outer || inner.strip_prefix(outer).is_some_and(|rest| rest.starts_with('.'))
    };
    if within(fault, tainted) || fault.contains('.') && within(tainted, fault) {
        return true;
    }
    let (bad_kind, bad_key) = (tainted.split('.').next().unwrap_or_default(), split(tainted).1);
    let unread = bad_table == bad_kind || matches!(bad_key, "strikes" | "between");
    match (bad_kind, table, key) {
        ("projectile" | "contact", _, "scheme") => return true,
        ("projectile" | "contact", "obstacle", _) if unread => return true, // what touches it
        _ => {}
    }
    let related: &[&str] = match key {
        "end" | "step" | "accuracy" => &["end", "step", "accuracy"],
        "from" | "until" => &["from", "until"],
        "velocity" | "direction" => &["velocity", "direction"],
        "strikes" => &["velocity", "direction"],
        "position" => &["velocity", "direction", "strikes", "standoff", "radius"],
        "penetrations" | "forces" => &["penetrations", "forces", "file"],
        "hertz_stiffness" => &["hertz"],
        "points" | "curve" => &["points", "curve"],
        "elements" | "element_length" => {
            &["points", "curve", "changes", "elements", "element_length"]
        }
        "grading" => &["points", "curve", "elements", "element_length"],
        "changes" => &["points", "curve", "elements", "element_length"],
        "heights" | "areas" | "materials" => &["heights", "areas", "materials", "depth"],
        "stations" | "sections" => &["stations", "sections"],
        "times" | "values" => &["times", "values", "file"],
        "modal" | "modes" => &["modal", "modes"],
        "force" | "moment" => &["force", "moment"],
        "stiffness" => &["damping", "rotational_stiffness", "rotational_damping"],
        "width" | "depth" | "diameter" | "thickness" | "flange" | "web" => {
            &["width", "depth", "diameter"]
        }
        _ => &[],
    };
    // Tables in braces stand within the table that is meant.
    related.iter().any(|key| within(tainted, &format!("{table}.{key}")))
}

/// Table and key of a path.
fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('.').unwrap_or(("", path))
}

/// The beams of the points given at a path: whether these exist depends on the geometry of the beams.
/// A point that could not be read is on a beam without a name.
fn mentions<'c>(content: &'c Content, path: &str) -> Vec<&'c str> {
    fn table<'c, T>(tables: &'c [Named<T>], kind: &str, path: &str) -> Option<&'c T> {
        let name = path.strip_prefix(kind)?.strip_prefix('.')?;
        tables.iter().find(|t| t.name == name).map(|t| &t.table)
    }
    let (owner, key) = split(path);
    match key {
        "at" => {
            let support = table(&content.support, "support", owner).map(|s| &s.at);
            let mass = table(&content.mass, "mass", owner).map(|m| &m.at);
            let load = table(&content.load, "load", owner).and_then(|l| match &l.kind {
                LoadKind::Point { at, .. } => Some(at),
                LoadKind::Gravity { .. } | LoadKind::Base { .. } | LoadKind::Distributed { .. } => {
                    None
                }
            });
            let obstacle = table(&content.obstacle, "obstacle", owner);
            let obstacle = obstacle.and_then(|o| match &o.kind {
                ObstacleKind::Clearance { at, .. } => Some(at),
                _ => None,
            });
            let all = support.into_iter().chain(mass).chain(load).chain(obstacle);
            all.map(|p| p.beam.as_str()).collect()
        }
        "stretch" => match table(&content.load, "load", owner).map(|l| &l.kind) {
            Some(LoadKind::Distributed { on, .. }) => vec![on],
            _ => Vec::new(),
        },
        "strikes" | "position" => {
            let projectile = table(&content.projectile, "projectile", owner);
            projectile.map(|p| struck(&p.contact)).unwrap_or_default()
        }
        "between" => {
            let joint = table(&content.joint, "joint", owner).into_iter();
            let spring = table(&content.spring, "spring", owner).into_iter();
            let ends = spring.flat_map(|s| &s.between).filter_map(|anchor| match anchor {
                Anchor::Point(point) => Some(point),
                Anchor::Projectile(_) | Anchor::Ground(_) => None,
            });
            let points = joint.flat_map(|j| &j.between).chain(ends).map(|p| p.beam.as_str());
            let contact = table(&content.contact, "contact", owner).into_iter();
            points.chain(contact.flat_map(|c| &c.between).filter_map(beam)).collect()
        }
        "points" if path == "record.points" => {
            content.record.points.iter().map(|p| p.beam.as_str()).collect()
        }
        "point" if path == "path.until.point" => {
            content.path.until.iter().map(|reach| reach.point.beam.as_str()).collect()
        }
        _ => Vec::new(),
    }
}

/// The beams that a projectile strikes by name.
fn struck(contact: &Touch) -> Vec<&str> {
    match contact {
        Touch::Point { strikes, .. } => vec![&strikes.beam],
        Touch::Surface { strikes, .. } => {
            let point = strikes.iter().filter_map(|s| s.point.as_ref()).map(|p| p.beam.as_str());
            point.chain(strikes.iter().flat_map(|s| &s.partners).filter_map(beam)).collect()
        }
    }
}

fn beam(partner: &Partner) -> Option<&str> {
    (partner.kind == PartnerKind::Beam).then_some(partner.name.as_str())
}
