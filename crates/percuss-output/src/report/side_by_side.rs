//! Several runs on one page: their scenes over each other, each curve once a run, key results in one table.

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::{Map, Value};

use super::data::ReportData;
use super::figure::{Axis, Figure, Section, Series, Shape, Table, largest};
use super::figures;
use super::html::{self, escape, table};
use super::page::frame;
use super::quantity::{Scale, number, quantity, without_round_off};
use super::state::RunState;
use super::template::{fill_holes, page_parts};
use super::{payload, scene, story};
use crate::error::Error;
use crate::fields::Fields;
use crate::files;

const TEMPLATE: &str = include_str!("../../web/comparison.html");
/// What a page of ours begins with, within its first bytes.
pub const MARK: &str = "<meta name=\"generator\" content=\"percuss comparison\">";
/// Runs on a page: as many as there are distinct colours.
pub const MOST_RUNS: usize = 8;
/// Colours of the runs, by their number.
const STYLES: [usize; MOST_RUNS] = [0, 1, 2, 3, 4, 5, 6, 8];
/// Curves that get a figure.
const MOST_FIGURES: usize = 60;

/// Placeholder in the path of a result for `min` or `max`, whichever is of larger magnitude.
const LARGEST: &str = "largest";

/// A run and what it is called on the page.
pub struct Named {
    /// Unique among the runs.
    pub name: String,
    /// What was read of it.
    pub data: ReportData,
}

/// Writes the page, whole or not at all.
///
/// # Errors
/// If a history cannot be read or the file not be written.
pub fn write(file: &Path, runs: &[Named]) -> Result<(), Error> {
    files::write(file, render(runs)?.as_bytes())
}

/// The page.
///
/// # Errors
/// If a history cannot be read.
pub fn render(runs: &[Named]) -> Result<String, Error> {
    let figures = figures_of(runs)?;
    let scenes: Vec<(&str, &Fields)> = runs
        .iter()
        .filter_map(|run| Some((run.name.as_str(), run.data.fields.as_ref()?)))
        .filter(|(_, fields)| !fields.frames.is_empty())
        .collect();
    let payload = payload::pack(&figures, &scenes);
    let names: Vec<&str> = runs.iter().map(|run| run.name.as_str()).collect();
    let missing = runs.len() - scenes.len();
    let lead = match (scenes.is_empty(), missing) {
        (true, _) => "None of these runs recorded shapes (record.shapes).".to_owned(),
        (_, 0) => "Overlay at equal time.".to_owned(),
        (_, n) => {
            format!("Overlay at equal time; {n} of the runs recorded no shapes.")
        }
    };
    Ok(fill_holes(TEMPLATE, |hole| match hole {
        "title" => escape(&format!("Comparison of {}", names.join(", "))),
        "status" => escape(&format!(
            "{} runs. Differences are relative to run '{}', of absolute values.",
            runs.len(),
            names[0]
        )),
        "scene" if scenes.is_empty() => format!("<p class=\"story\">{}</p>\n", escape(&lead)),
        "scene" => scene::section(&lead, scene::instant(&runs[0].data.summary)),
        "scene_scripts" => scene::SCRIPTS.join("\n"),
        "results" => results(runs),
        "figures" => figures.iter().map(frame).collect(),
        "stories" => stories(runs),
        "version" => env!("CARGO_PKG_VERSION").to_owned(),
        "index" => html::json(&payload.index),
        "data" => payload.data.clone(),
        other => page_parts(other),
    }))
}

fn stories(runs: &[Named]) -> String {
    let one = |run: &Named| {
        let summary = &run.data.summary;
        let (name, text) = (escape(&run.name), escape(&story::story(summary)));
        format!(
            "<h3>{name}</h3>\n<p class=\"status\">{}</p>\n<p>{text}</p>\n",
            escape(&RunState::of(summary).words)
        )
    };
    runs.iter().map(one).collect()
}

