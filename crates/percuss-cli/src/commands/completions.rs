//! `percuss completions`.

use clap::CommandFactory;

use crate::arguments::Arguments;
use crate::coupling_arguments::Completions;
use crate::outcome::{Failure, Status};
use crate::terminal;

/// Prints a completion script.
pub fn run(arguments: &Completions) -> Result<Status, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "percuss", &mut script);
    terminal::print(&String::from_utf8_lossy(&script))?;
    Ok(Status::Done)
}
