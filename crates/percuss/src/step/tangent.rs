//! The tangent of a step: the band of the beams with the fixed components at nodes, the couplings beyond it, and the low-rank part of modal damping.

mod low_rank;

pub use self::low_rank::DampedVectors;
use self::low_rank::LowRank;
use super::condensed_bodies::CondensedBodies;
use super::constraint::{self, ConstraintStep};
use super::projection::{prescribe_block, project_coupling};
use crate::linalg::block::{Block, ZERO};
use crate::linalg::chain::Chain;
use crate::linalg::condensed::{BorderPattern, Condensed};
use crate::model::Model;
use crate::model::frozen::{BodyKind, Connector, Constraint, ConstraintKind, MaterialPoint};

pub use super::projection::project;

/// The tangent, assembled or factored in place.
#[derive(Clone, Debug)]
pub struct Tangent {
    matrix: Condensed,
    /// Whether the band links a node to the next one, shape (nodes).
    linked: Vec<bool>,
    /// Couplings of contacts, which vary: (row node, column node, block), shape (couplings, 4, 4) \[index of a node, index of a node, N/m, N, N m\].
    contacts: Vec<(usize, usize, Block)>,
    /// Nodes of bodies that springs end at, shape (such ends) \[index of a node\].
    tied: Vec<usize>,
    /// Bodies that touch one element only, eliminated first.
    condensed_bodies: CondensedBodies,
    /// Number of permanent couplings; those of contacts without a condensed body follow.
    permanent: usize,
    /// Number of the first coupling of each connector, shape (connectors) \[index of a coupling\].
    of_connector: Vec<usize>,
    /// Number of the first coupling of each constraint, shape (constraints) \[index of a coupling\].
    of_constraint: Vec<usize>,
    /// Right side of the constraints, then the change of their multipliers, shape (constraints) \[m, -, then N, N m\].
    right: Vec<f64>,
    low_rank: LowRank,
}

/// Reason why a tangent cannot be factored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Singular {
    /// At a node.
    Node(usize),
    /// Connections of beams.
    Constraints,
}

/// Nodes with a share in a point or its slope.
fn nodes_of(point: &MaterialPoint, gradient: bool) -> Vec<usize> {
    let n = if gradient { &point.slope } else { &point.shape };
    let known = |k: usize| n[k] != 0.0 || n[k + 1] != 0.0;
    [(0, point.node), (2, point.node + 1)]
        .into_iter()
        .filter(|(k, _)| known(*k))
        .map(|(_, node)| node)
        .collect()
}

/// Pairs of nodes connected by two points, in both orders.
fn pairs(a: (&MaterialPoint, bool), b: (&MaterialPoint, bool)) -> Vec<(usize, usize)> {
    let (a, b) = (nodes_of(a.0, a.1), nodes_of(b.0, b.1));
    a.iter().flat_map(|i| b.iter().flat_map(move |j| [(*i, *j), (*j, *i)])).collect()
}

impl Tangent {
    /// Memory for the tangent of `model`.
    pub fn new(model: &Model) -> Self {
        let mut couplings = Vec::new();
        let (mut of_connector, mut of_constraint) = (Vec::new(), Vec::new());
        for connector in &model.connectors {
            of_connector.push(couplings.len());
            let attachments: Vec<_> =
                connector.attachments().map(|(_, attachment)| attachment).collect();
            if let [a, b] = attachments[..] {
                couplings.extend(pairs(a, b));
            }
        }
        for c in &model.constraints {
            of_constraint.push(couplings.len());
            if let ConstraintKind::Angle { points, .. } = &c.kind {
                couplings.extend(pairs((&points[0], true), (&points[1], true)));
            }
        }
        let mut linked = vec![true; model.node_count()];
        for span in &model.spans {
            linked[span.nodes.end - 1] = false;
        }
        for body in 0..model.bodies.len() {
            let next = model.bodies.get(body + 1).map(|b| b.kind);
            linked[model.body_node(body)] = matches!(next, Some(BodyKind::Rear { .. }));
        }
        Self {
            matrix: condensed(model, &linked, &couplings),
            permanent: couplings.len(),
            linked,
            contacts: Vec::new(),
            tied: model.connectors.iter().flat_map(Connector::tied_nodes).collect(),
            condensed_bodies: CondensedBodies::default(),
            of_connector,
            of_constraint,
            right: vec![0.0; model.constraints.len()],
            low_rank: LowRank::default(),
        }
    }

