//! Newton's iteration for equilibrium: residual and tangent of a structure at rest, and their corrections.

mod failing;
mod folded;
mod given;
mod motions;
mod onset;
mod reached;
mod relaxed;
mod search;

pub(super) use search::{Motions, Push, Reached, StaticSearch, largest};

use super::spectrum::{Layout, free_motions};
use super::static_contacts::{Pressing, StaticContacts};
use crate::element::beam::{ElementValues, step_point};
use crate::element::collocation;
use crate::element::membrane::green_or_engineering;
use crate::element::shear::{self, moved};
use crate::linalg::block::inner;
use crate::math::hermite::GAUSS;
use crate::math::vec2::{add, scale};
use crate::model::Model;
use crate::model::frozen::{Connector, Coordinate};
use crate::settings::Scheme;
use crate::state::State;
use crate::step::constraint::ConstraintStep;
use crate::step::forcing::Forcing;
use crate::step::integration::{Integration, Rule};
use crate::step::newton::prescribe;
use crate::step::tangent::{Singular, project};
use crate::step::workspace::Workspace;
use crate::step::{assemble, connectors, external, fibres};

/// Corrections before an equilibrium counts as not found; with contacts, which close and open one after the other, more.
const MOST_ITERATIONS: usize = 30;
const MOST_WITH_CONTACTS: usize = 300;
/// Number of corrections after which a correction that changes the closed set is followed only as far as unbalanced forces act along it.
const PATIENCE: usize = 6;
/// Evaluations along such a correction, and the accepted share of the opposing unbalanced forces.
const MOST_LOOKS: usize = 8;
const ENOUGH: f64 = 0.5;
/// Last correction of an equilibrium, relative to its displacements; the next would be its square.
const SETTLED: f64 = 1e-9;
/// Corrections this small against the size of the structure are round-off of its positions.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
/// Inverse iterations for the lowest eigenvalue.
const INVERSE_ITERATIONS: usize = 40;
/// Forces of springs that are left unbalanced in an equilibrium, relative to the largest.
const BALANCED: f64 = 1e-6;
/// Statics has no step size; this one keeps quotients finite.
pub(super) const RULE: Integration = Integration { h: 1.0, rule: Rule::Static };

impl<'m> StaticSearch<'m> {
    pub fn new(model: &'m Model) -> Self {
        let mut base = State::at_rest(model, Scheme::StrainRate);
        // Prescribed motions start from zero here.
        base.coordinates =
            model.connectors.iter().map(|c| c.value(&base.displacement, 0.0)).collect();
        let (work, forcing) = (Workspace::at_rest(model), Forcing::new(model));
        let contacts = StaticContacts::new(model, &base);
        let (withheld, let_go, gaps) = (Vec::new(), 1.0, None);
        let (iterations, motions, stressed) = (0, Motions::Growing, true);
        Self {
            model,
            base,
            work,
            forcing,
            contacts,
            iterations,
            withheld,
            let_go,
            motions,
            stressed,
            gaps,
            push: None,
        }
    }

    /// At an equilibrium: increments are relative to it. In the reference configuration no load acts, and springs whose drawn length differs from
    /// their free length are taken as force-free if their forces do not balance there: beams have no corresponding forces.
    pub fn at(model: &'m Model, state: &State) -> Self {
        // A heated bar between walls does not move.
        let loaded = largest(&state.displacement) > 0.0 || state.is_strained();
        let mut search = Self::at_share(model, state, f64::from(u8::from(loaded)));
        search.stressed = loaded || search.springs_balance();
        search
    }

    /// Whether springs are force-free at the current configuration, or their forces balance.
    pub fn springs_balance(&mut self) -> bool {
        let mut springs = self.model.connectors.iter().zip(&self.base.coordinates);
        let stressed = springs.any(|(c, q)| c.potential(*q, &self.base.memories) != 0.0);
        !stressed || self.is_balanced()
    }

    /// Whether the forces of springs balance at the current configuration, relative to the largest of them.
    fn is_balanced(&mut self) -> bool {
        self.assemble::<false>();
        let mut free = self.work.residual.clone();
        project(self.model, &mut free);
        let each = self.model.connectors.iter().enumerate();
        let force = |(i, c): (usize, &Connector)| {
            let force = self.connector_step(i, c).force.abs();
            match c.coordinate {
                Coordinate::Angle { .. } => force / self.model.extent().max(f64::MIN_POSITIVE),
                _ => force,
            }
        };
        let most = each.map(force).fold(0.0, f64::max);
        self.largest_force(&free) <= BALANCED * most
    }

