//! Arguments of the commands for other programs: drivers of studies, shells, readers of manual pages.

use std::path::PathBuf;

use clap::{Args, ValueHint};

/// Arguments of `serve`.
#[derive(Args, Debug)]
pub struct Serve {
    /// Study file: its parameters go in, its results come out, its design plays no part
    #[arg(value_hint = ValueHint::FilePath)]
    pub study: PathBuf,
    /// Port to listen at; 0 for any that is free
    #[arg(long, value_name = "N", default_value = "4242")]
    pub port: u16,
    /// Address to listen at; 0.0.0.0 lets other machines in, who then evaluate what they like
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1")]
    pub host: String,
    /// Token that the path of every request begins with [default: a new one each time, told with the address]
    #[arg(long, value_name = "TEXT", conflicts_with = "no_token")]
    pub token: Option<String>,
    /// Answer requests without a token: any program on this machine may ask then
    #[arg(long)]
    pub no_token: bool,
    /// Name that requests may call this server by besides `localhost`, --host and addresses in numbers; may be repeated
    #[arg(long, value_name = "NAME")]
    pub allow_host: Vec<String>,
    /// Requests at a time [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub jobs: Option<u32>,
    /// Say nothing unless something is wrong
    #[arg(long, short)]
    pub quiet: bool,
}

/// Arguments of `eval`.
#[derive(Args, Debug)]
pub struct Eval {
    /// Study file: its parameters go in, its results come out, its design plays no part
    #[arg(value_hint = ValueHint::FilePath)]
    pub study: PathBuf,
    /// File of parameters: Dakota's (standard or aprepro), or JSON such as {"speed": 20}, or - for standard input
    #[arg(value_hint = ValueHint::FilePath, value_name = "PARAMETERS")]
    pub parameters: PathBuf,
    /// File of results to write, in the form of the parameters; must not exist [default for JSON: standard output]
    #[arg(value_hint = ValueHint::FilePath, value_name = "RESULTS")]
    pub results: Option<PathBuf>,
    /// With derivatives; Dakota's files ask for them themselves
    #[arg(long)]
    pub gradients: bool,
}

/// Arguments of `man`.
#[derive(Args, Debug)]
pub struct Man {
    /// Directory to write into, made if it is missing; pages in it are replaced
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
The model is `forward`: one vector in, of the study's parameters in their order and in SI units, one vector out,
of its results. Evaluate, Gradient and ApplyJacobian are answered; derivatives are those of `percuss sensitivity`,
where the scene has them. A run that does not complete is an error of the model, with the reason.
The address that is told ends in a token, which clients take with it; for those that take no path there is --no-token.
Requests of more than a megabyte, under other names (--allow-host) and from pages of other sites are refused.

Examples:
  percuss serve speed-and-mass.toml
  percuss serve speed-and-mass.toml --port 0 --jobs 8

and in Python:
  model = umbridge.HTTPModel(\"http://127.0.0.1:4242/TOKEN\", \"forward\")
  model([[20, 500]])";

pub const EVAL: &str = "\
Variables are found by their names, which are those of the study's parameters; functions by theirs, or in the order of the
study's results where they have other names. Numbers are SI. A run that does not complete leaves a file that begins with FAIL,
which Dakota takes for a failed evaluation, and exit status 3.

Examples:
  percuss eval speed.toml params.in results.out             # as Dakota's analysis_drivers = 'percuss eval speed.toml'
  echo '{\"speed\": 20}' | percuss eval speed.toml - --gradients";