/// A figure for each curve that some run has, with a curve a run.
fn figures_of(runs: &[Named]) -> Result<Vec<Figure>, Error> {
    let each: Vec<Vec<Figure>> =
        runs.iter().map(|run| figures::all(&run.data)).collect::<Result<_, _>>()?;
    let mut seen = BTreeSet::new();
    let mut out = Vec::new();
    for figure in
        each.iter().flatten().filter(|f| f.scaled.is_some() && f.section != Section::Audit)
    {
        for series in figure.tables.iter().flat_map(|t| &t.series) {
            // A curve may be in another figure in another run, where sizes differ.
            let id = (
                figure.id.trim_end_matches(|c: char| c == '-' || c.is_ascii_digit()),
                &series.label,
            );
            let is_part = series.shape == Shape::Area;
            if is_part || out.len() == MOST_FIGURES || !seen.insert((id.0.to_owned(), id.1.clone()))
            {
                continue;
            }
            out.extend(overlaid(runs, &each, figure, &series.label));
        }
    }
    Ok(out)
}

/// The curve of this label in all runs.
fn overlaid(runs: &[Named], each: &[Vec<Figure>], like: &Figure, label: &str) -> Option<Figure> {
    let stem = |id: &str| id.trim_end_matches(|c: char| c == '-' || c.is_ascii_digit()).to_owned();
    let found: Vec<(usize, Vec<f64>, Vec<f64>)> = each
        .iter()
        .enumerate()
        .filter_map(|(k, figures)| {
            let is_it = |f: &&Figure| stem(&f.id) == stem(&like.id) && f.scaled.is_some();
            let of = |f: &Figure| {
                let scaled = f.scaled?;
                let table = f.tables.first()?;
                let series =
                    table.series.iter().find(|s| s.label == label && s.shape == Shape::Line)?;
                let back = |values: &[f64], by: f64| values.iter().map(|v| v / by).collect();
                let [x, y] = scaled.factors;
                Some((k, back(&table.x, x), back(&series.y, y)))
            };
            figures.iter().filter(is_it).find_map(of)
        })
        .collect();
    let scaled = like.scaled?;
    let x_scale = Scale::new(largest(found.iter().flat_map(|(_, x, _)| x)), "s");
    let y_scale = Scale::new(largest(found.iter().flat_map(|(_, _, y)| y)), scaled.unit);
    let times = |values: &[f64], by: f64| values.iter().map(|v| v * by).collect::<Vec<f64>>();
    let curve = |(k, x, y): &(usize, Vec<f64>, Vec<f64>)| Table {
        x: times(x, x_scale.factor),
        series: vec![Series {
            label: runs[*k].name.clone(),
            style: STYLES[*k],
            weight: 1.0,
            dashed: false,
            shape: Shape::Line,
            y: times(y, y_scale.factor),
        }],
    };
    let caption = like.y.label.split(" along ").next().unwrap_or(&like.y.label);
    let axis = Axis { label: "time".to_owned(), unit: x_scale.unit.clone() };
    let base = like.title.split(", ").next().unwrap_or(&like.title);
    let title = if label == caption { like.title.clone() } else { format!("{base}: {label}") };
    let id = format!("{}: {label}", like.id);
    let mut figure = Figure::new(Section::Impact, &id, &title, axis, caption);
    figure.y.unit.clone_from(&y_scale.unit);
    figure.tables = found.iter().map(curve).collect();
    Some(figure)
}

/// A result that runs are compared by.
struct KeyResult {
    label: String,
    /// Path in the summary.
    pointer: String,
    unit: &'static str,
}

