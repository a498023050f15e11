//! Supports as lines: the symbols of the drawings, as large as a share of the structure.

use serde_json::Value;

use super::placed::{OnAxis, Placed, pair, text};
use super::poly::{Cells, PolySeries};
use crate::fields::StoredFrame;

/// Half the size of a symbol, as a share of the structure's size.
const SIZE: f64 = 0.015;
/// Strokes of a hatched line.
const STROKES: usize = 5;
/// Corners of a spring.
const TURNS: usize = 10;

type Line = Vec<[f64; 2]>;

pub(super) fn series(placed: &Placed<'_>) -> Option<PolySeries> {
    let supports = placed.list("supports");
    let rest = StoredFrame {
        displacement: vec![0.0; placed.frames[0].displacement.len()],
        ..StoredFrame::default()
    };
    let all = |frame: &StoredFrame| -> Vec<(usize, Line)> {
        let of = |(number, support): (usize, &Value)| {
            let lines = symbol(placed, support, frame, &rest).unwrap_or_default();
            lines.into_iter().map(move |line| (number, line))
        };
        supports.iter().enumerate().flat_map(of).collect()
    };
    let (mut cells, mut count) = (Cells::default(), 0);
    for (number, line) in all(&placed.frames[0]) {
        cells.lines.push((count..count + line.len()).collect());
        cells.line_of.push(i32::try_from(number).unwrap_or(i32::MAX));
        count += line.len();
    }
    Some(PolySeries {
        times: placed.frames.iter().map(|f| f.time).collect(),
        points: placed
            .frames
            .iter()
            .flat_map(|f| all(f).into_iter().flat_map(|(_, line)| line))
            .collect(),
        counts: vec![count; placed.frames.len()],
        cells: Some(cells),
        arrays: Vec::new(),
        of: ("support", supports.iter().map(|s| text(&s["name"])).collect()),
    })
}

/// The lines of a support, of as many points in every frame; once it has let go, all in one place.
fn symbol(
    placed: &Placed<'_>,
    support: &Value,
    frame: &StoredFrame,
    rest: &StoredFrame,
) -> Option<Vec<Line>> {
    let (at, depth) = placed.on(&support["at"], frame)?;
    let (reference, _) = placed.on(&support["at"], rest)?;
    let h = SIZE * placed.size();
    let direction = pair(&support["direction"]);
    let mut lines = match support["kind"].as_str()? {
        "pin" => on_triangle(&at, upright(&reference), h, true),
        "roller" => on_triangle(&at, downward([direction[1], -direction[0]]), h, false),
        "elastic" => {
            let down = downward(direction);
            let end = ahead(reference.place, 2.5 * h, down);
            let mut lines = vec![spring(at.place, end, 0.5 * h)];
            lines.extend(hatched(end, down, h, h));
            lines
        }
        "stop" => stop(support, (&at, &reference), depth, h),
        _ => clamp(placed, support, &at, depth, h),
    };
    let until = support["until"].as_f64().unwrap_or(f64::INFINITY);
    if frame.time > until {
        lines.iter_mut().flatten().for_each(|point| *point = at.place);
    }
    Some(lines)
}

/// A wall across the beam, behind its end.
fn clamp(placed: &Placed<'_>, support: &Value, at: &OnAxis, depth: f64, h: f64) -> Vec<Line> {
    let beam = support["at"]["beam"].as_u64().and_then(|k| placed.beams.get(k as usize));
    let length = beam.and_then(|b| b.s.last()).copied().unwrap_or(0.0);
    let ends = support["at"]["s"].as_f64().is_some_and(|s| s > 0.5 * length);
    let tangent = [at.normal[1], -at.normal[0]];
    let behind = if ends { tangent } else { tangent.map(|t| -t) };
    hatched(at.place, behind, h.max(1.3 * depth), h)
}

/// A plate where the way ends, on a spring; one on either side of what stops both ways.
fn stop(support: &Value, (at, rest): (&OnAxis, &OnAxis), depth: f64, h: f64) -> Vec<Line> {
    let gap = support["gap"].as_f64().unwrap_or(0.0);
    let both = support["two_sided"].as_bool().unwrap_or(false);
    let sides: &[f64] = if both { &[1.0, -1.0] } else { &[1.0] };
    let one = |side: &f64| {
        let d = pair(&support["direction"]).map(|x| side * x);
        let moved = [at.place[0] - rest.place[0], at.place[1] - rest.place[1]];
        let way = gap.max(moved[0] * d[0] + moved[1] * d[1]);
        let plate = ahead(rest.place, way + depth, d);
        let end = ahead(rest.place, gap + depth + 2.5 * h, d);
        let across = [-d[1], d[0]];
        let mut lines = vec![vec![ahead(plate, -h, across), ahead(plate, h, across)]];
        lines.push(spring(plate, end, 0.4 * h));
        lines.extend(hatched(end, d, h, h));
        lines
    };
    sides.iter().flat_map(one).collect()
}

/// A triangle with its tip at the point, on hatched ground, or free to roll along a line.
fn on_triangle(at: &OnAxis, down: [f64; 2], h: f64, fixed: bool) -> Vec<Line> {
    let across = [-down[1], down[0]];
    let base = ahead(at.place, 1.4 * h, down);
    let corners = [ahead(base, 0.8 * h, across), ahead(base, -0.8 * h, across)];
    let mut lines = vec![vec![at.place, corners[0], corners[1], at.place]];
    if fixed {
        lines.extend(hatched(base, down, h, 0.6 * h));
    } else {
        let rail = ahead(base, 0.4 * h, down);
        lines.push(vec![ahead(rail, h, across), ahead(rail, -h, across)]);
    }
    lines
}

