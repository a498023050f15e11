//! Entries of the reference of the file formats as text.

use percuss_scenario::{BodyReference, KeyReference, KindsReference, TableForm, TableReference};

use super::find::{Found, Meaning, find};

/// Columns of a line.
const WIDTH: usize = 96;
/// Columns by which what belongs to a line is set in.
const INDENT: usize = 2;

/// Every meaning of a name in a format; none where it has none. `of` follows the titles.
pub fn text(format: &[TableReference], name: &str, of: &str) -> Option<String> {
    let mut all: Vec<(String, String)> = Vec::new();
    for one in find(format, name) {
        let (title, text) = (titled(&one) + of, meaning(format, &one));
        match all.iter_mut().find(|(_, known)| *known == text) {
            Some((titles, _)) => *titles = format!("{titles}\n{title}"),
            None => all.push((title, text)),
        }
    }
    let texts: Vec<String> =
        all.into_iter().map(|(title, text)| format!("{title}\n\n{text}")).collect();
    (!texts.is_empty()).then(|| texts.join("\n"))
}

/// A table as it is written in a file.
pub fn title(table: &TableReference) -> String {
    match table.form {
        TableForm::File => "the file".to_owned(),
        TableForm::Once => format!("[{}]", table.places[0]),
        TableForm::Named => format!("[{}.NAME]", table.places[0]),
        TableForm::Braces => {
            let places = table.places.iter().map(|place| format!("{place} = {{ ... }}"));
            places.collect::<Vec<_>>().join(", ")
        }
    }
}

fn titled(found: &Found<'_>) -> String {
    let paths = found.paths.join(", ");
    let title = match found.meaning {
        Meaning::Table(table) => title(table),
        Meaning::Key(_) | Meaning::Choice(_) => paths,
        Meaning::Kind(word, _) | Meaning::Word(word, _) => format!("{paths} = \"{word}\""),
    };
    match found.kinds.is_empty() {
        true => title,
        false => format!("{title} ({})", found.kinds.join(", ")),
    }
}

fn meaning(format: &[TableReference], found: &Found<'_>) -> String {
    let mut out = String::new();
    match &found.meaning {
        Meaning::Table(table) => described(format, &table.body, &mut out),
        Meaning::Key(key) => about(format, key, (0, &found.paths), &mut out),
        Meaning::Choice(kinds) => choice(format, kinds, 0, &mut out),
        Meaning::Kind(_, variant) => described(format, variant, &mut out),
        Meaning::Word(_, about) => lines(&sentence(about), 0, &mut out),
    }
    out
}

/// A body with what it is.
fn described(format: &[TableReference], body: &BodyReference, out: &mut String) {
    lines(&sentence(&body.about), 0, out);
    if !(body.keys.is_empty() && body.kinds.is_empty()) {
        out.push('\n');
    }
    contents(format, body, INDENT, out);
}

/// Keys and kinds of a body.
fn contents(format: &[TableReference], body: &BodyReference, indent: usize, out: &mut String) {
    for key in &body.keys {
        lines(key.name, indent, out);
        about(format, key, (indent + 2 * INDENT, &[]), out);
    }
    if !body.either.is_empty() {
        let sets: Vec<String> = body.either.iter().map(|keys| keys.join(" and ")).collect();
        lines(&format!("One of these is required: {}.", sets.join("; or ")), indent, out);
    }
    for kinds in &body.kinds {
        lines(kinds.tag, indent, out);
        choice(format, kinds, indent + 2 * INDENT, out);
    }
}

/// The meaning of a key, its value and its default. The table of a key at one of `places` is explained separately.
fn about(
    format: &[TableReference],
    key: &KeyReference,
    (indent, places): (usize, &[String]),
    out: &mut String,
) {
    lines(&sentence(&key.about), indent, out);
    for (word, about) in &key.words {
        lines(&format!("\"{word}\": {}", sentence(about)), indent + INDENT, out);
    }
    let table = key.table.and_then(|name| format.iter().find(|table| table.name == name));
    let value = match (key.words.is_empty(), table) {
        (false, _) => String::new(),
        (true, Some(table)) if table.places.iter().any(|place| places.contains(place)) => {
            format!("Value: {}. ", key.expected)
        }
        (true, Some(table)) => {
            format!("Value: {}; see `percuss explain {}`. ", key.expected, table.places[0])
        }
        (true, None) => format!("Value: {}. ", key.expected),
    };
    let rest = match (&key.default, key.required) {
        (Some(default), _) => format!("Default: {default}"),
        (None, true) => "Required.".to_owned(),
        (None, false) => "Optional.".to_owned(),
    };
    lines(&(value + &rest), indent, out);
}

/// The meaning of a choice of kinds, and the keys of each.
fn choice(format: &[TableReference], kinds: &KindsReference, indent: usize, out: &mut String) {
    let default = match kinds.default {
        Some(word) => format!("Default: \"{word}\""),
        None => "Required.".to_owned(),
    };
    lines(&format!("{} {default}", sentence(&kinds.about)), indent, out);
    for (word, variant) in &kinds.variants {
        let text = format!("{} = \"{word}\": {}", kinds.tag, sentence(&variant.about));
        lines(&text, indent, out);
        contents(format, variant, indent + 2 * INDENT, out);
    }
}

/// Broken into lines between words.
pub fn paragraph(text: &str) -> String {
    let mut out = String::new();
    lines(text, 0, &mut out);
    out.trim_end().to_owned()
}

fn lines(text: &str, indent: usize, out: &mut String) {
    let mut line = String::new();
    for word in text.split_whitespace() {
        let width = indent + line.chars().count() + 1 + word.chars().count();
        if !line.is_empty() && width > WIDTH {
            out.push_str(&format!("{:indent$}{line}\n", ""));
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    if !line.is_empty() {
        out.push_str(&format!("{:indent$}{line}\n", ""));
    }
}

fn sentence(text: &str) -> String {
    let text = text.trim();
    match text.is_empty() || text.ends_with(['.', '?', ':', ')']) {
        true => text.to_owned(),
        false => format!("{text}."),
    }
}
