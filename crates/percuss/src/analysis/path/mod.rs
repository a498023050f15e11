//! Equilibrium paths by arc length: past limit points, where load control ends.

mod advance;
mod tracer;
mod yielding;

use super::balance;
use super::static_search::StaticSearch;
use super::statics::{Equilibrium, finish, refuse_overlaps};
use super::yields::PathYield;
use crate::error::Error;
use crate::model::Model;
use crate::settings::{PathEnd, PathSettings};
use tracer::{Mark, Tracer};
use yielding::Yielded;

/// Corrections at which the arc stays as it is.
const WANTED_ITERATIONS: f64 = 5.0;
/// Most by which an arc is longer than that before.
const EASIEST: f64 = 1.5;
/// The arc is halved down to this share of the first before the path ends.
const SMALLEST_ARC: f64 = 1e-6;
/// The longest arc unless the first is longer, in the measure of [`Tracer::inner`]: moves of a twentieth of the structure, turns of a
/// twentieth of a radian.
const LONGEST_ARC: f64 = 0.05;

/// A point of an equilibrium path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathPoint {
    /// Factor on the loads that act at time zero.
    pub factor: f64,
    /// Displacements of the recorded points, in their order, shape (points, 2) \[m\].
    pub displacements: Vec<[f64; 2]>,
}

/// An equilibrium path.
#[derive(Clone, Debug)]
pub struct Path {
    /// Names of the recorded points, shape (recorded points).
    pub names: Vec<String>,
    /// Its points, from rest on, shape (points of the path).
    pub points: Vec<PathPoint>,
    /// Points where the load factor turns, in their order, shape (such points).
    pub limit_points: Vec<PathPoint>,
    /// First yields of springs and hinges, in their order, shape (springs and hinges that have yielded).
    pub yields: Vec<PathYield>,
    /// The equilibrium at its end.
    pub end: Equilibrium,
    /// Whether the end asked for was reached.
    pub reached: bool,
    /// What would fail next, where that ends the path: `joint.knee`, `spring.brace`, `beam.girder`.
    pub torn: Option<String>,
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
/// factor is first met. Where a joint of a given strength would carry more than that, the path ends before.
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
    let mut path = Path::begin(model, tracer.point());
    tracer.show(recorder, false, 0);
    let first = tracer.first_arc(settings.first).ok_or_else(|| Error::no_equilibrium(0.0))?;
    let (mut arc, longest) = (first, first.max(LONGEST_ARC));
    // The arc to go on with where one was cut.
    let mut whole = None;
    while path.points.len() <= settings.points {
        let before = tracer.mark();
        let advanced = tracer.advance(arc);
        // Where something would fail the path ends: it comes as near as arcs become short.
        path.torn = advanced.and_then(|_| tracer.search.first_beyond());
        let Some(iterations) = advanced.filter(|_| path.torn.is_none()) else {
            tracer.back_to(&before);
            arc *= 0.5;
            if arc < SMALLEST_ARC * first {
                break;
            }
            continue;
        };
        let factor_along_arc = tracer.factor_along_arc(&before);
        // Where the load factor turns, arcs are no longer than the first.
        if arc > first && (factor_along_arc.turned || !factor_along_arc.resolved) {
            tracer.back_to(&before);
            arc = (0.5 * arc).max(first);
            continue;
        }
        let yields = match tracer.yielded(&before, arc, first) {
            Yielded::Here(yields) => yields,
            Yielded::Before(shorter) => {
                tracer.back_to(&before);
                whole.get_or_insert(arc);
                arc = shorter;
                continue;
            }
        };
        if goal.passed(&before, &tracer) {
            if path.arrive(&mut tracer, &goal, &before, yields) {
                break;
            }
            arc *= 0.5;
            if arc < SMALLEST_ARC * first {
                break;
            }
            continue;
        }
        if factor_along_arc.turned {
            let after = tracer.mark();
            if let Some(point) = tracer.limit_point(&before, arc) {
                tracer.show(recorder, true, path.points.len());
                path.limit_points.push(point);
            }
            tracer.back_to(&after);
        }
        path.points.push(tracer.point());
        path.yields.extend(yields);
        tracer.show(recorder, false, path.points.len() - 1);
        let ease = (WANTED_ITERATIONS / iterations as f64).sqrt().clamp(0.5, EASIEST);
        // Contacts that close and open one after the other take corrections however short the arc.
        let ease = if tracer.given { EASIEST } else { ease };
        arc = (whole.take().unwrap_or(arc) * ease).min(longest);
    }
    if path.points.len() < 2 {
        return Err(Error::no_equilibrium(0.0));
    }
    let steps = path.points.len() - 1;
    tracer.search.set_share(tracer.factor);
    tracer.search.reached();
    path.end = finish(&mut tracer.search, steps);
    balance::check(&tracer.search, &path.end)?;
    Ok(path)
}

impl Path {
    /// One that has its first point.
    fn begin(model: &Model, first: PathPoint) -> Self {
        Self {
            names: model.points.iter().map(|p| p.label.clone()).collect(),
            points: vec![first],
            limit_points: Vec::new(),
            yields: Vec::new(),
            end: finish(&mut StaticSearch::new(model), 0),
            reached: false,
            torn: None,
        }
    }

    /// Ends at the goal, which lies between a mark and the point at hand; whether it is met there.
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
