//! What supports and striking bodies give: forces as means, impulses apart from them.

use serde::{Deserialize, Serialize};

use crate::geometry::row::Row;
use crate::model::Model;
use crate::state::State;
use crate::step::workspace::Workspace;
use crate::summary::SupportSummary;

/// A part of a step, by its length.
#[derive(Clone, Copy, Debug)]
pub(super) struct PartSize {
    /// Its length \[s\].
    pub h: f64,
    /// Whether it is as short as an impact.
    pub impulsive: bool,
    /// Whether contacts or jumps in it give impulses.
    pub carries_impulses: bool,
}

/// What supports gave since the last row: mean reactions, and impulses beyond them in impacts and jumps.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct RowReactions {
    /// Impulses and angular impulse of the parts that were not impulsive, shape (supports, 3) \[N s, N m s\].
    sum: Vec<[f64; 3]>,
    /// The time they took \[s\].
    time: f64,
    /// Whether a part was impulsive.
    carries_impulses: bool,
    /// Mean reactions over the time before the row, shape (supports, 3) \[N, N m\].
    mean: Vec<[f64; 3]>,
    /// Impulses beyond these since the last row, shape (supports, 3) \[N s, N m s\].
    impulses: Vec<[f64; 3]>,
    /// All that supports had given at the last row, shape (supports, 3) \[N s, N m s\].
    before: Vec<[f64; 3]>,
    /// When that was \[s\].
    row: f64,
    /// Reactions in the last part that was not impulsive in which a support gave anything, and that part's number, shape (supports, 3)
    /// \[N, N m, number of a part\].
    last: Vec<([f64; 3], u64)>,
    /// Number of such parts so far.
    part: u64,
}

impl RowReactions {
    /// Before the first row, with the reactions at the start.
    pub fn new(model: &Model, mean: Vec<[f64; 3]>) -> Self {
        let none = vec![[0.0; 3]; model.supports.len()];
        Self {
            sum: none.clone(),
            time: 0.0,
            carries_impulses: false,
            last: mean.iter().map(|r| (*r, 0)).collect(),
            mean,
            impulses: none.clone(),
            before: none,
            row: 0.0,
            part: 0,
        }
    }

    /// Whether it is one of so many supports.
    pub fn fits(&self, supports: usize) -> bool {
        let lengths = [
            self.sum.len(),
            self.mean.len(),
            self.impulses.len(),
            self.before.len(),
            self.last.len(),
        ];
        lengths.iter().all(|n| *n == supports)
    }

    /// Mean reactions over the time before the row.
    pub fn mean(&self) -> &[[f64; 3]] {
        &self.mean
    }

    /// Impulses beyond them.
    pub fn impulses(&self) -> &[[f64; 3]] {
        &self.impulses
    }

    /// Adds a part accepted last; impulses beyond the forces of the part before go to the summary.
    pub fn gather(&mut self, state: &State, part_size: &PartSize, summary: &mut [SupportSummary]) {
        let PartSize { h, impulsive, carries_impulses } = *part_size;
        if carries_impulses {
            self.carries_impulses = true;
        } else {
            self.time += h;
        }
        // Only parts longer than impacts tell forces: a gain over less is round-off or an impulse, many times magnified.
        self.part += u64::from(!impulsive);
        for (support, before) in state.reacting.list() {
            let now = &state.reactions[*support];
            let (mean, part) = &mut self.last[*support];
            for i in 0..3 {
                let gain = now[i] - before[i];
                if carries_impulses {
                    let force = if *part == self.part { mean[i] } else { 0.0 };
                    summary[*support].impulse[i] += gain - h * force;
                } else {
                    self.sum[*support][i] += gain;
                }
                if !impulsive {
                    mean[i] = gain / h;
                }
            }
            if !impulsive {
                *part = self.part;
            }
        }
    }

    /// Means and impulses since the last row; means of the row before if nothing but impacts lies between, and parts of a step of no more
    /// than `shortest` altogether, between which a mean force is an impulse in disguise. What they make together over the time since then
    /// is all that the supports gave.
    pub fn close(&mut self, state: &State, shortest: f64) {
        if self.time <= shortest {
            self.carries_impulses |= self.time > 0.0;
            self.sum.fill([0.0; 3]);
        } else {
            for (mean, sum) in self.mean.iter_mut().zip(&mut self.sum) {
                *mean = sum.map(|impulse| impulse / self.time);
                *sum = [0.0; 3];
            }
        }
        let since = state.time - self.row;
        for (k, impulse) in self.impulses.iter_mut().enumerate() {
            let (now, before, mean) = (&state.reactions[k], &self.before[k], &self.mean[k]);
            *impulse = std::array::from_fn(|i| {
                if self.carries_impulses { now[i] - before[i] - since * mean[i] } else { 0.0 }
            });
        }
        self.before.clone_from(&state.reactions);
        (self.time, self.row, self.carries_impulses) = (0.0, state.time, false);
    }
}

/// What a striking body gave to others through its contacts.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Given {
    /// Impulse, shape (2) \[N s\].
    pub impulse: [f64; 2],
    /// Energy that the contacts took from it \[J\].
    pub work: f64,
    /// Work of the contacts on the others \[J\].
    pub received: f64,
}

impl Given {
    /// Adds a step of size `h` of the body at `node`.
    pub fn gather(&mut self, work: &Workspace, node: usize, h: f64) {
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
