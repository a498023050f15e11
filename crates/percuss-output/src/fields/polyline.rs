//! Section forces between two stations as polylines, with jumps and corners at forces inside.

use super::StoredFrame;

/// Numbers of a row: interval, share of the way along it, axial force, shear force, moment.
pub(crate) const ROW: usize = 5;
/// A vertex that the chord past it misses by less than this share of the largest value is left out where several elements are one interval.
const MISSED: f32 = 5e-3;

/// A vertex of the section forces of an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vertex {
    /// Share of the way along the interval.
    pub share: f64,
    /// Axial force, shear force, moment, shape (3) \[N, N, N m\].
    pub forces: [f32; 3],
}

/// The values beside which those of a frame are measured.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Extent {
    /// Least and largest, shape (3, 2) \[N, N, N m\].
    range: [[f32; 2]; 3],
}

impl Extent {
    pub(super) fn of(forces: impl Iterator<Item = [f32; 3]>) -> Self {
        let mut extent = Self::default();
        for values in forces {
            for ([least, most], value) in extent.range.iter_mut().zip(values) {
                (*least, *most) = (least.min(value), most.max(value));
            }
        }
        extent
    }

    /// Deviations that are seen: axial and shear forces are measured by each other.
    fn seen(&self) -> [f32; 3] {
        let [axial, shear, moment] = self.range.map(|[least, most]| most.max(-least));
        [axial.max(shear), axial.max(shear), moment].map(|size| MISSED * size)
    }

    /// Whether a vertex has an extreme of the frame; inside a stretch on which the force is constant none has.
    fn is_extreme(&self, all: &[Vertex], k: usize) -> bool {
        let beside = |k: usize, i: usize| all.get(k).map(|vertex| vertex.forces[i]);
        (0..3).any(|i| {
            let value = all[k].forces[i];
            let inside = k > 0 && [k - 1, k + 1].iter().all(|k| beside(*k, i) == Some(value));
            value != 0.0 && self.range[i].contains(&value) && !inside
        })
    }
}

/// The vertices without which the line looks different, the first and the last among them.
pub(super) fn simplified(all: &[Vertex], extent: &Extent) -> Vec<Vertex> {
    let seen = extent.seen();
    let Some(last) = all.len().checked_sub(1) else { return Vec::new() };
    let mut kept: Vec<bool> = (0..all.len()).map(|k| extent.is_extreme(all, k)).collect();
    (kept[0], kept[last]) = (true, true);
    let ends: Vec<usize> = (0..all.len()).filter(|&k| kept[k]).collect();
    let mut pieces: Vec<(usize, usize)> = ends.windows(2).map(|w| (w[0], w[1])).collect();
    while let Some((i, j)) = pieces.pop() {
        let off = |k: &usize| missed([&all[i], &all[j]], &all[*k], &seen);
        let farthest = (i + 1..j).max_by(|a, b| off(a).total_cmp(&off(b)));
        if let Some(k) = farthest.filter(|k| off(k) > 1.0) {
            kept[k] = true;
            pieces.extend([(i, k), (k, j)]);
        }
    }
    all.iter().zip(kept).filter_map(|(vertex, kept)| kept.then_some(*vertex)).collect()
}

/// By how much a chord misses a vertex, as a multiple of what is seen.
fn missed([a, b]: [&Vertex; 2], at: &Vertex, seen: &[f32; 3]) -> f32 {
    let long = b.share - a.share;
    let y = if long > 0.0 { ((at.share - a.share) / long) as f32 } else { 0.5 };
    let off = |i: usize| (at.forces[i] - ((1.0 - y) * a.forces[i] + y * b.forces[i])).abs();
    (0..3).filter(|i| off(*i) > 0.0).map(|i| off(i) / seen[i]).fold(0.0, f32::max)
}

/// Rows of the vertices inside an interval of this number.
pub(super) fn rows(interval: usize, vertices: &[Vertex]) -> impl Iterator<Item = f32> {
    let inside = |vertex: &&Vertex| vertex.share > 0.0 && vertex.share < 1.0;
    let row = move |vertex: &Vertex| {
        let [axial, shear, moment] = vertex.forces;
        [interval as f32, vertex.share as f32, axial, shear, moment]
    };
    vertices.iter().filter(inside).flat_map(row)
}

