//! Expressions that were replaced by terms of the field (docs/glossary.md) stay out of what people read: messages, help, reports, docs; and out
//! of identifiers and comments.

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
    "blows",
];

/// The same of messages, help and reports alone: in longer texts they have their ordinary meaning.
const IN_MESSAGES: &[&str] = &["stands", "by hand", "in all"];

/// Parts of identifiers that may not come back, as words of `snake_case` or `CamelCase`.
const IN_NAMES: &[&str] = &[
    "told",
    "foretold",
    "telling",
    "desk",
    "anew",
    "afresh",
    "deed",
    "rooms",
    "lesson",
    "blow",
    "blows",
    "sound",
    "unsound",
    "standing",
    "standings",
    "in_play",
    "put_back",
    "line_of_flight",
    "letting_go",
    "going_on",
];

/// Expressions that may not come back in comments.
const IN_COMMENTS: &[&str] = &[
    "told",
    "telling",
    "desk",
    "anew",
    "deed",
    "blow",
    "sound",
    "line of flight",
    "balances close",
    "balances that close",
    "the system refuses",
    "gave up",
    "handed over",
    "things inside",
    "ever finer",
];

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

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Code,
    Comment,
    /// A doc comment, which is help where it describes arguments.
    Doc,
    Literal,
    /// The message of a broken invariant (`expect`).
    Invariant,
}

/// A part of a source, and its line.
#[derive(Debug, PartialEq)]
struct Text {
    line: usize,
    words: String,
    kind: Kind,
}

