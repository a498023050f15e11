//! What stands in the way of a command, and the exit status that goes with it.

use std::path::Path;
use std::process::ExitCode;

use percuss_codes::{Code, FileCode};
use percuss_scenario::Diagnostics;

/// Exit status.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Done.
    Done,
    /// The system refused: disk full, no permission.
    System,
    /// The input is wrong.
    Input,
    /// No convergence, or a verification case does not hold.
    GaveUp,
    /// A balance error above its limit (`--strict`).
    BalanceOpen,
    /// Interrupted.
    Interrupted,
}

impl Status {
    /// The number the shell sees.
    pub fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::System => 1,
            Self::Input => 2,
            Self::GaveUp => 3,
            Self::BalanceOpen => 4,
            Self::Interrupted => 130,
        }
    }
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        status.code().into()
    }
}

/// What stood in the way of a command.
#[derive(Debug)]
pub enum Failure {
    /// Faults of a scenario file.
    Faults {
        /// All of them.
        faults: Box<Diagnostics>,
        /// Whether `--set` changed the file, so that lines may have moved.
        changed: bool,
    },
    /// Warnings that are denied, shape (warnings).
    Denied(Vec<String>),
    /// The input is wrong.
    Input(Code, String),
    /// The system refused.
    System(Code, String),
}

impl Failure {
    /// The input is wrong.
    pub fn input(code: impl Into<Code>, text: impl Into<String>) -> Self {
        Self::Input(code.into(), text.into())
    }

    /// The system refused to do something with a file.
    pub fn system(path: &Path, doing: &str, error: &std::io::Error) -> Self {
        let text = format!("{}: cannot {doing}: {error}", path.display());
        Self::System(FileCode::System.into(), text)
    }

    /// The exit status that goes with it.
    pub fn status(&self) -> Status {
        match self {
            Self::Faults { .. } | Self::Denied(_) | Self::Input(..) => Status::Input,
            Self::System(..) => Status::System,
        }
    }
}

impl From<percuss_output::Error> for Failure {
    fn from(error: percuss_output::Error) -> Self {
        let (code, text) = (error.code().into(), error.to_string());
        match error.is_refused() || error.is_content() {
            true => Self::Input(code, text),
            false => Self::System(code, text),
        }
    }
}

impl From<percuss_pictures::Error> for Failure {
    fn from(error: percuss_pictures::Error) -> Self {
        match error.is_input() {
            true => Self::Input(error.code(), error.to_string()),
            false => Self::System(error.code(), error.to_string()),
        }
    }
}

impl From<percuss_study::Error> for Failure {
    fn from(error: percuss_study::Error) -> Self {
        match error.is_unfit() {
            true => Self::Input(error.code(), error.to_string()),
            false => Self::System(error.code(), error.to_string()),
        }
    }
}

impl From<Diagnostics> for Failure {
    fn from(faults: Diagnostics) -> Self {
        Self::Faults { faults: Box::new(faults), changed: false }
    }
}
