//! A place on an equilibrium path: its corrections, and the response to the loads there.

use super::goal::Goal;
use super::point::{PathPoint, PathRecorder};
use crate::analysis::ends::{finish, leans_on_stops};
use crate::analysis::lost::lost as lost_at;
use crate::analysis::stability::{Stability, stability};
use crate::analysis::static_contacts::{Pressing, Programme, Response};
use crate::analysis::static_search::{Motions, Reached, StaticSearch, largest};
use crate::error::Error;
use crate::model::Model;

/// Corrections of a point; more and the arc is halved. Contacts close and open one after the other.
pub(super) const MOST_ITERATIONS: usize = 16;
const MOST_WITH_CONTACTS: usize = 60;
/// A correction longer than this number of arcs (or first arcs) does not lead to a point of the branch.
const WILDEST: f64 = 20.0;
/// Last correction of a point relative to its displacements; the next would be its square.
pub(super) const SETTLED: f64 = 1e-9;
/// Displacements per load factor below this, in the measure of [`Tracer::inner`], are round-off: the path is followed by its load factor, from a
/// first arc of this length on.
const NOTHING: f64 = 1e-12;
const STILL_ARC: f64 = 0.01;
/// Last correction of a point where nothing moves, against the size of the structure.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
/// Share of the loads at which discs come to rest on their supports.
const LITTLE: f64 = 1e-4;

/// A place on the path.
#[derive(Clone)]
pub(super) struct Mark {
    pub factor: f64,
    pub reached: Reached,
    /// The last step along the path: increments of the nodal displacements, shape (nodes, 4) \[m, -\].
    pub way: Vec<[f64; 4]>,
    /// Active rigid contacts at its start, shape (places of contacts).
    pub pressed: Vec<bool>,
    /// Whether the load factor increased at the start of the last step.
    pub rising: bool,
    /// Change of the load factor in the last step, and whether it was prescribed.
    pub changed: f64,
    pub given: bool,
}

pub(super) struct Tracer<'m> {
    pub search: StaticSearch<'m>,
    /// The beams only.
    structure: Model,
    pub factor: f64,
    /// Rate of the load factor along the path where the last arc began.
    pub slope: f64,
    /// Load factor of the first arc, and that arc.
    pub first: f64,
    pub first_arc: f64,
    /// Arc for a unit of the load factor where the loads move nothing, as heat of a bar between walls; zero for other structures.
    pub still: f64,
    /// The arc that is tried.
    pub arc: f64,
    pub changed: f64,
    pub given: bool,
    /// The last step along the path: increments of the nodal displacements, shape (nodes, 4) \[m, -\].
    pub way: Vec<[f64; 4]>,
    /// Active rigid contacts at its start, shape (places of contacts).
    pub pressed: Vec<bool>,
    pub rising: bool,
    /// Response to the loads.
    pub response: Response,
}

impl<'m> Tracer<'m> {
    /// A structure whose loads all grow from zero.
    pub(super) fn new(model: &'m Model) -> Result<Self, Error> {
        let mut search = StaticSearch::new(model);
        search.motions = Motions::LeftOut;
        search.hold_loose_beams();
        search.foresee(true);
        // Springs may be stressed before any load acts.
        let stressed = model.connectors.iter().zip(&search.base.coordinates);
        if stressed.clone().any(|(c, q)| c.potential(*q, &search.base.memories) != 0.0) {
            search.solve(0.0);
        }
        // Discs rest on their supports, and stops that support a structure are closed, before the path is followed: the structure has no response
        // to the loads before.
        let settles = search.contacts.has_discs() || leans_on_stops(model);
        let start = search.reached();
        if settles && !search.solve(LITTLE) && !search.relax_from(&start, LITTLE) {
            let lost = search.contacts.lost(model).map(str::to_owned);
            return Err(lost.map_or_else(|| lost_at(&mut search, 0.0), Error::nothing_holds));
        }
        Ok(Self::at(search, if settles { LITTLE } else { 0.0 }))
    }

