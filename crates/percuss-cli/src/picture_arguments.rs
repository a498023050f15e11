//! Arguments of the commands that make pictures.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, RangedU64ValueParser};
use clap::{Args, ValueEnum, ValueHint};
use percuss_output::report::scene_choices;
use percuss_output::shock::Cfc;
use percuss_pictures::PrintFormat;
use percuss_scenario::units::{self, Dimension};

/// Examples of `animate`.
pub const ANIMATE: &str = "\
The film shows the scene of the report. The extension of FILE is its format: .gif, .apng or .mp4 (requires ffmpeg). A file that \
percuss did not write is replaced only with --force.

Examples:
  percuss animate runs/plank -o plank.gif
  percuss animate runs/plank -o impact.mp4 --impact --colour stress --width 1280
  percuss animate runs/plank -o start.apng --from 0 --to \"20 ms\" --duration 3
  percuss animate runs/plank -o peak.svg --still \"4.2 ms\" --diagram moment";

/// Examples of `plot`.
pub const PLOT: &str = "\
Text is 8 to 9 points high at any width. In SVG and PDF text is converted to outlines.

Examples:
  percuss plot runs/plank --list
  percuss plot runs/plank --figure energy --format pdf
  percuss plot runs/plank --figure force,energy --format svg,pdf,png --width 85mm --out figures
  percuss plot runs/plank --cfc 180 --figure acceleration-middle";

/// Examples of `spectrum`.
pub const SPECTRUM: &str = "\
COLUMN is the acceleration of a recorded point or of a projectile, averaged over each recorded step: point.NAME.acceleration_1 or _2, \
projectile.NAME.acceleration_1 or _2. The picture, FILE with .svg, shows absolute accelerations. A file that percuss did not write is \
replaced only with --force.

Examples:
  percuss spectrum runs/plank point.middle.acceleration_2
  percuss spectrum runs/plank point.middle.acceleration_2 --damping 0.02 --from 10Hz --to 5kHz --cfc 1000 --out srs.csv";

/// Arguments of `animate`.
#[derive(Args, Debug)]
pub struct Animate {
    /// Directory of a finished run
    #[arg(value_hint = ValueHint::DirPath, value_name = "DIR")]
    pub dir: PathBuf,
    /// File to write: .gif, .apng or .mp4; with --still .svg, .pdf or .png
    #[arg(long, short, value_hint = ValueHint::FilePath, value_name = "FILE")]
    pub out: PathBuf,
    /// Width in pixels, an even number or one less; the height follows from the scene
    #[arg(long, value_name = "PIXELS", default_value = "800", value_parser = RangedU64ValueParser::<u32>::new().range(160..=7680))]
    pub width: u32,
    /// Frames per second
    #[arg(long, value_name = "N", default_value = "25", value_parser = frames_a_second)]
    pub fps: f64,
    /// Duration of the film [default: 6 s, as in the report]
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub duration: Option<f64>,
    /// Start time in the run, such as "12 ms" [default: the first]
    #[arg(long, value_name = "TIME", value_parser = time, allow_negative_numbers = true)]
    pub from: Option<f64>,
    /// End time in the run [default: the last]
    #[arg(long, value_name = "TIME", value_parser = time, allow_negative_numbers = true)]
    pub to: Option<f64>,
    /// Only the time of contact, with a margin
    #[arg(long, conflicts_with_all = ["from", "to"])]
    pub impact: bool,
    /// Quantity shown by colour along the beams
    #[arg(long, value_name = "QUANTITY", default_value = "none", value_parser = choices("colour"))]
    pub colour: String,
    /// Diagram drawn along the beams
    #[arg(long, value_name = "QUANTITY", default_value = "none", value_parser = choices("diagram"))]
    pub diagram: String,
    /// Deformation scale; rejected where bodies would appear to overlap
    #[arg(long, value_name = "FACTOR", default_value = "1", value_parser = factor)]
    pub exaggeration: f64,
    /// Light on dark
    #[arg(long)]
    pub dark: bool,
    /// Title above the scene
    #[arg(long, value_name = "TEXT", default_value = "", hide_default_value = true)]
    pub title: String,
    /// Picture of this instant instead of a film
    #[arg(long, value_name = "TIME", value_parser = time, allow_negative_numbers = true, conflicts_with_all = ["from", "to", "impact", "duration"])]
    pub still: Option<f64>,
    /// Replace FILE even if percuss did not write it
    #[arg(long)]
    pub force: bool,
    /// Print nothing unless something is wrong
    #[arg(long, short)]
    pub quiet: bool,
}

