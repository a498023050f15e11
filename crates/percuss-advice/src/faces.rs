//! Contact of beams along faces or with flat ends: its stiffness depends on the mesh.

use super::case::Beams;
use super::planned::PlannedContact;
use super::structure::BeamPlace;
use super::{Advice, Topic, Verdict};

use percuss::math::vec2::{cross, dot, sub};

/// Beams whose directions are parallel or at right angles but for this sine meet with more than a corner.
const ALIGNED: f64 = 0.1;

/// Each contact point acts with the full law, and finer meshes have more of them.
pub fn finding(planned: &PlannedContact<'_>, beams: &Beams<'_>) -> Option<Advice> {
    if planned.case.law.is_rigid() {
        return None;
    }
    let (first, second) = (beams.numbers.0, beams.numbers.1?);
    let [one, other] = [first, second].map(|number| planned.model.beam(number));
    let opposite = BeamPlace::in_the_middle(planned.model, second);
    let (own, tangent) = (beams.place.tangent(), opposite.tangent());
    let middle = BeamPlace::in_the_middle(planned.model, first);
    let between = sub(opposite.position(), middle.position());
    let along = cross(own, tangent).abs() < ALIGNED;
    let across = dot(own, tangent).abs() < ALIGNED;
    let contact = planned.model.contact(planned.case.index)?;
    // Ends that point at the other partner; a round one meets it with one point.
    let ends = [(first, own, one.length()), (second, tangent, other.length())];
    let pointing = ends.into_iter().filter(|(_, t, length)| dot(between, *t).abs() > 0.5 * length);
    let pointing: Vec<usize> = pointing.map(|(beam, ..)| beam).collect();
    let flat = !pointing.iter().any(|beam| contact.has_round_ends(*beam));
    let reported =
        if along { pointing.is_empty() || flat } else { across && flat && !pointing.is_empty() };
    let text = format!(
        "'{}' and '{}' {}: the stiffness grows with the number of contact points, so that force and duration have no limit under \
         refinement (secant stiffness: peak force over penetration); use a disc{}, or divide the stiffness by the number of points",
        one.name(),
        other.name(),
        if along {
            "touch along their faces or end to end"
        } else {
            "touch with a flat end on a face"
        },
        if along { "" } else { " or round ends" }
    );
    let (topic, verdict) = (Topic::FaceStiffness, Verdict::Note);
    reported.then(|| planned.finding(topic, [f64::NAN; 2], "N/m", verdict, text))
}
