//! Figures of the page of a study.

use percuss_output::report::sheet::{Block, Chart, Curve, Map, Mark, Quantity};

use crate::analysis::{Population, Spread};
use crate::column::Table;
use crate::parameter::{Parameter, Variation};
use crate::study::{ResultColumn, Study};

/// Points on a page, all figures together, and those of one figure at most.
const POINTS: usize = 150_000;
const POINTS_OF_FIGURE: usize = 4000;
/// Points that a map is made of at most.
const POINTS_OF_MAP: usize = 3000;
/// Groups of runs with a colour each.
const GROUPS: usize = 8;
/// Steps of an empirical distribution at most.
const STEPS: usize = 800;

/// Runs that take the same words.
struct Group {
    label: String,
    /// Its rows, shape (rows of it) \[index of a row\].
    rows: Vec<usize>,
}

/// Every result over every parameter that is a number.
pub(super) fn responses(study: &Study, table: &Table) -> Vec<Block> {
    let numeric = numeric(study);
    if numeric.is_empty() {
        return Vec::new();
    }
    let groups = groups(study, table);
    let figures = (numeric.len() * study.results().len()).max(1);
    let most = (POINTS / figures).min(POINTS_OF_FIGURE);
    let mut blocks = vec![Block::Heading("Response".into())];
    if table.rows() > most {
        let text =
            format!("{} runs; each figure shows {most} of them, evenly spaced.", table.rows());
        blocks.push(Block::Note(text));
    }
    let charts = study.results().iter().map(|result| {
        numeric
            .iter()
            .filter_map(|p| response(table, p, result, &groups, most, &numeric))
            .collect::<Vec<Chart>>()
    });
    match numeric.len() {
        1 => blocks.push(Block::Charts(charts.flatten().collect())),
        _ => blocks.extend(charts.map(Block::Charts)),
    }
    blocks
}

fn response(
    table: &Table,
    parameter: &Parameter,
    result: &ResultColumn,
    groups: &[Group],
    most: usize,
    numeric: &[&Parameter],
) -> Option<Chart> {
    let (x, y) = (table.numbers(&parameter.name)?, table.numbers(&result.name)?);
    let stride = table.rows().div_ceil(most).max(1);
    let mut curves = Vec::new();
    for (k, group) in groups.iter().enumerate() {
        let rows = group.rows.iter().copied().filter(|&row| x[row].is_finite());
        let rows: Vec<usize> = rows.step_by(stride).collect();
        let pick = |values: &[f64]| rows.iter().map(|&row| values[row]).collect::<Vec<f64>>();
        let label = if group.label.is_empty() { result.name.clone() } else { group.label.clone() };
        let (style, x, y) = (k + 1, pick(&x), pick(&y));
        // Where nothing else varies, the points lie on a curve.
        let mark = if numeric.len() == 1 { Mark::Line } else { Mark::Dots };
        curves.push(Curve { label, style, mark, x, y });
    }
    Some(Chart {
        id: format!("{}-{}", result.name, parameter.name),
        title: format!("{} over {}", result.name, parameter.name),
        note: String::new(),
        x: quantity(&parameter.name, &parameter.unit),
        y: quantity(&result.name, result.path.unit()),
        from_zero: false,
        curves,
    })
}

/// Every result over two parameters, where there are just two.
pub(super) fn maps(study: &Study, table: &Table) -> Vec<Block> {
    let numeric = numeric(study);
    let [a, b] = numeric.as_slice() else { return Vec::new() };
    if study.parameters().len() > 2 {
        return Vec::new();
    }
    let map = |result: &ResultColumn| {
        let (x, y) = (table.numbers(&a.name)?, table.numbers(&b.name)?);
        let z = table.numbers(&result.name)?;
        let stride = table.rows().div_ceil(POINTS_OF_MAP).max(1);
        let rows = (0..table.rows()).step_by(stride).filter(|&row| z[row].is_finite());
        let points: Vec<[f64; 3]> = rows.map(|row| [x[row], y[row], z[row]]).collect();
        let varies = |values: &dyn Fn(&[f64; 3]) -> f64| {
            points.iter().any(|p| values(p) != values(&points[0]))
        };
        if points.len() < 4 || !(varies(&|p| p[0]) && varies(&|p| p[1]) && varies(&|p| p[2])) {
            return None;
        }
        Some(Map {
            title: format!("{} over {} and {}", result.name, a.name, b.name),
            x: quantity(&a.name, &a.unit),
            y: quantity(&b.name, &b.unit),
            value: quantity(&result.name, result.path.unit()),
            points,
        })
    };
    let maps: Vec<Map> = study.results().iter().filter_map(map).collect();
    if maps.is_empty() {
        Vec::new()
    } else {
        vec![Block::Heading("Maps".into()), Block::Maps(maps)]
    }
}

