//! External forces on a structure at rest: in equilibrium their resultant is zero, which is checked before results are reported.

use super::static_search::{StaticSearch, largest};
use crate::error::Error;
use crate::math::vec2::norm;
use crate::model::Model;
use crate::model::frozen::Span;
use crate::step::tangent::project;

/// Forces from outside that are left unbalanced, of those that act; each of Newton's iterations that ends leaves far less.
const LEFT: f64 = 1e-9;
/// Units in the last place that a strain may be off by, for rounded displacements.
const ROUNDED: f64 = 256.0 * f64::EPSILON;
/// Units in the last place that a gap, the difference of positions, may be off by.
const PLACED: f64 = 16.0 * f64::EPSILON;

/// Forces that act on a structure at rest from outside, each a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticBalance {
    /// Loads, weights included, shape (2) \[N\].
    pub loads: [f64; 2],
    /// Reactions of supports, obstacles and guides of projectiles, shape (2) \[N\].
    pub reactions: [f64; 2],
    /// Forces of springs to the ground and of foundations, shape (2) \[N\].
    pub springs: [f64; 2],
    /// Their sum, which is round-off, shape (2) \[N\].
    pub unbalanced: [f64; 2],
    /// Sum of their magnitudes \[N\].
    gross: f64,
}

impl StaticBalance {
    /// The balance at the current configuration of a search, with its residual assembled.
    pub(super) fn new(search: &mut StaticSearch, reactions: &[[f64; 3]]) -> Self {
        let mut gross = 0.0;
        let mut sum = |forces: &[[f64; 2]]| {
            gross += forces.iter().map(|f| norm(*f)).sum::<f64>();
            let along = |i: usize| forces.iter().map(|f| f[i]).sum::<f64>();
            [along(0), along(1)]
        };
        let loads = sum(&search.loads());
        let mut reactions: Vec<[f64; 2]> = reactions.iter().map(|r| [r[0], r[1]]).collect();
        reactions.extend(search.guide_reactions());
        let reactions = sum(&reactions);
        let springs = sum(&search.ground_springs());
        let unbalanced = [0, 1].map(|i| loads[i] + reactions[i] + springs[i]);
        Self { loads, reactions, springs, unbalanced, gross }
    }
}

/// Rejects a configuration without equilibrium: external forces that do not balance, or a node with unbalanced forces.
pub(super) fn check(
    search: &StaticSearch,
    balance: &StaticBalance,
    element_forces: &[[[f64; 3]; 2]],
) -> Result<(), Error> {
    let mut free = search.work.residual.clone();
    project(search.model, &mut free);
    let floor = LEFT * balance.gross.max(largest_inside(element_forces)) + rounded(search);
    let left = largest(&free).max(norm(balance.unbalanced));
    if left <= floor { Ok(()) } else { Err(Error::unbalanced(left, balance.gross)) }
}

/// The largest axial or shear force \[N\].
fn largest_inside(element_forces: &[[[f64; 3]; 2]]) -> f64 {
    let ends = element_forces.iter().flatten();
    ends.map(|[n, v, _]| n.abs().max(v.abs())).fold(0.0, f64::max)
}

/// Change of the forces of elements due to rounding of the displacements, and of compliant contacts due to that of positions \[N\].
fn rounded(search: &StaticSearch) -> f64 {
    let model = search.model;
    let reach = largest(&search.displacement());
    let one = |(span, k): (&Span, usize)| {
        let table = span.table(k);
        table.rows[1].section.axial * (1.0 + reach / table.length)
    };
    let most = model.each_element().map(|(span, k, ..)| one((span, k))).fold(0.0, f64::max);
    let contacts = PLACED * search.size() * search.contacts.largest_stiffness();
    ROUNDED * most * (model.element_count() as f64).sqrt() + contacts
}

impl StaticSearch<'_> {
    /// Loads as they act in the configuration, weights included, in parts of any number, shape (parts, 2) \[N\].
    fn loads(&mut self) -> Vec<[f64; 2]> {
        let gravity = self.forcing.gravity;
        let mut out = self.applied();
        let model: &Model = self.model;
        for (span, k, a, _) in model.each_element() {
            let on_nodes = span.table(k).uniform_force(a, gravity);
            out.extend(on_nodes.map(|(_, f)| [f[0], f[1]]));
        }
        out.extend(model.masses.iter().map(|mass| gravity.map(|g| mass.mass * g)));
        let bodies = model.bodies.iter().enumerate();
        let discs = bodies.filter(|(i, _)| self.contacts.has_disc(*i));
        out.extend(discs.map(|(_, body)| gravity.map(|g| body.mass * g)));
        out
    }

    /// Forces of guides on the projectiles that are in the analysis, across their lines of motion, shape (such projectiles, 2) \[N\].
    fn guide_reactions(&self) -> Vec<[f64; 2]> {
        let (model, all) = (self.model, &self.work.residual);
        let mut free = all.clone();
        project(model, &mut free);
        let bodies = model.bodies.iter().enumerate();
        let guided = bodies.filter(|(i, body)| body.kind.is_guided() && self.contacts.has_disc(*i));
        let held = |node: usize| [0, 1].map(|k| all[node][k] - free[node][k]);
        guided.map(|(i, _)| held(model.body_node(i))).collect()
    }

    /// Forces on the structure of springs to the ground or to a fixed body, shape (springs, 2) \[N\].
    fn ground_springs(&self) -> Vec<[f64; 2]> {
        let mut out = Vec::new();
        for (i, c) in self.model.connectors.iter().enumerate().filter(|(_, c)| c.support.is_none())
        {
            let is_fixed = |node| self.contacts.is_fixed(node);
            let mut ends = c
                .attachments()
                .filter(|(_, (p, slope))| !slope && !p.body_node().is_some_and(is_fixed));
            if let (Some((end, _)), None) = (ends.next(), ends.next()) {
                let step = self.connector_step(i, c);
                out.push(step.forms[end].map(|form| -step.force * form));
            }
        }
        out
    }
}
