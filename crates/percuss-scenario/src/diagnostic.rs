//! Faults of a scenario file: where, what was found, what would be right.

use std::fmt;
use std::ops::Range;

use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteDiagnostic, MietteError,
    MietteSpanContents, SourceCode, SourceSpan, SpanContents,
};

use crate::code::FaultCode;
use crate::source::Source;
use crate::visible::{covered, visible, visible_line};

/// One fault of a scenario file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What kind of fault it is.
    pub code: FaultCode,
    /// Line, from 1; 0 where the fault is no place in a file.
    pub line: usize,
    /// Column in characters, from 1; 0 where the fault is no place in a file.
    pub column: usize,
    /// The bytes of the file at fault.
    pub span: Range<usize>,
    /// Dotted path of the key, `section.plank.area`; empty where there is none.
    pub path: String,
    /// What was found, in a form fit for `found ...`.
    pub message: String,
    /// What would be right, in a form fit for `expected ...`.
    pub help: String,
}

impl Diagnostic {
    /// A fault of the file as a whole.
    pub(crate) fn of_file(found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            code: FaultCode::File,
            line: 0,
            column: 0,
            span: 0..0,
            path: String::new(),
            message: found.into(),
            help: expected.into(),
        }
    }

    /// A fault at a place.
    pub(crate) fn at(
        code: FaultCode,
        source: &Source,
        span: Range<usize>,
        path: impl Into<String>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        let span = source.clamp(span);
        let (line, column) = source.position(span.start);
        let (path, message, help) = (path.into(), found.into(), expected.into());
        Self { code, line, column, span, path, message, help }
    }
}

impl fmt::Display for Diagnostic {
    /// `12:8: section.plank.area: found ..., expected ...`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.line > 0 {
            write!(f, "{}:{}: ", self.line, self.column)?;
        }
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        write!(f, "found {}, expected {}", self.message, self.help)
    }
}

/// Every fault of a file, in the order of the file; never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostics {
    source: Source,
    /// The faults, in the order of the file, shape (faults).
    all: Vec<Diagnostic>,
}

impl Diagnostics {
    /// A single fault of a file as a whole.
    pub fn of_file(name: &str, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self::new(Source::new(name, ""), vec![Diagnostic::of_file(found, expected)])
    }

    pub(crate) fn new(source: Source, mut all: Vec<Diagnostic>) -> Self {
        all.sort_by(|a, b| (a.span.start, a.line, &a.path).cmp(&(b.span.start, b.line, &b.path)));
        let mut seen = std::collections::HashSet::new();
        all.retain(|d| seen.insert((d.span.start, d.path.clone(), d.message.clone())));
        Self { source, all }
    }

    /// The first faults, at most so many, and how many more there are.
    pub fn first(mut self, most: usize) -> (Self, usize) {
        let rest = self.all.len().saturating_sub(most);
        self.all.truncate(most);
        (self, rest)
    }

    /// The faults, in the order of the file.
    pub fn all(&self) -> &[Diagnostic] {
        &self.all
    }

    /// Name of the file, as given.
    pub fn name(&self) -> &str {
        &self.source.name
    }

    /// Report with the source lines underlined, `width` columns wide; nothing in it but its own colours is obeyed by a terminal.
    pub fn fancy(&self, color: bool, width: usize) -> String {
        let theme =
            if color { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
        let handler =
            GraphicalReportHandler::new_themed(theme).with_width(width.max(40)).with_links(false);
        let mut out = String::new();
        for one in &self.all {
            let title = match one.path.as_str() {
                "" => format!("found {}", one.message),
                path => format!("{path}: found {}", one.message),
            };
            let help = format!("expected {} [{}]", one.help, one.code.code());
            let report = MietteDiagnostic::new(visible_line(&title));
            let mut report = report.with_help(visible_line(&help));
            if one.line > 0 && !self.source.text.is_empty() {
                let mark = self.underlined(&one.span);
                report = report.with_label(LabeledSpan::new_with_span(None, mark));
            }
            let line = Line::of(&self.source, one.line);
            let report = miette::Report::new(report).with_source_code(line);
            if handler.render_report(&mut out, report.as_ref()).is_err() {
                out.push_str(&visible(&format!("{}:{one}\n", self.source.name)));
            }
        }
        out
    }

    /// One line for each fault, with its code at the end: `file.toml:12:8: section.plank.area: found ..., expected ... [E006]`.
    pub fn coded(&self) -> String {
        let line = |one: &Diagnostic| format!("{} [{}]", self.line(one), one.code.code());
        let lines = self.all.iter().map(|one| visible_line(&line(one)));
        lines.collect::<Vec<_>>().join("\n")
    }

    fn line(&self, one: &Diagnostic) -> String {
        let separator = if one.line > 0 { ":" } else { ": " };
        format!("{}{separator}{one}", self.source.name)
    }

    /// Start and length of the mark: the span up to the end of its line; of an empty span the last
    /// character before it.
    fn underlined(&self, span: &Range<usize>) -> (usize, usize) {
        let text = &self.source.text;
        let marked = &text[span.start..span.end];
        let length = marked.find(['\n', '\r']).unwrap_or(marked.len());
        match text[..span.start].chars().next_back() {
            Some(c) if length == 0 && !matches!(c, '\n' | '\u{feff}') => {
                (span.start - c.len_utf8(), c.len_utf8())
            }
            _ => (span.start, length),
        }
    }
}

impl fmt::Display for Diagnostics {
    /// One line for each fault: `file.toml:12:8: section.plank.area: found ..., expected ...`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, one) in self.all.iter().enumerate() {
            let end = if i > 0 { "\n" } else { "" };
            write!(f, "{end}{}", self.line(one))?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

/// Shows the one line a fault stands on, whatever context is asked for.
#[derive(Debug)]
struct Line {
    name: String,
    text: String,
    start: usize,
    number: usize,
}

impl Line {
    fn of(source: &Source, number: usize) -> Self {
        let span = source.line(number);
        let text = covered(&source.text[span.clone()]);
        Self { name: visible_line(&source.name), text, start: span.start, number }
    }
}

impl SourceCode for Line {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        _before: usize,
        _after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let before = self.text.get(..span.offset().saturating_sub(self.start));
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.clone(),
            self.text.as_bytes(),
            (self.start, self.text.len()).into(),
            self.number.saturating_sub(1),
            before.map_or(0, |text| text.chars().count()),
            1,
        )))
    }
}
