//! Poly data over time as a list (PVD) of files (VTP), one an instant: what ParaView before 5.12 reads.

use std::fmt::Write as _;

use super::poly::{Cells, PolySeries};
use crate::report::html::escape;

impl PolySeries {
    /// Number of the files beside the list.
    pub fn file_count(&self) -> usize {
        self.times.len()
    }

    /// The list of the files of a series called `name`: each stands in the directory of that name.
    pub fn list(&self, name: &str) -> String {
        let mut out = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n".to_owned();
        for (k, time) in self.times.iter().enumerate() {
            let file = escape(&format!("{name}/{}", file_name(k)));
            let _ = writeln!(out, "<DataSet timestep=\"{time:e}\" part=\"0\" file=\"{file}\"/>");
        }
        out + "</Collection>\n</VTKFile>\n"
    }

    /// The file of a frame.
    pub fn file(&self, frame: usize) -> Vec<u8> {
        let first: usize = self.counts[..frame].iter().sum();
        let count = self.counts[frame];
        let mut body = Appended::default();
        let points = self.points[first..first + count].iter();
        let flat = points.flat_map(|p| [p[0] as f32, p[1] as f32, 0.0]).flat_map(f32::to_le_bytes);
        let mut inside =
            format!("<Points>{}</Points>\n<PointData>", body.array("Float32", "Points", 3, flat));
        for array in &self.arrays {
            let part = &array.values[array.width * first..array.width * (first + count)];
            let bytes = part.iter().flat_map(|v| v.to_le_bytes());
            inside += &body.array("Float32", array.name, array.width, bytes);
        }
        inside += "</PointData>\n";
        let alone: Vec<Vec<usize>> = match &self.cells {
            Some(_) => Vec::new(),
            None => (0..count).map(|k| vec![k]).collect(),
        };
        let none = Cells::default();
        let cells = self.cells.as_ref().unwrap_or(&none);
        if self.cells.is_some() {
            let of = cells.line_of.iter().chain(&cells.polygon_of).flat_map(|n| n.to_le_bytes());
            let _ =
                writeln!(inside, "<CellData>{}</CellData>", body.array("Int32", self.of.0, 1, of));
        }
        for (kind, list) in [("Verts", &alone), ("Lines", &cells.lines), ("Polys", &cells.polygons)]
        {
            inside += &body.cells(kind, list);
        }
        let numbers = format!(
            "NumberOfPoints=\"{count}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\"",
            alone.len(),
            cells.lines.len(),
            cells.polygons.len()
        );
        let head = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\">\n<PolyData>\n{}<Piece {numbers}>\n{inside}</Piece>\n</PolyData>\n\
             <AppendedData encoding=\"raw\">\n_",
            self.names()
        );
        [head.as_bytes(), &body.bytes, b"\n</AppendedData>\n</VTKFile>\n"].concat()
    }

    /// What cells' numbers stand for: texts as the numbers of their bytes, so that nothing in them can be markup.
    fn names(&self) -> String {
        let (kind, names) = &self.of;
        let mut codes = String::new();
        for byte in names.iter().flat_map(|name| name.bytes().filter(|b| *b != 0).chain([0])) {
            let _ = write!(codes, "{byte} ");
        }
        format!(
            "<FieldData><Array type=\"String\" Name=\"{kind}_names\" NumberOfTuples=\"{}\" format=\"ascii\">{codes}</Array>\
             </FieldData>\n",
            names.len()
        )
    }
}

/// Name of the file of a frame.
pub(super) fn file_name(frame: usize) -> String {
    format!("{frame:05}.vtp")
}

/// Arrays as bytes behind the markup.
#[derive(Default)]
struct Appended {
    /// Bytes of the arrays so far, shape (bytes) \[-\].
    bytes: Vec<u8>,
}

impl Appended {
    /// Appends an array; the element that refers to it.
    fn array(
        &mut self,
        kind: &str,
        name: &str,
        width: usize,
        values: impl Iterator<Item = u8>,
    ) -> String {
        let at = self.bytes.len();
        self.bytes.extend([0; 8]);
        self.bytes.extend(values);
        let length = (self.bytes.len() - at - 8) as u64;
        self.bytes[at..at + 8].copy_from_slice(&length.to_le_bytes());
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{width}\" format=\"appended\" offset=\"{at}\"/>"
        )
    }

    fn cells(&mut self, kind: &str, list: &[Vec<usize>]) -> String {
        let points = list.iter().flatten().flat_map(|p| (*p as i64).to_le_bytes());
        let connectivity = self.array("Int64", "connectivity", 1, points);
        let mut end = 0;
        let ends = list.iter().flat_map(|cell| {
            end += cell.len() as i64;
            end.to_le_bytes()
        });
        let offsets = self.array("Int64", "offsets", 1, ends);
        format!("<{kind}>{connectivity}{offsets}</{kind}>\n")
    }
}
