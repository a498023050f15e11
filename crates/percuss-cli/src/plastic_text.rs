//! Plastic hinges and permanent deflections in words, of runs and of equilibria.

use percuss::{PermanentSet, PlasticHinge};

use percuss_output::round_off::{HINGE, without_round_off};

use crate::number::quantity;

/// The plastic hinge of the largest rotation, if it is one for a reader.
pub fn largest_hinge(hinges: &[PlasticHinge]) -> Option<&PlasticHinge> {
    let reported = hinges.iter().filter(|hinge| hinge.rotation.abs() >= HINGE);
    reported.max_by(|a, b| a.rotation.abs().total_cmp(&b.rotation.abs()))
}

/// Rotation, centre and length of a plastic hinge.
pub fn plastic_hinge(hinge: &PlasticHinge) -> String {
    let (rotation, length) = (quantity(hinge.rotation, "rad"), quantity(hinge.length, "m"));
    let centre = quantity(hinge.s, "m");
    format!("plastic hinge: rotation {rotation}, centre s = {centre}, length {length}")
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
