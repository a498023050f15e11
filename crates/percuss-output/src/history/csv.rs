//! Histories as CSV: a header line of names, shortest digits that read back to the same number.

use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::path::Path;

use serde_json::{Map, Value, json};

use super::channel::{CSV_UNITS, Channel};
use crate::error::Error;
use crate::{csv_text, files};

/// Rows handed on together.
const ROWS_PER_PIECE: usize = 4096;

/// Writes rows.
#[derive(Debug)]
pub(super) struct CsvSink {
    out: BufWriter<File>,
    /// The line being written, shape (bytes) \[-\].
    line: Vec<u8>,
    columns: usize,
}

impl CsvSink {
    pub(super) fn new(mut out: BufWriter<File>, channels: &[Channel]) -> io::Result<Self> {
        let names: Vec<String> = channels.iter().map(|c| csv_text::quote(&c.name)).collect();
        writeln!(out, "{}", names.join(","))?;
        Ok(Self { out, line: Vec::new(), columns: channels.len() })
    }

    pub(super) fn row(&mut self, values: &[f64]) -> io::Result<()> {
        if values.len() != self.columns {
            return Err(io::Error::other("a row does not match the channels"));
        }
        let mut number = zmij::Buffer::new();
        self.line.clear();
        for &value in values {
            self.line.extend_from_slice(number.format(value).as_bytes());
            self.line.push(b',');
        }
        if let Some(last) = self.line.last_mut() {
            *last = b'\n';
        }
        self.out.write_all(&self.line)
    }

    pub(super) fn close(mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Writes `history.units.json` beside the CSV file.
pub(super) fn write_units(csv: &Path, channels: &[Channel]) -> Result<(), Error> {
    let units: Map<String, Value> = channels
        .iter()
        .map(|c| (c.name.clone(), json!({ "unit": c.unit, "description": c.description })))
        .collect();
    let text = format!("{:#}\n", Value::Object(units));
    files::write(&csv.with_file_name(CSV_UNITS), text.as_bytes())
}

/// Channels, with their units where `history.units.json` is there, and number of rows.
pub(super) fn open(path: &Path) -> Result<(Vec<Channel>, usize), Error> {
    let fault = |e: io::Error| Error::io(path, "read", e);
    let mut file = BufReader::new(File::open(path).map_err(fault)?);
    let mut header = String::new();
    if file.read_line(&mut header).map_err(fault)? == 0 {
        return Err(Error::content(path, "is empty"));
    }
    let mut channels: Vec<Channel> = csv_text::fields(header.trim_end_matches(['\r', '\n']))
        .into_iter()
        .map(|name| Channel { name, ..Channel::default() })
        .collect();
    read_units(path, &mut channels)?;
    let (mut rows, mut last) = (0, b'\n');
    loop {
        let bytes = file.fill_buf().map_err(fault)?;
        let Some(&end) = bytes.last() else { break };
        rows += bytes.iter().filter(|b| **b == b'\n').count();
        last = end;
        let read = bytes.len();
        file.consume(read);
    }
    Ok((channels, rows + usize::from(last != b'\n')))
}

/// Hands the `wanted` columns to `visit` piece by piece.
pub(super) fn scan(
    path: &Path,
    wanted: &[usize],
    visit: &mut dyn FnMut(&[&[f64]]),
) -> Result<(), Error> {
    let fault = |e: io::Error| Error::io(path, "read", e);
    let mut file = BufReader::new(File::open(path).map_err(fault)?);
    let mut line = String::new();
    file.read_line(&mut line).map_err(fault)?;
    let width = csv_text::fields(line.trim_end_matches(['\r', '\n'])).len();
    let mut place_of = vec![None; width];
    wanted.iter().enumerate().for_each(|(place, &k)| place_of[k] = Some(place));
    let mut piece: Vec<Vec<f64>> = vec![Vec::with_capacity(ROWS_PER_PIECE); wanted.len()];
    let mut number = 1;
    loop {
        line.clear();
        let read = file.read_line(&mut line).map_err(fault)?;
        if read == 0 || piece.first().is_some_and(|c| c.len() == ROWS_PER_PIECE) {
            let columns: Vec<&[f64]> = piece.iter().map(Vec::as_slice).collect();
            visit(&columns);
            piece.iter_mut().for_each(Vec::clear);
        }
        if read == 0 {
            return Ok(());
        }
        number += 1;
        parse(&line, &place_of, &mut piece)
            .map_err(|reason| Error::content(path, format!("line {number}{reason}")))?;
    }
}

/// Appends the wanted fields of a line to their columns.
fn parse(line: &str, place_of: &[Option<usize>], piece: &mut [Vec<f64>]) -> Result<(), String> {
    let mut fields = line.split(',');
    for place in place_of {
        let text = fields.next().unwrap_or_default().trim();
        if let Some(place) = place {
            let value = text.parse().map_err(|_| format!(": `{text}` is not a number"))?;
            piece[*place].push(value);
        }
    }
    if fields.next().is_some() {
        return Err(" has more fields than the header".to_owned());
    }
    Ok(())
}

fn read_units(csv: &Path, channels: &mut [Channel]) -> Result<(), Error> {
    let path = csv.with_file_name(CSV_UNITS);
    if !path.is_file() {
        return Ok(());
    }
    let units: Value = serde_json::from_str(&files::read_text(&path)?)
        .map_err(|e| Error::content(&path, e.to_string()))?;
    for channel in channels {
        let about = &units[channel.name.as_str()];
        channel.unit = about["unit"].as_str().unwrap_or_default().to_owned();
        channel.description = about["description"].as_str().unwrap_or_default().to_owned();
    }
    Ok(())
}
