//! Histories as Parquet: doubles in byte-stream-split pages under snappy, units and scenario in the
//! file's key-value metadata (`percuss.channels`, `percuss.scenario`, `percuss.version`).

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, Encoding, Repetition, Type as PhysicalType};
use parquet::column::reader::get_typed_column_reader;
use parquet::data_type::DoubleType;
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};
use serde_json::{Value, json};

use super::channel::Channel;
use crate::error::Error;

/// Values held in memory before a row group is written (16 MB).
const VALUES_PER_GROUP: usize = 1 << 21;
/// Rows put aside before they are sorted into columns, few enough for the first-level cache.
const ROWS_ASIDE: usize = 64;
/// Rows read together.
const ROWS_PER_PIECE: usize = 1 << 13;

/// Writes rows.
pub(super) struct ParquetSink {
    writer: SerializedFileWriter<File>,
    /// Rows put aside, shape (up to ROWS_ASIDE, n_columns) \[unit of the column\].
    aside: Vec<f64>,
    /// Row group being filled, one entry a column, shape (columns, rows) \[unit of the column\].
    columns: Vec<Vec<f64>>,
    rows_per_group: usize,
}

impl std::fmt::Debug for ParquetSink {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ParquetSink").field("columns", &self.columns.len()).finish_non_exhaustive()
    }
}

impl ParquetSink {
    pub(super) fn new(file: File, channels: &[Channel], scenario: &str) -> Result<Self> {
        let writer = SerializedFileWriter::new(
            file,
            schema(channels)?,
            Arc::new(properties(channels, scenario)),
        )?;
        let n = channels.len().max(1);
        let rows_per_group = (VALUES_PER_GROUP / n).max(ROWS_ASIDE).next_multiple_of(ROWS_ASIDE);
        Ok(Self {
            writer,
            aside: Vec::with_capacity(ROWS_ASIDE * n),
            columns: vec![Vec::new(); channels.len()],
            rows_per_group,
        })
    }

    pub(super) fn row(&mut self, values: &[f64]) -> Result<()> {
        if values.len() != self.columns.len() {
            return Err(ParquetError::General("a row does not match the channels".to_owned()));
        }
        self.aside.extend_from_slice(values);
        if self.aside.len() == ROWS_ASIDE * self.columns.len() {
            self.sort_aside();
            if self.columns.first().is_some_and(|c| c.len() >= self.rows_per_group) {
                self.write_group()?;
            }
        }
        Ok(())
    }

    pub(super) fn close(mut self) -> Result<()> {
        self.sort_aside();
        if self.columns.first().is_some_and(|c| !c.is_empty()) {
            self.write_group()?;
        }
        self.writer.close().map(|_| ())
    }

    fn sort_aside(&mut self) {
        let n = self.columns.len();
        for (k, column) in self.columns.iter_mut().enumerate() {
            column.extend(self.aside.iter().skip(k).step_by(n));
        }
        self.aside.clear();
    }

    fn write_group(&mut self) -> Result<()> {
        let mut group = self.writer.next_row_group()?;
        for column in &mut self.columns {
            let mut writer = group.next_column()?.ok_or_else(|| {
                ParquetError::General("fewer columns in the schema than channels".to_owned())
            })?;
            writer.typed::<DoubleType>().write_batch(column, None, None)?;
            writer.close()?;
            column.clear();
        }
        group.close().map(|_| ())
    }
}

fn schema(channels: &[Channel]) -> Result<TypePtr> {
    let field = |channel: &Channel| {
        Type::primitive_type_builder(&channel.name, PhysicalType::DOUBLE)
            .with_repetition(Repetition::REQUIRED)
            .build()
            .map(Arc::new)
    };
    let fields = channels.iter().map(field).collect::<Result<Vec<_>>>()?;
    Ok(Arc::new(Type::group_type_builder("history").with_fields(fields).build()?))
}

