//! Collects definitions and turns them into a frozen [`Model`]; the one place that validates.

use super::definition::*;
use super::{Fault, Model};

/// Collects what a user defines; [`ModelBuilder::build`] checks all of it at once.
#[derive(Clone, Debug, Default)]
pub struct ModelBuilder {
    pub(super) materials: Vec<Material>,
    pub(super) sections: Vec<Section>,
    pub(super) beams: Vec<Beam>,
    pub(super) supports: Vec<Support>,
    pub(super) joints: Vec<Joint>,
    pub(super) projectiles: Vec<Projectile>,
    pub(super) loads: Vec<Load>,
    pub(super) points: Vec<PointRef>,
}

impl ModelBuilder {
    /// An empty model.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a material.
    pub fn material(&mut self, material: Material) -> MaterialId {
        self.materials.push(material);
        MaterialId(self.materials.len() as u32 - 1)
    }

    /// Adds a section.
    pub fn section(&mut self, section: Section) -> SectionId {
        self.sections.push(section);
        SectionId(self.sections.len() as u32 - 1)
    }

    /// Adds a beam.
    pub fn beam(&mut self, beam: Beam) -> BeamId {
        self.beams.push(beam);
        BeamId(self.beams.len() as u32 - 1)
    }

    /// Adds a support.
    pub fn support(&mut self, support: Support) {
        self.supports.push(support);
    }

    /// Adds a joint.
    pub fn joint(&mut self, joint: Joint) {
        self.joints.push(joint);
    }

    /// Adds a projectile; the point it strikes is recorded.
    pub fn projectile(&mut self, projectile: Projectile) {
        self.projectiles.push(projectile);
    }

    /// Adds a load.
    pub fn load(&mut self, load: Load) {
        self.loads.push(load);
    }

    /// Records the displacement of a point.
    pub fn record_point(&mut self, point: PointRef) {
        self.points.push(point);
    }

    /// Checks everything and freezes it.
    ///
    /// # Errors
    /// Every fault found, each with its place in the words of the scenario file.
    pub fn build(&self) -> Result<Model, Vec<Fault>> {
        unimplemented!()
    }
}
