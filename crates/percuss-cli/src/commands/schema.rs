//! `percuss schema`.

use crate::outcome::{Failure, Status};
use crate::terminal;

/// Prints the JSON Schema of scenario files.
pub fn run() -> Result<Status, Failure> {
    terminal::print(&format!("{:#}\n", percuss_scenario::schema()))?;
    Ok(Status::Done)
}