/// How the results are distributed.
pub(super) fn distributions(study: &Study, table: &Table) -> Vec<Block> {
    if !study.draws_values() {
        return Vec::new();
    }
    let mut charts = Vec::new();
    for result in study.results() {
        let Some(population) = Population::of(study, table, &result.name) else { continue };
        let Some(spread) = &population.spread else { continue };
        charts.extend(histogram(result, &population, spread));
        charts.push(exceedance(result, &population, spread));
    }
    match charts.is_empty() {
        true => Vec::new(),
        false => vec![Block::Heading("Distributions".into()), Block::Charts(charts)],
    }
}

/// The label of shares, and what they leave out.
const SHARE: &str = "share of completed runs";

fn histogram(result: &ResultColumn, population: &Population, spread: &Spread) -> Option<Chart> {
    let histogram = spread.histogram()?;
    let mut y = histogram.density;
    // In shares of the runs: a density would have a unit of its own.
    let width = histogram.edges[1] - histogram.edges[0];
    let valued = population.with_value() as f64 / population.completed as f64;
    y.iter_mut().for_each(|density| *density *= width * valued);
    y.push(0.0);
    let curve = Curve { label: SHARE.into(), style: 1, mark: Mark::Steps, x: histogram.edges, y };
    Some(Chart {
        id: format!("{}-histogram", result.name),
        title: format!("Histogram of {}", result.name),
        note: population.counts(),
        x: quantity(&result.name, result.path.unit()),
        y: quantity(SHARE, "1"),
        from_zero: true,
        curves: vec![curve],
    })
}

fn exceedance(result: &ResultColumn, population: &Population, spread: &Spread) -> Chart {
    let n = population.completed as f64;
    let steps = spread.steps(STEPS);
    // From below the smallest value on.
    let first = [(spread.min(), 0)];
    let all = || first.iter().chain(&steps);
    let x: Vec<f64> = all().map(|(value, _)| *value).collect();
    let below = all().map(|(_, count)| *count as f64 / n).collect();
    let above = |k: usize| all().map(|(value, _)| population.above(*value)[k] as f64 / n).collect();
    let curve = |label: &str, style, y| Curve {
        label: label.into(),
        style,
        mark: Mark::Steps,
        x: x.clone(),
        y,
    };
    let note = "Share of completed runs at or below a value and above it.".to_string();
    Chart {
        id: format!("{}-distribution", result.name),
        title: format!("Distribution of {}", result.name),
        note: match population.counts() {
            counts if counts.is_empty() => note,
            counts => format!("{note} {counts}."),
        },
        x: quantity(&result.name, result.path.unit()),
        y: quantity(SHARE, "1"),
        from_zero: true,
        curves: match population.open.is_empty() {
            true => vec![curve("at or below", 1, below), curve("above", 2, above(0))],
            // Where contacts leave it open nobody knows how many are below.
            false => {
                vec![curve("above, at least", 1, above(0)), curve("above, at most", 2, above(1))]
            }
        },
    }
}

fn quantity(label: &str, unit: &str) -> Quantity {
    Quantity { label: label.into(), unit: unit.into() }
}

/// Parameters that are numbers.
fn numeric(study: &Study) -> Vec<&Parameter> {
    let all = study.parameters().iter();
    all.filter(|p| !matches!(p.variation, Variation::Words(_))).collect()
}

/// Runs by the words they take; all in one group where these are more than there are colours.
fn groups(study: &Study, table: &Table) -> Vec<Group> {
    let all = study.parameters().iter();
    let words = all.filter(|p| matches!(p.variation, Variation::Words(_)));
    let columns: Vec<&[String]> = words.filter_map(|p| table.texts(&p.name)).collect();
    let mut groups: Vec<Group> = Vec::new();
    for row in 0..table.rows() {
        let label = columns.iter().map(|c| c[row].as_str()).collect::<Vec<_>>().join(", ");
        match groups.iter_mut().find(|group| group.label == label) {
            Some(group) => group.rows.push(row),
            None => groups.push(Group { label, rows: vec![row] }),
        }
        if groups.len() > GROUPS {
            return vec![Group { label: String::new(), rows: (0..table.rows()).collect() }];
        }
    }
    groups
}
