//! A structure between its reference and an equilibrium: the data of the search, without its rules.

use crate::analysis::static_contacts::StaticContacts;
use crate::element::fibre::FibreState;
use crate::geometry::row::Row;
use crate::linalg::chain::Chain;
use crate::model::Model;
use crate::state::{Followed, State};
use crate::step::forcing::Forcing;
use crate::step::workspace::Workspace;

/// A structure between its reference and an equilibrium.
pub(in crate::analysis) struct StaticSearch<'m> {
    pub model: &'m Model,
    /// The configuration increments count from; its stored strains are those foreseen for the next correction.
    pub base: State,
    pub work: Workspace,
    pub forcing: Forcing,
    pub contacts: StaticContacts,
    pub iterations: usize,
    /// Forces of failed parts, shape (nodes, 4) \[N, N m\]; empty if none are held. The released share.
    pub(super) withheld: Vec<[f64; 4]>,
    pub let_go: f64,
    /// Whether springs have the forces of their lengths.
    pub stressed: bool,
    /// Treatment of prescribed motions.
    pub motions: Motions,
    /// A weak stiffness of elements that have parted, for the tangent alone; none while no beam has.
    pub(super) gaps: Option<Chain>,
    /// A force that grows in place of the loads, which then act with their values at time zero.
    pub push: Option<Push>,
}

/// A dead force that grows from zero while loads and prescribed motions keep their values at time zero.
#[derive(Clone, Debug)]
pub(in crate::analysis) struct Push {
    /// Where it acts, and its direction.
    pub row: Row,
    /// The force \[N\].
    pub force: f64,
}

/// An intermediate configuration of a search.
#[derive(Clone)]
pub(in crate::analysis) struct Reached {
    /// Increment of the nodal displacements from the base, shape (nodes, 4) \[m, -\].
    pub increment: Vec<[f64; 4]>,
    /// Multipliers of the constraints, shape (constraints) \[N, N m\].
    pub(super) multiplier: Vec<f64>,
    pub(super) contacts: StaticContacts,
    /// State variables of fibres, shape (fibres).
    pub(super) fibres: Vec<FibreState>,
    /// State variables of connectors that yield, shape (connectors that yield).
    pub memories: Vec<FibreState>,
    /// Failed joints of a given strength, shape (such joints).
    pub(super) joints_parted: Vec<bool>,
    /// Fractured elements, as in [`State`], shape (beam nodes); empty without fractured beams.
    pub(super) parted: Vec<bool>,
}

/// Largest magnitude of nodal values; NaN if any is.
pub(in crate::analysis) fn largest(nodal: &[[f64; 4]]) -> f64 {
    nodal.as_flattened().iter().fold(0.0, |m, x| if x.is_nan() { f64::NAN } else { m.max(x.abs()) })
}

/// Treatment of prescribed motions in a search.
pub enum Motions {
    /// They grow with the loads to their values at time zero.
    Growing,
    /// They are left out.
    LeftOut,
    /// They have their values at the end of a run, and supports whose time has ended are removed.
    Left {
        /// The time \[s\].
        time: f64,
        /// Values of the motions, shape (motions).
        followed: Vec<Followed>,
    },
}
