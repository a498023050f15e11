//! `percuss export`.

use std::path::Path;

use percuss_codes::FileCode;
use percuss_output::paraview::{self, Format};
use percuss_output::{Extent, Results, fields};

use super::report::refuse_what_is_no_run;
use crate::arguments::{Export, ExportFormat};
use crate::interrupt;
use crate::outcome::{Failure, Status};
use crate::terminal;

/// Directory within that of the run.
const INSIDE: &str = "paraview";

/// Writes the shapes of a finished run for another program.
pub fn run(arguments: &Export) -> Result<Status, Failure> {
    let format = match arguments.format {
        ExportFormat::Vtkhdf => Format::Vtkhdf,
        ExportFormat::Pvd => Format::Pvd,
    };
    if !format.is_built() {
        let text = "this build has no HDF5 support; use --format pvd, or install with cargo install --path crates/percuss-cli";
        return Err(Failure::input(FileCode::Drawing, text));
    }
    let dir = &arguments.dir;
    refuse_what_is_no_run(dir)?;
    let Some(fields) = fields::read(dir)? else {
        return Err(Failure::input(
            FileCode::NoShapes,
            format!(
                "{}: the run has no recorded shapes (no fields/); run the scenario with record.shapes > 0",
                dir.display()
            ),
        ));
    };
    let (place, names) = match &arguments.out {
        Some(out) => {
            let directory = interrupt::directory(Results::Export, out)?;
            let names = paraview::write(directory.path(), &fields, format)?;
            (interrupt::commit(directory, Extent::Complete)?, names)
        }
        None => {
            let update = interrupt::update(dir)?;
            let names = paraview::write(update.path().join(INSIDE), &fields, format)?;
            interrupt::commit_update(update)?;
            (dir.join(INSIDE), names)
        }
    };
    terminal::tell(&description(&place, &names, fields.frames.len()));
    Ok(Status::Done)
}

fn description(place: &Path, names: &[String], frames: usize) -> String {
    format!("{}: {} with {frames} instants, for ParaView", place.display(), names.join(", "))
}
