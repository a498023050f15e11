//! The page: the template with its holes filled.

use std::fmt::Write as _;

use serde_json::Value;

use super::data::ReportData;
use super::figure::{Abscissa, Figure, Section};
use super::html::{self, escape};
use super::state::RunState;
use super::template::{fill_holes, page_parts};
use super::{advice, audit, log, payload, provenance, results, scene, warnings};
use crate::fields::Fields;

const TEMPLATE: &str = include_str!("../../web/report.html");

/// The whole page.
pub(super) fn render(data: &ReportData, figures: &[Figure]) -> String {
    let summary = &data.summary;
    let fields: Vec<(&str, &Fields)> = data.fields.iter().map(|fields| ("", fields)).collect();
    let payload = payload::pack(figures, &fields);
    let title = summary["title"].as_str().filter(|t| !t.is_empty()).unwrap_or("Percuss run");
    let fill = |hole: &str| -> String {
        match hole {
            "title" => escape(title),
            "version" => escape(summary["percuss_version"].as_str().unwrap_or("")),
            "status" => status(summary),
            "warnings" => warnings::worst(summary),
            "scene" => scene::render(data),
            "scene_scripts" => scene::SCRIPTS.join("\n"),
            "results" => results::render(summary),
            "decimation" => decimation(data, figures),
            "impact" => section(figures, Section::Impact, "Impact"),
            "log" => log::render(summary),
            "hand_formulas" => advice::hand_formulas(summary),
            "checks" => advice::checks(summary),
            "balance" => section(figures, Section::Balance, "Energy and momentum"),
            "supports" => section(figures, Section::Supports, "Reactions"),
            "forces" => section(figures, Section::Forces, "Section forces"),
            "envelopes" => envelopes(figures),
            "points" => section(figures, Section::Points, "Recorded points"),
            "audit_table" => audit::render(summary, &data.scenario),
            "audit_figures" => section(figures, Section::Audit, ""),
            "provenance" => provenance::render(summary),
            "settings" => audit::settings(summary),
            "scenario" => escape(&data.scenario),
            "index" => html::json(&payload.index),
            "data" => payload.data.clone(),
            other => page_parts(other),
        }
    };
    fill_holes(TEMPLATE, fill)
}

/// The state with the number of warnings and a link to them, and why the run stopped.
fn status(summary: &Value) -> String {
    let state = RunState::of(summary);
    let class = if summary["status"] == "completed" { "status" } else { "status warning" };
    let (words, warnings) = (escape(&state.words), link_to_warnings(&state));
    let mut out = format!("<p class=\"{class}\">{words}, {warnings}</p>\n");
    if let Some(error) = summary["error"].as_str() {
        let code =
            summary["error_code"].as_str().map_or(String::new(), |code| format!(" [{code}]"));
        let error = format!("{error}{code}");
        let _ = writeln!(out, "<p class=\"warning\" role=\"alert\">{}</p>", escape(&error));
    }
    out
}

/// A run's number of warnings in words, `4 warnings`, with a link to them.
fn link_to_warnings(state: &RunState) -> String {
    let words = escape(&state.warnings_in_words());
    match state.warnings {
        0 => words,
        _ => format!("<a href=\"#checks\">{words}</a>"),
    }
}

/// Says so where not every row is drawn.
fn decimation(data: &ReportData, figures: &[Figure]) -> String {
    let rows = data.history.rows();
    let fewest = figures
        .iter()
        .filter(|f| f.abscissa == Abscissa::Time && f.section != Section::Supports)
        .filter(|f| f.id != "restitution" && !f.id.starts_with("impulse"))
        .flat_map(|f| &f.tables)
        .map(|t| t.x.len())
        .min();
    let Some(drawn) = fewest.filter(|drawn| *drawn < rows) else { return String::new() };
    let source = match data.history.name() {
        "" => "the history",
        name => name,
    };
    let text = format!(
        "{} rows recorded. Long curves are shown as min-max envelopes ({} rows or more per figure); \
         full data in {source}.",
        grouped(rows),
        grouped(drawn),
    );
    format!("<p class=\"note\">{}</p>\n", escape(&text))
}