    /// Largest force of nodal ones, with moments divided by the size of the model, so that a structure and its image in another scale agree \[N\].
    fn largest_force(&self, nodal: &[[f64; 4]]) -> f64 {
        let length = self.model.extent();
        let one = |f: &[f64; 4]| {
            let moment = if length > 0.0 { f[2].abs().max(f[3].abs()) / length } else { 0.0 };
            f[0].abs().max(f[1].abs()).max(moment)
        };
        nodal.iter().map(one).fold(0.0, |most, f| if f.is_nan() { f } else { most.max(f) })
    }

    /// The same at an equilibrium under a share of the loads.
    pub fn at_share(model: &'m Model, state: &State, share: f64) -> Self {
        let mut search = Self::new(model);
        search.base.displacement.clone_from(&state.displacement);
        search.base.coordinates.clone_from(&state.coordinates);
        search.base.fibres.clone_from(&state.fibres);
        search.base.memories.clone_from(&state.memories);
        search.base.joints_parted.clone_from(&state.joints_parted);
        let parted: Vec<usize> = fibres::parted(model, &state.fibres).collect();
        parted.into_iter().for_each(|node| search.part_beam(node));
        search.work.multiplier.clone_from(&state.multiplier);
        search.set_share(share);
        search.forcing.hold_motions();
        search.foresee(true);
        search
    }

    /// Allows contacts to support beams without supports and joints; otherwise these beams are reported.
    pub fn hold_loose_beams(&mut self) {
        if self.contacts.is_empty() {
            return;
        }
        let structure = self.model.structure();
        let rest = State::at_rest(&structure, Scheme::EnergyMomentum);
        let layout = Layout::new(&structure);
        let loose = free_motions(&layout, &StaticSearch::at(&structure, &rest));
        self.contacts.hold_loosely(self.model, loose.stops);
    }

    /// Newton's iteration at a share of the loads, from the increment in the workspace.
    ///
    /// An equilibrium behind the start, relative to the first correction, is on another branch and is rejected; closing contacts may however
    /// reverse the way. One with elements that the way there has folded is rejected, too.
    pub fn solve(&mut self, share: f64) -> bool {
        self.set_share(share);
        let start = self.work.increment.clone();
        let folded = self.folded();
        let mut ahead: Option<Vec<[f64; 4]>> = None;
        prescribe(self.model, &self.forcing, &mut self.work.increment);
        // Obstacles have their position at time zero.
        self.work.increment[self.model.beam_node_count()..]
            .iter_mut()
            .zip(&self.model.bodies)
            .filter(|(_, body)| body.kind.is_obstacle())
            .for_each(|(d, _)| *d = [0.0; 4]);
        self.contacts.begin(Pressing::Exactly);
        self.contacts.slow_discs();
        let (alone, mut restless) = (self.contacts.is_empty(), 0);
        for _ in 0..if alone { MOST_ITERATIONS } else { MOST_WITH_CONTACTS } {
            if !self.direction() {
                return false;
            }
            if largest(&self.work.correction) > 1e-6 * self.size()
                && self.contacts.climb(&self.work.residual, &self.work.correction)
            {
                continue;
            }
            let ahead = ahead.get_or_insert_with(|| self.work.correction.clone());
            restless = if self.contacts.changed() { restless + 1 } else { 0 };
            let careful = restless > PATIENCE || self.contacts.opened();
            if !if careful { self.correct_along() } else { self.correct() } {
                return false;
            }
            let correction = largest(&self.work.correction);
            let moved = correction / largest(&self.work.increment);
            let small = moved.is_nan() || moved <= SETTLED || correction <= ROUND_OFF * self.size();
            if small && self.contacts.settled() {
                let way = |a: &[f64; 4], b: &[f64; 4]| std::array::from_fn(|i| a[i] - b[i]);
                let gone: Vec<[f64; 4]> =
                    self.work.increment.iter().zip(&start).map(|(a, b)| way(a, b)).collect();
                // NaN without any motion.
                let onward = moved.is_nan() || inner(&gone, ahead) >= 0.0;
                let found = (onward || !alone) && self.folded() <= folded;
                if found {
                    self.contacts.accept(self.model);
                }
                return found;
            }
        }
        false
    }

