//! Tables of the page of a study.

use percuss_output::report::sheet::{Bar, Block, in_words};

use crate::analysis::{Estimate, Population, Spread, share_interval, sobol_indices_of};
use crate::column::{Role, Table, Values};
use crate::parameter::Variation;
use crate::study::Study;
use percuss_output::shown::FINDINGS;

/// Intervals of indices wider than this are remarked upon.
const WIDE: f64 = 0.2;

fn texts(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_string()).collect()
}

/// Shares of the completed runs that the table of exceedances asks for, as far down as the runs reach.
const SHARES: [f64; 12] = [0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4];

/// How the results are spread.
pub(super) fn results(study: &Study, table: &Table) -> Vec<Block> {
    let header = [
        "result",
        "mean",
        "standard deviation",
        "smallest",
        "5 %",
        "median",
        "95 %",
        "largest",
        "with a value",
        "completed",
        "runs",
    ];
    let row = |(name, unit, population): (&str, &str, Population)| {
        let mut row = vec![name.to_string()];
        match &population.spread {
            Some(s) => {
                let quantiles = [0.0, 0.05, 0.5, 0.95, 1.0].map(|p| s.quantile(p));
                let all = [s.mean, s.deviation].into_iter().chain(quantiles);
                row.extend(all.map(|value| in_words(value, unit)));
            }
            None => row.extend(["no values"].iter().chain(&[""; 6]).map(|s| s.to_string())),
        }
        let counts = [population.with_value(), population.completed, population.runs];
        row.extend(counts.map(|count| count.to_string()));
        row
    };
    let rows = populations(study, table).map(row).collect();
    let caption = "Completed runs with a value".to_string();
    let mut blocks = vec![Block::Table { caption, header: texts(&header), rows }];
    blocks.extend(open(study, table));
    if study.draws_values() {
        blocks.push(intervals(study, table));
        blocks.push(Block::Note(about_intervals(study)));
    }
    blocks
}

/// The results with their values.
fn populations<'s>(
    study: &'s Study,
    table: &'s Table,
) -> impl Iterator<Item = (&'s str, &'s str, Population)> {
    study.results().iter().filter_map(|r| {
        Some((r.name.as_str(), r.path.unit(), Population::of(study, table, &r.name)?))
    })
}

/// Intervals of confidence of means and quantiles.
fn intervals(study: &Study, table: &Table) -> Block {
    let row = |(name, unit, population): (&str, &str, Population)| {
        let s = population.spread?;
        let quantiles = [0.05, 0.5, 0.95].map(|p| s.quantile_interval(p));
        let all = [s.mean_interval()].into_iter().chain(quantiles);
        let end = |value: f64, open: &str| match value.is_nan() {
            true => open.to_string(),
            false => in_words(value, unit),
        };
        let words = |[low, high]: [f64; 2]| match (low.is_nan(), high.is_nan()) {
            (true, true) => "too few runs".to_string(),
            _ => format!("{} to {}", end(low, "below all values"), end(high, "above all values")),
        };
        Some([name.to_string()].into_iter().chain(all.map(words)).collect())
    };
    let rows: Vec<Vec<String>> = populations(study, table).filter_map(row).collect();
    let header = texts(&["result", "mean", "5 %", "median", "95 %"]);
    Block::Table { caption: "95 % confidence intervals".into(), header, rows }
}

/// What the intervals mean for the design at hand.
fn about_intervals(study: &Study) -> String {
    let mut text = String::from(
        "Means: Student's t. Quantiles: order statistics (binomial ranks). Shares: Clopper and Pearson.",
    );
    if study.is_spread_evenly() {
        text += " The intervals assume independent draws. The points of this design are more evenly spaced: errors of \
                 smooth results are smaller, often several times smaller.";
    }
    if study.has_sobol_indices() {
        text += " Only the two independent runs of each point are counted.";
    }
    text
}

/// Probabilities of exceedance of the results.
pub(super) fn exceedances(study: &Study, table: &Table) -> Vec<Block> {
    let header = texts(&["value", "runs above", "share of completed runs", "from", "to (95 %)"]);
    let one = |(name, unit, population): (&str, &str, Population)| {
        let s = population.least.as_ref()?;
        let n = population.completed;
        let mut seen: Vec<(f64, [usize; 2])> = Vec::new();
        for share in SHARES {
            let count = (share * n as f64 + 1e-9).floor() as usize;
            if count == 0 || count >= s.count {
                continue;
            }
            let value = s.exceeded_by(count);
            let above = population.above(value);
            if above[0] > 0 && !seen.iter().any(|(_, other)| *other == above) {
                seen.push((value, above));
            }
        }
        let row = |(value, [least, most]): &(f64, [usize; 2])| {
            let [low, high] = [share_interval(*least, n)[0], share_interval(*most, n)[1]];
            let share = |x: f64| in_words(x, "1");
            let both = |text: &dyn Fn(usize) -> String| match least == most {
                true => text(*least),
                false => format!("{} to {}", text(*least), text(*most)),
            };
            let above = both(&|count| count.to_string());
            let shares = both(&|count| share(count as f64 / n as f64));
            vec![in_words(*value, unit), above, shares, share(low), share(high)]
        };
        let rows: Vec<Vec<String>> = seen.iter().map(row).collect();
        let caption = match population.counts() {
            counts if counts.is_empty() => format!("{name}: probability of exceedance"),
            counts if population.open.is_empty() => {
                format!(
                    "{name}: probability of exceedance ({counts}; runs without a value do not exceed it)"
                )
            }
            counts => format!(
                "{name}: probability of exceedance ({counts}; up to the last value of a run with a closed contact it exceeds, beyond that it \
                 may; other runs without a value do not exceed it)"
            ),
        };
        (!rows.is_empty()).then(|| Block::Table { caption, header: header.clone(), rows })
    };
    settled(study, table).filter_map(one).collect()
}

