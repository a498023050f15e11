//! The table of verification cases.

use percuss_verification::{Check, Tolerance};

use super::done::Done;
use crate::number::{number, small};

const HEADER: [&str; 7] =
    ["", "case", "quantity", "measured", "expected", "deviation", "tolerance"];

/// One line a case, its tightest check; every check of failing cases, or of all.
pub(super) fn render(all: &[Done], all_checks: bool) -> String {
    let mut rows = vec![HEADER.map(String::from)];
    for done in all {
        if all_checks || !done.holds() {
            rows.extend(done.checks.iter().map(|check| cells(done.case.id, check, "")));
        } else if let Some(tightest) = tightest(&done.checks) {
            let others = match done.checks.len() - 1 {
                0 => String::new(),
                n => format!(" (+{n})"),
            };
            rows.push(cells(done.case.id, tightest, &others));
        }
        if done.checks.is_empty() {
            let mut empty = [const { String::new() }; 7];
            empty[0] = "FAILS".into();
            empty[1] = done.case.id.into();
            empty[2] = "checks nothing".into();
            rows.push(empty);
        }
    }
    aligned(&rows)
}

/// Cells of a check; `others` stands behind its quantity.
pub(super) fn cells(id: &str, check: &Check, others: &str) -> [String; 7] {
    let verdict = if check.holds() { "ok" } else { "FAILS" };
    let bound = matches!(check.tolerance, Tolerance::AtMost | Tolerance::AtLeast);
    let deviation = check.deviation().filter(|_| !bound);
    [
        verdict.into(),
        id.into(),
        format!("{}{others}", check.quantity),
        number(check.measured),
        number(check.expected),
        deviation.map_or("-".into(), small),
        match check.tolerance {
            Tolerance::Relative(t) => format!("{} relative", small(t)),
            Tolerance::Absolute(t) => small(t),
            Tolerance::AtMost => "at most".into(),
            Tolerance::AtLeast => "at least".into(),
        },
    ]
}

fn tightest(checks: &[Check]) -> Option<&Check> {
    checks.iter().max_by(|a, b| share_used(a).total_cmp(&share_used(b)))
}

/// How much of its tolerance a check uses up: 1 at the limit.
pub(super) fn share_used(check: &Check) -> f64 {
    let share = match check.tolerance {
        Tolerance::Relative(t) | Tolerance::Absolute(t) => {
            check.deviation().unwrap_or(f64::NAN) / t
        }
        Tolerance::AtMost => check.measured / check.expected,
        Tolerance::AtLeast => check.expected / check.measured,
    };
    if share.is_nan() { 0.0 } else { share }
}

fn aligned(rows: &[[String; 7]]) -> String {
    let width = |k: usize| rows.iter().map(|row| row[k].chars().count()).max().unwrap_or(0);
    let widths: [usize; 7] = std::array::from_fn(width);
    let mut text = String::new();
    for row in rows {
        let cells = row.iter().zip(widths).enumerate().map(|(k, (cell, width))| match k {
            3..=5 => format!("{cell:>width$}"),
            _ => format!("{cell:width$}"),
        });
        let line = cells.collect::<Vec<_>>().join("  ");
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}
