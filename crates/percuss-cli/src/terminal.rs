//! Standard output and standard error: nothing panics when they are closed, no colour goes into a pipe, and what stands in files and
//! arguments is shown, never obeyed ([`shown`]).

use std::hash::{BuildHasher, RandomState};
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::sync::LazyLock;

use percuss_codes::{Code, FileCode};
use percuss_scenario::{visible, visible_line};

use crate::failure::Failure;

/// Where a style begins in a text on its way to the terminal: a number of this process stands in it, so that no file can hold it.
static STYLE: LazyLock<String> =
    LazyLock::new(|| format!("\u{fdd0}{:016x}", RandomState::new().hash_one("style")));
/// Where it is said.
const STYLED: char = '\u{fdd1}';

/// A text as it goes to the terminal: what a terminal would obey is written out, but for the styles of [`painted`].
fn shown(text: &str) -> String {
    let mut pieces = text.split(STYLE.as_str());
    let mut out = visible(pieces.next().unwrap_or_default());
    for piece in pieces {
        let (style, rest) = piece.split_once(STYLED).unwrap_or(("0", piece));
        out.push_str(&format!("\u{1b}[{style}m{}", visible(rest)));
    }
    out
}

/// Writes a line to standard error; if that is closed there is nobody to tell.
pub fn tell(text: &str) {
    tell_drawn(&shown(text));
}

/// The same of a text in which all that is not this program's was made visible.
pub fn tell_drawn(text: &str) {
    let mut stderr = io::stderr().lock();
    let _ = stderr.write_all(text.trim_end_matches('\n').as_bytes());
    let _ = stderr.write_all(b"\n");
}

/// Tells what is wrong, with its code.
pub fn error(code: impl Into<Code>, text: &str) {
    say_error(&code.into().behind(text));
}

/// The same of a text that has its codes.
pub fn say_error(text: &str) {
    tell(&format!("{} {text}", painted("error:", "1;31")));
}

/// Tells what deserves attention, with its code.
pub fn warning(code: impl Into<Code>, text: &str) {
    tell(&format!("{} {}", painted("warning:", "1;33"), code.into().behind(text)));
}

/// Tells what is worth knowing, with its code.
pub fn note(code: Code, text: &str) {
    tell(&format!("{} {}", painted("note:", "1;36"), code.behind(text)));
}

/// Tells what was found and is allowed, with its code.
pub fn allowed(code: Code, text: &str) {
    tell(&format!("{} {}", painted("allowed:", "1;36"), code.behind(text)));
}

/// Writes to standard output. A reader that has seen enough (`| head`) is no error.
///
/// # Errors
/// If standard output cannot be written for another reason.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    // Into files and other programs goes what was asked for, every byte of it.
    let made_visible = stdout.is_terminal().then(|| shown(text));
    let text = made_visible.as_deref().unwrap_or(text);
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            let text = format!("standard output: cannot write: {error}");
            Err(Failure::System(FileCode::System.into(), text))
        }
        _ => Ok(()),
    }
}

/// Whether standard error takes colours: a terminal, and the user has not said no.
pub fn colored() -> bool {
    let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|value| value == "dumb");
    io::stderr().is_terminal() && !refused && !dumb
}

/// Columns of the terminal that standard error is; none if it is no terminal.
pub fn width() -> Option<usize> {
    let stderr = io::stderr();
    stderr.is_terminal().then(|| {
        let size = terminal_size::terminal_size_of(&stderr);
        size.map_or(80, |(width, _)| usize::from(width.0).clamp(40, 120))
    })
}

/// `text` in an ANSI style where standard error takes colours.
pub fn painted(text: &str, style: &str) -> String {
    let text = visible_line(text);
    let begin = |style| format!("{}{style}{STYLED}", *STYLE);
    if colored() { format!("{}{text}{}", begin(style), begin("0")) } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn styles_are_this_program_s_alone() {
        let own = format!("{}1;31{STYLED}error:{}0{STYLED} x", *STYLE, *STYLE);
        assert_eq!(shown(&own), "\u{1b}[1;31merror:\u{1b}[0m x");
        assert_eq!(shown("\u{1b}[8mhidden"), "\\u{1b}[8mhidden");
        assert_eq!(shown("\u{fdd0}0\u{fdd1}"), "\\u{fdd0}0\\u{fdd1}");
    }
}
