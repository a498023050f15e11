//! Where a projectile begins that flies at a point of a beam.

use percuss::{Fault, LinePoint};

use super::beams::Surface;
use crate::content::Projectile;

/// A line of motion closer to the line of the beam than this (sine of the angle) never meets its face.
const GRAZING: f64 = 1e-3;

/// Centre of a disc of given radius whose surface is `standoff` away from that of the beam, along its line of motion towards
/// the point; `None` after a fault.
pub(super) fn centre(
    name: &str,
    projectile: &Projectile,
    [radius, standoff]: [f64; 2],
    surface: Surface,
    faults: &mut Vec<Fault>,
) -> Option<[f64; 2]> {
    let mut fault = |key: &str, found: String, expected: &str| {
        faults.push(Fault::new(format!("projectile.{name}.{key}"), found, expected));
    };
    let line = line_of_motion(projectile, &mut fault)?;
    if standoff < 0.0 {
        let found = format!("an initial penetration of {} m", -standoff);
        fault("standoff", found, "a standoff of zero or above");
        return None;
    }
    let Some(reach) = reach(line, surface.at, radius + surface.half_depth) else {
        let found = "a direction of motion along the beam";
        fault("strikes", found.into(), "a direction of motion that meets the beam, or `position`");
        return None;
    };
    Some([0, 1].map(|i| surface.at.position[i] - line[i] * (standoff + reach)))
}

/// Distance along a line of motion from the point to a centre that is `r` away from the line of the beam.
fn reach(line: [f64; 2], at: LinePoint, r: f64) -> Option<f64> {
    let [t1, t2] = at.tangent;
    let outward = -(line[0] * t1 + line[1] * t2);
    // Beyond its ends a beam is round.
    if at.s <= 0.0 && outward < 0.0 || at.s >= at.length && outward > 0.0 {
        return Some(r);
    }
    let across = (line[1] * t1 - line[0] * t2).abs();
    (across > GRAZING).then(|| r / across)
}

/// Unit vector along the velocity, or the direction of a projectile at rest.
fn line_of_motion(
    projectile: &Projectile,
    fault: &mut impl FnMut(&str, String, &str),
) -> Option<[f64; 2]> {
    let unit = |v: [f64; 2]| {
        let length = v[0].hypot(v[1]);
        (length > 0.0).then(|| v.map(|c| c / length))
    };
    let (velocity, direction) = (unit(projectile.velocity), projectile.direction.map(unit));
    match (velocity, direction) {
        (Some(v), Some(d)) => {
            let along = d.is_some_and(|d| (d[0] - v[0]).hypot(d[1] - v[1]) < 1e-9);
            if !along {
                let [d1, d2] = projectile.direction.unwrap_or_default();
                let found = format!("[{d1}, {d2}], not along the velocity");
                fault("direction", found, "no direction, or that of the velocity");
            }
            along.then_some(v)
        }
        (Some(v), None) => Some(v),
        (None, Some(Some(d))) => Some(d),
        (None, direction) => {
            let key = if direction.is_some() { "direction" } else { "velocity" };
            let expected = "a velocity, or `direction` for a projectile at rest";
            fault(key, "zero velocity".into(), expected);
            None
        }
    }
}