/// Arguments of `plot`.
#[derive(Args, Debug)]
pub struct Plot {
    /// Directory of a finished run
    #[arg(value_hint = ValueHint::DirPath, value_name = "DIR")]
    pub dir: PathBuf,
    /// List the figures of the run without writing them
    #[arg(long)]
    pub list: bool,
    /// Figures to write, by their ids; repeatable [default: all]
    #[arg(long, short, value_name = "ID", value_delimiter = ',', conflicts_with = "list")]
    pub figure: Vec<String>,
    /// File formats
    #[arg(
        long,
        value_name = "FORMAT",
        value_enum,
        value_delimiter = ',',
        default_value = "svg,pdf,png"
    )]
    pub format: Vec<PlotFormat>,
    /// Width on paper
    #[arg(long, value_name = "LENGTH", default_value = "85mm", value_parser = width)]
    pub width: f64,
    /// Pixels per inch of PNG
    #[arg(long, value_name = "N", default_value = "300", value_parser = RangedU64ValueParser::<u32>::new().range(36..=2400))]
    pub dpi: u32,
    /// Add figures of accelerations, filtered by a channel frequency class of SAE J211 and ISO 6487: 60, 180, 600 or 1000
    #[arg(long, value_name = "CLASS", value_parser = class)]
    pub cfc: Option<Cfc>,
    /// Omit titles, for figures with captions
    #[arg(long)]
    pub no_title: bool,
    /// Output directory
    #[arg(long, value_hint = ValueHint::DirPath, value_name = "DIR", default_value = ".")]
    pub out: PathBuf,
    /// Replace files even if percuss did not write them
    #[arg(long)]
    pub force: bool,
    /// Print nothing unless something is wrong
    #[arg(long, short)]
    pub quiet: bool,
}

/// Arguments of `spectrum`.
#[derive(Args, Debug)]
pub struct Spectrum {
    /// Directory of a finished run
    #[arg(value_hint = ValueHint::DirPath, value_name = "DIR")]
    pub dir: PathBuf,
    /// Acceleration, such as point.middle.acceleration_2
    #[arg(value_name = "COLUMN")]
    pub column: String,
    /// Damping ratio of the oscillators, from 0 to below 1
    #[arg(long, value_name = "RATIO", default_value = "0.05")]
    pub damping: f64,
    /// Lowest natural frequency
    #[arg(long, value_name = "FREQUENCY", default_value = "1Hz", value_parser = frequency)]
    pub from: f64,
    /// Highest natural frequency [default: 10 kHz, or a tenth of the sampling where that is less]
    #[arg(long, value_name = "FREQUENCY", value_parser = frequency)]
    pub to: Option<f64>,
    /// Natural frequencies per octave
    #[arg(long, value_name = "N", default_value = "12", value_parser = RangedU64ValueParser::<u32>::new().range(1..=96))]
    pub per_octave: u32,
    /// Filter the acceleration by a channel frequency class of SAE J211 and ISO 6487: 60, 180, 600 or 1000
    #[arg(long, value_name = "CLASS", value_parser = class)]
    pub cfc: Option<Cfc>,
    /// File of the spectrum [default: COLUMN-spectrum.csv]
    #[arg(long, value_hint = ValueHint::FilePath, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace files even if percuss did not write them
    #[arg(long)]
    pub force: bool,
    /// Print nothing unless something is wrong
    #[arg(long, short)]
    pub quiet: bool,
}

/// Format of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum PlotFormat {
    /// Vectors for the web and for editing
    Svg,
    /// Vectors for LaTeX and word processors
    Pdf,
    /// Pixels
    Png,
}

impl From<PlotFormat> for PrintFormat {
    fn from(format: PlotFormat) -> Self {
        match format {
            PlotFormat::Svg => Self::Svg,
            PlotFormat::Pdf => Self::Pdf,
            PlotFormat::Png => Self::Png,
        }
    }
}

fn choices(list: &str) -> PossibleValuesParser {
    scene_choices(list).into()
}

/// A quantity of a dimension, or a bare number in SI units.
fn quantity(text: &str, dimension: Dimension, example: &str) -> Result<f64, String> {
    let read = units::parse(text)
        .map_err(|fault| format!("found {}, expected {}", fault.found, fault.expected))?;
    match read.dimension {
        given if given == dimension || given == Dimension::default() => Ok(read.value),
        given => {
            Err(format!("{given} is another kind of quantity; expected for example {example}"))
        }
    }
}

/// A time with its unit, or in seconds \[s\].
pub fn time(text: &str) -> Result<f64, String> {
    quantity(text, Dimension::new(0, 0, 1), "\"12 ms\"")
}

fn frequency(text: &str) -> Result<f64, String> {
    match quantity(text, Dimension::new(0, 0, -1), "100Hz")? {
        hertz if hertz > 0.0 && hertz.is_finite() => Ok(hertz),
        _ => Err("expected a frequency above zero, such as 100Hz".into()),
    }
}

fn class(text: &str) -> Result<Cfc, String> {
    let class = text.trim().parse().ok().and_then(Cfc::of);
    class.ok_or_else(|| "expected a class of SAE J211: 60, 180, 600 or 1000".into())
}

fn duration(text: &str) -> Result<f64, String> {
    match quantity(text, Dimension::new(0, 0, 1), "\"6 s\"")? {
        seconds if (0.1..=600.0).contains(&seconds) => Ok(seconds),
        _ => Err("a film lasts from 0.1 s to 600 s".into()),
    }
}

fn width(text: &str) -> Result<f64, String> {
    match quantity(text, Dimension::new(1, 0, 0), "85mm")? {
        metres if (0.04..=1.0).contains(&metres) => Ok(metres),
        _ => Err("expected a width with its unit from 40mm to 1m, such as 85mm".into()),
    }
}

fn frames_a_second(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(fps) if (1.0..=100.0).contains(&fps) => Ok(fps),
        _ => Err("expected a number from 1 to 100".into()),
    }
}

fn factor(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(factor) if factor > 0.0 && factor <= 1e6 => Ok(factor),
        _ => Err("expected a number above 0, such as 20".into()),
    }
}
