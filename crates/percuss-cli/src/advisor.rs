//! What the advisor says of a run, before it and after it.

use percuss_advice::{Advice, Topic, Verdict, allow};
use percuss_scenario::Content;

use crate::terminal;

/// Takes what the scenario allows from the warnings among the findings; they stay there with the reason.
pub fn judge(advice: &mut [Advice], content: &Content) {
    allow(advice, |topic| content.reason_to_allow(topic));
}

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
        let reason = one.reason.as_ref().map_or(String::new(), |why| format!(" (reason: {why})"));
        let text = format!("{contact}, {name}: {}{reason} [{code}]", one.text);
        match one.verdict {
            Verdict::Fine => {}
            Verdict::Allowed => terminal::allowed(&text),
            Verdict::Note => terminal::note(&text),
            Verdict::Warning => terminal::warning(&text),
        }
    }
}

/// Tells of codes that the scenario allows though nothing of them was found. `of` is what could be found.
pub fn tell_in_vain(content: &Content, advice: &[Advice], of: impl Fn(Topic) -> bool) {
    for one in content.allow.iter().filter(|one| of(one.topic)) {
        if !advice.iter().any(|a| a.topic == one.topic && a.verdict > Verdict::Fine) {
            let code = one.topic.code();
            terminal::note(&format!(
                "[allow] {code}: nothing of this kind was found ({}); the line can be left out [{code}]",
                one.topic.name()
            ));
        }
    }
}

/// Notes and warnings whose topics are denied.
pub fn denied(advice: &[Advice], topics: &[Topic]) -> Vec<String> {
    let found = advice.iter().filter(|a| a.verdict > Verdict::Allowed && topics.contains(&a.topic));
    let text = |a: &Advice| format!("{}: {} [{}] is denied", a.contact, a.text, a.topic.code());
    found.map(text).collect()
}
