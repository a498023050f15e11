//! Beams, springs and hinges that can yield.

use percuss::{JointSummary, Parting, PlasticHinge, PlasticSummary, SectionPeak, YieldingSummary};
use serde_json::{Map, Value, json};

use super::peak;

/// What became of a beam that can yield.
pub(crate) fn value(beam: &PlasticSummary) -> Value {
    json!({
        "strain_max": beam.strain_max.value,
        "strain_max_at": place(&beam.strain_max),
        "accumulated_max": beam.accumulated_max.value,
        "rotation": beam.rotation(),
        "permanent_set": beam.permanent_set.map(|set| set.size()),
        "permanent_set_at": beam.permanent_set.map(|set| json!({ "s": set.s, "displacement": set.displacement })),
        "first_yield": beam.first_yield.map(|first| json!({ "time": first.time, "s": first.s })),
        "dissipated": beam.dissipated,
        "dissipated_by_preload": beam.dissipated_by_preload,
        "hardening": beam.hardening,
        "failed_fibres": beam.failed,
        "parted": beam.parted.iter().map(parting).collect::<Vec<_>>(),
        "hinges": beam.hinges.iter().map(hinge).collect::<Vec<_>>(),
    })
}

/// What became of a spring or hinge that can yield.
pub(super) fn yielding(connector: &YieldingSummary) -> Value {
    let what = if connector.turns { "rotation" } else { "extension" };
    let at = |time: Option<f64>| json!({ "time": time });
    let entries = [
        (format!("plastic_{what}"), connector.plastic.into()),
        (format!("plastic_{what}_max"), peak(&connector.plastic_max)),
        (format!("accumulated_{what}"), connector.accumulated.into()),
        (format!("{what}_max"), peak(&connector.extension_max)),
        ("first_yield".into(), at(connector.first_yield)),
        ("dissipated".into(), connector.dissipated.into()),
        ("dissipated_by_preload".into(), connector.dissipated_by_preload.into()),
        ("hardening".into(), connector.hardening.into()),
        ("failure".into(), at(connector.failed)),
    ];
    Value::Object(Map::from_iter(entries))
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
