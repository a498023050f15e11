//! `percuss man`.

use clap::CommandFactory;

use crate::arguments::Arguments;
use crate::coupling_arguments::Man;
use crate::outcome::{Failure, Status};
use crate::terminal;

/// Writes a manual page for the program and one for each command.
pub fn run(arguments: &Man) -> Result<Status, Failure> {
    let out = &arguments.out;
    std::fs::create_dir_all(out).map_err(|error| Failure::system(out, "create", &error))?;
    clap_mangen::generate_to(Arguments::command(), out)
        .map_err(|error| Failure::system(out, "write", &error))?;
    terminal::tell(&format!(
        "{} has the pages; `man -l {}/percuss.1`",
        out.display(),
        out.display()
    ));
    Ok(Status::Done)
}
