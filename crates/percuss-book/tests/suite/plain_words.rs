//! Expressions that were replaced by terms of the field (docs/glossary.md) stay out of what people read: messages, help, reports, docs.

use std::fs;
use std::path::{Path, PathBuf};

use super::repository;

/// Expressions that may not come back, with word boundaries on both sides, in any case.
const REPLACED: &[&str] = &[
    "told",
    "telling",
    "desk",
    "anew",
    "deed",
    "rooms",
    "booked",
    "keep a set",
    "keeps a set",
    "takes no part",
    "take no part",
    "plays no part",
    "on its way",
    "the system refused",
    "gave up",
    "gives up",
    "balances that close",
    "books that close",
    "balances close",
    "ever finer",
    "sees its course",
    "handed over",
    "given away",
    "passed on",
    "slightest push",
    "things inside",
    "beam that cannot be",
    "mend",
    "beam without end",
    "sound",
    "blow",
];

/// The same of messages, help and reports alone: in longer texts they have their ordinary meaning.
const IN_MESSAGES: &[&str] = &["stands", "by hand", "in all"];

/// Terms of the field that contain one of them.
const TERMS: &[&str] = &["speed of sound"];

/// Whether `text` has an expression between word boundaries; `in all` only where it ends a clause, as of a sum.
fn has(text: &str, expression: &str) -> bool {
    let mut text = text.to_lowercase();
    TERMS.iter().for_each(|term| text = text.replace(term, ""));
    let joins = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    text.match_indices(expression).any(|(at, _)| {
        let (before, behind) = (&text[..at], &text[at + expression.len()..]);
        let clause_ends = behind.is_empty() || behind.starts_with([',', '.', ';', ':', ')', '\n']);
        !before.ends_with(joins)
            && !behind.starts_with(joins)
            && (expression != "in all" || clause_ends)
    })
}

/// A text that people read, and its line.
#[derive(Debug, PartialEq)]
struct Text {
    line: usize,
    words: String,
    /// Whether it is a doc comment, which is help where it describes arguments.
    doc: bool,
}

/// String literals and doc comments of a Rust source, without messages of broken invariants (`expect`).
fn texts(source: &str) -> Vec<Text> {
    let mut found = Vec::new();
    let mut at = 0;
    let line = |at: usize| 1 + source[..at].matches('\n').count();
    while let Some(first) = source[at..].chars().next() {
        let rest = &source[at..];
        let named = source[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
        if rest.starts_with("//") {
            let end = rest.find('\n').unwrap_or(rest.len());
            if let Some(words) = rest[..end].strip_prefix("///") {
                found.push(Text { line: line(at), words: words.to_owned(), doc: true });
            }
            at += end;
        } else if let (false, Some((words, end))) = (named, raw(rest)) {
            found.push(Text { line: line(at), words: words.to_owned(), doc: false });
            at += end;
        } else if first == '"' {
            let (words, end) = quoted(rest);
            let invariant = source[..at].trim_end().ends_with(".expect(");
            if !invariant {
                found.push(Text { line: line(at), words, doc: false });
            }
            at += end;
        } else if first == '\'' {
            at += character(rest);
        } else {
            at += first.len_utf8();
        }
    }
    found
}

/// Content and length of a raw string, where one begins.
fn raw(rest: &str) -> Option<(&str, usize)> {
    let behind = rest.strip_prefix('r')?;
    let content = behind.trim_start_matches('#');
    let end = format!("\"{}", &behind[..behind.len() - content.len()]);
    let content = content.strip_prefix('"')?;
    let length = content.find(&end)?;
    let begin = rest.len() - content.len();
    Some((&content[..length], begin + length + end.len()))
}

/// Content and length of a string literal; escapes and arguments of formats are spaces, continued lines are one.
fn quoted(rest: &str) -> (String, usize) {
    let (mut words, mut depth) = (String::new(), 0_usize);
    let mut letters = rest.char_indices().skip(1).peekable();
    while let Some((at, letter)) = letters.next() {
        match letter {
            '"' => return (words, at + 1),
            '\\' => {
                let escaped = letters.next().map_or(' ', |(_, letter)| letter);
                if escaped == '\n' {
                    while letters.next_if(|(_, letter)| letter.is_whitespace()).is_some() {}
                } else {
                    words.push(' ');
                }
            }
            '{' => depth += 1,
            '}' => {
                depth = depth.saturating_sub(1);
                words.push(' ');
            }
            letter if depth == 0 => words.push(letter),
            _ => {}
        }
    }
    (words, rest.len())
}

/// Length of a character literal, or of the quote of a lifetime.
fn character(rest: &str) -> usize {
    let mut letters = rest.char_indices().skip(1);
    let (first, second) = (letters.next(), letters.next());
    match (first, second) {
        // The escaped letter may be a quote itself.
        (Some((_, '\\')), Some((at, letter))) => {
            let behind = at + letter.len_utf8();
            behind + rest[behind..].find('\'').map_or(0, |end| end + 1)
        }
        (Some(_), Some((at, '\''))) => at + 1,
        _ => 1,
    }
}

/// Files below a folder with an ending.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut all = Vec::new();
    let entries =
        fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    for entry in entries {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            all.extend(files(&path, ending));
        } else if path.extension().is_some_and(|own| own == ending) {
            all.push(path);
        }
    }
    all.sort();
    all
}

