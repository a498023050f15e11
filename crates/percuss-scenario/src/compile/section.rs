//! Cross sections from their dimensions.

use std::collections::BTreeMap;

use percuss::{Fault, MaterialId, Section, SectionFibre, Station, StationProperties};

use super::known;
use crate::content::{self, Content, Shape};
use crate::node::count;
use crate::table::Named;

/// Every section of the file; one at fault becomes a harmless one, so that the rest can be checked.
pub(super) fn sections(
    content: &Content,
    materials: &BTreeMap<&str, MaterialId>,
    faults: &mut Vec<Fault>,
) -> Vec<Section> {
    let mut uniform = BTreeMap::new();
    for named in &content.section {
        if !matches!(named.table.shape, Shape::Tapered { .. }) {
            let before = faults.len();
            dimensions(named, faults);
            let valid = faults.len() == before;
            uniform.insert(named.name.as_str(), valid.then(|| uniform_section(named, materials)));
        }
    }
    for (name, profile) in known::profiles(content) {
        uniform.insert(name, Some(profile.section(name)));
    }
    let one = |named: &Named<content::Section>| {
        let section = match &named.table.shape {
            Shape::Tapered { stations, sections } => {
                tapered(named, (stations, sections), &uniform, faults)
            }
            _ => uniform.get(named.name.as_str()).cloned().flatten(),
        };
        section.unwrap_or_else(|| {
            let plain = Section::new(named.name.as_str(), 1.0, 1.0);
            with_properties(&named.table, plain)
        })
    };
    content.section.iter().map(one).collect()
}

/// Faults of the dimensions of a shape; what is given explicitly is checked by the core.
fn dimensions(named: &Named<content::Section>, faults: &mut Vec<Fault>) {
    let mut fault = |key: &str, found: String, expected: String| {
        faults.push(Fault::new(format!("section.{}.{key}", named.name), found, expected));
    };
    let all: &[(&str, f64)] = match &named.table.shape {
        Shape::Explicit { depth, .. } | Shape::Fibres { depth, .. } => {
            &[("depth", depth.unwrap_or(1.0))]
        }
        Shape::Rectangle { width, depth } => &[("width", *width), ("depth", *depth)],
        Shape::Circle { diameter } => &[("diameter", *diameter)],
        Shape::Tube { diameter, thickness } => {
            &[("diameter", *diameter), ("thickness", *thickness)]
        }
        Shape::I { width, depth, flange, web } => {
            &[("width", *width), ("depth", *depth), ("flange", *flange), ("web", *web)]
        }
        Shape::Box { width, depth, thickness } => {
            &[("width", *width), ("depth", *depth), ("thickness", *thickness)]
        }
        Shape::Profile { .. } | Shape::Tapered { .. } => &[],
    };
    let mut valid = lists(named, &mut fault);
    for (key, value) in all.iter().filter(|(_, value)| *value <= 0.0) {
        fault(key, format!("{value} m"), format!("a {key} above zero"));
        valid = false;
    }
    if !valid {
        return;
    }
    let mut below = |key: &str, value: f64, limit: f64, of: &str| {
        if value >= limit {
            fault(key, format!("{value} m"), format!("less than {of}, {limit} m"));
        }
    };
    match named.table.shape {
        Shape::Tube { diameter, thickness } => {
            below("thickness", thickness, 0.5 * diameter, "half the diameter");
        }
        Shape::I { width, depth, flange, web } => {
            below("flange", flange, 0.5 * depth, "half the depth");
            below("web", web, width, "the width");
        }
        Shape::Box { width, depth, thickness } => {
            below("thickness", thickness, 0.5 * width.min(depth), "half the smaller side");
        }
        _ => {}
    }
}

/// Whether the lists of fibres go together.
fn lists(named: &Named<content::Section>, fault: &mut impl FnMut(&str, String, String)) -> bool {
    let Shape::Fibres { heights, areas, materials, .. } = &named.table.shape else { return true };
    let mut valid = true;
    let mut report = |key: &str, found: String, expected: &str| {
        fault(key, found, expected.to_owned());
        valid = false;
    };
    let fibres = count(heights.len(), "fibre");
    if areas.len() != heights.len() {
        let found = format!("{} for {fibres}", count(areas.len(), "area"));
        report("areas", found, "an area for each height");
    }
    if let Some(materials) = materials
        && materials.len() != heights.len()
    {
        let found = format!("{} for {fibres}", count(materials.len(), "material"));
        report("materials", found, "a material for each height, or no `materials`");
    }
    if named.table.fibres != Section::FIBRES {
        let found = format!("{} of a section whose fibres are listed", named.table.fibres);
        report("fibres", found, "no number: as many as there are heights");
    }
    valid
}

/// A section that does not vary along a beam.
fn uniform_section(
    named: &Named<content::Section>,
    materials: &BTreeMap<&str, MaterialId>,
) -> Section {
    with_properties(&named.table, shaped(named, materials))
}

