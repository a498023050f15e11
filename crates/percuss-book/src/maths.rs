//! Equations: TeX to MathML, numbered and referred to by name.
//!
//! A block `math` is an equation of its own; with `eq=NAME` it has a number, and `(eq:NAME)` in the text leads to it. What stands
//! between ``$` `` and `` `$`` is part of the text.

use std::collections::BTreeMap;

use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser, Storage, push_mathml};

use crate::fences::{Part, parts};

/// The page with its equations set; what cannot be set is reported. Numbers begin with `chapter`.
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
                for span in spans(&line) {
                    match span {
                        Span::Text(words) => text.push_str(&refer(words, &numbers, &mut faults)),
                        Span::Code("`$`") => {
                            faults.push("an equation is written between $` and `$".into());
                        }
                        Span::Code(code) => text.push_str(code),
                        Span::Maths(tex) => {
                            text.push_str(&mathml(tex, DisplayMode::Inline, &mut faults));
                        }
                        Span::Unclosed(rest) => {
                            faults.push(format!("an equation that is not closed: {rest}"));
                        }
                    }
                }
                text.push('\n');
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

/// A part of a line.
#[derive(Debug, PartialEq, Eq)]
enum Span<'l> {
    /// Words.
    Text(&'l str),
    /// A span of code with its backticks.
    Code(&'l str),
    /// TeX.
    Maths(&'l str),
    /// What follows the beginning of an equation without end.
    Unclosed(&'l str),
}

/// The parts of a line: equations are not looked for in code.
fn spans(line: &str) -> Vec<Span<'_>> {
    let mut spans = Vec::new();
    let mut rest = line;
    while let Some(at) = rest.find('`') {
        let begins = rest[..at].ends_with('$');
        let words = &rest[..if begins { at - 1 } else { at }];
        if !words.is_empty() {
            spans.push(Span::Text(words));
        }
        let ticks = rest[at..].len() - rest[at..].trim_start_matches('`').len();
        let inside = &rest[at + ticks..];
        if begins {
            let Some((tex, behind)) = rest[at + 1..].split_once("`$") else {
                spans.push(Span::Unclosed(&rest[at + 1..]));
                return spans;
            };
            spans.push(Span::Maths(tex));
            rest = behind;
        } else if let Some(end) = inside.find(&"`".repeat(ticks)) {
            let whole = at + ticks + end + ticks;
            spans.push(Span::Code(&rest[at..whole]));
            rest = &rest[whole..];
        } else {
            spans.push(Span::Code(&rest[at..]));
            return spans;
        }
    }
    if !rest.is_empty() {
        spans.push(Span::Text(rest));
    }
    spans
}

fn mathml(tex: &str, display_mode: DisplayMode, faults: &mut Vec<String>) -> String {
    let storage = Storage::new();
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    let mut out = String::new();
    let done = push_mathml(&mut out, Parser::new(tex.trim(), &storage), config);
    if done.is_err() || out.contains("<merror") {
        faults.push(format!("an equation that cannot be set: {}", tex.trim()));
    }
    // A line break within would end the block of HTML, a bar a cell of a table, and a sign of inequality is no start of a tag.
    out.replace('\n', " ").replace('|', "&#124;").replace("<mo><</mo>", "<mo>&lt;</mo>")
}

#[cfg(test)]
mod tests {
    use super::{Span, set, spans};

    #[test]
    fn equations_stand_in_the_text_and_not_in_code() {
        let line = "let $`x`$ be `a` or ``$`y`$``, $`z`$.";
        let wanted = [
            Span::Text("let "),
            Span::Maths("x"),
            Span::Text(" be "),
            Span::Code("`a`"),
            Span::Text(" or "),
            Span::Code("``$`y`$``"),
            Span::Text(", "),
            Span::Maths("z"),
            Span::Text("."),
        ];
        assert_eq!(spans(line), wanted);
    }

    #[test]
    fn inequalities_and_bars_are_escaped() {
        for text in ["Where $`a < |b|`$.", "```math,eq=less\na < |b|\n```\n"] {
            let (out, faults) = set(text, "1");
            assert!(faults.is_empty(), "{faults:?}");
            assert!(out.contains("<mo>&lt;</mo>") && !out.contains("<mo><</mo>"), "{out}");
            assert!(out.contains("&#124;") && !out.contains('|'), "{out}");
        }
    }

    #[test]
    fn an_equation_without_end_is_a_fault() {
        assert_eq!(set("Take $`x and go on.", "").1.len(), 1);
        // Marks with a backtick too many would set the words between two equations.
        assert_eq!(set("`$`x`$` is given", "").1.len(), 2);
    }
}
