//! Equilibria of structures with members that may be slack and with stops that may be open.
//!
//! Parts without stress or force of one sign have no stiffness while they are slack or open: Newton's iteration finds no correction there, or one
//! that leads far away. With a stiffness against motion added to the tangent every correction decreases the energy, as in a motion without inertia
//! under viscous drag. The added stiffness decreases with the unbalanced forces, and the last corrections are Newton's: the result is an
//! equilibrium of the unmodified structure.

use super::{Pressing, Reached, StaticContacts, StaticSearch, constraint_step, largest};
use crate::analysis::spectrum::{metric, size};
use crate::element::fibre::StressLaw;
use crate::model::Model;

use crate::linalg::block::inner;
use crate::step::newton::prescribe;
use crate::step::tangent::project;

/// Corrections before an equilibrium counts as not found.
const MOST_ITERATIONS: usize = 3000;
/// A correction moves no node by more than this share of the longest beam, and changes no slope by more than this.
const REACH: f64 = 0.02;
const TURN: f64 = 0.2;
/// Factors by which more and less is added.
const MORE: f64 = 4.0;
const LESS: f64 = 0.25;
/// Corrections whose work is less than the predicted work by this share increase the energy and are rejected; those beyond this one are good.
const UPHILL: f64 = 0.5;
const GOOD: f64 = 0.2;
/// Range of the added stiffness, relative to the bending stiffness of the structure.
const RANGE: [f64; 2] = [1e-12, 1e12];
/// Unbalanced forces relative to the acting forces below which Newton's iteration takes over, and at which the configuration is an equilibrium if
/// Newton finds no correction: the position of a slack member without weight is arbitrary.
const NEAR: f64 = 1e-3;
const ROUND_OFF: f64 = 1e-11;
/// Error of a constraint that is none, against the size of the structure.
const CLOSED: f64 = 1e-12;

/// Whether any member may be slack or any stop open.
fn may_give_way(model: &Model) -> bool {
    let slack = |law: &StressLaw| law.slack().is_some();
    let mut fibres = model.spans.iter().filter_map(|span| span.fibres.as_ref());
    fibres.any(|of| of.laws.iter().any(slack))
        || model.connectors.iter().any(|c| c.law.may_give_way())
}

/// Increment, multipliers and contacts of an intermediate configuration.
type Place = (Vec<[f64; 4]>, Vec<f64>, StaticContacts);

