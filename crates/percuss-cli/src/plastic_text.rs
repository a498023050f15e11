//! Plastic hinges and permanent deflections in words, of runs and of equilibria.

use percuss::{PermanentSet, PlasticHinge};

use crate::number::quantity;

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
    let plain = |x: f64| quantity(if x.abs() < 1e-9 * set.size() { 0.0 } else { x }, "m");
    let ([x, y], s) = (set.displacement.map(plain), quantity(set.s, "m"));
    format!("permanent deflection {size}, (x, y) = ({x}, {y}) at s = {s}")
}
