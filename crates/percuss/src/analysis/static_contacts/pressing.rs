//! Which rigid contacts of a structure carry a load, and how much: a quadratic programme in each of Newton's corrections.
//!
//! About a configuration with residual r, tangent K, gaps g and their gradients G the correction d is the minimiser of `1/2 d.K d + r.d` with `g +
//! G d >= 0`. Several candidates of an element may be closer than its shape functions resolve: forces of neighbours are then not unique, and
//! neither is the dual solution of the programme. The proximal method of multipliers (Rockafellar 1976) does not need uniqueness: about multipliers
//! m it minimises `1/2 d.K d + r.d + sum max(0, m - k (g + G d))^2 / 2k` and sets `m = max(0, m - k (g + G d))`, until gaps are zero. Each of these
//! functions is convex and piecewise quadratic if K is positive: Newton's method with an exact line search finds the closed set in finitely many
//! steps, for any number of contacts that open and close in one.

mod closed;

use super::super::static_search::{StaticSearch, largest};
use super::StaticContacts;
use super::place::{CandidatePair, moving};
use crate::geometry::row::Row;
use crate::model::Model;
use crate::step::contacts::add_tangent;
use crate::step::tangent::Tangent;

/// Changes of the closed set about the same multipliers, and changes of multipliers, of one correction.
const MOST_SETS: usize = 200;
const MOST_ROUNDS: usize = 40;
/// Gaps below the first share of the largest coordinate are zero; remaining gaps after a correction below the second one are accepted. A gap that
/// opens and closes by round-off would change the forces of neighbours by far more.
const ZERO_GAP: f64 = 16.0 * f64::EPSILON;
const ROUND_OFF: f64 = 2.0 * f64::EPSILON;
/// Forces below this share of the largest come and go by round-off.
const ROUND_OFF_OF_FORCES: f64 = 1e-13;
/// How deep a compliant contact that just touches is pressed in, as a share of the largest coordinate.
const TOUCHING: f64 = 1e-9;
/// Gaps that a correction may leave, as a share of the largest move: the next is smaller by itself.
const INEXACT: f64 = 1e-7;
/// The same of a response to a load.
const STILL: f64 = 1e-12;
/// Halvings of the interval in a line search: to round-off.
const HALVINGS: usize = 52;

/// The rigid contacts about a configuration.
pub struct Programme {
    /// Places of [`StaticContacts`], shape (contacts) \[index of a place\].
    places: Vec<usize>,
    /// Gradients of their gaps on the nodes that move, shape (contacts).
    rows: Vec<Row>,
    /// Their gaps, shape (contacts) \[m\].
    gaps: Vec<f64>,
    /// Stiffnesses with which gaps are weighed, shape (contacts) \[N/m\].
    stiffness: Vec<f64>,
    /// Multipliers about which forces are sought, shape (contacts) \[N\].
    multipliers: Vec<f64>,
    /// Which contacts are closed in the tangent factored last, shape (contacts).
    closed: Vec<bool>,
}

/// A correction, with the forces it is in equilibrium with: of either sign where closed.
#[derive(Clone)]
struct Balanced {
    /// The correction of the nodal values, shape (nodes, 4) \[m, -\].
    correction: Vec<[f64; 4]>,
    /// Forces of the contacts, shape (contacts) \[N\].
    forces: Vec<f64>,
    /// Gaps it leads to, shape (contacts) \[m\].
    gaps: Vec<f64>,
    /// Multipliers of the constraints, shape (constraints) \[N, N m\].
    constraints: Vec<f64>,
}

/// Constant data of a search during a correction.
struct Linear {
    tangent: Tangent,
    /// Unbalanced forces without those of the contacts, shape (nodes, 4) \[N, N m\].
    residual: Vec<[f64; 4]>,
    /// Multipliers of the constraints, shape (constraints) \[N, N m\].
    constraints: Vec<f64>,
}

impl StaticSearch<'_> {
    /// The correction for the assembled tangent and its rigid contacts, with the contacts that are closed after it; `None` for a singular tangent.
    pub fn press(&mut self) -> Option<Programme> {
        let mut programme = Programme::new(self.model, &self.contacts);
        let mut linear = self.linear();
        programme.spread(&programme.multipliers, &mut linear.residual);
        let found = programme.solve(self, &linear)?;
        self.work.correction.copy_from_slice(&found.correction);
        self.work.multiplier.copy_from_slice(&found.constraints);
        self.contacts.take(&programme);
        Some(programme)
    }

    /// The correction while the contacts that press stay closed and no other closes.
    pub fn hold_pressed(&mut self) -> Option<Programme> {
        let mut programme = Programme::new(self.model, &self.contacts);
        let mut linear = self.linear();
        programme.spread(&programme.multipliers, &mut linear.residual);
        let found = programme.solve_held(self, &linear)?;
        self.work.correction.copy_from_slice(&found.correction);
        self.work.multiplier.copy_from_slice(&found.constraints);
        self.contacts.take(&programme);
        Some(programme)
    }

    /// Factors the assembled tangent with the active rigid contacts closed; `None` if it is singular.
    pub fn factor_pressed(&mut self) -> Option<Programme> {
        let programme = Programme::new(self.model, &self.contacts);
        let linear = self.linear();
        programme.factor(self, &linear)?;
        Some(programme)
    }

    fn linear(&self) -> Linear {
        Linear {
            tangent: self.work.tangent.clone(),
            residual: self.work.residual.clone(),
            constraints: self.work.multiplier.clone(),
        }
    }
}

