//! Pages of the scenario reference, one a table of the format.

use std::collections::BTreeSet;
use std::fmt::Write;

use percuss_scenario::{BodyReference, KeyReference, KindsReference, TableForm, TableReference};

use crate::bounds::{Bounds, bounds};
use crate::excerpts::{Excerpt, Sample, TableUse, table_uses};

/// A page of the book.
#[derive(Clone, Debug)]
pub struct Page {
    /// Its path within the book.
    pub path: String,
    /// Its title in the table of contents.
    pub title: String,
    /// Its text.
    pub text: String,
}

/// The pages of a format into `folder`.
pub fn reference_pages(folder: &str, format: &[TableReference], samples: &[Sample]) -> Vec<Page> {
    let all: Vec<TableUse> = samples.iter().flat_map(|one| table_uses(one, format)).collect();
    let bounds = bounds(samples, format);
    let writer = Writer { folder, format, table_uses: &all, bounds: &bounds };
    format.iter().filter(|table| has_page(table)).map(|table| writer.page(table)).collect()
}

/// Keys of a format that stand in none of the files, each as `Table: kind=word/key`.
pub fn missing_examples(format: &[TableReference], samples: &[Sample]) -> Vec<String> {
    let all: Vec<TableUse> = samples.iter().flat_map(|one| table_uses(one, format)).collect();
    let shown = |table: &str, key: &str| {
        all.iter().any(|one| one.table == table && one.keys.iter().any(|(k, _)| k == key))
    };
    let mut missing = Vec::new();
    for table in format {
        let keys = keys_of(&table.body, "");
        missing.extend(
            keys.into_iter()
                .filter(|key| !shown(table.name, key))
                .map(|key| format!("{}: {key}", table.name)),
        );
    }
    missing
}

/// Every key and kind of a body, as [`TableUse::keys`] names them.
fn keys_of(body: &BodyReference, under: &str) -> Vec<String> {
    let mut keys: Vec<String> = body.keys.iter().map(|k| format!("{under}{}", k.name)).collect();
    for kinds in &body.kinds {
        for (word, variant) in &kinds.variants {
            let under = format!("{under}{}={word}", kinds.tag);
            keys.push(under.clone());
            keys.extend(keys_of(variant, &format!("{under}/")));
        }
    }
    keys
}

/// Whether a table has a page of its own: those under headers, and those that several tables hold.
fn has_page(table: &TableReference) -> bool {
    let roots: BTreeSet<&str> = table.places.iter().map(|place| root(place)).collect();
    table.form != TableForm::Braces || roots.len() > 1
}

fn root(place: &str) -> &str {
    place.split('.').next().unwrap_or(place)
}

/// The way to the same reference without the book.
const IN_THE_TERMINAL: &str = "`percuss explain` prints the reference of scenarios and studies in the terminal: `percuss explain beam` a table, `percuss explain \
                               projectile.stiffness` a key, `percuss explain hertz` a word.\n\n";

/// What writes the pages of a format.
struct Writer<'w> {
    folder: &'w str,
    /// Tables of the format, shape (tables).
    format: &'w [TableReference],
    /// What stands in the files of the book, shape (files and tables).
    table_uses: &'w [TableUse],
    bounds: &'w Bounds,
}

/// A page while it is written.
struct Draft<'d> {
    table: &'d TableReference,
    text: String,
    /// Keys that an example on the page shows.
    shown: BTreeSet<String>,
}

