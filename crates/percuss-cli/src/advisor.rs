//! What the advisor says before a run.

use percuss::{Advice, Verdict};

use crate::terminal;

/// Tells notes and warnings, a line each, those said of several contacts once; what is fine stands in the report.
pub fn tell(advice: &[Advice]) {
    let same =
        |a: &Advice, b: &Advice| (a.topic, a.verdict, &a.text) == (b.topic, b.verdict, &b.text);
    for (k, one) in advice.iter().enumerate() {
        if advice[..k].iter().any(|before| same(before, one)) {
            continue;
        }
        let contact = match advice[k..].iter().filter(|after| same(after, one)).count() {
            1 => one.contact.clone(),
            all => format!("{} and {} more", one.contact, all - 1),
        };
        let text = format!("{contact}, {}: {}", one.topic.name(), one.text);
        match one.verdict {
            Verdict::Fine => {}
            Verdict::Note => terminal::note(&text),
            Verdict::Warning => terminal::warning(&text),
        }
    }
}
