//! Equilibrium paths by arc length: past limit points, where load control ends.

use super::static_contacts::Pressing;
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

/// Receives equilibria along a path, for drawings.
pub trait PathRecorder {
    /// Whether the equilibrium at a point reached is wanted; `limit` where the load factor turns there. Limit points come between
    /// the points before and after them.
    fn wants(&mut self, limit: bool) -> bool;

    /// Called with an equilibrium that is wanted, and the factor on its loads.
    fn equilibrium(&mut self, factor: f64, limit: bool, found: &Equilibrium);
}

/// Wants nothing.
struct Nothing;

impl PathRecorder for Nothing {
    fn wants(&mut self, _: bool) -> bool {
        false
    }

    fn equilibrium(&mut self, _: f64, _: bool, _: &Equilibrium) {}
}

/// Follows the equilibrium path of `model` under its loads, all growing with one factor, from rest.
///
/// Prescribed motions take no part. A path of [`PathEnd::Displacement`] ends exactly there, one of [`PathEnd::Factor`] where the
/// factor is first met.
///
/// # Errors
/// No point beyond the first found, or an end that names no recorded point.
pub fn equilibrium_path(model: &Model, settings: &PathSettings) -> Result<Path, Error> {
    equilibrium_path_recorded(model, settings, &mut Nothing)
}

