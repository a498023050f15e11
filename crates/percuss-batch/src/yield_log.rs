//! Place and time of yielding of the spans of an ensemble, for each lane.

use super::engine::Engine;
use percuss::Model;
use percuss::internals::model::frozen::{BeamData, Span, SpanFibres};
use percuss::internals::run::yielding::{SAME_FLOW, YieldRecord};
use percuss::internals::scalar::{Mask, Number, Task};
use percuss::math::hermite::GAUSS;
use percuss::{FirstYield, SectionPeak};

/// A largest value, its Gauss point and its time.
#[derive(Clone, Copy, Debug)]
pub struct PointPeak<S> {
    pub value: S,
    /// Number of the Gauss point along the span.
    pub point: S,
    /// Time \[s\].
    pub time: S,
}

/// Record of a span.
#[derive(Clone, Copy, Debug)]
pub struct YieldLog<S> {
    /// Plastic strain of largest magnitude, signed \[-\].
    pub strain: PointPeak<S>,
    /// Largest accumulated plastic strain \[-\].
    pub accumulated: PointPeak<S>,
    /// The largest accumulated plastic strain in the step of first yield; unset without any \[-\].
    pub first: PointPeak<S>,
    /// Largest ratio of stress to yield stress before that; recorded only for derivatives \[-\].
    pub near: PointPeak<S>,
}

impl<S: Number> PointPeak<S> {
    fn none(like: S) -> Self {
        let zero = like.constant(0.0);
        Self { value: zero, point: zero, time: zero }
    }

    /// Updates the record with a value of given magnitude.
    #[inline(always)]
    fn take(&mut self, value: S, [point, time]: [S; 2]) {
        let larger = self.value.abs().less(value.abs());
        self.value = S::choose(larger, value, self.value);
        self.point = S::choose(larger, point, self.point);
        self.time = S::choose(larger, time, self.time);
    }
}

impl<S: Number> YieldLog<S> {
    /// A record without yielding.
    pub fn none(like: S) -> Self {
        let none = PointPeak::none(like);
        Self { strain: none, accumulated: none, first: none, near: none }
    }

    fn each(&mut self) -> impl Iterator<Item = &mut S> {
        let peaks = [&mut self.strain, &mut self.accumulated, &mut self.first, &mut self.near];
        peaks.into_iter().flat_map(|n| [&mut n.value, &mut n.point, &mut n.time])
    }

    /// Begins a new run in a lane.
    pub fn reset(&mut self, lane: usize) {
        let zero = self.strain.value.constant(0.0);
        self.each().for_each(|x| x.set_lane(lane, zero, lane));
    }

    /// Restores the saved records of all lanes except those of the mask `go`.
    #[inline(always)]
    pub fn restore(&mut self, kept: &Self, go: S::Mask) {
        for (now, kept) in self.each().zip({ *kept }.each()) {
            *now = S::choose(go, *now, *kept);
        }
    }
}

/// Updates the records, one for each span with fibres, with the fibres at a time.
#[inline(always)]
pub fn note<S: Number>(engine: &Engine<S>, time: S, logs: &mut [YieldLog<S>]) {
    if S::DERIVES || engine.fibres.flowed.any() {
        time.apart(Note { engine, time, logs });
    }
}

/// See [`note`].
struct Note<'a, S: Number> {
    engine: &'a Engine<S>,
    time: S,
    /// Records so far, shape (spans with fibres).
    logs: &'a mut [YieldLog<S>],
}

impl<S: Number> Task for Note<'_, S> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        note_all(self.engine, self.time, self.logs);
    }
}

#[inline(always)]
fn note_all<S: Number>(engine: &Engine<S>, time: S, logs: &mut [YieldLog<S>]) {
    let mut logs = logs.iter_mut();
    let mut element = 0;
    for span in &engine.numbers.spans {
        if let (Some(fibres), Some(log)) = (&span.fibres, span.fibres.as_ref().and(logs.next())) {
            for k in 0..span.count {
                log.note_element(engine, fibres, [k, element + k], time);
            }
        }
        element += span.count;
    }
}

impl<S: Number> YieldLog<S> {
    /// Updates the record with the fibres of an element, given its number in the span and among all.
    #[inline(always)]
    fn note_element(
        &mut self,
        engine: &Engine<S>,
        fibres: &SpanFibres<S>,
        [k, element]: [usize; 2],
        time: S,
    ) {
        let zero = time.constant(0.0);
        let mut states = engine.fibres.states[fibres.range(k)].iter();
        for (j, points) in fibres.of(k).iter().enumerate() {
            let place = [zero.constant((k * GAUSS + j) as f64), time];
            let (mut strain, mut accumulated) = (zero, zero);
            for (fibre, state) in points.iter().zip(states.by_ref()) {
                let larger = strain.abs().less(state.plastic.abs());
                strain = S::choose(larger, state.plastic, strain);
                accumulated = accumulated.max(state.accumulated);
                if S::DERIVES {
                    let [membrane, bending] = engine.fibres.strains[element][j];
                    let law = &fibres.laws[fibre.law];
                    let near = law.use_of_limit(state, membrane + fibre.height * bending);
                    self.near.take(near.unwrap_or(zero), place);
                }
            }
            let yielded = zero.less(accumulated);
            if !yielded.any() {
                continue;
            }
            self.strain.take(strain, place);
            self.accumulated.take(accumulated, place);
            let still_first = !zero.less(self.first.value) | self.first.time.equals(time);
            // Of two that have flowed as much but for round-off, the one before along the beam.
            let more = (self.first.value * (1.0 + SAME_FLOW)).less(accumulated);
            let own = S::choose(yielded & still_first & more, accumulated, zero);
            self.first.take(own, place);
        }
    }
}

/// The record of each beam of a lane's run.
pub fn records<S: Number>(model: &Model, logs: &[YieldLog<S>], lane: usize) -> Vec<YieldRecord> {
    let mut logs = logs.iter();
    let beam = |beam: &BeamData| {
        let with = model.spans[beam.spans.clone()].iter().filter(|span| span.fibres.is_some());
        let own: Vec<_> = with
            .zip(logs.by_ref())
            .filter(|(_, log)| log.accumulated.value.lane(lane) != 0.0)
            .map(|(span, log)| {
                [&log.strain, &log.accumulated, &log.first].map(|peak| SectionPeak {
                    value: peak.value.lane(lane),
                    s: place(span, peak.point.lane(lane) as usize),
                    time: peak.time.lane(lane),
                })
            })
            .collect();
        let earlier = |a: &SectionPeak, b: &SectionPeak| {
            a.time.total_cmp(&b.time).then(b.value.total_cmp(&a.value))
        };
        let first = own.iter().map(|[_, _, first]| *first).min_by(earlier);
        let mut record = YieldRecord::default();
        for [strain, accumulated, _] in &own {
            let SectionPeak { s, time, .. } = first.unwrap_or(*accumulated);
            record.take(FirstYield { s, time }, *strain, *accumulated);
        }
        record
    };
    model.beams.iter().map(beam).collect()
}

/// Arc length of a Gauss point of a span from the start of the beam \[m\].
fn place(span: &Span, point: usize) -> f64 {
    let (k, j) = (point / GAUSS, point % GAUSS);
    let (from, to) = (span.stations[k], span.stations[k + 1]);
    from + percuss::math::hermite::gauss_points()[j] * (to - from)
}
