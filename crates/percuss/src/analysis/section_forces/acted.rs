//! Envelopes at the fixed places of action inside elements: section forces jump or have a corner there.
//!
//! While a run steps, both sides of these places stand behind the places that every element has; [`ordered`] puts all in the order of arc
//! length.

use super::element::{ElementForces, PLACES, station};
use super::line::{SAME_PLACE, place_of};
use super::lines::Lines;
use crate::geometry::pair::{Carrier, Target};
use crate::model::Model;
use crate::model::frozen::{BeamData, LoadAction, Span};
use crate::summary::{Envelope, SectionForceSummary};

/// Arc lengths of the places inside elements of a beam at which point loads, masses and guided projectiles act, in their order \[m\].
pub(super) fn places(model: &Model, beam: &BeamData) -> Vec<f64> {
    let loads = model.loads.iter().filter_map(|load| match &load.kind {
        LoadAction::Point { point, .. } => Some((point.node, point.shape[2])),
        _ => None,
    });
    let masses = model.masses.iter().map(|mass| (mass.point.node, mass.point.shape[2]));
    let struck = model.pairs.iter().filter_map(|pair| match &pair.target {
        Target::Guided { point, .. } => match point.carrier {
            Carrier::Beam { shape, .. } => Some((point.node, shape[2])),
            Carrier::Body { .. } => None,
        },
        _ => None,
    });
    let inside = |share: &f64| (SAME_PLACE..=1.0 - SAME_PLACE).contains(share);
    let all = loads.chain(masses).chain(struck);
    let own = all.filter(|(node, share)| beam.nodes.contains(node) && inside(share));
    let mut found: Vec<f64> = own
        .map(|(node, share)| {
            let (span, k) = model.element_of(node);
            station(span.stations[k], span.stations[k + 1], place_of(share))
        })
        .collect();
    found.sort_by(f64::total_cmp);
    found.dedup_by(|a, b| (*a - *b).abs() <= SAME_PLACE * beam.length);
    found
}

/// Number of the places that every element of a beam has: those of action stand behind them.
pub(super) fn regular(beam: &BeamData) -> usize {
    PLACES.len() * beam.elements.len()
}

/// Begins envelopes at rest at the places of action of a beam, with stresses if they are asked for; notes in which elements they are.
pub(super) fn begin(
    model: &Model,
    beam: &BeamData,
    e: &mut Envelope,
    (stresses, acted): (bool, &mut [bool]),
) {
    for i in regular(beam)..e.s.len() {
        for span in &model.spans[beam.spans.clone()] {
            let Some(k) = element_around(span, e.s[i]) else { continue };
            acted[span.elements.start + k] = true;
            let stressed = stresses && span.has_depth();
            let Envelope { axial, shear, moment, stress, .. } = &mut *e;
            for columns in [axial, shear, moment] {
                columns.iter_mut().for_each(|column| column[i] = 0.0);
            }
            stress.iter_mut().filter(|_| stressed).for_each(|column| column[i] = 0.0);
        }
    }
}

/// The element of a span that a place is inside.
fn element_around(span: &Span, s: f64) -> Option<usize> {
    let k = span.stations.partition_point(|station| *station < s).checked_sub(1)?;
    (k + 1 < span.stations.len()).then_some(k)
}

/// Takes the places of action inside elements of a span without stresses into the envelope, where they stand from a number on.
pub(super) fn take_plain(span: &Span, lines: &Lines, out: &mut SectionForceSummary, from: usize) {
    for i in (from..out.envelope.s.len()).step_by(2) {
        if let Some(k) = element_around(span, out.envelope.s[i]) {
            let (line, inner) = lines.of(span.elements.start + k);
            ElementForces::elastic(span, k, line, inner, false).take_acted(out, from);
        }
    }
}

impl ElementForces<'_> {
    /// Takes both sides of the places of action inside the element into the envelope, where they stand from a number on.
    pub(super) fn take_acted(&self, out: &mut SectionForceSummary, from: usize) {
        let (a, b) = (self.span.stations[self.k], self.span.stations[self.k + 1]);
        for i in (from..out.envelope.s.len()).step_by(2) {
            let s = out.envelope.s[i];
            if a < s && s < b {
                for (side, ahead) in [false, true].into_iter().enumerate() {
                    let xi = (s - a) / (b - a);
                    let forces = self.line.at(xi, self.inner, ahead);
                    let fibres = self.fibres(xi, &forces);
                    self.widen(out, i + side, &forces, fibres.as_ref());
                }
            }
        }
    }
}

/// Puts the places of envelopes in the order of arc length. A stress that is known elsewhere alone, as in beams that can yield, is on the straight
/// line between its neighbours.
pub fn ordered(beams: &mut [SectionForceSummary]) {
    for beam in beams {
        let e = &mut beam.envelope;
        if e.s.is_sorted() {
            continue;
        }
        let mut order: Vec<usize> = (0..e.s.len()).collect();
        order.sort_by(|a, b| e.s[*a].total_cmp(&e.s[*b]));
        let Envelope { s, axial, shear, moment, stress } = e;
        let columns = [axial, shear, moment, stress];
        for column in columns.into_iter().flatten().filter(|column| !column.is_empty()) {
            *column = order.iter().map(|k| column[*k]).collect();
        }
        *s = order.iter().map(|k| s[*k]).collect();
        e.stress.iter_mut().for_each(|column| fill(&e.s, column));
    }
}

/// Puts what is not known between two known values on the straight line through them.
fn fill(s: &[f64], column: &mut [f64]) {
    for k in 1..column.len() {
        if column[k].is_nan() && column[k - 1].is_finite() {
            let next = (k..column.len()).find(|i| column[*i].is_finite());
            let Some(next) = next else { continue };
            let share = (s[k] - s[k - 1]) / (s[next] - s[k - 1]);
            let share = if share.is_finite() { share } else { 0.0 };
            column[k] = (1.0 - share) * column[k - 1] + share * column[next];
        }
    }
}
