//! Shapes of a structure: smooth curves through the nodes, drawn over the configuration they are taken about.

use kuva::render::render::{Primitive, Scene, TextAnchor};
use percuss::Model;

use crate::report::pictures::COLOURS;

/// Points of all curves of a panel, about.
const POINTS: usize = 4000;
/// Points an element at most.
const MOST_PIECES: usize = 16;
/// Largest displacement drawn, as a share of the structure's size.
const AMPLITUDE: f64 = 0.1;
/// Room around the structure, as a share of its size.
const ROOM: f64 = 0.13;
/// Width of a panel, and bounds of its height.
const PANEL: f64 = 380.0;
const HEIGHTS: (f64, f64) = (110.0, 420.0);
/// Height of a title, and room between panels.
const TITLE: f64 = 26.0;
const GAP: f64 = 24.0;

/// A shape to draw and what stands above it.
pub(crate) struct Panel<'a> {
    pub title: String,
    /// Index of the colour.
    pub style: usize,
    /// Nodal displacements and slopes, of any size, shape (nodes, 4) \[m, -\].
    pub shape: &'a [[f64; 4]],
}

/// Polylines, one a beam.
type Curves = Vec<Vec<[f64; 2]>>;

/// All panels on one sheet, each over the configuration at `displacement` (of the nodes).
pub(crate) fn sheet(model: &Model, displacement: &[[f64; 4]], panels: &[Panel<'_>]) -> Scene {
    let base = curves(model, |n| displacement[n]);
    let (low, high) = bounds(&base);
    let size = (high[0] - low[0]).max(high[1] - low[1]).max(f64::MIN_POSITIVE);
    let room = ROOM * size;
    let (width, height) = (high[0] - low[0] + 2.0 * room, high[1] - low[1] + 2.0 * room);
    let tall = (PANEL * height / width).clamp(HEIGHTS.0, HEIGHTS.1);
    let scale = (PANEL / width).min(tall / height);
    let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
    let columns = if tall > 0.6 * PANEL { 3 } else { 2 }.min(panels.len().max(1));
    let rows = panels.len().div_ceil(columns);
    let cell = (PANEL + GAP, tall + TITLE + GAP);
    let mut scene = Scene::new(columns as f64 * cell.0 + GAP, rows as f64 * cell.1 + GAP);
    scene.text_color = Some(COLOURS[0].to_owned());
    for (k, panel) in panels.iter().enumerate() {
        let corner = (GAP + (k % columns) as f64 * cell.0, GAP + (k / columns) as f64 * cell.1);
        scene.add(text(corner.0, corner.1 + 13.0, &panel.title));
        let place = |x: &[f64; 2]| {
            (
                corner.0 + 0.5 * PANEL + scale * (x[0] - middle[0]),
                corner.1 + TITLE + 0.5 * tall - scale * (x[1] - middle[1]),
            )
        };
        let factor = AMPLITUDE * size / largest(panel.shape);
        let moved = curves(model, |n| {
            std::array::from_fn(|i| displacement[n][i] + factor * panel.shape[n][i])
        });
        add(&mut scene, &base, "#aab2bb", 1.5, place);
        add(&mut scene, &moved, COLOURS[panel.style % COLOURS.len()], 2.0, place);
    }
    scene
}

fn add(
    scene: &mut Scene,
    curves: &Curves,
    colour: &str,
    width: f64,
    place: impl Fn(&[f64; 2]) -> (f64, f64),
) {
    for curve in curves {
        scene.add(Primitive::PolyLine {
            points: curve.iter().map(&place).collect(),
            stroke: colour.into(),
            stroke_width: width,
            stroke_dasharray: None,
        });
    }
}

fn text(x: f64, y: f64, content: &str) -> Primitive {
    Primitive::Text {
        x,
        y,
        content: content.to_owned(),
        size: 14,
        anchor: TextAnchor::Start,
        rotate: None,
        bold: false,
        color: None,
    }
}

/// The beams with the given displacements of their nodes: Hermite's cubic in every element, as the solver has it.
fn curves(model: &Model, displacement: impl Fn(usize) -> [f64; 4]) -> Curves {
    let pieces = (POINTS / model.element_count().max(1)).clamp(1, MOST_PIECES);
    let stride = model.element_count().div_ceil(POINTS).max(1);
    let of_beam = |name: &str| {
        let elements: Vec<_> = model.beam_elements(name).collect();
        let last = elements.len().saturating_sub(1);
        let mut curve: Vec<[f64; 2]> = Vec::new();
        for (k, (node, length, ends)) in elements.into_iter().enumerate() {
            if k % stride != 0 && k != last {
                continue;
            }
            let moved = |end: usize| -> [f64; 4] {
                let u = displacement(node + end);
                std::array::from_fn(|i| ends[end][i] + u[i])
            };
            let (a, b) = (moved(0), moved(1));
            let first = usize::from(!curve.is_empty());
            curve.extend(
                (first..=pieces).map(|p| hermite(&a, &b, length, p as f64 / pieces as f64)),
            );
        }
        curve
    };
    model.beam_names().map(of_beam).collect()
}

/// A point of the cubic between two nodes (x1, x2, x1', x2') at a share of the length.
fn hermite(a: &[f64; 4], b: &[f64; 4], length: f64, x: f64) -> [f64; 2] {
    let y = 1.0 - x;
    let (ha, hb) = (y * y * (1.0 + 2.0 * x), x * x * (1.0 + 2.0 * y));
    let (ga, gb) = (length * x * y * y, -length * x * x * y);
    std::array::from_fn(|i| ha * a[i] + hb * b[i] + ga * a[i + 2] + gb * b[i + 2])
}

fn bounds(curves: &Curves) -> ([f64; 2], [f64; 2]) {
    let start = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    curves.iter().flatten().fold(start, |(low, high), x| {
        ([low[0].min(x[0]), low[1].min(x[1])], [high[0].max(x[0]), high[1].max(x[1])])
    })
}

/// Largest displacement of a node.
fn largest(shape: &[[f64; 4]]) -> f64 {
    let size = shape.iter().map(|u| u[0].hypot(u[1])).fold(0.0, f64::max);
    if size > 0.0 { size } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_between_nodes_is_met_everywhere() {
        // x^3 from 1 to 3
        let node = |x: f64| [x, x.powi(3), 1.0, 3.0 * x * x];
        for share in [0.0, 0.3, 0.5, 1.0] {
            let [x, y] = hermite(&node(1.0), &node(3.0), 2.0, share);
            assert!((x - (1.0 + 2.0 * share)).abs() < 1e-14);
            assert!((y - x.powi(3)).abs() < 1e-12, "{share}");
        }
    }
}
