//! How a run went, said at its end, and the exit status that goes with it.

use std::path::Path;

use percuss::Termination;
use percuss_codes::{AnalysisCode, Caution, RequestCode};

use super::checkpoints::Checkpoints;
use super::ended::{Ended, shown};
use super::{balance, table};
use crate::outcome::{Failure, Status};
use crate::run_arguments::Run;
use crate::{advisor, browser, interrupt, terminal};

/// Says how the run went; the results are in their place.
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
            terminal::error(error.code(), &format!("the solver gave up: {error}"));
            report?;
            return Ok(Status::GaveUp);
        }
        Termination::Interrupted { time } => {
            let time = crate::number::number(*time);
            let text = format!("interrupted at t = {time} s; the results end there");
            terminal::warning(Caution::Interrupted, &text);
            if let Some((place, Some(time))) = ended.checkpoints.as_ref().map(Checkpoints::place) {
                let (place, time) = (shown(place), crate::number::number(time));
                terminal::tell(&format!(
                    "the same command with --resume goes on from t = {time} s ({})",
                    place.display()
                ));
            }
        }
        _ if interrupt::requested() => {
            let text = "interrupted after the run, whose results are complete";
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