fn properties(channels: &[Channel], scenario: &str) -> WriterProperties {
    let about: Vec<Value> = channels
        .iter()
        .map(|c| json!({ "name": c.name, "unit": c.unit, "description": c.description }))
        .collect();
    let entry = |key: &str, value: String| KeyValue { key: key.to_owned(), value: Some(value) };
    WriterProperties::builder()
        .set_created_by(format!("percuss {}", env!("CARGO_PKG_VERSION")))
        .set_key_value_metadata(Some(vec![
            entry("percuss.channels", Value::Array(about).to_string()),
            entry("percuss.scenario", scenario.to_owned()),
            entry("percuss.version", env!("CARGO_PKG_VERSION").to_owned()),
        ]))
        .set_dictionary_enabled(false)
        .set_encoding(Encoding::BYTE_STREAM_SPLIT)
        .set_compression(Compression::SNAPPY)
        .set_statistics_enabled(EnabledStatistics::None)
        .set_data_page_size_limit(1 << 17)
        .set_data_page_row_count_limit(usize::MAX)
        .set_write_batch_size(1 << 13)
        .set_max_row_group_row_count(None)
        .build()
}

/// What the library says, without the heading of its kind of error.
pub(super) fn reason(error: &ParquetError) -> String {
    let text = error.to_string();
    text.strip_prefix("External: ").unwrap_or(&text).to_owned()
}

fn reader(path: &Path) -> std::result::Result<SerializedFileReader<File>, Error> {
    let file = File::open(path).map_err(|e| Error::io(path, "read", e))?;
    SerializedFileReader::new(file).map_err(|e| fault(path, &e))
}

fn fault(path: &Path, source: &ParquetError) -> Error {
    Error::content(path, format!("cannot be read: {}", reason(source)))
}

/// Channels and number of rows.
pub(super) fn open(path: &Path) -> std::result::Result<(Vec<Channel>, usize), Error> {
    let reader = reader(path)?;
    let metadata = reader.metadata().file_metadata();
    let about = metadata
        .key_value_metadata()
        .and_then(|all| all.iter().find(|entry| entry.key == "percuss.channels"))
        .and_then(|entry| serde_json::from_str::<Value>(entry.value.as_deref()?).ok())
        .unwrap_or_default();
    let columns = metadata.schema_descr().columns();
    if columns.iter().any(|c| c.physical_type() != PhysicalType::DOUBLE) {
        return Err(Error::content(path, "has a column that does not hold doubles"));
    }
    let channels = columns.iter().map(|c| channel(c.name(), &about)).collect();
    Ok((channels, usize::try_from(metadata.num_rows()).unwrap_or(0)))
}

/// Hands the `wanted` columns to `visit` piece by piece.
pub(super) fn scan(
    path: &Path,
    wanted: &[usize],
    visit: &mut dyn FnMut(&[&[f64]]),
) -> std::result::Result<(), Error> {
    let fault = |e: ParquetError| fault(path, &e);
    let file = reader(path)?;
    let mut piece: Vec<Vec<f64>> = vec![Vec::with_capacity(ROWS_PER_PIECE); wanted.len()];
    for group in 0..file.num_row_groups() {
        let group = file.get_row_group(group).map_err(fault)?;
        let mut left = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        let pages = |&k: &usize| {
            Ok(get_typed_column_reader::<DoubleType>(group.get_column_reader(k).map_err(fault)?))
        };
        let mut columns =
            wanted.iter().map(pages).collect::<std::result::Result<Vec<_>, Error>>()?;
        while left > 0 {
            let rows = left.min(ROWS_PER_PIECE);
            for (values, column) in piece.iter_mut().zip(&mut columns) {
                values.clear();
                column.read_records(rows, None, None, values).map_err(fault)?;
                if values.len() != rows {
                    return Err(Error::content(path, "has a column shorter than its row group"));
                }
            }
            let slices: Vec<&[f64]> = piece.iter().map(Vec::as_slice).collect();
            visit(&slices);
            left -= rows;
        }
    }
    Ok(())
}

fn channel(name: &str, about: &Value) -> Channel {
    let entry = about.as_array().and_then(|all| all.iter().find(|c| c["name"] == name));
    let text = |key: &str| entry.and_then(|c| c[key].as_str()).unwrap_or_default().to_owned();
    Channel { name: name.to_owned(), unit: text("unit"), description: text("description") }
}
