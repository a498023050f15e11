//! `percuss plot`.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use percuss_codes::RequestCode;
use percuss_output::HistoryReader;
use percuss_output::report::ReportData;
use percuss_output::report::prints::{Print, accelerations, prints};
use percuss_pictures::{PrintFormat, is_ours, picture};
use percuss_scenario::one_of;

use super::animate::refuse_foreign;
use super::report::refuse_what_is_no_run;
use super::spectrum::refused;
use crate::outcome::{Failure, Status};
use crate::picture_arguments::Plot;
use crate::replacing;
use crate::terminal;
use percuss_output::shown::NAMES;

/// Writes figures of a finished run for print.
pub fn run(arguments: &Plot) -> Result<Status, Failure> {
    let dir = &arguments.dir;
    refuse_what_is_no_run(dir)?;
    let mut prints = prints(&ReportData::read(dir)?)?;
    if let Some(class) = arguments.cfc {
        let filtered = accelerations(&HistoryReader::open(dir)?, class)?;
        prints.extend(filtered.map_err(|error| refused(&error))?);
    }
    if arguments.list {
        return list(&prints);
    }
    let chosen = choose(&prints, arguments)?;
    if chosen.is_empty() {
        let text = format!("{}: the run has no figures", dir.display());
        return Err(Failure::input(RequestCode::NoSuchFigure, text));
    }
    let formats: BTreeSet<_> = arguments.format.iter().copied().collect();
    let formats: Vec<PrintFormat> = formats.into_iter().map(PrintFormat::from).collect();
    let file = |print: &Print, format: PrintFormat| -> PathBuf {
        arguments.out.join(format!("{}.{}", plain(print.id()), format.name()))
    };
    // Nothing is written if anything is in the way.
    for print in &chosen {
        formats.iter().try_for_each(|f| refuse_foreign(&file(print, *f), arguments.force))?;
    }
    fs::create_dir_all(&arguments.out)
        .map_err(|error| Failure::system(&arguments.out, "create", &error))?;
    let mut names = Vec::new();
    for print in &chosen {
        let svg = print.svg(1000.0 * arguments.width, !arguments.no_title);
        for format in &formats {
            let path = file(print, *format);
            let bytes = picture(&svg, *format, f64::from(arguments.dpi))?;
            replacing::put(&path, &bytes, &|there| arguments.force || is_ours(there))?;
            names.push(path.display().to_string());
        }
    }
    match names.len() {
        _ if arguments.quiet => {}
        n if n > NAMES => {
            terminal::tell(&format!(
                "{n} files of {} figures in {}",
                chosen.len(),
                arguments.out.display()
            ));
        }
        _ => terminal::tell(&names.join("\n")),
    }
    Ok(Status::Done)
}

fn list(prints: &[Print]) -> Result<Status, Failure> {
    let width = prints.iter().map(|p| p.id().chars().count()).max().unwrap_or(0);
    let lines = prints.iter().map(|p| format!("{:width$}  {}\n", p.id(), p.title()));
    terminal::print(&lines.collect::<String>())?;
    Ok(Status::Done)
}

/// The figures asked for, each once; all if none is.
fn choose<'p>(prints: &'p [Print], arguments: &Plot) -> Result<Vec<&'p Print>, Failure> {
    if arguments.figure.is_empty() {
        return Ok(prints.iter().collect());
    }
    let mut chosen: Vec<&Print> = Vec::new();
    for id in arguments.figure.iter().map(|id| id.trim()) {
        let print = prints.iter().find(|p| p.id() == id).ok_or_else(|| {
            Failure::input(
                RequestCode::NoSuchFigure,
                format!(
                    "--figure {id}: the run has no such figure; expected {}",
                    one_of(id, prints.iter().map(Print::id))
                ),
            )
        })?;
        if !chosen.iter().any(|other| other.id() == print.id()) {
            chosen.push(print);
        }
    }
    Ok(chosen)
}

/// A name any file system takes.
fn plain(id: &str) -> String {
    let keep = |c: char| if c.is_ascii_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    id.chars().map(keep).take(80).collect()
}
