//! A force at a point that grows from zero on a structure under its loads: the force with a given bending moment or deflection.
//!
//! The force follows the equilibrium path by arc length, so that a limit point is seen where the force turns, and the path beyond is not taken for
//! the first one, as by an iteration at a given force that jumps there.

use super::tracer::{Mark, Tracer};
use crate::analysis::static_loading::Loading;
use crate::analysis::static_search::{Push, StaticSearch};
use crate::geometry::row::Row;
use crate::model::Model;
use crate::model::frozen::MaterialPoint;
use crate::summary::NoEquivalentForce;

/// The first arc, and the longest, in the measure of [`Tracer::inner`]: displacements of a thousandth and a twentieth of the structure.
const FIRST_ARC: f64 = 1e-3;
const LONGEST_ARC: f64 = 0.05;
/// Arcs tried before the search ends without a result, and the shortest, as a share of the first.
const MOST_ARCS: usize = 80;
const SHORTEST: f64 = 1e-4;
/// A predicted arc is longer by this share, to lead beyond what is sought.
const BEYOND: f64 = 1e-2;
/// Relative tolerance of what is sought, and the largest number of points on the last arc.
const FOUND: f64 = 1e-9;
const MOST_LOOKS: usize = 40;
/// The loads come up in steps of this share.
const LOAD_STEP: f64 = 0.1;

/// A force at a point of a beam.
pub(in crate::analysis) struct PushPlace<'a> {
    /// The point.
    pub point: &'a MaterialPoint,
    /// Direction of the force, of unit length, shape (2) \[-\].
    pub direction: [f64; 2],
}

/// What the force is to lead to.
#[derive(Clone, Copy, Debug)]
pub(in crate::analysis) enum Effect {
    /// Largest magnitude of the bending moment in the beam of the point \[N m\].
    Moment(f64),
    /// Displacement of the point along the direction of the force, from the reference configuration \[m\].
    Deflection(f64),
}

impl Effect {
    fn value(self) -> f64 {
        match self {
            Self::Moment(value) | Self::Deflection(value) => value,
        }
    }
}

/// A structure under its loads at time zero, and a force that grows beside them.
pub(in crate::analysis) struct Pushed<'m> {
    tracer: Tracer<'m>,
    /// Where and along which direction the force acts.
    place: PushPlace<'m>,
    start: Mark,
}

