//! What a mesh adds to the plastic collapse load.

/// Farthest of three Gauss points from the start of an element of unit length.
const FAR: f64 = 0.887_298_334_620_741_7;

/// Distance of the pole of a plastic hinge at the end of an element over its length.
///
/// The curvature of an element is linear, and a hinge that turns by a unit angle about a pole at the share e has `4 - 6e` at its end and `6e - 2` at
/// the other, over the length. It does no more work than a hinge at a point as long as no Gauss point has a curvature of the other sign: down to
/// `e = (6 x - 4)/(12 x - 6)`, x the farthest Gauss point.
pub fn hinge_pole() -> f64 {
    (6.0 * FAR - 4.0) / (12.0 * FAR - 6.0)
}

/// Share by which a stretch between two plastic hinges bears more than its collapse load (upper bound theorem; M. R. Horne, Plastic Theory of
/// Structures): its length and those of its elements at the hinges, zero without a hinge, shape (2) \[m\]. The rigid parts between the hinges are
/// shorter by the distances of their poles.
pub fn collapse_excess(length: f64, at_hinges: [f64; 2]) -> f64 {
    let lever = length - hinge_pole() * (at_hinges[0] + at_hinges[1]);
    length / lever - 1.0
}

/// Number of elements with which an excess of a mesh of `count` elements falls to a share: it is proportional to the length of elements.
pub fn elements_for(count: usize, excess: f64, share: f64) -> usize {
    let lever = |excess: f64| excess / (1.0 + excess);
    (count as f64 * lever(excess) / lever(share)).ceil() as usize
}

#[cfg(test)]
mod tests {
    use super::super::near;
    use super::*;

    /// Loads borne by a clamped beam with a force in its middle over the exact one, by a linear program over all motions of such meshes.
    #[test]
    fn the_excess_is_that_of_the_limit_load_of_the_mesh() {
        for (elements, borne) in [(4, 1.398), (6, 1.234), (8, 1.166), (16, 1.077), (40, 1.029)] {
            let h = 1.0 / f64::from(elements);
            near(1.0 + collapse_excess(0.5, [h, h]), borne, 1e-3);
        }
        // Pinned ends: one hinge, in the middle.
        near(1.0 + collapse_excess(0.5, [0.125, 0.0]), 1.077, 1e-3);
        assert_eq!(elements_for(8, collapse_excess(0.5, [0.125; 2]), 0.03), 40);
    }
}
