//! From one point of an equilibrium path to the next.
//!
//! The continuation constraint is a plane through the point predicted by the response to the loads, or the load factor with active contacts, which
//! constrain a structure so that an arc is no measure; it leads up to the next contact if that closes in between, since a closing contact may turn
//! the path back on any plane. From there the path continues with growing contact force.

use super::PathPoint;
use super::tracer::{MOST_ITERATIONS, Mark, SETTLED, Tracer};
use crate::analysis::static_contacts::Pressing;
use crate::analysis::static_search::largest;

/// Search for a limit point, to round-off.
const BISECTIONS: usize = 40;
/// Search for a bifurcation.
const BISECTIONS_OF_STABILITY: usize = 30;
/// Contacts that are tried as the next to close.
const MOST_TOUCHES: usize = 5;
/// Least cosine between the directions of two points an arc longer than the first apart; below it the path may turn unnoticed between them.
const LEAST_COSINE: f64 = 0.9;
/// Least cosine between a plane's normal and the path: closing contacts may turn it.
const LEAST_ACROSS: f64 = 0.05;
/// Displacements per load factor, in the measure of [`Tracer::inner`], below which a structure that the loads did not move at first is still: round-off
/// grows towards a bifurcation.
const STILL: f64 = 1e-6;
/// Distance beyond a change of stiffness at which a path continues, as a share of the change of the load factor there.
const KINK: f64 = 1e-6;
/// Most by which a rise of the load factor is longer than that before, or than the first, where contacts press.
const LONGEST_RISE: f64 = 1.5;
/// Most that the load factor's slope at either end of such an arc exceeds the mean: beyond three it may turn twice between
/// (Fritsch, Carlson 1980).
const STEEPEST: f64 = 3.0;

/// Start of an arc, with which its end is compared.
struct Departure {
    start: Mark,
    /// Whether each place of the contacts, in their order, is rigid and presses there, shape (places).
    pressed: Vec<bool>,
    /// The arc, its least length unless a contact closes or opens, and the largest change of the load factor.
    arc: f64,
    least: f64,
    most: f64,
}

/// Change of the load factor along an arc.
pub(super) struct FactorAlongArc {
    /// Whether it turned: an odd number of times.
    pub turned: bool,
    /// Whether the arc represents it well enough to exclude two unnoticed turns.
    pub resolved: bool,
}

