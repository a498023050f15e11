//! Syntax errors of TOML, said the way the rest of the faults are.

use crate::code::FaultCode;
use crate::diagnostic::Diagnostic;
use crate::source::Source;

/// Syntax errors of a text.
pub(crate) fn faults(source: &Source, errors: &[toml::de::Error]) -> Vec<Diagnostic> {
    errors.iter().map(|error| fault(source, error)).collect()
}

fn fault(source: &Source, error: &toml::de::Error) -> Diagnostic {
    let span = source.clamp(error.span().unwrap_or(0..0));
    let (found, expected) = match error.message() {
        message if message.starts_with("string values must be quoted") => {
            unquoted(&source.text[span.clone()])
        }
        "duplicate key" => ("a key given twice".into(), "each key once".into()),
        message => {
            let (found, expected) = message.split_once(", expected ").unwrap_or((message, ""));
            let expected = match expected {
                "" | "nothing" => "valid TOML",
                expected => expected,
            };
            (format!("invalid TOML: {found}"), expected.to_string())
        }
    };
    Diagnostic::at(FaultCode::Syntax, source, span, "", found, expected)
}

/// A value that is no TOML: most often a quantity without its quotes.
fn unquoted(text: &str) -> (String, String) {
    let text = text.trim();
    if text.is_empty() {
        return ("no value".into(), "a value after the equals sign".into());
    }
    let quoted = toml_edit::Value::from(text).to_string();
    (format!("`{text}` without quotes"), format!("quotes round a text: {quoted}"))
}
