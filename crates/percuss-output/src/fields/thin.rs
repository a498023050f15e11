//! Fewer frames and stations, where a picture has to be small.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use super::polyline::{self, Extent, Vertex};
use super::{Fields, StoredFrame};

/// Columns of a beam in `scene.json`, one entry a station.
const COLUMNS: [&str; 8] = ["s", "x", "y", "tx", "ty", "half_depth", "area", "inertia"];

impl Fields {
    /// At most about so many frames in which something touches, and so many in which nothing does: every second, every third, ... of
    /// them, with the first, the last, and those of the largest force and impulse.
    pub fn thinned(&self, most: usize) -> Self {
        let kinds = [true, false].map(|touching| {
            let of_kind = |(_, f): &(usize, &StoredFrame)| f.contact_forces.is_empty() != touching;
            self.frames.iter().enumerate().filter(of_kind).map(|(k, _)| k).collect::<Vec<_>>()
        });
        let mut kept: BTreeSet<usize> = BTreeSet::new();
        for kind in kinds {
            let stride = kind.len().div_ceil(most.max(1)).max(1);
            kept.extend(kind.into_iter().step_by(stride));
        }
        kept.extend(self.frames.len().checked_sub(1));
        kept.extend([0.0, 1.0].into_iter().filter_map(|impulsive| self.largest(impulsive)));
        kept.extend((!self.frames.is_empty()).then_some(0));
        let frames = kept.into_iter().map(|k| self.frames[k].clone()).collect();
        Self { scene: self.scene.clone(), frames }
    }

    /// The frame with the largest resultant of a contact, among forces (0) or impulses (1).
    fn largest(&self, impulsive: f32) -> Option<usize> {
        let size = |frame: &StoredFrame| {
            let mut sums: Vec<[f32; 3]> = Vec::new();
            for row in frame.contact_forces.chunks_exact(6).filter(|row| row[5] == impulsive) {
                match sums.iter_mut().find(|sum| sum[0] == row[0]) {
                    Some(sum) => (sum[1], sum[2]) = (sum[1] + row[3], sum[2] + row[4]),
                    None => sums.push([row[0], row[3], row[4]]),
                }
            }
            sums.iter().map(|sum| sum[1].hypot(sum[2])).fold(0.0, f32::max)
        };
        let sizes = self.frames.iter().map(size).enumerate();
        sizes.filter(|(_, s)| *s > 0.0).max_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
    }

    /// Beams through every so manieth station of a span; ends of spans stay.
    pub fn coarsened(&self, every: usize) -> Self {
        let every = every.max(1);
        let beams = self.scene["beams"].as_array().cloned().unwrap_or_default();
        let (mut stations, mut intervals, mut node, mut interval) = (Vec::new(), Vec::new(), 0, 0);
        let (mut coarse, mut lengths) = (Vec::new(), Vec::new());
        for beam in beams {
            let kept = kept_stations(&beam, every);
            for pair in kept.windows(2).filter(|pair| at(&beam, pair[1]) > at(&beam, pair[0])) {
                // A span has an interval between any two neighbours.
                let count = pair[1] - pair[0];
                lengths.extend((pair[0]..pair[1]).map(|k| at(&beam, k + 1) - at(&beam, k)));
                intervals.push((interval, interval + count - 1));
                interval += count;
            }
            stations.extend(kept.iter().map(|k| node + k));
            node += beam["s"].as_array().map_or(0, Vec::len);
            coarse.push(with_columns(beam, &kept));
        }
        let frame = |frame: &StoredFrame| {
            let bodies = node..frame.displacement.len() / 4;
            let nodes = || stations.iter().copied().chain(bodies.clone());
            let of = |rows: &[f32]| -> Vec<f32> {
                nodes().filter_map(|n| rows.get(4 * n..4 * n + 4)).flatten().copied().collect()
            };
            let forces = |(a, b): &(usize, usize)| {
                let all = &frame.section_forces;
                [&all[6 * a..6 * a + 3], &all[6 * b + 3..6 * b + 6]].concat()
            };
            let spins = |(a, b): &(usize, usize)| {
                let at = |k: usize, i: usize| frame.angular_velocity.get(3 * k + i).copied();
                Some([at(*a, 0)?, at((a + b) / 2, 1 + (b - a) % 2)?, at(*b, 2)?])
            };
            StoredFrame {
                displacement: of(&frame.displacement),
                velocity: of(&frame.velocity),
                angular_velocity: intervals.iter().filter_map(spins).flatten().collect(),
                section_forces: intervals.iter().flat_map(forces).collect(),
                section_points: merged(frame, &intervals, &lengths),
                ..frame.clone()
            }
        };
        let mut scene = self.scene.clone();
        scene["beams"] = Value::Array(coarse);
        Self { scene, frames: self.frames.iter().map(frame).collect() }
    }
}

