//! Collection of a user's definitions.

use super::definition::*;

/// Collects the definitions of a user; [`ModelBuilder::build`] checks all of them at once.
#[derive(Clone, Debug, Default)]
pub struct ModelBuilder {
    /// Materials, shape (materials); these and all below in the order they were defined.
    pub(super) materials: Vec<Material>,
    /// Sections, shape (sections).
    pub(super) sections: Vec<Section>,
    /// Beams, shape (beams).
    pub(super) beams: Vec<Beam>,
    /// Supports, shape (supports).
    pub(super) supports: Vec<Support>,
    /// Joints, shape (joints).
    pub(super) joints: Vec<Joint>,
    /// Guided projectiles, shape (projectiles).
    pub(super) projectiles: Vec<Projectile>,
    /// Discs, shape (discs).
    pub(super) discs: Vec<Disc>,
    /// Obstacles, shape (obstacles).
    pub(super) obstacles: Vec<Obstacle>,
    /// Contacts, shape (contacts).
    pub(super) contacts: Vec<Contact>,
    /// Loads, shape (loads).
    pub(super) loads: Vec<Load>,
    /// Foundations, shape (foundations).
    pub(super) foundations: Vec<Foundation>,
    /// Springs, shape (springs).
    pub(super) springs: Vec<Spring>,
    /// Point masses, shape (point masses).
    pub(super) masses: Vec<PointMass>,
    pub(super) initial_motion: InitialMotion,
    /// Motions of beams and point masses of their own, by name, shape (such motions).
    pub(super) own_motions: Vec<(String, InitialMotion)>,
    /// Ratios of damping of the flexible modes, from the lowest on, shape (modes) \[-\].
    pub(super) modal_damping: Vec<f64>,
    /// Recorded points, shape (recorded points).
    pub(super) points: Vec<PointRef>,
    /// Points that free bodies are aimed at, shape (such points).
    pub(super) struck: Vec<PointRef>,
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

    /// Adds a disc that moves freely in the plane.
    pub fn disc(&mut self, disc: Disc) -> DiscId {
        self.discs.push(disc);
        DiscId(self.discs.len() as u32 - 1)
    }

    /// Adds an obstacle.
    pub fn obstacle(&mut self, obstacle: Obstacle) -> ObstacleId {
        self.obstacles.push(obstacle);
        ObstacleId(self.obstacles.len() as u32 - 1)
    }

    /// Adds a contact between two partners.
    pub fn contact(&mut self, contact: Contact) {
        self.contacts.push(contact);
    }

    /// Adds a load.
    pub fn load(&mut self, load: Load) {
        self.loads.push(load);
    }

    /// Adds a spring between two points.
    pub fn spring(&mut self, spring: Spring) {
        self.springs.push(spring);
    }

    /// Adds a foundation along a beam.
    pub fn foundation(&mut self, foundation: Foundation) {
        self.foundations.push(foundation);
    }

    /// Adds a mass at a point.
    pub fn point_mass(&mut self, mass: PointMass) {
        self.masses.push(mass);
    }

    /// Starts all beams and point masses with a rigid-body motion.
    pub fn initial_motion(&mut self, motion: InitialMotion) {
        self.initial_motion = motion;
    }

    /// Starts a beam, or a point mass, of this name with a motion of its own instead. A point mass takes coincident nodes of its beam along.
    pub fn initial_motion_of(&mut self, name: impl Into<String>, motion: InitialMotion) {
        self.own_motions.push((name.into(), motion));
    }

    /// Damps the flexible modes of the structure about its initial configuration, from the lowest on, each by a ratio of
    /// critical damping.
    pub fn modal_damping(&mut self, ratios: Vec<f64>) {
        self.modal_damping = ratios;
    }

    /// Records the displacement of a point.
    pub fn record_point(&mut self, point: PointRef) {
        self.points.push(point);
    }

    /// Notes a point that a free body is aimed at: a beam that can yield has short elements there, and nothing else changes.
    pub fn aim_at(&mut self, point: PointRef) {
        self.struck.push(point);
    }
}
