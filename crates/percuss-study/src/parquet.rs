//! Tables of a study as Parquet: numbers byte-stream-split, units and the study itself in the file's metadata.

use std::io::Write;
use std::sync::Arc;

use bytes::Bytes;
use parquet::basic::{
    Compression, ConvertedType, Encoding, LogicalType, Repetition, Type as Physical,
};
use parquet::column::reader::{ColumnReader, get_typed_column_reader};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type, TypePtr};
use percuss_codes::RequestCode;
use serde_json::{Value, json};

use crate::column::{Column, Table, Values};
use crate::error::Error;
use crate::seal;
use crate::study::Study;

/// Writes the rows of a study, a row group at a time.
pub(crate) struct Writer<W: Write + Send> {
    file: SerializedFileWriter<W>,
}

impl<W: Write + Send> Writer<W> {
    /// Begins a file; `more` goes into its metadata.
    pub fn new(out: W, study: &Study, more: Vec<(&str, String)>) -> Result<Self> {
        Self::with_layout(out, study, study.layout(), more)
    }

    /// Begins a file with columns of its own.
    pub fn with_layout(
        out: W,
        study: &Study,
        layout: Vec<(Column, Values)>,
        more: Vec<(&str, String)>,
    ) -> Result<Self> {
        let properties = Arc::new(properties(study, &layout, more));
        let file = SerializedFileWriter::new(out, schema(&layout)?, properties)?;
        Ok(Self { file })
    }

    /// Writes rows.
    pub fn write(&mut self, values: &[Values]) -> Result<()> {
        let mut group = self.file.next_row_group()?;
        for values in values {
            let missing = || ParquetError::General("fewer columns than values".to_owned());
            let mut column = group.next_column()?.ok_or_else(missing)?;
            match values {
                Values::Whole(values) => {
                    column.typed::<Int64Type>().write_batch(values, None, None)?;
                }
                Values::Number(values) => {
                    column.typed::<DoubleType>().write_batch(values, None, None)?;
                }
                Values::Text(values) => {
                    let bytes = |text: &String| ByteArray::from(text.as_str());
                    let values: Vec<ByteArray> = values.iter().map(bytes).collect();
                    column.typed::<ByteArrayType>().write_batch(&values, None, None)?;
                }
            }
            column.close()?;
        }
        group.close().map(|_| ())
    }

    /// Ends the file.
    pub fn close(self) -> Result<()> {
        self.file.close().map(|_| ())
    }
}

fn schema(layout: &[(Column, Values)]) -> Result<TypePtr> {
    let field = |(column, values): &(Column, Values)| {
        let kind = match values {
            Values::Whole(_) => Physical::INT64,
            Values::Number(_) => Physical::DOUBLE,
            Values::Text(_) => Physical::BYTE_ARRAY,
        };
        let mut field =
            Type::primitive_type_builder(&column.name, kind).with_repetition(Repetition::REQUIRED);
        if kind == Physical::BYTE_ARRAY {
            field = field
                .with_logical_type(Some(LogicalType::String))
                .with_converted_type(ConvertedType::UTF8);
        }
        field.build().map(Arc::new)
    };
    let fields = layout.iter().map(field).collect::<Result<Vec<_>>>()?;
    Ok(Arc::new(Type::group_type_builder("study").with_fields(fields).build()?))
}

fn properties(
    study: &Study,
    layout: &[(Column, Values)],
    more: Vec<(&str, String)>,
) -> WriterProperties {
    let about = |(c, _): &(Column, Values)| json!({ "name": c.name, "unit": c.unit, "role": c.role.name(), "description": c.about });
    let channels: Vec<Value> = layout.iter().map(about).collect();
    let mut metadata = vec![
        ("percuss.channels", Value::Array(channels).to_string()),
        ("percuss.fingerprint", study.fingerprint().to_owned()),
        ("percuss.version", env!("CARGO_PKG_VERSION").to_owned()),
    ];
    metadata.extend(more);
    let entry = |(key, value): (&str, String)| KeyValue { key: key.to_owned(), value: Some(value) };
    let mut builder = WriterProperties::builder()
        .set_created_by(format!("percuss {}", env!("CARGO_PKG_VERSION")))
        .set_key_value_metadata(Some(metadata.into_iter().map(entry).collect()))
        .set_dictionary_enabled(false)
        .set_compression(Compression::SNAPPY)
        .set_statistics_enabled(EnabledStatistics::None)
        .set_max_row_group_row_count(None);
    for (column, values) in layout {
        let path = ColumnPath::new(vec![column.name.clone()]);
        match values {
            Values::Number(_) => {
                builder = builder.set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT);
            }
            Values::Text(_) => builder = builder.set_column_dictionary_enabled(path, true),
            Values::Whole(_) => {}
        }
    }
    builder.build()
}

