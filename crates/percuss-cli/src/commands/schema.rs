//! `percuss schema`.

use crate::arguments::Schema;
use crate::outcome::{Failure, Status};
use crate::terminal;

/// Prints the JSON Schema of scenario files, of study files or of files of fits.
pub fn run(arguments: &Schema) -> Result<Status, Failure> {
    let schema = match (arguments.study, arguments.fit) {
        (true, _) => percuss_scenario::study_schema(),
        (_, true) => percuss_scenario::fit_schema(),
        (false, false) => percuss_scenario::schema(),
    };
    terminal::print(&format!("{schema:#}\n"))?;
    Ok(Status::Done)
}
