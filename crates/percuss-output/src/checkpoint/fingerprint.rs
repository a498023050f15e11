//! Which scenario a checkpoint belongs to, and what is different about another one.

use std::collections::BTreeMap;

use serde_json::{Value, json};
use sha2::{Digest, Sha256};

/// What begins the checksum of a table in a scenario as it is written out.
const SUM: &str = "sha256 = \"";

/// What a checkpoint keeps of its scenario, the text of it but for its end: a run may be extended, but nothing else of it may change.
pub(super) fn of(scenario: &str) -> Value {
    let (rest, tables) = without_tables(scenario);
    json!({ "text": hash(scenario), "without_tables": hash(&rest), "tables": tables })
}

/// Why a scenario is not the one that was kept; `None` if it is.
pub(super) fn difference(kept: &Value, scenario: &str) -> Option<String> {
    let now = of(scenario);
    if kept["text"] == now["text"] {
        return None;
    }
    let tables = kept["tables"].as_object();
    let mut changed =
        tables.into_iter().flatten().filter(|(file, sum)| now["tables"][*file] != **sum);
    let same = kept["without_tables"] == now["without_tables"];
    Some(match changed.next().filter(|_| same) {
        Some((file, _)) => format!(
            "the table {file} was modified after the checkpoint was written (different SHA-256); restore the file, or run from the start"
        ),
        None => "the checkpoint belongs to a different scenario (only time.end may differ); run from the start"
            .into(),
    })
}

fn hash(text: &str) -> String {
    Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The text without the checksums of the tables that it names, and these by their files.
fn without_tables(text: &str) -> (String, BTreeMap<String, String>) {
    let mut pieces = text.split(SUM);
    let mut rest = pieces.next().unwrap_or_default().to_owned();
    let mut tables = BTreeMap::new();
    for piece in pieces {
        let (sum, after) = piece.split_once('"').unwrap_or((piece, ""));
        tables.insert(last_file(&rest).to_owned(), sum.to_owned());
        rest.push_str(after);
    }
    (rest, tables)
}

/// The file that was named last.
fn last_file(text: &str) -> &str {
    let named = text.rsplit_once("file = ").map_or("", |(_, named)| named);
    let quote = named.chars().next().unwrap_or('"');
    named.split(quote).nth(1).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scenario(mass: u32, sums: [&str; 2]) -> String {
        let [a, b] = sums;
        format!(
            "mass = {mass}\nfunction = {{ file = \"/a b.csv\", sha256 = \"{a}\", smooth = false }}\n\
             file = '/it\"s.csv'\nsha256 = \"{b}\"\nend = 1\n"
        )
    }

    #[test]
    fn a_table_that_changed_is_named() {
        let kept = of(&scenario(1, ["aa", "bb"]));
        assert_eq!(difference(&kept, &scenario(1, ["aa", "bb"])), None);
        let first = difference(&kept, &scenario(1, ["ab", "bb"])).unwrap();
        assert!(first.starts_with("the table /a b.csv was modified"), "{first}");
        let second = difference(&kept, &scenario(1, ["aa", "b"])).unwrap();
        assert!(second.starts_with("the table /it\"s.csv was modified"), "{second}");
        let other = difference(&kept, &scenario(2, ["aa", "b"])).unwrap();
        assert!(other.contains("a different scenario"), "{other}");
    }
}
