//! Plastic hinges and permanent deflections in words, of runs and of equilibria.

use percuss::{PermanentSet, PlasticHinge};

use percuss_output::round_off::{HINGE, without_round_off};

use crate::number::quantity;

/// The plastic hinge of the largest rotation with the element length there, and how many more there are; nothing if none is one for a reader.
pub fn plastic_hinges(hinges: &[PlasticHinge]) -> Option<String> {
    let reported: Vec<_> = hinges.iter().filter(|h| h.rotation.abs() >= HINGE).collect();
    let size = |hinge: &PlasticHinge| hinge.rotation.abs();
    let largest = reported.iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
    Some(match reported.len() - 1 {
        0 => format!("plastic hinge: {}", plastic_hinge(largest)),
        more => format!("largest plastic hinge: {}, and {more} more", plastic_hinge(largest)),
    })
}

/// Rotation, centre and length of a plastic hinge, and the element length at its centre.
fn plastic_hinge(hinge: &PlasticHinge) -> String {
    let rotation = quantity(hinge.rotation, "rad");
    let [centre, length, element] =
        [hinge.s, hinge.length, hinge.element_length].map(|x| quantity(x, "m"));
    format!("rotation {rotation}, centre s = {centre}, length {length} (element length {element})")
}

/// Size, components and place of a permanent deflection; a component that is round-off beside the other is zero.
pub fn permanent_deflection(set: &PermanentSet) -> String {
    let size = quantity(set.size(), "m");
    if set.s.is_nan() {
        return format!("permanent deflection {size}");
    }
    let plain = |x: f64| quantity(without_round_off(x, set.size()), "m");
    let ([x, y], s) = (set.displacement.map(plain), quantity(set.s, "m"));
    format!("permanent deflection {size}, (x, y) = ({x}, {y}) at s = {s}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_several_plastic_hinges_the_largest_is_described_and_the_others_are_counted() {
        let hinge = |rotation: f64| PlasticHinge {
            s: 0.5,
            length: 0.1,
            element_length: 0.02,
            rotation,
            dissipated: 1.0,
        };
        let of = "rotation -0.2 rad, centre s = 500 mm, length 100 mm (element length 20 mm)";
        let text = |all: &[f64]| {
            plastic_hinges(&all.iter().map(|rotation| hinge(*rotation)).collect::<Vec<_>>())
        };
        assert_eq!(text(&[-0.2]), Some(format!("plastic hinge: {of}")));
        let three = text(&[0.1, -0.2, 1e-6, 0.05]);
        assert_eq!(three, Some(format!("largest plastic hinge: {of}, and 2 more")));
        assert_eq!(text(&[1e-6]), None);
    }
}
