//! `percuss verify`.

mod book;
mod done;
mod figure;
mod table;

use std::time::Instant;

use percuss_verification::{CASES, Case, Check, Tolerance};
use serde_json::{Value, json};

use crate::arguments::Verify;
use crate::outcome::{Failure, Status};
use crate::progress::Progress;
use crate::terminal;
use done::{Done, verdict};

/// Runs the verification cases.
pub fn run(arguments: &Verify) -> Result<Status, Failure> {
    let wanted =
        |case: &&Case| arguments.ids.is_empty() || arguments.ids.iter().any(|id| id == case.id);
    let cases: Vec<&Case> = CASES.iter().filter(wanted).collect();
    if arguments.list {
        list(&cases, arguments.json)?;
        return Ok(Status::Done);
    }
    let progress = Progress::of_things("verify", cases.len());
    let mut all = Vec::new();
    for (k, &case) in cases.iter().enumerate() {
        progress.show(case.id, k);
        let begun = Instant::now();
        let mut report = (case.run)();
        let checks = std::mem::take(&mut report.checks);
        all.push(Done { case, checks, report, seconds: begun.elapsed().as_secs_f64() });
    }
    progress.clear();
    if let Some(folder) = &arguments.book {
        book::write(folder, &all)?;
    }
    if arguments.json {
        terminal::print(&format!("{:#}\n", value(&all)))?;
    } else {
        terminal::print(&table::render(&all, arguments.all_checks))?;
        terminal::tell(&verdict(&all));
    }
    Ok(if all.iter().all(Done::holds) { Status::Done } else { Status::GaveUp })
}

fn list(cases: &[&Case], as_json: bool) -> Result<(), Failure> {
    if as_json {
        let one = |c: &&Case| json!({ "id": c.id, "title": c.title, "source": c.source });
        return terminal::print(&format!("{:#}\n", Value::from_iter(cases.iter().map(one))));
    }
    let width = cases.iter().map(|c| c.id.len()).max().unwrap_or(0);
    let line = |c: &&Case| {
        format!("{:width$}  {}\n{:width$}  expected from: {}\n", c.id, c.title, "", c.source)
    };
    terminal::print(&cases.iter().map(line).collect::<String>())
}

fn value(all: &[Done]) -> Value {
    let check = |check: &Check| {
        json!({
            "quantity": check.quantity,
            "measured": check.measured,
            "expected": check.expected,
            "deviation": check.deviation(),
            "tolerance": match check.tolerance {
                Tolerance::Relative(t) => json!({ "relative": t }),
                Tolerance::Absolute(t) => json!({ "absolute": t }),
                Tolerance::AtMost => json!("at most"),
                Tolerance::AtLeast => json!("at least"),
            },
            "holds": check.holds(),
        })
    };
    let case = |done: &Done| {
        json!({
            "id": done.case.id,
            "title": done.case.title,
            "source": done.case.source,
            "holds": done.holds(),
            "seconds": done.seconds,
            "checks": Value::from_iter(done.checks.iter().map(check)),
        })
    };
    json!({
        "holds": all.iter().all(Done::holds),
        "cases": Value::from_iter(all.iter().map(case)),
    })
}