impl Tracer<'_> {
    /// Advances by an arc; returns the number of corrections, or `None` if no point was found.
    pub(super) fn advance(&mut self, arc: f64) -> Option<usize> {
        self.arc = arc;
        self.search.contacts.begin(Pressing::Exactly);
        if !self.prepare() {
            return None;
        }
        let pressed = self.search.contacts.pressing();
        let first = self.way.as_flattened().iter().all(|c| *c == 0.0);
        self.rising = first || self.leads_up();
        let start = self.mark();
        let moved = self.inner(&self.response.nodal, &self.response.nodal).sqrt();
        let is_still = self.still > 0.0 && moved < STILL;
        let length = if is_still { self.still } else { moved };
        self.slope = 1.0 / length;
        // A structure constrained by contacts hardly moves, and an arc is no measure of its load.
        let presses = pressed.contains(&true);
        let shorter = (arc / self.first_arc).min(1.0);
        let longest = LONGEST_RISE * self.changed.abs().max(self.first) * shorter;
        let most = if presses { longest } else { f64::INFINITY };
        let share = (arc / length).min(most);
        let rise = if self.rising { share } else { -share };
        let from = Departure { start, pressed, arc, least: 0.2 * share * length, most };
        if is_still {
            return self.by_load(&from, rise);
        }
        if self.search.contacts.is_empty() {
            return self.by_plane(&from, rise).or_else(|| self.by_kink(&from, rise));
        }
        if presses {
            return self.by_load(&from, rise).or_else(|| self.by_plane(&from, rise));
        }
        // Closing contacts may reverse the load; otherwise a change of the load leads back along the path.
        let found = self.by_plane(&from, rise);
        let found = found.or_else(|| self.by_touching(&from, rise));
        let found = found.or_else(|| self.by_closing(&from, rise));
        found.or_else(|| self.by_closing(&from, -rise))
    }

    /// Records the way from a departure to the point found; whether it is on the same branch: a point far behind or beyond the arc is not, except
    /// that closing contacts may stop the way.
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

    /// Advances to the closing of the next contact, as far as a load that changes in the direction `rise` leads there.
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

    /// Goes to the point at which an open contact touches, with a free load factor; active contacts stay closed.
    fn touch(&mut self, place: usize) -> Option<usize> {
        for iteration in 1..=MOST_ITERATIONS {
            if !self.direction_held() {
                return None;
            }
            let search = &self.search;
            let [gap, rate] =
                search.contacts.gap_after(place, &search.work.correction, &self.response);
            self.load((search.contacts.touching(place) - gap) / rate);
            if !self.search.correct() {
                return None;
            }
            let work = &self.search.work;
            let reach = largest(&work.increment);
            if largest(&work.correction) <= SETTLED * reach {
                self.assemble();
                self.search.contacts.accept(self.search.model);
                return Some(iteration);
            }
        }
        None
    }

    /// Advances to just beyond the first change of the stiffness of a connector on the way of a load that changes by `rise`: there the path may
    /// bend so much that no plane ahead intersects it.
    fn by_kink(&mut self, from: &Departure, rise: f64) -> Option<usize> {
        self.by_load(from, rise)?;
        if !self.has_bent(&from.start) {
            return None;
        }
        let (mut low, mut high) = (0.0, 1.0);
        while high - low > KINK * high {
            let middle = 0.5 * (low + high);
            if self.by_load(from, middle * rise).is_some() && !self.has_bent(&from.start) {
                low = middle;
            } else {
                high = middle;
            }
        }
        for _ in 0..MOST_TOUCHES {
            if let Some(found) = self.by_load(from, high * rise)
                && self.has_bent(&from.start)
            {
                return Some(found);
            }
            high *= 1.0 + KINK;
        }
        None
    }

    /// Whether the stiffness of a connector differs from that at a mark, or one has begun to yield since.
    fn has_bent(&mut self, mark: &Mark) -> bool {
        let now = self.search.reached();
        let search = &self.search;
        let [then, here] = [&mark.reached.increment, &now.increment].map(|increment| {
            let both = search.base.displacement.iter().zip(increment);
            both.map(|(u, d)| std::array::from_fn(|i| u[i] + d[i])).collect::<Vec<[f64; 4]>>()
        });
        let yields = mark.reached.memories.iter().zip(&now.memories);
        let mut begun = yields.map(|(a, b)| a.accumulated == 0.0 && b.accumulated > 0.0);
        let mut each = search.model.connectors.iter().zip(&search.base.coordinates);
        begun.any(|begins| begins)
            || each.any(|(c, q)| {
                let at = |u: &[[f64; 4]]| c.law.stiffness_at(c.value(u, *q));
                at(&then) != at(&here)
            })
    }

    /// The same if a contact closes there: without this contact the way may be the one along which the path arrived.
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
            // A motion along the plane does not intersect it, and contacts that close before it may turn the path back from it.
            let back = across * rise < 0.0 && tracer.search.contacts.pressing() != from.pressed;
            (across.abs() > straight && !back).then(|| -tracer.inner(&plane, correction) / across)
        })?;
        self.arrive(from, false).then_some(found)
    }

    /// Whether the path continues from the current point with a rising load factor: in the given direction if there is one, else so that the
    /// contacts that have closed since the start of the last way press more, else as it arrived.
    pub(super) fn leads_up(&self) -> bool {
        if self.given {
            return self.changed > 0.0;
        }
        let pressing = self.search.contacts.onward(&self.pressed, &self.response);
        pressing.unwrap_or_else(|| self.inner(&self.way, &self.response.nodal)) > 0.0
    }

    /// Change of the load factor on the way from a point to the current one.
    pub(super) fn factor_along_arc(&mut self, before: &Mark) -> FactorAlongArc {
        let then = if self.rising { self.slope } else { -self.slope };
        let gone = self.inner(&self.way, &self.way).sqrt();
        let old = self.inner(&before.way, &before.way).sqrt();
        let along = self.inner(&before.way, &self.way);
        let Some(rises) = self.rises() else {
            return FactorAlongArc { turned: false, resolved: true };
        };
        if self.given && self.search.contacts.is_empty() {
            return FactorAlongArc { turned: false, resolved: true };
        }
        let length = self.inner(&self.response.nodal, &self.response.nodal).sqrt();
        let now = if rises { 1.0 / length } else { -1.0 / length };
        let mean = (self.factor - before.factor) / gone;
        let turned = then * now < 0.0;
        let straight = old == 0.0 || along >= LEAST_COSINE * gone * old;
        let even = |slope: f64| slope / mean >= 0.0 && slope / mean <= STEEPEST;
        FactorAlongArc { turned, resolved: straight && (turned || (even(then) && even(now))) }
    }

    /// Whether the load factor increases along the path at the current point.
    fn rises(&mut self) -> Option<bool> {
        self.prepare().then(|| self.leads_up())
    }

    /// Goes to the point of an arc from a point before it at which the number of motions without stiffness changes.
    pub(super) fn bifurcation(&mut self, before: &Mark, arc: f64, number: usize) -> PathPoint {
        let (mut low, mut high) = (0.0, arc);
        for _ in 0..BISECTIONS_OF_STABILITY {
            let middle = 0.5 * (low + high);
            self.back_to(before);
            let there = self.advance(middle).is_some();
            if there && self.stability().negative == Some(number) {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.back_to(before);
        let _ = self.advance(if low > 0.0 { low } else { high });
        self.point()
    }

    /// Goes to the limit point within an arc from a point before it, by bisection: the tested point with the largest load, or the least.
    pub(super) fn limit_point(&mut self, before: &Mark, arc: f64) -> Option<PathPoint> {
        let (mut low, mut high) = (0.0, arc);
        let rising = self.rising;
        let mut found: Option<Mark> = None;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            self.back_to(before);
            // An arc that leads nowhere is too long.
            let there = self.advance(middle).is_some();
            let mark = there.then(|| self.mark());
            let beyond = !there || self.rises()? != rising;
            if beyond {
                high = middle
            } else {
                low = middle
            }
            let further = |m: &Mark| found.as_ref().is_none_or(|f| (m.factor > f.factor) == rising);
            found = mark.filter(further).or(found);
        }
        self.back_to(&found?);
        Some(self.point())
    }
}
