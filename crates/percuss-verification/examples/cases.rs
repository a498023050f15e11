//! Runs the cases of `percuss verify` and prints a line for each: its name, whether it passes, and the comparisons that fail. Cases run in
//! parallel, and a panic ends only its case: scripts/sensitivity runs this with errors in the mechanics.

use std::panic::catch_unwind;
use std::sync::atomic::{AtomicUsize, Ordering};

use percuss_verification::{CASES, Case, Check};

fn line(case: &Case) -> String {
    let Ok(report) = catch_unwind(|| (case.run)()) else {
        return format!("{}\tpanics\t0\t0", case.id);
    };
    let checks = &report.checks;
    let open = checks.iter().filter(|check| !check.holds()).count();
    let word = if open == 0 && !checks.is_empty() { "holds" } else { "fails" };
    let first = checks.iter().find(|check| !check.holds());
    let first = first.map_or("", |check: &Check| &check.quantity);
    format!("{}\t{word}\t{open}\t{}\t{first}", case.id, checks.len())
}

fn main() {
    std::panic::set_hook(Box::new(|_| ()));
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(case) = CASES.get(next.fetch_add(1, Ordering::Relaxed)) {
                    println!("{}", line(case));
                }
            });
        }
    });
}
