//! `percuss man`.

use std::path::Path;

use clap::{Command, CommandFactory};
use clap_mangen::Man;

use crate::arguments::Arguments;
use crate::coupling_arguments;
use crate::outcome::{Failure, Status};
use crate::replacing;
use crate::terminal;

/// Writes a manual page for the program and one for each command.
pub fn run(arguments: &coupling_arguments::Man) -> Result<Status, Failure> {
    let out = &arguments.out;
    std::fs::create_dir_all(out).map_err(|error| Failure::system(out, "create", &error))?;
    let mut program = Arguments::command().disable_help_subcommand(true);
    program.build();
    write(program, out)?;
    terminal::tell(&format!(
        "manual pages in {}; view them with `man -l {}/percuss.1`",
        out.display(),
        out.display()
    ));
    Ok(Status::Done)
}

/// The pages of a command and of those below it.
fn write(command: Command, out: &Path) -> Result<(), Failure> {
    for below in command.get_subcommands().filter(|below| !below.is_hide_set()) {
        write(below.clone(), out)?;
    }
    let page = Man::new(command);
    let (mut text, file) = (Vec::new(), out.join(page.get_filename()));
    page.render(&mut text).map_err(|error| Failure::system(&file, "write", &error))?;
    let is_page = |there: &Path| {
        std::fs::read_to_string(there).is_ok_and(|text| text.contains(".TH percuss"))
    };
    replacing::put(&file, &text, &is_page)
}
