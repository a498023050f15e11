//! `envelopes.csv`: smallest and largest section forces along every beam, so that the report can be made again from the directory.
//!
//! One row a place: ends and middle of every element, and where a section force or stress of the beam is largest or smallest. Always CSV: its
//! first column is text, and it is small beside any history.

use std::fmt::Write as _;
use std::path::Path;

use percuss::{Envelope, SectionForceSummary, SectionPeak, SectionRange};

use crate::csv_text;
use crate::error::Error;
use crate::files;

const ENVELOPES: &str = "envelopes.csv";
const HEADER: &str =
    "beam,s,axial_min,axial_max,shear_min,shear_max,moment_min,moment_max,stress_min,stress_max";
/// Numbers in a row.
const NUMBERS: usize = 9;

/// Extremes along a beam.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BeamEnvelope {
    /// The beam's name.
    pub name: String,
    /// Smallest and largest values along it, SI.
    pub envelope: Envelope,
}

/// Writes `envelopes.csv` into `dir`; SI units, NaN where there is no value.
///
/// # Errors
/// If the file cannot be written.
pub fn write_envelopes(dir: impl AsRef<Path>, beams: &[SectionForceSummary]) -> Result<(), Error> {
    let mut text = format!("{HEADER}\n");
    let mut number = zmij::Buffer::new();
    for beam in beams {
        let name = csv_text::quote(&beam.name);
        let envelope = through_extremes(beam);
        let columns = columns(&envelope);
        for row in 0..envelope.s.len() {
            text.push_str(&name);
            for column in columns {
                let value = column.get(row).copied().unwrap_or(f64::NAN);
                let _ = write!(text, ",{}", number.format(value)); // a String never fails
            }
            text.push('\n');
        }
    }
    files::write(&dir.as_ref().join(ENVELOPES), text.as_bytes())
}

/// Extremes along a beam, with its largest and smallest values where they are between places: a force that acts inside an element has its
/// corner there. What is not an extreme at such a place is on the straight line between its neighbours.
fn through_extremes(beam: &SectionForceSummary) -> Envelope {
    let mut e = beam.envelope.clone();
    let ranges = [&beam.axial, &beam.shear, &beam.moment, &beam.stress];
    let peaks = |range: &SectionRange| [range.min, range.max];
    for (k, peak) in ranges.map(peaks).as_flattened().iter().enumerate() {
        if peak.value.is_finite() && e.s.len() > 1 {
            // Columns in the order of the header, behind that of the arc length.
            let column = columns(&e)[1 + k];
            if column.len() == e.s.len() && !has(&e.s, column, peak) {
                insert(&mut e, 1 + k, peak);
            }
        }
    }
    e
}

/// Whether a value is known at its place.
fn has(s: &[f64], column: &[f64], peak: &SectionPeak) -> bool {
    s.iter().zip(column).any(|(at, value)| *at == peak.s && *value == peak.value)
}

fn insert(e: &mut Envelope, which: usize, peak: &SectionPeak) {
    let at = e.s.partition_point(|s| *s < peak.s).clamp(1, e.s.len() - 1);
    let (a, b) = (e.s[at - 1], e.s[at]);
    let share = if b > a { ((peak.s - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 };
    for (k, column) in columns_mut(e).into_iter().enumerate().filter(|(_, c)| !c.is_empty()) {
        let value = match k {
            0 => peak.s,
            _ if k == which => peak.value,
            _ => (1.0 - share) * column[at - 1] + share * column[at],
        };
        column.insert(at, value);
    }
}

/// Reads `envelopes.csv` in `dir`; nothing if there is none.
///
/// # Errors
/// If the file is damaged.
pub fn read_envelopes(dir: impl AsRef<Path>) -> Result<Vec<BeamEnvelope>, Error> {
    let mut all: Vec<BeamEnvelope> = Vec::new();
    let path = dir.as_ref().join(ENVELOPES);
    csv_text::for_each_named(&path, HEADER, |name, numbers: [f64; NUMBERS]| {
        if all.last().is_none_or(|last| last.name != name) {
            all.push(BeamEnvelope { name: name.to_owned(), ..Default::default() });
        }
        if let Some(beam) = all.last_mut() {
            let columns = columns_mut(&mut beam.envelope);
            columns.into_iter().zip(numbers).for_each(|(column, number)| column.push(number));
        }
    })?;
    Ok(all)
}

/// Columns in the order of the header.
fn columns(e: &Envelope) -> [&Vec<f64>; NUMBERS] {
    let ([a, b], [c, d], [f, g], [h, i]) = (&e.axial, &e.shear, &e.moment, &e.stress);
    [&e.s, a, b, c, d, f, g, h, i]
}

fn columns_mut(e: &mut Envelope) -> [&mut Vec<f64>; NUMBERS] {
    let ([a, b], [c, d], [f, g], [h, i]) =
        (&mut e.axial, &mut e.shear, &mut e.moment, &mut e.stress);
    [&mut e.s, a, b, c, d, f, g, h, i]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two elements, a corner of the moment at 0.3 m inside the first, and its smallest value at a place that is known.
    #[test]
    fn an_envelope_goes_through_the_extremes_between_its_places() {
        let places = vec![0.0, 0.5, 1.0, 1.0, 1.5, 2.0];
        let column = || vec![0.0; 6];
        let moment = [vec![0.0, -1.0, 0.0, 0.0, 0.0, 0.0], vec![0.0, 5.0, 4.0, 4.0, 2.0, 0.0]];
        let [axial, shear] = [[column(), column()], [column(), vec![6.0; 6]]];
        let peak = |value: f64, s: f64| SectionPeak { value, s, time: 0.1 };
        let range = |min: SectionPeak, max: SectionPeak| SectionRange { min, max };
        let none = SectionRange::default();
        let beam = SectionForceSummary {
            name: "b".to_owned(),
            axial: range(peak(0.0, 0.0), peak(0.0, 0.0)),
            shear: range(peak(0.0, 0.0), peak(6.0, 2.0)),
            moment: range(peak(-1.0, 0.5), peak(7.0, 0.3)),
            strain: none,
            stress: none,
            shear_stress: none,
            von_mises_inside: SectionPeak::default(),
            beyond: None,
            beyond_inside: None,
            excess: None,
            plateau: None,
            envelope: Envelope { s: places, axial, shear, moment, stress: Default::default() },
        };
        let e = through_extremes(&beam);
        assert_eq!(e.s, [0.0, 0.3, 0.5, 1.0, 1.0, 1.5, 2.0]);
        assert_eq!(e.moment[1], [0.0, 7.0, 5.0, 4.0, 4.0, 2.0, 0.0]);
        assert_eq!(e.moment[0], [0.0, -0.6, -1.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(e.shear[1], [6.0; 7]);
    }
}
