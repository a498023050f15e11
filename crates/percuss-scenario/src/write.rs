//! Writes a scenario back as TOML.

/// Text of a file in the making.
#[derive(Debug, Default)]
pub(crate) struct Writer {
    text: String,
    /// Header of the table begun; written with its first key.
    header: Option<String>,
    /// Path of the latest header.
    path: String,
    /// Path of the table that headers stand in, with a dot behind it; empty at the root.
    within: String,
    /// `key = value` one by one, for a table in braces, shape (keys).
    inline: Option<Vec<String>>,
}

impl Writer {
    /// For a table in braces.
    pub fn inline() -> Self {
        Self { inline: Some(Vec::new()), ..Self::default() }
    }

    /// `key = value`, with the unit as a comment.
    pub fn line(&mut self, key: &str, value: &str, unit: &str) {
        if let Some(inline) = &mut self.inline {
            inline.push(format!("{key} = {value}"));
            return;
        }
        if let Some(header) = self.header.take() {
            let separator = if self.text.is_empty() { "" } else { "\n" };
            self.text.push_str(&format!("{separator}[{header}]\n"));
        }
        let comment = if unit.is_empty() { String::new() } else { format!("  # {unit}") };
        self.text.push_str(&format!("{key} = {value}{comment}\n"));
    }

    /// `[kind]` or `[kind.name]`.
    pub fn header(&mut self, kind: &str, name: Option<&str>) {
        let name = name.map(|n| format!(".{}", key(n))).unwrap_or_default();
        self.path = format!("{}{kind}{name}", self.within);
        self.header = Some(self.path.clone());
    }

    /// Writes what stands in the table of the latest header: headers within it begin with its path.
    pub fn inside(&mut self, write: impl FnOnce(&mut Self)) {
        let within = format!("{}.", self.path);
        let outer = std::mem::replace(&mut self.within, within);
        write(self);
        self.within = outer;
    }

    /// The file, or the table in braces.
    pub fn finish(self) -> String {
        match self.inline {
            Some(inline) => format!("{{ {} }}", inline.join(", ")),
            None => self.text,
        }
    }
}

/// The shortest number that reads back the same bits.
pub(crate) fn number(value: f64) -> String {
    let plain = format!("{value:?}");
    let plain = match plain.strip_suffix(".0") {
        Some(whole) if whole != "-0" => whole.to_string(),
        _ => plain,
    };
    let scientific = format!("{value:e}");
    if scientific.len() + 2 < plain.len() { scientific } else { plain }
}

/// A text in quotes.
pub(crate) fn text(value: &str) -> String {
    toml_edit::Value::from(value).to_string()
}

/// A key, in quotes where it needs them.
pub(crate) fn key(name: &str) -> String {
    toml_edit::Key::new(name).to_string()
}