impl Writer<'_> {
    fn page(&self, table: &TableReference) -> Page {
        let title = title(table);
        let mut text = format!("# {}\n\n", escaped(&title));
        if table.form == TableForm::File {
            text.push_str(IN_THE_TERMINAL);
        }
        let mut draft = Draft { table, text, shown: BTreeSet::new() };
        self.table(&mut draft, 2);
        for inner in self.format.iter().filter(|inner| self.lies_on(inner, table)) {
            let _ = write!(draft.text, "\n## {}\n\n", escaped(&titled_places(inner)));
            let mut part = Draft { table: inner, text: String::new(), shown: BTreeSet::new() };
            self.table(&mut part, 3);
            draft.text.push_str(&part.text);
        }
        Page { path: self.path(table), title, text: draft.text }
    }

    /// Whether a table in braces is described on the page of another one.
    fn lies_on(&self, inner: &TableReference, table: &TableReference) -> bool {
        !has_page(inner) && inner.places.iter().any(|place| table.places[0] == root(place))
    }

    fn path(&self, table: &TableReference) -> String {
        let name = match table.form {
            TableForm::File => "index".into(),
            TableForm::Once | TableForm::Named => table.places[0].clone(),
            TableForm::Braces => plain(table).to_lowercase(),
        };
        format!("{}/{name}.md", self.folder)
    }

    fn table(&self, draft: &mut Draft<'_>, level: usize) {
        let body = &draft.table.body;
        if draft.table.form != TableForm::File {
            let _ = writeln!(draft.text, "{}\n", sentence(&body.about));
        }
        self.body(draft, body, "", level);
        self.rest(draft);
    }

    /// Keys of a body, and its kinds one after another.
    fn body(&self, draft: &mut Draft<'_>, body: &BodyReference, under: &str, level: usize) {
        self.keys(draft, body, under);
        if !body.either.is_empty() {
            let set = |keys: &Vec<&str>| {
                keys.iter().map(|key| code(key)).collect::<Vec<_>>().join(" and ")
            };
            let sets: Vec<String> = body.either.iter().map(set).collect();
            let _ = writeln!(draft.text, "One of these must be given: {}.\n", sets.join("; or "));
        }
        for kinds in &body.kinds {
            self.kinds(draft, kinds, under, level);
        }
        if body.kinds.is_empty() && draft.table.form != TableForm::File {
            self.example(draft, body, under);
        }
    }

    fn kinds(&self, draft: &mut Draft<'_>, kinds: &KindsReference, under: &str, level: usize) {
        let hashes = "#".repeat(level.min(6));
        let KindsReference { tag, about, default, implied, variants } = kinds;
        let heading = format!("{hashes} {}\n\n{}\n\n", code(tag), sentence(about));
        draft.text.push_str(&heading);
        let said = match default {
            Some(word) => format!("`{tag}` may be left out; it is `\"{word}\"` then.\n\n"),
            None => format!("`{tag}` must be given.\n\n"),
        };
        draft.text.push_str(&said);
        if let Some((key, word)) = implied {
            let said = format!("With `{key}` and no `{tag}` it is `\"{word}\"`.\n\n");
            draft.text.push_str(&said);
        }
        for (word, variant) in variants {
            let deeper = "#".repeat((level + 1).min(6));
            let heading =
                format!("{deeper} `{tag} = \"{word}\"`\n\n{}\n\n", sentence(&variant.about));
            draft.text.push_str(&heading);
            self.body(draft, variant, &format!("{under}{tag}={word}/"), level + 2);
        }
    }

    fn keys(&self, draft: &mut Draft<'_>, body: &BodyReference, under: &str) {
        if body.keys.is_empty() {
            return;
        }
        draft
            .text
            .push_str("| key | meaning | value | default | bounds |\n|---|---|---|---|---|\n");
        for key in &body.keys {
            let place = (draft.table.name, format!("{under}{}", key.name));
            let bounds = self.bounds.get(&place).copied().unwrap_or_default();
            let default = match (&key.default, key.required) {
                (Some(text), _) => code(text),
                (None, true) => "must be given".into(),
                (None, false) => String::new(),
            };
            let (name, meaning) = (code(key.name), self.meaning(key));
            let line = format!("| {name} | {meaning} | {} | {default} | {bounds} |\n", value(key));
            draft.text.push_str(&line);
        }
        draft.text.push('\n');
    }

    fn meaning(&self, key: &KeyReference) -> String {
        let mut text = cell(&sentence(&key.about));
        for (word, about) in &key.words {
            let _ = write!(text, "<br>`\"{word}\"`: {}", cell(about));
        }
        let table = key.table.and_then(|name| self.format.iter().find(|table| table.name == name));
        if let Some(table) = table.filter(|table| has_page(table)) {
            let path = self.path(table);
            let file = path.rsplit('/').next().unwrap_or_default();
            let _ = write!(text, " See [{}]({file}).", escaped(&title(table)));
        }
        text
    }

    /// The example that shows most of a body with these kinds.
    fn example(&self, draft: &mut Draft<'_>, body: &BodyReference, under: &str) {
        let wanted = keys_of(body, under);
        let chosen = under.trim_end_matches('/');
        let fits = |one: &&TableUse| {
            let kind = |(key, _): &(String, String)| key == chosen;
            one.table == draft.table.name && (chosen.is_empty() || one.keys.iter().any(kind))
        };
        let shows = |one: &&TableUse| one.keys.iter().filter(|(k, _)| wanted.contains(k)).count();
        let candidates: Vec<&TableUse> = self.table_uses.iter().filter(fits).collect();
        // Of equals the first one: scenarios before examples made for this page.
        let best = candidates
            .iter()
            .max_by(|a, b| shows(a).cmp(&shows(b)).then(std::cmp::Ordering::Greater));
        if let Some(best) = best {
            draft.show(best);
        }
    }

    /// Examples of what none has shown so far.
    fn rest(&self, draft: &mut Draft<'_>) {
        let own = |one: &&TableUse| one.table == draft.table.name;
        let own: Vec<&TableUse> = self.table_uses.iter().filter(own).collect();
        if draft.table.form == TableForm::File {
            return;
        }
        loop {
            let new = |one: &TableUse| {
                one.keys.iter().filter(|(key, _)| !draft.shown.contains(key)).count()
            };
            match own.iter().map(|one| (new(one), one)).max_by_key(|(count, _)| *count) {
                Some((count, one)) if count > 0 => draft.show(one),
                _ => break,
            }
        }
    }
}

