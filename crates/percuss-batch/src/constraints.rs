//! Joints of beams, and supports between nodes, in an ensemble: their multipliers follow from the Schur complement of the band.
//!
//! The same constraints as those of single runs ([`step::constraint`](percuss::internals::step::constraint)): forces along the gradient in the middle
//! of a step, which do no work, and a value that vanishes at its end. Lanes cannot search for pivots; the complement is that of a
//! tangent that masses dominate, and needs none.

use super::engine::Engine;
use percuss::internals::ledger::Ledger;
use percuss::internals::linalg::gauss_jordan;
use percuss::internals::model::frozen::{Constraint, ConstraintKind};
use percuss::internals::scalar::{Number, array};
use percuss::internals::step::constraint::{ConstraintStep, NodalForm, point_nodes};
use percuss::internals::step::convergence::ROUND_OFF;
use percuss::internals::step::forcing::Forcing;

/// Corrections by which derivatives follow the values where angles are kept: the tangent lacks what the forces of such a joint change
/// by when they turn, of the order of the strain of an element, so that each of them leaves a small share of what it finds.
pub const FOLLOWING: usize = 12;

/// What about a constraint an ensemble does not know, if anything.
pub fn unknown(c: &Constraint) -> Option<&'static str> {
    match &c.kind {
        _ if c.until < f64::INFINITY => Some("supports for a time"),
        _ if c.joint.is_some() => Some("joints of a given strength"),
        _ if !c.drive.is_empty() => Some("supports that move"),
        ConstraintKind::Turned { .. } => Some("supports that turn"),
        _ => None,
    }
}

/// The constraints of the runs in mid-flight.
#[derive(Clone, Debug)]
pub struct Constraints<S: Number> {
    /// One by one, shape (constraints).
    each: Vec<ConstraintState<S>>,
    /// No motion: supports that move are unknown.
    still: Forcing,
    /// Inverse of the Schur complement, row by row, shape (constraints * constraints) \[N/m, N, N m\].
    inverse: Vec<S>,
    /// Lanes in whose part impulses act: multipliers of such a part are no guess for what follows, and no round-off is taken back in it.
    pub impulsive: S::Mask,
}

/// A constraint on its way, and in the step at hand.
#[derive(Clone, Debug)]
struct ConstraintState<S> {
    /// Multiplier of the step accepted last, which the next one starts from \[N, N m\].
    accepted: S,
    /// Multiplier in the step at hand, and its correction \[N, N m\].
    multiplier: S,
    correction: S,
    /// Round-off of the steps before that this one takes back \[m, -\].
    taken_back: S,
    /// By how much the increment as it stands misses the constraint \[m, -\].
    miss: S,
    /// Gradient in the middle of the step, as it was evaluated last, shape (4, 4) \[-, m, 1/m\].
    gradient: NodalForm<S>,
    /// Gradient at the end of the step, in the free directions, of the factors in use, shape (4, 4) \[-, m, 1/m\].
    row: NodalForm<S>,
    /// What the factors in use answer to its gradient, shape (beam nodes, 4) \[m/N, 1/N\].
    column: Vec<[S; 4]>,
}

impl<S: Number> Constraints<S> {
    /// Of runs at rest in the reference configuration.
    pub fn new(numbers: &[Constraint<S>], nodes: usize, zero: S) -> Self {
        let none = [[zero; 4]; 4];
        let state = ConstraintState {
            accepted: zero,
            multiplier: zero,
            correction: zero,
            taken_back: zero,
            miss: zero,
            gradient: none,
            row: none,
            column: vec![[zero; 4]; nodes],
        };
        let n = numbers.len();
        let (each, inverse) = (vec![state; n], vec![zero; n * n]);
        Self { each, still: Forcing::default(), inverse, impulsive: zero.less(zero) }
    }

    /// Takes over a lane of other runs.
    pub fn set_lane(&mut self, lane: usize, from: &Self, from_lane: usize) {
        for (mine, other) in self.each.iter_mut().zip(&from.each) {
            mine.accepted.set_lane(lane, other.accepted, from_lane);
        }
    }

    /// Multipliers that the next steps start from, shape (constraints) \[N, N m\].
    pub fn accepted(&mut self) -> impl Iterator<Item = &mut S> {
        self.each.iter_mut().map(|c| &mut c.accepted)
    }