/// Uses of replaced expressions: place, expression and text.
fn uses(path: &Path, line: usize, words: &str, expressions: &[&[&str]]) -> Vec<String> {
    let shown = path.strip_prefix(repository()).unwrap_or(path).display();
    let found = expressions.iter().flat_map(|list| list.iter()).filter(|one| has(words, one));
    found.map(|one| format!("{shown}:{line}: `{one}` in: {}", words.trim())).collect()
}

/// Strings with a space are sentences; others are keys, names and paths.
#[test]
fn messages_and_help_use_the_terms_of_the_field() {
    let mut wrong = Vec::new();
    let crates = fs::read_dir(repository().join("crates")).expect("the crates");
    for folder in crates {
        let sources = folder.expect("an entry").path().join("src");
        for path in files(&sources, "rs") {
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            if name == "tests.rs" || path.components().any(|part| part.as_os_str() == "tests") {
                continue;
            }
            let source = fs::read_to_string(&path).expect("a source");
            let source = source.split("#[cfg(test)]\nmod tests {").next().unwrap_or(&source);
            let helps = name.contains("arguments");
            for text in texts(source).iter().filter(|text| !text.doc || helps) {
                if text.words.trim().contains(' ') {
                    wrong.extend(uses(&path, text.line, &text.words, &[REPLACED, IN_MESSAGES]));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "see docs/glossary.md:\n{}", wrong.join("\n"));
}

/// Pages of the book, guides and scenarios. The glossary and the list of changes name what was replaced; code has its names.
#[test]
fn guides_use_the_terms_of_the_field() {
    let at = |path: &str| repository().join(path);
    let mut pages = files(&at("docs"), "md");
    pages.extend(files(&at("paper"), "md"));
    pages.extend(files(&at("scenarios"), "toml"));
    pages.extend(files(&at("crates/percuss-scenario/templates"), "toml"));
    let whole = fs::read_dir(repository()).expect("the repository");
    let whole = whole.map(|entry| entry.expect("an entry").path());
    pages.extend(whole.filter(|path| path.extension().is_some_and(|own| own == "md")));
    // Registries show the descriptions in them.
    pages.extend(["Cargo.toml", "pyproject.toml", "docs/book/book.toml"].map(at));
    let apart = ["docs/glossary.md", "CHANGELOG.md"].map(at);
    let mut wrong = Vec::new();
    for path in pages.iter().filter(|path| !apart.contains(path)) {
        let text = fs::read_to_string(path).expect("a page");
        let mut fenced = false;
        for (k, line) in text.lines().enumerate() {
            fenced ^= line.trim_start().starts_with("```");
            if !fenced {
                let plain: String = line.split('`').step_by(2).collect();
                wrong.extend(uses(path, k + 1, &plain, &[REPLACED]));
            }
        }
    }
    assert!(wrong.is_empty(), "see docs/glossary.md:\n{}", wrong.join("\n"));
}

#[test]
fn texts_are_found_in_a_source() {
    let source = "/// Help of it.\nfn f<'a>(x: &'a str) -> char {\n    let _ = r#\"raw \"text\"\"#; // \"no\"\n    \
                  g(\"one \\\n        line, {told} \\\"quoted\\\"\", '\"', '\\'').expect(\"sound model\")\n}";
    let found: Vec<(usize, String)> =
        texts(source).into_iter().map(|text| (text.line, text.words)).collect();
    let expected = [(1, " Help of it."), (3, "raw \"text\""), (4, "one line,    quoted ")];
    assert_eq!(found, expected.map(|(line, words)| (line, words.to_owned())));
    assert!(has("It Stands here", "stands") && !has("withstands", "stands"));
    assert!(!has("the speed of sound", "sound") && has("a sound scenario", "sound"));
    assert!(has("7 N s in all.", "in all") && !has("in all contacts", "in all"));
}
