//! Equilibrium paths by arc length: past limit points, where load control ends.

mod advance;
mod failing;
mod goal;
mod point;
mod push;
mod tracer;
mod yielding;

use super::balance;
use super::ends::{finish, refuse_overlaps};
use super::equilibrium::Equilibrium;
use super::failure::StaticFailure;
use super::static_search::StaticSearch;
use super::yields::PathYield;
use crate::error::Error;
use crate::model::Model;
use crate::settings::PathSettings;
use goal::Goal;
pub use point::{PathPoint, PathRecorder};
pub(super) use push::{Effect, PushPlace, Pushed};
use tracer::{Mark, Tracer};
use yielding::Yielded;

/// Number of corrections at which the arc does not change.
const WANTED_ITERATIONS: f64 = 5.0;
/// Most by which an arc is longer than that before.
const EASIEST: f64 = 1.5;
/// The arc is halved down to this share of the first before the path ends.
const SMALLEST_ARC: f64 = 1e-6;
/// The longest arc unless the first is longer, in the measure of [`Tracer::inner`]: moves of a twentieth of the structure, turns of a
/// twentieth of a radian.
const LONGEST_ARC: f64 = 0.05;

/// An equilibrium path.
#[derive(Clone, Debug)]
pub struct Path {
    /// Names of the recorded points, shape (recorded points).
    pub names: Vec<String>,
    /// Its points, from rest on, shape (points of the path).
    pub points: Vec<PathPoint>,
    /// Points where the load factor turns, in their order, shape (such points).
    pub limit_points: Vec<PathPoint>,
    /// Points at which a motion loses or gains stiffness while the load factor continues, in their order, shape (such points): another path may
    /// branch off there.
    pub bifurcations: Vec<PathPoint>,
    /// Failures, in their order, shape (such failures).
    pub failures: Vec<StaticFailure>,
    /// First yields of springs and hinges, in their order, shape (springs and hinges that have yielded).
    pub yields: Vec<PathYield>,
    /// The equilibrium at its end.
    pub end: Equilibrium,
    /// Whether the requested end was reached.
    pub reached: bool,
    /// Part whose failure at the end of the path leaves no equilibrium: `joint.knee`, `spring.brace`, `beam.girder`.
    pub torn: Option<String>,
}

/// Requests no equilibria.
struct Nothing;

impl PathRecorder for Nothing {
    fn wants(&mut self, _: bool) -> bool {
        false
    }

    fn equilibrium(&mut self, _: f64, _: bool, _: &Equilibrium) {}
}

/// Follows the equilibrium path of `model` under its loads, all growing with one factor, from rest.
///
/// Prescribed motions are ignored. A path of [`PathEnd::Displacement`](crate::PathEnd::Displacement) ends exactly there, one of
/// [`PathEnd::Factor`](crate::PathEnd::Factor) where the factor is first reached. At a failure (fibres, springs, hinges, joints of a given
/// strength) an arc ends, and the forces of the failed part are released at this load factor, or at this displacement for a path to a displacement;
/// without an equilibrium the path ends.
///
/// # Errors
/// No point beyond the first found, or an end that names no recorded point.
pub fn equilibrium_path(model: &Model, settings: &PathSettings) -> Result<Path, Error> {
    equilibrium_path_recorded(model, settings, &mut Nothing)
}

/// The same, with a recorder for the equilibria of the path.
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
    let negative = tracer.stability().negative;
    let path = Path::begin(model, tracer.point());
    tracer.show(recorder, false, 0);
    let first = tracer.first_arc(settings.first).ok_or_else(|| Error::no_equilibrium(0.0))?;
    let longest = first.max(LONGEST_ARC);
    let mut way = Following {
        tracer,
        path,
        recorder,
        goal,
        first,
        arc: first,
        longest,
        whole: None,
        negative,
    };
    while way.path.points.len() <= settings.points && way.go_on() {}
    let Following { mut tracer, mut path, .. } = way;
    if path.points.len() < 2 {
        return Err(Error::no_equilibrium(0.0));
    }
    let steps = path.points.len() - 1;
    tracer.search.set_share(tracer.factor);
    tracer.search.reached();
    path.end = finish(&mut tracer.search, steps);
    balance::check(&tracer.search, &path.end.balance, &path.end.element_forces)?;
    path.end.failures.clone_from(&path.failures);
    path.end.stable = path.points.last().is_some_and(|point| point.stable);
    Ok(path)
}

/// State of a path.
struct Following<'m, 'r> {
    tracer: Tracer<'m>,
    path: Path,
    recorder: &'r mut dyn PathRecorder,
    goal: Goal,
    /// The first arc, the next one, the longest, and the one to continue with after a cut.
    first: f64,
    arc: f64,
    longest: f64,
    whole: Option<f64>,
    /// Motions without stiffness at the last point, if they were counted.
    negative: Option<usize>,
}

