//! The advisor's findings and the hand formulas in `summary.json`.

use percuss_advice::{Advice, Comparison, Topic, Verdict};
use serde_json::{Value, json};

/// A finding before the run.
pub(super) fn finding(advice: &Advice) -> Value {
    json!({
        "contact": advice.contact,
        "code": advice.topic.code(),
        "topic": advice.topic.name(),
        "verdict": advice.verdict.name(),
        "value": advice.value,
        "reference": advice.reference,
        "unit": advice.unit,
        "text": advice.text,
        "reason": advice.reason,
    })
}

/// What a scenario allows, a code with its reason each, and whether the run had such a finding: `allow` of a summary.
pub fn allowances(allowed: &[(Topic, &str)], advice: &[Advice]) -> Value {
    let one = |&(topic, reason): &(Topic, &str)| {
        let found = advice.iter().any(|one| one.topic == topic && one.verdict > Verdict::Fine);
        json!({ "code": topic.code(), "topic": topic.name(), "reason": reason, "found": found })
    };
    allowed.iter().map(one).collect()
}

/// A result beside a hand formula.
pub(super) fn comparison(comparison: &Comparison) -> Value {
    json!({
        "contact": comparison.contact,
        "formula": comparison.formula,
        "source": comparison.source,
        "quantity": comparison.quantity,
        "unit": comparison.unit,
        "by_hand": comparison.by_hand,
        "simulated": comparison.simulated,
        "difference_percent": comparison.difference_percent,
        "holds_if": comparison.holds_if,
    })
}
