//! Extremes of section forces and stresses between the places at which every element is looked at.

use super::element::{ElementForces, PLACES, station};
use super::fibres::Fibres;
use super::line::{Rise, SAME_PLACE, SectionForces};
use super::screen::{depth_of, extremes, may_exceed_between, stress_may_exceed};
use crate::summary::SectionForceSummary;

/// Pieces in which extremes between two places are looked for.
const PIECES: usize = 4;

/// Derivatives of axial force, shear force and moment.
pub(super) const RISES: [fn(&Rise) -> f64; 3] =
    [|rise| rise.axial, |rise| rise.shear, |rise| rise.moment];

impl ElementForces<'_> {
    /// Takes section forces where they are largest between two places.
    pub(super) fn take_between_places(
        &self,
        out: &mut SectionForceSummary,
        places: &[SectionForces; 3],
        time: f64,
    ) {
        for j in 1..PLACES.len() {
            let ends = [&places[j - 1], &places[j]];
            self.take_within(out, [PLACES[j - 1], PLACES[j]], ends, time);
        }
    }

    /// The next place from one on at which a force acts inside, or of these; those next to it are the same place.
    pub(super) fn next_stop(&self, from: f64, places: &[f64]) -> f64 {
        let stops = self.inner.iter().map(|one| one.xi).chain(places.iter().copied());
        let to = stops.filter(|xi| *xi > from + SAME_PLACE).fold(1.0, f64::min);
        if to > 1.0 - SAME_PLACE { 1.0 } else { to }
    }

    /// Takes what is behind and ahead of every force inside, and where section forces are largest between them.
    pub(super) fn take_between_forces(&self, out: &mut SectionForceSummary, time: f64) {
        let mut from = 0.0;
        let mut ahead = self.line.at(from, self.inner, true);
        while from < 1.0 {
            let to = self.next_stop(from, &PLACES);
            let behind = self.line.at(to, self.inner, false);
            self.take_within(out, [from, to], [&ahead, &behind], time);
            self.take_at(out, to, &behind, time);
            ahead = self.line.at(to, self.inner, true);
            self.take_at(out, to, &ahead, time);
            from = to;
        }
    }

    /// Takes axial force, shear force and moment, and the stress, where they may be largest between two places with nothing inside: in
    /// pieces, for each may turn more than once. What is known at both places is not asked for again.
    fn take_within(
        &self,
        out: &mut SectionForceSummary,
        [from, to]: [f64; 2],
        ends: [&SectionForces; 2],
        time: f64,
    ) {
        let known = [&out.axial, &out.shear, &out.moment].map(extremes);
        let wanted = may_exceed_between(ends, to - from, &known);
        let stressed = self.has_fibres() && {
            let depth = [from, to].map(|xi| depth_of(&self.span.section_at(self.k, xi)));
            stress_may_exceed(ends, to - from, depth, &extremes(&out.stress))
        };
        if !stressed && wanted == [false; 3] {
            return;
        }
        let at: [f64; PIECES + 1] =
            std::array::from_fn(|k| station(from, to, k as f64 / PIECES as f64));
        let forces: [SectionForces; PIECES + 1] = std::array::from_fn(|k| match k {
            0 => *ends[0],
            PIECES => *ends[1],
            _ => self.line.at(at[k], self.inner, false),
        });
        for (of, _) in RISES.into_iter().zip(wanted).filter(|(_, wanted)| *wanted) {
            for k in 1..=PIECES {
                let [a, b] = [k - 1, k].map(|k| (at[k], of(&forces[k].rise)));
                if a.1 * b.1 < 0.0 {
                    let xi = self.line.stationary([a, b], self.inner, of);
                    self.take_at(out, xi, &self.line.at(xi, self.inner, false), time);
                }
            }
        }
        if stressed {
            self.take_stresses(out, &at, &forces, time);
        }
    }

    /// Takes stresses at places as far apart, and at the crest of the parabola through the largest and the least of them.
    fn take_stresses(
        &self,
        out: &mut SectionForceSummary,
        at: &[f64; PIECES + 1],
        forces: &[SectionForces; PIECES + 1],
        time: f64,
    ) {
        let seen: [Option<Fibres>; PIECES + 1] =
            std::array::from_fn(|k| self.fibres(at[k], &forces[k]));
        for (fibres, xi) in seen.iter().zip(at) {
            if let Some(fibres) = fibres {
                self.take_fibres(out, *xi, fibres, time);
            }
        }
        for side in 0..2 {
            let sign = if side == 0 { -1.0 } else { 1.0 };
            let value = |k: usize| seen[k].map_or(f64::NAN, |f| sign * f.stress[side]);
            let most = (1..=PIECES).fold(0, |m, k| if value(k) > value(m) { k } else { m });
            let middle = most.clamp(1, PIECES - 1);
            let [a, b, c] = [middle - 1, middle, middle + 1].map(value);
            let way = 0.5 * (a - c) / (a - 2.0 * b + c);
            if a - 2.0 * b + c < 0.0 && way.abs() < 1.0 {
                let xi = at[middle] + way * (at[1] - at[0]);
                let crest = self.line.at(xi, self.inner, false);
                if let Some(fibres) = self.fibres(xi, &crest) {
                    self.take_fibres(out, xi, &fibres, time);
                }
            }
        }
    }
}
