//! `envelopes.csv`: smallest and largest section forces along every beam, so that the report can be made again from the directory.
//!
//! One row a place, two places an element (its ends). Always CSV: its first column is text, and it is small beside any history.

use std::fmt::Write as _;
use std::path::Path;

use percuss::{Envelope, SectionForceSummary};

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
        let columns = columns(&beam.envelope);
        for row in 0..beam.envelope.s.len() {
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
