//! Section forces of an element, and what they add to the largest of its beam.

use super::fibres::{self, Fibres, Strained};
use super::line::{Inner, Line, SectionForces};
use crate::element::beam::SectionValues;
use crate::math::hermite::{self, GAUSS};
use crate::model::frozen::Span;
use crate::summary::{SectionForceSummary, SectionPeak};

/// Places of an element that the envelope knows: both ends and the middle.
pub(super) const PLACES: [f64; 3] = [0.0, 0.5, 1.0];

/// What changes by less than this share of itself along half an element does not change.
pub(super) const FLAT: f64 = 1e-12;

/// Share of an element next to a node within which an extreme is at the node: its value there is that of the extreme but for round-off.
const NEXT_TO_NODE: f64 = 1e-6;

/// The place of an extreme in an element, as it is given: at a node if it is next to it.
fn place_of_extreme(xi: f64) -> f64 {
    match xi {
        _ if xi < NEXT_TO_NODE => 0.0,
        _ if xi > 1.0 - NEXT_TO_NODE => 1.0,
        _ => xi,
    }
}

/// Arc length at a share of the way.
pub(super) fn station(a: f64, b: f64, xi: f64) -> f64 {
    if xi == 1.0 { b } else { a + xi * (b - a) }
}

/// An element with its section forces.
pub(super) struct ElementForces<'a> {
    pub(super) span: &'a Span,
    pub(super) k: usize,
    pub(super) line: Line,
    /// Forces inside the element, by place, shape (such forces).
    pub(super) inner: &'a [Inner],
    /// Strains at both nodes, where they do not follow from the forces, shape (2).
    pub(super) strained: Option<[Strained; 2]>,
    /// Extreme fibres at the Gauss points of an element that can yield, shape (Gauss points); those of the middle of a shear-flexible one.
    pub(super) yielded: Option<[Fibres; GAUSS]>,
    /// Whether its stresses and strains are asked for.
    pub(super) stresses: bool,
    /// Whether its shear stresses and von Mises stresses are, too.
    pub(super) sheared: bool,
}

impl<'a> ElementForces<'a> {
    /// Elastic, with stresses of the extreme fibres if they are asked for, else with axial force, shear force and moment alone; strains are not, and are zero.
    pub(super) fn elastic(
        span: &'a Span,
        k: usize,
        line: Line,
        inner: &'a [Inner],
        stresses: bool,
    ) -> Self {
        let strained = Some([Strained { stretch: 0.0, turn: 0.0 }; 2]);
        Self { span, k, line, inner, strained, yielded: None, stresses, sheared: false }
    }

    /// Whether it has extreme fibres anywhere, and they are asked for.
    pub(super) fn has_fibres(&self) -> bool {
        self.stresses && self.span.has_depth() && self.yielded.is_none()
    }

    /// Arc length of an extreme at a share of the way.
    pub(super) fn s(&self, xi: f64) -> f64 {
        let (a, b) = (self.span.stations[self.k], self.span.stations[self.k + 1]);
        station(a, b, place_of_extreme(xi))
    }

    /// Extreme fibres; nothing without a depth.
    pub(super) fn fibres(&self, xi: f64, forces: &SectionForces) -> Option<Fibres> {
        self.has_fibres().then(|| self.fibres_of(&self.section(xi), xi, forces))
    }

    fn section(&self, xi: f64) -> SectionValues {
        self.span.section_at(self.k, xi)
    }

    fn fibres_of(&self, section: &SectionValues, xi: f64, forces: &SectionForces) -> Fibres {
        let gauss = hermite::nearest_gauss_point(xi);
        let curvature = self.span.table(self.k).rows[gauss].reference.curvature;
        let strained = self.strained.map(|[a, b]| {
            let mix = |a: f64, b: f64| (1.0 - xi) * a + xi * b;
            Strained { stretch: mix(a.stretch, b.stretch), turn: mix(a.turn, b.turn) }
        });
        fibres::fibres(section, curvature, forces, strained)
    }

    /// Takes the element into the extremes of its beam, its places into the envelope from `index` on.
    pub(super) fn take(&self, out: &mut SectionForceSummary, index: usize, time: f64) {
        let places = PLACES.map(|xi| self.line.at(xi, self.inner, false));
        for (j, forces) in places.iter().enumerate() {
            let fibres = self.take_at(out, PLACES[j], forces, time);
            self.widen(out, index + j, forces, fibres.as_ref());
        }
        for (j, fibres) in self.yielded.iter().flatten().enumerate() {
            let xi = if self.span.shear.is_some() { 0.5 } else { hermite::gauss_points()[j] };
            self.take_fibres(out, xi, fibres, time);
            let [least, most] = fibres.stress;
            widen(&mut out.envelope.stress, index + j, least, most);
        }
        if !self.inner.is_empty() {
            self.take_between_forces(out, time);
        } else {
            self.take_between_places(out, &places, time);
        }
    }

    /// Takes section forces and stresses of a place into the envelope.
    pub(super) fn widen(
        &self,
        out: &mut SectionForceSummary,
        index: usize,
        forces: &SectionForces,
        fibres: Option<&Fibres>,
    ) {
        let e = &mut out.envelope;
        widen(&mut e.axial, index, forces.axial, forces.axial);
        widen(&mut e.shear, index, forces.shear, forces.shear);
        widen(&mut e.moment, index, forces.moment, forces.moment);
        if let Some(Fibres { stress: [least, most], .. }) = fibres {
            widen(&mut e.stress, index, *least, *most);
        }
    }

    pub(super) fn take_at(
        &self,
        out: &mut SectionForceSummary,
        xi: f64,
        forces: &SectionForces,
        time: f64,
    ) -> Option<Fibres> {
        let s = self.s(xi);
        out.axial.take(forces.axial, s, time);
        out.shear.take(forces.shear, s, time);
        out.moment.take(forces.moment, s, time);
        if !self.has_fibres() {
            return None;
        }
        let section = self.section(xi);
        let fibres = self.fibres_of(&section, xi, forces);
        self.take_fibres(out, xi, &fibres, time);
        if self.sheared {
            self.take_sheared(out, xi, (&section, forces), time);
        }
        Some(fibres)
    }

    pub(super) fn take_fibres(
        &self,
        out: &mut SectionForceSummary,
        xi: f64,
        fibres: &Fibres,
        time: f64,
    ) {
        let s = self.s(xi);
        for side in 0..2 {
            out.stress.take(fibres.stress[side], s, time);
            out.strain.take(fibres.strain[side], s, time);
            let (stress, strength) = (fibres.stress[side], self.span.strength);
            // At the first instant, where it is largest.
            let first = out.beyond.is_none_or(|b| b.time == time && stress.abs() > b.value.abs());
            if first && strength.is_some_and(|strength| strength.is_passed(stress)) {
                out.beyond = Some(SectionPeak { value: stress, s, time });
            }
        }
    }
}

pub(super) fn widen([min, max]: &mut [Vec<f64>; 2], i: usize, least: f64, most: f64) {
    // The first value replaces NaN.
    if least < min[i] || min[i].is_nan() {
        min[i] = least;
    }
    if most > max[i] || max[i].is_nan() {
        max[i] = most;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_next_to_a_node_are_at_it() {
        for (found, given) in
            [(0.0, 0.0), (1.2e-8, 0.0), (0.999_999_6, 1.0), (1.0, 1.0), (0.01, 0.01)]
        {
            assert_eq!(place_of_extreme(found), given);
        }
        // The end of an element is that of its span to the last bit.
        assert_eq!(station(0.1, 0.3, place_of_extreme(0.999_999_9)), 0.3);
    }
}
