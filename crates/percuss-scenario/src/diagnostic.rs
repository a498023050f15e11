//! Faults of a scenario file: where, what was found, what would be right.

use std::fmt;
use std::ops::Range;

use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteDiagnostic, NamedSource};

use crate::source::Source;

/// One fault of a scenario file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
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
        source: &Source,
        span: Range<usize>,
        path: impl Into<String>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        let span = source.clamp(span);
        let (line, column) = source.position(span.start);
        let (path, message, help) = (path.into(), found.into(), expected.into());
        Self { line, column, span, path, message, help }
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
    all: Vec<Diagnostic>,
}

impl Diagnostics {
    pub(crate) fn new(source: Source, mut all: Vec<Diagnostic>) -> Self {
        all.sort_by(|a, b| (a.span.start, a.line, &a.path).cmp(&(b.span.start, b.line, &b.path)));
        let mut seen = std::collections::HashSet::new();
        all.retain(|d| seen.insert((d.span.start, d.path.clone(), d.message.clone())));
        Self { source, all }
    }

    /// The faults, in the order of the file.
    pub fn all(&self) -> &[Diagnostic] {
        &self.all
    }

    /// Name of the file, as given.
    pub fn name(&self) -> &str {
        &self.source.name
    }

    /// Report with the source lines underlined, `width` columns wide.
    pub fn fancy(&self, color: bool, width: usize) -> String {
        let theme =
            if color { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
        let handler = GraphicalReportHandler::new_themed(theme)
            .with_width(width.max(40))
            .with_context_lines(0)
            .with_links(false);
        let mut out = String::new();
        for one in &self.all {
            let title = match one.path.as_str() {
                "" => format!("found {}", one.message),
                path => format!("{path}: found {}", one.message),
            };
            let mut report =
                MietteDiagnostic::new(title).with_help(format!("expected {}", one.help));
            if one.line > 0 && !self.source.text.is_empty() {
                let length = self.underlined(&one.span);
                report =
                    report.with_label(LabeledSpan::new_with_span(None, (one.span.start, length)));
            }
            let named = NamedSource::new(&self.source.name, self.source.text.clone());
            let report = miette::Report::new(report).with_source_code(named);
            if handler.render_report(&mut out, report.as_ref()).is_err() {
                out.push_str(&format!("{}:{one}\n", self.source.name));
            }
        }
        out
    }

    /// Length of the mark: the span, but not beyond the end of its line.
    fn underlined(&self, span: &Range<usize>) -> usize {
        let text = &self.source.text[span.start..span.end];
        text.find(['\n', '\r']).unwrap_or(text.len())
    }
}

impl fmt::Display for Diagnostics {
    /// One line for each fault: `file.toml:12:8: section.plank.area: found ..., expected ...`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, one) in self.all.iter().enumerate() {
            let separator = if one.line > 0 { ":" } else { ": " };
            let end = if i > 0 { "\n" } else { "" };
            write!(f, "{end}{}{separator}{one}", self.source.name)?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}
