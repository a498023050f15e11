//! Scratch of a step; may be dropped and rebuilt without changing a result.

use super::tangent::Tangent;
use crate::contact::impact::ImpactProblem;
use crate::model::Model;

/// Scratch of a step: the increment sought and what is needed to find it.
#[derive(Clone, Debug)]
pub struct Workspace {
    /// Increment of the nodal displacements over the step, shape (n_node).
    pub increment: Vec<[f64; 4]>,
    /// Multipliers of the constraints in the step, shape (n_constraint) \[N, N m\].
    pub multiplier: Vec<f64>,
    /// Increments of the projectiles' travel, shape (n_projectile) \[m\].
    pub travel: Vec<f64>,
    /// Smooth contact forces in the step, shape (n_projectile) \[N\].
    pub force: Vec<f64>,
    /// Impulses in the step, shape (n_projectile) \[N s\].
    pub impulse: Vec<f64>,
    /// Residual `M a + f_int - f_ext` of the nodes with everything in it, supports' reactions left over, shape (n_node).
    pub residual: Vec<[f64; 4]>,
    /// Right-hand side and correction, shape (n_node).
    pub correction: Vec<[f64; 4]>,
    /// The factored tangent.
    pub tangent: Tangent,

    /// Residuals of the projectiles' equations, shape (n_projectile) \[N\].
    pub projectile_residual: Vec<f64>,
    /// Derivatives of the smooth contact forces with respect to the penetration, as in the factored tangent,
    /// shape (n_projectile) \[N/m\].
    pub spring_slope: Vec<f64>,
    /// Answer of the model to unit forces at active contacts: nodal vectors and multipliers, one a contact.
    pub contact_columns: Vec<(Vec<[f64; 4]>, Vec<f64>)>,
    /// The impact problem of the active contacts.
    pub impact: ImpactProblem,
    /// Impulses of the active contacts, in their order \[N s\].
    pub active_impulse: Vec<f64>,
}

impl Workspace {
    /// Scratch for `model`.
    pub fn new(model: &Model) -> Self {
        let (n, p) = (model.node_count(), model.projectiles.len());
        Self {
            increment: vec![[0.0; 4]; n],
            multiplier: vec![0.0; model.constraints.len()],
            travel: vec![0.0; p],
            force: vec![0.0; p],
            impulse: vec![0.0; p],
            residual: vec![[0.0; 4]; n],
            correction: vec![[0.0; 4]; n],
            tangent: Tangent::new(model),
            projectile_residual: vec![0.0; p],
            spring_slope: vec![0.0; p],
            contact_columns: Vec::new(),
            impact: ImpactProblem::default(),
            active_impulse: Vec::new(),
        }
    }
}
