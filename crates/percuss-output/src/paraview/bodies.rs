//! Discs with a spoke, and guided projectiles as blocks before the beam they strike.

use serde_json::Value;

use super::placed::{Placed, pair, text};
use super::poly::{Array, Cells, PolySeries};
use crate::fields::StoredFrame;

/// Corners of a disc.
const CORNERS: usize = 48;
/// Half the side of a block, and the length of a free spring, as shares of the structure's size: masses are points.
const BLOCK: f64 = 0.015;
const SPRING: f64 = 0.05;

pub(super) fn series(placed: &Placed<'_>) -> Option<PolySeries> {
    let bodies = placed.list("bodies");
    let mut cells = Cells::default();
    let (mut points, mut counts) = (Vec::new(), Vec::new());
    let mut velocity = Array::new("velocity", "m/s", 3);
    for (k, frame) in placed.frames.iter().enumerate() {
        let before = points.len();
        let mut front = [0.0; 2];
        for (number, body) in bodies.iter().enumerate() {
            let shape = match body["kind"].as_str() {
                Some("disc") => disc(placed, frame, (number, body)),
                Some("guided") => {
                    let Some(shape) = guided(placed, frame, (number, body)) else { continue };
                    front = shape.front;
                    shape
                }
                Some("rear") if number > 0 => {
                    rear(placed, frame, (number, &bodies[number - 1]), front)
                }
                _ => continue,
            };
            if k == 0 {
                shape.join(&mut cells, points.len(), number);
            }
            shape.velocities.iter().for_each(|v| velocity.vector(*v));
            points.extend(shape.points);
        }
        counts.push(points.len() - before);
    }
    Some(PolySeries {
        times: placed.frames.iter().map(|f| f.time).collect(),
        points,
        counts,
        cells: Some(cells),
        arrays: if placed.has_velocities() { vec![velocity] } else { Vec::new() },
        of: ("body", bodies.iter().map(|b| text(&b["name"])).collect()),
    })
}

/// A body in a frame: the corners of its area, then points of a line.
struct Shape {
    corners: usize,
    /// Points of its outline, shape (points, 2) \[m\].
    points: Vec<[f64; 2]>,
    /// Their velocities, shape (points, 2) \[m/s\].
    velocities: Vec<[f64; 2]>,
    /// The point that leads, shape (2) \[m\].
    front: [f64; 2],
}

impl Shape {
    fn join(&self, cells: &mut Cells, first: usize, number: usize) {
        let number = i32::try_from(number).unwrap_or(i32::MAX);
        cells.polygons.push((first..first + self.corners).collect());
        cells.polygon_of.push(number);
        if self.points.len() > self.corners {
            cells.lines.push((first + self.corners..first + self.points.len()).collect());
            cells.line_of.push(number);
        }
    }
}

fn disc(placed: &Placed<'_>, frame: &StoredFrame, (number, body): (usize, &Value)) -> Shape {
    let [u, v] = placed.body(frame, number);
    let (at, radius) = (pair(&body["position"]), body["radius"].as_f64().unwrap_or(0.0));
    let centre = [at[0] + u[0], at[1] + u[1]];
    let rim = |k: usize| {
        let angle = u[2] + std::f64::consts::TAU * k as f64 / CORNERS as f64;
        [radius * angle.cos(), radius * angle.sin()]
    };
    let mut arms: Vec<[f64; 2]> = (0..CORNERS).map(rim).collect();
    arms.extend([[0.0; 2], rim(0)]);
    Shape {
        corners: CORNERS,
        points: arms.iter().map(|r| [centre[0] + r[0], centre[1] + r[1]]).collect(),
        velocities: arms.iter().map(|r| [v[0] - v[2] * r[1], v[1] + v[2] * r[0]]).collect(),
        front: centre,
    }
}

/// Before the surface that it strikes, at the true gap; an elastic one behind its spring.
fn guided(
    placed: &Placed<'_>,
    frame: &StoredFrame,
    (number, body): (usize, &Value),
) -> Option<Shape> {
    let (struck, depth) = placed.on(&body["strikes"], frame)?;
    let [u, v] = placed.body(frame, number);
    let d = pair(&body["direction"]);
    let along = |w: [f64; 2]| w[0] * d[0] + w[1] * d[1];
    let gap = body["standoff"].as_f64()? + along(struck.displacement) - along([u[0], u[1]]);
    let off = depth + gap.max(0.0);
    let surface = [struck.place[0] - off * d[0], struck.place[1] - off * d[1]];
    let free =
        if body["elastic"].as_bool().unwrap_or(false) { SPRING * placed.size() } else { 0.0 };
    let length = free - (-gap).clamp(0.0, 0.7 * free);
    let front = [surface[0] - length * d[0], surface[1] - length * d[1]];
    Some(block(placed.size(), front, d, (surface, [v[0], v[1]])))
}

/// Behind the mass before it, as far as both have moved towards each other.
fn rear(
    placed: &Placed<'_>,
    frame: &StoredFrame,
    (number, guided): (usize, &Value),
    front: [f64; 2],
) -> Shape {
    let [u, v] = placed.body(frame, number);
    let [ahead, _] = placed.body(frame, number - 1);
    let d = pair(&guided["direction"]);
    let size = placed.size();
    let come = (u[0] - ahead[0]) * d[0] + (u[1] - ahead[1]) * d[1];
    let gap = (SPRING * size - come).max(0.3 * SPRING * size);
    let back = |by: f64| [front[0] - by * d[0], front[1] - by * d[1]];
    block(size, back(2.0 * BLOCK * size + gap), d, (back(2.0 * BLOCK * size), [v[0], v[1]]))
}

/// A square whose front is at a point, and the line from there on.
fn block(size: f64, front: [f64; 2], d: [f64; 2], (tip, v): ([f64; 2], [f64; 2])) -> Shape {
    let half = BLOCK * size;
    let corner = |a: f64, b: f64| {
        [front[0] + half * (a * d[0] - b * d[1]), front[1] + half * (a * d[1] + b * d[0])]
    };
    let points = vec![
        corner(0.0, 1.0),
        corner(-2.0, 1.0),
        corner(-2.0, -1.0),
        corner(0.0, -1.0),
        front,
        tip,
    ];
    Shape { corners: 4, velocities: vec![v; points.len()], points, front }
}