/// The same, with the equilibria on the way for a recorder.
///
/// # Errors
/// As [`equilibrium_path`].
pub fn equilibrium_path_recorded(
    model: &Model,
    settings: &PathSettings,
    recorder: &mut dyn PathRecorder,
) -> Result<Path, Error> {
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
    tracer.show(recorder, false, 0);
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
            if let Some(point) = tracer.limit_point(&before, arc) {
                tracer.show(recorder, true, path.points.len());
                path.limit_points.push(point);
            }
            tracer.back_to(&after);
        }
        path.points.push(tracer.point());
        tracer.show(recorder, false, path.points.len() - 1);
        let ease = (WANTED_ITERATIONS / iterations as f64).sqrt().clamp(0.5, 1.5);
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
    /// The last way along the path.
    way: Vec<[f64; 4]>,
    /// Whether the load factor grew where the last way began.
    rising: bool,
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
    way: Vec<[f64; 4]>,
    rising: bool,
    /// Response to the loads, and of the multipliers.
    response: (Vec<[f64; 4]>, Vec<f64>),
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
        let multipliers = search.work.multiplier.clone();
        let factor = if search.contacts.has_discs() { LITTLE } else { 0.0 };
        Ok(Self {
            search,
            factor,
            slope: 0.0,
            way: zero.clone(),
            rising: true,
            response: (zero, multipliers),
        })
    }

    fn point(&self) -> PathPoint {
        let d = &self.search.work.increment;
        let displacements = self.search.model.points.iter().map(|p| p.value(d)).collect();
        PathPoint { factor: self.factor, displacements }
    }

    /// Hands the equilibrium reached after so many steps to a recorder that wants it, and comes back to it.
    fn show(&mut self, recorder: &mut dyn PathRecorder, limit: bool, steps: usize) {
        if !recorder.wants(limit) {
            return;
        }
        let here = self.mark();
        self.search.forcing.set_static(self.search.model, self.factor);
        self.search.forcing.rest_motions();
        let found = finish(&mut self.search, steps);
        recorder.equilibrium(self.factor, limit, &found);
        self.back_to(&here);
    }

    fn mark(&self) -> Mark {
        Mark {
            factor: self.factor,
            reached: self.search.reached(),
            way: self.way.clone(),
            rising: self.rising,
        }
    }

    fn back_to(&mut self, mark: &Mark) {
        self.factor = mark.factor;
        self.search.go_back(&mark.reached);
        self.way.clone_from(&mark.way);
        self.rising = mark.rising;
    }

    /// Factors at the current point and finds the response to the loads.
    fn prepare(&mut self) -> bool {
        let model = self.search.model;
        self.search.forcing.set_static(model, self.factor + 1.0);
        self.search.forcing.rest_motions();
        self.search.assemble::<false>();
        let loaded = self.search.work.residual.clone();
        self.search.forcing.set_static(model, self.factor);
        self.search.forcing.rest_motions();
        if !self.search.factor() {
            return false;
        }
        let residual = &self.search.work.residual;
        let (x, multipliers) = &mut self.response;
        for ((x, a), b) in x.iter_mut().zip(residual).zip(&loaded) {
            *x = std::array::from_fn(|i| a[i] - b[i]);
        }
        *multipliers = self.search.work.tangent.solve_linear(model, x);
        x.as_flattened().iter().all(|c| c.is_finite())
    }

    /// Inner product of ways: displacements over the size of the structure, slopes as they are, in the mean.
    fn inner(&self, a: &[[f64; 4]], b: &[[f64; 4]]) -> f64 {
        let size = self.search.size();
        let one = |(a, b): (&[f64; 4], &[f64; 4])| {
            (a[0] * b[0] + a[1] * b[1]) / (size * size) + a[2] * b[2] + a[3] * b[3]
        };
        a.iter().zip(b).map(one).sum::<f64>() / a.len() as f64
    }

    /// The arc that leads to a load factor by the linear response.
    fn first_arc(&mut self, factor: f64) -> Option<f64> {
        let regular = self.prepare();
        let arc = factor * self.inner(&self.response.0, &self.response.0).sqrt();
        (regular && arc > 0.0).then_some(arc)
    }

    /// Moves by `share` of the response to the loads.
    fn load(&mut self, share: f64) {
        self.factor += share;
        let work = &mut self.search.work;
        for (c, x) in work.correction.iter_mut().zip(&self.response.0) {
            (0..4).for_each(|i| c[i] += share * x[i]);
        }
        for (m, x) in work.multiplier.iter_mut().zip(&self.response.1) {
            *m += share * x;
        }
    }

    /// Advances by an arc; returns the corrections it took, or nothing if it found no point.
    fn advance(&mut self, arc: f64) -> Option<usize> {
        if !self.prepare() {
            return None;
        }
        self.search.contacts.begin(Pressing::Following);
        let start = self.search.work.increment.clone();
        let ahead = self.inner(&self.way, &self.response.0);
        let first = self.way.as_flattened().iter().all(|c| *c == 0.0);
        self.rising = first || ahead > 0.0;
        let length = self.inner(&self.response.0, &self.response.0).sqrt();
        self.slope = 1.0 / length;
        let share = if self.rising { arc / length } else { -arc / length };
        self.search.work.correction.fill([0.0; 4]);
        self.load(share);
        let plane = self.search.work.correction.clone();
        if !self.search.correct() {
            return None;
        }
        let iterations = self.iterate(|tracer, correction| {
            -tracer.inner(&plane, correction) / tracer.inner(&plane, &tracer.response.0)
        })?;
        let end = &self.search.work.increment;
        self.way =
            end.iter().zip(&start).map(|(a, b)| std::array::from_fn(|i| a[i] - b[i])).collect();
        // A point far behind or beyond the arc belongs to another branch.
        let gone = self.inner(&self.way, &self.way).sqrt();
        (gone > 0.2 * arc && gone < 5.0 * arc).then_some(iterations)
    }

    /// Corrections, each with the change of the load factor that `control` asks for.
    fn iterate(&mut self, control: impl Fn(&Self, &[[f64; 4]]) -> f64) -> Option<usize> {
        let alone = self.search.contacts.is_empty();
        for iteration in 1..=if alone { MOST_ITERATIONS } else { MOST_WITH_CONTACTS } {
            if !self.prepare() {
                return None;
            }
            self.search.correction();
            let share = control(self, &self.search.work.correction);
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
                self.iterate(|tracer, _| miss - tracer.factor).is_some()
            }
            Goal::Displacement { point, component, value } => {
                let p = &self.search.model.points[*point];
                self.iterate(|tracer, correction| {
                    let now = p.value(&tracer.search.work.increment)[*component]
                        + p.value(correction)[*component];
                    (value - now) / p.value(&tracer.response.0)[*component]
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
        let length = self.inner(&self.response.0, &self.response.0).sqrt();
        let now = if rises { 1.0 / length } else { -1.0 / length };
        let mean = (self.factor - before.factor) / gone;
        let turned = then * now < 0.0;
        let straight = old == 0.0 || along >= LEAST_COSINE * gone * old;
        let even = |slope: f64| slope / mean >= 0.0 && slope / mean <= STEEPEST;
        Course { turned, resolved: straight && (turned || (even(then) && even(now))) }
    }

    /// Whether the load factor grows along the path at the current point.
    fn rises(&mut self) -> Option<bool> {
        self.prepare().then(|| self.inner(&self.way, &self.response.0) > 0.0)
    }

    /// The limit point within an arc from a place before it, by bisection.
    fn limit_point(&mut self, before: &Mark, arc: f64) -> Option<PathPoint> {
        let (mut low, mut high) = (0.0, arc);
        let start = self.rising;
        let mut found = None;
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            self.back_to(before);
            self.advance(middle)?;
            found = Some(self.point());
            if self.rises()? == start { low = middle } else { high = middle }
        }
        found
    }
}
