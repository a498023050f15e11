//! Contacts within a step: smooth forces along discrete gradients, impulses from the Delassus operator.

use super::integration::Rule;
use super::newton::StepProblem;
use super::tangent::Tangent;
use super::workspace::Workspace;
use crate::contact::law::StepForce;
use crate::contact::search::longest_arcs;
use crate::geometry::configuration::Configuration;
use crate::geometry::pair::Memory;
use crate::geometry::row::Row;
use crate::geometry::touch::Reach;
use crate::geometry::turning::Turning;
use crate::linalg::block::ZERO;
use crate::model::{ContactForce, RigidLaw, SmoothLaw, TouchLaw};

/// Parts of a step below this share of it are as short as an impact: a mean force over them is an impulse in disguise.
pub const IMPULSIVE: f64 = 1e-3;
/// Differences of gaps below this share of the size of positions are none: what round-off and Newton's iteration leave of them.
pub const GAP_RESOLUTION: f64 = 1e-12;

/// A rigid contact that takes part in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveContact {
    /// The pair.
    pub pair: usize,
    /// What is asked of it.
    pub phase: Phase,
}

/// What a rigid contact does in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    /// It strikes: restitution along normal and tangent.
    Impact {
        /// Along the normal.
        restitution: f64,
        /// Along the tangent.
        tangential: f64,
    },
    /// It stays closed while it presses; friction acts against the sliding velocity at the end of the step, or against its mean.
    Resting { mean: bool },
    /// After a step that held it by impulses of this size: both together are those of a plastic impact.
    PlasticPostStep {
        /// Along normal and tangent, shape (2) \[N s\].
        carried: [f64; 2],
    },
}

impl Phase {
    /// Impulses along normal and tangent that have acted before and count in \[N s\].
    pub fn carried(&self) -> [f64; 2] {
        match self {
            Self::PlasticPostStep { carried } => *carried,
            _ => [0.0; 2],
        }
    }

    /// Least rate of the gap at the end of a step that begins with this one, where the normal does not turn; one that happens to open already is
    /// let go as it came: an impulse would give energy.
    #[inline(always)]
    pub fn least_rate(&self, before: f64) -> f64 {
        match self {
            Self::Impact { restitution, .. } => -restitution * before.min(0.0) - before.max(0.0),
            Self::Resting { .. } => -before.max(0.0),
            Self::PlasticPostStep { .. } => 0.0,
        }
    }

    /// Whether a contact is closed behind a step in which it gave this impulse along the normal. What sticks is held from there on; if
    /// nothing presses it, the next step releases it.
    pub fn closes(&self, impulse: f64) -> bool {
        match self {
            Self::Impact { restitution, .. } => *restitution == 0.0,
            phase => phase.carried()[0] + impulse > 0.0,
        }
    }
}

impl ActiveContact {
    /// Pair `i`, which stays closed while it presses.
    pub fn resting(pair: usize) -> Self {
        Self { pair, phase: Phase::Resting { mean: false } }
    }
}

/// How impulses follow from the velocities before and after.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImpulseLaw {
    /// Newton's along the normal, Coulomb's along the tangent on what restitution leaves.
    Newton,
    /// Moreau's: impulses of the plastic impact, times 1 + e. In an instant it never gives energy.
    Moreau,
    /// Newton's along the normal, Coulomb's on the mean sliding velocity: never gives energy, whatever else acts in the step.
    Mean,
}

/// A smooth contact in a step, as last evaluated.
#[derive(Clone, Copy, Debug)]
pub struct SmoothContact {
    /// The pair.
    pub pair: usize,
    /// Force over the step.
    pub force: StepForce,
    /// Where the force acts: the form of the gap's change.
    pub row: Row,
    /// What to remember at the end of the step, if that was looked at.
    pub end: Option<Memory>,
}

/// A rigid contact in a step, as last evaluated.
#[derive(Clone, Copy, Debug, Default)]
pub struct RigidContact {
    /// Gradient of the gap.
    pub normal: Row,
    /// Form of the sliding velocity.
    pub tangent: Row,
    /// Impulses along normal and tangent, shape (2) \[N s\].
    pub impulse: [f64; 2],
}

