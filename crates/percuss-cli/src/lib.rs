//! The `percuss` command as a function: the binary calls it, and so does the Python package, whose wheel brings the command along.

mod advisor;
mod all_templates;
mod arguments;
mod browser;
mod commands;
mod coupling_arguments;
mod effective_mass;
mod failure;
mod fit_arguments;
mod foundation_text;
mod interrupt;
mod json;
mod memory;
mod modified_files;
mod new_file;
mod number;
mod outcome;
mod picture_arguments;
mod plastic_text;
mod progress;
mod replacing;
mod run_arguments;
mod scenario;
mod stage_messages;
mod terminal;

use std::ffi::OsString;

use clap::Parser;

use arguments::{Arguments, Command};

/// Does what a command line asks for and returns the exit status; its first word is the name of the program. Takes over Ctrl-C, and
/// may end the process: for a process of its own.
pub fn command<T: Into<OsString> + Clone>(line: impl IntoIterator<Item = T>) -> u8 {
    let arguments = match Arguments::try_parse_from(line) {
        Ok(arguments) => arguments,
        Err(error) => return refused(&error),
    };
    if arguments.allow_outside {
        scenario::allow_outside();
    }
    let done = interrupt::install().and_then(|()| match arguments.command {
        Command::Run(arguments) => commands::run::run(&arguments),
        Command::Extend(arguments) => commands::run::extend(&arguments),
        Command::Check(arguments) => commands::check::run(&arguments),
        Command::Static(arguments) => commands::statics::run(&arguments),
        Command::Modes(arguments) => commands::modes::run(&arguments),
        Command::New(arguments) => commands::new::run(&arguments),
        Command::Sweep(arguments) => commands::sweep::run(&arguments),
        Command::Sensitivity(arguments) => commands::sensitivity::run(&arguments),
        Command::Converge(arguments) => commands::converge::run(&arguments),
        Command::Fit(arguments) => commands::fit::run(&arguments),
        Command::Explain(arguments) => commands::explain::run(&arguments),
        Command::Book(arguments) => commands::book::run(&arguments),
        Command::Schema(arguments) => commands::schema::run(&arguments),
        Command::Export(arguments) => commands::export::run(&arguments),
        Command::Report(arguments) => commands::report::run(&arguments),
        Command::Animate(arguments) => commands::animate::run(&arguments),
        Command::Plot(arguments) => commands::plot::run(&arguments),
        Command::Spectrum(arguments) => commands::spectrum::run(&arguments),
        Command::Serve(arguments) => commands::serve::run(&arguments),
        Command::Eval(arguments) => commands::eval::run(&arguments),
        Command::Verify(arguments) => commands::verify::run(&arguments),
        Command::Completions(arguments) => commands::completions::run(&arguments),
        Command::Man(arguments) => commands::man::run(&arguments),
    });
    let status = done.unwrap_or_else(|failure| {
        failure.tell();
        failure.status()
    });
    status.code()
}

/// Tells of a command line that is not understood, or gives the help that was asked for.
fn refused(error: &clap::Error) -> u8 {
    let text = error.render().to_string();
    // Colours are those of the help; a text with someone else's words in it goes the one way to the terminal.
    if error.use_stderr() && percuss_scenario::visible(&text) != text {
        terminal::tell(&text);
    } else {
        // Where standard output is closed nobody reads it.
        let _ = error.print();
    }
    u8::try_from(error.exit_code()).unwrap_or(outcome::Status::Input.code())
}
