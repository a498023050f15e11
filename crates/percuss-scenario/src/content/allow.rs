//! Findings and warnings that the author of a scenario knows of and allows.

use percuss_codes::{Caution, Code, Topic};
use serde_json::{Map, Value as Json, json};

use crate::code::FaultCode;
use crate::format::{Format, Written};
use crate::node::{Body, Node, Reader};
use crate::suggest;
use crate::write::{self, Writer};

/// A finding of the advisor, or a warning of a run's audit, that is allowed, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Allowed {
    /// What it is about.
    pub code: Code,
    /// Why it is no reason to worry, in the author's words.
    pub reason: String,
}

/// Codes with reasons: `[allow]`.
pub(crate) struct Allowances;

impl Allowances {
    /// What a code stands for, if it may be allowed, or what is wrong with it.
    fn code(written: &str) -> Result<Code, (FaultCode, String, String)> {
        let allowable = Code::allowable();
        if let Some(code) = allowable.iter().find(|one| one.code == written) {
            return Ok(*code);
        }
        let found = format!("the code {written:?}");
        match Code::find(written).filter(|one| !allowable.contains(one)) {
            Some(other) => {
                let what = match other.is_error() {
                    true => "an error, which cannot be accepted",
                    false => "which reports on a command and cannot be accepted in a scenario",
                };
                let found = format!("{found} ({}), {what}", other.name);
                Err((FaultCode::Conflict, found, Self::expected_codes()))
            }
            None => {
                let known = suggest::one_of(written, allowable.iter().map(|one| one.code));
                let expected = format!("{known}; `percuss explain` lists them");
                Err((FaultCode::UnknownName, found, expected))
            }
        }
    }

    fn expected_codes() -> String {
        let ends = |all: &[&'static str]| match all {
            [first, .., last] => format!("{first} to {last}"),
            all => all.concat(),
        };
        let findings = Topic::ALL.map(Topic::code);
        let audit = Caution::ALL.into_iter().filter(|one| one.is_of_the_audit());
        let audit: Vec<&str> = audit.map(Caution::code).collect();
        format!(
            "a warning of the model and result checks, {}, or of the audit of a run, {}",
            ends(&findings),
            ends(&audit)
        )
    }
}

impl Format for Allowances {
    type Value = Vec<Allowed>;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value> {
        let Some(body) = Body::of(node) else {
            reader.wrong(node, node.found(), Self::expected());
            return None;
        };
        let mut all = Vec::new();
        for (written, span) in body.keys() {
            let Some(node) = body.get(written) else { continue };
            let code = match Self::code(written) {
                Ok(code) => code,
                Err((kind, found, expected)) => {
                    reader.misplaced_as(kind, &node.path, span, (found, expected));
                    continue;
                }
            };
            match node.value.as_str().map(str::trim) {
                Some(reason) if !reason.is_empty() => {
                    all.push(Allowed { code, reason: reason.to_owned() });
                }
                found => {
                    let found = found.map_or_else(|| node.found(), |_| "an empty reason".into());
                    let expected =
                        "the reason, in your words, such as \"the span is meant to be short\"";
                    reader.wrong(&node, found, expected);
                }
            }
        }
        Some(all)
    }

    fn placeholder() -> Self::Value {
        Vec::new()
    }

    fn expected() -> String {
        "a table of codes of warnings, each with the reason why it is accepted".into()
    }

    fn schema() -> Json {
        let one = |code: Code| {
            let schema = json!({ "type": "string", "minLength": 1, "description": code.name });
            (code.code.to_owned(), schema)
        };
        let properties: Map<String, Json> = Code::allowable().into_iter().map(one).collect();
        json!({ "type": "object", "properties": properties, "additionalProperties": false })
    }
}

impl Written for Allowances {
    fn write(value: &Self::Value, key: &str, out: &mut Writer) {
        out.header(key, None);
        for one in value {
            out.line(one.code.code, &write::text(&one.reason), "");
        }
    }

    fn default_text(_: &Self::Value) -> Option<String> {
        None
    }
}
