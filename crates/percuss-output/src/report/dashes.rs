//! Dashes that run along a curve.
//!
//! The raster backend restarts the pattern at every point of a polyline, so a finely sampled curve
//! comes out solid. Here the curve is cut into its dashes beforehand.

use kuva::render::render::{Primitive, Scene};

/// The scene with every dashed polyline cut into solid ones.
pub(super) fn cut(mut scene: Scene) -> Scene {
    let mut elements = Vec::with_capacity(scene.elements.len());
    for element in scene.elements {
        match element {
            Primitive::PolyLine {
                points,
                stroke,
                stroke_width,
                stroke_dasharray: Some(pattern),
            } => {
                let lengths = lengths(&pattern);
                elements.extend(dashes(&points, &lengths).into_iter().map(|points| {
                    Primitive::PolyLine {
                        points,
                        stroke: stroke.clone(),
                        stroke_width,
                        stroke_dasharray: None,
                    }
                }));
            }
            other => elements.push(other),
        }
    }
    scene.elements = elements;
    scene
}

/// `9 4` as lengths, on and off in turn.
fn lengths(pattern: &str) -> Vec<f64> {
    let lengths: Vec<f64> =
        pattern.split([' ', ',']).filter_map(|n| n.parse().ok()).filter(|n| *n > 0.0).collect();
    if lengths.len().is_multiple_of(2) { lengths } else { lengths.repeat(2) }
}

/// The drawn parts of a polyline.
fn dashes(points: &[(f64, f64)], lengths: &[f64]) -> Vec<Vec<(f64, f64)>> {
    if lengths.is_empty() {
        return vec![points.to_vec()];
    }
    let mut parts = Vec::new();
    let mut part: Vec<(f64, f64)> = points.first().copied().into_iter().collect();
    let (mut k, mut left) = (0, lengths[0]);
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        let mut way = f64::hypot(to.0 - from.0, to.1 - from.1);
        while way.is_finite() && way > left {
            let share = left / way;
            from = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            way -= left;
            if k % 2 == 0 {
                part.push(from);
                parts.push(std::mem::take(&mut part));
            } else {
                part = vec![from];
            }
            k = (k + 1) % lengths.len();
            left = lengths[k];
        }
        left -= way;
        if k % 2 == 0 {
            part.push(to);
        }
    }
    if part.len() > 1 {
        parts.push(part);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pattern_runs_on_through_the_points_of_a_curve() {
        let fine: Vec<(f64, f64)> = (0..=190).map(|i| (f64::from(i) * 0.1, 0.0)).collect();
        let parts = dashes(&fine, &[3.0, 2.0]);
        let ends: Vec<(i64, i64)> = parts
            .iter()
            .map(|p| (p[0].0.round() as i64, p[p.len() - 1].0.round() as i64))
            .collect();
        assert_eq!(ends, [(0, 3), (5, 8), (10, 13), (15, 18)]);
    }
}
