//! What the advisor says of a run, before it and after it, what its audit warns of, and what of all that is denied.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use percuss_advice::{Advice, AuditWarning, Verdict, allow};
use percuss_codes::{Caution, Code};
use percuss_scenario::Content;

use crate::terminal;
use percuss_output::shown::{FINDINGS, NAMES};

/// Takes what the scenario allows from the warnings among the findings; they stay there with the reason.
pub fn judge(advice: &mut [Advice], content: &Content) {
    allow(advice, |code| content.reason_to_allow(code));
}

/// Tells notes and warnings, a line each, those said of several contacts once; what is fine stands in the report. Where there are very
/// many, the weightiest are reported and the rest is counted.
pub fn tell(advice: &[Advice]) {
    let mut reported = grouped(advice);
    let rest = reported.len().saturating_sub(FINDINGS);
    if rest > 0 {
        reported.sort_by_key(|group| std::cmp::Reverse(group.first.verdict));
        reported.truncate(FINDINGS);
    }
    for group in reported {
        let one = group.first;
        let text = format!("{}, {}: {}", group.names(), one.topic.name(), one.text);
        let text = if group.differ { format!("{text} (of {})", one.contact) } else { text };
        say(one.topic.into(), one.verdict, (&text, one.reason.as_deref()));
    }
    if rest > 0 {
        terminal::tell(&format!("and {rest} more notes and warnings"));
    }
}

/// Findings that say the same of several subjects.
struct Group<'a> {
    /// The first of them, whose text is reported.
    first: &'a Advice,
    /// Their subjects, shape (subjects).
    subjects: Vec<&'a str>,
    /// Whether their numbers differ.
    differ: bool,
}

/// Findings of one kind with numbers of their own that are reported one by one.
const APART: usize = 4;

impl Group<'_> {
    /// The subjects, of many the first ones.
    fn names(&self) -> String {
        let all = &self.subjects;
        match all.len() - all.len().min(NAMES) {
            0 => all.join(", "),
            more => format!("{} and {more} more", all[..NAMES].join(", ")),
        }
    }
}

/// What is worth reporting, equal findings once: those whose texts differ in nothing but names of subjects, and those that differ in numbers, too,
/// where there are many.
fn grouped(advice: &[Advice]) -> Vec<Group<'_>> {
    let worth = || advice.iter().filter(|one| one.verdict > Verdict::Fine);
    let mut kinds: HashMap<Kind<'_>, usize> = HashMap::new();
    worth().for_each(|one| *kinds.entry(kind(one, true)).or_default() += 1);
    let mut groups: Vec<Group<'_>> = Vec::new();
    let mut places: HashMap<Kind<'_>, usize> = HashMap::new();
    for one in worth() {
        let many = kinds[&kind(one, true)] > APART;
        match places.entry(kind(one, many)) {
            Entry::Occupied(place) => {
                let group = &mut groups[*place.get()];
                group.differ |= shape(&one.text, false) != shape(&group.first.text, false);
                group.subjects.push(&one.contact);
            }
            Entry::Vacant(place) => {
                place.insert(groups.len());
                groups.push(Group { first: one, subjects: vec![&one.contact], differ: false });
            }
        }
    }
    groups
}

/// Topic, verdict, reason, and the text without what differs between subjects.
type Kind<'a> = (&'a str, Verdict, Option<&'a str>, String);

fn kind(one: &Advice, without_numbers: bool) -> Kind<'_> {
    (one.topic.name(), one.verdict, one.reason.as_deref(), shape(&one.text, without_numbers))
}

/// A text without the names in quotes, and without its numbers.
fn shape(text: &str, without_numbers: bool) -> String {
    let names: String = text.split('\'').step_by(2).collect::<Vec<_>>().join("''");
    let plain = |c: char| !(without_numbers && (c.is_ascii_digit() || c == '.'));
    // Prefixes of units go with the numbers.
    match without_numbers {
        true => names.split(' ').filter(|word| word.chars().all(plain) && word.len() > 3).collect(),
        false => names,
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
        Verdict::Unchecked | Verdict::Fine => {}
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

#[cfg(test)]
mod tests {
    use percuss_codes::Topic;

    use super::*;

    fn note(contact: &str, text: &str) -> Advice {
        Advice {
            contact: contact.to_owned(),
            topic: Topic::ContactDuration,
            value: 1.0,
            reference: 1.0,
            unit: "s",
            verdict: Verdict::Note,
            text: text.to_owned(),
            reason: None,
        }
    }

    #[test]
    fn equal_notes_of_many_contacts_are_one_with_their_names() {
        let same: Vec<Advice> = (0..50)
            .map(|k| note(&format!("p{k}"), &format!("'p{k}' touches along a face")))
            .collect();
        let groups = grouped(&same);
        assert_eq!(groups.len(), 1);
        assert_eq!(groups[0].names(), "p0, p1, p2, p3, p4, p5 and 44 more");
        assert!(!groups[0].differ);
        // Those with numbers of their own: few are reported one by one, many once with the numbers of the first.
        let own = |k: usize| note(&format!("p{k}"), &format!("waves return after {k}.5 ms, early"));
        let few: Vec<Advice> = (0..3).map(own).collect();
        assert_eq!(grouped(&few).len(), 3);
        let many: Vec<Advice> = (0..50).map(own).collect();
        assert_eq!((grouped(&many).len(), grouped(&many)[0].differ), (1, true));
    }
}
