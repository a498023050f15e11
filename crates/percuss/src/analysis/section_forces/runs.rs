//! Section forces of runs of one shape side by side: lanes are runs, and each keeps the extremes of its own beams.
//!
//! Axial force, shear force and moment, and stresses of elastic beams where they are asked for; strains are not reported.

use super::acted;
use super::element::{ElementForces, PLACES, widen};
use super::line::{ElementShape, Inner, Line, OnNodes, SectionForces};
use super::lines::{inner_of, take};
use super::screen::{BeamExtremes, Depth, depth_of, look_at, look_at_stresses, stresses_at};
use super::unset;
use crate::model::Model;
use crate::model::frozen::{BeamData, MaterialPoint, Span};
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
    /// The extremes of each beam once more, side by side, shape (beams, 3, 2) \[N, N, N m\].
    known: Vec<BeamExtremes<S>>,
    /// The same at both ends and in the middle of each element, shape (elements, 3, 3, 2) \[N, N, N m\].
    envelope: Vec<[BeamExtremes<S>; 3]>,
    /// Whether a fixed place of action is inside an element in a lane's run, shape (elements).
    acted: Vec<bool>,
    /// Stresses, if they are asked for.
    stresses: Option<Stresses<S>>,
}

/// Stresses of runs side by side.
#[derive(Clone, Debug)]
struct Stresses<S> {
    /// What forces make of them, zero where the section has no depth, shape (elements, 3, 2) \[1/m^2, 1/m^3\].
    depth: Vec<Depth<S>>,
    /// Least and largest so far, shape (beams, 2) \[Pa\].
    known: Vec<[S; 2]>,
    /// The same at both ends and in the middle of each element, shape (elements, 3, 2) \[Pa\].
    envelope: Vec<[[S; 2]; 3]>,
}

impl<'m, S: Number> RunForces<'m, S> {
    /// Of runs of the shape of a model; no lane has one yet.
    pub fn new(model: &Model, stresses: bool, like: S) -> Self {
        let none = [[like.constant(0.0); 2]; 3];
        let elements = model.element_count();
        Self {
            models: vec![None; S::LANES],
            found: vec![Vec::new(); S::LANES],
            known: vec![none; model.beams.len()],
            envelope: vec![[none; 3]; elements],
            acted: vec![false; elements],
            stresses: stresses.then(|| Stresses {
                depth: vec![none; elements],
                known: vec![none[0]; model.beams.len()],
                envelope: vec![none; elements],
            }),
        }
    }

