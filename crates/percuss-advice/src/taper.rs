//! Sections that vary along a beam, between stations too far apart.

use super::words::digits;
use super::{Advice, Topic, Verdict};
use percuss::Model;
use percuss::inspect::SectionConstants;

/// Shares by which a second moment of area is too large that are worth a note, and a warning.
const SHARES: [f64; 2] = [0.03, 0.1];
/// Slopes of straight lines agree within this share.
const STRAIGHT: f64 = 1e-6;

/// A station: arc length \[m\], bending stiffness, axial stiffness, half depth.
type Station = [f64; 4];

/// Beams whose bending stiffness is a straight line where the size of the section is one.
///
/// Between stations area and second moment of area vary linearly. Where it is the depth that does, I goes with its third power (of a
/// width alone with its first, of a circle with the fourth) and lies below the chord: with `I ~ x^n`, n from both ends, by
/// `(I1 + I2)/2 / I((x1 + x2)/2) - 1` in the middle.
pub fn findings(model: &Model) -> Vec<Advice> {
    let all = (0..model.beam_count()).map(|index| model.beam(index)).filter_map(|beam| {
        let mut worst: Option<[f64; 3]> = None;
        for span in beam.spans().filter(|span| span.varies()) {
            let stations: Vec<Station> = (0..=span.element_count())
                .map(|k| {
                    let last = usize::from(k == span.element_count());
                    station(span.stations()[k], &span.end_sections(k - last)[last])
                })
                .collect();
            for [a, b] in stretches(&stations) {
                let share = excess(&a, &b);
                if share > worst.map_or(SHARES[0], |w| w[0]) {
                    worst = Some([share, a[0], b[0]]);
                }
            }
        }
        worst.map(|found| advice(beam.name(), found))
    });
    all.collect()
}

fn station(s: f64, section: &SectionConstants) -> Station {
    [s, section.bending, section.axial, section.half_depth]
}

/// Ends of the stretches over which the bending stiffness is a straight line.
fn stretches(stations: &[Station]) -> Vec<[Station; 2]> {
    let slope =
        |k: usize| (stations[k + 1][1] - stations[k][1]) / (stations[k + 1][0] - stations[k][0]);
    let mut all = Vec::new();
    let mut start = 0;
    for k in 1..stations.len() {
        let goes_on = k + 1 < stations.len() && {
            let scale = slope(k - 1).abs().max(slope(k).abs());
            (slope(k) - slope(k - 1)).abs() <= STRAIGHT * scale
        };
        if !goes_on {
            all.push([stations[start], stations[k]]);
            start = k;
        }
    }
    all
}

/// How much larger the chord is in the middle than a section whose size varies linearly; zero where nothing tells a size.
fn excess(a: &Station, b: &Station) -> f64 {
    let ratio = b[1] / a[1];
    // The depth tells the size; without one the area, of a rectangle of constant width.
    let known = [a[3], b[3]].iter().all(|h| *h > 0.0);
    let size = if known { b[3] / a[3] } else { b[2] / a[2] };
    if (size - 1.0).abs() < 1e-6 || !(ratio > 0.0 && size > 0.0) {
        return 0.0;
    }
    let power = ratio.ln() / size.ln();
    0.5 * (1.0 + ratio) / (0.5 * (1.0 + size)).powf(power) - 1.0
}

fn advice(beam: &str, [share, from, to]: [f64; 3]) -> Advice {
    let text = format!(
        "second moment of area interpolated linearly between the stations s = {} m and {} m; up to {} % too large if the depth varies \
         linearly: add stations",
        digits(from),
        digits(to),
        digits(100.0 * share)
    );
    let verdict = if share < SHARES[1] { Verdict::Note } else { Verdict::Warning };
    let contact = format!("beam {beam}");
    Advice::new(contact, Topic::Taper, [share, SHARES[0]], "1", verdict, text)
}

#[cfg(test)]
mod tests {
    use super::super::formulas::near;
    use super::*;

    /// Depth from h to 2 h: I from 1 to 8, 4.5 in the middle of the chord, 3.375 by the depth.
    #[test]
    fn a_chord_lies_above_the_cube_of_the_depth() {
        near(excess(&[0.0, 1.0, 1.0, 1.0], &[1.0, 8.0, 2.0, 2.0]), 4.5 / 3.375 - 1.0, 1e-12);
        // The same by the area; and a width that varies, which is a straight line.
        near(
            excess(&[0.0, 1.0, 1.0, f64::NAN], &[1.0, 8.0, 2.0, f64::NAN]),
            4.5 / 3.375 - 1.0,
            1e-12,
        );
        assert!(excess(&[0.0, 1.0, 1.0, 1.0], &[1.0, 2.0, 2.0, 1.0]).abs() < 1e-12);
        assert!(excess(&[0.0, 1.0, 1.0, f64::NAN], &[1.0, 2.0, 2.0, f64::NAN]).abs() < 1e-12);
    }

    #[test]
    fn stations_between_end_a_stretch() {
        let all = [
            [0.0, 1.0, 1.0, 1.0],
            [1.0, 2.0, 1.0, 1.0],
            [2.0, 3.0, 1.0, 1.0],
            [3.0, 7.0, 1.0, 1.0],
        ];
        assert_eq!(stretches(&all).len(), 2);
    }
}
