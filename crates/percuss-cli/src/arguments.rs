//! The command line.

mod closing;

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};

use percuss_codes::Code;

use self::closing::{
    BEGIN, BOOK, COMPLETIONS, CONVERGE, EXIT_STATUS, EXPORT, MODES, SENSITIVITY, STATIC, SWEEP,
    VERIFY,
};
use crate::all_templates::all_templates;
use crate::commands::explain::topic::{Topic, topic};
use crate::coupling_arguments::{Completions, EVAL, Eval, Man, SERVE, Serve};
use crate::fit_arguments::{FIT, FitArguments};
use crate::picture_arguments::{ANIMATE, Animate, PLOT, Plot, SPECTRUM, Spectrum};
use crate::run_arguments::{EXTEND, Extend, RUN, Run, code};

/// Simulate impact on geometrically exact beams, with an energy and momentum balance after every step.
#[derive(Debug, Parser)]
#[command(name = "percuss", version, after_help = BEGIN, max_term_width = 100)]
pub struct Arguments {
    /// Command
    #[command(subcommand)]
    pub command: Command,
    /// Allow scenarios and studies to name files outside their own folder
    #[arg(long, global = true)]
    pub allow_outside: bool,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Simulate a scenario: history, summary, shapes over time, report
    #[command(after_help = format!("{RUN}\n\n{EXIT_STATUS}"))]
    Run(Run),
    /// Continue a completed run to a later end time
    #[command(after_help = format!("{EXTEND}\n\n{EXIT_STATUS}"))]
    Extend(Extend),
    /// Validate a scenario, study or fit and list all errors and warnings
    Check(Check),
    /// Static equilibrium under the loads at time zero, with contacts; moving projectiles are ignored
    #[command(after_help = format!("{STATIC}\n\n{EXIT_STATUS}"))]
    Static(Static),
    /// Natural frequencies and mode shapes (projectiles are ignored)
    #[command(after_help = format!("{MODES}\n\n{EXIT_STATUS}"))]
    Modes(Modes),
    /// Print a commented scenario, study or fit to start from; without a template, list them
    New(New),
    /// Run a study: many runs of one scenario with varied parameters
    #[command(after_help = format!("{SWEEP}\n\n{EXIT_STATUS}"))]
    Sweep(Sweep),
    /// Derivatives of a run's results with respect to numbers of its scenario, impacts included
    #[command(after_help = format!("{SENSITIVITY}\n\n{EXIT_STATUS}"))]
    Sensitivity(Sensitivity),
    /// Convergence study in step and mesh: observed orders, extrapolated limits with uncertainty, cheapest settings for an accuracy
    #[command(after_help = format!("{CONVERGE}\n\n{EXIT_STATUS}"))]
    Converge(Converge),
    /// Find parameters of a scenario from measured curves, with standard errors and warnings
    #[command(after_help = FIT)]
    Fit(FitArguments),
    /// Explain the code of a warning (W002) or an error (E006), or a table, key or word of scenario and study files; without a topic,
    /// list codes and tables
    Explain(Explain),
    /// Open the book in a browser and print its path: tasks, references, theory, verification
    #[command(after_help = BOOK)]
    Book(Book),
    /// Print the JSON Schema of scenario or study files, for completion in editors
    Schema(Schema),
    /// Rebuild report.html of a finished run, or compare several runs on one page
    Report(Report),
    /// Export a finished run to ParaView: beams with depth, section forces and stresses, bodies, obstacles, contact forces
    #[command(after_help = EXPORT)]
    Export(Export),
    /// Make a film of a finished run, or a picture of an instant, without a browser
    #[command(after_help = ANIMATE)]
    Animate(Animate),
    /// Write figures of a finished run for print
    #[command(after_help = PLOT)]
    Plot(Plot),
    /// Shock response spectrum and peak of an acceleration of a finished run
    #[command(after_help = SPECTRUM)]
    Spectrum(Spectrum),
    /// Run the verification cases and print what was measured and expected
    #[command(after_help = VERIFY)]
    Verify(Verify),
    /// Serve a study as a model for uncertainty quantification and optimisation programs over HTTP (UM-Bridge)
    #[command(after_help = SERVE)]
    Serve(Serve),
    /// Evaluate a study at one point, from a file of parameters to a file of results (Dakota, JSON)
    #[command(after_help = EVAL)]
    Eval(Eval),
    /// Print a script that completes this command in a shell
    #[command(after_help = COMPLETIONS)]
    Completions(Completions),
    /// Write manual pages, percuss.1 and one for each command
    Man(Man),
}

