//! Pages as lines of text and fenced blocks.

/// A part of a page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// A line outside of blocks.
    Line(String),
    /// A fenced block.
    Fence(Fence),
}

/// A fenced block: ```` ```console,fails ````.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fence {
    /// Its language.
    pub language: String,
    /// What else stands behind the fence, separated by commas, shape (marks).
    pub marks: Vec<String>,
    /// Its lines, shape (lines).
    pub lines: Vec<String>,
}

impl Fence {
    /// Whether a mark is there.
    pub fn has(&self, mark: &str) -> bool {
        self.marks.iter().any(|one| one == mark)
    }

    /// The value of a mark `key=value`.
    pub fn value(&self, key: &str) -> Option<&str> {
        self.marks.iter().find_map(|mark| mark.strip_prefix(key)?.strip_prefix('='))
    }

    /// Its lines, each ended.
    pub fn text(&self) -> String {
        self.lines.iter().map(|line| format!("{line}\n")).collect()
    }

    /// As it stands in a page.
    pub fn whole(&self) -> String {
        let marks: String = self.marks.iter().map(|mark| format!(",{mark}")).collect();
        format!("```{}{marks}\n{}```\n", self.language, self.text())
    }

    /// The same without marks.
    pub fn plain(&self) -> String {
        format!("```{}\n{}```\n", self.language, self.text())
    }
}

/// The parts of a page; a block that is not closed ends with the page.
pub fn parts(page: &str) -> Vec<Part> {
    let mut parts = Vec::new();
    let mut open: Option<Fence> = None;
    for line in page.lines() {
        match (&mut open, line.strip_prefix("```")) {
            (None, Some(info)) => {
                let mut words = info.split(',').map(|word| word.trim().to_string());
                let language = words.next().unwrap_or_default();
                open = Some(Fence { language, marks: words.collect(), lines: Vec::new() });
            }
            (Some(_), Some("")) => parts.extend(open.take().map(Part::Fence)),
            (Some(fence), _) => fence.lines.push(line.into()),
            (None, None) => parts.push(Part::Line(line.into())),
        }
    }
    parts.extend(open.map(Part::Fence));
    parts
}
