//! Arguments of `fit`.

use std::path::PathBuf;

use clap::{Args, ValueHint};

pub const FIT: &str = "\
The file names a scenario, parameters and tests with their records (CSV). Minima of the weighted residuals are found by a trust-region \
method from one or several starting points. Results: fit.json, fit.txt, fit.html with measured and computed curves, curves.csv, and \
fitted.toml, the scenario with the values found.

Examples:
  percuss new fit --out my-fit.toml
  percuss fit drop-test.toml
  percuss fit drop-test.toml --profile stiffness
  percuss fit drop-test.toml --json | jq '.parameters[] | [.name, .value, .stderr]'

Exit status:
  0    the iteration converged
  1    I/O error (disk full, no permission)
  2    invalid input; nothing is written
  3    no convergence; the best values are written, unless no starting point has a run
  130  interrupted; nothing is written";

/// Arguments of `fit`.
#[derive(Args, Debug)]
pub struct FitArguments {
    /// File of the fit, with [fit], parameters and tests
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Output directory; an earlier fit in it is replaced [default: runs/ and the name of FILE with -fit]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Profile of a free parameter: the other parameters are fitted at given values of it, which gives its interval of 95 % where curves are not
    /// linear in it; repeatable
    #[arg(long, value_name = "NAME")]
    pub profile: Vec<String>,
    /// Threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub jobs: Option<u32>,
    /// Print fit.json to standard output instead of the report
    #[arg(long)]
    pub json: bool,
    /// Print nothing unless something is wrong
    #[arg(long, short)]
    pub quiet: bool,
}
