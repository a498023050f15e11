//! `percuss explain`.

use percuss_advice::Topic;
use percuss_scenario::FaultCode;

use crate::arguments::Explain;
use crate::outcome::{Failure, Status};
use crate::terminal;

/// Columns of a paragraph.
const WIDTH: usize = 96;

/// What a code stands for.
#[derive(Clone, Copy, Debug)]
pub enum Explained {
    /// A finding of the advisor: `W...`.
    Finding(Topic),
    /// A fault of a file: `E...`.
    Fault(FaultCode),
}

impl Explained {
    /// What `code` stands for.
    ///
    /// # Errors
    /// There is no such code.
    pub fn of_code(code: &str) -> Result<Self, String> {
        let finding = Topic::of_code(code).map(Self::Finding);
        let fault = || FaultCode::of_code(code).map(Self::Fault);
        finding.or_else(fault).ok_or_else(|| "no such code; `percuss explain` lists them".into())
    }

    fn all() -> impl Iterator<Item = Self> {
        let findings = Topic::ALL.into_iter().map(Self::Finding);
        findings.chain(FaultCode::ALL.into_iter().map(Self::Fault))
    }

    fn heading(self) -> String {
        match self {
            Self::Finding(topic) => format!("{}  {}", topic.code(), topic.name()),
            Self::Fault(fault) => format!("{}  {}", fault.code(), fault.name()),
        }
    }

    fn explanation(self) -> &'static str {
        match self {
            Self::Finding(topic) => topic.explanation(),
            Self::Fault(fault) => fault.explanation(),
        }
    }
}

/// Says what a code means, or lists all.
pub fn run(arguments: &Explain) -> Result<Status, Failure> {
    let text = match arguments.code {
        Some(one) => format!("{}\n\n{}\n", one.heading(), paragraph(one.explanation())),
        None => Explained::all().map(|one| one.heading() + "\n").collect(),
    };
    terminal::print(&text)?;
    Ok(Status::Done)
}

/// Broken into lines between words.
fn paragraph(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        if !lines[last].is_empty() && lines[last].len() + 1 + word.len() > WIDTH {
            lines.push(word.into());
        } else {
            let gap = if lines[last].is_empty() { "" } else { " " };
            lines[last] = format!("{}{gap}{word}", lines[last]);
        }
    }
    lines.join("\n")
}
