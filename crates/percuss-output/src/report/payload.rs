//! The numbers of the page: columns, byte-shuffled, deflated where that pays, in base64.

use std::collections::HashMap;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::figure::{Abscissa, Axis, Figure, Series, Shape, Table};
use crate::fields::{Fields, ROW, StoredFrame};

/// Smaller payloads are not deflated, so that any browser shows them.
const DEFLATED_FROM: usize = 1 << 19;

/// How hard deflate tries: 6 makes the page of the elastic example 1 % smaller and takes twice the time, a quarter of what the whole run takes.
const LEVEL: u8 = 2;

/// Columns and the figures that refer to them.
pub(super) struct Payload {
    /// Figures, columns and encoding.
    pub index: Value,
    /// The columns' bytes in base64.
    pub data: String,
}

/// Packs the figures, and how the scenes moved: that of the run first, then those it is compared with.
pub(super) fn pack(figures: &[Figure], fields: &[(&str, &Fields)]) -> Payload {
    pack_from(DEFLATED_FROM, figures, fields)
}

/// The same, deflated from so many bytes on.
pub(super) fn pack_from(
    deflated_from: usize,
    figures: &[Figure],
    fields: &[(&str, &Fields)],
) -> Payload {
    let mut columns = Columns::default();
    let scenes: Vec<Value> =
        fields.iter().map(|(name, fields)| scene(&mut columns, name, fields)).collect();
    let figures: Vec<Value> = figures.iter().map(|f| figure(&mut columns, f)).collect();
    let deflated = columns.bytes.len() >= deflated_from;
    let bytes = if deflated {
        miniz_oxide::deflate::compress_to_vec(&columns.bytes, LEVEL)
    } else {
        columns.bytes
    };
    let index = json!({
        "figures": figures,
        "scenes": scenes,
        "columns": columns.index,
        "encoding": if deflated { "deflate" } else { "plain" },
    });
    Payload { index, data: STANDARD.encode(bytes) }
}

fn scene(columns: &mut Columns, name: &str, fields: &Fields) -> Value {
    let frames = &fields.frames;
    let mut all = |list: fn(&StoredFrame) -> &Vec<f32>| {
        columns.push(frames.iter().flat_map(|f| list(f).iter().copied()), f32::to_le_bytes)
    };
    let lists = [
        all(|f| &f.displacement),
        all(|f| &f.section_forces),
        all(|f| &f.contact_forces),
        all(|f| &f.load_factors),
        all(|f| &f.velocity),
        all(|f| &f.section_points),
    ];
    let counts = frames.iter().map(|f| (f.contact_forces.len() / 6) as f32);
    let points = frames.iter().map(|f| (f.section_points.len() / ROW) as f32);
    json!({
        "name": name,
        "scene": fields.scene,
        "frames": {
            "velocity": lists[4],
            "time": columns.push(frames.iter().map(|f| f.time), f64::to_le_bytes),
            "displacement": lists[0],
            "sections": lists[1],
            "points": lists[5],
            "point_count": columns.push(points, f32::to_le_bytes),
            "contacts": lists[2],
            "loads": lists[3],
            "contact_count": columns.push(counts, f32::to_le_bytes),
        },
    })
}

fn figure(columns: &mut Columns, figure: &Figure) -> Value {
    let axis = |axis: &Axis| json!({ "caption": axis.caption(), "unit": axis.unit });
    json!({
        "id": figure.id,
        "title": figure.title,
        "x": axis(&figure.x),
        "y": axis(&figure.y),
        "own": figure.abscissa == Abscissa::Own,
        "from_zero": figure.from_zero,
        "range": figure.y_range.map(|(low, high)| [low, high]),
        "filled": figure.filled,
        "small": !figure.group.is_empty(),
        "group": figure.group,
        "tables": figure.tables.iter().map(|t| table(columns, figure, t)).collect::<Vec<_>>(),
    })
}

fn table(columns: &mut Columns, figure: &Figure, table: &Table) -> Value {
    let mut series = |s: &Series| {
        json!({
            "label": s.label,
            "style": s.style,
            "shape": match s.shape {
                Shape::Line => "line",
                Shape::Area => "area",
                Shape::Stem => "stem",
                Shape::Band => "band",
                Shape::Dots => "dots",
                Shape::Steps => "steps",
            },
            "weight": s.weight,
            "dashed": figure.is_dashed(s),
            "y": columns.push(s.y.iter().map(|y| *y as f32), f32::to_le_bytes),
        })
    };
    let list: Vec<Value> = table.series.iter().map(&mut series).collect();
    json!({ "x": columns.push(table.x.iter().copied(), f64::to_le_bytes), "series": list })
}

/// Byte-shuffled columns, equal ones stored once.
#[derive(Default)]
struct Columns {
    /// Bytes of the columns so far, shape (bytes) \[-\].
    bytes: Vec<u8>,
    /// Place of each column among the bytes, shape (columns).
    index: Vec<Value>,
    /// Columns that are there already, by their bytes, shape (bytes of a column) \[index of a column\].
    seen: HashMap<Vec<u8>, usize>,
}

impl Columns {
    /// Appends a column, byte 0 of all values first, then byte 1, ...; returns its number.
    fn push<T: Copy, const N: usize>(
        &mut self,
        values: impl Iterator<Item = T>,
        to_bytes: fn(T) -> [u8; N],
    ) -> usize {
        let values: Vec<[u8; N]> = values.map(to_bytes).collect();
        let shuffled: Vec<u8> = (0..N).flat_map(|k| values.iter().map(move |v| v[k])).collect();
        if let Some(&number) = self.seen.get(&shuffled) {
            return number;
        }
        let number = self.index.len();
        self.index.push(json!([N, values.len()]));
        self.bytes.extend_from_slice(&shuffled);
        self.seen.insert(shuffled, number);
        number
    }
}
