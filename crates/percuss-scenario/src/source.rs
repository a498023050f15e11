//! The text of a scenario file and where things lie in it.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::de::{DeTable, DeValue};

/// A scenario file as text, with its name for messages.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Source {
    pub name: String,
    pub text: String,
    /// Byte at which each line begins, shape (lines) \[bytes\].
    lines: Vec<usize>,
}

impl Source {
    pub fn new(name: &str, text: &str) -> Self {
        let starts = text.match_indices('\n').map(|(i, _)| i + 1);
        let lines = [0].into_iter().chain(starts).collect();
        Self { name: name.into(), text: text.into(), lines }
    }

    /// Line and column of a byte, both from 1; the column counts characters.
    pub fn position(&self, at: usize) -> (usize, usize) {
        let at = floor(&self.text, at);
        let line = self.lines.partition_point(|&start| start <= at).max(1);
        let start = self.lines.get(line - 1).copied().unwrap_or(0);
        let before = &self.text[start..at];
        let mark = usize::from(start == 0 && before.starts_with('\u{feff}'));
        (line, before.chars().count() + 1 - mark)
    }

    /// Bytes of a line, counted from 1, without its end and without a byte order mark.
    pub fn line(&self, number: usize) -> Range<usize> {
        let number = number.max(1);
        let start = self.lines.get(number - 1).copied().unwrap_or(self.text.len());
        let end = self.lines.get(number).map_or(self.text.len(), |&next| next - 1);
        let text = self.text[start..end].trim_end_matches('\r');
        self.clamp(start..start + text.len())
    }

    /// The same span within the text, after its byte order mark, on the boundaries of characters.
    pub fn clamp(&self, span: Range<usize>) -> Range<usize> {
        let mark = if self.text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        let start = floor(&self.text, span.start).max(mark);
        start..floor(&self.text, span.end).max(start)
    }
}

/// The boundary of a character at or before `at`.
fn floor(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

/// Where every key of a file has its value, by dotted path.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Places(BTreeMap<String, Range<usize>>);

impl Places {
    pub fn new(root: &DeTable<'_>) -> Self {
        let mut places = Self::default();
        places.add("", root);
        places
    }

    fn add(&mut self, parent: &str, table: &DeTable<'_>) {
        for (key, value) in table {
            let path = join(parent, key.get_ref());
            if let DeValue::Table(inner) = value.get_ref() {
                self.add(&path, inner);
            }
            self.0.insert(path, value.span());
        }
    }

    /// The value at `path`, or the innermost table around it that stands in the file.
    pub fn find(&self, path: &str) -> Option<Range<usize>> {
        let mut path = path;
        loop {
            if let Some(span) = self.0.get(path) {
                return Some(span.clone());
            }
            path = path.rsplit_once('.')?.0;
        }
    }
}

/// `parent.key`, or `key` at the root.
pub(crate) fn join(parent: &str, key: &str) -> String {
    if parent.is_empty() { key.to_string() } else { format!("{parent}.{key}") }
}
