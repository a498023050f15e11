//! Nearest points of an axis.

use super::*;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// For any bent axis: descent from any point decreases the distance, and the closest point overall is the result of the search in its own
    /// neighbourhood.
    #[test]
    fn closest_points_are_downhill_and_found_again(
        nodes in proptest::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64, -2.5..2.5_f64, -2.5..2.5_f64), 4),
        y in (-1.2..1.2_f64, -1.2..1.2_f64),
        (start, xi) in (0..3_usize, 0.0..1.0_f64),
    ) {
        let still = NodeFrame { position: [0.0; 2], tangent: [0.0; 2] };
        let frames = [still; 4];
        let displacement: Vec<_> = nodes.iter().map(|n| [n.0, n.1, n.2, n.3]).collect();
        let element =
            |k: usize| AxisElement { node: k, length: 1.0, s: k as f64, bent: 1.0, half_depths: [0.0; 2], deviations: [0.0; 3] };
        let elements = AxisElements::new((0..3).map(element).collect());
        let at = Configuration::of(&displacement);
        let arc = longest_arc(&elements, &frames, &at);
        let ends = elements.ends([0.0; 2]);
        let bounded =
            Axis { nodes: &frames, elements: &elements, skip: [0, 0], ends: &ends, arc, parted: &[] };
        let y = [y.0, y.1];
        let away = |p: AxisPoint| bounded.placed(p.element, &at).away(y, p.xi);

        let from = AxisPoint { element: start, xi };
        let near = bounded.near(y, &at, from, 0.0).point;
        prop_assert!(away(near) <= away(from) + 1e-12, "{} from {}", away(near), away(from));

        let nearest = bounded.nearest(y, &at, from, 0.0).map_or(from, |n| n.closest.point);
        let again = bounded.near(y, &at, nearest, 0.0).point;
        prop_assert!((away(again) - away(nearest)).abs() <= 1e-12);
        // Elements skipped by their length would not have been closer.
        let all = Axis { arc: f64::INFINITY, ..bounded };
        let unbounded = all.nearest(y, &at, from, 0.0).map_or(from, |n| n.closest.point);
        prop_assert!((away(unbounded) - away(nearest)).abs() <= 1e-12);
        // No point of a fine sampling is closer, except between the points of the search.
        for k in 0..3 {
            for j in 0..=200 {
                let sample = away(AxisPoint { element: k, xi: f64::from(j) / 200.0 });
                prop_assert!(sample >= away(nearest) - 1e-2, "{sample} {}", away(nearest));
            }
        }
    }
}
