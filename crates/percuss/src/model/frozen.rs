//! The frozen model: what is simulated. Never changes once built.

use std::ops::Range;

use super::definition::{ContactForce, StrainMeasure};
use crate::element::beam::ElementTable;
use crate::element::point::SectionLaw;

/// What is simulated; made by [`ModelBuilder`](super::ModelBuilder).
///
/// Nodes and elements of all beams stand in one row, beam after beam.
#[derive(Clone, Debug)]
pub struct Model {
    /// Reference positions of the nodes, shape (n_node) \[m\].
    pub(crate) nodes: Vec<[f64; 2]>,
    /// Beams, in the order they were defined.
    pub(crate) beams: Vec<BeamData>,
    /// Components held at nodes.
    pub(crate) holds: Vec<NodeHold>,
    /// Constraints that a node's own components cannot express: joints, supports between nodes.
    pub(crate) constraints: Vec<Constraint>,
    /// Projectiles, in the order they were defined.
    pub(crate) projectiles: Vec<ProjectileData>,
    /// Acceleration of gravity, with its interval of action.
    pub(crate) gravity: Vec<GravityData>,
    /// Point loads.
    pub(crate) point_loads: Vec<PointLoadData>,
    /// Recorded points, each once.
    pub(crate) points: Vec<MaterialPoint>,
    /// Mass of beams and projectiles, a scale \[kg\].
    pub(crate) total_mass: f64,
}

/// A straight beam, evenly meshed.
#[derive(Clone, Debug)]
pub(crate) struct BeamData {
    pub name: String,
    pub nodes: Range<usize>,
    pub elements: Range<usize>,
    pub table: ElementTable,
    pub law: SectionLaw<f64>,
    pub mass_per_length: f64,
    pub length: f64,
}

/// Components of a node's displacement held to zero.
#[derive(Clone, Debug)]
pub(crate) struct NodeHold {
    pub node: usize,
    /// Held directions in (u1, u2, u1', u2'), orthonormal; at most four.
    pub normals: Vec<[f64; 4]>,
}

/// A material point: where it lies in the mesh and how it follows the nodes.
#[derive(Clone, Debug)]
pub(crate) struct MaterialPoint {
    pub label: String,
    pub beam: usize,
    /// Node `a` of the element; node `b` is the next one.
    pub node: usize,
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Shape functions (u_a, u_a', u_b, u_b').
    pub shape: [f64; 4],
    /// Derivatives of the shape functions.
    pub slope: [f64; 4],
    /// Reference position \[m\].
    pub position: [f64; 2],
    /// Reference tangent.
    pub tangent: [f64; 2],
}

impl MaterialPoint {
    /// Interpolates nodal values with the shape functions.
    #[inline]
    pub fn value(&self, nodal: &[[f64; 4]]) -> [f64; 2] {
        self.combine(nodal, &self.shape)
    }

    /// Interpolates nodal values with the derivatives of the shape functions.
    #[inline]
    pub fn gradient(&self, nodal: &[[f64; 4]]) -> [f64; 2] {
        self.combine(nodal, &self.slope)
    }

    #[inline]
    fn combine(&self, nodal: &[[f64; 4]], n: &[f64; 4]) -> [f64; 2] {
        let (a, b) = (&nodal[self.node], &nodal[self.node + 1]);
        [
            n[0] * a[0] + n[1] * a[2] + n[2] * b[0] + n[3] * b[2],
            n[0] * a[1] + n[1] * a[3] + n[2] * b[1] + n[3] * b[3],
        ]
    }

    /// Adds `shape^T f` to nodal forces.
    #[inline]
    pub fn spread(&self, force: [f64; 2], nodal: &mut [[f64; 4]]) {
        spread(&self.shape, self.node, force, nodal);
    }

    /// Adds `slope^T f` to nodal forces.
    #[inline]
    pub fn spread_gradient(&self, force: [f64; 2], nodal: &mut [[f64; 4]]) {
        spread(&self.slope, self.node, force, nodal);
    }
}

#[inline]
fn spread(n: &[f64; 4], node: usize, force: [f64; 2], nodal: &mut [[f64; 4]]) {
    for i in 0..2 {
        nodal[node][i] += n[0] * force[i];
        nodal[node][2 + i] += n[1] * force[i];
        nodal[node + 1][i] += n[2] * force[i];
        nodal[node + 1][2 + i] += n[3] * force[i];
    }
}