impl RigidContact {
    /// The form of row `k` of the impact problem: that of the normal for an even one, of the tangent for an odd one.
    pub(super) fn row(&self, k: usize) -> &Row {
        if k.is_multiple_of(2) { &self.normal } else { &self.tangent }
    }
}

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
    pub(super) fn rigid_law(&self, pair: usize) -> Option<RigidLaw> {
        match &self.model.contacts[self.model.pairs[pair].contact].law {
            TouchLaw::Rigid(law) => Some(*law),
            TouchLaw::Smooth(_) => None,
        }
    }

    /// Bounds the elements' lengths at the increment as it stands.
    pub(super) fn measure_arcs(&self, work: &mut Workspace) {
        longest_arcs(self.model, self.arcs, &work.increment, &mut work.arcs);
    }

    /// The same within the iteration, where something is looked for all along a beam.
    pub(super) fn measure_arcs_if_needed(&self, work: &mut Workspace) {
        if self.reach == Reach::All || !self.active.is_empty() {
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
            let touch = pair.touch(self.model, &mid, &seen.memory, Reach::Near)?;
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
            // Where the closest point crosses into another element the gradients know other nodes; those of the middle will do.
            let crosses = step.end.closest.node != step.middle.closest.node;
            let end = &if crosses { *middle } else { pair.normal_row(&step.end, &at) };
            let (turning, bend) = (pair.turning(&step.middle, &mid), 0.5 * force.force);
            add_tangent(tangent, middle, end, force.slope, bend, turning.as_ref());
            let of_sections = pair.section_turnings(&step.middle, &mid);
            of_sections.iter().flatten().for_each(|t| add_turning(tangent, bend, t));
        }
        Some(SmoothContact { pair: index, force, row, end: Some(step.end.memory) })
    }

    /// A guided projectile's contact, whose gap is linear: what a [`StepGap`](crate::contact::discrete_gradient::StepGap) would hold besides,
    /// it does without.
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

    /// Rows of the active rigid contacts at the increment as it stands, and their impulses' part of the residual.
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
            // What stays closed does so at the end of the step: the form must give the change of the gap.
            Phase::Resting { .. } => {
                let step =
                    pair.over_step(self.model, &at, &seen.memory, seen.gap, true, Reach::All)?;
                (step.middle, step.row)
            }
            Phase::Impact { .. } | Phase::PlasticPostStep { .. } => {
                let touch = pair.touch(self.model, &mid, &seen.memory, Reach::Near)?;
                (touch, pair.normal_row(&touch, &mid))
            }
        };
        let frictional = self.rigid_law(contact.pair).is_some_and(|law| law.friction > 0.0);
        let tangent = if frictional { pair.tangent_row(&touch, &mid) } else { Row::default() };
        Some(RigidContact { normal, tangent, impulse })
    }
}

/// Adds `slope row (x) end - bend d(gradient)`; without the second part where the normal does not turn.
pub(crate) fn add_tangent(
    tangent: &mut Tangent,
    row: &Row,
    end: &Row,
    slope: f64,
    bend: f64,
    turning: Option<&Turning>,
) {
    for (column, on_end) in end.iter() {
        let turned = turning.map(|t| {
            let [a, b] = t.forms.each_ref().map(|form| form.at(column));
            t.weights.map(|w| [0, 1, 2, 3].map(|k| bend * (w[0] * a[k] + w[1] * b[k])))
        });
        for (node, on_row) in row.iter() {
            let mut block = ZERO;
            for r in 0..4 {
                block[r] = on_end.map(|x| slope * on_row[r] * x);
            }
            if let (Some(t), Some(turned)) = (turning, &turned) {
                let [a, b] = t.forms.each_ref().map(|form| form.at(node));
                for r in 0..4 {
                    for c in 0..4 {
                        block[r][c] -= a[r] * turned[0][c] + b[r] * turned[1][c];
                    }
                }
            }
            tangent.add_contact(node, column, &block);
        }
    }
}

/// Adds `-bend` times what a turn of sections adds to the second derivative of a gap.
pub(crate) fn add_turning(tangent: &mut Tangent, bend: f64, turning: &Turning) {
    let [first, second] = &turning.forms;
    let w = &turning.weights;
    for (column, a) in first.iter() {
        let b = second.at(column);
        let turned = w.map(|w| [0, 1, 2, 3].map(|k| bend * (w[0] * a[k] + w[1] * b[k])));
        for (node, c) in first.iter() {
            let d = second.at(node);
            let block = [0, 1, 2, 3]
                .map(|r| [0, 1, 2, 3].map(|k| -(c[r] * turned[0][k] + d[r] * turned[1][k])));
            tangent.add_contact(node, column, &block);
        }
    }
}