impl<'m> Pushed<'m> {
    /// The structure before the force acts: under its loads if they are borne, else in its reference configuration.
    pub fn new(model: &'m Model, place: PushPlace<'m>, borne: bool) -> Result<Self, &'static str> {
        let mut search = StaticSearch::new(model);
        search.foresee(true);
        if borne {
            let mut loading = Loading::new(&mut search, LOAD_STEP);
            loading.bring_up(model).map_err(|_| "the loads before it have no equilibrium")?;
            if !loading.failures.is_empty() {
                return Err("part of the structure fails under the loads before it");
            }
        } else if !search.springs_balance() {
            return Err("stressed springs move the structure from the start");
        }
        let [e1, e2] = place.direction;
        let [n0, n1, n2, n3] = place.point.shape;
        let mut row = Row::default();
        row.add(place.point.node, [n0 * e1, n0 * e2, n1 * e1, n1 * e2]);
        row.add(place.point.node + 1, [n2 * e1, n2 * e2, n3 * e1, n3 * e2]);
        search.push = Some(Push { row, force: 0.0 });
        let mut tracer = Tracer::at(search, 0.0);
        let start = tracer.mark();
        Ok(Self { tracer, place, start })
    }

    /// The largest moment in the beam of the point, and the displacement of the point, before the force acts \[N m, m\].
    pub fn before(&mut self) -> [f64; 2] {
        self.tracer.back_to(&self.start);
        [Effect::Moment(0.0), Effect::Deflection(0.0)].map(|effect| self.measure(effect))
    }

    /// The value of an effect at the current point of the path.
    fn measure(&mut self, of: Effect) -> f64 {
        let PushPlace { point, direction } = &self.place;
        let search = &mut self.tracer.search;
        match of {
            Effect::Deflection(_) => {
                let [x, y] = point.value(&search.displacement());
                direction[0] * x + direction[1] * y
            }
            Effect::Moment(_) => {
                search.set_share(self.tracer.factor);
                search.foresee(true);
                let state = search.state();
                search.section_forces(&state).beams[point.beam].moment.largest().value.abs()
            }
        }
    }

    /// The force that leads to an effect larger than that without it \[N\].
    pub fn force_of(&mut self, effect: Effect) -> Result<f64, NoEquivalentForce> {
        self.tracer.back_to(&self.start);
        let mut here = self.measure(effect);
        if effect.value() <= here {
            return Err(NoEquivalentForce::NoIncrease);
        }
        let first = self.first_arc().ok_or(NoEquivalentForce::NotSupported)?;
        let (mut arc, mut longest) = (first, LONGEST_ARC);
        for _ in 0..MOST_ARCS {
            let before = self.tracer.mark();
            if self.tracer.advance(arc).is_none() {
                self.tracer.back_to(&before);
                (arc, longest) = (0.5 * arc, 0.5 * arc);
                if arc < SHORTEST * first {
                    break;
                }
                continue;
            }
            let along = self.tracer.factor_along_arc(&before);
            if arc > first && (along.turned || !along.resolved) {
                self.tracer.back_to(&before);
                arc = (0.5 * arc).max(first);
                continue;
            }
            let fails = self.tracer.search.largest_use() >= 1.0;
            let there = self.measure(effect);
            let after = self.tracer.mark();
            if there >= effect.value()
                && let Some(force) = self.within(&before, arc, effect, here)
            {
                return force;
            }
            if along.turned || fails {
                return Err(self.ended(&before, arc, fails));
            }
            self.tracer.back_to(&after);
            let gone = self.tracer.inner(&after.way, &after.way).sqrt();
            let needed = (effect.value() - there) / (there - here) * gone * (1.0 + BEYOND);
            longest = (2.0 * longest).min(LONGEST_ARC);
            arc = if there > here { needed.min(longest) } else { longest };
            here = there;
        }
        Err(NoEquivalentForce::NotFound { force: self.tracer.factor })
    }

    /// The first arc, of a structure with a response to the force.
    fn first_arc(&mut self) -> Option<f64> {
        let regular = self.tracer.prepare();
        let response = &self.tracer.response.nodal;
        let unit = self.tracer.inner(response, response).sqrt();
        (regular && unit.is_finite() && unit > 0.0).then(|| {
            self.tracer.first_arc = FIRST_ARC;
            self.tracer.first = FIRST_ARC / unit;
            FIRST_ARC
        })
    }

    /// The force at which an effect is reached within an arc; `None` if that is beyond a failure or a limit point.
    fn within(
        &mut self,
        before: &Mark,
        arc: f64,
        effect: Effect,
        here: f64,
    ) -> Option<Result<f64, NoEquivalentForce>> {
        let sought = effect.value();
        let (mut low, mut high) = ([0.0, here - sought], [arc, self.measure(effect) - sought]);
        let mut last_low = None;
        for _ in 0..MOST_LOOKS {
            if high[1].abs() <= FOUND * sought.abs() {
                break;
            }
            let share = (low[1] / (low[1] - high[1])).clamp(1e-3, 1.0 - 1e-3);
            let middle = low[0] + share * (high[0] - low[0]);
            self.tracer.back_to(before);
            if self.tracer.advance(middle).is_none() {
                return Some(Err(NoEquivalentForce::NotFound { force: before.factor }));
            }
            let miss = self.measure(effect) - sought;
            if miss.abs() <= FOUND * sought.abs() {
                break;
            }
            // Regula falsi, with weights for an unchanged end (Illinois).
            let below = miss < 0.0;
            if below {
                low = [middle, miss];
                high[1] *= if last_low == Some(true) { 0.5 } else { 1.0 };
            } else {
                high = [middle, miss];
                low[1] *= if last_low == Some(false) { 0.5 } else { 1.0 };
            }
            last_low = Some(below);
        }
        if self.tracer.search.largest_use() >= 1.0 {
            return None;
        }
        if self.tracer.stability().stable {
            return Some(Ok(self.tracer.factor));
        }
        let along = self.tracer.factor_along_arc(before);
        (!along.turned).then_some(Err(NoEquivalentForce::Unstable))
    }

    /// Why the path does not lead beyond an arc: a part fails on it, or the force turns.
    fn ended(&mut self, before: &Mark, arc: f64, fails: bool) -> NoEquivalentForce {
        if fails {
            let found = self.tracer.locate_failure(before, arc);
            let force = if found.is_some() { self.tracer.factor } else { before.factor };
            return NoEquivalentForce::Fails { force };
        }
        let top = self.tracer.limit_point(before, arc).map_or(before.factor, |p| p.factor);
        NoEquivalentForce::LimitPoint { force: top }
    }
}
