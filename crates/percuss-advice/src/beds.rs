//! Foundations of compression alone from which the weight pulls the beam away.

use super::structure::gravity;
use super::words::digits;
use super::{Advice, Topic, Verdict};
use percuss::math::vec2::{add, dot, norm, scale};
use percuss::{FoundationLaw, Model};

/// Share of the weight along the direction in which a foundation pushes from which on it counts as pulled away.
const AWAY: f64 = 0.1;

/// Every such foundation, unless others on the same beam push against the weight.
pub fn findings(model: &Model) -> Vec<Advice> {
    let (weight, _) = gravity(model);
    let size = norm(weight);
    if size == 0.0 {
        return Vec::new();
    }
    // Mean direction in which each one pushes.
    let pushes: Vec<(usize, [f64; 2])> = (model.foundations())
        .map(|foundation| {
            let all =
                foundation.pushes(model).fold(([0.0; 2], 0.0), |(sum, total), (n, length)| {
                    (add(sum, scale(length, n)), total + length)
                });
            (foundation.beam(), scale(1.0 / all.1, all.0))
        })
        .collect();
    let away = |push: [f64; 2]| dot(push, weight) / size;
    let carried = |beam: usize| pushes.iter().any(|(on, push)| *on == beam && away(*push) < -AWAY);
    let of = |(foundation, (beam, push)): (
        percuss::inspect::FoundationView<'_>,
        &(usize, [f64; 2]),
    )| {
        let one_sided = matches!(foundation.law(), FoundationLaw::Compression { .. });
        if !one_sided || away(*push) <= AWAY || carried(*beam) {
            return None;
        }
        let [x, y] = push.map(digits);
        let [u, v] = push.map(|c| digits(0.0 - c));
        let text = format!(
            "it pushes in the direction ({x}, {y}), in which the weight acts, and never pulls: the weight moves the beam away from it. Without \
             `direction` it pushes to the left of the direction in which the beam is drawn; set direction = [{u}, {v}]"
        );
        let subject = format!("foundation {}", foundation.name());
        Some(Advice::new(subject, Topic::Bed, [f64::NAN; 2], "", Verdict::Warning, text))
    };
    model.foundations().zip(&pushes).filter_map(of).collect()
}
