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
    /// Points of each line.
    pub lines: Vec<Vec<usize>>,
    pub polygons: Vec<Vec<usize>>,
    /// Number of the thing that each cell belongs to: lines, then polygons.
    pub line_of: Vec<i32>,
    pub polygon_of: Vec<i32>,
}

/// Poly data over time.
#[derive(Debug)]
pub(super) struct PolySeries {
    pub times: Vec<f64>,
    /// Points of all frames, one frame behind the other.
    pub points: Vec<[f64; 2]>,
    /// Points of each frame.
    pub counts: Vec<usize>,
    /// Cells; `None` where every point is a cell of its own.
    pub cells: Option<Cells>,
    pub arrays: Vec<Array>,
    /// What cells' numbers count, and the names they stand for.
    pub of: (&'static str, Vec<String>),
}

impl PolySeries {
    /// Whether there is nothing in any frame.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }
}