    /// The correction at the current increment, with the rigid contacts that close and open; `false` where there is none.
    fn direction(&mut self) -> bool {
        self.assemble::<true>();
        if self.contacts.press_exactly() {
            return self.press().is_some();
        }
        let regular = self.factor_assembled().is_ok();
        if regular {
            self.correction();
        }
        regular
    }

    pub fn factor_assembled(&mut self) -> Result<(), Singular> {
        let step = constraint_step(&self.base, &self.work.increment, &self.forcing);
        self.work.tangent.factor(self.model, &step, None)
    }

    /// The correction of the factored tangent; multipliers change with it.
    pub fn correction(&mut self) {
        let work = &mut self.work;
        for (c, r) in work.correction.iter_mut().zip(&work.residual) {
            *c = r.map(|x| -x);
        }
        project(self.model, &mut work.correction);
        let step = constraint_step(&self.base, &work.increment, &self.forcing);
        let (x, multiplier) = (&mut work.correction, &mut work.multiplier);
        work.tangent.solve(self.model, &step, x, multiplier, Some(1.0));
    }

    /// Applies the correction; false if it leads nowhere.
    pub fn correct(&mut self) -> bool {
        let share = self.contacts.share(self.model, &self.work.correction);
        if share < 1.0 {
            self.work.correction.as_flattened_mut().iter_mut().for_each(|c| *c *= share);
        }
        self.foresee(false);
        let work = &mut self.work;
        for (d, c) in work.increment.iter_mut().zip(&work.correction) {
            (0..4).for_each(|i| d[i] += c[i]);
        }
        self.contacts.correct(&work.correction, share);
        self.contacts.look_for_lost(self.model, &work.increment);
        self.iterations += 1;
        let reach = largest(&work.increment);
        let lost = self.contacts.lost(self.model).is_some();
        !lost && largest(&work.correction).is_finite() && reach <= 1e6 * self.size()
    }

    /// Applies the share of the correction along which the unbalanced forces have done most of their work: contacts that close within it end it.
    fn correct_along(&mut self) -> bool {
        let (start, full) = (self.work.increment.clone(), self.work.correction.clone());
        let before = inner(&self.work.residual, &full);
        if !self.correct() || before.is_nan() || before >= 0.0 {
            return before.is_finite();
        }
        let whole = inner(&self.work.correction, &full) / inner(&full, &full);
        let mut share = whole;
        for _ in 0..MOST_LOOKS {
            self.assemble::<false>();
            let after = inner(&self.work.residual, &full);
            if after <= -ENOUGH * before {
                break;
            }
            share *= (before / (before - after)).clamp(0.1, 0.7);
            self.work.increment.copy_from_slice(&start);
            for (c, f) in self.work.correction.iter_mut().zip(&full) {
                *c = f.map(|x| share * x);
            }
            self.foresee(false);
            for (d, c) in self.work.increment.iter_mut().zip(&self.work.correction) {
                (0..4).for_each(|i| d[i] += c[i]);
            }
        }
        true
    }

    /// Strains that the correction leads to, to first order; those of the increment itself if `still`.
    pub fn foresee(&mut self, still: bool) {
        let nothing = ElementValues { chord: [0.0; 2], slope_a: [0.0; 2], slope_b: [0.0; 2] };
        let Self { model, base, work, .. } = self;
        for (span, k, a, element) in model.each_element() {
            let table = span.table(k);
            let values = |n: &[[f64; 4]]| ElementValues::new(&n[a], &n[a + 1]);
            let (u, d) = (values(&base.displacement), values(&work.increment));
            let c = if still { nothing } else { values(&work.correction) };
            let stored = &mut base.strain[element];
            if let Some(shear) = span.shear_at(k) {
                *stored = shear::stored(shear.foresee(&moved(&u, &d, 1.0), &c));
                continue;
            }
            for (row, stored) in table.rows.iter().zip(stored.iter_mut()) {
                let point = step_point(row, &u, &d);
                let (slope, bend) = (c.at(&row.first), c.at(&row.second));
                let s = collocation::foresee(&row.weighed, &point, slope, bend);
                *stored = [s.membrane, s.bending];
            }
            let Some(samples) = &table.membrane else { continue };
            for (i, stored) in stored.iter_mut().enumerate() {
                let (t, row) = (samples.tangent[i], &samples.rows[i]);
                let slope = add(u.at(row), d.at(row));
                let step = crate::element::membrane::MembraneStep {
                    tangent: t,
                    slope_0: slope,
                    d_slope: [0.0; 2],
                };
                let here = step.collocated(span.measure, 0.0, 0.0);
                let (g, moved) = (add(t, slope), c.at(row));
                stored[0] = green_or_engineering(span.measure, t, slope)
                    + here.alpha * (g[0] * moved[0] + g[1] * moved[1]);
            }
        }
    }

