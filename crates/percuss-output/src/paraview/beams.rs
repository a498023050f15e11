//! Beams as surfaces with depth: between two stations, rows of points through the lower fibre, the axis and the upper fibre.

use super::placed::{Beam, OnAxis, Placed, mix};
use super::poly::{Array, Cells, PolySeries};
use crate::fields::StoredFrame;

/// Parts that all intervals together are drawn in, about, and those of one at most.
const PARTS: usize = 160;
const MOST_PARTS: usize = 8;

pub(super) fn series(placed: &Placed<'_>) -> Option<PolySeries> {
    if placed.intervals == 0 {
        return None;
    }
    let parts = (PARTS / placed.intervals).clamp(1, MOST_PARTS);
    let mut arrays = Arrays::new(placed.has_velocities());
    let (mut points, mut counts) = (Vec::new(), Vec::new());
    for frame in placed.frames {
        let before = points.len();
        for (number, beam) in placed.beams.iter().enumerate() {
            for &(k, interval) in &beam.intervals {
                // A gap has cells of no area, since all frames have the same.
                let gap = placed.is_parted(number, k, frame);
                for part in 0..=parts {
                    let share = if gap { 0.0 } else { part as f64 / parts as f64 };
                    let at = placed.point(beam, (k, interval), share, frame);
                    let section = Section::of(beam, (k, interval, share), frame);
                    for y in section.fibres() {
                        points.push([0, 1].map(|i| at.place[i] + y * at.normal[i]));
                        arrays.push(&at, &section, y);
                    }
                }
            }
        }
        counts.push(points.len() - before);
    }
    Some(PolySeries {
        times: placed.frames.iter().map(|f| f.time).collect(),
        points,
        counts,
        cells: Some(cells(placed, parts)),
        arrays: arrays.finish(),
        of: ("beam", placed.beams.iter().map(|b| b.name.clone()).collect()),
    })
}

/// What acts in a section, and its shape.
struct Section {
    /// Axial force, shear force, moment, shape (3) \[N, N, N m\].
    forces: [f64; 3],
    half_depth: f64,
    area: f64,
    inertia: f64,
}

impl Section {
    fn of(beam: &Beam, (k, interval, share): (usize, usize, f64), frame: &StoredFrame) -> Self {
        Self {
            forces: frame.section_at(interval, share),
            half_depth: mix(&beam.half_depth, k, share),
            area: mix(&beam.area, k, share),
            inertia: mix(&beam.inertia, k, share),
        }
    }

    fn has_depth(&self) -> bool {
        self.half_depth.is_finite() && self.half_depth > 0.0
    }

    /// Distances of the points from the axis, along the normal.
    fn fibres(&self) -> Vec<f64> {
        let h = self.half_depth;
        if self.has_depth() { vec![-h, 0.0, h] } else { vec![0.0] }
    }

    /// Normal stress at a distance from the axis: a positive moment bends towards the normal, so that fibres there are pressed.
    fn stress(&self, y: f64) -> f64 {
        self.forces[0] / self.area - self.forces[2] * y / self.inertia
    }

    /// Largest magnitude over the section; of the axial force alone where the depth is unknown.
    fn largest(&self) -> f64 {
        let h = if self.has_depth() { self.half_depth } else { 0.0 };
        self.forces[0].abs() / self.area + self.forces[2].abs() * h / self.inertia
    }
}

struct Arrays {
    displacement: Array,
    /// Arrays of axial force, shear force and moment, shape (3).
    forces: [Array; 3],
    stress: Array,
    largest: Array,
    velocity: Option<Array>,
}

impl Arrays {
    fn new(has_velocities: bool) -> Self {
        Self {
            displacement: Array::new("displacement", "m", 3),
            forces: [
                Array::new("axial_force", "N", 1),
                Array::new("shear_force", "N", 1),
                Array::new("moment", "N m", 1),
            ],
            stress: Array::new("stress", "Pa", 1),
            largest: Array::new("largest_stress", "Pa", 1),
            velocity: has_velocities.then(|| Array::new("velocity", "m/s", 3)),
        }
    }

    fn push(&mut self, at: &OnAxis, section: &Section, y: f64) {
        let turned = |i: usize| y * (at.normal[i] - at.rest_normal[i]);
        self.displacement.vector([0, 1].map(|i| at.displacement[i] + turned(i)));
        for (array, force) in self.forces.iter_mut().zip(section.forces) {
            array.number(force);
        }
        self.stress.number(section.stress(y));
        self.largest.number(section.largest());
        if let Some(velocity) = &mut self.velocity {
            // Sections stay plane and at right angles to the axis.
            let [n1, n2] = at.normal;
            let turning = [-y * at.spin * n2, y * at.spin * n1];
            velocity.vector([0, 1].map(|i| at.velocity[i] + turning[i]));
        }
    }

    fn finish(self) -> Vec<Array> {
        let [axial, shear, moment] = self.forces;
        let plain = [self.displacement, axial, shear, moment, self.stress, self.largest];
        plain.into_iter().chain(self.velocity).collect()
    }
}

/// Quadrilaterals between rows of three points, a line where a row is one point.
fn cells(placed: &Placed<'_>, parts: usize) -> Cells {
    let (mut cells, mut first) = (Cells::default(), 0);
    for (number, beam) in placed.beams.iter().enumerate() {
        let number = i32::try_from(number).unwrap_or(i32::MAX);
        for &(k, _) in &beam.intervals {
            let mut rows = Vec::new();
            for part in 0..=parts {
                let depth = mix(&beam.half_depth, k, part as f64 / parts as f64);
                let width = if depth.is_finite() && depth > 0.0 { 3 } else { 1 };
                rows.push((first, width));
                first += width;
            }
            for pair in rows.windows(2) {
                let ((a, wide), (b, wide_too)) = (pair[0], pair[1]);
                if wide == 3 && wide_too == 3 {
                    for i in 0..2 {
                        cells.polygons.push(vec![a + i, b + i, b + i + 1, a + i + 1]);
                        cells.polygon_of.push(number);
                    }
                } else {
                    // Axes: the only point of a row, or the middle one.
                    cells.lines.push(vec![a + wide / 2, b + wide_too / 2]);
                    cells.line_of.push(number);
                }
            }
        }
    }
    cells
}
