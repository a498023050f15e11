//! Section forces of runs of one shape side by side: lanes are runs, and each keeps the extremes of its own beams.
//!
//! Axial force, shear force and moment alone; stresses and strains of fibres stay unset.

use super::element::{ElementForces, PLACES, station, widen};
use super::line::{ElementShape, Inner, Line, OnNodes, SectionForces};
use super::lines::{inner_of, take};
use super::screen::{Known, look_at};
use super::unset;
use crate::model::Model;
use crate::model::frozen::{MaterialPoint, Span};
use crate::scalar::{Mask, Number};
use crate::summary::{SectionForceSummary, SectionRange};

/// What acts on an element in a step.
#[derive(Clone, Copy, Debug)]
pub struct ElementActing<S> {
    /// Tangents x' at both nodes in the middle of the step, shape (2, 2) \[-\].
    pub tangents: [[S; 2]; 2],
    /// From the first node to the second, shape (2) \[m\].
    pub chord: [S; 2],
    /// Arc length of the reference \[m\].
    pub length: S,
    /// Forces of its neighbours on values and slopes of its nodes, shape (2, 4) \[N, N m\].
    pub ends: [[S; 4]; 2],
    /// What accelerates it beyond its loads, likewise, shape (2, 4) \[N, N m\].
    pub along: [[S; 4]; 2],
}

/// A force that acts inside an element.
#[derive(Clone, Copy, Debug)]
pub struct ForceInside(Inner);

impl ForceInside {
    /// At a point, shape of the force (2) \[N\]; none at a node.
    pub fn at(model: &Model, point: &MaterialPoint, force: [f64; 2]) -> Option<Self> {
        inner_of(model, point, force).map(Self)
    }
}

/// Which element of which beam.
#[derive(Clone, Copy, Debug)]
pub struct ElementPlace {
    /// Its beam \[index of a beam\].
    pub beam: usize,
    /// Its span \[index of a span\].
    pub span: usize,
    /// Its number in the span.
    pub k: usize,
    /// Its number among all elements.
    pub element: usize,
}

/// Extremes and envelopes of the section forces of runs side by side.
#[derive(Clone, Debug)]
pub struct RunForces<'m, S: Number> {
    /// The model of the run in each lane, shape (lanes).
    models: Vec<Option<&'m Model>>,
    /// Its extremes; of its envelopes what forces inside elements widened alone, shape (lanes, beams).
    found: Vec<Vec<SectionForceSummary>>,
    /// The extremes of each beam once more, side by side, shape (beams).
    known: Vec<Known<S>>,
    /// The same at both ends and in the middle of each element, shape (elements, 3).
    envelope: Vec<[Known<S>; 3]>,
}

impl<'m, S: Number> RunForces<'m, S> {
    /// Of runs of the shape of a model; no lane has one yet.
    pub fn new(model: &Model, like: S) -> Self {
        let none = [[like.constant(0.0); 2]; 3];
        Self {
            models: vec![None; S::LANES],
            found: vec![Vec::new(); S::LANES],
            known: vec![none; model.beams.len()],
            envelope: vec![[none; 3]; model.element_count()],
        }
    }

    /// Begins a run at rest in a lane.
    pub fn begin(&mut self, lane: usize, model: &'m Model) {
        self.models[lane] = Some(model);
        self.found[lane] = unset(model);
        for beam in &mut self.found[lane] {
            let s = beam.envelope.s.first().map_or(0.0, |s| *s);
            ranges(beam).into_iter().for_each(|range| range.take(0.0, s, 0.0));
        }
        let all = self.envelope.as_flattened_mut().iter_mut().chain(&mut self.known);
        for x in all.flat_map(|known| known.as_flattened_mut()) {
            x.set_lane(lane, x.constant(0.0), lane);
        }
    }

    /// Takes in an element in a step that ends at `time`, of the lanes that `go`; nothing acts inside it.
    #[inline(always)]
    pub fn take(&mut self, at: ElementPlace, acting: &ElementActing<S>, time: S, go: S::Mask) {
        let ElementActing { tangents, chord, length, ends, along } = *acting;
        let (mut line, left) = Line::open(&ElementShape { tangents, chord, length }, &ends, &along);
        line.close_smooth(left);
        let places = [line.smooth(PLACES[0]), line.smooth(PLACES[1]), line.smooth(PLACES[2])];
        for (envelope, forces) in self.envelope[at.element].iter_mut().zip(&places) {
            let values = [forces.axial, forces.shear, forces.moment];
            for (range, value) in envelope.iter_mut().zip(values) {
                range[0] = S::choose(go & value.less(range[0]), value, range[0]);
                range[1] = S::choose(go & range[1].less(value), value, range[1]);
            }
        }
        let [exceeds, turns] = look_at(&places, &self.known[at.beam]);
        if ((exceeds | turns) & go).any() {
            let [exceeds, turns] = [exceeds & go, turns & go];
            for lane in 0..S::LANES {
                if exceeds.lane(lane) {
                    self.take_places(lane, at, &places, time.lane(lane));
                }
                if turns.lane(lane) {
                    self.take_between(lane, at, &line, time.lane(lane));
                }
                if exceeds.lane(lane) || turns.lane(lane) {
                    self.know(lane, at.beam);
                }
            }
        }
    }

