//! The advisor's findings and the hand formulas in `summary.json`.

use percuss_advice::{Advice, AuditWarning, Comparison, Verdict};
use percuss_codes::Code;
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

/// What the audit of the run warns of.
pub(super) fn warning(warning: &AuditWarning) -> Value {
    json!({
        "code": warning.caution.code(),
        "topic": warning.caution.name(),
        "verdict": warning.verdict.name(),
        "text": warning.text,
        "reason": warning.reason,
    })
}

/// What a scenario allows, a code with its reason each, and whether the run had such a finding or warning: `allow` of a summary.
pub(super) fn allowances(
    allowed: &[(Code, &str)],
    advice: &[Advice],
    warnings: &[AuditWarning],
) -> Value {
    let reported = advice.iter().filter(|one| one.verdict > Verdict::Fine);
    let found: Vec<Code> = reported
        .map(|one| one.topic.into())
        .chain(warnings.iter().map(|one| one.caution.into()))
        .collect();
    let one = |(code, reason): &(Code, &str)| {
        json!({
            "code": code.code,
            "topic": code.name,
            "reason": reason,
            "found": found.contains(code),
        })
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
        "bound": comparison.bound,
        "holds_if": comparison.holds_if,
    })
}
