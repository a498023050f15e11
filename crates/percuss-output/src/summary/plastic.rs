//! Beams, springs and hinges that can yield.

use percuss::{
    JointSummary, NoPermanentSet, Parting, PermanentSet, PlasticHinge, PlasticSummary, SectionPeak,
    SetOfBeam, YieldingSummary,
};
use serde_json::{Value, json};

use super::peak::peak;

/// What became of a beam that can yield.
pub(crate) fn value(beam: &PlasticSummary) -> Value {
    let mut value = json!({
        "strain_max": beam.strain_max.value,
        "strain_max_at": place(&beam.strain_max),
        "accumulated_max": beam.accumulated_max.value,
        "rotation": beam.rotation(),
        "first_yield": beam.first_yield.map(|first| json!({ "time": first.time, "s": first.s })),
        "dissipated": beam.dissipated,
        "dissipated_by_preload": beam.dissipated_by_preload,
        "hardening": beam.hardening,
        "failed_fibres": beam.failed,
        "parted": beam.parted.iter().map(parting).collect::<Vec<_>>(),
        "hinges": beam.hinges.iter().map(hinge).collect::<Vec<_>>(),
    });
    if let Value::Object(entries) = &mut value {
        let at = |set: &PermanentSet| json!({ "s": set.s, "displacement": set.displacement });
        let set = beam.permanent_set.as_ref();
        entries.extend(permanent_set(set.map(|set| (set.size(), at(set)))));
    }
    value
}

/// How large a permanent set is and where, or `null` and why.
fn permanent_set(
    found: Result<(f64, Value), &NoPermanentSet>,
) -> impl Iterator<Item = (String, Value)> + use<> {
    let ((size, at), note) = match found {
        Ok((size, at)) => ((size.into(), at), None),
        Err(reason) => ((Value::Null, Value::Null), Some(reason.to_string())),
    };
    let entries = [("permanent_set", Some(size)), ("permanent_set_at", Some(at))];
    let all = entries.into_iter().chain([("permanent_set_note", note.map(Value::from))]);
    all.filter_map(|(key, value)| Some((key.to_owned(), value?)))
}

/// The same of the beams that a spring or hinge acts on.
pub(crate) fn set_beside(
    found: &Result<SetOfBeam, NoPermanentSet>,
) -> impl Iterator<Item = (String, Value)> + use<> {
    let at = |of: &SetOfBeam| json!({ "beam": of.beam, "s": of.set.s, "displacement": of.set.displacement });
    permanent_set(found.as_ref().map(|of| (of.set.size(), at(of))))
}

/// What became of a spring or hinge that can yield.
pub(super) fn yielding(connector: &YieldingSummary) -> Value {
    let [what, force] =
        if connector.turns { ["rotation", "moment"] } else { ["extension", "force"] };
    let at = |time: Option<f64>| json!({ "time": time });
    let entries = [
        (format!("plastic_{what}"), connector.plastic.into()),
        (format!("plastic_{what}_max"), peak(&connector.plastic_max)),
        (format!("accumulated_{what}"), connector.accumulated.into()),
        (format!("{what}_max"), peak(&connector.extension_max)),
        (format!("{force}_max"), peak(&connector.force_max)),
        ("first_yield".into(), at(connector.first_yield)),
        ("dissipated".into(), connector.dissipated.into()),
        ("dissipated_by_preload".into(), connector.dissipated_by_preload.into()),
        ("hardening".into(), connector.hardening.into()),
        ("failure".into(), at(connector.failed)),
    ];
    let set = set_beside(&connector.permanent_set);
    Value::Object(entries.into_iter().chain(set).collect())
}

/// What became of a joint of a given strength.
pub(super) fn joint(joint: &JointSummary) -> Value {
    json!({
        "force_max": peak(&joint.force_max),
        "moment_max": peak(&joint.moment_max),
        "parted": joint.parted.map(|p| json!({ "time": p.time, "force": p.force, "moment": p.moment })),
    })
}

fn place(peak: &SectionPeak) -> Value {
    if peak.s.is_nan() { Value::Null } else { json!({ "s": peak.s, "time": peak.time }) }
}

fn parting(parting: &Parting) -> Value {
    json!({
        "s": parting.s,
        "stretch": parting.stretch,
        "time": parting.time,
        "energy": parting.energy,
    })
}

fn hinge(hinge: &PlasticHinge) -> Value {
    json!({
        "s": hinge.s,
        "length": hinge.length,
        "element_length": hinge.element_length,
        "rotation": hinge.rotation,
        "dissipated": hinge.dissipated,
    })
}
