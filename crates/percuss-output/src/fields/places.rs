//! Frames of the whole model as those of the scene's nodes and intervals.

use percuss::scene::Scene;
use percuss::{Frame, SectionPoint};

use super::StoredFrame;
use super::polyline::{self, Extent, Vertex};

/// Memory that the section forces inside an interval take \[bytes\], about: two vertices.
const INSIDE: usize = 40;

/// What of a model a scene is drawn from.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    /// Nodes of the scene, shape (nodes of the scene) \[index of a node\].
    nodes: Vec<usize>,
    /// Elements whose start and end bound each interval between stations, shape (intervals, 2) \[index of an element\].
    intervals: Vec<[usize; 2]>,
    /// Arc lengths of both ends of each interval, shape (intervals, 2) \[m\].
    stretches: Vec<[f64; 2]>,
    /// Loads of the scene.
    loads: usize,
}

impl Places {
    pub(crate) fn of(scene: &Scene) -> Self {
        let (mut intervals, mut stretches) = (Vec::new(), Vec::new());
        for beam in &scene.beams {
            for pair in beam.stations.windows(2) {
                // Between the end of a span and the next one lies nothing.
                if !pair[0].ends_span {
                    let last = pair[1].element - usize::from(!pair[1].ends_span);
                    intervals.push([pair[0].element, last]);
                    stretches.push([pair[0].s, pair[1].s]);
                }
            }
        }
        Self { nodes: scene.nodes.clone(), intervals, stretches, loads: scene.loads.len() }
    }

    /// Memory that a frame takes \[bytes\], about.
    pub(super) fn bytes(&self) -> usize {
        32 * self.nodes.len() + (36 + INSIDE) * self.intervals.len() + 64
    }

    /// A frame as it is kept.
    pub(super) fn stored(&self, frame: &Frame<'_>) -> StoredFrame {
        let at = |element: usize| quadratic(frame.spin.get(element).copied().unwrap_or_default());
        let spins = self.intervals.iter().flat_map(|[a, b]| {
            // With an even number of elements the middle is the end of one.
            let middle = at((a + b) / 2)[1 + (b - a) % 2];
            [at(*a)[0], middle, at(*b)[2]]
        });
        StoredFrame {
            velocity: self.of_nodes(frame.velocity),
            angular_velocity: spins.map(single).collect(),
            ..self.still(frame)
        }
    }

    /// The same of a structure at rest. Section forces that are not given are none.
    pub(crate) fn still(&self, frame: &Frame<'_>) -> StoredFrame {
        let at = |element: usize, end: usize| {
            frame.section_forces.get(element).map_or([0.0; 3], |ends| ends[end])
        };
        let forces = self.intervals.iter().flat_map(|[a, b]| [at(*a, 0), at(*b, 1)]).flatten();
        let contacts = frame.contact_forces.iter().flat_map(|c| {
            let ([x, y], [f, g]) = (c.position, c.force);
            [c.contact as f64, x, y, f, g, f64::from(u8::from(c.impulsive))]
        });
        StoredFrame {
            time: frame.time,
            displacement: self.of_nodes(frame.displacement),
            velocity: Vec::new(),
            angular_velocity: Vec::new(),
            section_forces: forces.map(single).collect(),
            section_points: self.inside(frame),
            contact_forces: contacts.map(single).collect(),
            load_factors: (0..self.loads)
                .map(|k| frame.load_factors.get(k).copied().map_or(0.0, single))
                .collect(),
        }
    }

    /// Section forces inside the intervals.
    fn inside(&self, frame: &Frame<'_>) -> Vec<f32> {
        let (mut rows, mut rest) = (Vec::new(), frame.section_points);
        let several = self.intervals.iter().any(|[a, b]| a < b);
        let all = rest.iter().map(|point| point.forces.map(single));
        let extent = if several { Extent::of(all) } else { Extent::default() };
        for (number, ([first, last], [from, to])) in
            self.intervals.iter().zip(&self.stretches).enumerate()
        {
            let (own, others) = rest.split_at(rest.partition_point(|point| point.element <= *last));
            rest = others;
            let share = |s: f64| (s - from) / (to - from);
            let vertex = |point: &SectionPoint| Vertex {
                share: share(point.s),
                forces: point.forces.map(single),
            };
            let mut vertices: Vec<Vertex> = own.iter().map(vertex).collect();
            if first < last {
                vertices.dedup();
                vertices = polyline::simplified(&vertices, &extent);
            }
            rows.extend(polyline::rows(number, &vertices));
        }
        rows
    }

    /// Whether a frame is one of this scene.
    pub(super) fn fits(&self, frame: &StoredFrame) -> bool {
        let nodes = 4 * self.nodes.len();
        frame.displacement.len() == nodes
            && frame.velocity.len() == nodes
            && frame.angular_velocity.len() == 3 * self.intervals.len()
            && frame.section_forces.len() == 6 * self.intervals.len()
            && frame.has_points_of(self.intervals.len())
            && frame.contact_forces.len().is_multiple_of(6)
            && frame.load_factors.len() == self.loads
    }

    /// A shape without forces, of `shape` (n_node or fewer: those beyond rest), by the size of its largest displacement.
    pub(crate) fn shape(&self, shape: &[[f64; 4]]) -> StoredFrame {
        let size = shape.iter().map(|u| u[0].hypot(u[1])).fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        let scaled: Vec<[f64; 4]> = shape.iter().map(|u| u.map(|u| u / size)).collect();
        StoredFrame {
            displacement: self.of_nodes(&scaled),
            section_forces: vec![0.0; 6 * self.intervals.len()],
            load_factors: vec![0.0; self.loads],
            ..StoredFrame::default()
        }
    }

    fn of_nodes(&self, rows: &[[f64; 4]]) -> Vec<f32> {
        let row = |n: &usize| rows.get(*n).copied().unwrap_or([0.0; 4]);
        self.nodes.iter().flat_map(row).map(single).collect()
    }
}

/// The quadratic through values at the three Gauss points: at the start, in the middle and at the end of the element.
fn quadratic([first, middle, last]: [f64; 3]) -> [f64; 3] {
    let d = 0.6_f64.sqrt();
    let end = |near: f64, far: f64| ((1.0 + d) * near + (1.0 - d) * far) / 1.2 - middle / 1.5;
    [end(first, last), middle, end(last, first)]
}

fn single(x: f64) -> f32 {
    x as f32
}
