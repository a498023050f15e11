//! A figure before anybody has drawn it: what the page and the pictures have in common.

use super::decimate;
use super::quantity::Scale;

/// Where a figure stands on the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Section {
    /// A projectile and the point it strikes.
    Impact,
    /// Energy and momentum.
    Books,
    /// What does not add up.
    Audit,
    /// Recorded points.
    Points,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Joined.
    Line,
    /// One vertical line a value, never joined.
    Stem,
}

/// Label and unit of an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Axis {
    pub label: String,
    pub unit: String,
}

impl Axis {
    /// `contact force [kN]`.
    pub(crate) fn caption(&self) -> String {
        if self.unit.is_empty() {
            self.label.clone()
        } else {
            format!("{} [{}]", self.label, self.unit)
        }
    }
}

/// One curve, in the units of its axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Series {
    pub label: String,
    /// Index of colour and dash pattern; 0 is the neutral one.
    pub style: usize,
    pub shape: Shape,
    pub y: Vec<f64>,
}

/// Curves over common abscissae.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Table {
    pub x: Vec<f64>,
    pub series: Vec<Series>,
}

/// A figure, ready to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Figure {
    /// Unique on the page; the file name of its pictures.
    pub id: String,
    pub section: Section,
    /// Whether there are pictures of it.
    pub picture: bool,
    pub title: String,
    pub x: Axis,
    pub y: Axis,
    pub note: String,
    pub tables: Vec<Table>,
}

/// A curve in SI units, all rows of it.
pub(crate) struct Curve<'a> {
    pub label: String,
    pub style: usize,
    pub y: &'a [f64],
}

impl<'a> Curve<'a> {
    pub(crate) fn new(label: impl Into<String>, style: usize, y: &'a [f64]) -> Self {
        Self { label: label.into(), style, y }
    }
}

/// What the figures of a page have in common.
pub(crate) struct Canvas<'a> {
    /// Times of all rows \[s\].
    pub time: &'a [f64],
    /// Scale of the time axis.
    pub time_scale: Scale,
    /// Bins to which long histories are reduced.
    pub bins: usize,
}

impl Canvas<'_> {
    /// The time axis.
    pub(crate) fn time_axis(&self) -> Axis {
        Axis { label: "time".to_owned(), unit: self.time_scale.unit.clone() }
    }

    /// Curves over time, decimated together and scaled.
    pub(crate) fn lines(&self, unit: &str, curves: &[Curve<'_>]) -> (String, Table) {
        let columns: Vec<&[f64]> = curves.iter().map(|c| c.y).collect();
        let scale = Scale::new(largest(&columns), unit);
        let rows = decimate::rows(&columns, self.time.len(), self.bins);
        let pick = |column: &[f64], factor: f64| rows.iter().map(|&r| column[r] * factor).collect();
        let series = curves
            .iter()
            .map(|c| Series {
                label: c.label.clone(),
                style: c.style,
                shape: Shape::Line,
                y: pick(c.y, scale.factor),
            })
            .collect();
        (scale.unit, Table { x: pick(self.time, self.time_scale.factor), series })
    }
}

/// Largest finite magnitude in `columns`.
pub(crate) fn largest(columns: &[&[f64]]) -> f64 {
    let all = columns.iter().flat_map(|c| c.iter()).map(|v| v.abs());
    all.filter(|v| v.is_finite()).fold(0.0, f64::max)
}