/// The table of the shard of a number as a file, sealed.
pub(crate) fn shard_bytes(
    index: u64,
    table: &Table,
    study: &Study,
) -> std::result::Result<Vec<u8>, Error> {
    let mut out = Vec::new();
    // The seal comes last, so that it is the last one found.
    let more = vec![("percuss.shard", index.to_string()), ("percuss.seal", seal::open())];
    let write = |out: &mut Vec<u8>| -> Result<()> {
        let mut writer = Writer::new(out, study, more)?;
        writer.write(&table.values)?;
        writer.close()
    };
    let fault = |e: ParquetError| Error::system(format!("shard {index} cannot be written: {e}"));
    write(&mut out).map_err(fault)?;
    seal::close(&mut out);
    Ok(out)
}

/// The number and the table of the shard in a file, if it is whole and of this study.
pub(crate) fn shard_from(bytes: &[u8], study: &Study) -> std::result::Result<(u64, Table), Error> {
    if !seal::holds(bytes) {
        return Err(unfit("the shard is damaged"));
    }
    let damaged = |e: ParquetError| unfit(format!("the shard cannot be read: {e}"));
    let reader = SerializedFileReader::new(Bytes::copy_from_slice(bytes)).map_err(damaged)?;
    let metadata = reader.metadata().file_metadata().key_value_metadata();
    let entry = |key: &str| {
        let entry = metadata.and_then(|all| all.iter().find(|entry| entry.key == key));
        entry.and_then(|entry| entry.value.clone()).unwrap_or_default()
    };
    if entry("percuss.fingerprint") != study.fingerprint() {
        return Err(unfit("the shard belongs to another study or version"));
    }
    let (columns, layout): (Vec<Column>, Vec<Values>) = study.layout().into_iter().unzip();
    let values = read_all(&reader, layout).map_err(damaged)?;
    let index = entry("percuss.shard").parse();
    let index = index.map_err(|_| unfit("the shard has no number"))?;
    let rows = study.runs_of(index).count();
    match values.iter().all(|column| column.len() == rows) {
        true => Ok((index, Table { columns, values })),
        false => Err(unfit("the shard has another number of rows")),
    }
}

/// The content of `results.parquet` of a study, whichever version of the program wrote it.
///
/// # Errors
/// If it is damaged, or the table of another study.
pub fn read_table(bytes: &[u8], study: &Study) -> std::result::Result<Table, Error> {
    let damaged = |e: ParquetError| unfit(format!("the table is damaged: {e}"));
    let reader = SerializedFileReader::new(Bytes::copy_from_slice(bytes)).map_err(damaged)?;
    let (columns, layout): (Vec<Column>, Vec<Values>) = study.layout().into_iter().unzip();
    let found = reader.metadata().file_metadata().schema_descr().columns();
    if !found.iter().map(|column| column.name()).eq(columns.iter().map(|column| &column.name)) {
        return Err(unfit("the table has other columns than its study"));
    }
    let values = read_all(&reader, layout).map_err(damaged)?;
    Ok(Table { columns, values })
}

fn unfit(message: impl Into<String>) -> Error {
    Error::unfit(RequestCode::Shard, message)
}

fn read_all(file: &SerializedFileReader<Bytes>, mut columns: Vec<Values>) -> Result<Vec<Values>> {
    for group in 0..file.num_row_groups() {
        let group = file.get_row_group(group)?;
        if group.num_columns() != columns.len() {
            return Err(ParquetError::General("another number of columns".to_owned()));
        }
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        for (k, values) in columns.iter_mut().enumerate() {
            read(group.get_column_reader(k)?, rows, values)?;
        }
    }
    Ok(columns)
}

fn read(column: ColumnReader, rows: usize, values: &mut Values) -> Result<()> {
    match (column, values) {
        (ColumnReader::Int64ColumnReader(mut column), Values::Whole(values)) => {
            column.read_records(rows, None, None, values).map(|_| ())
        }
        (ColumnReader::DoubleColumnReader(mut column), Values::Number(values)) => {
            column.read_records(rows, None, None, values).map(|_| ())
        }
        (column @ ColumnReader::ByteArrayColumnReader(_), Values::Text(values)) => {
            let mut read = Vec::with_capacity(rows);
            let mut column = get_typed_column_reader::<ByteArrayType>(column);
            column.read_records(rows, None, None, &mut read)?;
            for bytes in read {
                values.push(bytes.as_utf8()?.to_owned());
            }
            Ok(())
        }
        _ => Err(ParquetError::General("a column of another kind".to_owned())),
    }
}