/// Comments and string literals of a Rust source, and the code between them.
fn texts(source: &str) -> Vec<Text> {
    let mut found = Vec::new();
    let (mut at, mut code, mut line) = (0, 0, 1);
    let mut push = |words: String, kind: Kind, whole: &str| {
        found.push(Text { line, words, kind });
        line += whole.matches('\n').count();
    };
    while let Some(first) = source[at..].chars().next() {
        let rest = &source[at..];
        let named = source[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let part = if rest.starts_with("//") {
            let end = rest.find('\n').unwrap_or(rest.len());
            let (doc, words) =
                (rest[..end].strip_prefix("///"), rest[..end].trim_start_matches(['/', '!']));
            let kind = if doc.is_some() { Kind::Doc } else { Kind::Comment };
            Some((kind, words.to_owned(), end))
        } else if let (false, Some((words, end))) = (named, raw(rest)) {
            Some((Kind::Literal, words.to_owned(), end))
        } else if first == '"' {
            let (words, end) = quoted(rest);
            let invariant = source[..at].trim_end().ends_with(".expect(");
            Some((if invariant { Kind::Invariant } else { Kind::Literal }, words, end))
        } else {
            None
        };
        if let Some((kind, words, end)) = part {
            push(source[code..at].to_owned(), Kind::Code, &source[code..at]);
            push(words, kind, &rest[..end]);
            at += end;
            code = at;
        } else if first == '\'' {
            at += character(rest);
        } else {
            at += first.len_utf8();
        }
    }
    push(source[code..].to_owned(), Kind::Code, "");
    found
}

/// Sources of a crate that are no tests, without their test modules.
fn sources(folder: &Path) -> Vec<(PathBuf, String)> {
    let is_test = |path: &PathBuf| {
        path.file_name().is_some_and(|name| name == "tests.rs")
            || path.components().any(|part| part.as_os_str() == "tests")
    };
    let read = |path: PathBuf| {
        let source = fs::read_to_string(&path).expect("a source");
        let own = source.split("#[cfg(test)]\nmod tests {").next().unwrap_or(&source).to_owned();
        (path, own)
    };
    files(folder, "rs").into_iter().filter(|path| !is_test(path)).map(read).collect()
}

/// Folders of the sources of all crates.
fn crates() -> Vec<PathBuf> {
    let entries = fs::read_dir(repository().join("crates")).expect("the crates");
    let folders = entries.map(|entry| entry.expect("an entry").path().join("src"));
    folders.filter(|folder| folder.is_dir()).collect()
}

/// Replaced parts of the identifiers in a code, each with its line and identifier.
fn names(code: &str) -> Vec<(usize, String, &'static str)> {
    let mut found = Vec::new();
    for (k, line) in code.lines().enumerate() {
        let identifiers = line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        for identifier in identifiers {
            let mut snake = String::from("_");
            let mut before = '_';
            for letter in identifier.chars() {
                if letter.is_ascii_uppercase() && before.is_ascii_lowercase() {
                    snake.push('_');
                }
                snake.push(letter.to_ascii_lowercase());
                before = letter;
            }
            snake.push('_');
            let replaced = IN_NAMES.iter().find(|name| snake.contains(&format!("_{name}_")));
            found.extend(replaced.map(|name| (k, identifier.to_owned(), *name)));
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
    for (path, source) in crates().iter().flat_map(|folder| sources(folder)) {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let helps = name.contains("arguments");
        let read = |kind: Kind| kind == Kind::Literal || helps && kind == Kind::Doc;
        for text in texts(&source).iter().filter(|text| read(text.kind)) {
            if text.words.trim().contains(' ') {
                wrong.extend(uses(&path, text.line, &text.words, &[REPLACED, IN_MESSAGES]));
            }
        }
    }
    assert!(wrong.is_empty(), "see docs/glossary.md:\n{}", wrong.join("\n"));
}

/// Code between backquotes in a comment counts as code.
#[test]
fn identifiers_and_comments_use_the_terms_of_the_field() {
    let mut wrong = Vec::new();
    let mut name_faults = |path: &Path, line: usize, code: &str| {
        let shown = path.strip_prefix(repository()).unwrap_or(path).display().to_string();
        let found = names(code).into_iter();
        wrong.extend(
            found.map(|(k, name, part)| format!("{shown}:{}: `{part}` in `{name}`", line + k)),
        );
    };
    let mut remarks = Vec::new();
    for (path, source) in crates().iter().flat_map(|folder| sources(folder)) {
        name_faults(&path, 1, &path.file_stem().unwrap_or_default().to_string_lossy());
        for text in texts(&source) {
            match text.kind {
                Kind::Code => name_faults(&path, text.line, &text.words),
                Kind::Comment | Kind::Doc => {
                    let plain: String = text.words.split('`').step_by(2).collect();
                    remarks.extend(uses(&path, text.line, &plain, &[IN_COMMENTS]));
                }
                Kind::Invariant => {
                    remarks.extend(uses(&path, text.line, &text.words, &[IN_COMMENTS]))
                }
                Kind::Literal => {}
            }
        }
    }
    for path in files(&repository().join("python/percuss"), "py") {
        name_faults(&path, 1, &fs::read_to_string(&path).expect("a source"));
    }
    wrong.extend(remarks);
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
    let found: Vec<(usize, String, Kind)> = (texts(source).into_iter())
        .filter(|text| text.kind != Kind::Code)
        .map(|text| (text.line, text.words, text.kind))
        .collect();
    let expected = [
        (1, " Help of it.", Kind::Doc),
        (3, "raw \"text\"", Kind::Literal),
        (3, " \"no\"", Kind::Comment),
        (4, "one line,    quoted ", Kind::Literal),
        (5, "sound model", Kind::Invariant),
    ];
    assert_eq!(found, expected.map(|(line, words, kind)| (line, words.to_owned(), kind)));
    let code: String =
        texts(source).iter().filter(|t| t.kind == Kind::Code).map(|t| &*t.words).collect();
    assert!(code.contains("fn f<'a>(x: &'a str) -> char {") && code.ends_with(")\n}"), "{code}");
    let found = names("let is_told = Desk::of(standing);\nLettingGo.withstanding(sounds, DESK)");
    let found: Vec<(usize, &str)> = found.iter().map(|(k, _, part)| (*k, *part)).collect();
    assert_eq!(found, [(0, "told"), (0, "desk"), (0, "standing"), (1, "letting_go"), (1, "desk")]);
    assert!(has("It Stands here", "stands") && !has("withstands", "stands"));
    assert!(!has("the speed of sound", "sound") && has("a sound scenario", "sound"));
    assert!(has("7 N s in all.", "in all") && !has("in all contacts", "in all"));
}
