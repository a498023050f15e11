//! Messages at the end of a run, and its exit status.

use std::path::Path;

use percuss::Termination;
use percuss_codes::{AnalysisCode, Caution, RequestCode};

use super::checkpoints::Checkpoints;
use super::ended::{Ended, shown};
use super::{balance, table};
use crate::outcome::{Failure, Status};
use crate::run_arguments::Run;
use crate::{advisor, browser, interrupt, terminal};

/// Prints how the run ended; the results are in the output directory.
pub(super) fn conclude(
    ended: &Ended,
    arguments: &Run,
    out: &Path,
    report: Result<(), Failure>,
) -> Result<Status, Failure> {
    if arguments.json {
        terminal::print(&format!("{:#}\n", ended.value))?;
    } else if !arguments.quiet {
        terminal::tell(&table::table(ended, out));
    }
    if !arguments.quiet {
        advisor::tell_audit(&ended.warnings);
    }
    match &ended.summary.termination {
        Termination::Failed(error) => {
            terminal::error(error.code(), &stopped(error));
            report?;
            return Ok(Status::GaveUp);
        }
        Termination::Interrupted { time } => {
            let time = crate::number::quantity(*time, "s");
            let text = format!("interrupted at t = {time}; results up to this time are written");
            terminal::warning(Caution::Interrupted, &text);
            if let Some((place, Some(time))) = ended.checkpoints.as_ref().map(Checkpoints::place) {
                let (place, time) = (shown(place), crate::number::quantity(time, "s"));
                terminal::tell(&format!(
                    "the same command with --resume continues from t = {time} ({})",
                    place.display()
                ));
            }
        }
        _ if interrupt::requested() => {
            let text = "interrupted after the end of the run; the results are complete";
            terminal::warning(Caution::Interrupted, text);
        }
        _ => {}
    }
    report?;
    if interrupt::requested() {
        return Ok(Status::Interrupted);
    }
    let mut denied = ended.denied.clone();
    if arguments.open
        && let Some(text) = browser::open(&out.join("report.html"))
    {
        denied.extend(advisor::warn(Caution::Browser, &text, &arguments.deny));
    }
    let open = if arguments.strict { balance::open(&ended.summary) } else { Vec::new() };
    open.iter().for_each(|text| terminal::error(AnalysisCode::Balance, text));
    denied.iter().for_each(|text| terminal::error(RequestCode::Denied, text));
    Ok(if open.is_empty() && denied.is_empty() { Status::Done } else { Status::BalanceOpen })
}

/// Why a run stopped; an iteration that did not converge is called that even where the error names an equilibrium.
fn stopped(error: &percuss::Error) -> String {
    let text = error.to_string();
    match error.is_no_convergence() && !text.starts_with("no convergence") {
        true => format!("no convergence: {text}"),
        false => text,
    }
}
