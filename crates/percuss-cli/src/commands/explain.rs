//! `percuss explain`.

mod find;
mod print;
pub mod topic;

use crate::arguments::Explain;
use crate::outcome::{Failure, Status};
use crate::terminal;

/// Prints an explanation, or lists codes and tables.
pub fn run(arguments: &Explain) -> Result<Status, Failure> {
    let text = match &arguments.topic {
        Some(topic) => topic.text.clone(),
        None => topic::list(),
    };
    terminal::print(&text)?;
    Ok(Status::Done)
}
