//! The page of a study.

mod figures;
mod tables;

use percuss_output::report::sheet::{Block, Sheet, render};

use crate::column::Table;
use crate::study::Study;

/// The page of a study as HTML, with everything it needs in it, made from its table alone; `kept` are numbers of runs that were kept
/// whole, and where their pages are, from this one.
pub fn report(study: &Study, table: &Table, kept: &[(u64, String)]) -> String {
    let title = match study.title() {
        "" => "Percuss study",
        title => title,
    };
    let completed = table.texts("status").unwrap_or_default();
    let completed = completed.iter().filter(|status| *status == "completed").count();
    let runs = table.rows();
    let status = match runs - completed {
        0 => format!("{runs} runs, all completed"),
        lost => format!("{runs} runs, {completed} completed, {lost} not completed (listed below)"),
    };
    let mut blocks = Vec::new();
    if !kept.is_empty() {
        let link = |(run, page): &(u64, String)| (format!("run {run}"), page.clone());
        let caption = "Recorded runs with their own page".to_owned();
        blocks.push(Block::Links { caption, links: kept.iter().map(link).collect() });
    }
    blocks.push(Block::Heading("Results".into()));
    blocks.extend(tables::results(study, table));
    blocks.extend(tables::indices(study, table));
    blocks.extend(figures::responses(study, table));
    blocks.extend(figures::maps(study, table));
    blocks.extend(figures::distributions(study, table));
    if study.draws_values() {
        blocks.extend(tables::exceedances(study, table));
    }
    blocks.extend(tables::audit(table));
    blocks.extend(tables::failures(study, table));
    blocks.push(Block::Heading("Study".into()));
    blocks.push(tables::parameters(study));
    blocks.push(Block::Note(study.how_runs_go()));
    let summary = "Study and scenario with all default values".to_string();
    blocks.push(Block::Listing { summary, text: study.to_toml() });
    render(&Sheet { title: title.into(), status, alarming: completed < runs, blocks })
}
