//! The `percuss` command: simulates impact on geometrically exact beams from scenario files.

use std::process::ExitCode;

fn main() -> ExitCode {
    percuss_cli::command(std::env::args_os()).into()
}
