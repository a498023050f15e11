//! Size of a model, estimated from its definitions before meshing.

use super::builder::ModelBuilder;
use super::centre_line::CentreLine;
use super::definition::{
    Along, Beam, BeamId, ContactPartner, Curve, ElementSize, Inelasticity, Section,
};

/// Memory of an element that shares its constants with the others of a straight span, including computed data \[bytes\]. This and the other two
/// were measured with meshes of a million elements, and of fifty thousand in contact.
const EVEN: f64 = 1900.0;
/// Memory of an element with its own constants: on a curve, or with a varying section \[bytes\].
const OWN: f64 = 3600.0;
/// Memory of a pair of a contact \[bytes\].
const PAIR: f64 = 500.0;
/// Memory of a fibre at the three Gauss points of an element \[bytes\].
const FIBRE: f64 = 400.0;

/// Estimated size of a model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ModelExtent {
    /// Elements of all beams \[-\].
    pub elements: f64,
    /// Pairs of all contacts \[-\].
    pub pairs: f64,
    /// Memory of the model and of the start of a run \[bytes\].
    pub memory: f64,
}

impl ModelBuilder {
    /// Size of the model. Invalid definitions count with their smallest size: they are reported when it is built.
    pub fn extent(&self) -> ModelExtent {
        let elements: Vec<f64> = self.beams.iter().map(elements).collect();
        let mut extent = ModelExtent { elements: elements.iter().sum(), ..Default::default() };
        let each = self.beams.iter().zip(&elements);
        extent.memory = each.map(|(beam, count)| count * self.memory_of_element(beam)).sum();
        for contact in &self.contacts {
            let points = contact.points_per_element as f64;
            // Both faces of each beam in the contact; one pair without beams.
            let beams = contact.between.iter().filter_map(|partner| match partner {
                ContactPartner::Beam(BeamId(k)) => elements.get(*k as usize),
                ContactPartner::Disc(_) | ContactPartner::Obstacle(_) => None,
            });
            extent.pairs += beams.map(|count| 2.0 * points * count).sum::<f64>().max(1.0);
        }
        extent.memory += PAIR * extent.pairs;
        extent
    }

    fn memory_of_element(&self, beam: &Beam) -> f64 {
        let section = self.sections.get(beam.section.0 as usize);
        let varies = section.is_some_and(|section| !section.stations.is_empty());
        let material = self.materials.get(beam.material.0 as usize);
        let inelastic: Option<&Inelasticity> = material.and_then(|m| m.inelasticity.as_ref());
        let graded = beam.mesh.grading.is_some() || beam.mesh.hinges && inelastic.is_some();
        let even = matches!(beam.curve, Curve::Polyline) && !graded && !varies;
        let own = if even { EVEN } else { OWN };
        let fibres = |section: &Section| section.given_fibres().map_or(section.fibres, <[_]>::len);
        let has_fibres = inelastic.is_some() || section.is_some_and(|s| s.given_fibres().is_some());
        let fibres = section.filter(|_| has_fibres).map_or(0, fibres);
        own + FIBRE * fibres as f64
    }
}

/// Elements of a beam, according to its definition.
fn elements(beam: &Beam) -> f64 {
    match beam.mesh.size {
        ElementSize::Number(count) => count as f64,
        ElementSize::Length(size) => {
            let Some(line) = CentreLine::new(beam) else { return 0.0 };
            let length = line.length();
            let Some(grading) = beam.mesh.grading else { return count(length / size) };
            // Sizes grow evenly away from the smallest: the integral of their inverse on either side.
            let towards: Along = grading.towards;
            let centre = line.arc(towards);
            let slope = (grading.ratio - 1.0) / centre.max(length - centre);
            let side = |reach: f64| (slope * reach).ln_1p() / slope;
            count((side(centre) + side(length - centre)) / size)
        }
    }
}

fn count(elements: f64) -> f64 {
    if elements.is_finite() { elements.max(1.0) } else { 0.0 }
}