/// Arguments of `check`.
#[derive(Args, Debug)]
pub struct Check {
    /// Scenario, study or fit file, or - for standard input (a scenario)
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Change a value of the scenario, such as time.step=1e-5; repeatable
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Fail if there is a warning of this code, such as W002; repeatable
    #[arg(long, value_name = "CODE", value_parser = code)]
    pub deny: Vec<Code>,
}

/// Arguments of `sweep`.
#[derive(Args, Debug)]
pub struct Sweep {
    /// Study file
    #[arg(value_hint = ValueHint::FilePath)]
    pub study: PathBuf,
    /// Output directory; finished runs of the same study in it are kept [default: runs/ and the name of STUDY]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub jobs: Option<u32>,
    /// Compute only every N-th shard, beginning with shard I (1 to N); the last one to finish combines the results
    #[arg(long, value_name = "I/N", value_parser = share)]
    pub shard: Option<Share>,
    /// Run it on the Dask cluster of this scheduler, such as tcp://head:8786; needs Python with percuss and Dask, and takes any
    /// fsspec location for --out
    #[arg(long, value_name = "ADDRESS", conflicts_with_all = ["jobs", "shard", "json"])]
    pub scheduler: Option<String>,
    /// Keep all files of run N, with history and report, in kept/run-N; repeatable, also after the study is finished
    #[arg(long, value_name = "N", conflicts_with_all = ["shard", "scheduler"])]
    pub keep_run: Vec<u64>,
    /// Print counts and ranges of the results as JSON to standard output instead of a table
    #[arg(long)]
    pub json: bool,
    /// Print nothing unless something is wrong
    #[arg(long, short)]
    pub quiet: bool,
}

/// Every `of`-th part of something, from `part` on, counted from 1.
#[derive(Clone, Copy, Debug)]
pub struct Share {
    /// The part.
    pub part: u64,
    /// Number of parts.
    pub of: u64,
}

fn share(text: &str) -> Result<Share, String> {
    let numbers = text.split_once('/').and_then(|(part, of)| {
        Some(Share { part: part.trim().parse().ok()?, of: of.trim().parse().ok()? })
    });
    match numbers {
        Some(share) if (1..=share.of).contains(&share.part) => Ok(share),
        _ => Err("expected I/N with I from 1 to N, such as 3/20".into()),
    }
}

/// Arguments of `explain`.
#[derive(Args, Debug)]
pub struct Explain {
    /// A code, table, key or word: W002, beam, projectile.stiffness, hertz
    #[arg(value_parser = topic)]
    pub topic: Option<Topic>,
}

/// Arguments of `book`.
#[derive(Args, Debug)]
pub struct Book {
    /// Print the path of the first page and open no browser
    #[arg(long)]
    pub path: bool,
}

/// Arguments of `schema`.
#[derive(Args, Debug)]
pub struct Schema {
    /// Schema of study files instead of scenario files
    #[arg(long)]
    pub study: bool,
    /// Schema of files of fits instead of scenario files
    #[arg(long, conflicts_with = "study")]
    pub fit: bool,
}

/// Arguments of `static`.
#[derive(Args, Debug)]
pub struct Static {
    /// Scenario file, or - for standard input
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Change a value of the scenario, such as load.tip.force="[0, -10]"; repeatable
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Print only the result, as JSON
    #[arg(long)]
    pub json: bool,
    /// Follow the equilibrium path by arc length; writes its page, path.csv and a picture
    #[arg(long)]
    pub path: bool,
    /// Output directory; earlier results of the same kind in it are replaced [default: runs/ and the name of FILE with -static
    /// or -path]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
}

