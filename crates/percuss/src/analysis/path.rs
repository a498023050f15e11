//! Equilibrium paths by arc length: past limit points, where load control ends.

use super::static_contacts::{Pressing, Programme, Response};
use super::static_search::{Reached, StaticSearch};
use super::statics::{Equilibrium, finish, refuse_overlaps};
use crate::error::Error;
use crate::model::Model;
use crate::settings::{PathEnd, PathSettings};

/// Corrections of a point; more and the arc is halved. Contacts close and open one after the other.
const MOST_ITERATIONS: usize = 16;
const MOST_WITH_CONTACTS: usize = 60;
/// Corrections at which the arc stays as it is.
const WANTED_ITERATIONS: f64 = 5.0;
/// Most by which an arc is longer than that before.
const EASIEST: f64 = 1.5;
/// Looks for a limit point: to round-off.
const BISECTIONS: usize = 40;
/// Contacts that are tried as the next to close.
const MOST_TOUCHES: usize = 5;
/// Last correction of a point relative to its displacements; the next would be its square.
const SETTLED: f64 = 1e-9;
/// Share of the loads by which discs settle on what holds them.
const LITTLE: f64 = 1e-4;
/// The arc is halved down to this share of the first before the path ends.
const SMALLEST_ARC: f64 = 1e-6;
/// The longest arc unless the first is longer, in the measure of [`Tracer::inner`]: moves of a twentieth of the structure, turns of a
/// twentieth of a radian.
const LONGEST_ARC: f64 = 0.05;
/// Least cosine between the ways of two points an arc longer than the first apart; less and the path turns unseen between them.
const LEAST_COSINE: f64 = 0.9;
/// Least cosine between a plane's normal and the path that is sought on it: what closes may turn it.
const LEAST_ACROSS: f64 = 0.05;
/// Most by which a rise of the load factor is longer than that before, or than the first, where contacts press.
const LONGEST_RISE: f64 = 1.5;
/// Most that the load factor's slope at either end of such an arc exceeds the mean: beyond three it may turn twice between
/// (Fritsch, Carlson 1980).
const STEEPEST: f64 = 3.0;

/// A point of an equilibrium path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathPoint {
    /// Factor on the loads that act at time zero.
    pub factor: f64,
    /// Displacements of the recorded points \[m\], in their order.
    pub displacements: Vec<[f64; 2]>,
}

/// An equilibrium path.
#[derive(Clone, Debug)]
pub struct Path {
    /// Names of the recorded points.
    pub names: Vec<String>,
    /// Its points, from rest on.
    pub points: Vec<PathPoint>,
    /// Points where the load factor turns, in their order.
    pub limit_points: Vec<PathPoint>,
    /// The equilibrium at its end.
    pub end: Equilibrium,
    /// Whether the end asked for was reached.
    pub reached: bool,
}

/// Follows the equilibrium path of `model` under its loads, all growing with one factor, from rest.
///
/// Prescribed motions take no part. A path of [`PathEnd::Displacement`] ends exactly there, one of [`PathEnd::Factor`] where the
/// factor is first met.
///
/// # Errors
/// No point beyond the first found, or an end that names no recorded point.
pub fn equilibrium_path(model: &Model, settings: &PathSettings) -> Result<Path, Error> {
    refuse_overlaps(&StaticSearch::new(model))?;
    let goal = Goal::new(model, &settings.end).ok_or_else(|| Error::no_equilibrium(0.0))?;
    let mut tracer = Tracer::new(model)?;
    let mut path = Path {
        names: model.points.iter().map(|p| p.label.clone()).collect(),
        points: vec![tracer.point()],
        limit_points: Vec::new(),
        end: finish(&mut StaticSearch::new(model), 0),
        reached: false,
    };
    let first = tracer.first_arc(settings.first).ok_or_else(|| Error::no_equilibrium(0.0))?;
    let (mut arc, longest) = (first, first.max(LONGEST_ARC));
    while path.points.len() <= settings.points {
        let before = tracer.mark();
        let Some(iterations) = tracer.advance(arc) else {
            tracer.back_to(&before);
            arc *= 0.5;
            if arc < SMALLEST_ARC * first {
                break;
            }
            continue;
        };
        let course = tracer.course(&before);
        // Where the load factor turns, arcs are no longer than the first.
        if arc > first && (course.turned || !course.resolved) {
            tracer.back_to(&before);
            arc = (0.5 * arc).max(first);
            continue;
        }
        if goal.passed(&before, &tracer) {
            tracer.back_to(&before);
            path.reached = tracer.hit(&goal);
            if !path.reached {
                tracer.back_to(&before);
                arc *= 0.5;
                if arc < SMALLEST_ARC * first {
                    break;
                }
                continue;
            }
            path.points.push(tracer.point());
            break;
        }
        if course.turned {
            let after = tracer.mark();
            path.limit_points.extend(tracer.limit_point(&before, arc));
            tracer.back_to(&after);
        }
        path.points.push(tracer.point());
        let ease = (WANTED_ITERATIONS / iterations as f64).sqrt().clamp(0.5, EASIEST);
        // Contacts that close and open one after the other take corrections however short the arc.
        let ease = if tracer.given { EASIEST } else { ease };
        arc = (arc * ease).min(longest);
    }
    if path.points.len() < 2 {
        return Err(Error::no_equilibrium(0.0));
    }
    let steps = path.points.len() - 1;
    tracer.search.forcing.set_static(model, tracer.factor);
    path.end = finish(&mut tracer.search, steps);
    Ok(path)
}

