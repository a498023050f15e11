//! Frames on disk.

use std::fs::{self, File};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, Encoding, Repetition, Type as PhysicalType};
use parquet::column::reader::get_typed_column_reader;
use parquet::data_type::{DoubleType, FloatType};
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::{ColumnChunkMetaData, KeyValue};
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::{DIRECTORY, Fields, StoredFrame};
use crate::error::Error;
use crate::files;

/// Lists of a frame: name of the column, and the list itself, to be written and to be read.
type List = (&'static str, fn(&StoredFrame) -> &Vec<f32>, fn(&mut StoredFrame) -> &mut Vec<f32>);
const LISTS: [List; 7] = [
    ("displacement", |f| &f.displacement, |f| &mut f.displacement),
    ("section_forces", |f| &f.section_forces, |f| &mut f.section_forces),
    ("contact_forces", |f| &f.contact_forces, |f| &mut f.contact_forces),
    ("velocity", |f| &f.velocity, |f| &mut f.velocity),
    ("load_factors", |f| &f.load_factors, |f| &mut f.load_factors),
    ("angular_velocity", |f| &f.angular_velocity, |f| &mut f.angular_velocity),
    ("section_points", |f| &f.section_points, |f| &mut f.section_points),
];

/// What the columns hold, for those who read the file without this program.
const ABOUT: &str = "displacement: (u1, u2, u1', u2') of every station of every beam in the order of scene.json, then (u1, u2, angle, 0) of \
every body; velocity: the rates of the same; section_forces: (axial, shear, moment) at the start and at the end of every interval between two stations; contact_forces: \
(contact, x, y, force 1, force 2, 1 where it is an impulse) each, on the second partner; load_factors: one a load; angular_velocity: of the sections, at the start, in the middle and at the end of every interval; section_points: (interval, share of the way along it, axial, shear, moment) each, \
where straight lines between the ends of an interval would miss them, two at a place where they jump. SI units.";

/// Writes `fields/` into the directory of a run.
///
/// # Errors
/// If it cannot be written.
pub fn write(dir: impl AsRef<Path>, fields: &Fields) -> std::result::Result<(), Error> {
    let directory = dir.as_ref().join(DIRECTORY);
    fs::create_dir_all(&directory).map_err(|e| Error::io(&directory, "create", e))?;
    files::write(&directory.join("scene.json"), format!("{:#}\n", fields.scene).as_bytes())?;
    let path = directory.join("frames.parquet");
    let file = files::create_new(&path).map_err(|e| Error::io(&path, "write", e))?;
    write_frames(file, fields).map_err(|e| Error::io(&path, "write", e))
}

fn write_frames(file: File, fields: &Fields) -> Result<()> {
    write_lists(file, fields, &LISTS)
}

fn write_lists(file: File, fields: &Fields, lists: &[List]) -> Result<()> {
    let field = |name: &str, kind: PhysicalType, repetition: Repetition| -> Result<Arc<Type>> {
        Ok(Arc::new(Type::primitive_type_builder(name, kind).with_repetition(repetition).build()?))
    };
    let mut columns = vec![field("time", PhysicalType::DOUBLE, Repetition::REQUIRED)?];
    for (name, ..) in lists {
        columns.push(field(name, PhysicalType::FLOAT, Repetition::REPEATED)?);
    }
    let schema = Arc::new(Type::group_type_builder("frames").with_fields(columns).build()?);
    let about = KeyValue { key: "percuss.about".to_owned(), value: Some(ABOUT.to_owned()) };
    let properties = WriterProperties::builder()
        .set_created_by(format!("percuss {}", env!("CARGO_PKG_VERSION")))
        .set_key_value_metadata(Some(vec![about]))
        .set_dictionary_enabled(false)
        .set_encoding(Encoding::BYTE_STREAM_SPLIT)
        .set_compression(Compression::SNAPPY)
        .set_statistics_enabled(EnabledStatistics::None)
        .build();
    let mut writer = SerializedFileWriter::new(file, schema, Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    let times: Vec<f64> = fields.frames.iter().map(|f| f.time).collect();
    let mut column = next(&mut group)?;
    column.typed::<DoubleType>().write_batch(&times, None, None)?;
    column.close()?;
    for (_, list, _) in lists {
        let (mut values, mut defined, mut repeated) = (Vec::new(), Vec::new(), Vec::new());
        for list in fields.frames.iter().map(list) {
            // An empty list is one undefined entry; in a longer one all but the first repeat.
            defined.extend(std::iter::repeat_n(i16::from(!list.is_empty()), list.len().max(1)));
            repeated.extend((0..list.len().max(1)).map(|k| i16::from(k > 0)));
            values.extend_from_slice(list);
        }
        let mut column = next(&mut group)?;
        column.typed::<FloatType>().write_batch(&values, Some(&defined), Some(&repeated))?;
        column.close()?;
    }
    group.close()?;
    writer.close().map(|_| ())
}

fn next<'a>(
    group: &'a mut SerializedRowGroupWriter<'_, File>,
) -> Result<parquet::file::writer::SerializedColumnWriter<'a>> {
    let missing = || ParquetError::General("fewer columns in the schema than written".to_owned());
    group.next_column()?.ok_or_else(missing)
}

