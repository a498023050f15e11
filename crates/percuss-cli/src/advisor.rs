//! What the advisor says of a run, before it and after it, what its audit warns of, and what of all that is denied.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use percuss_advice::{Advice, AuditWarning, Verdict, allow};
use percuss_codes::{Caution, Code};
use percuss_scenario::Content;

use crate::terminal;

/// Takes what the scenario allows from the warnings among the findings; they stay there with the reason.
pub fn judge(advice: &mut [Advice], content: &Content) {
    allow(advice, |code| content.reason_to_allow(code));
}

/// Findings listed one by one; those beyond are counted.
const MOST: usize = 50;

/// Tells notes and warnings, a line each, those said of several contacts once; what is fine stands in the report. Where there are very
/// many, the weightiest are reported and the rest is counted.
pub fn tell(advice: &[Advice]) {
    let mut reported: Vec<(&Advice, usize)> = Vec::new();
    let mut places: HashMap<(&str, Verdict, &str), usize> = HashMap::new();
    for one in advice.iter().filter(|one| one.verdict > Verdict::Fine) {
        match places.entry((one.topic.name(), one.verdict, one.text.as_str())) {
            Entry::Occupied(place) => reported[*place.get()].1 += 1,
            Entry::Vacant(place) => {
                place.insert(reported.len());
                reported.push((one, 1));
            }
        }
    }
    let rest = reported.len().saturating_sub(MOST);
    if rest > 0 {
        reported.sort_by_key(|(one, _)| std::cmp::Reverse(one.verdict));
        reported.truncate(MOST);
    }
    for (one, all) in reported {
        let contact = match all {
            1 => one.contact.clone(),
            all => format!("{} and {} more", one.contact, all - 1),
        };
        let text = format!("{contact}, {}: {}", one.topic.name(), one.text);
        say(one.topic.into(), one.verdict, (&text, one.reason.as_deref()));
    }
    if rest > 0 {
        terminal::tell(&format!("and {rest} more notes and warnings"));
    }
}

/// Tells what the audit of a run warns of.
pub fn tell_audit(warnings: &[AuditWarning]) {
    for one in warnings {
        say(one.caution.into(), one.verdict, (&one.text, one.reason.as_deref()));
    }
}

/// A line, and the reason why it is allowed.
fn say(code: Code, verdict: Verdict, (text, reason): (&str, Option<&str>)) {
    let reason = reason.map_or(String::new(), |why| format!(" (reason: {why})"));
    let text = format!("{text}{reason}");
    match verdict {
        Verdict::Fine => {}
        Verdict::Allowed => terminal::allowed(code, &text),
        Verdict::Note => terminal::note(code, &text),
        Verdict::Warning => terminal::warning(code, &text),
    }
}

/// Tells of codes that the scenario allows though nothing of them was found. `found` are those that were, `of` is what could be.
pub fn tell_in_vain(content: &Content, found: &[Code], of: impl Fn(Code) -> bool) {
    for one in content.allow.iter().filter(|one| of(one.code) && !found.contains(&one.code)) {
        let Code { code, name, .. } = one.code;
        let text = format!("[allow] {code}: no such warning ({name}); remove this line");
        terminal::note(one.code, &text);
    }
}

/// Codes of what was found, allowed or not.
pub fn codes(advice: &[Advice], warnings: &[AuditWarning]) -> Vec<Code> {
    let reported = advice.iter().filter(|one| one.verdict > Verdict::Fine);
    reported
        .map(|one| one.topic.into())
        .chain(warnings.iter().map(|one| one.caution.into()))
        .collect()
}

/// Notes and warnings whose codes are denied.
pub fn denied(advice: &[Advice], codes: &[Code]) -> Vec<String> {
    let found = advice.iter().filter(|a| a.verdict > Verdict::Allowed);
    let found = found.map(|a| (a.topic.into(), format!("{}: {}", a.contact, a.text)));
    found.filter_map(|(code, text)| refused(code, &text, codes)).collect()
}

/// The same of what the audit warns of.
pub fn denied_of_audit(warnings: &[AuditWarning], codes: &[Code]) -> Vec<String> {
    let found = warnings.iter().filter(|one| one.verdict > Verdict::Allowed);
    found.filter_map(|one| refused(one.caution.into(), &one.text, codes)).collect()
}

/// Warns of how the command went; the failure that it is, if it is denied.
pub fn warn(caution: Caution, text: &str, codes: &[Code]) -> Option<String> {
    terminal::warning(caution, text);
    refused(caution.into(), text, codes)
}

fn refused(code: Code, text: &str, codes: &[Code]) -> Option<String> {
    codes.contains(&code).then(|| format!("{} is denied", code.behind(text)))
}
