//! Given strains of the reference configuration.

use super::{BALANCED, StaticSearch, constraint_step};
use crate::step::tangent::project;

impl StaticSearch<'_> {
    /// Keeps given strains of the reference configuration, with these factors of their loads, if supports and constraints bear them without a
    /// displacement, as of a heated bar between walls: with the forces of the constraints. Else the configuration is no equilibrium, and they are
    /// left out with all other loads.
    pub fn keep_borne_strains(&mut self, factors: &[f64]) {
        self.set_share(0.0);
        self.work.multiplier.fill(0.0);
        self.assemble::<false>();
        let alone = self.work.residual.clone();
        self.forcing.give_strains(self.model, factors);
        self.assemble::<true>();
        let added = self.work.residual.iter_mut().zip(&alone);
        added.for_each(|(r, a)| (0..4).for_each(|i| r[i] -= a[i]));
        if self.factor_assembled().is_ok() {
            // Forces of the constraints for which least is left.
            self.correction();
            let mut free = self.work.residual.clone();
            let step = constraint_step(&self.base, &self.work.increment, &self.forcing);
            for (c, multiplier) in self.model.constraints.iter().zip(&self.work.multiplier) {
                step.add_gradient(c, *multiplier, &mut free);
            }
            project(self.model, &mut free);
            if self.largest_force(&free) <= BALANCED * self.largest_force(&self.work.residual) {
                return;
            }
        }
        self.set_share(0.0);
        self.work.multiplier.fill(0.0);
        self.stressed = self.springs_balance();
    }
}
