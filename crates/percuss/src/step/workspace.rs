//! Scratch data of a step; may be dropped and rebuilt without changing a result by more than round-off, and without any change if the tangent keeps
//! its pattern.

use super::contacts::{RigidContact, SmoothContact};
use super::end_forces::EndForces;
use super::lead::Lead;
use super::modal_damping::MovingModes;
use super::tangent::Tangent;
use crate::contact::impact::ImpactProblem;
use crate::model::Model;

/// Scratch data of a step: the increment and the data for its solution.
#[derive(Clone, Debug)]
pub struct Workspace {
    /// Increment of the nodal displacements over the step, shape (nodes, 4) \[m, -, rad\].
    pub increment: Vec<[f64; 4]>,
    /// Lead of prescribed velocities over those of the scheme.
    pub lead: Lead,
    /// Multipliers of the constraints in the step, shape (constraints) \[N, N m\].
    pub multiplier: Vec<f64>,
    /// Smooth contacts in the step, shape (smooth contacts).
    pub smooth: Vec<SmoothContact>,
    /// Length that no element of a beam exceeds in the step, one a beam, shape (beams) \[m\]; empty if not known.
    pub arcs: Vec<f64>,
    /// Active rigid contacts in the step, in the order of the problem's, shape (active rigid contacts).
    pub rigid: Vec<RigidContact>,
    /// Rotation of their forms by the last correction, times their impulses \[N s\].
    pub turned: f64,
    /// Their pairs, shape (active rigid contacts) \[index of a pair\].
    pub rigid_pairs: Vec<usize>,
    /// Residual `M a + f_int - f_ext` of the nodes with everything in it, supports' reactions left over, shape (nodes, 4) \[N, N m\].
    pub residual: Vec<[f64; 4]>,
    /// Forces on the elements.
    pub beams: EndForces,
    /// Right-hand side, then correction, shape (nodes, 4) \[N, N m, then m, -, rad\].
    pub correction: Vec<[f64; 4]>,
    /// The previous correction, in iterations that take long, shape (nodes, 4) \[m, -, rad\].
    pub correction_before: Vec<[f64; 4]>,
    /// Modal damping in the middle of the step.
    pub modal: MovingModes,
    /// The factored tangent.
    pub tangent: Tangent,

    /// Answers of the model to unit forces at active contacts along normal and tangent: nodal vectors,
    /// shape (2 active contacts or more, nodes, 4) \[m/N, 1/N\], and multipliers, shape (at least 2 active contacts, constraints) \[-, m\].
    pub contact_columns: Vec<(Vec<[f64; 4]>, Vec<f64>)>,
    /// The impact problem of the active contacts.
    pub impact: ImpactProblem,
    /// Impulses of the active contacts, along normal and tangent, shape (2 active contacts) \[N s\].
    pub impulses: Vec<f64>,
    /// Violation of their conditions, relative to the largest rate.
    pub impact_residual: f64,
}

impl Workspace {
    /// Scratch for a run of `model`.
    pub fn new(model: &Model) -> Self {
        Self { beams: EndForces::new(model), ..Self::at_rest(model) }
    }

    /// Scratch for statics of `model`.
    pub fn at_rest(model: &Model) -> Self {
        let n = model.node_count();
        Self {
            increment: vec![[0.0; 4]; n],
            lead: Lead::new(model),
            multiplier: vec![0.0; model.constraints.len()],
            smooth: Vec::new(),
            arcs: Vec::new(),
            rigid: Vec::new(),
            turned: 0.0,
            rigid_pairs: Vec::new(),
            residual: vec![[0.0; 4]; n],
            beams: EndForces::default(),
            correction: vec![[0.0; 4]; n],
            correction_before: Vec::new(),
            modal: MovingModes::default(),
            tangent: Tangent::new(model),
            contact_columns: Vec::new(),
            impact: ImpactProblem::default(),
            impulses: Vec::new(),
            impact_residual: 0.0,
        }
    }
}
