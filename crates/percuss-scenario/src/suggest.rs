//! Suggestions for misspelt names.

use crate::foreign;

/// Names that one message lists at most.
const LISTED: usize = 40;

/// The candidate nearest to `word`, if one is near enough to be what was meant.
///
/// A candidate that differs in case alone wins, then one that other programs call so; among equals the first.
pub(crate) fn nearest<'c>(
    word: &str,
    candidates: impl Iterator<Item = &'c str> + Clone,
) -> Option<&'c str> {
    if word.len() > 64 {
        return None; // no name is that long, and the distance costs the product of the lengths
    }
    let lower = word.to_lowercase();
    if let Some(same) = candidates.clone().find(|candidate| candidate.to_lowercase() == lower) {
        return Some(same);
    }
    if let Some(ours) = foreign::ours(word, candidates.clone()) {
        return Some(ours);
    }
    let reach = match word.chars().count() {
        0 => return None,
        1..=3 => 1,
        4..=5 => 2,
        _ => 3,
    };
    let letters = Letters::of(&lower);
    candidates
        .filter(|c| c.len() <= 64)
        .filter_map(|candidate| {
            let folded = candidate.to_lowercase();
            let begins = candidate.len() > 2 && lower.starts_with(candidate);
            if !begins && letters.distance_at_least(Letters::of(&folded)) > reach {
                return None;
            }
            let distance = strsim::damerau_levenshtein(&lower, &folded);
            if !begins && (distance > reach || distance >= candidate.chars().count().max(2)) {
                return None;
            }
            let exact = strsim::damerau_levenshtein(word, candidate);
            Some((2 * distance + usize::from(exact > distance), candidate))
        })
        .min_by_key(|(cost, _)| *cost)
        .map(|(_, candidate)| candidate)
}

/// What bounds the distance of two words from below without going through them letter by letter of the other.
#[derive(Clone, Copy)]
struct Letters {
    count: usize,
    /// Which letters occur, some sharing a bit.
    occur: u64,
}

impl Letters {
    fn of(word: &str) -> Self {
        let bit = |c: char| 1_u64 << (u32::from(c) % u64::BITS);
        word.chars().fold(Self { count: 0, occur: 0 }, |Self { count, occur }, c| Self {
            count: count + 1,
            occur: occur | bit(c),
        })
    }

    /// Each change alters the length by one at most, takes away one letter at most and brings one at most; two letters that swap
    /// their places do neither.
    fn distance_at_least(self, other: Self) -> usize {
        let gone = (self.occur & !other.occur).count_ones() as usize;
        let come = (other.occur & !self.occur).count_ones() as usize;
        self.count.abs_diff(other.count).max(gone).max(come)
    }
}

/// `one of `a`, `b` (did you mean `a`?)`; of very many names the first ones, and how many there are besides.
pub fn one_of<'c>(word: &str, candidates: impl Iterator<Item = &'c str> + Clone) -> String {
    let count = candidates.clone().count();
    // One name more is listed rather than counted.
    let listed = if count > LISTED + 1 { LISTED } else { count };
    let list: Vec<String> = candidates.clone().take(listed).map(|c| format!("`{c}`")).collect();
    let mut out = match list.len() {
        0 => "none at all".to_string(),
        1 => list[0].clone(),
        _ => format!("one of {}", list.join(", ")),
    };
    if count > listed {
        out.push_str(&format!(" and {} more", count - listed));
    }
    if count > 1
        && let Some(near) = nearest(word, candidates)
    {
        out.push_str(&format!(" (did you mean `{near}`?)"));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    const WORDS: [&str; 14] = [
        "a",
        "ab",
        "ba",
        "young",
        "yuong",
        "YOUNG",
        "ünge",
        "density",
        "density_of",
        "e",
        "m1",
        "m12",
        "strikes",
        "strike",
    ];

    #[test]
    fn the_bound_is_never_above_the_distance() {
        for one in WORDS {
            for other in WORDS {
                let bound = Letters::of(one).distance_at_least(Letters::of(other));
                let distance = strsim::damerau_levenshtein(one, other);
                assert!(bound <= distance, "{one} {other}: {bound} > {distance}");
            }
        }
    }

    #[test]
    fn long_lists_are_cut_and_still_searched() {
        let names: Vec<String> = (0..1000).map(|k| format!("beam{k}")).collect();
        let reported = one_of("baem977", names.iter().map(String::as_str));
        assert!(reported.starts_with("one of `beam0`, `beam1`, "), "{reported}");
        assert!(
            reported.ends_with("`beam39` and 960 more (did you mean `beam977`?)"),
            "{reported}"
        );
    }
}
