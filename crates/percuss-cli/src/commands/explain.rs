//! `percuss explain`.

use percuss_codes::{Code, Group};

use crate::arguments::Explain;
use crate::outcome::{Failure, Status};
use crate::terminal;

/// Columns of a paragraph.
const WIDTH: usize = 96;

/// What `code` stands for.
///
/// # Errors
/// There is no such code.
pub fn code(code: &str) -> Result<Code, String> {
    Code::find(code).ok_or_else(|| "no such code; `percuss explain` lists them".into())
}

fn heading(one: Code) -> String {
    format!("{}  {}", one.code, one.name)
}

/// Says what a code means, or lists all.
pub fn run(arguments: &Explain) -> Result<Status, Failure> {
    let text = match arguments.code {
        Some(one) => format!("{}\n\n{}\n", heading(one), paragraph(one.explanation)),
        None => Code::groups().iter().map(list).collect::<Vec<_>>().join("\n"),
    };
    terminal::print(&text)?;
    Ok(Status::Done)
}

fn list(group: &Group) -> String {
    let codes: String = group.codes.iter().map(|one| format!("  {}\n", heading(*one))).collect();
    format!("{}\n{codes}", group.name)
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