/// Rows of key results: a column a run, and the difference from the first.
fn results(runs: &[Named]) -> String {
    let mut rows: Vec<KeyResult> = Vec::new();
    for run in runs {
        for row in key_results(&run.data.summary) {
            if !rows.iter().any(|known| known.pointer == row.pointer) {
                rows.push(row);
            }
        }
    }
    let mut header = vec!["result".to_owned()];
    for (k, run) in runs.iter().enumerate() {
        header.push(run.name.clone());
        header.extend((k > 0).then(|| "difference".to_owned()));
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let shown: Vec<Vec<String>> =
        rows.iter().filter_map(|row| cells(row, scale(row, &rows, runs), runs)).collect();
    table("Results of each run", &header, &shown)
}

/// Size beside which a result is round-off: the largest of this unit and of what it belongs to, in any run.
fn scale(row: &KeyResult, rows: &[KeyResult], runs: &[Named]) -> f64 {
    let owner = |row: &KeyResult| row.pointer.split('/').nth(2).unwrap_or_default().to_owned();
    let alike = rows.iter().filter(|other| other.unit == row.unit && owner(other) == owner(row));
    let values = alike.flat_map(|other| {
        runs.iter().filter_map(|run| value_at(&run.data.summary, &other.pointer))
    });
    largest(&values.collect::<Vec<f64>>())
}

/// The result at a path.
fn value_at(summary: &Value, pointer: &str) -> Option<f64> {
    let of = |end: &str| {
        summary.pointer(&pointer.replace(&format!("/{LARGEST}/"), &format!("/{end}/")))?.as_f64()
    };
    match (of("min"), of("max")) {
        (Some(least), Some(most)) if least.abs() > most.abs() => Some(least),
        (least, most) => most.or(least),
    }
}

fn cells(row: &KeyResult, scale: f64, runs: &[Named]) -> Option<Vec<String>> {
    let shown = |v: f64| without_round_off(v, scale);
    let value = |run: &Named| value_at(&run.data.summary, &row.pointer).map(shown);
    let values: Vec<Option<f64>> = runs.iter().map(value).collect();
    let mut cells = vec![row.label.clone()];
    let mut any = false;
    for (k, value) in values.iter().enumerate() {
        any |= value.is_some();
        cells.push(quantity(*value, row.unit));
        if k > 0 {
            cells.push(difference(values[0], *value));
        }
    }
    any.then_some(cells)
}

/// Of the absolute values, in percent of the first; none where the first is zero or missing.
fn difference(first: Option<f64>, value: Option<f64>) -> String {
    let (Some(first), Some(value)) = (first, value) else { return "\u{2013}".to_owned() };
    if first == value {
        return "none".to_owned();
    }
    let percent = 100.0 * (value.abs() - first.abs()) / first.abs();
    if !percent.is_finite() {
        return "\u{2013}".to_owned();
    }
    let turned = if first * value < 0.0 { ", opposite sign" } else { "" };
    let plus = if percent > 0.0 { "+" } else { "" };
    format!("{plus}{}\u{a0}%{turned}", number(rounded(percent)))
}

/// Three digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// Results that a reader looks for first.
fn key_results(summary: &Value) -> Vec<KeyResult> {
    let mut rows = Vec::new();
    let mut row =
        |label: String, pointer: String, unit| rows.push(KeyResult { label, pointer, unit });
    let empty = Map::new();
    let named = |part: &str| {
        summary[part].as_object().unwrap_or(&empty).keys().map(|n| (n, key(n))).collect::<Vec<_>>()
    };
    for (name, key) in named("contact") {
        row(format!("peak contact force, {name}"), format!("/contact/{key}/peak_force/value"), "N");
        row(
            format!("time of peak contact force, {name}"),
            format!("/contact/{key}/peak_force/time"),
            "s",
        );
        row(format!("total impulse, {name}"), format!("/contact/{key}/impulse_total"), "N*s");
        row(format!("impacts, {name}"), format!("/contact/{key}/impact_count"), "1");
        let pressed = format!("/contact/{key}/permanent_penetration");
        row(format!("permanent indentation, {name}"), pressed, "m");
        let slid = format!("/contact/{key}/sliding_distance");
        row(format!("sliding distance, {name}"), slid, "m");
        row(format!("friction work, {name}"), format!("/contact/{key}/friction_work"), "J");
        let equivalent = format!("/contact/{key}/equivalent_force/moment");
        row(format!("equivalent static force by moment, {name}"), equivalent, "N");
    }
    for (name, key) in named("projectile") {
        for (k, axis) in [(0, "x"), (1, "y")] {
            row(
                format!("final velocity along {axis}, {name}"),
                format!("/projectile/{key}/velocity_final/{k}"),
                "m/s",
            );
        }
        row(
            format!("momentum transferred to the structure, {name}"),
            format!("/projectile/{key}/momentum_transferred"),
            "kg*m/s",
        );
        row(format!("energy transferred, {name}"), format!("/projectile/{key}/energy_given"), "J");
        row(
            format!("energy received by the structure, {name}"),
            format!("/projectile/{key}/energy_received_by_others"),
            "J",
        );
    }
    for (name, key) in named("point") {
        for (k, axis) in [(1, "x"), (2, "y")] {
            row(
                format!("largest displacement along {axis}, {name}"),
                format!("/point/{key}/displacement_max/component_{k}/value"),
                "m",
            );
        }
    }
    beam_rows(summary, &mut row);
    balance_rows(&mut row);
    rows
}

/// Section forces of beams, and what yielding left of them.
fn beam_rows(summary: &Value, row: &mut impl FnMut(String, String, &'static str)) {
    let names = |part: &str| -> Vec<(String, String)> {
        let all = summary[part].as_object().into_iter().flat_map(|all| all.keys());
        all.map(|name| (name.clone(), key(name))).collect()
    };
    // Of the largest and the smallest stress the one of larger magnitude.
    let stress = format!("stress/{LARGEST}/value");
    for (name, key) in names("section_forces") {
        for (label, what, unit) in [
            ("largest moment", "moment_max/value", "N*m"),
            ("largest axial force", "axial_max/value", "N"),
            ("largest stress", stress.as_str(), "Pa"),
        ] {
            row(format!("{label}, {name}"), format!("/section_forces/{key}/{what}"), unit);
        }
    }
    for (name, key) in names("plastic") {
        for (label, what, unit) in [
            ("largest plastic strain", "strain_max", "1"),
            ("largest plastic hinge rotation", "rotation", "rad"),
            ("permanent deflection", "permanent_set", "m"),
        ] {
            row(format!("{label}, {name}"), format!("/plastic/{key}/{what}"), unit);
        }
    }
}

/// Where the energy went, the balance error, and what the run cost.
fn balance_rows(row: &mut impl FnMut(String, String, &'static str)) {
    for (label, pointer) in [
        ("energy lost in impacts and friction", "/energy/loss_impacts"),
        ("energy dissipated by plastic flow", "/energy/plastic"),
        ("energy dissipated by damping and in contacts", "/energy/loss_damping"),
        ("part of it dissipated in contacts", "/energy/loss_contacts"),
    ] {
        row(label.to_owned(), pointer.to_owned(), "J");
    }
    for (label, pointer, unit) in [
        ("energy residual, relative", "/energy/residual_max", "1"),
        ("steps", "/steps", "1"),
        ("wall time", "/wall_seconds", "s"),
    ] {
        row(label.to_owned(), pointer.to_owned(), unit);
    }
}

/// A name as JSON pointers spell it.
fn key(name: &str) -> String {
    name.replace('~', "~0").replace('/', "~1")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strut is stressed by -120.7 MPa and by nothing else.
    #[test]
    fn the_largest_stress_is_that_of_largest_magnitude() {
        let stress = |least: f64, most: f64| {
            let range = serde_json::json!({ "min": { "value": least }, "max": { "value": most } });
            let summary = serde_json::json!({ "section_forces": { "b": { "stress": range } } });
            let rows = key_results(&summary);
            let row = rows.iter().find(|row| row.label == "largest stress, b").unwrap();
            value_at(&summary, &row.pointer)
        };
        assert_eq!(stress(-120.7e6, 0.0), Some(-120.7e6));
        assert_eq!(stress(-1.0, 2.0), Some(2.0));
        assert_eq!(stress(f64::NAN, f64::NAN), None);
    }

    #[test]
    fn differences_are_relative_and_of_absolute_values() {
        let shown = |a: f64, b: f64| difference(Some(a), Some(b)).replace('\u{a0}', " ");
        assert_eq!(shown(-5.0, -6.0), "+20 %");
        assert_eq!(shown(4.0, -3.0), "-25 %, opposite sign");
        assert_eq!(shown(4.0, 4.0), "none");
        assert_eq!(shown(0.0, 1.0), "\u{2013}");
        assert_eq!(difference(None, Some(1.0)), "\u{2013}");
    }
}
