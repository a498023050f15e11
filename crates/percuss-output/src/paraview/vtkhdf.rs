//! Poly data over time as a VTKHDF file (version 2.0 of the format: ParaView 5.12 and later).

use super::poly::{Cells, PolySeries};
use hdf5_pure::{AttrValue, Error, FileBuilder, FinishedGroup, GroupBuilder};

/// Kinds of cells, in the order of the format.
const KINDS: [&str; 4] = ["Vertices", "Lines", "Polygons", "Strips"];

impl PolySeries {
    /// The file.
    pub fn bytes(&self) -> Result<Vec<u8>, Error> {
        let mut file = FileBuilder::new();
        let mut root = file.create_group("VTKHDF");
        root.set_attr("Version", AttrValue::I64Array(vec![2, 0]));
        root.set_attr("Type", AttrValue::AsciiString("PolyData".into()));
        let moves = self.moves();
        let stored = if moves { self.points.len() } else { self.counts[0] };
        let flat: Vec<f32> =
            self.points[..stored].iter().flat_map(|p| [p[0] as f32, p[1] as f32, 0.0]).collect();
        let most = self.counts.iter().copied().max().unwrap_or(1).max(1);
        numbers(&mut root, "Points", &flat, 3, most).set_attr("unit", unit("m"));
        let counts = if self.cells.is_some() { &self.counts[..1] } else { &self.counts[..] };
        integers(&mut root, "NumberOfPoints", &whole(counts));
        let mut data = root.create_group("PointData");
        for array in &self.arrays {
            numbers(&mut data, array.name, &array.values, array.width, most)
                .set_attr("unit", unit(array.unit));
        }
        let offsets = self.topology(&mut root)?;
        root.add_group(data.finish());
        let steps = self.steps(&mut root, moves, &offsets);
        root.add_group(steps);
        file.add_group(root.finish());
        // Beside what VTK reads: its reader (9.7) ends the process at texts in field data that changes in time.
        let mut names = file.create_group("percuss");
        let words: Vec<&str> = self.of.1.iter().map(String::as_str).collect();
        names.create_dataset(&format!("{}_names", self.of.0)).with_vlen_strings(&words);
        file.add_group(names.finish());
        file.finish()
    }

    /// Whether points ever leave where they stand in the first frame.
    fn moves(&self) -> bool {
        let count = self.counts[0];
        self.cells.is_none()
            || self.points.chunks(count.max(1)).any(|frame| *frame != self.points[..count])
    }

    /// Cells of all kinds, with what they belong to; cells before each frame.
    fn topology(&self, root: &mut GroupBuilder) -> Result<Vec<i64>, Error> {
        let empty = Cells::default();
        let cells = self.cells.as_ref().unwrap_or(&empty);
        let parts = if self.cells.is_some() { 1 } else { self.counts.len() };
        for kind in KINDS {
            let mut group = root.create_group(kind);
            let (mut connectivity, mut ends, mut counts) = (Vec::new(), Vec::new(), Vec::new());
            let (mut ids, list) = (
                Vec::new(),
                match kind {
                    "Lines" => cells.lines.as_slice(),
                    "Polygons" => cells.polygons.as_slice(),
                    _ => &[],
                },
            );
            for part in 0..parts {
                let alone =
                    if kind == "Vertices" && self.cells.is_none() { self.counts[part] } else { 0 };
                ends.push(0);
                ends.extend(1..=alone as i64);
                connectivity.extend(0..alone as i64);
                counts.push((list.len() + alone) as i64);
                ids.push((alone + list.iter().map(Vec::len).sum::<usize>()) as i64);
            }
            let mut end = 0;
            for cell in list {
                end += cell.len() as i64;
                ends.push(end);
                connectivity.extend(cell.iter().map(|p| *p as i64));
            }
            integers(&mut group, "Connectivity", &connectivity);
            integers(&mut group, "Offsets", &ends);
            integers(&mut group, "NumberOfCells", &counts);
            integers(&mut group, "NumberOfConnectivityIds", &ids);
            root.add_group(group.finish());
        }
        if self.cells.is_some() {
            let mut data = root.create_group("CellData");
            let of: Vec<i32> = cells.line_of.iter().chain(&cells.polygon_of).copied().collect();
            data.create_dataset(self.of.0).with_i32_data(&of);
            root.add_group(data.finish());
        }
        let mut before = vec![0];
        before.extend(self.counts.iter().scan(0, |sum, n| {
            *sum += *n as i64;
            Some(*sum)
        }));
        Ok(before)
    }

    /// Where each frame's numbers begin.
    fn steps(&self, root: &mut GroupBuilder, moves: bool, before: &[i64]) -> FinishedGroup {
        let mut steps = root.create_group("Steps");
        let n = self.times.len();
        steps.set_attr("NSteps", AttrValue::I64(n as i64));
        steps.create_dataset("Values").with_f64_data(&self.times);
        let fixed = self.cells.is_some();
        let none = vec![0; n];
        let parts: Vec<i64> = if fixed { none.clone() } else { (0..n as i64).collect() };
        integers(&mut steps, "PartOffsets", &parts);
        integers(&mut steps, "NumberOfParts", &vec![1; n]);
        let points = if moves { before[..n].to_vec() } else { none };
        integers(&mut steps, "PointOffsets", &points);
        // Of vertices: one a point; the other kinds are the same cells in every frame, or none.
        let cells: Vec<i64> =
            before[..n].iter().flat_map(|v| [if fixed { 0 } else { *v }, 0, 0, 0]).collect();
        for name in ["CellOffsets", "ConnectivityIdOffsets"] {
            steps.create_dataset(name).with_i64_data(&cells).with_shape(&[n as u64, 4]);
        }
        let mut data = steps.create_group("PointDataOffsets");
        for array in &self.arrays {
            integers(&mut data, array.name, &before[..n]);
        }
        steps.add_group(data.finish());
        if fixed {
            let mut data = steps.create_group("CellDataOffsets");
            integers(&mut data, self.of.0, &vec![0; n]);
            steps.add_group(data.finish());
        }
        steps.finish()
    }
}

fn whole(counts: &[usize]) -> Vec<i64> {
    counts.iter().map(|n| *n as i64).collect()
}

fn unit(unit: &str) -> AttrValue {
    AttrValue::AsciiString(unit.to_owned())
}

fn integers(group: &mut GroupBuilder, name: &str, values: &[i64]) {
    group.create_dataset(name).with_i64_data(values);
}

/// Numbers at points, packed in pieces of about a frame, so that a reader unpacks little more than it wants.
fn numbers<'a>(
    group: &'a mut GroupBuilder,
    name: &str,
    values: &[f32],
    width: usize,
    rows: usize,
) -> &'a mut hdf5_pure::DatasetBuilder {
    let (count, width) = ((values.len() / width) as u64, width as u64);
    let dataset = group.create_dataset(name).with_f32_data(values);
    let piece = (rows as u64).max(256).min(count.max(1));
    if width == 1 {
        dataset.with_shape(&[count]).with_chunks(&[piece]);
    } else {
        dataset.with_shape(&[count, width]).with_chunks(&[piece, width]);
    }
    dataset.with_shuffle().with_deflate(4)
}
