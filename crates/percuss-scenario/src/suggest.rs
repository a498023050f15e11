//! Suggestions for misspelt names.

/// The candidate nearest to `word`, if one is near enough to be what was meant.
///
/// A candidate that differs in case alone wins; among equals the first.
pub(crate) fn nearest<'c>(
    word: &str,
    candidates: impl Iterator<Item = &'c str>,
) -> Option<&'c str> {
    if word.len() > 64 {
        return None; // no name is that long, and the distance costs the product of the lengths
    }
    let lower = word.to_lowercase();
    let reach = match word.chars().count() {
        0 => return None,
        1..=3 => 1,
        4..=5 => 2,
        _ => 3,
    };
    candidates
        .filter(|c| c.len() <= 64)
        .map(|candidate| {
            let folded = strsim::damerau_levenshtein(&lower, &candidate.to_lowercase());
            let exact = strsim::damerau_levenshtein(word, candidate);
            (2 * folded + usize::from(exact > folded), folded, candidate)
        })
        .filter(|(_, distance, candidate)| {
            let near = *distance <= reach && *distance < candidate.chars().count().max(2);
            near || candidate.len() > 2 && lower.starts_with(*candidate)
        })
        .min_by_key(|(cost, ..)| *cost)
        .map(|(.., candidate)| candidate)
}

/// `one of `a`, `b` (did you mean `a`?)`.
pub fn one_of<'c>(word: &str, candidates: impl Iterator<Item = &'c str> + Clone) -> String {
    let list: Vec<String> = candidates.clone().map(|c| format!("`{c}`")).collect();
    let mut out = match list.len() {
        0 => "none at all".to_string(),
        1 => list[0].clone(),
        _ => format!("one of {}", list.join(", ")),
    };
    if list.len() > 1
        && let Some(near) = nearest(word, candidates)
    {
        out.push_str(&format!(" (did you mean `{near}`?)"));
    }
    out
}