impl Draft<'_> {
    fn show(&mut self, table_use: &TableUse) {
        let Excerpt { file, text } = &table_use.excerpt;
        let example = format!("```toml\n{text}\n```\n\nFrom `{file}`.\n\n");
        if !self.text.contains(&example) {
            self.text.push_str(&example);
        }
        self.shown.extend(table_use.keys.iter().map(|(key, _)| key.clone()));
    }
}

/// The name of a table as its page has it.
fn title(table: &TableReference) -> String {
    match table.form {
        TableForm::File => "The file".into(),
        TableForm::Once => format!("[{}]", table.places[0]),
        TableForm::Named => format!("[{}.NAME]", table.places[0]),
        TableForm::Braces => format!("{} in braces", plain(table)),
    }
}

fn titled_places(table: &TableReference) -> String {
    let key = |place: &String| place.rsplit('.').next().unwrap_or_default().to_string();
    let keys: BTreeSet<String> = table.places.iter().map(key).collect();
    let keys: Vec<String> = keys.iter().map(|key| format!("{key} = {{ ... }}")).collect();
    keys.join(", ")
}

/// The name of a declaration without what says that it is a table.
fn plain(table: &TableReference) -> &'static str {
    table.name.strip_suffix("Table").unwrap_or(table.name)
}

/// What is expected, its example set as code.
fn value(key: &KeyReference) -> String {
    let text = match key.expected.split_once(", such as ") {
        Some((what, example)) => {
            let (example, rest) = example
                .split_once(", or ")
                .map_or((example, String::new()), |(e, r)| (e, format!(", or {r}")));
            format!("{what}, such as {}{rest}", code(example))
        }
        None if !key.words.is_empty() => "one of these words".into(),
        None => key.expected.clone(),
    };
    cell(&text)
}

fn code(text: &str) -> String {
    format!("`{text}`")
}

fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

fn escaped(text: &str) -> String {
    text.replace('[', "\\[").replace(']', "\\]")
}

fn sentence(text: &str) -> String {
    let text = text.trim();
    if text.is_empty() || text.ends_with(['.', '?', ':']) {
        text.into()
    } else {
        format!("{text}.")
    }
}