    /// Corrections of the multipliers, shape (constraints) \[N, N m\].
    pub fn corrections(&mut self) -> impl Iterator<Item = &mut S> {
        self.each.iter_mut().map(|c| &mut c.correction)
    }

    /// Takes the corrections in the lanes of `which`.
    #[inline(always)]
    pub fn correct(&mut self, which: S::Mask) {
        for c in &mut self.each {
            c.multiplier += S::choose(which, c.correction, c.correction.constant(0.0));
        }
    }

    /// Accepts the multipliers of the step at hand.
    #[inline(always)]
    pub fn commit(&mut self) {
        for c in &mut self.each {
            c.accepted = S::choose(self.impulsive, c.accepted, c.multiplier);
        }
    }

    /// Lanes whose increments, as large as `step`, meet all constraints but for round-off of displacements as large as `reach`.
    #[inline(always)]
    fn met(&self, step: S, reach: S, taken_back: S) -> S::Mask {
        let one = step.constant(1.0);
        let tolerance = (step + taken_back * (one + reach)) * ROUND_OFF;
        let all = !step.less(step);
        self.each.iter().fold(all, |met, c| met & c.miss.abs().at_most(tolerance))
    }
}

impl<S: Number> Engine<S> {
    /// Share of the constraints' round-off that the step at hand takes back: its share in a whole one.
    #[inline(always)]
    fn taken_back(&self) -> S {
        let one = self.h.constant(1.0);
        let share = self.h / self.numbers.step;
        let share = share.if_less(one, share, one);
        S::choose(self.constraints.impulsive, one.constant(0.0), share)
    }

    /// Begins a step: multipliers as the one before left them.
    #[inline(always)]
    pub fn predict_multipliers(&mut self) {
        if self.numbers.constraints.is_empty() {
            return;
        }
        let share = self.taken_back();
        for k in 0..self.numbers.constraints.len() {
            let value = self.constraint_step().start_value(&self.numbers.constraints[k]);
            let state = &mut self.constraints.each[k];
            (state.multiplier, state.taken_back) = (state.accepted, share * value);
        }
    }

