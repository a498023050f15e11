//! Joints and supports between nodes in a step: forces, and corrections by the Schur complement of the band.

use super::Engine;
use percuss::internals::ledger::Ledger;
use percuss::internals::linalg::gauss_jordan;
use percuss::internals::model::frozen::Constraint;
use percuss::internals::scalar::{Number, array};
use percuss::internals::step::constraint::{ConstraintStep, NodalForm, point_nodes};

impl<S: Number> Engine<S> {
    /// Share of the constraints' round-off that is compensated in the current step: its size as a share of a whole step.
    #[inline(always)]
    fn taken_back(&self) -> S {
        let one = self.h.constant(1.0);
        let share = self.h / self.numbers.step;
        let share = share.if_less(one, share, one);
        S::choose(self.constraints.impulsive, one.constant(0.0), share)
    }

    /// Begins a step with the multipliers of the previous one.
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

    /// The current step for the constraints.
    #[inline(always)]
    fn constraint_step(&self) -> ConstraintStep<'_, S> {
        let (start, increment) = (&self.displacement, &self.increment);
        ConstraintStep { start, increment, forcing: &self.constraints.still, share: 0.5 }
    }

    /// Forces of the constraints at the current increment, and their violation.
    #[inline(always)]
    pub fn constrain(&mut self) {
        for k in 0..self.numbers.constraints.len() {
            self.see_constraint(k);
            let (c, state) = (&self.numbers.constraints[k], &self.constraints.each[k]);
            add_to(&mut self.residual, c, &state.gradient, state.multiplier);
        }
    }

    /// Evaluates a constraint at the current increment.
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

    /// Lanes whose increments satisfy the constraints; `reach` is the size of the displacements, `look` is true if the increments have changed
    /// since the last evaluation of forces.
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

    /// Columns, rows and the Schur complement of the constraints for the factors in use, in lanes with new factors.
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

    /// Solves for the corrections with the factors in use and the constraints, whose violation becomes zero or, if not `closing`, does not change.
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

    /// Change of the constraints' force on a node by the last correction.
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
