//! Warnings of a run, the worst first: their number, and those shown above the scene.

use percuss::AuditSummary;
use serde_json::Value;

use super::html::escape;
use crate::shown::{FEW, NAMES};

/// Warnings of one kind with the same text.
struct Warning<'s> {
    code: &'s str,
    topic: &'s str,
    text: &'s str,
    /// Subjects: contacts, beams, ...; none for the run as a whole, shape (subjects).
    about: Vec<&'s str>,
}

/// The warnings that nobody has accepted: those of the finished run, which concern its results, then those of the checks.
fn of(summary: &Value) -> Vec<Warning<'_>> {
    let list = |key: &str| summary[key].as_array().map_or(&[][..], Vec::as_slice);
    let mut found: Vec<Warning<'_>> = Vec::new();
    for entry in list("warnings").iter().chain(list("advice")) {
        let word = |key: &str| entry[key].as_str().unwrap_or_default();
        if word("verdict") != "warning" {
            continue;
        }
        let about = Some(word("contact")).filter(|name| !name.is_empty());
        match found.iter_mut().find(|w| w.code == word("code") && w.text == word("text")) {
            Some(known) => known.about.extend(about),
            None => found.push(Warning {
                code: word("code"),
                topic: word("topic"),
                text: word("text"),
                about: about.into_iter().collect(),
            }),
        }
    }
    found.extend(unresolved(summary));
    found
}

/// That the step does not resolve the motion, by the same rule as the audit table.
fn unresolved(summary: &Value) -> Option<Warning<'_>> {
    let drift = summary["audit"]["angular_rate_drift_max"].as_f64()?;
    let text = "the time step does not resolve the motion; use a smaller step";
    let about = Vec::new();
    (drift > AuditSummary::UNRESOLVED).then_some(Warning {
        code: "",
        topic: "resolution",
        text,
        about,
    })
}

/// Whether the scenario accepts a finding about a subject.
pub(super) fn is_accepted(summary: &Value, codes: &[&str], subject: &str) -> bool {
    let of = |list: &Value| -> bool {
        list.as_array().into_iter().flatten().any(|one| {
            let own = one["contact"] == subject || one["contact"].is_null();
            own && one["verdict"] == "allowed" && codes.iter().any(|code| one["code"] == *code)
        })
    };
    of(&summary["advice"]) || of(&summary["warnings"])
}

/// Number of warnings that nobody has accepted, equal ones counted once.
pub(super) fn number(summary: &Value) -> usize {
    of(summary).len()
}

/// The name of a subject in quotes: `'hammer'`, `beam 'girder'`.
fn subject(of: &str) -> String {
    match of.split_once(' ') {
        Some(("beam", name)) => format!("beam '{name}'"),
        _ => format!("'{of}'"),
    }
}

/// The names of several subjects, of many the first ones.
fn subjects(all: &[&str]) -> String {
    let mut names: Vec<String> = all.iter().take(NAMES).map(|one| subject(one)).collect();
    let more = all.len() - names.len();
    let last = if more > 0 { format!("{more} more") } else { names.pop().unwrap_or_default() };
    format!("{} and {last}", names.join(", "))
}

/// The worst of them in a list; nothing where there are none.
pub(super) fn worst(summary: &Value) -> String {
    let all = of(summary);
    if all.is_empty() {
        return String::new();
    }
    let item = |w: &Warning<'_>| {
        let (code, topic, text) = (escape(w.code), escape(w.topic), escape(w.text));
        let about = match w.about.as_slice() {
            [] => String::new(),
            [one] => format!(", {}", subject(one)),
            several => format!(", {}", subjects(several)),
        };
        let title = format!("{code} {topic}{}", escape(&about));
        format!("<li><strong>{}:</strong> {text}</li>\n", title.trim_start())
    };
    let items: String = all.iter().take(FEW).map(item).collect();
    let link = match all.len() {
        1 => "Warning in full".to_owned(),
        n => format!("All {n} warnings in full"),
    };
    format!(
        "<aside class=\"warning worst\" aria-label=\"Warnings\">\n<ul>\n{items}</ul>\n\
         <p><a href=\"#checks\">{link}</a></p>\n</aside>\n"
    )
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn equal_warnings_count_once_and_accepted_ones_do_not() {
        let advice = |contact: &str, code: &str, verdict: &str| json!({ "contact": contact, "code": code, "topic": "t", "verdict": verdict, "text": code });
        let summary = json!({
            "advice": [
                advice("a<b>", "W002", "warning"), advice("b", "W002", "warning"), advice("c", "W007", "note"),
                advice("d", "W008", "allowed"), advice("e", "W009", "warning"), advice("f", "W010", "warning"),
            ],
            "warnings": [{ "code": "W101", "topic": "energy", "verdict": "warning", "text": "off" }],
        });
        assert_eq!(number(&summary), 4);
        let worst = worst(&summary);
        let place = |text: &str| worst.find(text).unwrap();
        assert!(
            place("W101 energy:") < place("W002 t, &#39;a&lt;b&gt;&#39; and &#39;b&#39;:"),
            "{worst}"
        );
        assert!(worst.contains("All 4 warnings in full") && !worst.contains("W010"), "{worst}");
        assert_eq!([subject("hammer"), subject("beam girder")], ["'hammer'", "beam 'girder'"]);
        assert_eq!(number(&json!({})), 0);
        assert!(super::worst(&json!({ "advice": 3 })).is_empty());
    }
}