/// A scalar constraint on material points, kept by a multiplier.
#[derive(Clone, Debug)]
pub(crate) enum Constraint {
    /// `direction . u(point) = 0`, or of its gradient: a support between nodes.
    Held { point: MaterialPoint, direction: [f64; 2], gradient: bool },
    /// `direction . (u(a) - u(b)) = 0`: positions shared.
    Shared { points: Box<[MaterialPoint; 2]>, direction: [f64; 2] },
    /// `g_a x R g_b = 0` with R the rotation from the reference tangent of b to that of a: the angle is kept.
    Angle { points: Box<[MaterialPoint; 2]>, cosine: f64, sine: f64 },
}

/// A projectile on its line of flight.
#[derive(Clone, Debug)]
pub(crate) struct ProjectileData {
    pub name: String,
    pub mass: f64,
    /// Unit vector of the line of flight, from projectile to beam.
    pub direction: [f64; 2],
    /// Initial speed along `direction` \[m/s\].
    pub speed: f64,
    /// Initial position \[m\].
    pub position: [f64; 2],
    /// Initial gap \[m\].
    pub standoff: f64,
    /// The point struck.
    pub point: MaterialPoint,
    pub law: ContactLaw,
}

/// What acts between a projectile and the point it strikes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ContactLaw {
    /// A linear spring without tension.
    Spring { stiffness: f64, force: ContactForce },
    /// Newton's impact law.
    Unilateral { restitution: f64 },
}

/// Gravity with its interval of action.
#[derive(Clone, Debug)]
pub(crate) struct GravityData {
    pub acceleration: [f64; 2],
    pub from: f64,
    pub until: f64,
}

/// A dead force and a moment at a material point, with their interval of action.
#[derive(Clone, Debug)]
pub(crate) struct PointLoadData {
    pub point: MaterialPoint,
    pub force: [f64; 2],
    pub moment: f64,
    pub from: f64,
    pub until: f64,
}

/// Share of the step `[start, start + h]` in which a load that acts in `[from, until]` acts.
pub(crate) fn share(from: f64, until: f64, start: f64, h: f64) -> f64 {
    // Ends of steps are sums of steps: a difference of some ulps is the same instant.
    let slack = 1e-9 * h;
    let lo = from.max(start);
    let hi = until.min(start + h);
    let share = (hi - lo) / h;
    if from <= start + slack && until >= start + h - slack { 1.0 } else { share.clamp(0.0, 1.0) }
}

impl Model {
    /// Number of nodes of all beams.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Number of elements of all beams.
    pub fn element_count(&self) -> usize {
        self.beams.iter().map(|b| b.elements.len()).sum()
    }

    /// Names of the beams, in their order.
    pub fn beam_names(&self) -> impl Iterator<Item = &str> {
        self.beams.iter().map(|b| b.name.as_str())
    }

    /// Reference positions of the nodes of the beam called `name` \[m\], start to end.
    pub fn beam_nodes(&self, name: &str) -> Option<&[[f64; 2]]> {
        let beam = self.beams.iter().find(|b| b.name == name)?;
        Some(&self.nodes[beam.nodes.clone()])
    }

    /// Reference tangent at a node.
    pub(crate) fn tangent_at_node(&self, node: usize) -> [f64; 2] {
        let beam = self.beams.partition_point(|b| b.nodes.end <= node);
        self.beams[beam].table.tangent
    }

    /// Names of the projectiles, in their order, and whether each is rigid.
    pub fn projectile_names(&self) -> impl Iterator<Item = (&str, bool)> {
        let rigid = |p: &ProjectileData| matches!(p.law, ContactLaw::Unilateral { .. });
        self.projectiles.iter().map(move |p| (p.name.as_str(), rigid(p)))
    }

    /// Whether any projectile is rigid, so that impacts with impulses can occur.
    pub fn has_rigid_projectile(&self) -> bool {
        self.projectile_names().any(|(_, rigid)| rigid)
    }

    /// Strain measure of the beam called `name`.
    pub fn strain_measure(&self, name: &str) -> Option<StrainMeasure> {
        self.beams.iter().find(|b| b.name == name).map(|b| b.law.measure)
    }
}
