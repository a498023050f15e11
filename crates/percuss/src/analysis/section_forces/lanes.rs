//! Section forces of a span, element beside element.

use pulp::{Simd, WithSimd};

use super::element::{ElementForces, PLACES, station};
use super::line::{Line, SectionForces};
use super::lines::Lines;
use super::screen::{BeamExtremes, extremes, look_at};
use crate::model::frozen::Span;
use crate::scalar::{Lanes, Mask, Number};
use crate::state::State;
use crate::summary::SectionForceSummary;

/// No register holds more numbers.
const MOST_LANES: usize = 8;

/// Takes the section forces of a span without stresses into the extremes so far.
pub struct PlainSpan<'a> {
    pub span: &'a Span,
    /// First element of its beam.
    pub first: usize,
    pub lines: &'a Lines,
    pub state: &'a State,
    pub out: &'a mut SectionForceSummary,
}

impl WithSimd for PlainSpan<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<P: Simd>(mut self, family: P) {
        let (like, count) = (Lanes::new(family, 0.0), self.span.elements.len());
        for k in (0..count).step_by(P::F64_LANES) {
            let element = self.span.elements.start + k;
            let line = Line::from_numbers(self.lines.lines.load_row(like, element));
            let places = [line.smooth(PLACES[0]), line.smooth(PLACES[1]), line.smooth(PLACES[2])];
            let own = 0..P::F64_LANES.min(count - k);
            let forced = |lane: usize| !self.lines.inside(element + lane).is_empty();
            if !self.lines.inner.is_empty() && own.clone().any(forced) {
                own.for_each(|lane| self.take_one(k + lane));
                continue;
            }
            let [exceeds, turns] = look_at(&places, &self.known(like));
            if exceeds.any() {
                for lane in own.clone() {
                    self.take_places(k + lane, &places, lane);
                }
            }
            self.widen(k, &places, own.len());
            if turns.any() {
                for lane in own.filter(|lane| turns.lane(*lane)) {
                    let places = places.each_ref().map(|at| at.lane(lane));
                    self.take_between(k + lane, &places);
                }
            }
        }
    }
}

impl PlainSpan<'_> {
    /// The extremes of the beam so far, as every element compares itself with them.
    #[inline(always)]
    fn known<S: Number>(&self, like: S) -> BeamExtremes<S> {
        let SectionForceSummary { axial, shear, moment, .. } = &*self.out;
        [axial, shear, moment].map(|range| extremes(range).map(|value| like.constant(value)))
    }

    #[inline(always)]
    fn take_places<P: Simd>(
        &mut self,
        k: usize,
        places: &[SectionForces<Lanes<P>>; 3],
        lane: usize,
    ) {
        let time = self.state.time;
        for (j, at) in places.iter().enumerate() {
            let s = station(self.span.stations[k], self.span.stations[k + 1], PLACES[j]);
            self.out.axial.take(at.axial.at(lane), s, time);
            self.out.shear.take(at.shear.at(lane), s, time);
            self.out.moment.take(at.moment.at(lane), s, time);
        }
    }

    /// Takes the places of so many elements from number `k` on into the envelope.
    #[inline(always)]
    fn widen<P: Simd>(&mut self, k: usize, places: &[SectionForces<Lanes<P>>; 3], count: usize) {
        let index = PLACES.len() * (self.span.elements.start + k - self.first);
        let [a, b, c] = places;
        let envelope = &mut self.out.envelope;
        widen_places(&mut envelope.axial, index, [a.axial, b.axial, c.axial], count);
        widen_places(&mut envelope.shear, index, [a.shear, b.shear, c.shear], count);
        widen_places(&mut envelope.moment, index, [a.moment, b.moment, c.moment], count);
    }

    /// Takes an element on its own.
    fn take_one(&mut self, k: usize) {
        let Self { span, lines, state, .. } = *self;
        let (line, inner) = lines.of(span.elements.start + k);
        let piece = ElementForces::elastic(span, k, line, inner, false);
        let index = PLACES.len() * (span.elements.start + k - self.first);
        piece.take(self.out, index, state.time);
    }

    /// Takes the largest section forces of an element between the places looked at.
    fn take_between(&mut self, k: usize, places: &[SectionForces; 3]) {
        let Self { span, lines, state, .. } = *self;
        let (line, inner) = lines.of(span.elements.start + k);
        let piece = ElementForces::elastic(span, k, line, inner, false);
        piece.take_between_places(self.out, places, state.time);
    }
}

/// Takes values at the places of so many elements into their envelope from `index` on; all in one go, so that they go through registers.
#[inline(always)]
fn widen_places<P: Simd>(
    [min, max]: &mut [Vec<f64>; 2],
    index: usize,
    places: [Lanes<P>; 3],
    count: usize,
) {
    let mut values = [0.0; PLACES.len() * MOST_LANES];
    for lane in 0..P::F64_LANES {
        for j in 0..PLACES.len() {
            values[PLACES.len() * lane + j] = places[j].at(lane);
        }
    }
    let own = index..index + PLACES.len() * count;
    let values = &values[..own.len()];
    let (min, max) = (&mut min[own.clone()], &mut max[own]);
    for i in 0..values.len() {
        // The first value replaces NaN.
        min[i] = if values[i] < min[i] || min[i].is_nan() { values[i] } else { min[i] };
    }
    for i in 0..values.len() {
        max[i] = if values[i] > max[i] || max[i].is_nan() { values[i] } else { max[i] };
    }
}