    /// Residual, and tangent if `TANGENT`, at the current increment.
    pub fn assemble<const TANGENT: bool>(&mut self) {
        let Self { model, base, forcing, contacts, gaps, .. } = self;
        let Workspace { increment, residual, tangent, multiplier, beams, .. } = &mut self.work;
        let sums = (tangent.chain_mut(), beams);
        assemble::beams::<TANGENT>(model, base, &RULE, forcing.gravity, increment, residual, sums);
        if TANGENT {
            tangent.clear_ties();
            if let Some(gaps) = gaps {
                tangent.chain_mut().add_scaled(gaps, 1.0);
            }
        }
        weigh_masses(model, forcing, residual);
        external::apply::<TANGENT>(model, base, forcing, &RULE, increment, residual, tangent);
        contacts.bodies::<TANGENT>(model, forcing, residual, tangent);
        connectors::apply::<TANGENT>(model, base, &RULE, forcing, increment, residual, tangent);
        contacts.fix_nodes::<TANGENT>(residual, tangent);
        contacts.assemble::<TANGENT>(model, base, increment, residual, tangent);
        let step = constraint_step(base, increment, forcing);
        for (i, (c, multiplier)) in model.constraints.iter().zip(multiplier.iter()).enumerate() {
            step.add_gradient(c, *multiplier, residual);
            if TANGENT {
                tangent.add_constraint(i, c, &step, *multiplier);
            }
        }
        if let Some(push) = &self.push {
            push.row.spread(-push.force, &mut self.work.residual);
        }
        self.hold_back();
    }

    /// Size of the structure \[m\].
    pub fn size(&self) -> f64 {
        self.model.beams.iter().map(|b| b.length).sum::<f64>().max(1.0)
    }
}

/// The step from the base for constraints, with forces in the directions at its end.
fn constraint_step<'a>(
    base: &'a State,
    increment: &'a [[f64; 4]],
    forcing: &'a Forcing,
) -> ConstraintStep<'a> {
    ConstraintStep { start: &base.displacement, increment, forcing, share: 1.0 }
}

fn weigh_masses(model: &Model, forcing: &Forcing, residual: &mut [[f64; 4]]) {
    for mass in &model.masses {
        mass.point.spread(scale(-mass.mass, forcing.gravity), residual);
    }
}

/// The tangent of a structure about a state, assembled and not yet factored, with the search that made it.
pub(super) fn linearized<'m>(model: &'m Model, state: &State) -> StaticSearch<'m> {
    let mut search = StaticSearch::at(model, state);
    search.assemble::<true>();
    search
}

/// Unbalanced loads and internal forces at the nodes of a structure at rest, without supports and constraints, shape (nodes, 4) \[N, N m\].
pub(crate) fn unbalanced_forces(
    structure: &Model,
    state: &State,
    forcing: &Forcing,
) -> Vec<[f64; 4]> {
    let mut search = StaticSearch::at(structure, state);
    search.forcing.clone_from(forcing);
    search.forcing.rest_motions();
    search.work.multiplier.fill(0.0);
    search.assemble::<false>();
    search.work.residual.iter().map(|f| f.map(|c| -c)).collect()
}

/// Strains of a configuration, as the scheme that stores them keeps them, shape (elements, Gauss points, 2) \[-, 1/m\].
pub(crate) fn stored_strains(structure: &Model, state: &State) -> Vec<[[f64; 2]; GAUSS]> {
    let mut search = StaticSearch::at(structure, state);
    search.foresee(true);
    search.base.strain
}