/// A line across a direction, with strokes on the side it points to.
fn hatched(middle: [f64; 2], into: [f64; 2], half: f64, stroke: f64) -> Vec<Line> {
    let across = [-into[1], into[0]];
    let mut lines = vec![vec![ahead(middle, half, across), ahead(middle, -half, across)]];
    for k in 0..STROKES {
        let share = 2.0 * (k as f64 + 0.5) / STROKES as f64 - 1.0;
        let from = ahead(middle, share * half, across);
        lines.push(vec![from, ahead(ahead(from, 0.6 * stroke, into), -0.4 * stroke, across)]);
    }
    lines
}

fn spring(a: [f64; 2], b: [f64; 2], half: f64) -> Line {
    let along = [b[0] - a[0], b[1] - a[1]];
    let length = along[0].hypot(along[1]).max(f64::MIN_POSITIVE);
    let across = [-along[1] / length, along[0] / length];
    let corner = |k: usize| {
        let place = ahead(a, k as f64 / TURNS as f64, along);
        let side = if k == 0 || k == TURNS { 0.0 } else { 2.0 * (k % 2) as f64 - 1.0 };
        ahead(place, side * half, across)
    };
    (0..=TURNS).map(corner).collect()
}

/// Across a level beam downward, to the side of one that stands.
fn upright(rest: &OnAxis) -> [f64; 2] {
    let upright = rest.normal[0].abs() > 0.8;
    if upright { [-rest.normal[0].signum(), 0.0] } else { [0.0, -1.0] }
}

/// A direction, turned where it points up.
fn downward(d: [f64; 2]) -> [f64; 2] {
    if d[1] > 0.0 || (d[1] == 0.0 && d[0] > 0.0) { d.map(|x| -x) } else { d }
}

fn ahead(p: [f64; 2], by: f64, d: [f64; 2]) -> [f64; 2] {
    [p[0] + by * d[0], p[1] + by * d[1]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::Fields;
    use serde_json::json;

    /// A level beam of 2 m whose right end rises by 0.1 m in a second.
    fn fields(supports: Value) -> Fields {
        let beam = json!({ "name": "b", "s": [0.0, 2.0], "x": [0.0, 2.0], "y": [0.0, 0.0], "tx": [1.0, 1.0], "ty": [0.0, 0.0],
            "half_depth": [0.02, 0.02], "area": [1.0, 1.0], "inertia": [1.0, 1.0] });
        let frame = |time: f64| StoredFrame {
            time,
            displacement: vec![0.0, 0.0, 0.0, 0.0, 0.0, 0.1 * time as f32, 0.0, 0.0],
            section_forces: vec![0.0; 6],
            ..StoredFrame::default()
        };
        let scene = json!({ "beams": [beam], "bodies": [], "supports": supports });
        Fields { scene, frames: vec![frame(0.0), frame(1.0)] }
    }

    #[test]
    fn supports_are_lines_that_follow_the_beam_until_they_let_go() {
        let all = json!([
            { "name": "wall", "kind": "clamp", "at": { "beam": 0, "s": 0.0 }, "until": null },
            { "name": "hinge", "kind": "pin", "at": { "beam": 0, "s": 2.0 }, "until": null },
            { "name": "rail", "kind": "roller", "direction": [1.0, 0.0], "at": { "beam": 0, "s": 2.0 }, "until": 0.5 },
            { "name": "spring", "kind": "elastic", "direction": [0.0, 1.0], "at": { "beam": 0, "s": 2.0 }, "until": null },
            { "name": "stop", "kind": "stop", "direction": [0.0, 1.0], "gap": 0.05, "two_sided": true, "at": { "beam": 0, "s": 2.0 }, "until": null },
        ]);
        let fields = fields(all);
        let placed = Placed::new(&fields).unwrap();
        let series = series(&placed).unwrap();
        let cells = series.cells.as_ref().unwrap();
        assert_eq!(series.of.1, ["wall", "hinge", "rail", "spring", "stop"]);
        assert_eq!(series.counts, [series.points.len() / 2; 2]);
        assert!(series.points.as_flattened().iter().all(|x| x.is_finite()));
        let of = |number: i32, frame: usize| -> Vec<[f64; 2]> {
            let lines = cells.lines.iter().zip(&cells.line_of).filter(|(_, of)| **of == number);
            lines
                .flat_map(|(line, _)| line)
                .map(|p| series.points[frame * series.counts[0] + p])
                .collect()
        };
        let near = |a: f64, b: f64| (a - b).abs() < 1e-7;
        // The wall stands behind the start, the tip of the hinge follows its end.
        assert!(of(0, 1).iter().all(|p| p[0] <= 1e-12) && of(0, 1).iter().any(|p| p[0] < -1e-3));
        assert_eq!(of(1, 0)[0], [2.0, 0.0]);
        assert!(near(of(1, 1)[0][1], 0.1) && of(1, 1)[1..3].iter().all(|p| p[1] < 0.1));
        // What has let go is a single place.
        assert!(of(2, 0).iter().any(|p| p[1] < -1e-3));
        assert!(of(2, 1).iter().all(|p| near(p[0], 2.0) && near(p[1], 0.1)));
        // The end of the spring on the ground stays where it is, the other rises.
        let (before, after) = (of(3, 0), of(3, 1));
        assert!(near(before[TURNS][1], after[TURNS][1]) && near(after[0][1], 0.1));
        // The upper plate is pushed on from the end of its way, the lower one stays.
        let plates = [0, 1].map(|frame| of(4, frame)[0][1]);
        assert!(near(plates[0], 0.05 + 0.02) && near(plates[1], 0.1 + 0.02), "{plates:?}");
    }
}
