//! Beams with their materials and sections, and where they lie.

use std::collections::BTreeMap;

use percuss::{
    Along, BeamId, ElementSize, Fault, LinePoint, MaterialId, ModelBuilder, Section, SectionId,
};

use super::known;
use super::section::sections;
use super::yielding::inelasticity;
use crate::content::{self, Content, Grading};
use crate::point::Point;
use crate::table::Named;

/// The beams of a file, by name.
pub(super) struct Beams<'c> {
    beams: BTreeMap<&'c str, Placed<'c>>,
    sections: BTreeMap<&'c str, Section>,
    /// Any of them.
    first: BeamId,
}

struct Placed<'c> {
    id: BeamId,
    beam: percuss::Beam,
    table: &'c content::Beam,
}

/// A place on a beam and how far its surface is from there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    pub at: LinePoint,
    /// Half the depth of the section \[m\]; zero where it has none.
    pub half_depth: f64,
}

impl<'c> Beams<'c> {
    /// Adds materials, sections and beams.
    pub fn add(content: &'c Content, builder: &mut ModelBuilder, faults: &mut Vec<Fault>) -> Self {
        let materials = materials(content, builder, faults);
        let (mut ids, mut by_name) = (BTreeMap::new(), BTreeMap::new());
        for (section, named) in
            sections(content, &materials, faults).into_iter().zip(&content.section)
        {
            ids.insert(named.name.as_str(), builder.section(section.clone()));
            by_name.insert(named.name.as_str(), section);
        }
        for (name, profile) in known::profiles(content) {
            let section = profile.section(name);
            ids.insert(name, builder.section(section.clone()));
            by_name.insert(name, section);
        }
        let mut beams = BTreeMap::new();
        for named in &content.beam {
            let beam = beam(named, &materials, &ids, builder);
            let id = builder.beam(beam.clone());
            beams.insert(named.name.as_str(), Placed { id, beam, table: &named.table });
        }
        let first = beams.values().next().map(|placed: &Placed<'_>| placed.id).unwrap_or_default();
        Self { beams, sections: by_name, first }
    }

    /// A beam by its name, if that could be read.
    pub fn known(&self, name: &str) -> Option<BeamId> {
        self.beams.get(name).map(|placed| placed.id)
    }

    /// A beam by its name. The reader has checked the names; after a fault of reading any beam will do.
    pub fn id(&self, name: &str) -> BeamId {
        self.known(name).unwrap_or(self.first)
    }

    /// The point meant by a reference.
    pub fn point(&self, point: &Point) -> percuss::PointRef {
        let (label, along) = (point.label.clone(), point.along);
        percuss::PointRef { label, beam: self.id(&point.beam), along }
    }

    /// Where a point lies; `None` where its beam does not reach.
    pub fn surface(&self, point: &Point) -> Option<Surface> {
        let Placed { beam, table, .. } = self.beams.get(point.beam.as_str())?;
        let at = beam.line_point(point.along)?;
        let arc = |along: Along| match along {
            Along::Fraction(fraction) => fraction * at.length,
            Along::Distance(s) => s,
        };
        let changed = table.changes.iter().filter(|change| arc(change.at) <= at.s);
        let name = changed.filter_map(|change| change.section.as_ref()).next_back();
        let section = self.sections.get(name.unwrap_or(&table.section).as_str());
        let depth = section.and_then(|section| section.depth_at(at.s / at.length));
        Some(Surface { at, half_depth: 0.5 * depth.unwrap_or(0.0) })
    }
}

fn materials<'c>(
    content: &'c Content,
    builder: &mut ModelBuilder,
    faults: &mut Vec<Fault>,
) -> BTreeMap<&'c str, MaterialId> {
    let mut materials = BTreeMap::new();
    for Named { name, table } in &content.material {
        // Values that could not be read are reported already.
        let (young, density) = (table.young.unwrap_or(1.0), table.density.unwrap_or(1.0));
        let material = percuss::Material {
            poisson: table.poisson,
            shear_modulus: table.shear_modulus,
            strain: table.strain,
            retardation: table.retardation,
            mass_damping: table.mass_damping,
            expansion: table
                .expansion
                .or(table.preset.and_then(|preset| preset.expansion))
                .unwrap_or(0.0),
            inelasticity: inelasticity(name, table, faults),
            strength: table.preset.and_then(|preset| preset.strength),
            uniform_strain: table.preset.and_then(|preset| preset.uniform_strain),
            ..percuss::Material::new(name.as_str(), young, density)
        };
        materials.insert(name.as_str(), builder.material(material));
    }
    for (name, preset) in known::materials(content) {
        let material = percuss::Material {
            strength: preset.strength,
            uniform_strain: preset.uniform_strain,
            expansion: preset.expansion.unwrap_or(0.0),
            ..percuss::Material::new(name, preset.young, preset.density)
        };
        materials.insert(name, builder.material(material));
    }
    materials
}

fn beam(
    Named { name, table }: &Named<content::Beam>,
    materials: &BTreeMap<&str, MaterialId>,
    sections: &BTreeMap<&str, SectionId>,
    builder: &mut ModelBuilder,
) -> percuss::Beam {
    let material = materials.get(table.material.as_str()).copied();
    let section = sections.get(table.section.as_str()).copied();
    let (material, section) = stand_ins(name, material, section, builder);
    let change = |change: &content::Change| percuss::Change {
        at: change.at,
        material: change.material.as_ref().and_then(|m| materials.get(m.as_str()).copied()),
        section: change.section.as_ref().and_then(|s| sections.get(s.as_str()).copied()),
    };
    let grading = table.grading.as_ref();
    percuss::Beam {
        name: name.clone(),
        points: table.points.clone(),
        curve: table.curve,
        mesh: percuss::Mesh {
            size: match (table.elements, table.element_length) {
                (None, Some(length)) => ElementSize::Length(length),
                (elements, _) => ElementSize::Number(elements.unwrap_or(1)),
            },
            grading: grading
                .filter(|g| g.ratio != Grading::EVEN.ratio)
                .map(|g| percuss::Grading { towards: g.towards, ratio: g.ratio }),
            hinges: grading.is_none(),
        },
        material,
        section,
        changes: table.changes.iter().map(change).collect(),
        ends: table.ends,
        theory: table.theory,
    }
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
