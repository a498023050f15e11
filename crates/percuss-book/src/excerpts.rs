//! Where tables and keys of the format stand in files that run, and the lines to show of them.

use std::path::{Path, PathBuf};
use std::{fs, io};

use percuss_scenario::{BodyReference, TableForm, TableReference, is_fit, is_study, templates};
use toml_edit::{DocumentMut, Item, TableLike};

/// A file whose lines may be shown.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Its name, as it is shown.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// Lines of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// Name of the file.
    pub file: String,
    /// The lines.
    pub text: String,
}

/// A table as it stands in a file.
#[derive(Clone, Debug)]
pub struct TableUse {
    /// Its declaration.
    pub table: &'static str,
    /// Keys and kinds that are there, `kind=elastic/stiffness`, each with its path in the file, shape (keys).
    pub keys: Vec<(String, String)>,
    /// The lines that show it.
    pub excerpt: Excerpt,
}

/// Every file of the repository that may serve as an example: scenarios, templates, examples of the book.
///
/// # Errors
/// A folder or file that cannot be read.
pub fn samples(repository: &Path) -> io::Result<Vec<Sample>> {
    let mut paths = Vec::new();
    for folder in [
        "scenarios",
        "scenarios/paper",
        "scenarios/studies",
        "scenarios/fits",
        "docs/book/examples",
    ] {
        paths.extend(files(&repository.join(folder), "toml")?);
    }
    let named = |path: PathBuf| {
        let name = path.strip_prefix(repository).unwrap_or(&path).display().to_string();
        fs::read_to_string(&path).map(|text| Sample { name, text })
    };
    let mut all = paths.into_iter().map(named).collect::<io::Result<Vec<Sample>>>()?;
    let template = |t: &percuss_scenario::Template| {
        let name = format!("crates/percuss-scenario/templates/{}.toml", t.name);
        Sample { name, text: t.text.into() }
    };
    all.extend(templates().iter().map(template));
    Ok(all)
}

/// Files of a folder with an extension, in the order of their names; none where there is no folder.
pub(crate) fn files(folder: &Path, extension: &str) -> io::Result<Vec<PathBuf>> {
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let entries = fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
    let mut paths = entries.collect::<io::Result<Vec<PathBuf>>>()?;
    paths.retain(|path| path.extension().is_some_and(|e| e == extension));
    paths.sort();
    Ok(paths)
}

/// Every table of a file that the format knows.
pub fn table_uses(sample: &Sample, format: &[TableReference]) -> Vec<TableUse> {
    let Ok(document) = sample.text.parse::<DocumentMut>() else { return Vec::new() };
    let mut walk = Walk { sample, format, found: Vec::new() };
    let file = format.iter().find(|table| table.form == TableForm::File);
    // Kinds of files share words for other things.
    let meant = match is_fit(&sample.text) {
        true => "FitContent",
        false if is_study(&sample.text) => "StudyContent",
        false => "Content",
    };
    if let Some(file) = file.filter(|file| file.name == meant) {
        walk.table(file, document.as_table(), "", String::new());
    }
    walk.found
}

/// Whether a table has a key, or a kind, that its declaration knows; tables by names of the user's have none.
fn has_own_key(of: &TableReference, table: &dyn TableLike) -> bool {
    let keys = of.body.keys.iter().map(|key| key.name);
    keys.chain(of.body.kinds.iter().map(|kinds| kinds.tag)).any(|key| table.contains_key(key))
}

/// The way through a file.
struct Walk<'w> {
    sample: &'w Sample,
    /// Tables of the format, shape (tables).
    format: &'w [TableReference],
    /// What was found so far, shape (files and tables).
    found: Vec<TableUse>,
}

