//! Contacts at an increment: forces of the smooth ones along discrete gradients, rows of the rigid ones.

use super::StepProblem;
use crate::contact::law::StepForce;
use crate::contact::search::longest_arcs;
use crate::geometry::configuration::Configuration;
use crate::geometry::row::Row;
use crate::geometry::touch::SearchRegion;
use crate::model::{ContactForce, RigidLaw, SmoothLaw, TouchLaw};
use crate::step::contacts::{
    ActiveContact, Phase, RigidContact, SmoothContact, add_tangent, add_turning,
};
use crate::step::integration::Rule;
use crate::step::workspace::Workspace;

impl StepProblem<'_> {
    fn configuration<'b>(
        &'b self,
        increment: &'b [[f64; 4]],
        arcs: &'b [f64],
    ) -> Configuration<'b> {
        self.state.configuration_after(increment, arcs)
    }

    fn smooth_law(&self, pair: usize) -> Option<&SmoothLaw> {
        match &self.model.contacts[self.model.pairs[pair].contact].law {
            TouchLaw::Smooth(law) => Some(law),
            TouchLaw::Rigid(_) => None,
        }
    }

    /// Law of a rigid pair.
    pub(in crate::step) fn rigid_law(&self, pair: usize) -> Option<RigidLaw> {
        match &self.model.contacts[self.model.pairs[pair].contact].law {
            TouchLaw::Rigid(law) => Some(*law),
            TouchLaw::Smooth(_) => None,
        }
    }

    /// Bounds the elements' lengths at the current increment.
    pub(super) fn measure_arcs(&self, work: &mut Workspace) {
        longest_arcs(self.model, self.arcs, &work.increment, &mut work.arcs);
    }

    /// The same within the iteration, for a search along a whole beam.
    pub(super) fn measure_arcs_if_needed(&self, work: &mut Workspace) {
        if self.reach == SearchRegion::All || !self.active.is_empty() {
            self.measure_arcs(work);
        }
    }

    /// Forces of the smooth contacts.
    pub(super) fn smooth_contacts<const TANGENT: bool>(&self, work: &mut Workspace) {
        let mut contacts = std::mem::take(&mut work.smooth);
        contacts.clear();
        for &pair in self.near {
            let Some(law) = self.smooth_law(pair) else { continue };
            if let Some(contact) = self.smooth_contact::<TANGENT>(pair, law, work) {
                contact.row.spread(-contact.force.force, &mut work.residual);
                contacts.push(contact);
            }
        }
        work.smooth = contacts;
    }

    fn smooth_contact<const TANGENT: bool>(
        &self,
        index: usize,
        law: &SmoothLaw,
        work: &mut Workspace,
    ) -> Option<SmoothContact> {
        let (pair, seen) = (&self.model.pairs[index], self.seen(index));
        let Workspace { increment, tangent, arcs, .. } = work;
        let rule = &self.integration;
        let theta = rule.theta();
        let at = self.configuration(increment, arcs);
        if let Rule::Alpha(_) = rule.rule {
            let mid = at.at(theta);
            let touch = pair.touch(self.model, &mid, &seen.memory, SearchRegion::Near)?;
            let row = pair.normal_row(&touch, &mid);
            let force = law.potential.collocated(-touch.gap, -touch.gap, 1.0);
            if TANGENT && force.force > 0.0 {
                let (slope, bend) = (theta * force.slope, theta * force.force);
                let turning = pair.turning(&touch, &mid);
                add_tangent(tangent, &row, &row, slope, bend, turning.as_ref());
                let of_sections = pair.section_turnings(&touch, &mid);
                of_sections.iter().flatten().for_each(|t| add_turning(tangent, bend, t));
            }
            return Some(SmoothContact { pair: index, force, row, end: None });
        }
        if pair.target.is_guided() {
            return self.guided_contact::<TANGENT>(index, law, work);
        }
        let projected = law.force == ContactForce::Conserving;
        let step =
            pair.over_step(self.model, &at, &seen.memory, seen.gap, projected, self.reach)?;
        let (force, row) = if law.force == ContactForce::Midpoint {
            let p = -step.middle.gap;
            let force = law.potential.collocated(p, p, 1.0);
            (StepForce { slope: 0.5 * force.slope, ..force }, step.row)
        } else {
            (law.step_force(step.gaps.map(|gap| -gap), seen.deepest, rule.h), step.row)
        };
        if TANGENT && force.force > 0.0 {
            let mid = at.at(0.5);
            let middle = &pair.normal_row(&step.middle, &mid);
            // If the closest point crosses into another element, the gradients have other nodes; those of the middle are used.
            let crosses = step.end.closest.node != step.middle.closest.node;
            let end = &if crosses { *middle } else { pair.normal_row(&step.end, &at) };
            let (turning, bend) = (pair.turning(&step.middle, &mid), 0.5 * force.force);
            add_tangent(tangent, middle, end, force.slope, bend, turning.as_ref());
            let of_sections = pair.section_turnings(&step.middle, &mid);
            of_sections.iter().flatten().for_each(|t| add_turning(tangent, bend, t));
        }
        Some(SmoothContact { pair: index, force, row, end: Some(step.end.memory) })
    }

    /// A guided projectile's contact, whose gap is linear: it does not need the other data of a
    /// [`StepGap`](crate::contact::discrete_gradient::StepGap).
    fn guided_contact<const TANGENT: bool>(
        &self,
        index: usize,
        law: &SmoothLaw,
        work: &mut Workspace,
    ) -> Option<SmoothContact> {
        let (pair, seen) = (&self.model.pairs[index], self.seen(index));
        let Workspace { increment, tangent, arcs, .. } = work;
        let at = self.configuration(increment, arcs);
        let mid = at.at(0.5);
        let gap = pair.guided_gap(&at)?;
        let row = pair.guided_row(&mid);
        let force = if law.force == ContactForce::Midpoint {
            let p = -pair.guided_gap(&mid)?;
            let force = law.potential.collocated(p, p, 1.0);
            StepForce { slope: 0.5 * force.slope, ..force }
        } else {
            law.step_force([-seen.gap, -gap], seen.deepest, self.integration.h)
        };
        if TANGENT && force.force > 0.0 {
            // A mass and a point of an axis have no section that turns, either.
            add_tangent(tangent, &row, &pair.guided_row(&at), force.slope, 0.0, None);
        }
        Some(SmoothContact { pair: index, force, row, end: Some(seen.memory) })
    }

    /// Rows of the active rigid contacts at the current increment, and the contribution of their impulses to the residual.
    pub(super) fn rigid_contacts(&self, work: &mut Workspace) {
        let h = self.integration.h;
        work.turned = 0.0;
        for (a, contact) in self.active.iter().enumerate() {
            let impulse = work.rigid[a].impulse;
            let Some(found) = self.rigid_contact(contact, work, impulse) else {
                continue;
            };
            let before = &work.rigid[a];
            let rows = [(&found.normal, &before.normal), (&found.tangent, &before.tangent)];
            for ((now, then), impulse) in rows.into_iter().zip(impulse) {
                if impulse != 0.0 {
                    work.turned += now.turned(then) * impulse.abs();
                }
            }
            work.rigid[a] = found;
            found.normal.spread(-impulse[0] / h, &mut work.residual);
            if impulse[1] != 0.0 {
                found.tangent.spread(-impulse[1] / h, &mut work.residual);
            }
        }
    }

    /// A rigid contact in the middle of the step.
    pub(super) fn rigid_contact(
        &self,
        contact: &ActiveContact,
        work: &Workspace,
        impulse: [f64; 2],
    ) -> Option<RigidContact> {
        let (pair, seen) = (&self.model.pairs[contact.pair], self.seen(contact.pair));
        let at = self.configuration(&work.increment, &work.arcs);
        let mid = at.at(0.5);
        let (touch, normal) = match contact.phase {
            // A closed contact remains closed at the end of the step: the form must give the change of the gap.
            Phase::Resting { .. } => {
                let step = pair.over_step(
                    self.model,
                    &at,
                    &seen.memory,
                    seen.gap,
                    true,
                    SearchRegion::All,
                )?;
                (step.middle, step.row)
            }
            Phase::Impact { .. } | Phase::PlasticPostStep { .. } => {
                let touch = pair.touch(self.model, &mid, &seen.memory, SearchRegion::Near)?;
                (touch, pair.normal_row(&touch, &mid))
            }
        };
        let frictional = self.rigid_law(contact.pair).is_some_and(|law| law.friction > 0.0);
        let tangent = if frictional { pair.tangent_row(&touch, &mid) } else { Row::default() };
        Some(RigidContact { normal, tangent, impulse })
    }
}