impl Programme {
    fn new(model: &Model, contacts: &StaticContacts) -> Self {
        let near = |p: &&CandidatePair| p.is_exact && p.gap.is_finite();
        let all = || contacts.places.iter().filter(near);
        let round_off = ZERO_GAP * contacts.size;
        let gap = |p: &CandidatePair| if p.gap.abs() <= round_off { 0.0 } else { p.gap };
        let numbers = contacts.places.iter().enumerate().filter(|(_, p)| near(p));
        Self {
            places: numbers.map(|(i, _)| i).collect(),
            rows: all().map(|p| moving(model, &p.row)).collect(),
            gaps: all().map(gap).collect(),
            stiffness: all().map(|p| p.stiffnesses[1]).collect(),
            multipliers: all().map(|p| p.multiplier).collect(),
            closed: all().map(|p| p.multiplier > 0.0).collect(),
        }
    }

    /// Adds forces along the gradients of their gaps.
    fn spread(&self, forces: &[f64], nodal: &mut [[f64; 4]]) {
        for (row, force) in self.rows.iter().zip(forces).filter(|(_, f)| **f != 0.0) {
            row.spread(*force, nodal);
        }
    }

    /// Forces about the multipliers where the gaps are those given; negative where the contact is open.
    fn trial(&self, gaps: &[f64]) -> Vec<f64> {
        let each = self.multipliers.iter().zip(&self.stiffness).zip(gaps);
        each.map(|((m, k), g)| m - k * g).collect()
    }

    fn solve(&mut self, search: &mut StaticSearch, linear: &Linear) -> Option<Balanced> {
        let mut at: Option<Balanced> = None;
        let mut factored = false;
        for _ in 0..MOST_ROUNDS {
            for _ in 0..MOST_SETS {
                if let Some(at) = &at {
                    factored &= !self.flip(&self.trial(&at.gaps));
                }
                if !factored {
                    self.factor(search, linear)?;
                    factored = true;
                }
                let full = self.balance(search, linear);
                let Some(from) = &at else {
                    at = Some(full);
                    continue;
                };
                let share = self.share(from, &full);
                let reached = from.toward(&full, share);
                let trial = self.trial(&reached.gaps);
                at = Some(reached);
                if share == 1.0 && !self.would_flip(&trial) {
                    break;
                }
            }
            let reached = at.as_ref()?;
            let forces = self.trial(&reached.gaps);
            self.multipliers = forces.iter().map(|f| f.max(0.0)).collect();
            let most = largest(&reached.correction);
            let left = |(k, g): (usize, &f64)| if self.closed[k] { g.abs() } else { (-g).max(0.0) };
            let left = reached.gaps.iter().enumerate().map(left).fold(0.0, f64::max);
            let none = ROUND_OFF * search.contacts.size;
            if !most.is_finite() {
                return None;
            }
            if left <= none.max(INEXACT * most) {
                break;
            }
        }
        at
    }

    /// The response of the last factored structure to a nodal load, with closed contacts kept closed: multipliers are updated until the closed gaps
    /// do not change.
    pub fn response(&self, search: &mut StaticSearch, load: &[[f64; 4]]) -> Response {
        let mut forces = vec![0.0; self.rows.len()];
        let mut nodal = Vec::new();
        let mut constraints = Vec::new();
        for _ in 0..MOST_ROUNDS {
            nodal = load.to_vec();
            self.spread(&forces, &mut nodal);
            constraints = search.work.tangent.solve_linear(search.model, &mut nodal);
            let mut left = 0.0_f64;
            for k in (0..self.rows.len()).filter(|k| self.closed[*k]) {
                let moved = self.rows[k].on(&nodal);
                forces[k] -= self.stiffness[k] * moved;
                left = left.max(moved.abs());
            }
            if left.is_nan() || left <= STILL * largest(&nodal) {
                break;
            }
        }
        let contacts = self.places.iter().copied().zip(forces).filter(|(_, f)| *f != 0.0);
        Response { nodal, constraints, contacts: contacts.collect() }
    }