impl StoredFrame {
    /// Whether its rows are those of so many intervals, in their order.
    pub(crate) fn has_points_of(&self, intervals: usize) -> bool {
        let (rows, rest) = self.section_points.as_chunks::<ROW>();
        let numbers = rows.iter().map(|row| row[0]);
        rest.is_empty()
            && rows.iter().all(|row| (0.0..intervals as f32).contains(&row[0]))
            && numbers.is_sorted()
    }

    /// The vertices of an interval, from its start to its end; the frame is one of the scene.
    pub(crate) fn vertices(&self, interval: usize) -> Vec<Vertex> {
        let end = |k: usize| -> [f32; 3] {
            let at = 6 * interval + 3 * k;
            std::array::from_fn(|i| self.section_forces.get(at + i).copied().unwrap_or(0.0))
        };
        // Rows are in the order of intervals.
        let rows = self.section_points.as_chunks::<ROW>().0;
        let from = rows.partition_point(|row| (row[0] as usize) < interval);
        let own = rows[from..].iter().take_while(|row| row[0] as usize == interval);
        let inside =
            own.map(|row| Vertex { share: f64::from(row[1]), forces: [row[2], row[3], row[4]] });
        let first = std::iter::once(Vertex { share: 0.0, forces: end(0) });
        first.chain(inside).chain([Vertex { share: 1.0, forces: end(1) }]).collect()
    }

    /// Section forces at a share of an interval, ahead of what jumps there.
    pub(crate) fn section_at(&self, interval: usize, share: f64) -> [f64; 3] {
        let all = self.vertices(interval);
        let after = all.iter().position(|v| v.share > share).unwrap_or(all.len() - 1).max(1);
        let (a, b) = (&all[after - 1], &all[after]);
        let long = b.share - a.share;
        let y = if long > 0.0 { ((share - a.share) / long).clamp(0.0, 1.0) } else { 1.0 };
        std::array::from_fn(|i| (1.0 - y) * f64::from(a.forces[i]) + y * f64::from(b.forces[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_keeps_its_jumps_corners_and_extremes_and_no_more() {
        // A triangle of moments with a jump of the shear force at a third, seen at every hundredth, and a bump too small to be seen.
        let moment = |x: f64| if x < 0.33 { 2.0 * x } else { 0.66 * (1.0 - x) / 0.67 };
        let shear = |x: f64| if x < 0.33 { 2.0 } else { -1.0 };
        let vertex = |x: f64, v: f64| Vertex {
            share: x,
            forces: [0.0, v as f32, (moment(x) + 1e-4 * (40.0 * x).sin()) as f32],
        };
        let mut all: Vec<Vertex> =
            (0..=100).map(|k| f64::from(k) / 100.0).map(|x| vertex(x, shear(x))).collect();
        all.insert(33, vertex(0.33, 2.0));
        let kept = simplified(&all, &Extent::of(all.iter().map(|v| v.forces)));
        assert!(kept.len() <= 8, "{kept:?}");
        let at_jump: Vec<f32> =
            kept.iter().filter(|v| v.share == 0.33).map(|v| v.forces[1]).collect();
        assert_eq!(at_jump, [2.0, -1.0]);
        let most = |list: &[Vertex]| list.iter().map(|v| v.forces[2]).fold(0.0, f32::max);
        assert_eq!(most(&kept), most(&all));
    }

    #[test]
    fn section_forces_between_stations_go_through_their_vertices() {
        let frame = StoredFrame {
            section_forces: vec![0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 5.0, 0.0, 0.0, 5.0, 0.0, 0.0],
            section_points: vec![0.0, 0.25, 0.0, 1.0, 3.0, 0.0, 0.25, 0.0, -1.0, 3.0],
            ..StoredFrame::default()
        };
        assert_eq!(frame.section_at(0, 0.125), [0.0, 1.0, 1.5]);
        assert_eq!(frame.section_at(0, 0.25), [0.0, -1.0, 3.0]);
        assert_eq!(frame.section_at(0, 0.625), [0.0, -1.0, 1.5]);
        assert_eq!(frame.section_at(1, 1.0), [5.0, 0.0, 0.0]);
    }
}
