//! `percuss spectrum`.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use percuss_codes::RequestCode;
use percuss_output::HistoryReader;
use percuss_output::shock::{
    Band, Cfc, SPECTRUM_HEADER, ShockError, ShockSpectrum, Signal, accelerations, filtered,
    shock_spectrum,
};
use percuss_pictures::{PrintFormat, is_ours, picture};
use percuss_scenario::one_of;

use super::animate::refuse_foreign;
use super::report::refuse_what_is_no_run;
use crate::number::quantity;
use crate::outcome::{Failure, Status};
use crate::picture_arguments::Spectrum;
use crate::replacing;
use crate::terminal;

/// Writes the spectrum of an acceleration and tells its peaks.
pub fn run(arguments: &Spectrum) -> Result<Status, Failure> {
    refuse_what_is_no_run(&arguments.dir)?;
    let column = arguments.column.trim();
    let mut signal = acceleration(&HistoryReader::open(&arguments.dir)?, column)?;
    if let Some(class) = arguments.cfc {
        signal = filtered(&signal, class).map_err(|error| refused(&error))?;
    }
    let band = Band {
        from: arguments.from,
        to: arguments.to,
        per_octave: f64::from(arguments.per_octave),
    };
    let spectrum =
        shock_spectrum(&signal, arguments.damping, &band).map_err(|error| refused(&error))?;
    let table = arguments.out.clone().unwrap_or_else(|| format!("{column}-spectrum.csv").into());
    let drawn = picture_beside(&table)?;
    if !is_spectrum(&table) {
        refuse_foreign(&table, arguments.force)?;
    }
    refuse_foreign(&drawn, arguments.force)?;
    let title = format!("{column}{}, damping {}", suffix(arguments.cfc), arguments.damping);
    let svg = picture(&spectrum.svg(&title), PrintFormat::Svg, 96.0)?;
    for (path, bytes) in [(&table, spectrum.csv().as_bytes()), (&drawn, &svg[..])] {
        let may_go = |there: &Path| arguments.force || is_spectrum(there) || is_ours(there);
        replacing::put(path, bytes, &may_go)?;
    }
    if !arguments.quiet {
        terminal::print(&description(&signal, &spectrum, arguments.cfc))?;
        terminal::tell(&format!("{}\n{}", table.display(), drawn.display()));
    }
    Ok(Status::Done)
}

/// ` (CFC 180)` behind what was filtered.
fn suffix(class: Option<Cfc>) -> String {
    class.map_or_else(String::new, |class| format!(" (CFC {})", class.number()))
}

/// An acceleration that cannot be judged as it was asked to.
pub fn refused(error: &ShockError) -> Failure {
    Failure::input(RequestCode::Acceleration, error.to_string())
}

/// The acceleration of that name.
fn acceleration(history: &HistoryReader, column: &str) -> Result<Signal, Failure> {
    let known = accelerations(history.channels());
    let Some(found) = known.iter().find(|one| one.name == column) else {
        let is_column = history.channels().iter().any(|channel| channel.name == column);
        let what = if is_column { "is no acceleration" } else { "the run has no such column" };
        let expected = match known.is_empty() {
            true => "it has no accelerations at all; record points under [record]".to_owned(),
            false => {
                format!("expected {}", one_of(column, known.iter().map(|one| one.name.as_str())))
            }
        };
        return Err(Failure::input(
            RequestCode::Acceleration,
            format!("{column}: {what}; {expected}"),
        ));
    };
    if let Some(why) = found.misleads() {
        return Err(Failure::input(RequestCode::Acceleration, why));
    }
    let columns = history.columns(&["time", &found.velocity])?;
    Signal::from_velocity(&columns[0], &columns[1]).map_err(|error| refused(&error))
}

/// The picture's file beside the table's.
fn picture_beside(table: &Path) -> Result<PathBuf, Failure> {
    let drawn = table.with_extension(match table.extension() {
        Some(ending) if ending != "csv" => {
            let text = format!("{}: expected a name that ends with .csv", table.display());
            return Err(Failure::input(RequestCode::FileName, text));
        }
        _ => "svg",
    });
    Ok(drawn)
}

/// Whether a file begins as spectra do.
fn is_spectrum(path: &Path) -> bool {
    let mut line = String::new();
    let read = |file: File| BufReader::new(file.take(4096)).read_line(&mut line);
    path.is_file() && File::open(path).and_then(read).is_ok() && line.trim_end() == SPECTRUM_HEADER
}

/// Peaks of the signal and of its spectrum.
fn description(signal: &Signal, spectrum: &ShockSpectrum, class: Option<Cfc>) -> String {
    let mut text = String::new();
    if signal.resampled {
        text += &format!(
            "non-uniform output interval: velocities interpolated linearly, step {}\n",
            quantity(signal.step, "s")
        );
    }
    if let Some((peak, time)) = signal.peak() {
        let (peak, time) = (quantity(peak, "m/s^2"), quantity(time, "s"));
        text += &format!("peak acceleration {peak} at t = {time}{}\n", suffix(class));
    }
    let answers = spectrum.frequency.iter().zip(&spectrum.acceleration);
    let largest = answers.max_by(|a, b| a.1.maximax().total_cmp(&b.1.maximax()));
    if let Some((frequency, answer)) = largest {
        text += &format!(
            "peak of the spectrum {} at {} (range {} to {}, damping {}){}\n",
            quantity(answer.maximax(), "m/s^2"),
            quantity(*frequency, "Hz"),
            quantity(spectrum.frequency[0], "Hz"),
            quantity(spectrum.frequency[spectrum.frequency.len() - 1], "Hz"),
            spectrum.damping,
            suffix(class),
        );
    }
    text
}
