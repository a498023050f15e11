//! What must not be at the start of a run: one thing inside another, or right through it.

use super::Model;
use super::fault::Fault;
use super::frozen::ContactData;
use crate::geometry::configuration::Configuration;
use crate::geometry::pair::{Carrier, Memory, Pair, Target};
use crate::geometry::placed::Placed;
use crate::geometry::touch::{Reach, Touch};
use crate::math::vec2::{cross, scale, sub};

/// Penetrations at the start below this share of the bodies' size are round-off.
const TOUCHING: f64 = 1e-9;
/// Straight lines that stand for an element.
const CHORDS: usize = 8;

impl Model {
    /// A fault for each contact `of` those that has one thing inside the other in a configuration: how deep, where, and what would
    /// cure it.
    pub(crate) fn overlaps(
        &self,
        displacement: &[[f64; 4]],
        of: impl Fn(&ContactData) -> bool,
    ) -> Vec<Fault> {
        let at = Configuration::of(displacement);
        let mut faults = Vec::new();
        for contact in self.contacts.iter().filter(|c| of(c)) {
            let depth = |pair: &Pair| {
                let touch = pair.touch(self, &at, &Memory::default(), Reach::All)?;
                (touch.gap < -TOUCHING * self.scale_of(pair))
                    .then_some((touch, pair.source_partner))
            };
            let worst = self.pairs[contact.pairs.clone()].iter().filter_map(depth);
            let worst = worst.min_by(|a, b| a.0.gap.total_cmp(&b.0.gap));
            if let Some((touch, partner)) = worst.or_else(|| self.crossing(contact, &at)) {
                faults.push(overlap(contact, &touch, partner));
            }
        }
        faults
    }

    /// What goes right through a beam between the points at which it could touch: the end of it that is least far through, as a
    /// touch from the other side, and the partner it is of.
    fn crossing(&self, contact: &ContactData, at: &Configuration) -> Option<(Touch, usize)> {
        let pairs = &self.pairs[contact.pairs.clone()];
        let mut polyline: Option<(usize, Vec<[f64; 2]>)> = None;
        let mut last: Option<&Target> = None;
        let crosses = pairs.iter().any(|pair| {
            let beam = pair.movers[0];
            if beam >= self.beams.len() || last == Some(&pair.target) {
                return false;
            }
            last = Some(&pair.target);
            let other = match &pair.target {
                Target::Segment { ends } => ends.map(|end| end.place(at)).to_vec(),
                Target::Axis { beam: onto, .. } if *onto != beam => self.polyline(*onto, at),
                _ => return false,
            };
            if polyline.as_ref().is_none_or(|(of, _)| *of != beam) {
                polyline = Some((beam, self.polyline(beam, at)));
            }
            polyline.as_ref().is_some_and(|(_, own)| cross_each_other(own, &other))
        });
        if !crosses {
            return None;
        }
        let through = |pair: &Pair| {
            let end = match &pair.source.carrier {
                Carrier::Body { .. } => true,
                Carrier::Beam { .. } => pair.at_end,
            };
            let touch = pair.touch(self, at, &Memory::default(), Reach::All).filter(|_| end)?;
            let depth = touch.gap + 2.0 * pair.thickness(self, &touch.memory);
            let back = Touch { gap: -depth, normal: scale(-1.0, touch.normal), ..touch };
            depth.is_finite().then_some((back, pair.source_partner))
        };
        pairs.iter().filter_map(through).max_by(|a, b| a.0.gap.total_cmp(&b.0.gap))
    }

    /// Places along the axis of a beam.
    fn polyline(&self, beam: usize, at: &Configuration) -> Vec<[f64; 2]> {
        let axis = &self.beams[beam].axis;
        let along = axis.iter().flat_map(|element| {
            let placed = Placed::new(element, &self.nodes, at);
            (0..=CHORDS).map(move |k| placed.position(k as f64 / CHORDS as f64))
        });
        along.collect()
    }

    fn scale_of(&self, pair: &Pair) -> f64 {
        match &pair.target {
            Target::Axis { beam, .. } => self.beams[*beam].length.max(pair.reach),
            Target::Guided { .. } => f64::INFINITY, // its standoff is checked by itself
            _ => pair.reach.max(1e-3),
        }
    }
}

/// Whether two polylines cross.
fn cross_each_other(one: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let apart = |a: [f64; 2], b: [f64; 2], line: &[[f64; 2]]| {
        let side = |p: [f64; 2]| cross(sub(b, a), sub(p, a));
        side(line[0]) * side(line[1]) >= 0.0
    };
    one.windows(2).any(|a| other.windows(2).any(|b| !apart(a[0], a[1], b) && !apart(b[0], b[1], a)))
}

/// A length by seven significant digits \[m\].
fn legible(x: f64) -> String {
    let decimals = if x == 0.0 { 0.0 } else { 6.0 - x.abs().log10().floor() };
    let text = format!("{x:.*}", decimals.clamp(1.0, 15.0) as usize);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn overlap(contact: &ContactData, touch: &Touch, partner: usize) -> Fault {
    let depth = -touch.gap;
    let [x, y] = touch.closest_place.map(legible);
    // A little more than enough, so that rounding leaves nothing inside.
    let shift = scale(depth * (1.0 + 1e-6), touch.normal).map(|x| legible(x + 0.0));
    let (inside, of) = (&contact.between[partner], &contact.between[1 - partner]);
    let found = format!("`{inside}` starts {} m inside `{of}`, at [{x}, {y}]", legible(depth));
    let expected = format!(
        "a start without penetration: move `{inside}` by [{}, {}] m, or `{of}` the other way",
        shift[0], shift[1]
    );
    Fault::new(format!("contact.{}.between", contact.name), found, expected)
}
