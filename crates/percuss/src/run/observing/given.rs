//! Reactions of supports and forces of projectiles: means of forces, and impulses separately.

use serde::{Deserialize, Serialize};

use crate::geometry::row::Row;
use crate::model::Model;
use crate::run::solving::trial::Accepted;
use crate::state::State;
use crate::summary::SupportSummary;

/// Reactions of supports: forces as means over steps, and additional impulses in impacts and jumps. Their sum is the total impulse of the supports,
/// over a row of the history as over the run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RowReactions {
    /// Impulses and angular impulse since the last instant settled, of the parts in which they are those of forces, shape (supports, 3)
    /// \[N s, N m s\].
    sum: Vec<[f64; 3]>,
    /// These parts for compliant and for rigid supports, shape (2).
    unsettled: [Unsettled; 2],
    /// Mean reactions over the time before the last instant settled, shape (supports, 3) \[N, N m\].
    mean: Vec<[f64; 3]>,
    /// Impulses of supports up to the last settled instant, shape (supports, 3) \[N s, N m s\].
    before: Vec<[f64; 3]>,
    /// That instant \[s\].
    settled: f64,
    /// Impulse of forces and impulses since the last row, shape (2, supports, 3) \[N s, N m s\].
    since_row: [Vec<[f64; 3]>; 2],
    /// Time of the last row \[s\].
    row: f64,
    /// Mean reactions and impulses of the last row, shape (2, supports, 3) \[N, N m\] and \[N s, N m s\].
    last_row: [Vec<[f64; 3]>; 2],
}

/// Parts since the last instant settled, for supports of one kind.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Unsettled {
    /// Duration of those in which reactions are forces \[s\].
    time: f64,
    /// Whether reactions were impulses in any: a mean over it is an impulse in disguise.
    carries_impulses: bool,
}

impl RowReactions {
    /// Before the first row, with the reactions at the start.
    pub fn new(state: &State, mean: &[[f64; 3]]) -> Self {
        let (mean, none) = (mean.to_vec(), vec![[0.0; 3]; mean.len()]);
        Self {
            sum: none.clone(),
            unsettled: Default::default(),
            last_row: [mean.clone(), none.clone()],
            mean,
            before: state.reactions.clone(),
            settled: state.time,
            since_row: [none.clone(), none],
            row: state.time,
        }
    }

    /// Whether it has the given number of supports.
    pub fn fits(&self, supports: usize) -> bool {
        let pairs = self.since_row.iter().chain(&self.last_row);
        [&self.sum, &self.mean, &self.before].into_iter().chain(pairs).all(|v| v.len() == supports)
    }

    /// Mean reactions over the time before the row.
    pub fn mean(&self) -> &[[f64; 3]] {
        &self.last_row[0]
    }

    /// Impulses beyond them.
    pub fn impulses(&self) -> &[[f64; 3]] {
        &self.last_row[1]
    }

    /// Enters a part of a step.
    pub fn take(&mut self, part: &Accepted<'_>) {
        let (state, solved) = (part.after, part.solved);
        for (own, rigid) in self.unsettled.iter_mut().zip([false, true]) {
            if solved.reacts_by_impulses(rigid) {
                own.carries_impulses = true;
            } else {
                own.time += solved.trial.h;
            }
        }
        for (support, before) in state.reacting.list() {
            if !solved.reacts_by_impulses(part.model.supports[*support].rigid) {
                let now = &state.reactions[*support];
                (0..3).for_each(|i| self.sum[*support][i] += now[i] - before[i]);
            }
        }
    }

    /// Separates forces and impulses at the end of a step, or at an impact within it, and adds the impulses to the summary. The force is the mean
    /// over the parts in which reactions are forces; without such parts it is the previous one.
    pub fn settle(&mut self, model: &Model, state: &State, summary: &mut [SupportSummary]) {
        let since = state.time - self.settled;
        if since <= 0.0 {
            return;
        }
        let unsettled = std::mem::take(&mut self.unsettled);
        let [forces, impulses] = &mut self.since_row;
        for (k, support) in model.supports.iter().enumerate() {
            let Unsettled { time, carries_impulses } = unsettled[usize::from(support.rigid)];
            let (sum, mean) = (&mut self.sum[k], &mut self.mean[k]);
            if time > 0.0 {
                *mean = sum.map(|impulse| impulse / time);
                *sum = [0.0; 3];
            }
            let (now, before) = (&state.reactions[k], &self.before[k]);
            for i in 0..3 {
                forces[k][i] += since * mean[i];
                if carries_impulses {
                    let beyond = now[i] - before[i] - since * mean[i];
                    impulses[k][i] += beyond;
                    summary[k].impulse[i] += beyond;
                }
            }
        }
        self.before.clone_from(&state.reactions);
        self.settled = state.time;
    }

    /// Ends a row, with the values since the last one.
    pub fn close(&mut self) {
        let since = self.settled - self.row;
        let ([forces, impulses], [mean, beyond]) = (&mut self.since_row, &mut self.last_row);
        if since > 0.0 {
            for (mean, force) in mean.iter_mut().zip(forces.iter()) {
                *mean = force.map(|impulse| impulse / since);
            }
        }
        beyond.clone_from(impulses);
        forces.fill([0.0; 3]);
        impulses.fill([0.0; 3]);
        self.row = self.settled;
    }
}

/// Impulse and energy transferred by a projectile through its contacts.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Given {
    /// Impulse, shape (2) \[N s\].
    pub impulse: [f64; 2],
    /// Energy transferred by its contacts \[J\].
    pub work: f64,
    /// Work of the contacts on the others \[J\].
    pub received: f64,
}

impl Given {
    /// Enters a part of a step of the body at `node`.
    pub fn take(&mut self, node: usize, part: &Accepted<'_>) {
        let (work, h) = (part.work(), part.solved.trial.h);
        let d = &work.increment[node];
        let mut add = |row: &Row, impulse: f64| {
            if impulse == 0.0 {
                return;
            }
            let c = row.at(node);
            self.impulse[0] -= impulse * c[0];
            self.impulse[1] -= impulse * c[1];
            let own: f64 = (0..4).map(|i| c[i] * d[i]).sum();
            self.work -= impulse * own / h;
            if c != [0.0; 4] {
                self.received += impulse * row.on_some(&work.increment, |n| n != node) / h;
            }
        };
        for contact in &work.smooth {
            add(&contact.row, contact.force.force * h);
        }
        for contact in &work.rigid {
            add(&contact.normal, contact.impulse[0]);
            add(&contact.tangent, contact.impulse[1]);
        }
    }
}
