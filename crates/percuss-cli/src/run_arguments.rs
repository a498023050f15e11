//! Arguments of the commands that simulate one scenario: `run` and `extend`.

use std::path::PathBuf;

use clap::{Args, ValueEnum, ValueHint};

use percuss_codes::Code;
use percuss_output::HistoryFormat;

use crate::picture_arguments;

/// Help of `run`.
pub const RUN: &str = "\
With a rigid projectile the report compares the energies under the coefficients of restitution
that `[report] restitution` lists. Without it these are 1, 0.5 and 0, as long as the run has at
most 200 000 steps times elements.

Ctrl-C ends the run after its step and writes what there is; a second one ends it at once.

With --checkpoint a run that was interrupted, killed or cut off by the machine goes on with --resume,
given the same scenario and --out, and ends in the same history, summary and frames, bit for bit.

Examples:
  percuss run plank.toml
  percuss run long.toml --checkpoint \"60 s\"
  percuss run long.toml --resume
  percuss run plank.toml --out results/fast --set projectile.mass.velocity=\"[0, 30]\"
  percuss run plank.toml --set time.step=\"1e-5 s\" --history csv
  percuss run plank.toml --json --quiet | jq .energy.residual_max";

/// Help of `extend`.
pub const EXTEND: &str = "\
The run goes on from the checkpoint before its last step and ends in the bits of one that was given the later end from the
beginning. Nothing else of the scenario may change; --checkpoint is needed when it is run first. Given here, too, an extension
that was interrupted, killed or cut off goes on with --resume.

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
    /// Directory of the results; an earlier run in it is replaced [default: runs/ and the name of FILE]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Change a value of the scenario, such as time.step=1e-5; may be given again
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Fail with status 4 if energy or momentum are off by more than 1e-10, relative
    #[arg(long)]
    pub strict: bool,
    /// Print summary.json to standard output, and no table
    #[arg(long)]
    pub json: bool,
    /// File format of the history
    #[arg(long, value_enum, value_name = "FORMAT", default_value = "parquet")]
    pub history: History,
    /// Leave out report.html (and the runs that compare restitution coefficients)
    #[arg(long)]
    pub no_report: bool,
    /// Write the figures of the report as SVG and PNG as well, into figures/
    #[arg(long, conflicts_with = "no_report")]
    pub figures: bool,
    /// Open the report in the browser when the run has ended
    #[arg(long, conflicts_with = "no_report")]
    pub open: bool,
    /// Write a checkpoint every so often ("60 s" of computing time, "5000 steps") into DIR.checkpoint, to go on from with --resume
    #[arg(long, value_name = "EVERY", value_parser = every)]
    pub checkpoint: Option<Every>,
    /// Go on from the last checkpoint; ends in the same bits as a run that was never interrupted. With --checkpoint, begin if there
    /// is none
    #[arg(long)]
    pub resume: bool,
    /// Fail if there is a warning of this code, such as W002 or W105 (`percuss explain` lists them): before the run with status 2,
    /// after it with 4; may be given again
    #[arg(long, value_name = "CODE", value_parser = code)]
    pub deny: Vec<Code>,
    /// Say nothing unless something is wrong
    #[arg(long, short)]
    pub quiet: bool,
}

/// A warning, by its code.
pub fn code(text: &str) -> Result<Code, String> {
    match Code::find(text) {
        Some(code) if code.is_error() => Err(format!(
            "{code} is an error ({}), which ends a command whatever is denied; expected the code of a warning",
            code.name
        )),
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
    /// Directory of a complete run that was given --checkpoint
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub dir: PathBuf,
    /// Time at which it ends now, such as "2 s"
    #[arg(long, value_name = "TIME", value_parser = picture_arguments::time)]
    pub end: f64,
    /// Directory of the extended run [default: DIR, whose results it replaces]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Write a checkpoint every so often on the way ("60 s" of computing time, "5000 steps") into DIR.checkpoint, to go on from with
    /// --resume
    #[arg(long, value_name = "EVERY", value_parser = every)]
    pub checkpoint: Option<Every>,
    /// Go on from the last checkpoint of an extension that was interrupted; with --checkpoint, begin if there is none
    #[arg(long)]
    pub resume: bool,
    /// Fail with status 4 if energy or momentum are off by more than 1e-10, relative
    #[arg(long)]
    pub strict: bool,
    /// Print summary.json to standard output, and no table
    #[arg(long)]
    pub json: bool,
    /// Leave out report.html (and the runs that compare restitution coefficients)
    #[arg(long)]
    pub no_report: bool,
    /// Say nothing unless something is wrong
    #[arg(long, short)]
    pub quiet: bool,
}

/// File format of a history.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum History {
    /// history.parquet: compact, units inside
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