    /// Begins a run at rest in a lane.
    pub fn begin(&mut self, lane: usize, model: &'m Model) {
        self.models[lane] = Some(model);
        self.found[lane] = unset(model);
        for (beam, data) in self.found[lane].iter_mut().zip(&model.beams) {
            let stressed = self.stresses.is_some();
            acted::begin(model, data, &mut beam.envelope, (stressed, &mut self.acted));
            let s = beam.envelope.s.first().map_or(0.0, |s| *s);
            ranges(beam).into_iter().for_each(|range| range.take(0.0, s, 0.0));
            if self.stresses.is_some() {
                beam.stress.take(0.0, s, 0.0);
            }
        }
        let all = self.envelope.as_flattened_mut().iter_mut().chain(&mut self.known);
        for x in all.flat_map(|known| known.as_flattened_mut()) {
            x.set_lane(lane, x.constant(0.0), lane);
        }
        if let Some(stresses) = &mut self.stresses {
            stresses.begin(lane, model);
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
        if self.acted[at.element] {
            self.take_acted(at, &line, go);
        }
        let [mut exceeds, mut turns] = look_at(&places, &self.known[at.beam]);
        if let Some(stresses) = &mut self.stresses {
            let [more, within] = stresses.take(at, &places, go);
            (exceeds, turns) = (exceeds | more, turns | within);
        }
        if ((exceeds | turns) & go).any() {
            let [exceeds, turns] = [exceeds & go, turns & go];
            for lane in 0..S::LANES {
                if self.models[lane].is_none() {
                    continue;
                }
                if exceeds.lane(lane) {
                    self.take_places(lane, at, &line, time.lane(lane));
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
        let piece = ElementForces::elastic(span, at.k, line, &inner, self.stresses.is_some());
        let index = PLACES.len() * (at.element - first);
        piece.take(&mut self.found[lane][at.beam], index, time);
        if let Some(model) = self.models[lane] {
            let regular = acted::regular(&model.beams[at.beam]);
            piece.take_acted(&mut self.found[lane][at.beam], regular);
        }
        self.know(lane, at.beam);
    }

    /// The section forces of a lane's run.
    pub fn end(&self, lane: usize) -> Vec<SectionForceSummary> {
        let mut found = self.found[lane].clone();
        let beams = self.models[lane].iter().flat_map(|model| &model.beams);
        for (out, beam) in found.iter_mut().zip(beams) {
            if let Some((stresses, model)) = self.stresses.as_ref().zip(self.models[lane]) {
                stresses.end(lane, model, beam, out);
            }
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
        acted::ordered(&mut found);
        found
    }

    /// The span of an element in a lane's run, and the first element of its beam.
    fn span(&self, lane: usize, at: ElementPlace) -> Option<(&'m Span, usize)> {
        let model = self.models[lane]?;
        Some((&model.spans[at.span], model.beams[at.beam].elements.start))
    }

    /// Takes the fixed places of action inside an element into the envelopes of the lanes that `go`.
    fn take_acted(&mut self, at: ElementPlace, line: &Line<S>, go: S::Mask) {
        for lane in (0..S::LANES).filter(|lane| go.lane(*lane)) {
            let Some(piece) = self.piece(lane, at, line) else { continue };
            let regular =
                self.models[lane].map_or(0, |model| acted::regular(&model.beams[at.beam]));
            piece.take_acted(&mut self.found[lane][at.beam], regular);
        }
    }

    fn take_places(&mut self, lane: usize, at: ElementPlace, line: &Line<S>, time: f64) {
        let Some(piece) = self.piece(lane, at, line) else { return };
        for xi in PLACES {
            piece.take_at(&mut self.found[lane][at.beam], xi, &piece.line.at(xi, &[], false), time);
        }
    }

    /// Takes the largest section forces of an element between the places looked at.
    fn take_between(&mut self, lane: usize, at: ElementPlace, line: &Line<S>, time: f64) {
        let Some(piece) = self.piece(lane, at, line) else { return };
        let places = PLACES.map(|xi| piece.line.at(xi, &[], false));
        piece.take_between_places(&mut self.found[lane][at.beam], &places, time);
    }

    /// An element of a lane's run, nothing inside it.
    fn piece(&self, lane: usize, at: ElementPlace, line: &Line<S>) -> Option<ElementForces<'m>> {
        let (span, _) = self.span(lane, at)?;
        let line = Line::from_numbers(line.numbers().map(|x| x.lane(lane)));
        Some(ElementForces::elastic(span, at.k, line, &[], self.stresses.is_some()))
    }

    /// Notes the extremes of a lane's beam beside those of the others.
    fn know(&mut self, lane: usize, beam: usize) {
        let found = &mut self.found[lane][beam];
        let stress = found.stress;
        let pairs = self.known[beam].iter_mut().zip(ranges(found).map(|range| *range));
        let stresses = self.stresses.iter_mut().map(|stresses| (&mut stresses.known[beam], stress));
        for (mine, range) in pairs.chain(stresses) {
            for (x, peak) in mine.iter_mut().zip([range.min, range.max]) {
                x.set_lane(lane, x.constant(peak.value), lane);
            }
        }
    }
}

fn ranges(beam: &mut SectionForceSummary) -> [&mut SectionRange; 3] {
    [&mut beam.axial, &mut beam.shear, &mut beam.moment]
}

impl<S: Number> Stresses<S> {
    /// Begins a run at rest in a lane.
    fn begin(&mut self, lane: usize, model: &Model) {
        for (span, k, _, element) in model.each_element() {
            for (mine, xi) in self.depth[element].iter_mut().zip(PLACES) {
                let section = span.section_at(k, xi);
                let own = match span.has_depth() {
                    true => depth_of(&section),
                    false => [0.0; 2],
                };
                mine.iter_mut()
                    .zip(own)
                    .for_each(|(x, own)| x.set_lane(lane, x.constant(own), lane));
            }
        }
        for x in self.envelope.as_flattened_mut().iter_mut().chain(&mut self.known).flatten() {
            x.set_lane(lane, x.constant(0.0), lane);
        }
    }

    /// Takes an element into the envelope; whether it exceeds what its beam has had at the places looked at, and whether it may between them.
    #[inline(always)]
    fn take(
        &mut self,
        at: ElementPlace,
        places: &[SectionForces<S>; 3],
        go: S::Mask,
    ) -> [S::Mask; 2] {
        let depth = &self.depth[at.element];
        for (range, [least, most]) in
            self.envelope[at.element].iter_mut().zip(stresses_at(places, depth))
        {
            range[0] = S::choose(go & least.less(range[0]), least, range[0]);
            range[1] = S::choose(go & range[1].less(most), most, range[1]);
        }
        look_at_stresses(places, depth, &self.known[at.beam])
    }

    /// Enters what the envelope of a lane's beam has into its record, where sections have a depth.
    fn end(&self, lane: usize, model: &Model, beam: &BeamData, out: &mut SectionForceSummary) {
        for span in model.spans[beam.spans.clone()].iter().filter(|span| span.has_depth()) {
            let first = PLACES.len() * (span.elements.start - beam.elements.start);
            let places = self.envelope[span.elements.clone()].as_flattened();
            for (k, [least, most]) in places.iter().enumerate() {
                widen(&mut out.envelope.stress, first + k, least.lane(lane), most.lane(lane));
            }
        }
        let deep = model.spans[beam.spans.clone()].iter().any(Span::has_depth);
        if !deep {
            out.stress = SectionRange::default();
        }
        out.strain = SectionRange::default();
    }
}