    /// Nodes connected by contacts in the current pattern, which outlasts the contacts: the order of elimination follows from it, and the last bits
    /// of a solution from that.
    pub fn ties(&self) -> Vec<(usize, usize)> {
        self.matrix.couplings[self.permanent..].iter().map(|c| (c.0, c.1)).collect()
    }

    /// Adopts a pattern as given by [`Tangent::ties`].
    pub fn tie(&mut self, model: &Model, ties: &[(usize, usize)]) {
        let permanent = self.matrix.couplings[..self.permanent].iter().map(|c| (c.0, c.1));
        let places: Vec<(usize, usize)> = permanent.chain(ties.iter().copied()).collect();
        self.matrix = condensed(model, &self.linked, &places);
    }

    /// The band, not yet factored.
    pub fn chain_mut(&mut self) -> &mut Chain {
        &mut self.matrix.chain
    }

    /// Clears all parts except the band.
    pub fn clear_ties(&mut self) {
        self.contacts.clear();
        for coupling in &mut self.matrix.couplings {
            coupling.2 = ZERO;
        }
    }

    /// Blocks of the band and beyond it that are not zero: (row node, column node, block); before factorisation.
    pub fn blocks(&self) -> impl Iterator<Item = (usize, usize, &Block)> {
        let Chain { diag, upper, lower, .. } = &self.matrix.chain;
        let linked = |i: &usize| self.linked[*i];
        let band = diag.iter().enumerate().map(|(i, b)| (i, i, b));
        let above = (0..self.linked.len()).filter(linked).map(|i| (i, i + 1, &upper[i]));
        let below = (0..self.linked.len()).filter(linked).map(|i| (i + 1, i, &lower[i]));
        let beyond = self.matrix.couplings.iter().map(|(i, j, b)| (*i, *j, b));
        band.chain(above).chain(below).chain(beyond).filter(|(_, _, b)| **b != ZERO)
    }

    /// Adds the tangent of connector `i`.
    pub fn add_connector(
        &mut self,
        i: usize,
        connector: &Connector,
        blocks: &[[[[f64; 2]; 2]; 2]; 2],
    ) {
        for (g, (p, gradient)) in connector.attachments() {
            let n = if gradient { &p.slope } else { &p.shape };
            self.matrix.chain.add_outer(p.node, n, n, &blocks[g][g]);
        }
        let mut ends = connector.attachments();
        if let (Some((_, a)), Some((_, b))) = (ends.next(), ends.next()) {
            self.add_between(self.of_connector[i], a, b, &blocks[0][1], &blocks[1][0]);
        }
    }

    /// Adds the derivative of the force of constraint `i`, a matrix between the slopes at its two points.
    fn add_hessian(&mut self, i: usize, points: &[MaterialPoint; 2], k: &[[f64; 2]; 2]) {
        let transposed = [[k[0][0], k[1][0]], [k[0][1], k[1][1]]];
        let first = self.of_constraint[i];
        self.add_between(first, (&points[0], true), (&points[1], true), k, &transposed);
    }

    /// Adds the derivative of the force of constraint `i` with a multiplier, if it is quadratic.
    pub fn add_constraint(
        &mut self,
        i: usize,
        c: &Constraint,
        step: &ConstraintStep,
        multiplier: f64,
    ) {
        match &c.kind {
            ConstraintKind::Angle { points, .. } => {
                if let Some(k) = step.hessian(c, multiplier) {
                    self.add_hessian(i, points, &k);
                }
            }
            ConstraintKind::Length { point } => {
                let (k, node) = (multiplier * step.share, constraint::node_of_length(point));
                let block = &mut self.matrix.chain.diag[node];
                (2..4).for_each(|i| block[i][i] += k);
            }
            _ => {}
        }
    }

