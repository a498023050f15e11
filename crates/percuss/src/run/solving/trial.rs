//! A solved part of a step: its kind, start and results, and its acceptance for observers.

use crate::ledger::Measures;
use crate::model::Model;
use crate::model::frozen::JointLoad;
use crate::state::{PairState, State};
use crate::step::contacts::{ActiveContact, Phase, RigidContact};
use crate::step::fibres::PartedElement;
use crate::step::forcing::Forcing;
use crate::step::integration::Integration;
use crate::step::newton::seen;
use crate::step::workspace::Workspace;

/// Progress of a sequence of impacts.
#[derive(Clone, Debug)]
pub struct Sequence {
    /// Length of an impact interval \[s\].
    pub(super) interval: f64,
    /// Active contacts: those that touched at its beginning, and those that rested, shape (such contacts) \[index of a pair\].
    pub(super) members: Vec<usize>,
    /// Contacts with a slower approach have no impact of their own \[m/s\].
    pub(super) least: f64,
    /// Impacts that it may still have.
    pub(super) left: usize,
}

/// Kind of a part of a step.
#[derive(Clone, Debug)]
pub enum PartKind {
    /// No impact; it may end at an instant of contact, that of the pair `located`.
    Free { located: Option<usize> },
    /// Prescribed velocities jump in it, which is as short as an impact.
    Jump,
    /// An impact interval.
    Impact,
    /// One of several impact intervals, one for each impact.
    InSequence(Sequence),
    /// The last of several, without rebound.
    EndOfSequence,
    /// Impacts have accumulated: contacts that would overlap at the end were held.
    Held,
    /// Held contacts come to rest.
    PlasticPostStep,
    /// A step of the paper's: impulses act over all of it.
    TimeStepping {
        /// Whether each active contact rests, shape (active contacts).
        persistent: Vec<bool>,
    },
}

/// Kind of a part of a step.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Its size \[s\].
    pub h: f64,
    /// Active rigid contacts, in the order of the workspace's, shape (active contacts).
    pub active: Vec<ActiveContact>,
    /// Whether their impulses obey a replacement for their law, which would have created energy.
    pub fallback_law: bool,
    /// Kind.
    pub kind: PartKind,
}

impl Trial {
    /// Whether its impulses are no forces over its length.
    pub fn carries_impulses(&self) -> bool {
        let strikes = |c: &ActiveContact| !matches!(c.phase, Phase::Resting { .. });
        matches!(self.kind, PartKind::Jump) || self.active.iter().any(strikes)
    }

    /// Whether it counts among the events of a step.
    pub fn is_event(&self) -> bool {
        match self.kind {
            PartKind::Free { located } => located.is_some(),
            PartKind::Impact | PartKind::InSequence(_) | PartKind::EndOfSequence => true,
            _ => false,
        }
    }

    /// In time-stepping, which of the active contacts rest; else empty.
    pub fn persistent(&self) -> &[bool] {
        match &self.kind {
            PartKind::TimeStepping { persistent } => persistent,
            _ => &[],
        }
    }
}

/// Pairs of a part of a step.
#[derive(Clone, Debug, Default)]
pub struct Encounters {
    /// Those taken into it, shape (such pairs) \[index of a pair\].
    pub near: Vec<usize>,
    /// Those that its motion brought within reach of each other, shape (such pairs) \[index of a pair\].
    pub reached: Vec<usize>,
    /// Pairs whose evaluation differs from the state, in their order, shape (such pairs) \[index of a pair\]: sleeping ones that were evaluated,
    /// and those whose side was unknown. They are stored until a part is accepted.
    pub sights: Vec<(usize, PairState)>,
}

impl Encounters {
    /// The evaluation of a pair, to be changed.
    pub fn sight_mut(&mut self, state: &State, pair: usize) -> &mut PairState {
        let found = self.sights.binary_search_by_key(&pair, |sight| sight.0);
        let k = found.unwrap_or_else(|k| {
            self.sights.insert(k, (pair, state.pairs[pair]));
            k
        });
        &mut self.sights[k].1
    }
}

/// A pair that the fracture of an element has separated at the end of a part of a step.
#[derive(Clone, Copy, Debug)]
pub struct Separated {
    /// The pair.
    pub pair: usize,
    /// As it was before the fracture.
    pub before: PairState,
}

