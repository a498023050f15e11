//! Beams that can yield.

use percuss::{PlasticHinge, PlasticSummary, SectionPeak};
use serde_json::{Value, json};

/// What became of a beam that can yield.
pub(super) fn value(beam: &PlasticSummary) -> Value {
    json!({
        "strain_max": beam.strain_max.value,
        "strain_max_at": place(&beam.strain_max),
        "accumulated_max": beam.accumulated_max.value,
        "rotation": beam.rotation(),
        "permanent_set": beam.permanent_set,
        "first_yield": beam.first_yield.map(|first| json!({ "time": first.time, "s": first.s })),
        "dissipated": beam.dissipated,
        "hardening": beam.hardening,
        "failed_fibres": beam.failed,
        "hinges": beam.hinges.iter().map(hinge).collect::<Vec<_>>(),
    })
}

fn place(peak: &SectionPeak) -> Value {
    if peak.s.is_nan() { Value::Null } else { json!({ "s": peak.s, "time": peak.time }) }
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