    /// The same of a lane's element inside which something acts.
    pub fn take_forced(
        &mut self,
        lane: usize,
        at: ElementPlace,
        acting: &ElementActing<S>,
        time: f64,
        inside: impl Iterator<Item = ForceInside>,
    ) {
        let Some((span, first)) = self.span(lane, at) else { return };
        let mut inner: Vec<Inner> = inside.map(|one| one.0).collect();
        inner.sort_by(|a, b| a.xi.total_cmp(&b.xi));
        let pair = |of: &[[S; 2]; 2]| of.map(|x| x.map(|x| x.lane(lane)));
        let shape = ElementShape {
            tangents: pair(&acting.tangents),
            chord: acting.chord.map(|x| x.lane(lane)),
            length: acting.length.lane(lane),
        };
        let own = |of: &[[S; 4]; 2]| -> OnNodes { of.map(|x| x.map(|x| x.lane(lane))) };
        let (mut ends, along) = (own(&acting.ends), own(&acting.along));
        inner.iter().for_each(|one| take(&mut ends, &one.on_nodes));
        let line = Line::new(&shape, &ends, &along, &mut inner);
        let piece = ElementForces::resultants(span, at.k, line, &inner);
        let index = PLACES.len() * (at.element - first);
        piece.take(&mut self.found[lane][at.beam], index, time);
        self.know(lane, at.beam);
    }

    /// The section forces of a lane's run.
    pub fn end(&self, lane: usize) -> Vec<SectionForceSummary> {
        let mut found = self.found[lane].clone();
        let beams = self.models[lane].iter().flat_map(|model| &model.beams);
        for (out, beam) in found.iter_mut().zip(beams) {
            let places = self.envelope[beam.elements.clone()].as_flattened();
            let e = &mut out.envelope;
            for (index, known) in places.iter().enumerate() {
                for (to, range) in
                    [&mut e.axial, &mut e.shear, &mut e.moment].into_iter().zip(known)
                {
                    widen(to, index, range[0].lane(lane), range[1].lane(lane));
                }
            }
        }
        found
    }

    /// The span of an element in a lane's run, and the first element of its beam.
    fn span(&self, lane: usize, at: ElementPlace) -> Option<(&'m Span, usize)> {
        let model = self.models[lane]?;
        Some((&model.spans[at.span], model.beams[at.beam].elements.start))
    }

    fn take_places(
        &mut self,
        lane: usize,
        at: ElementPlace,
        places: &[SectionForces<S>; 3],
        time: f64,
    ) {
        let Some((span, _)) = self.span(lane, at) else { return };
        let out = &mut self.found[lane][at.beam];
        for (xi, forces) in PLACES.iter().zip(places) {
            let s = station(span.stations[at.k], span.stations[at.k + 1], *xi);
            let values = [forces.axial, forces.shear, forces.moment];
            for (range, value) in ranges(out).into_iter().zip(values) {
                range.take(value.lane(lane), s, time);
            }
        }
    }

    /// Takes the largest section forces of an element between the places looked at.
    fn take_between(&mut self, lane: usize, at: ElementPlace, line: &Line<S>, time: f64) {
        let Some((span, _)) = self.span(lane, at) else { return };
        let line = Line::from_numbers(line.numbers().map(|x| x.lane(lane)));
        let piece = ElementForces::resultants(span, at.k, line, &[]);
        let places = PLACES.map(|xi| piece.line.at(xi, &[], false));
        piece.take_between_places(&mut self.found[lane][at.beam], &places, time);
    }

    /// Notes the extremes of a lane's beam beside those of the others.
    fn know(&mut self, lane: usize, beam: usize) {
        let known = &mut self.known[beam];
        for (mine, range) in known.iter_mut().zip(ranges(&mut self.found[lane][beam])) {
            for (x, peak) in mine.iter_mut().zip([range.min, range.max]) {
                x.set_lane(lane, x.constant(peak.value), lane);
            }
        }
    }
}

fn ranges(beam: &mut SectionForceSummary) -> [&mut SectionRange; 3] {
    [&mut beam.axial, &mut beam.shear, &mut beam.moment]
}