/// A section with the properties that are given beside its shape.
fn with_properties(table: &content::Section, section: Section) -> Section {
    let content::Section { rotary_inertia, fibres, shear_factor, .. } = *table;
    Section { rotary_inertia, fibres, shear_factor, ..section }
}

fn shaped(named: &Named<content::Section>, known: &BTreeMap<&str, MaterialId>) -> Section {
    let name = named.name.as_str();
    match named.table.shape {
        Shape::Fibres { ref heights, ref areas, ref materials, depth } => {
            let material = |i: usize| known.get(materials.as_ref()?.get(i)?.as_str()).copied();
            let both = heights.iter().zip(areas).enumerate();
            let fibre =
                |(i, (&height, &area))| SectionFibre { height, area, material: material(i) };
            let section = Section::of_fibres(name, both.map(fibre).collect());
            Section { depth: depth.or(section.depth), ..section }
        }
        Shape::Explicit { area, inertia, depth } => {
            Section { depth, ..Section::new(name, area, inertia) }
        }
        Shape::Rectangle { width, depth } => Section::rectangle(name, width, depth),
        Shape::Circle { diameter } => Section::circle(name, diameter),
        Shape::Tube { diameter, thickness } => Section::tube(name, diameter, thickness),
        Shape::I { width, depth, flange, web } => Section::i_shape(name, width, depth, flange, web),
        Shape::Box { width, depth, thickness } => {
            Section::hollow_box(name, width, depth, thickness)
        }
        Shape::Profile { ref profile } => profile.section(name),
        Shape::Tapered { .. } => Section::new(name, 1.0, 1.0),
    }
}

/// A tapered section; `None` where it, or a section it names, has a fault. Its stations have all properties of the sections there; where it has
/// properties of its own, these come first.
fn tapered(
    named: &Named<content::Section>,
    (stations, sections): (&[f64], &[String]),
    uniform: &BTreeMap<&str, Option<Section>>,
    faults: &mut Vec<Fault>,
) -> Option<Section> {
    let name = named.name.as_str();
    let mut fault = |key: &str, found: String, expected: &str| {
        faults.push(Fault::new(format!("section.{name}.{key}"), found, expected));
    };
    if sections.len() != stations.len() {
        let [given, wanted] = [count(sections.len(), "section"), count(stations.len(), "station")];
        let found = format!("{given} for {wanted}");
        fault("sections", found, "a section for each station");
        return None;
    }
    let (ends, expected) = ([stations.first(), stations.last()], "stations from 0 to 1");
    if stations.len() < 2 {
        fault(
            "stations",
            count(stations.len(), "station"),
            "at least two, the first 0 and the last 1",
        );
        return None;
    } else if ends != [Some(&0.0), Some(&1.0)] {
        let [first, last] = ends.map(|end| end.copied().unwrap_or_default());
        fault("stations", format!("stations from {first} to {last}"), expected);
        return None;
    } else if let Some(pair) = stations.windows(2).find(|pair| pair[1] <= pair[0]) {
        fault("stations", format!("{} after {}", pair[1], pair[0]), "stations that increase");
        return None;
    }
    if let Some(bad) = sections.iter().find(|s| !uniform.contains_key(s.as_str())) {
        let found = format!("{bad:?}, which is tapered itself");
        fault("sections", found, "sections that do not vary along the beam");
        return None;
    }
    let made = |s: &&String| {
        let section = uniform.get(s.as_str()).and_then(Option::as_ref);
        section.is_some_and(|s| matches!(s.profile, percuss::Profile::Fibres(_)))
    };
    if let Some(bad) = sections.iter().find(made) {
        let found = format!("{bad:?}, which is made of fibres");
        fault("sections", found, "sections whose fibres are not listed");
        return None;
    }
    let mut out = Vec::new();
    let mut most = None;
    for (&at, section) in stations.iter().zip(sections) {
        let section = uniform.get(section.as_str())?.as_ref()?.clone();
        let Section { area, inertia, depth, profile, rotary_inertia, shear_factor, walls, .. } =
            section;
        if area <= 0.0 || inertia <= 0.0 {
            return None; // the named section's own fault
        }
        most = most.max(Some(section.fibres));
        let properties = StationProperties { rotary_inertia, shear_factor, walls };
        out.push(Station { at, area, inertia, depth, profile, properties });
    }
    let Station { area, inertia, depth, profile, .. } = out.first()?.clone();
    let section = Section { depth, stations: out, profile, ..Section::new(name, area, inertia) };
    let own = with_properties(&named.table, section);
    // Equal numbers of fibres at all stations: as many as any has, unless the section itself has a number.
    let fibres = if own.fibres == Section::FIBRES { most? } else { own.fibres };
    Some(Section { fibres, ..own })
}
