//! What the advisor says of a run, before it and after it.

use percuss_advice::{Advice, Topic, Verdict};

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
        let (name, code) = (one.topic.name(), one.topic.code());
        let text = format!("{contact}, {name}: {} [{code}]", one.text);
        match one.verdict {
            Verdict::Fine => {}
            Verdict::Note => terminal::note(&text),
            Verdict::Warning => terminal::warning(&text),
        }
    }
}

/// Findings, fine ones left out, whose topics are denied.
pub fn denied(advice: &[Advice], topics: &[Topic]) -> Vec<String> {
    let found = advice.iter().filter(|a| a.verdict > Verdict::Fine && topics.contains(&a.topic));
    let text = |a: &Advice| format!("{}: {} [{}] is denied", a.contact, a.text, a.topic.code());
    found.map(text).collect()
}