impl Walk<'_> {
    /// Takes in a table at `path`, which `shown` shows.
    fn table(&mut self, of: &TableReference, at: &dyn TableLike, path: &str, shown: String) {
        let mut keys = Vec::new();
        self.body(&of.body, at, (path, &shown, ""), &mut keys);
        let excerpt = Excerpt { file: self.sample.name.clone(), text: shown };
        self.found.push(TableUse { table: of.name, keys, excerpt });
    }

    /// Takes in the keys of a body, and the tables behind them. The place is its path, the lines that show it, and the kinds
    /// chosen so far.
    fn body(
        &mut self,
        body: &BodyReference,
        at: &dyn TableLike,
        (path, shown, under): (&str, &str, &str),
        keys: &mut Vec<(String, String)>,
    ) {
        for key in &body.keys {
            let Some(item) = at.get(key.name) else { continue };
            let path = join(path, key.name);
            keys.push((format!("{under}{}", key.name), path.clone()));
            let inner = key.table.and_then(|name| self.format.iter().find(|t| t.name == name));
            if let Some(inner) = inner {
                self.behind(inner, item, &path, shown);
            }
        }
        for kinds in &body.kinds {
            let implied = kinds.implied.filter(|(key, _)| at.contains_key(key));
            let unsaid = implied.map_or(kinds.default, |(_, word)| Some(word));
            let word = at.get(kinds.tag).map_or(unsaid, Item::as_str);
            let Some((word, variant)) = kinds.variants.iter().find(|v| Some(v.0) == word) else {
                continue;
            };
            let under = format!("{under}{}={word}/", kinds.tag);
            keys.push((under.trim_end_matches('/').into(), join(path, kinds.tag)));
            self.body(variant, at, (path, shown, &under), keys);
        }
    }

    /// Takes in what stands behind a key: a table, tables by name, or a list of tables.
    fn behind(&mut self, of: &TableReference, item: &Item, path: &str, shown: &str) {
        if let Some(list) = item.as_array() {
            let tables =
                list.iter().enumerate().filter_map(|(k, v)| Some((k, v.as_inline_table()?)));
            for (k, table) in tables {
                self.table(of, table, &format!("{path}[{k}]"), shown.into());
            }
        }
        if let Some(list) = item.as_array_of_tables() {
            for (k, table) in list.iter().enumerate() {
                self.table(of, table, &format!("{path}[{k}]"), self.lines(path));
            }
        }
        if let Some(word) = item.as_str() {
            self.word(of, word, path, shown);
        }
        let Some(table) = item.as_table_like() else { return };
        match of.form {
            TableForm::File => {}
            // Tables in braces behind names of the user's.
            TableForm::Braces if !has_own_key(of, table) => {
                for (name, item) in table.iter() {
                    if let Some(table) = item.as_inline_table() {
                        self.table(of, table, &join(path, name), self.lines(path));
                    }
                }
            }
            TableForm::Braces => self.table(of, table, path, shown.into()),
            TableForm::Once => self.table(of, table, path, self.lines(path)),
            TableForm::Named => {
                for (name, item) in table.iter() {
                    if let Some(table) = item.as_table_like() {
                        let path = join(path, name);
                        self.table(of, table, &path, self.lines(&path));
                    }
                }
            }
        }
    }

    /// Takes in a table whose kind stands alone behind its key: `function = "constant"`.
    fn word(&mut self, of: &TableReference, word: &str, path: &str, shown: &str) {
        for kinds in &of.body.kinds {
            if kinds.variants.iter().any(|variant| variant.0 == word) {
                let keys = vec![(format!("{}={word}", kinds.tag), path.to_string())];
                let excerpt = Excerpt { file: self.sample.name.clone(), text: shown.into() };
                self.found.push(TableUse { table: of.name, keys, excerpt });
            }
        }
    }

    /// The lines of a table under its header, and of those under headers within it.
    fn lines(&self, path: &str) -> String {
        let within = |line: &str| {
            let header = line.trim().trim_matches(['[', ']']);
            header == path || header.strip_prefix(path).is_some_and(|rest| rest.starts_with('.'))
        };
        let mut inside = false;
        let mut shown: Vec<&str> = Vec::new();
        for line in self.sample.text.lines() {
            if line.starts_with('[') && !line.contains('=') {
                inside = within(line.split('#').next().unwrap_or(line));
            }
            if inside {
                shown.push(line);
            }
        }
        // Comments at the end belong to what follows.
        while shown.last().is_some_and(|line| line.trim().is_empty() || line.starts_with('#')) {
            shown.pop();
        }
        shown.join("\n")
    }
}

fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.into() } else { format!("{path}.{key}") }
}
