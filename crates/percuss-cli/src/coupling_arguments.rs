//! Arguments of the commands for other programs: drivers of studies, shells, readers of manual pages.

use std::path::PathBuf;

use clap::{Args, ValueHint};

/// Arguments of `serve`.
#[derive(Args, Debug)]
pub struct Serve {
    /// Study file; inputs: the study's parameters; outputs: its results; the sampling design is ignored
    #[arg(value_hint = ValueHint::FilePath)]
    pub study: PathBuf,
    /// Port to listen on; 0 for any free port
    #[arg(long, value_name = "N", default_value = "4242")]
    pub port: u16,
    /// Address to listen on; 0.0.0.0 accepts requests from other machines
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1")]
    pub host: String,
    /// Token that begins the path of every request [default: a new one each time, printed with the address]
    #[arg(long, value_name = "TEXT", conflicts_with = "no_token")]
    pub token: Option<String>,
    /// Accept requests without a token, from any program on this machine
    #[arg(long)]
    pub no_token: bool,
    /// Host name accepted in requests besides `localhost`, --host and numeric addresses; repeatable
    #[arg(long, value_name = "NAME")]
    pub allow_host: Vec<String>,
    /// Simultaneous requests [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub jobs: Option<u32>,
    /// Print nothing unless something is wrong
    #[arg(long, short)]
    pub quiet: bool,
}

/// Arguments of `eval`.
#[derive(Args, Debug)]
pub struct Eval {
    /// Study file; inputs: the study's parameters; outputs: its results; the sampling design is ignored
    #[arg(value_hint = ValueHint::FilePath)]
    pub study: PathBuf,
    /// Parameters file: Dakota's (standard or aprepro), or JSON such as {"speed": 20}, or - for standard input
    #[arg(value_hint = ValueHint::FilePath, value_name = "PARAMETERS")]
    pub parameters: PathBuf,
    /// Results file, in the format of the parameters; must not exist [default for JSON: standard output]
    #[arg(value_hint = ValueHint::FilePath, value_name = "RESULTS")]
    pub results: Option<PathBuf>,
    /// Also compute derivatives (Dakota's files request them themselves)
    #[arg(long)]
    pub gradients: bool,
}

/// Arguments of `man`.
#[derive(Args, Debug)]
pub struct Man {
    /// Output directory, created if missing; pages in it are replaced
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: PathBuf,
}

/// Arguments of `completions`.
#[derive(Args, Debug)]
pub struct Completions {
    /// The shell
    pub shell: clap_complete::Shell,
}

pub const SERVE: &str = "\
The model is `forward`: one input vector with the study's parameters in their order and in SI units, one output vector with its \
results. Evaluate, Gradient and ApplyJacobian are supported; derivatives are those of `percuss sensitivity`, where available. A run that \
does not complete is an error of the model, with the reason.

The printed address ends in a token; use --no-token for clients that take no path. Requests of more than a megabyte, for other host \
names (--allow-host) and from pages of other sites are rejected.

Examples:
  percuss serve speed-and-mass.toml
  percuss serve speed-and-mass.toml --port 0 --jobs 8

and in Python:
  model = umbridge.HTTPModel(\"http://127.0.0.1:4242/TOKEN\", \"forward\")
  model([[20, 500]])";

pub const EVAL: &str = "\
Variables are matched by name with the study's parameters, functions by name with its results, or in their order where names differ. \
Values are in SI units. A run that does not complete writes a file that begins with FAIL, which Dakota reads as a failed evaluation, and \
ends with exit status 3.

Examples:
  percuss eval speed.toml params.in results.out             # as Dakota's analysis_drivers = 'percuss eval speed.toml'
  echo '{\"speed\": 20}' | percuss eval speed.toml - --gradients";