impl Following<'_, '_> {
    /// Advances by an arc, or finds it too long; returns whether the path continues.
    fn go_on(&mut self) -> bool {
        let (tracer, first) = (&mut self.tracer, self.first);
        let before = tracer.mark();
        let Some(iterations) = tracer.advance(self.arc) else {
            tracer.back_to(&before);
            return self.halve();
        };
        let along = tracer.factor_along_arc(&before);
        // At a limit point of the load factor, arcs are no longer than the first.
        if self.arc > first && (along.turned || !along.resolved) {
            tracer.back_to(&before);
            self.arc = (0.5 * self.arc).max(first);
            return true;
        }
        let yields = match tracer.yielded(&before, self.arc, first) {
            Yielded::Here(yields) => yields,
            Yielded::Before(shorter) => {
                tracer.back_to(&before);
                self.whole.get_or_insert(self.arc);
                self.arc = shorter;
                return true;
            }
        };
        let fails = tracer.search.largest_use() >= 1.0;
        if fails {
            let Some(arc) = tracer.locate_failure(&before, self.arc) else {
                tracer.back_to(&before);
                return self.halve();
            };
            self.whole.get_or_insert(self.arc);
            self.arc = arc;
        }
        if self.goal.passed(&before, &self.tracer) {
            let (path, tracer) = (&mut self.path, &mut self.tracer);
            return !path.arrive(tracer, &self.goal, &before, yields) && self.halve();
        }
        self.accept(&before, along.turned && !fails, yields);
        if fails && !self.fail() {
            return false;
        }
        let ease = (WANTED_ITERATIONS / iterations as f64).sqrt().clamp(0.5, EASIEST);
        // Contacts that close and open one after the other require corrections for any length of the arc.
        let ease = if self.tracer.given { EASIEST } else { ease };
        self.arc = (self.whole.take().unwrap_or(self.arc) * ease).min(self.longest);
        true
    }

    /// Halves the arc; whether one is left.
    fn halve(&mut self) -> bool {
        self.arc *= 0.5;
        self.arc >= SMALLEST_ARC * self.first
    }

    /// Records the point at the end of an arc, and the limit point or the bifurcation on it.
    fn accept(&mut self, before: &Mark, turned: bool, yields: Vec<PathYield>) {
        let Self { tracer, path, recorder, arc, .. } = self;
        let found = tracer.stability();
        let after = tracer.mark();
        if turned && let Some(point) = tracer.limit_point(before, *arc) {
            tracer.show(*recorder, true, path.points.len());
            path.limit_points.push(point);
        }
        // A limit point changes the stiffness against one motion.
        if let (Some(then), Some(now)) = (self.negative, found.negative)
            && then.abs_diff(now) > usize::from(turned)
        {
            path.bifurcations.push(tracer.bifurcation(before, *arc, then));
        }
        tracer.back_to(&after);
        self.negative = found.negative;
        path.points.push(tracer.point_of(found.stable));
        path.yields.extend(yields);
        tracer.show(*recorder, false, path.points.len() - 1);
    }

    /// Lets the part at its full strength fail; returns whether the path continues without it.
    fn fail(&mut self) -> bool {
        let Self { tracer, path, recorder, goal, .. } = self;
        let Some(failures) = tracer.fail(goal) else {
            tracer.search.set_share(tracer.factor);
            path.torn = tracer.search.first_to_fail();
            return false;
        };
        path.failures.extend(failures);
        let found = tracer.stability();
        self.negative = found.negative;
        path.points.push(tracer.point_of(found.stable));
        tracer.show(*recorder, false, path.points.len() - 1);
        true
    }
}

impl Path {
    /// One that has its first point.
    fn begin(model: &Model, first: PathPoint) -> Self {
        Self {
            names: model.points.iter().map(|p| p.label.clone()).collect(),
            points: vec![first],
            limit_points: Vec::new(),
            bifurcations: Vec::new(),
            failures: Vec::new(),
            yields: Vec::new(),
            end: finish(&mut StaticSearch::new(model), 0),
            reached: false,
            torn: None,
        }
    }

    /// Ends at the goal, which is between a mark and the current point; returns whether it is reached there.
    fn arrive(
        &mut self,
        tracer: &mut Tracer,
        goal: &Goal,
        before: &Mark,
        yields: Vec<PathYield>,
    ) -> bool {
        tracer.back_to(before);
        self.reached = tracer.hit(goal);
        if self.reached {
            self.points.push(tracer.point());
            self.yields.extend(yields.into_iter().filter(|one| tracer.has_yielded(one)));
        } else {
            tracer.back_to(before);
        }
        self.reached
    }
}

impl Goal {
    /// The controlled quantities at the current point of the path.
    fn here(&self, tracer: &Tracer) -> Self {
        match self {
            Self::Factor(_) => Self::Factor(tracer.factor),
            Self::Displacement { point, component, .. } => {
                let p = &tracer.search.model.points[*point];
                let value = p.value(&tracer.search.work.increment)[*component];
                Self::Displacement { point: *point, component: *component, value }
            }
        }
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