    /// A search at an equilibrium under a share of what grows.
    pub(super) fn at(search: StaticSearch<'m>, factor: f64) -> Self {
        let zero = vec![[0.0; 4]; search.model.node_count()];
        let pressed = search.contacts.pressing();
        let structure = search.model.structure();
        Self {
            search,
            structure,
            factor,
            slope: 0.0,
            first: 0.0,
            first_arc: 0.0,
            still: 0.0,
            arc: f64::INFINITY,
            changed: 0.0,
            given: false,
            way: zero.clone(),
            pressed,
            rising: true,
            response: Response::free(zero, Vec::new()),
        }
    }

    pub(super) fn point(&mut self) -> PathPoint {
        let stable = self.stability().stable;
        self.point_of(stable)
    }

    /// The point where its stability is known.
    pub(super) fn point_of(&self, stable: bool) -> PathPoint {
        let d = &self.search.work.increment;
        let displacements = self.search.model.points.iter().map(|p| p.value(d)).collect();
        PathPoint { factor: self.factor, displacements, stable }
    }

    /// Whether the current equilibrium is stable, under its current loads.
    pub(super) fn stability(&mut self) -> Stability {
        let here = self.mark();
        self.search.set_share(self.factor);
        let found = stability(&self.structure, &mut self.search);
        self.back_to(&here);
        found
    }

    /// Passes the equilibrium after the given number of steps to a recorder that requests it, and returns to it.
    pub(super) fn show(&mut self, recorder: &mut dyn PathRecorder, limit: bool, steps: usize) {
        if !recorder.wants(limit) {
            return;
        }
        let here = self.mark();
        self.search.set_share(self.factor);
        let found = finish(&mut self.search, steps);
        recorder.equilibrium(self.factor, limit, &found);
        self.back_to(&here);
    }

    pub(super) fn mark(&mut self) -> Mark {
        Mark {
            factor: self.factor,
            reached: self.search.reached(),
            way: self.way.clone(),
            pressed: self.pressed.clone(),
            rising: self.rising,
            changed: self.changed,
            given: self.given,
        }
    }

    pub(super) fn back_to(&mut self, mark: &Mark) {
        self.factor = mark.factor;
        self.search.go_back(&mark.reached);
        self.way.clone_from(&mark.way);
        self.pressed.clone_from(&mark.pressed);
        (self.rising, self.changed, self.given) = (mark.rising, mark.changed, mark.given);
    }

    /// Assembles at the current point; the load that a unit of the factor adds.
    pub(super) fn assemble(&mut self) -> Vec<[f64; 4]> {
        if let Some(row) = self.search.push.as_ref().map(|push| push.row) {
            self.search.set_share(self.factor);
            self.search.assemble::<true>();
            let mut load = vec![[0.0; 4]; self.search.model.node_count()];
            row.spread(1.0, &mut load);
            return load;
        }
        self.search.set_share(self.factor + 1.0);
        self.search.assemble::<false>();
        let loaded = self.search.work.residual.clone();
        self.search.set_share(self.factor);
        self.search.assemble::<true>();
        let added = |(a, b): (&[f64; 4], &[f64; 4])| std::array::from_fn(|i| a[i] - b[i]);
        self.search.work.residual.iter().zip(&loaded).map(added).collect()
    }

    /// Factors at the current point, with the contacts closed that press, and finds the response to the loads.
    pub(super) fn prepare(&mut self) -> bool {
        let load = self.assemble();
        if self.search.contacts.press_exactly() {
            return self
                .search
                .factor_pressed()
                .is_some_and(|closed| self.respond(&load, Some(&closed)));
        }
        self.search.factor_assembled().is_ok() && self.respond(&load, None)
    }

    /// The correction at the current point under the current loads, and the response to the loads.
    pub(super) fn direction(&mut self) -> bool {
        let load = self.assemble();
        if self.search.contacts.press_exactly() {
            return self.search.press().is_some_and(|closed| self.respond(&load, Some(&closed)));
        }
        let regular = self.search.factor_assembled().is_ok() && self.respond(&load, None);
        if regular {
            self.search.correction();
        }
        regular
    }