    fn add_between(
        &mut self,
        first: usize,
        a: (&MaterialPoint, bool),
        b: (&MaterialPoint, bool),
        forth: &[[f64; 2]; 2],
        back: &[[f64; 2]; 2],
    ) {
        let weights = |(p, gradient): (&MaterialPoint, bool)| {
            let n = if gradient { p.slope } else { p.shape };
            [[n[0], n[1]], [n[2], n[3]]].into_iter().filter(|w| *w != [0.0; 2]).collect::<Vec<_>>()
        };
        let (a, b) = (weights(a), weights(b));
        let mut k = first;
        for wa in &a {
            for wb in &b {
                add_block(&mut self.matrix.couplings[k].2, wa, wb, forth);
                add_block(&mut self.matrix.couplings[k + 1].2, wb, wa, back);
                k += 2;
            }
        }
    }

    /// Adds a block between two nodes that touch.
    pub fn add_contact(&mut self, row: usize, column: usize, block: &Block) {
        let chain = &mut self.matrix.chain;
        let target = if row == column {
            &mut chain.diag[row]
        } else if column == row + 1 && self.linked[row] {
            &mut chain.upper[row]
        } else if row == column + 1 && self.linked[column] {
            &mut chain.lower[column]
        } else {
            match self.contacts.iter().position(|c| c.0 == row && c.1 == column) {
                Some(at) => &mut self.contacts[at].2,
                None => {
                    self.contacts.push((row, column, ZERO));
                    let last = self.contacts.len() - 1;
                    &mut self.contacts[last].2
                }
            }
        };
        for (t, v) in target.as_flattened_mut().iter_mut().zip(block.as_flattened()) {
            *t += v;
        }
    }

    /// Passes the couplings of contacts to condensed bodies and, those without a condensed body, to the condensed matrix.
    fn place_contacts(&mut self, model: &Model) -> Result<(), Singular> {
        self.condensed_bodies.clear();
        if self.contacts.is_empty() {
            return Ok(());
        }
        for (a, b, block) in &mut self.contacts {
            project_coupling(model, *a, *b, block);
        }
        let first = model.beam_node_count();
        let chain = &mut self.matrix.chain;
        self.condensed_bodies
            .eliminate(chain, (&self.linked, &self.tied), first, &mut self.contacts)
            .map_err(Singular::Node)?;
        let known = |m: &Condensed, c: &(usize, usize, Block)| {
            m.couplings.iter().position(|k| (k.0, k.1) == (c.0, c.1))
        };
        if self.contacts.iter().any(|c| known(&self.matrix, c).is_none()) {
            self.widen(model);
        }
        for c in &self.contacts {
            if let Some(at) = known(&self.matrix, c) {
                let target = &mut self.matrix.couplings[at].2;
                for (t, v) in target.as_flattened_mut().iter_mut().zip(c.2.as_flattened()) {
                    *t += v;
                }
            }
        }
        Ok(())
    }

    /// A new order and pattern for contacts that connect nodes; those of the last one are kept while they are few.
    fn widen(&mut self, model: &Model) {
        let old = &self.matrix.couplings;
        let keep = if old.len() - self.permanent > 4 * self.contacts.len() + 16 {
            self.permanent
        } else {
            old.len()
        };
        let mut places: Vec<(usize, usize)> = old[..keep].iter().map(|c| (c.0, c.1)).collect();
        for (a, b, _) in &self.contacts {
            if !places.contains(&(*a, *b)) {
                places.push((*a, *b));
            }
        }
        let mut wider = condensed(model, &self.linked, &places);
        wider.chain = std::mem::take(&mut self.matrix.chain);
        for (new, old) in wider.couplings.iter_mut().zip(&self.matrix.couplings[..self.permanent]) {
            new.2 = old.2;
        }
        self.matrix = wider;
    }