/// What ends a path.
enum Goal {
    Factor(f64),
    Displacement { point: usize, component: usize, value: f64 },
}

impl Goal {
    fn new(model: &Model, end: &PathEnd) -> Option<Self> {
        Some(match end {
            PathEnd::Factor(factor) => Self::Factor(*factor),
            PathEnd::Displacement { point, component, value } => Self::Displacement {
                point: model.points.iter().position(|p| p.label == *point)?,
                component: component.checked_sub(1).filter(|c| *c < 2)?,
                value: *value,
            },
        })
    }

    fn passed(&self, before: &Mark, tracer: &Tracer) -> bool {
        let side = |value: f64, now: f64, then: f64| (now - value) * (then - value) <= 0.0;
        match self {
            Self::Factor(f) => side(*f, tracer.factor, before.factor),
            Self::Displacement { point, component, value } => {
                let at = |d: &[[f64; 4]]| tracer.search.model.points[*point].value(d)[*component];
                side(*value, at(&tracer.search.work.increment), at(&before.reached.increment))
            }
        }
    }
}

/// A place on the path.
#[derive(Clone)]
struct Mark {
    factor: f64,
    reached: Reached,
    /// The last way along the path, and the rigid contacts that pressed where it began.
    way: Vec<[f64; 4]>,
    pressed: Vec<bool>,
    /// Whether the load factor grew where the last way began.
    rising: bool,
    /// How far the last way changed the load factor, and whether it was given by that.
    changed: f64,
    given: bool,
}

/// Where an arc begins, and what its end is held against.
struct Departure {
    start: Mark,
    /// Rigid contacts that press there.
    pressed: Vec<bool>,
    /// The arc, the least that is gone unless something closes or opens, and the largest change of the load factor.
    arc: f64,
    least: f64,
    most: f64,
}

/// How the load factor went along an arc.
struct Course {
    /// Whether it turned: an odd number of times.
    turned: bool,
    /// Whether the arc tells it well enough for it not to have turned twice unseen.
    resolved: bool,
}

struct Tracer<'m> {
    search: StaticSearch<'m>,
    factor: f64,
    /// Rate of the load factor along the path where the last arc began.
    slope: f64,
    /// Load factor of the first arc, and that arc.
    first: f64,
    first_arc: f64,
    changed: f64,
    given: bool,
    way: Vec<[f64; 4]>,
    pressed: Vec<bool>,
    rising: bool,
    /// Response to the loads.
    response: Response,
}

impl<'m> Tracer<'m> {
    fn new(model: &'m Model) -> Result<Self, Error> {
        let mut search = StaticSearch::new(model);
        search.hold_loose_beams();
        search.foresee(true);
        // Springs may be stressed before any load acts.
        let stressed = model.connectors.iter().zip(&search.base.coordinates);
        if stressed.clone().any(|(c, q)| c.potential(*q) > 0.0) {
            search.solve(0.0);
        }
        // Discs lie on what holds them before the path is followed: nothing answers to their weight till then.
        if search.contacts.has_discs() && !search.solve(LITTLE) {
            let lost = search.contacts.lost(model).map(str::to_owned);
            return Err(lost.map_or(Error::no_equilibrium(0.0), Error::nothing_holds));
        }
        let zero = vec![[0.0; 4]; model.node_count()];
        let factor = if search.contacts.has_discs() { LITTLE } else { 0.0 };
        let pressed = search.contacts.pressing();
        Ok(Self {
            search,
            factor,
            slope: 0.0,
            first: 0.0,
            first_arc: 0.0,
            changed: 0.0,
            given: false,
            way: zero.clone(),
            pressed,
            rising: true,
            response: Response::free(zero, Vec::new()),
        })
    }

