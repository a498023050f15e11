//! Equations: TeX to MathML, numbered and referred to by name.
//!
//! A block `math` is an equation of its own; with `eq=NAME` it has a number, and `(eq:NAME)` in the text leads to it. What stands
//! between ``$` `` and `` `$`` is part of the text.

use std::collections::BTreeMap;

use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser, Storage, push_mathml};

use crate::fences::{Part, parts};

/// The page with its equations set; what cannot be set is told. Numbers begin with `chapter`.
pub fn set(page: &str, chapter: &str) -> (String, Vec<String>) {
    let mut faults = Vec::new();
    let numbers = numbers(page, chapter);
    let mut text = String::new();
    for part in parts(page) {
        match part {
            Part::Fence(fence) if fence.language == "math" => {
                let set = mathml(&fence.text(), DisplayMode::Block, &mut faults);
                let (id, number) = match fence.value("eq") {
                    Some(name) => (format!(" id=\"eq-{name}\""), format!("({})", numbers[name])),
                    None => Default::default(),
                };
                text.push_str(&format!(
                    "<div class=\"equation\"{id}>{set}<span class=\"equation-number\">{number}</span></div>\n"
                ));
            }
            Part::Fence(fence) => text.push_str(&fence.whole()),
            Part::Line(line) => {
                let line = inline(&line, &mut faults);
                text.push_str(&(refer(&line, &numbers, &mut faults) + "\n"));
            }
        }
    }
    (text, faults)
}

fn numbers(page: &str, chapter: &str) -> BTreeMap<String, String> {
    let equations = parts(page).into_iter().filter_map(|part| match part {
        Part::Fence(fence) if fence.language == "math" => fence.value("eq").map(str::to_string),
        _ => None,
    });
    equations.enumerate().map(|(k, name)| (name, format!("{chapter}{}", k + 1))).collect()
}

/// Numbers for names of equations.
fn refer(line: &str, numbers: &BTreeMap<String, String>, faults: &mut Vec<String>) -> String {
    let mut pieces = line.split("(eq:");
    let mut out = pieces.next().unwrap_or_default().to_string();
    for piece in pieces {
        let (name, rest) = piece.split_once(')').unwrap_or((piece, ""));
        match numbers.get(name) {
            Some(number) => out.push_str(&format!("[({number})](#eq-{name}){rest}")),
            None => faults.push(format!("no equation `{name}`")),
        }
    }
    out
}

fn inline(line: &str, faults: &mut Vec<String>) -> String {
    let mut pieces = line.split("$`");
    let mut out = pieces.next().unwrap_or_default().to_string();
    for piece in pieces {
        let (tex, rest) = piece.split_once("`$").unwrap_or((piece, ""));
        out.push_str(&mathml(tex, DisplayMode::Inline, faults));
        out.push_str(rest);
    }
    out
}

fn mathml(tex: &str, display_mode: DisplayMode, faults: &mut Vec<String>) -> String {
    let storage = Storage::new();
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    let mut out = String::new();
    let done = push_mathml(&mut out, Parser::new(tex.trim(), &storage), config);
    if done.is_err() || out.contains("<merror") {
        faults.push(format!("an equation that cannot be set: {}", tex.trim()));
    }
    // A line break within would end the block of HTML.
    out.replace('\n', " ")
}
