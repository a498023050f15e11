//! An equilibrium path on disk: its points, its limit points, a picture, a page.

use std::fmt::Write as _;
use std::path::Path as FilePath;

use percuss::scene::Scene;
use percuss::{Equilibrium, Path, PathPoint, PathRecorder, PathYield};
use serde_json::{Map, Value, json};

use crate::csv_text;
use crate::equilibrium::failure;
use crate::error::Error;
use crate::fields::Places;
use crate::files;
use crate::report::figure::{Abscissa, Axis, Figure, Section, Series, Shape, Table, largest};
use crate::report::pictures;
use crate::report::quantity::Scale;
pub use crate::report::still::PathInfo;
use crate::report::still::{Along, PathPage, drawn_displacements, path_page};

/// Equilibria kept for drawings: points of the path at most, limit points at most.
const MOST: usize = 240;
const MOST_LIMITS: usize = 60;

/// Keeps equilibria of a path for its page: all while they are few, then every second, every fourth, ..., and the limit points.
#[derive(Clone, Debug)]
pub struct PathShapes {
    places: Places,
    stride: usize,
    offered: usize,
    limits: usize,
    /// Equilibria kept so far, shape (equilibria).
    kept: Vec<Along>,
}

impl PathShapes {
    /// Nothing kept yet.
    pub fn new(scene: &Scene) -> Self {
        Self { places: Places::of(scene), stride: 1, offered: 0, limits: 0, kept: Vec::new() }
    }

    fn keep(&mut self, factor: f64, limit: bool, found: &Equilibrium) {
        self.kept.push(Along {
            number: self.offered - 1,
            factor,
            limit,
            displacements: found.points.iter().map(|(_, u)| *u).collect(),
            frame: self.places.still(&found.frame()),
        });
    }

    /// What was kept, and the end of the path.
    fn finish(mut self, path: &Path) -> Vec<Along> {
        let factor = path.points.last().map_or(0.0, |point| point.factor);
        self.offered += 1;
        self.keep(factor, false, &path.end);
        // A path that breaks off has offered its end as a point.
        if let [.., before, end] = self.kept.as_slice()
            && before.factor == end.factor
            && before.displacements == end.displacements
            && !before.limit
        {
            self.kept.remove(self.kept.len() - 2);
        }
        self.kept
    }
}

impl PathRecorder for PathShapes {
    fn wants(&mut self, limit: bool) -> bool {
        if limit {
            self.limits += 1;
            return self.limits <= MOST_LIMITS;
        }
        self.offered += 1;
        (self.offered - 1).is_multiple_of(self.stride)
    }

    fn equilibrium(&mut self, factor: f64, limit: bool, found: &Equilibrium) {
        self.keep(factor, limit, found);
        if self.kept.iter().filter(|one| !one.limit).count() > MOST {
            self.stride *= 2;
            let stride = self.stride;
            self.kept.retain(|one| one.limit || one.number.is_multiple_of(stride));
        }
    }
}

/// Whether the end asked for was reached, number of points, last factor, limit points, first yields.
pub fn path_value(path: &Path) -> Value {
    let at = |point: &PathPoint| {
        let named = path.names.iter().zip(&point.displacements);
        let points = named.map(|(name, u)| (name.clone(), json!({ "displacement": u })));
        json!({ "factor": point.factor, "point": points.collect::<Map<_, _>>() })
    };
    let first_yield = |y: &PathYield| json!({ "name": y.name, "factor": y.factor });
    json!({
        "reached": path.reached,
        "torn": path.torn,
        "points": path.points.len(),
        "factor": path.points.last().map(|p| p.factor),
        "failures": path.failures.iter().map(failure).collect::<Vec<_>>(),
        "bifurcations": path.bifurcations.iter().map(at).collect::<Vec<_>>(),
        "limit_points": path.limit_points.iter().map(at).collect::<Vec<_>>(),
        "first_yields": path.yields.iter().map(first_yield).collect::<Vec<_>>(),
    })
}

/// Writes `path.csv`, `path.html`, `path.svg` and `path.png` (where points are recorded), and `path.json` with `value`, into `dir`.
/// The page draws the equilibria kept in `shapes`.
///
/// # Errors
/// If a file cannot be written or the picture not drawn.
pub fn write_path(
    dir: impl AsRef<FilePath>,
    info: &PathInfo<'_>,
    shapes: PathShapes,
    value: &Value,
) -> Result<(), Error> {
    let dir = dir.as_ref();
    files::write(&dir.join("path.csv"), csv(info.path).as_bytes())?;
    let page = PathPage { info, along: shapes.finish(info.path) };
    files::write(&dir.join("path.html"), path_page(&page).as_bytes())?;
    let figure = figure(info.path);
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
    text.push_str(",stable\n");
    let mut buffer = zmij::Buffer::new();
    for point in &path.points {
        text.push_str(buffer.format(point.factor));
        for value in point.displacements.as_flattened() {
            let _ = write!(text, ",{}", buffer.format(*value));
        }
        text.push_str(if point.stable { ",1" } else { ",0" });
        text.push('\n');
    }
    text
}

/// The load factor over the largest displacements.
fn figure(path: &Path) -> Figure {
    let column = |(point, component): (usize, usize)| -> Vec<f64> {
        path.points.iter().map(|p| p.displacements[point][component]).collect()
    };
    let all = drawn_displacements(path);
    let size = all.iter().map(|c| largest(&column(*c))).fold(0.0, f64::max);
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