    /// The same with active contacts kept closed and no rigid contact closing.
    pub(super) fn direction_held(&mut self) -> bool {
        if !self.search.contacts.press_exactly() {
            return self.direction();
        }
        let load = self.assemble();
        self.search.hold_pressed().is_some_and(|closed| self.respond(&load, Some(&closed)))
    }

    /// Solves for the response of the last factored structure to a load; returns whether there is one.
    pub(super) fn respond(&mut self, load: &[[f64; 4]], closed: Option<&Programme>) -> bool {
        self.response = if let Some(closed) = closed {
            closed.response(&mut self.search, load)
        } else {
            let mut nodal = load.to_vec();
            let constraints = self.search.work.tangent.solve_linear(self.search.model, &mut nodal);
            Response::free(nodal, constraints)
        };
        self.response.nodal.as_flattened().iter().all(|c| c.is_finite())
    }

    /// Inner product of steps.
    pub(super) fn inner(&self, a: &[[f64; 4]], b: &[[f64; 4]]) -> f64 {
        self.search.alike(a, b)
    }

    /// The arc that leads to a load factor by the linear response: of the structure without its contacts, unless they are its only support.
    pub(super) fn first_arc(&mut self, factor: f64) -> Option<f64> {
        self.first = factor;
        self.search.contacts.begin(Pressing::Exactly);
        let load = self.assemble();
        let free = self.search.factor_assembled().is_ok() && self.respond(&load, None);
        let regular = free || self.prepare();
        let moved = self.inner(&self.response.nodal, &self.response.nodal).sqrt();
        // What nothing acts on has no path.
        if regular && moved <= NOTHING && !self.structure.loads.is_empty() {
            self.still = STILL_ARC / factor;
        }
        let arc = factor * moved.max(self.still);
        self.first_arc = arc;
        (regular && arc > 0.0).then_some(arc)
    }

    /// Moves by `share` of the response to the loads.
    pub(super) fn load(&mut self, share: f64) {
        self.factor += share;
        let work = &mut self.search.work;
        for (c, x) in work.correction.iter_mut().zip(&self.response.nodal) {
            (0..4).for_each(|i| c[i] += share * x[i]);
        }
        for (m, x) in work.multiplier.iter_mut().zip(&self.response.constraints) {
            *m += share * x;
        }
        self.search.contacts.respond(&self.response, share);
    }

    /// Corrections, each with the change of the load factor that `control` requires; `None` without one.
    pub(super) fn iterate(
        &mut self,
        control: impl Fn(&Self, &[[f64; 4]]) -> Option<f64>,
    ) -> Option<usize> {
        let alone = self.search.contacts.is_empty();
        for iteration in 1..=if alone { MOST_ITERATIONS } else { MOST_WITH_CONTACTS } {
            if !self.direction() {
                return None;
            }
            let share = control(self, &self.search.work.correction)?;
            self.load(share);
            let correction = &self.search.work.correction;
            let moved = self.inner(correction, correction).sqrt();
            if moved > WILDEST * self.arc.max(self.first_arc) || !self.search.correct() {
                return None;
            }
            let work = &self.search.work;
            let reach = largest(&work.increment);
            let floor = if self.still > 0.0 { ROUND_OFF * self.search.size() } else { 0.0 };
            let small = largest(&work.correction) <= floor.max(SETTLED * reach);
            if small && self.search.contacts.settled() {
                self.search.contacts.accept(self.search.model);
                return Some(iteration);
            }
        }
        None
    }

    /// Goes to the point at which the goal is reached exactly, from a point before it.
    pub(super) fn hit(&mut self, goal: &Goal) -> bool {
        match goal {
            Goal::Factor(factor) => {
                let miss = *factor;
                self.iterate(|tracer, _| Some(miss - tracer.factor)).is_some()
            }
            Goal::Displacement { point, component, value } => {
                let p = &self.search.model.points[*point];
                self.iterate(|tracer, correction| {
                    let now = p.value(&tracer.search.work.increment)[*component]
                        + p.value(correction)[*component];
                    Some((value - now) / p.value(&tracer.response.nodal)[*component])
                })
                .is_some()
            }
        }
    }
}