    /// Factors the assembled tangent with its fixed components; border columns are the constraint gradients at the forces, rows those at the end of
    /// the step.
    ///
    /// # Errors
    /// Where it is singular.
    pub fn factor(
        &mut self,
        model: &Model,
        step: &ConstraintStep,
        damping: Option<DampedVectors>,
    ) -> Result<(), Singular> {
        for dofs in &model.prescribed {
            prescribe_block(&mut self.matrix.chain, dofs, &self.linked);
        }
        for (a, b, block) in &mut self.matrix.couplings {
            project_coupling(model, *a, *b, block);
        }
        self.place_contacts(model)?;
        for (i, c) in model.constraints.iter().enumerate() {
            let acts = step.forcing.constrained[i];
            self.matrix.corner[i] = if acts { 0.0 } else { 1.0 };
            for (end, vector) in
                [(false, &mut self.matrix.columns[i]), (true, &mut self.matrix.rows[i])]
            {
                step.border(c, end, vector);
                for (node, value) in vector.iter_mut() {
                    if !acts {
                        *value = [0.0; 4];
                    } else if let Some(dofs) = model.dofs_at(*node) {
                        dofs.project(value);
                    }
                }
            }
        }
        self.matrix
            .factor()
            .map_err(|at| at.map_or(Singular::Constraints, |p| Singular::Node(p.node)))?;
        let mut low_rank = std::mem::take(&mut self.low_rank);
        let solve = |x: &mut [_], border: &mut [_]| self.solve_plain(model, x, border);
        let regular = low_rank.factor(damping, model.constraints.len(), solve);
        self.low_rank = low_rank;
        if regular { Ok(()) } else { Err(Singular::Constraints) }
    }

    fn solve_plain(&mut self, model: &Model, x: &mut [[f64; 4]], border: &mut [f64]) {
        project(model, x);
        self.condensed_bodies.before(x);
        self.matrix.solve(x, border);
        self.condensed_bodies.after(x);
        project(model, x);
    }

    /// Solves `A x + C^T dl = x_given`, `C x = -c` in place and adds dl to `multiplier`.
    ///
    /// c is the change of each constraint over the step plus a share `feedback` of its value at the start, or zero without feedback. The share is
    /// that of the step in the given step size: round-off of positions, compensated within a very short step, would be a velocity.
    pub fn solve(
        &mut self,
        model: &Model,
        step: &ConstraintStep,
        x: &mut [[f64; 4]],
        multiplier: &mut [f64],
        feedback: Option<f64>,
    ) {
        let mut right = std::mem::take(&mut self.right);
        for (i, (c, right)) in model.constraints.iter().zip(&mut right).enumerate() {
            *right = match feedback {
                Some(share) if step.forcing.constrained[i] => {
                    -(step.change(c) + share * step.start_value(c))
                }
                _ => 0.0,
            };
        }
        self.solve_plain(model, x, &mut right);
        self.low_rank.correct(x, &mut right);
        for (m, change) in multiplier.iter_mut().zip(&right) {
            *m += change;
        }
        self.right = right;
    }

    /// Solves `A x + C^T dl = x_given`, `C x = 0` in place, without damping; returns dl.
    pub fn solve_linear(&mut self, model: &Model, x: &mut [[f64; 4]]) -> Vec<f64> {
        let mut border = vec![0.0; model.constraints.len()];
        self.solve_plain(model, x, &mut border);
        border
    }
}

/// The matrix with blocks beyond the band at the given places.
fn condensed(model: &Model, linked: &[bool], couplings: &[(usize, usize)]) -> Condensed {
    let pattern = |c: &Constraint| BorderPattern {
        nodes: constraint::nodes(c),
        permanent: c.until == f64::INFINITY && c.joint.is_none(),
        in_band: matches!(c.kind, ConstraintKind::Length { .. }),
    };
    let border: Vec<BorderPattern> = model.constraints.iter().map(pattern).collect();
    let mut matrix = Condensed::new(model.node_count(), |i| linked[i], couplings, &border);
    let alone = |b: &crate::model::frozen::Body| {
        matches!(b.kind, BodyKind::Disc { .. } | BodyKind::Obstacle)
    };
    let first = model.bodies.iter().position(alone).unwrap_or(model.bodies.len());
    matrix.chain.isolated = model.body_node(first);
    matrix
}

/// Adds `left^T k right` between two nodes' values and slopes.
fn add_block(block: &mut Block, left: &[f64; 2], right: &[f64; 2], k: &[[f64; 2]; 2]) {
    for p in 0..2 {
        for q in 0..2 {
            for i in 0..2 {
                for j in 0..2 {
                    block[2 * p + i][2 * q + j] += left[p] * right[q] * k[i][j];
                }
            }
        }
    }
}