    fn point(&self) -> PathPoint {
        let d = &self.search.work.increment;
        let displacements = self.search.model.points.iter().map(|p| p.value(d)).collect();
        PathPoint { factor: self.factor, displacements }
    }

    fn mark(&self) -> Mark {
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

    fn back_to(&mut self, mark: &Mark) {
        self.factor = mark.factor;
        self.search.go_back(&mark.reached);
        self.way.clone_from(&mark.way);
        self.pressed.clone_from(&mark.pressed);
        (self.rising, self.changed, self.given) = (mark.rising, mark.changed, mark.given);
    }

    /// Assembles at the current point; the load that a unit of the factor adds.
    fn assemble(&mut self) -> Vec<[f64; 4]> {
        let model = self.search.model;
        self.search.forcing.set_static(model, self.factor + 1.0);
        self.search.forcing.rest_motions();
        self.search.assemble::<false>();
        let loaded = self.search.work.residual.clone();
        self.search.forcing.set_static(model, self.factor);
        self.search.forcing.rest_motions();
        self.search.assemble::<true>();
        let added = |(a, b): (&[f64; 4], &[f64; 4])| std::array::from_fn(|i| a[i] - b[i]);
        self.search.work.residual.iter().zip(&loaded).map(added).collect()
    }

    /// Factors at the current point, with the contacts closed that press, and finds the response to the loads.
    fn prepare(&mut self) -> bool {
        let load = self.assemble();
        if self.search.contacts.press_exactly() {
            return self
                .search
                .factor_pressed()
                .is_some_and(|closed| self.respond(&load, Some(&closed)));
        }
        self.search.factor_assembled().is_ok() && self.respond(&load, None)
    }

    /// The correction at the current point under the loads as they are, and the response to the loads beside it.
    fn direction(&mut self) -> bool {
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

    /// The response to a load of what was factored last; whether there is one.
    fn respond(&mut self, load: &[[f64; 4]], closed: Option<&Programme>) -> bool {
        self.response = if let Some(closed) = closed {
            closed.response(&mut self.search, load)
        } else {
            let mut nodal = load.to_vec();
            let constraints = self.search.work.tangent.solve_linear(self.search.model, &mut nodal);
            Response::free(nodal, constraints)
        };
        self.response.nodal.as_flattened().iter().all(|c| c.is_finite())
    }

    /// Inner product of ways: displacements over the size of the structure, slopes as they are, in the mean.
    fn inner(&self, a: &[[f64; 4]], b: &[[f64; 4]]) -> f64 {
        let size = self.search.size();
        let one = |(a, b): (&[f64; 4], &[f64; 4])| {
            (a[0] * b[0] + a[1] * b[1]) / (size * size) + a[2] * b[2] + a[3] * b[3]
        };
        a.iter().zip(b).map(one).sum::<f64>() / a.len() as f64
    }

    /// The arc that leads to a load factor by the linear response: of the structure without its contacts, unless they alone hold it.
    fn first_arc(&mut self, factor: f64) -> Option<f64> {
        self.first = factor;
        self.search.contacts.begin(Pressing::Exactly);
        let load = self.assemble();
        let free = self.search.factor_assembled().is_ok() && self.respond(&load, None);
        let regular = free || self.prepare();
        let arc = factor * self.inner(&self.response.nodal, &self.response.nodal).sqrt();
        self.first_arc = arc;
        (regular && arc > 0.0).then_some(arc)
    }

    /// Moves by `share` of the response to the loads.
    fn load(&mut self, share: f64) {
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

    /// Advances by an arc; returns the corrections it took, or nothing if it found no point.
    fn advance(&mut self, arc: f64) -> Option<usize> {
        self.search.contacts.begin(Pressing::Exactly);
        if !self.prepare() {
            return None;
        }
        let pressed = self.search.contacts.pressing();
        let first = self.way.as_flattened().iter().all(|c| *c == 0.0);
        self.rising = first || self.leads_up();
        let start = self.mark();
        let length = self.inner(&self.response.nodal, &self.response.nodal).sqrt();
        self.slope = 1.0 / length;
        // Held by contacts a structure hardly moves, and an arc is no measure of how far its load goes.
        let presses = pressed.contains(&true);
        let shorter = (arc / self.first_arc).min(1.0);
        let longest = LONGEST_RISE * self.changed.abs().max(self.first) * shorter;
        let most = if presses { longest } else { f64::INFINITY };
        let share = (arc / length).min(most);
        let rise = if self.rising { share } else { -share };
        let from = Departure { start, pressed, arc, least: 0.2 * share * length, most };
        if self.search.contacts.is_empty() {
            return self.by_plane(&from, rise);
        }
        if presses {
            return self.by_load(&from, rise).or_else(|| self.by_plane(&from, rise));
        }
        // What closes may turn the load; where nothing does, a change of the load leads back where the path came from.
        let found = self.by_plane(&from, rise);
        let found = found.or_else(|| self.by_touching(&from, rise));
        let found = found.or_else(|| self.by_closing(&from, rise));
        found.or_else(|| self.by_closing(&from, -rise))
    }

    /// Notes the way from a departure to the point found; whether it is one of the same branch: a point far behind or beyond the arc is
    /// not, but that what closes may well stop the way.
    fn arrive(&mut self, from: &Departure, by_load: bool) -> bool {
        let (end, start) = (&self.search.work.increment, &from.start.reached.increment);
        let moved = |(a, b): (&[f64; 4], &[f64; 4])| std::array::from_fn(|i| a[i] - b[i]);
        self.way = end.iter().zip(start).map(moved).collect();
        self.pressed.clone_from(&from.pressed);
        self.changed = self.factor - from.start.factor;
        self.given = by_load;
        let gone = self.inner(&self.way, &self.way).sqrt();
        let stopped = by_load || self.search.contacts.pressing() != self.pressed;
        (stopped || gone > from.least)
            && gone < 5.0 * from.arc
            && self.changed.abs() <= 1.01 * from.most
    }

    /// Advances by a rise of the load factor: where a contact closes the path may turn back on every plane.
    fn by_load(&mut self, from: &Departure, rise: f64) -> Option<usize> {
        self.back_to(&from.start);
        let target = self.factor + rise;
        let found = self.iterate(|tracer, _| Some(target - tracer.factor))?;
        self.arrive(from, true).then_some(found)
    }

    /// Advances to where the next contact closes, as far as a load that changes the way `rise` tells leads there.
    fn by_touching(&mut self, from: &Departure, rise: f64) -> Option<usize> {
        self.back_to(&from.start);
        let regular = self.prepare();
        let mut sought =
            self.search.contacts.next_to_close(&self.response, rise).filter(|_| regular)?;
        for _ in 0..MOST_TOUCHES {
            self.back_to(&from.start);
            let corrections = self.touch(sought)?;
            let Some(other) = self.search.contacts.innermost() else {
                self.search.contacts.close(sought);
                return self.arrive(from, false).then_some(corrections);
            };
            sought = other;
        }
        None
    }

    /// Goes to where an open contact just touches, the load factor free; what presses stays closed.
    fn touch(&mut self, place: usize) -> Option<usize> {
        for iteration in 1..=MOST_ITERATIONS {
            let load = self.assemble();
            let closed = self.search.hold_pressed()?;
            if !self.respond(&load, Some(&closed)) {
                return None;
            }
            let search = &self.search;
            let [gap, rate] =
                search.contacts.gap_after(place, &search.work.correction, &self.response);
            self.load(-gap / rate);
            if !self.search.correct() {
                return None;
            }
            let work = &self.search.work;
            let reach = super::static_search::largest(&work.increment);
            if super::static_search::largest(&work.correction) <= SETTLED * reach {
                self.assemble();
                self.search.contacts.accept();
                return Some(iteration);
            }
        }
        None
    }

    /// The same where that closes a contact: without it this may well be the way that the path came.
    fn by_closing(&mut self, from: &Departure, rise: f64) -> Option<usize> {
        let found = self.by_load(from, rise);
        found.filter(|_| self.search.contacts.pressing() != from.pressed)
    }

    /// Advances across the path: to the plane through the point that the response to a rise of the load factor leads to.
    fn by_plane(&mut self, from: &Departure, rise: f64) -> Option<usize> {
        self.back_to(&from.start);
        self.prepare();
        self.search.work.correction.fill([0.0; 4]);
        self.search.contacts.keep_forces();
        self.load(rise);
        let plane = self.search.work.correction.clone();
        let long = self.inner(&plane, &plane).sqrt();
        if !self.search.correct() {
            return None;
        }
        let found = self.iterate(|tracer, correction| {
            let response = &tracer.response.nodal;
            let across = tracer.inner(&plane, response);
            let straight = LEAST_ACROSS * long * tracer.inner(response, response).sqrt();
            // What runs along the plane never meets it, and what closes on the way to it may turn the path back from it.
            let back = across * rise < 0.0 && tracer.search.contacts.pressing() != from.pressed;
            (across.abs() > straight && !back).then(|| -tracer.inner(&plane, correction) / across)
        })?;
        self.arrive(from, false).then_some(found)
    }

    /// Whether the path goes on from the current point as the load factor rises: as it did where that was given, as contacts that
    /// have come to press since where the last way began press more, and as it came otherwise.
    fn leads_up(&self) -> bool {
        if self.given {
            return self.changed > 0.0;
        }
        let pressing = self.search.contacts.onward(&self.pressed, &self.response);
        pressing.unwrap_or_else(|| self.inner(&self.way, &self.response.nodal)) > 0.0
    }

    /// Corrections, each with the change of the load factor that `control` asks for; nothing where it knows none.
    fn iterate(&mut self, control: impl Fn(&Self, &[[f64; 4]]) -> Option<f64>) -> Option<usize> {
        let alone = self.search.contacts.is_empty();
        for iteration in 1..=if alone { MOST_ITERATIONS } else { MOST_WITH_CONTACTS } {
            if !self.direction() {
                return None;
            }
            let share = control(self, &self.search.work.correction)?;
            self.load(share);
            if !self.search.correct() {
                return None;
            }
            let work = &self.search.work;
            let reach = super::static_search::largest(&work.increment);
            let small = super::static_search::largest(&work.correction) <= SETTLED * reach;
            if small && self.search.contacts.settled() {
                self.search.contacts.accept();
                return Some(iteration);
            }
        }
        None
    }

    /// Goes to where the goal is met exactly, from a point before it.
    fn hit(&mut self, goal: &Goal) -> bool {
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

    /// How the load factor went on the way from a point to the current one.
    fn course(&mut self, before: &Mark) -> Course {
        let then = if self.rising { self.slope } else { -self.slope };
        let gone = self.inner(&self.way, &self.way).sqrt();
        let old = self.inner(&before.way, &before.way).sqrt();
        let along = self.inner(&before.way, &self.way);
        let Some(rises) = self.rises() else { return Course { turned: false, resolved: true } };
        let length = self.inner(&self.response.nodal, &self.response.nodal).sqrt();
        let now = if rises { 1.0 / length } else { -1.0 / length };
        let mean = (self.factor - before.factor) / gone;
        let turned = then * now < 0.0;
        let straight = old == 0.0 || along >= LEAST_COSINE * gone * old;
        let even = |slope: f64| slope / mean >= 0.0 && slope / mean <= STEEPEST;
        Course { turned, resolved: straight && (turned || (even(then) && even(now))) }
    }

    /// Whether the load factor grows along the path at the current point.
    fn rises(&mut self) -> Option<bool> {
        self.prepare().then(|| self.leads_up())
    }

    /// The limit point within an arc from a place before it, by bisection: of the points looked at the one of the most load, or the
    /// least.
    fn limit_point(&mut self, before: &Mark, arc: f64) -> Option<PathPoint> {
        let (mut low, mut high) = (0.0, arc);
        let rising = self.rising;
        let mut found: Option<PathPoint> = None;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            self.back_to(before);
            // An arc that leads nowhere is too long.
            let point = self.advance(middle).map(|_| self.point());
            let beyond = point.is_none() || self.rises()? != rising;
            if beyond {
                high = middle
            } else {
                low = middle
            }
            let further =
                |p: &PathPoint| found.as_ref().is_none_or(|f| (p.factor > f.factor) == rising);
            found = point.filter(further).or(found);
        }
        found
    }
}
