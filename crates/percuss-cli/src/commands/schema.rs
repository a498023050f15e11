//! `percuss schema`.

use crate::arguments::Schema;
use crate::outcome::{Failure, Status};
use crate::terminal;

/// Prints the JSON Schema of scenario files or of study files.
pub fn run(arguments: &Schema) -> Result<Status, Failure> {
    let schema = match arguments.study {
        true => percuss_scenario::study_schema(),
        false => percuss_scenario::schema(),
    };
    terminal::print(&format!("{schema:#}\n"))?;
    Ok(Status::Done)
}
