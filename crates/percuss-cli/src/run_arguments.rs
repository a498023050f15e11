//! Arguments of the commands that simulate one scenario: `run` and `extend`.

use std::path::PathBuf;

use clap::{Args, ValueEnum, ValueHint};

use percuss_codes::Code;
use percuss_output::HistoryFormat;

use crate::picture_arguments;

/// Help of `run`.
pub const RUN: &str = "\
With a rigid projectile the report compares the energies for the coefficients of restitution in `[report] restitution` (default 1, 0.5 \
and 0, for runs of at most 200 000 steps times elements).

Ctrl-C stops the run after the current step and writes the results so far; a second Ctrl-C stops immediately.

With --checkpoint an interrupted or killed run continues with --resume, the same scenario and the same --out; its history, summary and \
frames are bitwise those of an uninterrupted run.

Examples:
  percuss run plank.toml
  percuss run long.toml --checkpoint \"60 s\"
  percuss run long.toml --resume
  percuss run plank.toml --out results/fast --set projectile.mass.velocity=\"[0, 30]\"
  percuss run plank.toml --set time.step=\"1e-5 s\" --history csv
  percuss run plank.toml --json --quiet | jq .energy.residual_max";

/// Help of `extend`.
pub const EXTEND: &str = "\
The run continues from the checkpoint before its last step; the results are bitwise those of a run with the later end time. The \
scenario is otherwise unchanged. The first run requires --checkpoint; with --checkpoint here, an interrupted extension continues with \
--resume.

Examples:
  percuss run plank.toml --checkpoint \"60 s\"
  percuss extend runs/plank --end \"2 s\"
  percuss extend runs/plank --end \"2 s\" --out runs/plank-long
  percuss extend runs/plank --end \"200 s\" --checkpoint \"60 s\" --resume";

/// Arguments of `run`.
#[derive(Args, Debug)]
pub struct Run {
    /// Scenario file, or - for standard input
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Output directory; an earlier run in it is replaced [default: runs/ and the name of FILE]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Change a value of the scenario, such as time.step=1e-5; repeatable
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Fail with status 4 if a relative balance error exceeds 1e-10
    #[arg(long)]
    pub strict: bool,
    /// Print summary.json to standard output instead of a table
    #[arg(long)]
    pub json: bool,
    /// File format of the history
    #[arg(long, value_enum, value_name = "FORMAT", default_value = "parquet")]
    pub history: History,
    /// Do not write report.html (nor run the comparison of restitution coefficients)
    #[arg(long)]
    pub no_report: bool,
    /// Also write the figures of the report as SVG and PNG, into figures/
    #[arg(long, conflicts_with = "no_report")]
    pub figures: bool,
    /// Open the report in the browser after the run
    #[arg(long, conflicts_with = "no_report")]
    pub open: bool,
    /// Interval of checkpoints in DIR.checkpoint, for --resume: computing time ("60 s") or steps ("5000 steps")
    #[arg(long, value_name = "EVERY", value_parser = every)]
    pub checkpoint: Option<Every>,
    /// Continue from the last checkpoint; the results are bitwise those of an uninterrupted run. With --checkpoint, start the run if
    /// there is none
    #[arg(long)]
    pub resume: bool,
    /// Treat this warning as an error, such as W002 or W105 (`percuss explain` lists them): status 2 before the run, 4 after it;
    /// repeatable
    #[arg(long, value_name = "CODE", value_parser = code)]
    pub deny: Vec<Code>,
    /// Print nothing unless something is wrong
    #[arg(long, short)]
    pub quiet: bool,
}

/// A warning, by its code.
pub fn code(text: &str) -> Result<Code, String> {
    match Code::find(text) {
        Some(code) if code.is_error() => {
            Err(format!("{code} is an error ({}); expected the code of a warning", code.name))
        }
        Some(code) => Ok(code),
        None => Err("no such code; `percuss explain` lists them".into()),
    }
}

/// How often something is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Every {
    /// After so many seconds of computing.
    Seconds(f64),
    /// After so many steps.
    Steps(usize),
}

fn every(text: &str) -> Result<Every, String> {
    let expected = "expected a time such as \"60 s\" or a number of steps such as \"5000 steps\"";
    let steps = text.trim().strip_suffix("steps").or_else(|| text.trim().strip_suffix("step"));
    if let Some(number) = steps {
        return match number.trim().parse() {
            Ok(steps) if steps > 0 => Ok(Every::Steps(steps)),
            _ => Err(expected.into()),
        };
    }
    match picture_arguments::time(text) {
        Ok(seconds) if seconds > 0.0 => Ok(Every::Seconds(seconds)),
        Ok(_) => Err(expected.into()),
        Err(fault) => Err(format!("{fault}; {expected}")),
    }
}

/// Arguments of `extend`.
#[derive(Args, Debug)]
pub struct Extend {
    /// Directory of a completed run with --checkpoint
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub dir: PathBuf,
    /// New end time, such as "2 s"
    #[arg(long, value_name = "TIME", value_parser = picture_arguments::time)]
    pub end: f64,
    /// Directory of the extended run [default: DIR, whose results it replaces]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Interval of checkpoints in DIR.checkpoint, for --resume: computing time ("60 s") or steps ("5000 steps")
    #[arg(long, value_name = "EVERY", value_parser = every)]
    pub checkpoint: Option<Every>,
    /// Continue from the last checkpoint of an interrupted extension; with --checkpoint, start if there is none
    #[arg(long)]
    pub resume: bool,
    /// Fail with status 4 if a relative balance error exceeds 1e-10
    #[arg(long)]
    pub strict: bool,
    /// Print summary.json to standard output instead of a table
    #[arg(long)]
    pub json: bool,
    /// Do not write report.html (nor run the comparison of restitution coefficients)
    #[arg(long)]
    pub no_report: bool,
    /// Print nothing unless something is wrong
    #[arg(long, short)]
    pub quiet: bool,
}

/// File format of a history.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum History {
    /// history.parquet: compact, with units
    Parquet,
    /// history.csv, and the units in history.units.json
    Csv,
}

impl From<History> for HistoryFormat {
    fn from(history: History) -> Self {
        match history {
            History::Parquet => Self::Parquet,
            History::Csv => Self::Csv,
        }
    }
}
