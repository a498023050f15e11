//! Section forces of all elements as polylines, for drawings: through what they are, the jumps and corners at forces inside elements and the
//! largest values included.

use super::between::RISES;
use super::element::{ElementForces, PLACES};
use super::line::SectionForces;
use super::lines::Lines;
use super::screen::{BeamExtremes, may_exceed_between};
use crate::frame::SectionPoint;
use crate::model::Model;
use crate::summary::SectionForceSummary;

/// A chord may miss the curve by about this share of the largest value so far: a quarter of a pixel of a diagram of 46 pixels.
const MISSED: f64 = 5e-3;
/// Parts of a piece between two forces at most: two to the power of this.
const HALVINGS: usize = 4;

/// What the polylines of a frame know.
struct Drawn<'a> {
    /// Deviations of a chord from the curve that are seen, shape (3) \[N, N, N m\].
    seen: [f64; 3],
    /// Least and largest so far in this frame, shape (3, 2) \[N, N, N m\].
    known: BeamExtremes<f64>,
    /// The vertices so far, shape (vertices).
    out: &'a mut Vec<SectionPoint>,
}

/// A place of an element, and its section forces on the side that is meant.
type ForcesAt = (f64, SectionForces);

impl Lines {
    /// Vertices of the section forces of all elements, in their order: both ends of each element, both sides of every force inside, as
    /// many between as the curve needs beside the largest values of a run or equilibrium so far, and where they are largest.
    pub fn vertices(
        &self,
        model: &Model,
        so_far: &[SectionForceSummary],
        out: &mut Vec<SectionPoint>,
    ) {
        out.clear();
        let most = |of: fn(&SectionForceSummary) -> f64| {
            so_far.iter().map(of).filter(|value| value.is_finite()).fold(0.0, f64::max)
        };
        // Axial and shear forces are measured by each other: alone they might be round-off.
        let force = most(|b| b.axial.largest().value.abs().max(b.shear.largest().value.abs()));
        let moment = most(|b| b.moment.largest().value.abs());
        let seen = [force, force, moment].map(|size| MISSED * size);
        let mut drawn = Drawn { seen, known: [[0.0; 2]; 3], out };
        for (span, k, _, element) in model.each_element() {
            let (line, inner) = self.of(element);
            let piece = ElementForces::elastic(span, k, line, inner, false);
            drawn.element(&piece, element);
        }
    }
}

impl Drawn<'_> {
    fn element(&mut self, piece: &ElementForces<'_>, element: usize) {
        let mut from = PLACES[0];
        while from < 1.0 {
            let to = piece.next_stop(from, &[]);
            let ahead = (from, piece.line.at(from, piece.inner, true));
            let behind = (to, piece.line.at(to, piece.inner, false));
            self.push(piece, element, &ahead);
            self.between(piece, element, [&ahead, &behind], HALVINGS);
            self.push(piece, element, &behind);
            from = to;
        }
    }

    /// The vertices strictly between two places with nothing between them.
    fn between(
        &mut self,
        piece: &ElementForces<'_>,
        element: usize,
        [a, b]: [&ForcesAt; 2],
        halvings: usize,
    ) {
        if halvings > 0 && self.is_bent(a, b) {
            let xi = 0.5 * (a.0 + b.0);
            let middle = (xi, piece.line.at(xi, piece.inner, false));
            self.between(piece, element, [a, &middle], halvings - 1);
            self.push(piece, element, &middle);
            self.between(piece, element, [&middle, b], halvings - 1);
            return;
        }
        let wanted = may_exceed_between([&a.1, &b.1], b.0 - a.0, &self.known);
        let mut crests: Vec<ForcesAt> = Vec::new();
        for (of, _) in RISES.into_iter().zip(wanted).filter(|(_, wanted)| *wanted) {
            let ends = [(a.0, of(&a.1.rise)), (b.0, of(&b.1.rise))];
            if ends[0].1 * ends[1].1 < 0.0 {
                let xi = piece.line.stationary(ends, piece.inner, of);
                crests.push((xi, piece.line.at(xi, piece.inner, false)));
            }
        }
        crests.sort_by(|one, other| one.0.total_cmp(&other.0));
        crests.iter().for_each(|crest| self.push(piece, element, crest));
    }

    /// Whether the chord between two places misses the cubic of the values and rises there by more than is seen.
    fn is_bent(&self, (from, a): &ForcesAt, (to, b): &ForcesAt) -> bool {
        let apart = to - from;
        (0..3).any(|i| {
            let chord = values(b)[i] - values(a)[i];
            let off = |of: &SectionForces| (apart * RISES[i](&of.rise) - chord).abs() / 3.0;
            // A cubic whose control points are as far from the chord is nowhere farther than three quarters of it.
            0.75 * off(a).max(off(b)) > self.seen[i]
        })
    }

    fn push(&mut self, piece: &ElementForces<'_>, element: usize, (xi, at): &ForcesAt) {
        let forces = values(at);
        for (range, value) in self.known.iter_mut().zip(forces) {
            *range = [range[0].min(value), range[1].max(value)];
        }
        self.out.push(SectionPoint { element, s: piece.s(*xi), forces });
    }
}

fn values(at: &SectionForces) -> [f64; 3] {
    [at.axial, at.shear, at.moment]
}
