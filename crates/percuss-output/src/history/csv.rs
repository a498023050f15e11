//! Histories as CSV: a header line of names, shortest digits that read back to the same number.

use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::path::Path;

use serde_json::{Map, Value, json};

use super::{CSV_UNITS, Channel, History};
use crate::error::Error;
use crate::{csv_text, files};

/// Writes rows.
#[derive(Debug)]
pub(super) struct CsvSink {
    out: BufWriter<File>,
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

/// Reads a CSV history, with its units where `history.units.json` is there.
pub(super) fn read(path: &Path) -> Result<History, Error> {
    let file = File::open(path).map_err(|e| Error::io(path, "read", e))?;
    let mut lines = BufReader::new(file).lines();
    let header = match lines.next() {
        Some(line) => line.map_err(|e| Error::io(path, "read", e))?,
        None => return Err(Error::content(path, "is empty")),
    };
    let mut channels: Vec<Channel> = csv_text::fields(&header)
        .into_iter()
        .map(|name| Channel { name, ..Channel::default() })
        .collect();
    read_units(path, &mut channels)?;
    let mut columns = vec![Vec::new(); channels.len()];
    for (number, line) in lines.enumerate() {
        let line = line.map_err(|e| Error::io(path, "read", e))?;
        let place = number + 2;
        let mut fields = line.split(',');
        for column in &mut columns {
            let text = fields.next().unwrap_or_default().trim();
            let value: f64 = text.parse().map_err(|_| {
                Error::content(path, format!("line {place}: `{text}` is not a number"))
            })?;
            column.push(value);
        }
        if fields.next().is_some() {
            let reason = format!("line {place} has more fields than the header");
            return Err(Error::content(path, reason));
        }
    }
    Ok(History { channels, columns, source: super::CSV.to_owned() })
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
