//! Effective mass of a struck point, on the mesh and in the limit of mesh refinement.

use serde::{Deserialize, Serialize};

use super::assemble;
use super::constraint::ConstraintStep;
use super::forcing::Forcing;
use super::tangent::{Singular, Tangent};
use crate::element::beam::{ElementSums, ElementValues};
use crate::element::point::PointResponse;
use crate::geometry::configuration::Configuration;
use crate::geometry::pair::{Carrier, Pair};
use crate::geometry::touch::Touch;
use crate::linalg::chain::Chain;
use crate::math::vec2::{add, cross, dot, norm, scale};
use crate::model::Model;
use crate::model::frozen::{BodyKind, Constraint, ConstraintKind, MaterialPoint, ProjectileData};

/// A point that moves by less than this share of the whole under an impulse is fixed.
const HELD: f64 = 1e-12;

/// Effective mass of a struck point, along the line of motion of its projectile.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EffectiveMass {
    /// On the current mesh, `1 / (n M^-1 n^T)` \[kg\]; infinite for a fixed point.
    pub on_mesh: f64,
    /// In the limit of mesh refinement, `2 sqrt(rhoA rhoI)` across a beam's interior, none of a shear-flexible one \[kg\].
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
        let rest = vec![[0.0; 4]; self.node_count()];
        let Ok(mut mass) = mass_matrix(self, &rest) else {
            let unknown = EffectiveMass { on_mesh: f64::NAN, limit: f64::NAN };
            return vec![unknown; self.projectiles.len()];
        };
        let both = |p: &ProjectileData| {
            let on_mesh = on_mesh(self, &mut mass, &p.point, p.direction);
            let MaterialPoint { beam, node, s, tangent, .. } = p.point;
            let place = StruckPlace { beam, node, s, tangent };
            let limit = if on_mesh.is_infinite() {
                f64::INFINITY
            } else {
                place.limit(self, p.direction, ALONG)
            };
            EffectiveMass { on_mesh, limit }
        };
        self.projectiles.iter().map(both).collect()
    }

    /// Mass that a place of a beam carries in itself \[kg\].
    fn mass_at(&self, beam: usize, s: f64) -> f64 {
        let there =
            |p: &MaterialPoint| p.beam == beam && (p.s - s).abs() <= 1e-9 * self.beams[beam].length;
        self.masses.iter().filter(|m| there(&m.point)).fold(0.0, |sum, m| sum + m.mass)
    }
}

/// The mass matrix of a configuration, rotary inertia and point masses included, without supports.
pub fn mass_band(model: &Model, u: &[[f64; 4]]) -> Chain {
    let mut chain = Chain::zeros(model.node_count());
    for (span, k, a, _) in model.each_element() {
        let table = span.table(k);
        let values = ElementValues::new(&u[a], &u[a + 1]);
        let mut sums = ElementSums::zero(0.0);
        for row in &table.rows {
            let mut point =
                PointResponse { force_g: [0.0; 2], force_p: [0.0; 2], tangent: [[0.0; 4]; 4] };
            let block =
                turning(row.weighed.rotary, add(row.reference.tangent, values.at(&row.first)));
            for i in 0..2 {
                for j in 0..2 {
                    point.tangent[i][j] = block[i][j];
                }
            }
            sums.add::<true>(row, &point);
        }
        assemble::spread(&sums, &table.mass, 1.0, a, &mut chain);
    }
    for mass in &model.masses {
        let p = &mass.point;
        let m = mass.mass;
        chain.add_outer(p.node, &p.shape, &p.shape, &[[m, 0.0], [0.0, m]]);
        let g = add(p.tangent, p.gradient(u));
        chain.add_outer(p.node, &p.slope, &p.slope, &turning(mass.rotary_inertia, g));
    }
    for (i, body) in model.bodies.iter().enumerate() {
        let diag = &mut chain.diag[model.body_node(i)];
        let mass = if body.kind == BodyKind::Obstacle { 1.0 } else { body.mass };
        (0..4).for_each(|k| diag[k][k] = if k == 2 { body.inertia.max(mass) } else { mass });
    }
    chain
}

/// `rhoI dtheta . dtheta` with `dtheta = (g x dg) / a`.
fn turning(rotary: f64, g: [f64; 2]) -> [[f64; 2]; 2] {
    let a = dot(g, g);
    let normal = [-g[1] / a, g[0] / a];
    [0, 1].map(|i| [0, 1].map(|j| rotary * normal[i] * normal[j]))
}

/// The mass matrix of a configuration with supports and joints, factored.
///
/// # Errors
/// Where it is singular.
pub fn mass_matrix(model: &Model, u: &[[f64; 4]]) -> Result<Tangent, Singular> {
    let mut tangent = Tangent::new(model);
    *tangent.chain_mut() = mass_band(model, u);
    let forcing = Forcing::new(model);
    tangent.factor(model, &ConstraintStep::at_rest(u, &forcing), None)?;
    Ok(tangent)
}

