//! Pages whose commands are run: what they print stands in the page.
//!
//! A block `toml,file=NAME` is a file of the reader's. In a block `console` lines that begin with `$ ` are run; the lines behind them
//! must be printed in this order (`...` stands for any), and where there are none, what is printed takes their place. Marks: `fails` (the
//! last command fails), `slow` (not run with [`Effort::Quick`]), `quiet` (what it prints is not shown), `lines=12` (at most so many are).
//! A comment `<!-- $ ... -->` is run and not shown.

use std::io;

use crate::fences::{Fence, Part, parts};
use crate::sandbox::Sandbox;

/// How much of a page is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// All but what takes long.
    Quick,
    /// Everything.
    All,
}

/// Lines of output that are shown.
const SHOWN: usize = 40;

/// Runs a page; its text as it is shown, and what went otherwise than the page says.
///
/// # Errors
/// A file that cannot be written, or no shell.
pub fn run(page: &str, sandbox: &Sandbox, effort: Effort) -> io::Result<(String, Vec<String>)> {
    let (mut text, mut faults) = (String::new(), Vec::new());
    for part in parts(page) {
        match part {
            Part::Line(line) => match hidden(&line) {
                Some(command) => {
                    let outcome = sandbox.run(command)?;
                    if !outcome.success {
                        faults.push(format!("`{command}` fails:\n{}", outcome.text));
                    }
                }
                None => text.push_str(&(line + "\n")),
            },
            Part::Fence(fence) if fence.language == "console" => {
                text.push_str(&console(&fence, sandbox, effort, &mut faults)?);
            }
            Part::Fence(fence) if fence.language == "math" => text.push_str(&fence.whole()),
            Part::Fence(fence) => {
                if let Some(name) = fence.value("file") {
                    sandbox.put(name, &fence.text())?;
                }
                text.push_str(&fence.plain());
            }
        }
    }
    Ok((text, faults))
}

fn hidden(line: &str) -> Option<&str> {
    line.trim().strip_prefix("<!-- $ ")?.strip_suffix(" -->")
}

/// Runs the commands of a block; the block as it is shown.
fn console(
    fence: &Fence,
    sandbox: &Sandbox,
    effort: Effort,
    faults: &mut Vec<String>,
) -> io::Result<String> {
    if fence.has("norun") || (fence.has("slow") && effort == Effort::Quick) {
        return Ok(fence.plain());
    }
    let mut lines = Vec::new();
    let mut rest = fence.lines.as_slice();
    while let Some((first, behind)) = rest.split_first() {
        let Some(mut command) = first.strip_prefix("$ ").map(str::to_string) else {
            faults.push(format!("`{first}` is no command"));
            break;
        };
        lines.push(first.clone());
        let mut behind = behind;
        while let Some((more, further)) = behind.split_first()
            && command.ends_with('\\')
        {
            lines.push(more.clone());
            command = format!("{command}\n{}", more.trim_start_matches("> "));
            behind = further;
        }
        let expected = behind.iter().take_while(|line| !line.starts_with("$ ")).count();
        let (expected, further) = behind.split_at(expected);
        let outcome = sandbox.run(&command)?;
        let wanted = !(fence.has("fails") && further.is_empty());
        if outcome.success != wanted {
            let how = if wanted { "fails" } else { "succeeds" };
            faults.push(format!("`{command}` {how}:\n{}", outcome.text));
        }
        faults.extend(unlike(&command, expected, &outcome.text));
        match expected {
            [] if fence.has("quiet") => {}
            [] => lines.extend(shortened(&outcome.text, fence)),
            _ => lines.extend(expected.iter().cloned()),
        }
        rest = further;
    }
    Ok(Fence { lines, ..fence.clone() }.plain())
}

fn shortened(text: &str, fence: &Fence) -> Vec<String> {
    let most = fence.value("lines").and_then(|n| n.parse().ok()).unwrap_or(SHOWN);
    let mut lines: Vec<String> = text.lines().map(|line| line.trim_end().to_string()).collect();
    if lines.len() > most {
        lines.truncate(most);
        lines.push("...".into());
    }
    lines
}

/// The first line that is expected and not printed after those before it.
fn unlike(command: &str, expected: &[String], printed: &str) -> Option<String> {
    let mut printed_lines = printed.lines();
    let lines = expected.iter().map(|line| line.trim_end()).filter(|line| *line != "...");
    let mut wanted = lines.filter(|line| !line.is_empty());
    let missing = wanted.find(|line| !printed_lines.any(|one| one.trim_end() == *line))?;
    Some(format!("`{command}` does not print `{missing}`, but:\n{printed}"))
}
