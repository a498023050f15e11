//! How a command ends: the exit status and what is said when something stood in the way.

use percuss_codes::RequestCode;
use percuss_output::shown::FINDINGS;
use percuss_scenario::Diagnostics;

pub use crate::failure::{Failure, Status};
use crate::terminal;

impl Failure {
    /// Says what is wrong: faults underlined on a terminal, one line each elsewhere.
    pub fn tell(&self) {
        match self {
            Self::Faults { faults, changed } => {
                let (faults, rest) = Diagnostics::clone(faults).first(FINDINGS);
                let in_the_file = faults.all().iter().any(|one| one.line > 0);
                match terminal::width() {
                    Some(width) if in_the_file => {
                        terminal::tell_drawn(&faults.fancy(terminal::colored(), width));
                    }
                    Some(_) => terminal::say_error(&faults.coded()),
                    None => terminal::tell(&faults.coded()),
                }
                if rest > 0 {
                    terminal::tell(&format!("and {rest} more errors"));
                }
                if *changed && in_the_file {
                    terminal::tell(
                        "(line numbers refer to the file with the --set changes applied)",
                    );
                }
            }
            Self::Denied(all) => {
                all.iter().take(FINDINGS).for_each(|one| terminal::error(RequestCode::Denied, one));
                if let rest @ 1.. = all.len().saturating_sub(FINDINGS) {
                    terminal::tell(&format!("and {rest} more denied warnings"));
                }
            }
            Self::Input(code, text) | Self::System(code, text) => terminal::error(*code, text),
        }
    }
}
