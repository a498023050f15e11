//! `percuss explain`.

use percuss_advice::Topic;

use crate::arguments::Explain;
use crate::outcome::{Failure, Status};
use crate::terminal;

/// Columns of a paragraph.
const WIDTH: usize = 96;

/// Says what a code means, or lists all.
pub fn run(arguments: &Explain) -> Result<Status, Failure> {
    let text = match arguments.code {
        Some(topic) => format!("{}\n\n{}\n", heading(topic), paragraph(topic.explanation())),
        None => Topic::ALL.into_iter().map(|topic| heading(topic) + "\n").collect(),
    };
    terminal::print(&text)?;
    Ok(Status::Done)
}

fn heading(topic: Topic) -> String {
    format!("{}  {}", topic.code(), topic.name())
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
