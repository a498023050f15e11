//! Poly data over time.

/// Numbers at points, all frames one behind the other.
#[derive(Debug)]
pub(super) struct Array {
    pub name: &'static str,
    #[cfg_attr(
        not(feature = "vtkhdf"),
        expect(dead_code, reason = "VTP files have no place for it")
    )]
    pub unit: &'static str,
    /// Numbers of one point.
    pub width: usize,
    /// Values, one point or cell after the other, shape (points or cells, numbers of each) \[unit of the array\].
    pub values: Vec<f32>,
}

impl Array {
    pub fn new(name: &'static str, unit: &'static str, width: usize) -> Self {
        Self { name, unit, width, values: Vec::new() }
    }

    /// A vector in the plane.
    pub fn vector(&mut self, v: [f64; 2]) {
        self.values.extend([v[0] as f32, v[1] as f32, 0.0]);
    }

    pub fn number(&mut self, v: f64) {
        self.values.push(v as f32);
    }
}

/// Cells that are the same in all frames.
#[derive(Debug, Default)]
pub(super) struct Cells {
    /// Points of each line, shape (lines, points of one) \[index of a point\].
    pub lines: Vec<Vec<usize>>,
    /// Points of each polygon, shape (polygons, points of one) \[index of a point\].
    pub polygons: Vec<Vec<usize>>,
    /// Number of the thing that each cell belongs to: lines, then polygons, shape (lines) \[index of a thing\].
    pub line_of: Vec<i32>,
    /// Number of the thing that each polygon belongs to, shape (polygons) \[index of a thing\].
    pub polygon_of: Vec<i32>,
}

/// Poly data over time.
#[derive(Debug)]
pub(super) struct PolySeries {
    /// Times of the frames, shape (frames) \[s\].
    pub times: Vec<f64>,
    /// Points of all frames, one frame behind the other, shape (points of all frames, 2) \[m\].
    pub points: Vec<[f64; 2]>,
    /// Points of each frame, shape (frames) \[-\].
    pub counts: Vec<usize>,
    /// Cells; `None` where every point is a cell of its own.
    pub cells: Option<Cells>,
    /// Arrays on points and cells, shape (arrays).
    pub arrays: Vec<Array>,
    /// What cells' numbers count, and the names they stand for, shape (things).
    pub of: (&'static str, Vec<String>),
}

impl PolySeries {
    /// Whether there is nothing in any frame.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }
}
