//! Contact forces as points with vectors, for arrows.

use super::placed::{Placed, text};
use super::poly::{Array, PolySeries};

pub(super) fn series(placed: &Placed<'_>) -> Option<PolySeries> {
    let contacts = placed.list("contacts");
    let turned: Vec<bool> = contacts.iter().map(|c| is_turned(placed, c)).collect();
    let (mut points, mut counts) = (Vec::new(), Vec::new());
    let mut force = Array::new("force", "N", 3);
    let mut impulse = Array::new("impulse", "N s", 3);
    let mut number = Array::new("contact", "1", 1);
    for frame in placed.frames {
        let before = points.len();
        for row in frame.contact_forces.chunks_exact(6) {
            let [contact, x, y, f, g, impulsive] = std::array::from_fn(|i| f64::from(row[i]));
            let sign =
                if turned.get(contact as usize).copied().unwrap_or(false) { -1.0 } else { 1.0 };
            let vector = [sign * f, sign * g];
            let is_impulse = impulsive > 0.5;
            points.push([x, y]);
            force.vector(if is_impulse { [0.0; 2] } else { vector });
            impulse.vector(if is_impulse { vector } else { [0.0; 2] });
            number.number(contact);
        }
        counts.push(points.len() - before);
    }
    Some(PolySeries {
        times: placed.frames.iter().map(|f| f.time).collect(),
        points,
        counts,
        cells: None,
        arrays: vec![force, impulse, number],
        of: ("contact", contacts.iter().map(|c| text(&c["name"])).collect()),
    })
}

/// Whether the force on the first partner is meant: that on the beam, where a body presses on one.
fn is_turned(placed: &Placed<'_>, contact: &serde_json::Value) -> bool {
    let bodies = || placed.list("bodies").iter().chain(placed.list("obstacles"));
    let is_body = |name: &serde_json::Value| bodies().any(|b| b["name"] == *name);
    let between = &contact["between"];
    is_body(&between[1]) && !is_body(&between[0])
}
