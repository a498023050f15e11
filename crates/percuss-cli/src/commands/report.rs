//! `percuss report`.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use percuss_codes::{Caution, FileCode, RequestCode};
use percuss_output::report::side_by_side::{self, Named};
use percuss_output::report::{ReportData, write, write_with_figures};

use crate::arguments::Report;
use crate::browser;
use crate::interrupt;
use crate::outcome::{Failure, Status};
use crate::replacing;
use crate::terminal;

/// Rebuilds the report of a finished run, or compares several runs.
pub fn run(arguments: &Report) -> Result<Status, Failure> {
    arguments.dirs.iter().try_for_each(|dir| refuse_what_is_no_run(dir))?;
    match arguments.dirs.as_slice() {
        [dir] => rebuild(dir, arguments),
        dirs => compare(dirs, arguments),
    }
}

/// Writes one page of several runs.
fn compare(dirs: &[PathBuf], arguments: &Report) -> Result<Status, Failure> {
    let out = &arguments.out;
    if dirs.len() > side_by_side::MOST_RUNS {
        return Err(Failure::input(
            RequestCode::TooManyRuns,
            format!("{} runs: a comparison shows at most {}", dirs.len(), side_by_side::MOST_RUNS),
        ));
    }
    refuse_foreign_page(out)?;
    let names = names(dirs);
    let read = |(dir, name): (&PathBuf, String)| Ok(Named { name, data: ReportData::read(dir)? });
    let runs = dirs.iter().zip(names).map(read).collect::<Result<Vec<_>, Failure>>()?;
    replacing::put(out, side_by_side::render(&runs)?.as_bytes(), &is_comparison)?;
    terminal::tell(&format!("{} compares {} runs", out.display(), runs.len()));
    if arguments.open {
        warn(browser::open(out));
    }
    Ok(Status::Done)
}

fn warn(of: Option<String>) {
    of.iter().for_each(|text| terminal::warning(Caution::Browser, text));
}

/// Names of the directories, with as much of their paths as tells them apart.
fn names(dirs: &[PathBuf]) -> Vec<String> {
    let named = |parts: usize| -> Vec<String> {
        let name = |dir: &PathBuf| {
            let whole = dir.canonicalize().unwrap_or_else(|_| dir.clone());
            let all: Vec<_> = whole.iter().map(|p| p.to_string_lossy().into_owned()).collect();
            all[all.len().saturating_sub(parts)..].join("/")
        };
        dirs.iter().map(name).collect()
    };
    let differ = |names: &[String]| names.iter().collect::<BTreeSet<_>>().len() == names.len();
    (1..6).map(named).find(|names| differ(names)).unwrap_or_else(|| {
        dirs.iter().enumerate().map(|(k, d)| format!("{}: {}", k + 1, d.display())).collect()
    })
}

/// A file that is no page of ours stays as it is.
fn refuse_foreign_page(out: &Path) -> Result<(), Failure> {
    match !out.exists() || is_comparison(out) {
        true => Ok(()),
        false => Err(Failure::input(
            FileCode::Foreign,
            format!(
                "{}: exists and is not a percuss comparison; choose another --out",
                out.display()
            ),
        )),
    }
}

/// Whether a file is a comparison that this program wrote.
fn is_comparison(page: &Path) -> bool {
    let mut start = Vec::new();
    let read = File::open(page).and_then(|file| file.take(4096).read_to_end(&mut start));
    read.is_ok() && String::from_utf8_lossy(&start).contains(side_by_side::MARK)
}

fn rebuild(dir: &Path, arguments: &Report) -> Result<Status, Failure> {
    let (data, page) = (ReportData::read(dir)?, dir.join("report.html"));
    let update = interrupt::update(dir)?;
    if arguments.figures {
        write_with_figures(update.path(), &data)?;
        interrupt::commit_update(update)?;
        terminal::tell(&format!("{} and figures/ rebuilt", page.display()));
    } else {
        write(update.path(), &data)?;
        interrupt::commit_update(update)?;
        terminal::tell(&format!("{} rebuilt", page.display()));
    }
    if arguments.open {
        warn(browser::open(&page));
    }
    Ok(Status::Done)
}

/// Refuses a path that is not the directory of a run.
pub fn refuse_what_is_no_run(dir: &Path) -> Result<(), Failure> {
    let what = if !dir.exists() {
        "no such directory"
    } else if !dir.is_dir() {
        "not a directory"
    } else if !dir.join("summary.json").is_file() {
        "not the directory of a run (it has no summary.json)"
    } else {
        return Ok(());
    };
    let expected = "give the directory that `percuss run` has written";
    Err(Failure::input(FileCode::NoRun, format!("{}: {what}; {expected}", dir.display())))
}
