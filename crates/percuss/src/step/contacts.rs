//! Contacts within a step: springs condensed into the band, impulses from the Delassus operator.

use super::integration::Rule;
use super::newton::{Failure, StepProblem};
use super::workspace::Workspace;
use crate::contact::law;
use crate::math::vec2::{dot, scale};
use crate::model::frozen::ContactLaw;

impl StepProblem<'_> {
    /// Contact springs, their projectiles' unknowns condensed into the band.
    pub(super) fn springs<const TANGENT: bool>(&self, work: &mut Workspace) {
        let rule = &self.integration;
        for (i, p) in self.model.projectiles.iter().enumerate() {
            let ContactLaw::Spring { stiffness, force } = p.law else { continue };
            let state = &self.state.projectiles[i];
            let p0 = -self.state.gap(self.model, i);
            let moved = dot(p.direction, p.point.value(&work.increment));
            let p1 = p0 + work.travel[i] - moved;
            let step = match rule.rule {
                Rule::Midpoint(_) => law::step_force(force, stiffness, p0, p1),
                Rule::Alpha(_) | Rule::Static => law::collocated(stiffness, p0, p1, rule.theta()),
            };
            work.force[i] = step.force;
            let acceleration = rule.inertia(work.travel[i], state.speed, state.acceleration);
            work.projectile_residual[i] =
                step.force + p.mass * (acceleration - dot(self.forcing.gravity, p.direction));
            p.point.spread(scale(-step.force, p.direction), &mut work.residual);
            if TANGENT {
                work.spring_slope[i] = step.slope;
                if step.slope != 0.0 {
                    let inertia = p.mass * rule.inertia_slope();
                    let k = step.slope * inertia / (inertia + step.slope);
                    let d = p.direction;
                    let matrix =
                        [[k * d[0] * d[0], k * d[0] * d[1]], [k * d[1] * d[0], k * d[1] * d[1]]];
                    let (node, n) = (p.point.node, &p.point.shape);
                    work.tangent.chain_mut().add_outer(node, n, n, &matrix);
                }
            }
        }
    }

    /// Impulses of the active contacts from the Delassus operator of the factored tangent, and what they change.
    pub(super) fn impact(&self, work: &mut Workspace) -> Result<(), Failure> {
        let n = self.active.len();
        if n == 0 {
            return Ok(());
        }
        let h = self.integration.h;
        let rate_per_force = 2.0 / (h * h); // of the gap, for the midpoint rule: v1 = 2 d/h - v0, force L/h
        let problem = &mut work.impact;
        problem.delassus.resize(n * n, 0.0);
        problem.free.resize(n, 0.0);
        problem.bound.resize(n, 0.0);
        work.active_impulse.resize(n, 0.0);
        for (a, contact) in self.active.iter().enumerate() {
            let i = contact.projectile;
            let p = &self.model.projectiles[i];
            for (b, (column, _)) in work.contact_columns[..n].iter().enumerate() {
                problem.delassus[a * n + b] =
                    rate_per_force * dot(p.direction, p.point.value(column));
            }
            problem.delassus[a * n + a] += 1.0 / p.mass;
            work.active_impulse[a] = work.impulse[i];
            let d = p.point.value(&work.increment);
            let c = p.point.value(&work.correction);
            let v0 = p.point.value(&self.state.velocity);
            let beam: f64 =
                (0..2).map(|k| p.direction[k] * (2.0 * (d[k] + c[k]) / h - v0[k])).sum();
            let speed = self.state.projectiles[i].speed
                + h * dot(self.forcing.gravity, p.direction)
                - work.impulse[i] / p.mass;
            let row = &problem.delassus[a * n..(a + 1) * n];
            let carried: f64 =
                self.active.iter().zip(row).map(|(c, w)| w * work.impulse[c.projectile]).sum();
            problem.free[a] = beam - speed - carried;
            problem.bound[a] = contact.bound;
        }
        problem.solve(&mut work.active_impulse)?;
        for (a, contact) in self.active.iter().enumerate() {
            let change = work.active_impulse[a] - work.impulse[contact.projectile];
            work.impulse[contact.projectile] = work.active_impulse[a];
            let (column, multiplier) = &work.contact_columns[a];
            for (target, c) in work.correction.iter_mut().zip(column) {
                for i in 0..4 {
                    target[i] += change / h * c[i];
                }
            }
            for (target, m) in work.multiplier.iter_mut().zip(multiplier) {
                *target += change / h * m;
            }
        }
        Ok(())
    }
}