/// 1000001 as `1 000 001`.
fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            out.push('\u{202f}');
        }
        out.push(digit);
    }
    out
}

fn section(figures: &[Figure], section: Section, heading: &str) -> String {
    let all: Vec<&Figure> = figures.iter().filter(|f| f.section == section).collect();
    if all.is_empty() {
        return String::new();
    }
    let heading =
        if heading.is_empty() { String::new() } else { format!("<h2>{}</h2>\n", escape(heading)) };
    format!(
        "{heading}<div class=\"figures\">\n{}</div>\n",
        all.into_iter().map(frame).collect::<String>()
    )
}

/// The place of a figure, with its title.
pub(crate) fn frame(figure: &Figure) -> String {
    let (id, title) = (escape(&figure.id), escape(&figure.title));
    // Small figures have one title and one note above all of them.
    let name = match figure.group.as_str() {
        "" => title.clone(),
        group => format!("{}, {title}", escape(group)),
    };
    let note = if figure.group.is_empty() { escape(&figure.note) } else { String::new() };
    let save = |kind: &str| {
        let upper = kind.to_uppercase();
        format!(
            "<button type=\"button\" class=\"save\" data-save=\"{kind}\" aria-label=\"Save {name} as {upper}\">{upper}</button>"
        )
    };
    let saves: String = ["csv", "svg", "png"].map(save).concat();
    format!(
        "<figure data-figure=\"{id}\" aria-label=\"{name}\"><figcaption><h3>{title}</h3><span>{saves}</span>\
         <p>{note}</p></figcaption><div class=\"plot\"></div></figure>\n"
    )
}

/// Envelopes: figures of the usual size, or small ones in groups.
fn envelopes(figures: &[Figure]) -> String {
    let all: Vec<&Figure> = figures.iter().filter(|f| f.section == Section::Envelopes).collect();
    let Some(first) = all.first() else { return String::new() };
    let mut out = "<h2>Envelopes of the section forces along the beams</h2>\n".to_owned();
    if first.group.is_empty() {
        return out + &section(figures, Section::Envelopes, "");
    }
    for group in all.chunk_by(|a, b| a.group == b.group) {
        let note = match group[0].note.as_str() {
            "" => String::new(),
            note => format!(": {}", escape(note)),
        };
        let _ = writeln!(out, "<h3>{}{note}</h3>", escape(&group[0].group));
        let frames: String = group.iter().map(|f| frame(f)).collect();
        let _ = writeln!(out, "<div class=\"figures small\">\n{frames}</div>");
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_in_user_text_are_not_filled() {
        let page = fill_holes("a {{x}} b {{y}} c", |hole| match hole {
            "x" => "{{y}}".to_owned(),
            _ => "z".to_owned(),
        });
        assert_eq!(page, "a {{y}} b z c");
    }

    #[test]
    fn the_state_gives_the_time_the_warnings_and_why_a_run_stopped() {
        let of = |summary: serde_json::Value| status(&summary).replace('\u{a0}', " ");
        let warning = serde_json::json!([{ "verdict": "warning", "code": "W101", "text": "off" }]);
        assert_eq!(
            of(serde_json::json!({ "status": "completed", "time": 1.4, "warnings": warning })),
            "<p class=\"status\">Completed, t = 1.4 s, <a href=\"#checks\">1 warning</a></p>\n"
        );
        let failed = of(
            serde_json::json!({ "status": "failed", "time": 0.02, "error": "a < b", "error_code": "E101" }),
        );
        assert!(
            failed
                .starts_with("<p class=\"status warning\">Stopped (no convergence) at t = 20 ms: "),
            "{failed}"
        );
        assert!(failed.contains("step, no warnings</p>"), "{failed}");
        assert!(failed.contains("role=\"alert\">a &lt; b [E101]</p>"), "{failed}");
    }

    #[test]
    fn thousands_are_grouped() {
        assert_eq!(grouped(1_000_001), "1\u{202f}000\u{202f}001");
        assert_eq!(grouped(999), "999");
    }
}