/// Results that grow while a contact is closed, or that no contact leaves open: of these it is known how often they are above a value.
fn settled<'s>(
    study: &'s Study,
    table: &'s Table,
) -> impl Iterator<Item = (&'s str, &'s str, Population)> {
    let open = |name: &str| {
        let path = study.results().iter().find(|result| result.name == name).map(|r| &r.path);
        path.is_some_and(|path| path.may_stay_open() && !path.only_grows())
    };
    populations(study, table).filter(move |(name, _, all)| all.open.is_empty() || !open(name))
}

/// What contacts that were still closed at the end leave open of the results.
fn open(study: &Study, table: &Table) -> Vec<Block> {
    let note = |(name, unit, population): (&str, &str, Population)| {
        let (first, last) = (population.open.first()?, population.open.last()?);
        let path = &study.results().iter().find(|result| result.name == name)?.path;
        let runs = format!("{} of {} completed runs", population.open.len(), population.completed);
        let [first, last] = [first, last].map(|value| in_words(*value, unit));
        Some(Block::Note(match path.only_grows() {
            true => format!(
                "{name}: in {runs} a contact was still closed at the end. Its value there is at least the last one, {first} to {last} \
                 (column open.{name}); these runs are left out of the mean and quantiles or taken as complete. Set a later time.end."
            ),
            false => format!(
                "{name}: in {runs} a contact was still closed at the end. Its values there, {first} to {last} (column open.{name}), are not those \
                 after the contact. Set a later time.end."
            ),
        }))
    };
    populations(study, table).filter_map(note).collect()
}

/// Sobol indices of every result.
pub(super) fn indices(study: &Study, table: &Table) -> Vec<Block> {
    if !study.has_sobol_indices() {
        return Vec::new();
    }
    let mut blocks = vec![
        Block::Heading("Sobol sensitivity indices".into()),
        Block::Note(
            "First-order index: share of the variance due to the parameter alone. Total index: share including its interactions \
             with other parameters. In brackets: 95 % confidence intervals (bootstrap)."
                .into(),
        ),
    ];
    let mut unsure = false;
    for result in study.results() {
        let indices = match sobol_indices_of(study, table, &result.name) {
            Ok(indices) => indices,
            Err(reason) => {
                blocks.push(Block::Note(format!("{}: no indices: {}.", result.name, reason)));
                continue;
            }
        };
        let bar = |e: &Estimate| Bar { value: e.value, interval: [e.low, e.high] };
        let both = indices.first.iter().zip(&indices.total);
        let rows = study.parameters().iter().zip(both);
        let rows = rows.map(|(p, (first, total))| (p.name.clone(), vec![bar(first), bar(total)]));
        let lost = study.point_count() as usize - indices.points;
        let caption = match lost {
            0 => format!("{}: {} points", result.name, indices.points),
            lost => format!(
                "{}: {} points; {lost} points with a run without a value are left out",
                result.name, indices.points
            ),
        };
        let header = texts(&["parameter", "first-order index", "total index"]);
        blocks.push(Block::Bars { caption, header, rows: rows.collect() });
        unsure |= indices.first.iter().chain(&indices.total).any(|e| e.high - e.low > WIDE);
    }
    if unsure {
        let text = format!("Some intervals are wider than {WIDE}: more runs are needed.");
        blocks.push(Block::Note(text));
    }
    if study.is_spread_evenly() {
        let text = "The bootstrap assumes independent draws. The points are more evenly spaced: errors of the indices of smooth \
                    results are smaller, often several times smaller.";
        blocks.push(Block::Note(text.into()));
    }
    blocks
}

/// Balance errors of the runs.
pub(super) fn audit(table: &Table) -> Vec<Block> {
    let columns = table.columns.iter().filter(|column| column.role == Role::Audit);
    let row = |column: &crate::Column| {
        let spread = Spread::of(&table.numbers(&column.name)?)?;
        let name = column.name.trim_start_matches("audit.").replace('_', " ");
        let name = name.replace("newton", "Newton");
        let values = [spread.quantile(0.5), spread.max()];
        let values = values.map(|value| in_words(value, &column.unit));
        Some([name].into_iter().chain(values).collect())
    };
    let rows: Vec<Vec<String>> = columns.filter_map(row).collect();
    let header = texts(&["quantity", "median", "largest"]);
    let caption = "Relative balance errors of energy and momentum, and cost of the runs";
    vec![
        Block::Heading("Balance errors and cost".into()),
        Block::Table { caption: caption.into(), header, rows },
    ]
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
    let rows = lost.iter().take(FINDINGS).map(row).collect();
    let caption = match lost.len() {
        n if n > FINDINGS => format!("The first {FINDINGS} of {n}"),
        n => format!("{n} of {} runs", table.rows()),
    };
    vec![
        Block::Heading("Runs that are not completed".into()),
        Block::Table { caption, header, rows },
    ]
}

/// What varied, and how.
pub(super) fn parameters(study: &Study) -> Block {
    let row = |parameter: &crate::Parameter| {
        let ends = [0.0, 1.0].map(|u| match parameter.variation.at(u) {
            crate::Input::Number(x) if x.is_finite() => in_words(x, &parameter.unit),
            crate::Input::Number(_) => "unbounded".to_string(),
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