    /// The step at hand as constraints see it.
    #[inline(always)]
    fn constraint_step(&self) -> ConstraintStep<'_, S> {
        let (start, increment) = (&self.displacement, &self.increment);
        ConstraintStep { start, increment, forcing: &self.constraints.still, share: 0.5 }
    }

    /// Forces of the constraints at the increment as it stands, and by how much it misses them.
    #[inline(always)]
    pub fn constrain(&mut self) {
        for k in 0..self.numbers.constraints.len() {
            self.see_constraint(k);
            let (c, state) = (&self.numbers.constraints[k], &self.constraints.each[k]);
            add_to(&mut self.residual, c, &state.gradient, state.multiplier);
        }
    }

    /// Looks at a constraint at the increment as it stands.
    #[inline(always)]
    fn see_constraint(&mut self, k: usize) {
        let c = &self.numbers.constraints[k];
        let (gradient, change) = {
            let step = self.constraint_step();
            (step.nodal_form(c, 0.5), step.change(c))
        };
        let state = &mut self.constraints.each[k];
        (state.gradient, state.miss) = (gradient, change + state.taken_back);
    }

    /// Lanes whose increments meet the constraints; `reach` is the size of the displacements, `look` says that the increments have changed
    /// since forces were evaluated.
    #[inline(always)]
    pub fn meet_constraints(&mut self, reach: S, look: bool) -> S::Mask {
        if self.numbers.constraints.is_empty() {
            return !reach.less(reach);
        }
        if look {
            (0..self.numbers.constraints.len()).for_each(|k| self.see_constraint(k));
        }
        let mut step = reach.constant(0.0);
        for d in &self.increment {
            (0..4).for_each(|i| step = step.max(d[i].abs()));
        }
        self.constraints.met(step, reach, self.taken_back())
    }

    /// Columns, rows and the Schur complement of the constraints for the factors in use, where they are new.
    #[inline(always)]
    pub fn factor_constraints(&mut self, renew: S::Mask) {
        let n = self.numbers.constraints.len();
        for k in 0..n {
            let c = &self.numbers.constraints[k];
            let step = self.constraint_step();
            let mut row = step.nodal_form(c, 1.0);
            let mut column = vec![[self.h.constant(0.0); 4]; self.increment.len()];
            step.add_gradient(c, self.h.constant(1.0), &mut column);
            for dofs in &self.numbers.prescribed {
                dofs.project(&mut column[dofs.node]);
                let own = point_nodes(c).zip(&mut row).filter(|(node, _)| *node == dofs.node);
                own.for_each(|(_, value)| dofs.project(value));
            }
            self.factors.solve(&mut column);
            let state = &mut self.constraints.each[k];
            choose_all(&mut state.row, &row, renew);
            choose_all(&mut state.column, &column, renew);
        }
        for i in 0..n {
            for j in 0..n {
                let (c, each) = (&self.numbers.constraints[i], &self.constraints.each);
                self.constraints.inverse[i * n + j] = applied(c, &each[i].row, &each[j].column);
            }
        }
        gauss_jordan::invert(&mut self.constraints.inverse, n);
    }

    /// Solves for the corrections with the factors in use and the constraints, which close what they miss or, if not `closing`, stay as
    /// they are.
    #[inline(always)]
    pub fn solve_constrained(&mut self, closing: bool) {
        self.factors.solve(&mut self.correction);
        let n = self.numbers.constraints.len();
        if n == 0 {
            return;
        }
        let zero = self.h.constant(0.0);
        for i in 0..n {
            let mut change = zero;
            for (j, c) in self.numbers.constraints.iter().enumerate() {
                let state = &self.constraints.each[j];
                let left = applied(c, &state.row, &self.correction);
                let left = if closing { left + state.miss } else { left };
                change = change.add_product(self.constraints.inverse[i * n + j], left);
            }
            self.constraints.each[i].correction = change;
        }
        for state in &self.constraints.each {
            for (x, answer) in self.correction.iter_mut().zip(&state.column) {
                for i in 0..4 {
                    x[i] = x[i].sub_product(state.correction, answer[i]);
                }
            }
        }
    }

    /// What the correction taken last has changed of the constraints' force on a node.
    #[inline(always)]
    pub fn add_constraint_change(&self, node: usize, change: &mut [S; 4]) {
        for (c, state) in self.numbers.constraints.iter().zip(&self.constraints.each) {
            if !point_nodes(c).any(|n| n == node) {
                continue;
            }
            let now = self.constraint_step().nodal_form(c, 0.5);
            let before = state.multiplier - state.correction;
            for (k, _) in point_nodes(c).enumerate().filter(|(_, n)| *n == node) {
                for i in 0..4 {
                    let force = now[k][i] * state.multiplier;
                    change[i] += force.sub_product(state.gradient[k][i], before);
                }
            }
        }
    }

    /// Enters the impulses of supports between nodes over the step.
    #[inline(always)]
    pub fn enter_constraints(&self, ledger: &mut Ledger<S>) {
        for (c, state) in self.numbers.constraints.iter().zip(&self.constraints.each) {
            if c.support.is_some() {
                let r = self.constraint_step().reaction(c, state.multiplier);
                ledger.react(self.h, r.at, r.force, r.moment);
            }
        }
    }
}

/// A gradient applied to nodal values.
#[inline(always)]
fn applied<S: Number>(c: &Constraint<S>, gradient: &NodalForm<S>, nodal: &[[S; 4]]) -> S {
    let mut sum = gradient[0][0].constant(0.0);
    for (node, on) in point_nodes(c).zip(gradient) {
        for i in 0..4 {
            sum = sum.add_product(on[i], nodal[node][i]);
        }
    }
    sum
}

/// Adds `factor` times a gradient to nodal values.
#[inline(always)]
fn add_to<S: Number>(nodal: &mut [[S; 4]], c: &Constraint<S>, gradient: &NodalForm<S>, factor: S) {
    for (node, on) in point_nodes(c).zip(gradient) {
        for i in 0..4 {
            nodal[node][i] = nodal[node][i].add_product(on[i], factor);
        }
    }
}

#[inline(always)]
fn choose_all<S: Number>(mine: &mut [[S; 4]], other: &[[S; 4]], which: S::Mask) {
    for (mine, other) in mine.iter_mut().zip(other) {
        *mine = array(|i| S::choose(which, other[i], mine[i]));
    }
}