/// Values at the start of a part of a step that are compared with its end.
#[derive(Clone, Debug, Default)]
pub struct PartStart {
    /// Time \[s\].
    pub time: f64,
    /// Largest energy so far \[J\].
    pub energy_scale: f64,
    /// Its smooth contacts, shape (smooth contacts).
    pub smooth: Vec<PairState>,
    /// Displacements and velocities of the recorded points, shape (recorded points, 2, 2) \[m, m/s\].
    pub points: Vec<[[f64; 2]; 2]>,
}

/// Memory and results of a part of a step.
#[derive(Clone, Debug)]
pub struct PartSolution {
    /// Increment, contacts with their forces and impulses, multipliers, residual; scratch of the solver.
    pub work: Workspace,
    /// Loads and motions over it.
    pub forcing: Forcing,
    /// Pairs that came close in it.
    pub encounters: Encounters,
    /// Values at its start.
    pub start: PartStart,
}

impl PartSolution {
    /// Memory of a part of a step.
    pub fn new(model: &Model) -> Self {
        Self {
            work: Workspace::new(model),
            forcing: Forcing::new(model),
            encounters: Encounters::default(),
            start: PartStart::default(),
        }
    }

    /// Notes how it begins.
    pub(super) fn begin(&mut self, model: &Model, state: &State) {
        let (sights, start) = (&self.encounters.sights, &mut self.start);
        (start.time, start.energy_scale) = (state.time, state.ledger.energy_scale);
        start.smooth.clear();
        start.smooth.extend(self.work.smooth.iter().map(|c| *seen(state, sights, c.pair)));
        start.points.clear();
        let points = model.points.iter();
        let (u, v) = (&state.displacement, &state.velocity);
        start.points.extend(points.map(|p| [p.displacement(u), p.velocity(u, v)]));
    }
}

/// A solved part of a step.
#[derive(Debug)]
pub struct Solved {
    /// Kind.
    pub trial: Trial,
    /// Scheme and size.
    pub rule: Integration,
    /// Whether it is as short as an impact, so that quotients over it are impulsive.
    pub impulsive: bool,
    /// Whether velocities jump in it: whether it is as short as an impact interval, or has an impact.
    pub jumps: bool,
    /// Contacts of a simultaneous impact of touching bodies, shape (2) \[index of a contact\].
    pub shared: Option<[usize; 2]>,
    /// Loads of joints with a strength, shape (such joints); empty if they are not forces.
    pub joint_loads: Vec<JointLoad>,
    /// Results.
    pub solution: Box<PartSolution>,
}

impl Solved {
    /// Whether reactions of supports over the part are impulses, of rigid supports or of the others.
    ///
    /// Of a part as short as an impact all are: no force is known from it. In a step of the paper's in which velocities jump, rigid supports transmit
    /// impulses, and a mean over the step would grow without limit as steps become shorter; the deformation of compliant supports limits their forces.
    pub fn reacts_by_impulses(&self, rigid: bool) -> bool {
        let over_step = self.jumps && matches!(self.trial.kind, PartKind::TimeStepping { .. });
        self.impulsive || (rigid && over_step)
    }

    /// Whether it is an impact with a non-zero impulse of at least one contact.
    pub fn strikes(&self) -> bool {
        let struck = |(contact, found): (&ActiveContact, &RigidContact)| {
            matches!(contact.phase, Phase::Impact { .. }) && found.impulse[0] > 0.0
        };
        match self.trial.kind {
            PartKind::Impact => self.trial.active.iter().zip(&self.solution.work.rigid).any(struck),
            PartKind::InSequence(_) | PartKind::EndOfSequence => true,
            _ => false,
        }
    }
}

/// An accepted part of a step for observers: its solution has the values at its start.
#[derive(Clone, Copy, Debug)]
pub struct Accepted<'a> {
    /// The model.
    pub model: &'a Model,
    /// The solution.
    pub solved: &'a Solved,
    /// State at its end.
    pub after: &'a State,
    /// Energies and momenta there.
    pub measures: &'a Measures,
    /// Pairs evaluated there, shape (such pairs) \[index of a pair\].
    pub awake: &'a [usize],
    /// Elements that parted there, shape (such elements).
    pub parted: &'a [PartedElement],
    /// Pairs that they have separated, in their order, shape (such pairs).
    pub separated: &'a [Separated],
    /// Whether any fibre has yielded in it.
    pub yielded: bool,
}

impl<'a> Accepted<'a> {
    /// Its memory.
    pub fn work(&self) -> &'a Workspace {
        &self.solved.solution.work
    }

    /// Values at its start.
    pub fn before(&self) -> &'a PartStart {
        &self.solved.solution.start
    }
}