    /// The correction on the closed set as it is.
    fn solve_held(&mut self, search: &mut StaticSearch, linear: &Linear) -> Option<Balanced> {
        self.factor(search, linear)?;
        let mut found = self.balance(search, linear);
        for _ in 0..MOST_ROUNDS {
            let closed = |(k, f): (usize, f64)| if self.closed[k] { f } else { 0.0 };
            self.multipliers =
                self.trial(&found.gaps).into_iter().enumerate().map(closed).collect();
            let gaps = found.gaps.iter().zip(&self.closed).filter(|(_, c)| **c);
            let left = gaps.map(|(g, _)| g.abs()).fold(0.0, f64::max);
            let none = ROUND_OFF * search.contacts.size;
            if left <= none.max(INEXACT * largest(&found.correction)) {
                break;
            }
            found = self.balance(search, linear);
        }
        largest(&found.correction).is_finite().then_some(found)
    }

    fn would_flip(&self, trial: &[f64]) -> bool {
        let most = trial.iter().fold(0.0_f64, |m, f| m.max(*f));
        let flips = |(f, closed): (&f64, &bool)| {
            (*f > 0.0) != *closed && f.abs() > ROUND_OFF_OF_FORCES * most
        };
        trial.iter().zip(&self.closed).any(flips)
    }

    /// Closes contacts under pressure and opens contacts under tension; returns whether any changed.
    fn flip(&mut self, trial: &[f64]) -> bool {
        let flips = self.would_flip(trial);
        if flips {
            self.closed = trial.iter().map(|f| *f > 0.0).collect();
        }
        flips
    }

    fn factor(&self, search: &mut StaticSearch, linear: &Linear) -> Option<()> {
        search.work.tangent.clone_from(&linear.tangent);
        let closed = self.rows.iter().zip(&self.stiffness).zip(&self.closed).filter(|(_, c)| **c);
        for ((row, stiffness), _) in closed {
            add_tangent(&mut search.work.tangent, row, row, *stiffness, 0.0, None);
        }
        search.factor_assembled().ok()
    }

    /// The correction on the closed set factored last.
    fn balance(&self, search: &mut StaticSearch, linear: &Linear) -> Balanced {
        let closed = |k: usize, force: f64| if self.closed[k] { force } else { 0.0 };
        let start: Vec<f64> =
            self.trial(&self.gaps).iter().enumerate().map(|(k, f)| closed(k, *f)).collect();
        search.work.residual.copy_from_slice(&linear.residual);
        let pushed: Vec<f64> = start.iter().map(|f| -f).collect();
        self.spread(&pushed, &mut search.work.residual);
        search.work.multiplier.copy_from_slice(&linear.constraints);
        search.correction();
        let correction = search.work.correction.clone();
        let moved = self.rows.iter().map(|row| row.on(&correction));
        let gaps: Vec<f64> = self.gaps.iter().zip(moved).map(|(g, moved)| g + moved).collect();
        let forces = self.trial(&gaps).iter().enumerate().map(|(k, f)| closed(k, *f)).collect();
        Balanced { correction, forces, gaps, constraints: search.work.multiplier.clone() }
    }

    /// The share of the way to another correction after which the function of the programme is least.
    ///
    /// Its slope is that of the structure, whose unbalanced forces at either end are the forces of the contacts there, less that of
    /// the contacts.
    fn share(&self, from: &Balanced, to: &Balanced) -> f64 {
        let slope = |share: f64| {
            let mut sum = 0.0;
            for k in 0..self.places.len() {
                let moved = to.gaps[k] - from.gaps[k];
                let gap = from.gaps[k] + share * moved;
                let balanced = from.forces[k] + share * (to.forces[k] - from.forces[k]);
                let pressed = self.multipliers[k] - self.stiffness[k] * gap;
                sum += (balanced - pressed.max(0.0)) * moved;
            }
            sum
        };
        // Ascent from the start for a tangent that is not positive: there is no minimum.
        if slope(1.0) <= 0.0 || slope(0.0) >= 0.0 {
            return 1.0;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if slope(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }
}

impl Balanced {
    fn toward(&self, other: &Self, share: f64) -> Self {
        if share == 1.0 {
            return other.clone();
        }
        let mix = |a: &f64, b: &f64| a + share * (b - a);
        let each = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| mix(a, b)).collect();
        let nodal = self.correction.iter().zip(&other.correction);
        Self {
            correction: nodal.map(|(a, b)| std::array::from_fn(|i| mix(&a[i], &b[i]))).collect(),
            forces: each(&self.forces, &other.forces),
            gaps: each(&self.gaps, &other.gaps),
            constraints: each(&self.constraints, &other.constraints),
        }
    }
}

/// Response of a structure to a load with constant closed contacts.
#[derive(Clone, Debug, Default)]
pub struct Response {
    /// Displacements, shape (nodes, 4) \[m, -\].
    pub nodal: Vec<[f64; 4]>,
    /// Forces of constraints, shape (constraints) \[N, N m\].
    pub constraints: Vec<f64>,
    /// Forces of rigid contacts, by place, shape (rigid contacts near) \[index of a place, N\].
    pub(super) contacts: Vec<(usize, f64)>,
}

impl Response {
    /// The response of a structure without rigid contacts that corrections find.
    pub fn free(nodal: Vec<[f64; 4]>, constraints: Vec<f64>) -> Self {
        Self { nodal, constraints, contacts: Vec::new() }
    }
}
