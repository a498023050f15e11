//! A figure before anybody has drawn it: what the page and the pictures have in common.

/// Place of a figure on the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Section {
    /// A projectile and the point it strikes.
    Impact,
    /// Energy and momentum.
    Balance,
    /// Reactions of supports.
    Supports,
    /// Section forces at recorded points.
    Forces,
    /// Extremes of section forces along beams.
    Envelopes,
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
    /// Joined, stacked on the areas before it in its table, and filled down to them.
    Area,
    /// One vertical line a value, never joined.
    Stem,
    /// Spans of the abscissa, from one to the next of each pair of rows; the value belongs to the span.
    Band,
    /// A dot each, never joined.
    Dots,
    /// Each value holds up to the next abscissa; the area below is filled.
    Steps,
}

/// What the abscissa is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Abscissa {
    /// Time, the same for all figures that have it.
    Time,
    /// The figure's own.
    Own,
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
    /// Width of the line in units of the usual one.
    pub weight: f64,
    /// Whether the dash pattern of the style is used where it distinguishes curves.
    pub dashed: bool,
    pub shape: Shape,
    /// Ordinates, shape (points) \[unit of the axis\].
    pub y: Vec<f64>,
}

/// Curves over common abscissae.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Table {
    /// Abscissae, shape (points) \[unit of the axis\].
    pub x: Vec<f64>,
    /// Curves over these abscissae, shape (series).
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
    pub abscissa: Abscissa,
    /// Whether the y axis starts at zero whatever the values.
    pub from_zero: bool,
    /// Range of the y axis, where figures share one.
    pub y_range: Option<(f64, f64)>,
    /// Whether the area between the first two curves is filled.
    pub filled: bool,
    /// What several small figures beside each other have in common; empty for a figure of its own.
    pub group: String,
    pub note: String,
    /// Its curves, those with the same abscissae together, shape (tables).
    pub tables: Vec<Table>,
    /// What made it of channels, if it was: with it values are SI again.
    pub scaled: Option<Scaled>,
}

/// How the values of a figure came from SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scaled {
    /// Factors of the abscissa and of the ordinate, shape (2) \[-\].
    pub factors: [f64; 2],
    /// Unit of the ordinate as channels spell it.
    pub unit: &'static str,
}

impl Figure {
    /// A figure without curves, over time.
    pub(crate) fn new(section: Section, id: &str, title: &str, x: Axis, label: &str) -> Self {
        Self {
            id: id.to_owned(),
            section,
            picture: false,
            title: title.to_owned(),
            x,
            y: Axis { label: label.to_owned(), unit: String::new() },
            abscissa: Abscissa::Time,
            from_zero: false,
            y_range: None,
            filled: false,
            group: String::new(),
            note: String::new(),
            tables: Vec::new(),
            scaled: None,
        }
    }

    /// Whether the series is drawn with its dash pattern; a curve alone is solid.
    pub(crate) fn is_dashed(&self, series: &Series) -> bool {
        let several = self.tables.iter().map(|t| t.series.len()).sum::<usize>() > 1;
        several && series.dashed && series.shape == Shape::Line
    }
}

/// Largest finite magnitude of `values`.
pub(crate) fn largest<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    values.into_iter().map(|v| v.abs()).filter(|v| v.is_finite()).fold(0.0, f64::max)
}