impl StaticSearch<'_> {
    /// The same from a known equilibrium, for structures with slack members, open stops, or contacts as the only support; without effect for others.
    pub fn relax_from(&mut self, accepted: &Reached, share: f64) -> bool {
        if !may_give_way(self.model) && !self.contacts.holds_beams() {
            return false;
        }
        let lost = self.contacts.lost_one();
        self.go_back(accepted);
        let found = self.relax(share);
        if !found {
            // Bodies that the previous iteration found unsupported are still to be reported.
            self.contacts.lose(lost);
        }
        found
    }

    /// Equilibrium at a share of the loads from the increment in the workspace, with the added stiffness that convergence requires.
    fn relax(&mut self, share: f64) -> bool {
        self.begin_relaxed(share);
        let mass = metric(self.model, false);
        let longest = self.model.beams.iter().map(|b| b.length).fold(0.0, f64::max);
        let unit = if longest > 0.0 { (size(self.model) / longest).powi(4) } else { 1.0 };
        let reach = REACH * longest.max(f64::MIN_POSITIVE);
        let (mut added, mut near) = (1.0, NEAR);
        for _ in 0..MOST_ITERATIONS {
            let (left, apart) = (self.left_unbalanced(), self.apart());
            let together = apart <= CLOSED * self.size();
            if left <= near && together {
                // From here on less must be left before it is tried again.
                near = 0.1 * left;
                let place = self.place();
                if self.solve(share) {
                    return true;
                }
                self.restore(&place);
                self.begin_relaxed(share);
                if left <= ROUND_OFF {
                    self.contacts.accept(self.model);
                    return true;
                }
            }
            let place = self.place();
            self.foresee(true);
            self.assemble::<true>();
            self.work.tangent.chain_mut().add_scaled(&mass, added * unit);
            let before = self.relaxed_direction();
            // Separate parts are brought into contact first.
            if !together && before.is_some() && self.correct() {
                continue;
            }
            let leads = before.is_some_and(|work| work < 0.0) && self.correction_within(reach);
            let after = if leads && self.correct() { self.slope_after() } else { f64::INFINITY };
            let before = before.unwrap_or(f64::NAN);
            if after <= -UPHILL * before {
                if after <= -GOOD * before {
                    added = (LESS * added).max(RANGE[0]);
                }
                continue;
            }
            self.restore(&place);
            added *= MORE;
            if added > RANGE[1] {
                return false;
            }
        }
        false
    }

    fn begin_relaxed(&mut self, share: f64) {
        self.set_share(share);
        prescribe(self.model, &self.forcing, &mut self.work.increment);
        let beams = self.model.beam_node_count();
        let bodies = self.work.increment[beams..].iter_mut().zip(&self.model.bodies);
        bodies.filter(|(_, body)| body.kind.is_obstacle()).for_each(|(d, _)| *d = [0.0; 4]);
        self.contacts.begin(Pressing::Exactly);
        self.contacts.slow_discs();
    }

    /// Solves for the correction with the current tangent; returns its work against the unbalanced forces.
    fn relaxed_direction(&mut self) -> Option<f64> {
        if self.contacts.press_exactly() {
            self.press()?;
        } else {
            self.factor_assembled().ok()?;
            self.correction();
        }
        let work = inner(&self.work.residual, &self.work.correction);
        work.is_finite().then_some(work)
    }

    /// Whether the correction is within a distance \[m\], and its changes of slopes within their limit.
    fn correction_within(&self, reach: f64) -> bool {
        let within = |c: &[f64; 4]| {
            c[0].abs().max(c[1].abs()) <= reach && c[2].abs().max(c[3].abs()) <= TURN
        };
        self.work.correction.iter().all(within)
    }

    /// Work of the unbalanced forces at the end of the correction that was made.
    fn slope_after(&mut self) -> f64 {
        self.foresee(true);
        self.assemble::<false>();
        inner(&self.work.residual, &self.work.correction)
    }

    /// Unbalanced forces relative to the largest of loads and reactions.
    fn left_unbalanced(&mut self) -> f64 {
        self.foresee(true);
        self.assemble::<false>();
        let scale = largest(&self.work.residual).max(self.load());
        let mut free = self.work.residual.clone();
        project(self.model, &mut free);
        if scale > 0.0 { largest(&free) / scale } else { 0.0 }
    }

    /// Largest error of a constraint \[m, -\].
    fn apart(&self) -> f64 {
        let step = constraint_step(&self.base, &self.work.increment, &self.forcing);
        let error = |c| (step.start_value(c) + step.change(c)).abs();
        self.model.constraints.iter().map(error).fold(0.0, f64::max)
    }

    /// Largest force of the loads on a node \[N\]: a load that is carried where it acts leaves no reaction elsewhere.
    fn load(&mut self) -> f64 {
        let mut loads = self.applied();
        for (span, k, a, _) in self.model.each_element() {
            for (node, force) in span.table(k).uniform_force(a, self.forcing.gravity) {
                (0..2).for_each(|i| loads[node][i] += force[i]);
            }
        }
        loads.as_flattened().iter().fold(0.0, |most, f| most.max(f.abs()))
    }

    fn place(&self) -> Place {
        let work = &self.work;
        (work.increment.clone(), work.multiplier.clone(), self.contacts.clone())
    }

    fn restore(&mut self, place: &Place) {
        self.work.increment.copy_from_slice(&place.0);
        self.work.multiplier.copy_from_slice(&place.1);
        self.contacts.clone_from(&place.2);
    }
}