/// Effective mass `1 / (n M^-1 n^T)` of a point in a direction \[kg\]; infinite if the point is fixed.
fn on_mesh(model: &Model, mass: &mut Tangent, point: &MaterialPoint, direction: [f64; 2]) -> f64 {
    let mut x = vec![[0.0; 4]; model.node_count()];
    point.spread(direction, &mut x);
    mass.solve_linear(model, &mut x);
    let mobility = dot(direction, point.value(&x));
    let free = 1.0 / model.total_mass;
    if mobility <= HELD * free { f64::INFINITY } else { 1.0 / mobility }
}

/// Directions closer to the axis than this have an axial part, for which a fine mesh has no mass.
const ALONG: f64 = 1e-9;
/// The same of a normal in a configuration that the run has bent.
const LEANS: f64 = 1e-3;

/// A place of a beam.
#[derive(Clone, Copy, Debug)]
struct StruckPlace {
    beam: usize,
    /// First node of its element.
    node: usize,
    /// Arc length \[m\].
    s: f64,
    /// Unit tangent, shape (2) \[-\].
    tangent: [f64; 2],
}

impl StruckPlace {
    /// Limit of the effective mass under mesh refinement \[kg\]: `2 sqrt(rhoA rhoI)` across a beam's interior, half of it across a free end, plus
    /// the mass added at the point; zero along the beam.
    ///
    /// The velocity that an impulse leaves in a Rayleigh beam decays as `exp(-s / l)` with `l = sqrt(rhoI / rhoA)`.
    fn limit(&self, model: &Model, direction: [f64; 2], leans: f64) -> f64 {
        let own = model.mass_at(self.beam, self.s);
        if dot(direction, self.tangent).abs() > leans {
            return own;
        }
        let span = model.element_of(self.node).0;
        if span.shear.is_some() {
            return own; // its sections do not turn with its axis
        }
        let section = span.section.at(self.s);
        let interior = 2.0 * (section.mass * section.law.rotary).sqrt();
        own + if self.is_free_end(model) {
            0.5 * interior * cross(self.tangent, direction).abs()
        } else {
            interior
        }
    }

    fn is_free_end(&self, model: &Model) -> bool {
        let length = model.beams[self.beam].length;
        let at_end = self.s <= 1e-9 * length || self.s >= length * (1.0 - 1e-9);
        let joins = |c: &&Constraint| {
            c.support.is_none() && !matches!(c.kind, ConstraintKind::Length { .. })
        };
        let joined = model.constraints.iter().filter(joins).any(|c| {
            let mut points = c.points().iter();
            points.any(|p| p.beam == self.beam && (p.s - self.s).abs() < 1e-9 * length)
        });
        at_end && !joined
    }
}

impl EffectiveMass {
    /// Effective mass of the beams of a pair against an impulse along its normal: `1 / sum(n M^-1 n^T)` over those of the two that
    /// are beams. None where neither is one.
    ///
    /// `mass` is the mass matrix of a configuration, factored; `u` are the displacements in which the two touch.
    pub(crate) fn of_pair(
        model: &Model,
        mass: &mut Tangent,
        u: &[[f64; 4]],
        pair: &Pair,
        touch: &Touch,
    ) -> Option<Self> {
        let at = Configuration::of(u);
        let row = pair.normal_row(touch, &at);
        let mut x = vec![[0.0; 4]; model.node_count()];
        row.spread(1.0, &mut x);
        mass.solve_linear(model, &mut x);
        let beams = model.beam_node_count();
        let mobility = row.on_some(&x, |n| n < beams);
        let sides =
            [(pair.movers[0], &pair.source, pair.s), (pair.movers[1], &touch.closest, touch.s)];
        let (mut softness, mut any) = (0.0, false);
        for (mover, centre, s) in sides {
            let Carrier::Beam { slope, tangent, .. } = &centre.carrier else { continue };
            if mover >= model.beams.len() || s.is_nan() {
                continue;
            }
            any = true;
            let nodes = model.beams[mover].nodes.clone();
            if row.on_some(&x, |n| nodes.contains(&n)) <= HELD / model.total_mass {
                continue;
            }
            let bent = add(
                *tangent,
                hermite_slope(slope, &at.node(centre.node), &at.node(centre.node + 1)),
            );
            let tangent = scale(1.0 / norm(bent), bent);
            let place = StruckPlace { beam: mover, node: centre.node, s, tangent };
            softness += 1.0 / place.limit(model, touch.normal, LEANS);
        }
        let held = mobility <= HELD / model.total_mass;
        let one_over = |x: f64| if held { f64::INFINITY } else { 1.0 / x };
        any.then(|| Self { on_mesh: one_over(mobility), limit: one_over(softness) })
    }
}

/// Derivative of an element's displacement at a point.
fn hermite_slope(n: &[f64; 4], a: &[f64; 4], b: &[f64; 4]) -> [f64; 2] {
    [0, 1].map(|i| n[0] * a[i] + n[1] * a[2 + i] + n[2] * b[i] + n[3] * b[2 + i])
}
