//! Standard output and standard error: nothing panics when they are closed, no colour goes into a pipe.

use std::io::{self, ErrorKind, IsTerminal, Write};

use percuss_codes::{Code, FileCode};

use crate::outcome::Failure;

/// Writes a line to standard error; if that is closed there is nobody to tell.
pub fn tell(text: &str) {
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
    if colored() { format!("\u{1b}[{style}m{text}\u{1b}[0m") } else { text.to_owned() }
}
