//! An equilibrium path on disk: its points, its limit points, a picture.

use std::fmt::Write as _;
use std::path::Path as FilePath;

use percuss::{Path, PathPoint};
use serde_json::{Map, Value, json};

use crate::csv_text;
use crate::error::Error;
use crate::files;
use crate::report::figure::{Abscissa, Axis, Figure, Section, Series, Shape, Table, largest};
use crate::report::pictures;
use crate::report::quantity::Scale;

/// Curves in the picture.
const DRAWN: usize = 6;

/// Whether the end asked for was reached, number of points, last factor, limit points.
pub fn path_value(path: &Path) -> Value {
    let at = |point: &PathPoint| {
        let named = path.names.iter().zip(&point.displacements);
        let points = named.map(|(name, u)| (name.clone(), json!({ "displacement": u })));
        json!({ "factor": point.factor, "point": points.collect::<Map<_, _>>() })
    };
    json!({
        "reached": path.reached,
        "points": path.points.len(),
        "factor": path.points.last().map(|p| p.factor),
        "limit_points": path.limit_points.iter().map(at).collect::<Vec<_>>(),
    })
}

/// Writes `path.csv`, `path.svg` and `path.png` (where points are recorded), and `path.json` with `value`, into `dir`.
///
/// # Errors
/// If a file cannot be written or the picture not drawn.
pub fn write_path(dir: impl AsRef<FilePath>, path: &Path, value: &Value) -> Result<(), Error> {
    let dir = dir.as_ref();
    files::write(&dir.join("path.csv"), csv(path).as_bytes())?;
    let figure = figure(path);
    if !figure.tables.is_empty() {
        pictures::draw(dir, "path", pictures::single(&figure, (0.0, 0.0)))?;
    }
    files::write(&dir.join("path.json"), format!("{value:#}\n").as_bytes())
}

fn csv(path: &Path) -> String {
    let mut text = "factor".to_owned();
    for name in &path.names {
        for i in 1..=2 {
            let column = csv_text::quote(&format!("point.{name}.displacement_{i}"));
            let _ = write!(text, ",{column}"); // a String never fails
        }
    }
    text.push('\n');
    let mut buffer = zmij::Buffer::new();
    for point in &path.points {
        text.push_str(buffer.format(point.factor));
        for value in point.displacements.as_flattened() {
            let _ = write!(text, ",{}", buffer.format(*value));
        }
        text.push('\n');
    }
    text
}

/// The load factor over the largest displacements.
fn figure(path: &Path) -> Figure {
    let column = |(point, component): (usize, usize)| -> Vec<f64> {
        path.points.iter().map(|p| p.displacements[point][component]).collect()
    };
    let mut all: Vec<(usize, usize)> =
        (0..path.names.len()).flat_map(|point| [(point, 0), (point, 1)]).collect();
    all.sort_by(|a, b| largest(&column(*b)).total_cmp(&largest(&column(*a))));
    let size = all.first().map_or(0.0, |first| largest(&column(*first)));
    all.retain(|c| largest(&column(*c)) > 1e-9 * size);
    all.truncate(DRAWN);
    all.sort_unstable();
    let scale = Scale::new(size, "m");
    let factors: Vec<f64> = path.points.iter().map(|p| p.factor).collect();
    let axis = Axis { label: "displacement".to_owned(), unit: scale.unit.clone() };
    let title = "Equilibrium path";
    let mut figure = Figure::new(Section::Points, "path", title, axis, "load factor");
    figure.abscissa = Abscissa::Own;
    let table = |(k, c): (usize, &(usize, usize))| Table {
        x: column(*c).into_iter().map(|u| u * scale.factor).collect(),
        series: vec![Series {
            label: format!("{}, along e{}", path.names[c.0], c.1 + 1),
            style: 1 + k,
            weight: 1.0,
            dashed: true,
            shape: Shape::Line,
            y: factors.clone(),
        }],
    };
    figure.tables = all.iter().enumerate().map(table).collect();
    if let [only] = figure.tables.as_slice() {
        figure.x.label = format!("displacement of {}", only.series[0].label);
    }
    figure
}
