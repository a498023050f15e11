//! What the advisor says before a run.

use percuss::{Advice, Verdict};

use crate::terminal;

/// Tells notes and warnings, a line each; what is fine stands in the report.
pub fn tell(advice: &[Advice]) {
    for one in advice {
        let text = format!("{}, {}: {}", one.contact, one.topic.name(), one.text);
        match one.verdict {
            Verdict::Fine => {}
            Verdict::Note => terminal::note(&text),
            Verdict::Warning => terminal::warning(&text),
        }
    }
}
