//! Obstacles as areas, those that move with their bodies.

use serde_json::Value;

use super::placed::{Placed, pair, text};
use super::poly::{Cells, PolySeries};

/// Corners of a disc.
const CORNERS: usize = 96;
/// How far the area behind a straight line is drawn, as a share of the structure's size.
const DEEP: f64 = 0.1;

pub(super) fn series(placed: &Placed<'_>) -> Option<PolySeries> {
    let obstacles = placed.list("obstacles");
    let (mut cells, mut outline) = (Cells::default(), Vec::new());
    for (number, obstacle) in obstacles.iter().enumerate() {
        for area in areas(placed, obstacle) {
            let first = outline.len();
            let body = obstacle["body"].as_u64().and_then(|body| usize::try_from(body).ok());
            outline.extend(area.into_iter().map(|place| (place, body)));
            cells.polygons.push((first..outline.len()).collect());
            cells.polygon_of.push(i32::try_from(number).unwrap_or(i32::MAX));
        }
    }
    let moved = |frame| {
        outline.iter().map(move |(place, body): &([f64; 2], Option<usize>)| {
            let [u, _] = body.map_or([[0.0; 3]; 2], |body| placed.body(frame, body));
            [place[0] + u[0], place[1] + u[1]]
        })
    };
    Some(PolySeries {
        times: placed.frames.iter().map(|f| f.time).collect(),
        points: placed.frames.iter().flat_map(moved).collect(),
        counts: vec![outline.len(); placed.frames.len()],
        cells: Some(cells),
        arrays: Vec::new(),
        of: ("obstacle", obstacles.iter().map(|o| text(&o["name"])).collect()),
    })
}

fn areas(placed: &Placed<'_>, obstacle: &Value) -> Vec<Vec<[f64; 2]>> {
    match obstacle["kind"].as_str() {
        Some("half-plane") => {
            vec![behind(placed, pair(&obstacle["point"]), pair(&obstacle["normal"]))]
        }
        Some("disc") => {
            let (centre, radius) =
                (pair(&obstacle["centre"]), obstacle["radius"].as_f64().unwrap_or(0.0));
            let rim = |k: usize| {
                let angle = std::f64::consts::TAU * k as f64 / CORNERS as f64;
                [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]
            };
            vec![(0..CORNERS).map(rim).collect()]
        }
        Some("walls") => {
            let half =
                0.5 * obstacle["thickness"].as_f64().unwrap_or(0.0).max(2e-3 * placed.size());
            let ends = obstacle["ends"].as_array().map(Vec::as_slice).unwrap_or_default();
            ends.iter().map(|wall| thick(pair(&wall[0]), pair(&wall[1]), half)).collect()
        }
        _ => Vec::new(),
    }
}

/// A strip behind a line, as long as everything else is large.
fn behind(placed: &Placed<'_>, point: [f64; 2], n: [f64; 2]) -> Vec<[f64; 2]> {
    let [low, high] = placed.bounds;
    let t = [-n[1], n[0]];
    let middle = [0, 1].map(|i| 0.5 * (low[i] + high[i]) - point[i]);
    let at = middle[0] * t[0] + middle[1] * t[1];
    let (reach, deep) = (0.75 * placed.size(), DEEP * placed.size());
    let place = |x: f64, y: f64| [point[0] + x * t[0] - y * n[0], point[1] + x * t[1] - y * n[1]];
    vec![
        place(at - reach, 0.0),
        place(at + reach, 0.0),
        place(at + reach, deep),
        place(at - reach, deep),
    ]
}

fn thick(a: [f64; 2], b: [f64; 2], half: f64) -> Vec<[f64; 2]> {
    let along = [b[0] - a[0], b[1] - a[1]];
    let length = along[0].hypot(along[1]).max(f64::MIN_POSITIVE);
    let n = [-half * along[1] / length, half * along[0] / length];
    let side = |p: [f64; 2], sign: f64| [p[0] + sign * n[0], p[1] + sign * n[1]];
    vec![side(a, 1.0), side(a, -1.0), side(b, -1.0), side(b, 1.0)]
}