/// Arguments of `sensitivity`.
#[derive(Args, Debug)]
pub struct Sensitivity {
    /// Scenario file, or - for standard input
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Number of the scenario, such as projectile.mass.velocity[1]; repeatable
    #[arg(long, short, value_name = "PATH", required = true)]
    pub parameter: Vec<String>,
    /// Number of the summary, such as contact.mass.peak_force.value; repeatable [default: peaks, impulses, velocities at the end]
    #[arg(long, short, value_name = "PATH")]
    pub result: Vec<String>,
    /// Change a value of the scenario, such as beam.girder.elements=20; repeatable
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Print values and derivatives as JSON to standard output instead of a table
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `converge`.
#[derive(Args, Debug)]
pub struct Converge {
    /// Scenario file, or - for standard input
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Number of the summary, such as contact.mass.peak_force.value, or column of the history, of which the value of largest
    /// magnitude is taken; repeatable [default: peaks, velocities at the end, impulses, largest section forces]
    #[arg(long, short, value_name = "PATH")]
    pub result: Vec<String>,
    /// Accuracy for which the cheapest settings are sought, such as "1 %" or 0.01
    #[arg(long, value_name = "SHARE", value_parser = accuracy)]
    pub accuracy: Option<f64>,
    /// Refinement levels; each halves the step or doubles the elements
    #[arg(long, value_name = "N", default_value_t = percuss_study::Ladder::LEVELS as u8, value_parser = clap::value_parser!(u8).range(3..=8))]
    pub levels: u8,
    /// Change a value of the scenario, such as beam.girder.elements=20; repeatable
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Print all results as JSON to standard output instead of a table
    #[arg(long)]
    pub json: bool,
    /// Print nothing unless something is wrong
    #[arg(long, short)]
    pub quiet: bool,
}

fn accuracy(text: &str) -> Result<f64, String> {
    let (number, unit) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    let share = number.trim().parse::<f64>().ok().map(|number| number * unit);
    let valid = share.filter(|share| *share > 0.0 && *share < 1.0);
    valid.ok_or_else(|| "expected a share between 0 and 1, such as \"1 %\" or 0.01".into())
}

/// Arguments of `modes`.
#[derive(Args, Debug)]
pub struct Modes {
    /// Scenario file, or - for standard input
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Number of modes, from the lowest on
    #[arg(long, value_name = "N", default_value = "10", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub count: u32,
    /// Configuration of the linearisation [default: static if the scenario starts from it, else reference]
    #[arg(long, value_enum, value_name = "CONFIGURATION")]
    pub about: Option<About>,
    /// Output directory; earlier modes in it are replaced [default: runs/ and the name of FILE with -modes]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Change a value of the scenario, such as beam.girder.elements=20; repeatable
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Print modes.json to standard output instead of a table
    #[arg(long)]
    pub json: bool,
}

/// Configuration of the linearisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum About {
    /// Stress-free reference configuration
    Reference,
    /// Static equilibrium under the loads at time zero
    Static,
}

/// Arguments of `new`.
#[derive(Args, Debug)]
pub struct New {
    /// Template to print
    #[arg(value_parser = templates())]
    pub template: Option<String>,
    /// Write the template to a new file, and files that it names beside it where there are none
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, requires = "template")]
    pub out: Option<PathBuf>,
}

/// Arguments of `report`.
#[derive(Args, Debug)]
pub struct Report {
    /// Directory of a finished run; several are compared on one page
    #[arg(value_hint = ValueHint::DirPath, required = true, value_name = "DIR")]
    pub dirs: Vec<PathBuf>,
    /// Also write the figures as SVG and PNG, into figures/ of the run
    #[arg(long)]
    pub figures: bool,
    /// Page of the comparison of several runs
    #[arg(long, value_hint = ValueHint::FilePath, value_name = "FILE", default_value = "comparison.html")]
    pub out: PathBuf,
    /// Open the page in the browser
    #[arg(long)]
    pub open: bool,
}

/// Arguments of `export`.
#[derive(Args, Debug)]
pub struct Export {
    /// Directory of a finished run
    #[arg(value_hint = ValueHint::DirPath, value_name = "DIR")]
    pub dir: PathBuf,
    /// File format
    #[arg(long, value_enum, value_name = "FORMAT", default_value = "vtkhdf")]
    pub format: ExportFormat,
    /// Directory of the files; an earlier export in it is replaced [default: paraview/ in DIR]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
}

/// Format of an export.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ExportFormat {
    /// Poly data over time in HDF5, one file for each kind of body, for ParaView 5.12 or later
    Vtkhdf,
    /// The same as series of VTP files, one per instant, for any ParaView
    Pvd,
}

/// Arguments of `verify`.
#[derive(Args, Debug)]
pub struct Verify {
    /// Cases to run [default: all]
    #[arg(value_name = "ID", value_parser = cases())]
    pub ids: Vec<String>,
    /// List the cases and run none
    #[arg(long)]
    pub list: bool,
    /// Print every number as JSON instead of a table
    #[arg(long)]
    pub json: bool,
    /// Show every check of every case, not only the tightest one
    #[arg(long)]
    pub all_checks: bool,
    /// Write the verification manual into this folder: an index, and a page and a figure for each case
    #[arg(long, value_name = "DIR")]
    pub book: Option<PathBuf>,
}

fn templates() -> PossibleValuesParser {
    all_templates().map(|t| PossibleValue::new(t.name).help(t.summary)).collect::<Vec<_>>().into()
}

fn cases() -> PossibleValuesParser {
    let cases = percuss_verification::CASES.iter();
    cases.map(|c| PossibleValue::new(c.id).help(c.title)).collect::<Vec<_>>().into()
}