/// Rows inside intervals each of which has been several, from one number to another, of these lengths.
fn merged(frame: &StoredFrame, intervals: &[(usize, usize)], lengths: &[f64]) -> Vec<f32> {
    let all = (0..lengths.len()).flat_map(|k| frame.vertices(k));
    let extent = Extent::of(all.map(|vertex| vertex.forces));
    let rows = |(number, (a, b)): (usize, &(usize, usize))| {
        let (whole, mut from) = (lengths[*a..=*b].iter().sum::<f64>(), 0.0);
        let mut line: Vec<Vertex> = Vec::new();
        for k in *a..=*b {
            let moved = |v: Vertex| Vertex { share: (from + v.share * lengths[k]) / whole, ..v };
            line.extend(frame.vertices(k).into_iter().map(moved));
            from += lengths[k];
        }
        let line = if a < b { polyline::simplified(&line, &extent) } else { line };
        polyline::rows(number, &line).collect::<Vec<f32>>()
    };
    intervals.iter().enumerate().flat_map(rows).collect()
}

/// Arc length at a station.
fn at(beam: &Value, station: usize) -> f64 {
    beam["s"][station].as_f64().unwrap_or(0.0)
}

/// Both ends of every span, and every so manieth station between.
fn kept_stations(beam: &Value, every: usize) -> Vec<usize> {
    let count = beam["s"].as_array().map_or(0, Vec::len);
    let mut first = 0;
    let mut kept = Vec::new();
    for k in 0..count {
        let ends = k + 1 == count || at(beam, k + 1) <= at(beam, k);
        if ends || (k - first).is_multiple_of(every) {
            kept.push(k);
        }
        if ends {
            first = k + 1;
        }
    }
    kept
}

fn with_columns(mut beam: Value, kept: &[usize]) -> Value {
    for name in COLUMNS {
        let column: Vec<Value> = kept.iter().map(|k| beam[name][*k].clone()).collect();
        beam[name] = json!(column);
    }
    beam
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(count: usize) -> Vec<f64> {
        (0..count).map(|k| k as f64).collect()
    }

    /// A beam of two spans of four intervals and a body; frames that touch now and then.
    fn fields() -> Fields {
        let s = [column(5), column(5).iter().map(|s| s + 4.0).collect()].concat();
        let mut beam = json!({ "name": "b", "s": s });
        for name in &COLUMNS[1..] {
            beam[*name] = json!(column(10));
        }
        let frame = |k: usize| StoredFrame {
            time: k as f64,
            displacement: (0..44).map(|i| i as f32).collect(),
            velocity: (0..44).map(|i| i as f32).collect(),
            angular_velocity: (0..24).map(|i| i as f32).collect(),
            section_forces: (0..48).map(|i| i as f32).collect(),
            section_points: Vec::new(),
            contact_forces: match k {
                40..60 => vec![0.0, 0.0, 0.0, 1.0 + f32::from(k == 47), 0.0, 0.0],
                _ => Vec::new(),
            },
            load_factors: Vec::new(),
        };
        Fields { scene: json!({ "beams": [beam] }), frames: (0..100).map(frame).collect() }
    }

    #[test]
    fn few_frames_keep_the_ends_and_the_largest_force() {
        let times: Vec<f64> = fields().thinned(5).frames.iter().map(|f| f.time).collect();
        assert!((8..=13).contains(&times.len()), "{times:?}");
        assert!(times.contains(&0.0) && times.contains(&47.0) && times.contains(&99.0));
        assert!(times.windows(2).all(|w| w[0] < w[1] && w[1] - w[0] <= 20.0));
        assert_eq!(fields().thinned(100).frames.len(), 100);
        assert!(Fields::default().thinned(3).frames.is_empty());
    }

    #[test]
    fn few_stations_keep_ends_of_spans_and_the_forces_at_them() {
        let coarse = fields().coarsened(3);
        assert_eq!(coarse.scene["beams"][0]["s"], json!([0.0, 3.0, 4.0, 4.0, 7.0, 8.0]));
        let frame = &coarse.frames[0];
        let nodes = [0, 3, 4, 5, 8, 9, 10];
        let expected: Vec<f32> =
            nodes.iter().flat_map(|n| (4 * n..4 * n + 4).map(|i| i as f32)).collect();
        assert_eq!((&frame.displacement, &frame.velocity), (&expected, &expected));
        // The middle of three intervals is that of the second of them.
        assert_eq!(
            frame.angular_velocity,
            [0, 4, 8, 9, 10, 11, 12, 16, 20, 21, 22, 23].map(|i| i as f32)
        );
        // Of two it is the end of the first.
        assert_eq!(fields().coarsened(2).frames[0].angular_velocity[..3], [0.0, 2.0, 5.0]);
        // Intervals 0 to 2, 3, 4 to 6, 7: the start of the first and the end of the last.
        let rows = [(0, 2), (3, 3), (4, 6), (7, 7)]
            .map(|(a, b)| [6 * a, 6 * a + 1, 6 * a + 2, 6 * b + 3, 6 * b + 4, 6 * b + 5]);
        assert_eq!(
            frame.section_forces,
            rows.concat().iter().map(|i| *i as f32).collect::<Vec<_>>()
        );
        assert_eq!(fields().coarsened(1).frames, fields().frames);
    }
}