/// Reads `fields/` of the directory of a run; `None` where it has none.
///
/// # Errors
/// If it is damaged.
pub fn read(dir: impl AsRef<Path>) -> std::result::Result<Option<Fields>, Error> {
    let directory = dir.as_ref().join(DIRECTORY);
    let (scene, path) = (directory.join("scene.json"), directory.join("frames.parquet"));
    if !scene.is_file() || !path.is_file() {
        return Ok(None);
    }
    let text = files::read_text(&scene)?;
    let value = serde_json::from_str(&text)
        .map_err(|e| Error::content(&scene, format!("cannot be read: {e}")))?;
    let file = File::open(&path).map_err(|e| Error::io(&path, "read", e))?;
    // The decoder of the parquet crate indexes past the end of some damaged pages instead of refusing them.
    let frames = catch_unwind(AssertUnwindSafe(|| read_frames(file)))
        .map_err(|_| Error::content(&path, "damaged file"))?
        .map_err(|e| Error::content(&path, format!("cannot be read: {e}")))?;
    Ok(Some(Fields { scene: value, frames }))
}

fn read_frames(file: File) -> Result<Vec<StoredFrame>> {
    let reader = SerializedFileReader::new(file)?;
    let mut frames = Vec::new();
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group)?;
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        let mut times = Vec::new();
        get_typed_column_reader::<DoubleType>(group.get_column_reader(0)?)
            .read_records(rows, None, None, &mut times)?;
        let mut read: Vec<StoredFrame> =
            times.into_iter().map(|time| StoredFrame { time, ..StoredFrame::default() }).collect();
        let columns = group.metadata().columns();
        for (name, _, list) in LISTS {
            // Files of earlier versions have no velocities, or no angular ones.
            let named = |c: &ColumnChunkMetaData| c.column_path().string() == name;
            let Some(column) = columns.iter().position(named) else { continue };
            let (mut values, mut defined, mut repeated) = (Vec::new(), Vec::new(), Vec::new());
            get_typed_column_reader::<FloatType>(group.get_column_reader(column)?).read_records(
                rows,
                Some(&mut defined),
                Some(&mut repeated),
                &mut values,
            )?;
            let (mut values, mut at) = (values.into_iter(), 0);
            for (defined, repeated) in defined.iter().zip(&repeated) {
                at += usize::from(*repeated == 0);
                let frame = read.get_mut(at.wrapping_sub(1));
                let frame = frame.ok_or_else(|| ParquetError::General("a list too many".into()))?;
                if *defined == 1 {
                    list(frame).extend(values.next());
                }
            }
        }
        frames.append(&mut read);
    }
    Ok(frames)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn frames_come_back_as_they_were_written() {
        let frame = |k: usize| StoredFrame {
            time: 0.1 * k as f64,
            displacement: (0..8).map(|i| (i * k) as f32).collect(),
            velocity: (0..8).map(|i| (i + k) as f32).collect(),
            angular_velocity: (0..3).map(|i| (i * k) as f32).collect(),
            section_forces: vec![1.5; 6],
            section_points: vec![0.0; 5 * (k % 4)],
            contact_forces: vec![k as f32; 6 * (k % 3)],
            load_factors: Vec::new(),
        };
        let fields = Fields { scene: json!({ "beams": [] }), frames: (0..50).map(frame).collect() };
        let dir = tempfile::tempdir().unwrap();
        write(dir.path(), &fields).unwrap();
        let back = read(dir.path()).unwrap().unwrap();
        assert_eq!(back.frames, fields.frames);
        assert_eq!(back.scene, fields.scene);
        assert!(read(dir.path().join("elsewhere")).unwrap().is_none());
    }

    #[test]
    fn frames_without_velocities_can_still_be_read() {
        let frame = StoredFrame { time: 0.5, displacement: vec![1.0; 4], ..StoredFrame::default() };
        let fields = Fields { scene: json!({}), frames: vec![frame] };
        let earlier: Vec<List> = LISTS
            .into_iter()
            .filter(|(name, ..)| !name.contains("velocity") && *name != "section_points")
            .collect();
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("frames.parquet");
        write_lists(File::create(&path).unwrap(), &fields, &earlier).unwrap();
        assert_eq!(read_frames(File::open(&path).unwrap()).unwrap(), fields.frames);
    }
}
