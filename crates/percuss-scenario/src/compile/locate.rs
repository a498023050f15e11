//! Faults of the core in the words of the file.

use percuss::Fault;

use crate::content::{Content, Law, PathTarget, Potential, ProjectileKind, Smooth, Strikes, Touch};
use crate::table::Named;

/// A fault of the core, whose names of things are not in all cases those of the file.
pub(super) fn in_file_words(content: &Content, fault: Fault) -> Fault {
    let fault = of_recorded_point(content, fault);
    let path = match fault.path.split_once('.') {
        Some(("disc", rest)) => format!("projectile.{rest}"),
        Some(("contact", rest)) => of_contact(content, rest),
        _ => fault.path,
    };
    Fault { path: of_law(content, path, &fault.found), ..fault }
}

/// A point that ends a path or is flown at is recorded as others are; its fault belongs there.
fn of_recorded_point(content: &Content, fault: Fault) -> Fault {
    let about = |label: &str| fault.found.starts_with(&format!("{label} "));
    let listed = content.record.points.iter().any(|point| about(&point.label));
    if fault.path != "record.points" || listed {
        return fault;
    }
    let flown_at = content.projectile.iter().find_map(|named| match &named.table.contact {
        Touch::Surface { strikes: Some(Strikes { point: Some(point), .. }), .. } => {
            about(&point.label).then(|| format!("projectile.{}.strikes", named.name))
        }
        _ => None,
    });
    let ends = match &content.path.until {
        Some(PathTarget { point, .. }) if about(&point.label) => Some("path.until.point".into()),
        _ => None,
    };
    Fault { path: ends.or(flown_at).unwrap_or(fault.path), ..fault }
}

/// The path of a contact: its own table, or the projectile that makes it.
fn of_contact(content: &Content, rest: &str) -> String {
    let (name, key) = rest.split_once('.').unwrap_or((rest, ""));
    let own = content.contact.iter().any(|named| named.name == name);
    let makes = |maker: &&Named<_>| {
        name.strip_prefix(maker.name.as_str())
            .is_some_and(|partner| partner.is_empty() || partner.starts_with('-'))
    };
    let maker = content.projectile.iter().filter(makes).max_by_key(|named| named.name.len());
    let (table, key) = match maker {
        Some(maker) if !own => {
            let key = if key == "between" { "strikes" } else { key };
            (format!("projectile.{}", maker.name), key)
        }
        _ => (format!("contact.{name}"), key),
    };
    if key.is_empty() { table } else { format!("{table}.{key}") }
}

/// The path of a value of a law: the key of the file that leads to it.
fn of_law(content: &Content, path: String, found: &str) -> String {
    let parts: Vec<&str> = path.split('.').collect();
    let &[kind, name, key] = &parts[..] else { return path };
    let Some(law) = law(content, kind, name) else { return path };
    let key = match (&law.potential, key) {
        (_, "dissipation") if law.rebound.is_some() => "rebound",
        (Potential::Hertz { hertz: Some(_), .. }, "stiffness") => "hertz",
        (Potential::Hertz { .. }, "stiffness") => "hertz_stiffness",
        (Potential::Table { .. }, "penetration") => "penetrations",
        // Of two values that the core calls so; the other is how the force is evaluated.
        (Potential::Table { .. }, "force") if !found.starts_with("dissipation") => "forces",
        (_, key) => key,
    };
    format!("{kind}.{name}.{key}")
}

/// The smooth law of a table.
fn law<'c>(content: &'c Content, kind: &str, name: &str) -> Option<&'c Smooth> {
    match kind {
        "projectile" => {
            let named = content.projectile.iter().find(|named| named.name == name)?;
            match &named.table.kind {
                ProjectileKind::Elastic { law } => Some(law),
                ProjectileKind::Rigid { .. } => None,
            }
        }
        "contact" => {
            let named = content.contact.iter().find(|named| named.name == name)?;
            match &named.table.law {
                Law::Smooth(law) => Some(law),
                Law::Rigid { .. } => None,
            }
        }
        _ => None,
    }
}
