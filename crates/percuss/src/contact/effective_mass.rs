//! Effective mass of a struck point, on the mesh and in the limit of an ever finer one.

use crate::element::beam::ElementSums;
use crate::element::point::PointResponse;
use crate::linalg::chain::Chain;
use crate::math::vec2::{cross, dot};
use crate::model::Model;
use crate::model::frozen::{BeamData, Constraint, MaterialPoint, ProjectileData};
use crate::step::assemble;
use crate::step::tangent::{Singular, Tangent};

/// Effective mass of a struck point, along the line of flight of its projectile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectiveMass {
    /// On the mesh at hand, `1 / (n M^-1 n^T)` \[kg\]; infinite if the point is held.
    pub on_mesh: f64,
    /// In the limit of an ever finer mesh, `2 sqrt(rhoA rhoI)` across a beam's interior \[kg\].
    pub limit: f64,
}

impl EffectiveMass {
    /// Whether mesh and limit differ by more than half of the limit: an impulse then is a property of the mesh.
    pub fn depends_on_mesh(&self) -> bool {
        self.on_mesh.is_finite() && (self.on_mesh - self.limit).abs() > 0.5 * self.limit
    }
}

impl Model {
    /// Effective mass of each struck point, one entry a projectile in the order of their definition.
    pub fn effective_masses(&self) -> Vec<EffectiveMass> {
        if self.projectiles.is_empty() {
            return Vec::new();
        }
        let Ok(mut mass) = mass_matrix(self) else {
            let unknown = EffectiveMass { on_mesh: f64::NAN, limit: f64::NAN };
            return vec![unknown; self.projectiles.len()];
        };
        let both = |p: &ProjectileData| {
            let on_mesh = on_mesh(self, &mut mass, &p.point, p.direction);
            EffectiveMass { on_mesh, limit: limit(self, &p.point, p.direction, on_mesh) }
        };
        self.projectiles.iter().map(both).collect()
    }
}

/// The mass matrix of the reference configuration, rotary inertia included, without supports.
pub fn mass_band(model: &Model) -> Chain {
    let mut chain = Chain::zeros(model.node_count());
    for beam in &model.beams {
        let t = beam.table.tangent;
        // dtheta = (t x dg): rhoI dtheta . dtheta
        let normal = [-t[1], t[0]];
        let mut point =
            PointResponse { force_g: [0.0; 2], force_p: [0.0; 2], tangent: [[0.0; 4]; 4] };
        for i in 0..2 {
            for j in 0..2 {
                point.tangent[i][j] = beam.law.rotary * normal[i] * normal[j];
            }
        }
        let mut sums = ElementSums::zero();
        for row in &beam.table.rows {
            sums.add::<true>(row, &point);
        }
        for a in beam.nodes.start..beam.nodes.end - 1 {
            assemble::spread(&sums.tangent, &beam.table.mass, 1.0, a, &mut chain);
        }
    }
    chain
}

/// The mass matrix of the reference configuration with supports and joints, factored.
///
/// # Errors
/// Where it is singular.
pub fn mass_matrix(model: &Model) -> Result<Tangent, Singular> {
    let mut tangent = Tangent::new(model);
    tangent.chain = mass_band(model);
    let rest = vec![[0.0; 4]; model.node_count()];
    tangent.factor(model, &rest, &rest)?;
    Ok(tangent)
}

/// Effective mass `1 / (n M^-1 n^T)` of a point in a direction \[kg\]; infinite if the point is held.
fn on_mesh(model: &Model, mass: &mut Tangent, point: &MaterialPoint, direction: [f64; 2]) -> f64 {
    let rest = vec![[0.0; 4]; model.node_count()];
    let mut x = rest.clone();
    point.spread(direction, &mut x);
    let mut multiplier = vec![0.0; model.constraints.len()];
    mass.solve(model, &rest, &rest, &mut x, &mut multiplier, None);
    let mobility = dot(direction, point.value(&x));
    let free = 1.0 / model.total_mass;
    if mobility <= 1e-12 * free { f64::INFINITY } else { 1.0 / mobility }
}

/// Limit of the effective mass for an ever finer mesh \[kg\]: `2 sqrt(rhoA rhoI)` across a beam's interior, half of it
/// across a free end, zero along the beam, infinite where held.
///
/// The velocity that an impulse leaves in a Rayleigh beam decays as `exp(-s / l)` with `l = sqrt(rhoI / rhoA)`.
fn limit(model: &Model, point: &MaterialPoint, direction: [f64; 2], on_mesh: f64) -> f64 {
    if on_mesh.is_infinite() {
        return f64::INFINITY;
    }
    if dot(direction, point.tangent).abs() > 1e-9 {
        return 0.0;
    }
    let beam = &model.beams[point.beam];
    let interior = 2.0 * (beam.mass_per_length * beam.law.rotary).sqrt();
    if is_free_end(model, beam, point) {
        0.5 * interior * cross(point.tangent, direction).abs()
    } else {
        interior
    }
}

fn is_free_end(model: &Model, beam: &BeamData, point: &MaterialPoint) -> bool {
    let at_end = point.s <= 1e-9 * beam.length || point.s >= beam.length * (1.0 - 1e-9);
    let joined = model.constraints.iter().any(|c| match c {
        Constraint::Held { .. } => false,
        Constraint::Shared { points, .. } | Constraint::Angle { points, .. } => points
            .iter()
            .any(|p| p.beam == point.beam && (p.s - point.s).abs() < 1e-9 * beam.length),
    });
    at_end && !joined
}
