//! Tables of the page of a study.

use percuss_output::report::sheet::{Bar, Block, in_words};

use crate::analysis::{Estimate, Spread, sobol_indices_of};
use crate::column::{Role, Table, Values};
use crate::parameter::Variation;
use crate::study::Study;

/// Runs listed that did not end well; the table of the study has all of them.
const FAILURES_SHOWN: usize = 50;

/// Intervals of indices wider than this are remarked upon.
const WIDE: f64 = 0.2;

fn texts(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_string()).collect()
}

/// How the results are spread.
pub(super) fn results(study: &Study, table: &Table) -> Vec<Block> {
    let header =
        ["result", "mean", "deviation", "smallest", "5 %", "median", "95 %", "largest", "runs"];
    let row = |(name, unit, values): (&str, &str, Vec<f64>)| {
        let mut row = vec![name.to_string()];
        match Spread::of(&values) {
            Some(s) => {
                let quantiles = [0.0, 0.05, 0.5, 0.95, 1.0].map(|p| s.quantile(p));
                let all = [s.mean, s.deviation].into_iter().chain(quantiles);
                row.extend(all.map(|value| in_words(value, unit)));
                row.push(s.count.to_string());
            }
            None => row.extend(["no values".to_string()]),
        }
        row
    };
    let columns = study.results().iter();
    let columns =
        columns.filter_map(|r| Some((r.name.as_str(), r.path.unit(), table.numbers(&r.name)?)));
    let rows = columns.map(row).collect();
    let caption = "Over all runs that completed".to_string();
    vec![Block::Table { caption, header: texts(&header), rows }]
}

/// Sobol indices of every result.
pub(super) fn indices(study: &Study, table: &Table) -> Vec<Block> {
    if !study.has_sobol_indices() {
        return Vec::new();
    }
    let mut blocks = vec![
        Block::Heading("Sensitivity: whose the variance is".into()),
        Block::Note(
            "First-order index: the share of the variance that would vanish if the parameter alone were known. Total index: \
             the share that would remain if all but it were known, what it does together with others included. In \
             brackets 95 % intervals by resampling."
                .into(),
        ),
    ];
    let mut unsure = false;
    for result in study.results() {
        let Some(indices) = sobol_indices_of(study, table, &result.name) else {
            blocks.push(Block::Note(format!("{}: it does not vary.", result.name)));
            continue;
        };
        let bar = |e: &Estimate| Bar { value: e.value, interval: [e.low, e.high] };
        let both = indices.first.iter().zip(&indices.total);
        let rows = study.parameters().iter().zip(both);
        let rows = rows.map(|(p, (first, total))| (p.name.clone(), vec![bar(first), bar(total)]));
        let lost = study.point_count() as usize - indices.points;
        let caption = match lost {
            0 => format!("{}: {} points", result.name, indices.points),
            lost => format!("{}: {} points, {lost} left out", result.name, indices.points),
        };
        let header = texts(&["parameter", "first-order index", "total index"]);
        blocks.push(Block::Bars { caption, header, rows: rows.collect() });
        unsure |= indices.first.iter().chain(&indices.total).any(|e| e.high - e.low > WIDE);
    }
    if unsure {
        let text = format!("Some intervals are wider than {WIDE}: more runs would narrow them.");
        blocks.push(Block::Note(text));
    }
    blocks
}

/// Whether the books of the runs closed.
pub(super) fn audit(table: &Table) -> Vec<Block> {
    let columns = table.columns.iter().filter(|column| column.role == Role::Audit);
    let row = |column: &crate::Column| {
        let spread = Spread::of(&table.numbers(&column.name)?)?;
        let name = column.name.trim_start_matches("audit.").replace('_', " ");
        let values = [spread.quantile(0.5), spread.max()];
        let values = values.map(|value| in_words(value, &column.unit));
        Some([name].into_iter().chain(values).collect())
    };
    let rows: Vec<Vec<String>> = columns.filter_map(row).collect();
    let header = texts(&["", "median", "largest"]);
    let caption = "Books of energy and momentum, relative to what was in play, and what runs cost";
    vec![Block::Heading("Audit".into()), Block::Table { caption: caption.into(), header, rows }]
}

/// Runs that did not end well.
pub(super) fn failures(study: &Study, table: &Table) -> Vec<Block> {
    let (Some(status), Some(reason)) = (table.texts("status"), table.texts("reason")) else {
        return Vec::new();
    };
    let lost: Vec<usize> = (0..status.len()).filter(|&row| status[row] != "completed").collect();
    if lost.is_empty() {
        return Vec::new();
    }
    let mut header = texts(&["run"]);
    header.extend(study.parameters().iter().map(|p| p.name.clone()));
    header.extend(texts(&["status", "reason"]));
    let row = |&row: &usize| {
        let mut cells = vec![row.to_string()];
        for (column, values) in table.columns.iter().zip(&table.values) {
            match values {
                _ if column.role != Role::Input => {}
                Values::Number(values) => cells.push(in_words(values[row], &column.unit)),
                Values::Whole(values) => cells.push(values[row].to_string()),
                Values::Text(values) => cells.push(values[row].clone()),
            }
        }
        cells.extend([status[row].clone(), reason[row].clone()]);
        cells
    };
    let rows = lost.iter().take(FAILURES_SHOWN).map(row).collect();
    let caption = match lost.len() {
        n if n > FAILURES_SHOWN => format!("The first {FAILURES_SHOWN} of {n}"),
        n => format!("{n} of {} runs", table.rows()),
    };
    vec![
        Block::Heading("Runs that did not complete".into()),
        Block::Table { caption, header, rows },
    ]
}

/// What varied, and how.
pub(super) fn parameters(study: &Study) -> Block {
    let row = |parameter: &crate::Parameter| {
        let ends = [0.0, 1.0].map(|u| match parameter.variation.at(u) {
            crate::Input::Number(x) if x.is_finite() => in_words(x, &parameter.unit),
            crate::Input::Number(_) => "without limit".to_string(),
            crate::Input::Word(word) => word.to_string(),
        });
        let kind = match &parameter.variation {
            Variation::Numbers(values) => format!("{} values", values.len()),
            Variation::Words(values) => format!("{} values", values.len()),
            Variation::Range { count: Some(count), .. } => format!("range, {count} values"),
            Variation::Range { .. } => "range".to_string(),
            Variation::Random(crate::Distribution::Uniform { .. }) => "uniform".to_string(),
            Variation::Random(crate::Distribution::Normal { .. }) => "normal".to_string(),
            Variation::Random(crate::Distribution::Lognormal { .. }) => "lognormal".to_string(),
        };
        let [from, to] = ends;
        vec![parameter.name.clone(), parameter.field.path().to_string(), kind, from, to]
    };
    let header = texts(&["parameter", "path", "variation", "from", "to"]);
    let rows = study.parameters().iter().map(row).collect();
    Block::Table { caption: "Parameters".into(), header, rows }
}
