//! Pages of the verification manual, one a case.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use percuss_verification::{Check, Tolerance};

use super::done::{Done, verdict};
use super::figure::{drawn, sketch};
use super::table::{cells, share_used};
use crate::outcome::Failure;
use crate::replacing;

/// Checks of a case that its figure shows.
const SHOWN: usize = 40;
/// Height of a bar with its gap in a figure.
const ROW: usize = 18;
/// Shares of the tolerance below this one are all drawn as it.
const LEAST: f64 = 1e-8;

/// Writes an index and a page and a figure a case into a folder.
///
/// # Errors
/// A file that cannot be written.
pub(super) fn write(folder: &Path, all: &[Done]) -> Result<(), Failure> {
    let made = fs::create_dir_all(folder);
    made.map_err(|error| Failure::system(folder, "create", &error))?;
    put(&folder.join("index.md"), index(all))?;
    for done in all {
        put(&folder.join(format!("{}.svg", done.case.id)), bars(&done.checks))?;
        for (k, figure) in done.report.figures.iter().enumerate() {
            let name = format!("{}-figure-{}.svg", done.case.id, k + 1);
            put(&folder.join(name), drawn(figure))?;
        }
        for (name, text) in &done.report.files {
            if let Some(svg) = sketch(text, name) {
                put(&folder.join(sketch_name(done.case.id, name)), svg)?;
            }
        }
        put(&folder.join(format!("{}.md", done.case.id)), page(folder, done))?;
    }
    Ok(())
}

/// Writes a page or figure in place of an earlier one.
fn put(file: &Path, text: impl AsRef<[u8]>) -> Result<(), Failure> {
    replacing::put(file, text.as_ref(), &|_| true)
}

fn index(all: &[Done]) -> String {
    let mut text = String::from(
        "# Verification manual\n\nEach case compares Percuss with numbers that were not computed by it: closed forms, published figures, independent \
         programs, conservation laws. These pages were written by `percuss verify --book DIR`, which ran every case; `percuss verify ID` runs one.\n\n",
    );
    let _ = writeln!(text, "{}.\n", verdict(all));
    text.push_str("| case | what is verified | expected from | checks | tolerance used |\n|---|---|---|---|---|\n");
    for done in all {
        let used = done.checks.iter().map(share_used).fold(0.0, f64::max);
        let (id, title, source) = (done.case.id, done.case.title, done.case.source);
        let (title, source) = (escaped(title), escaped(source));
        let count = done.checks.len();
        let holds = if done.holds() { "" } else { ", fails" };
        let _ = writeln!(
            text,
            "| [{id}]({id}.md) | {title} | {source} | {count}{holds} | {:.0} % |",
            100.0 * used
        );
    }
    text.push_str(
        "\n*Tolerance used* is the share of its tolerance that the worst check of a case takes.\n",
    );
    text
}

fn sketch_name(id: &str, file: &str) -> String {
    format!("{id}-{file}-sketch.svg")
}

/// The page of a case whose figures and sketches are in the folder.
fn page(folder: &Path, done: &Done) -> String {
    let case = done.case;
    let mut text = format!("# {}\n\n{}.\n\n", case.id, escaped(case.title));
    let _ = writeln!(text, "**Expected from:** {}.\n", escaped(case.source));
    let _ = writeln!(
        text,
        "**Run it:** `percuss verify {} --all-checks` ({:.1} s here).\n",
        case.id, done.seconds
    );
    for (file, contents) in &done.report.files {
        let sketch = sketch_name(case.id, file);
        if folder.join(&sketch).exists() {
            let _ = writeln!(text, "![The scene at its start]({sketch})\n");
        }
        let _ = writeln!(
            text,
            "<details><summary>The scenario, <code>{file}.toml</code></summary>\n\n```toml\n{}\n```\n\n</details>\n",
            contents.trim_end()
        );
    }
    for (k, figure) in done.report.figures.iter().enumerate() {
        let _ = writeln!(text, "![{}]({}-figure-{}.svg)\n", figure.title, case.id, k + 1);
    }
    let holds = if done.holds() { "All checks hold." } else { "**Not all checks hold.**" };
    let _ = writeln!(
        text,
        "{holds}\n\n| quantity | measured | expected | deviation | tolerance |\n|---|---|---|---|---|"
    );
    for check in &done.checks {
        let [_, _, quantity, measured, expected, deviation, tolerance] = cells(case.id, check, "");
        let quantity = escaped(&quantity);
        let _ =
            writeln!(text, "| {quantity} | {measured} | {expected} | {deviation} | {tolerance} |");
    }
    let _ = writeln!(text, "\n![How much of its tolerance each check takes]({}.svg)\n", case.id);
    text.push_str("*Figure:* how much of its tolerance each check takes, in powers of ten; the line at the right is the tolerance itself.\n");
    text
}

/// Bars on a logarithmic axis, a check each.
fn bars(checks: &[Check]) -> String {
    let shown = &checks[..checks.len().min(SHOWN)];
    let (label, width) = (330.0, 300.0);
    let height = ROW * shown.len() + 30;
    let at = |share: f64| label + width * (1.0 - share.clamp(LEAST, 1.0).log10() / LEAST.log10());
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 660 {height}\" width=\"660\" height=\"{height}\" font-family=\"sans-serif\" \
         font-size=\"11\"><rect width=\"660\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    for power in (0..=8).step_by(2) {
        let x = at(10f64.powi(-power));
        let colour = if power == 0 { "#b02020" } else { "#d0d0d0" };
        let name = if power == 0 { "1".to_string() } else { format!("1e-{power}") };
        let (end, below) = (height - 22, height - 8);
        let _ = writeln!(
            text,
            "<line x1=\"{x:.1}\" y1=\"4\" x2=\"{x:.1}\" y2=\"{end}\" stroke=\"{colour}\"/><text x=\"{x:.1}\" y=\"{below}\" text-anchor=\"middle\" \
             fill=\"#404040\">{name}</text>"
        );
    }
    for (k, check) in shown.iter().enumerate() {
        let (y, x) = (ROW * k + 6, at(share(check)));
        let bar = x - label;
        let words: String = check.quantity.chars().take(52).collect();
        let words = words.replace('&', "&amp;").replace('<', "&lt;");
        let _ = writeln!(
            text,
            "<text x=\"{:.1}\" y=\"{}\" text-anchor=\"end\" fill=\"#202020\">{words}</text><rect x=\"{label}\" y=\"{y}\" width=\"{bar:.1}\" height=\"12\" \
             fill=\"#3a6ea5\"/>",
            label - 6.0,
            y + 10
        );
    }
    text + "</svg>\n"
}

fn share(check: &Check) -> f64 {
    match check.tolerance {
        Tolerance::AtLeast if check.measured == 0.0 => 1.0,
        _ => share_used(check),
    }
}

fn escaped(text: &str) -> String {
    text.replace('|', "\\|")
        .replace('<', "&lt;")
        .replace('*', "\\*")
        .replace('[', "\\[")
        .replace(']', "\\]")
}
