//! Collects definitions and turns them into a frozen [`Model`]; the one place that validates.

use super::definition::*;
use super::frozen::*;
use super::{Fault, check, constrain};
use crate::element::beam::ElementTable;
use crate::element::point::SectionLaw;
use crate::math::hermite;
use crate::math::vec2::{norm, scale, sub};

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
    pub(super) springs: Vec<Spring>,
    pub(super) masses: Vec<PointMass>,
    pub(super) initial_motion: InitialMotion,
    pub(super) modal_damping: Vec<f64>,
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

    /// Adds a spring between two points.
    pub fn spring(&mut self, spring: Spring) {
        self.springs.push(spring);
    }

    /// Adds a mass at a point.
    pub fn point_mass(&mut self, mass: PointMass) {
        self.masses.push(mass);
    }

    /// Lets all beams and point masses start in a rigid motion.
    pub fn initial_motion(&mut self, motion: InitialMotion) {
        self.initial_motion = motion;
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

    /// Checks everything and freezes it.
    ///
    /// # Errors
    /// Every fault found, each with its place in the words of the scenario file.
    pub fn build(&self) -> Result<Model, Vec<Fault>> {
        let faults = check::faults(self);
        if !faults.is_empty() {
            return Err(faults);
        }
        let mut model = self.mesh();
        self.place_projectiles(&mut model);
        self.place_loads(&mut model);
        for point in self.projectiles.iter().map(|p| &p.strikes).chain(&self.points) {
            if !model.points.iter().any(|p| p.label == point.label) {
                model.points.push(locate(&model, point));
            }
        }
        constrain::supports(self, &mut model);
        constrain::joints(self, &mut model)?;
        Ok(model)
    }

    fn mesh(&self) -> Model {
        let mut model = Model {
            nodes: Vec::new(),
            beams: Vec::new(),
            holds: Vec::new(),
            constraints: Vec::new(),
            projectiles: Vec::new(),
            gravity: Vec::new(),
            point_loads: Vec::new(),
            points: Vec::new(),
            total_mass: self.projectiles.iter().map(|p| p.mass).sum(),
        };
        let mut elements = 0;
        for beam in &self.beams {
            let material = &self.materials[beam.material.0 as usize];
            let section = &self.sections[beam.section.0 as usize];
            let (start, end) = (beam.points[0], beam.points[1]);
            let length = norm(sub(end, start));
            let tangent = scale(1.0 / length, sub(end, start));
            let mass_per_length = material.density * section.area;
            let first = model.nodes.len();
            let ElementSize::Number(n) = beam.mesh.size else { unreachable!() };
            for i in 0..=n {
                let f = i as f64 / n as f64;
                model
                    .nodes
                    .push([start[0] + f * (end[0] - start[0]), start[1] + f * (end[1] - start[1])]);
            }
            model.beams.push(BeamData {
                name: beam.name.clone(),
                nodes: first..first + n + 1,
                elements: elements..elements + n,
                table: ElementTable::new(length / n as f64, tangent, mass_per_length),
                law: SectionLaw {
                    axial: material.young * section.area,
                    bending: material.young * section.inertia,
                    rotary: match section.rotary_inertia {
                        RotaryInertia::Density => material.density * section.inertia,
                        RotaryInertia::Neglected => 0.0,
                        RotaryInertia::Given(value) => value,
                    },
                    measure: material.strain,
                },
                mass_per_length,
                length,
            });
            elements += n;
            model.total_mass += mass_per_length * length;
        }
        model
    }

    fn place_projectiles(&self, model: &mut Model) {
        for projectile in &self.projectiles {
            let point = locate(model, &projectile.strikes);
            let line = check::line_of_flight(projectile).unwrap_or([f64::NAN; 2]);
            let direction = scale(1.0 / norm(line), line);
            model.projectiles.push(ProjectileData {
                name: projectile.name.clone(),
                mass: projectile.mass,
                direction,
                speed: norm(projectile.velocity),
                position: sub(point.position, scale(projectile.standoff, direction)),
                standoff: projectile.standoff,
                point,
                law: match projectile.kind {
                    ProjectileKind::Elastic { stiffness, force } => {
                        ContactLaw::Spring { stiffness, force }
                    }
                    ProjectileKind::Rigid { restitution } => ContactLaw::Unilateral { restitution },
                },
            });
        }
    }

    fn place_loads(&self, model: &mut Model) {
        for load in &self.loads {
            let (from, until) = (load.from, load.until);
            match &load.kind {
                LoadKind::Gravity { acceleration } => {
                    model.gravity.push(GravityData { acceleration: *acceleration, from, until });
                }
                LoadKind::Distributed { .. } => {}
                LoadKind::Point { at, force, moment, .. } => {
                    let point = locate(model, at);
                    let (force, moment) = (*force, *moment);
                    model.point_loads.push(PointLoadData { point, force, moment, from, until });
                }
            }
        }
    }
}

/// The material point meant by a (checked) reference; points within a billionth of an element of a node are that node.
pub(super) fn locate(model: &Model, reference: &PointRef) -> MaterialPoint {
    let beam_index = reference.beam.0 as usize;
    let beam = &model.beams[beam_index];
    let h = beam.table.length;
    let s = match reference.along {
        Along::Fraction(f) => f * beam.length,
        Along::Distance(s) => s,
    };
    let n = beam.elements.len();
    let mut x = s / h;
    if (x - x.round()).abs() < 1e-9 {
        x = x.round();
    }
    let element = (x.floor() as usize).min(n - 1);
    let xi = x - element as f64;
    let node = beam.nodes.start + element;
    let t = beam.table.tangent;
    let origin = model.nodes[node];
    MaterialPoint {
        label: reference.label.clone(),
        beam: beam_index,
        node,
        s,
        shape: hermite::shape(xi, h),
        slope: hermite::slope(xi, h),
        position: [origin[0] + xi * h * t[0], origin[1] + xi * h * t[1]],
        tangent: t,
    }
}
