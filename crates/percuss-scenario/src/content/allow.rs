//! Findings that the author of a scenario knows of and allows.

use percuss_codes::{Code, Topic};
use serde_json::{Map, Value as Json, json};

use super::Content;
use crate::code::FaultCode;
use crate::format::{Format, Written};
use crate::node::{Body, Node, Reader};
use crate::suggest;
use crate::write::{self, Writer};

/// A finding of the advisor that is allowed, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Allowed {
    /// What it is about.
    pub topic: Topic,
    /// Why it is no reason to worry, in the author's words.
    pub reason: String,
}

impl Content {
    /// Why findings about a topic are allowed, if they are.
    pub fn reason_to_allow(&self, topic: Topic) -> Option<&str> {
        self.allow.iter().find(|one| one.topic == topic).map(|one| one.reason.as_str())
    }

    /// What is allowed, each with its reason.
    pub fn allowances(&self) -> Vec<(Topic, &str)> {
        self.allow.iter().map(|one| (one.topic, one.reason.as_str())).collect()
    }
}

/// Codes with reasons: `[allow]`.
pub(crate) struct Allowances;

impl Allowances {
    /// The topic of a code, or what is wrong with it.
    fn topic(code: &str) -> Result<Topic, (FaultCode, String, String)> {
        let exact = Topic::of_code(code).filter(|topic| topic.code() == code);
        if let Some(topic) = exact {
            return Ok(topic);
        }
        let found = format!("the code {code:?}");
        match Code::find(code).filter(|_| Topic::of_code(code).is_none()) {
            Some(other) => {
                let what = if other.is_error() { "an error" } else { "a warning of the command" };
                let (first, last) = (Topic::ALL[0], Topic::ALL[Topic::ALL.len() - 1]);
                let found = format!("{found} ({}), {what}, which cannot be allowed", other.name);
                let expected =
                    format!("a finding of the advisor, {} to {}", first.code(), last.code());
                Err((FaultCode::Conflict, found, expected))
            }
            None => {
                let known = suggest::one_of(code, Topic::ALL.into_iter().map(Topic::code));
                let expected = format!("{known}; `percuss explain` lists them");
                Err((FaultCode::UnknownName, found, expected))
            }
        }
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
        for (code, span) in body.keys() {
            let Some(node) = body.get(code) else { continue };
            let topic = match Self::topic(code) {
                Ok(topic) => topic,
                Err((kind, found, expected)) => {
                    reader.misplaced_as(kind, &node.path, span, (found, expected));
                    continue;
                }
            };
            match node.value.as_str().map(str::trim) {
                Some(reason) if !reason.is_empty() => {
                    all.push(Allowed { topic, reason: reason.to_owned() });
                }
                found => {
                    let found = found.map_or_else(|| node.found(), |_| "an empty reason".into());
                    let expected = "why it is allowed, in your words, such as \"the span is meant to be short\"";
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
        "a table of codes of the advisor's findings, each with the reason why it is allowed".into()
    }

    fn schema() -> Json {
        let one = |topic: Topic| {
            let schema = json!({ "type": "string", "minLength": 1, "description": topic.name() });
            (topic.code().to_owned(), schema)
        };
        let properties: Map<String, Json> = Topic::ALL.into_iter().map(one).collect();
        json!({ "type": "object", "properties": properties, "additionalProperties": false })
    }
}

impl Written for Allowances {
    fn write(value: &Self::Value, key: &str, out: &mut Writer) {
        out.header(key, None);
        for one in value {
            out.line(one.topic.code(), &write::text(&one.reason), "");
        }
    }

    fn default_text(_: &Self::Value) -> Option<String> {
        None
    }
}
