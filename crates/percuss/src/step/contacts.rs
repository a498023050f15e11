//! Contacts within a step: conditions, results, tangents.

use super::tangent::Tangent;
use crate::contact::law::StepForce;
use crate::geometry::pair::Memory;
use crate::geometry::row::Row;
use crate::geometry::turning::Turning;
use crate::linalg::block::ZERO;

/// Parts of a step below this share of it are as short as an impact: a mean force over them is an impulse in disguise.
pub const IMPULSIVE: f64 = 1e-3;
/// Differences of gaps below this share of the size of positions are zero: the accuracy of round-off and Newton's iteration.
pub const GAP_RESOLUTION: f64 = 1e-12;

/// An active rigid contact in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveContact {
    /// The pair.
    pub pair: usize,
    /// Its condition.
    pub phase: Phase,
}

/// Phase of a rigid contact in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    /// It strikes: restitution along normal and tangent.
    Impact {
        /// Along the normal.
        restitution: f64,
        /// Along the tangent.
        tangential: f64,
    },
    /// It remains closed under contact force; friction acts against the sliding velocity at the end of the step, or against its mean.
    Resting { mean: bool },
    /// After a step in which impulses of this size held it: the total impulses are those of a plastic impact.
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

    /// Least rate of the gap at the end of a step that begins with this one, for a constant normal; a gap that opens already keeps its rate: an
    /// impulse would create energy.
    #[inline(always)]
    pub fn least_rate(&self, before: f64) -> f64 {
        match self {
            Self::Impact { restitution, .. } => -restitution * before.min(0.0) - before.max(0.0),
            Self::Resting { .. } => -before.max(0.0),
            Self::PlasticPostStep { .. } => 0.0,
        }
    }

    /// Whether a contact is closed after a step with this normal impulse. A sticking contact is held from there on; without contact force the next
    /// step releases it.
    pub fn closes(&self, impulse: f64) -> bool {
        match self {
            Self::Impact { restitution, .. } => *restitution == 0.0,
            phase => phase.carried()[0] + impulse > 0.0,
        }
    }
}

impl ActiveContact {
    /// Pair `i`, which remains closed under contact force.
    pub fn resting(pair: usize) -> Self {
        Self { pair, phase: Phase::Resting { mean: false } }
    }
}

/// Relation of impulses to the velocities before and after.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImpulseLaw {
    /// Newton's law along the normal, Coulomb's along the tangent, for the velocity after restitution.
    Newton,
    /// Moreau's: impulses of the plastic impact, times 1 + e. In an instant it never creates energy.
    Moreau,
    /// Newton's along the normal, Coulomb's on the mean sliding velocity: never creates energy, for any other actions in the step.
    Mean,
}

/// A smooth contact in a step, as last evaluated.
#[derive(Clone, Copy, Debug)]
pub struct SmoothContact {
    /// The pair.
    pub pair: usize,
    /// Force over the step.
    pub force: StepForce,
    /// Form of the force: that of the gap's change.
    pub row: Row,
    /// Data to store at the end of the step, if it was evaluated.
    pub end: Option<Memory>,
}

/// A pair that presses in a static equilibrium.
#[derive(Clone, Copy, Debug)]
pub struct PressingPair {
    /// The pair.
    pub pair: usize,
    /// Form of the force.
    pub row: Row,
    /// Force along it \[N\].
    pub force: f64,
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
    pub fn row(&self, k: usize) -> &Row {
        if k.is_multiple_of(2) { &self.normal } else { &self.tangent }
    }
}

/// Adds `slope row (x) end - bend d(gradient)`; without the second part for a constant normal.
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

/// Adds `-bend` times the contribution of the rotation of sections to the second derivative of a gap.
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
