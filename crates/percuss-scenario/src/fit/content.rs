//! What a file of a fit contains.

use crate::format::{Count, Flag, List, Maybe, Pair, Text};
use crate::measure::{Ratio, Time};
use crate::node::{Body, Reader};
use crate::quantity::Quantity;
use crate::study::{Anything, Given, Spaced, Spacing, Whole};
use crate::table::{Braces, Collection, Named, Single};
use crate::words::{Word, Words};
use crate::write::Writer;

table! {
    /// A fit: parameters of a scenario found from measured curves.
    pub struct FitContent {
        /// One line about the fit.
        title: String as Text = String::new(),
        /// Path of the scenario, relative to the folder of this file.
        base: Option<String> as Maybe<Text> = None,
        /// Instead of `base`: the text of the scenario itself.
        scenario: Option<String> as Maybe<Text> = None,
        /// How the fit is made.
        fit: FitOptions as Single<FitOptions>,
        /// Parameters, by name.
        parameter: Vec<Named<FitParameter>> as Collection<FitParameter>,
        /// Tests with measured curves, by name.
        test: Vec<Named<FitTest>> as Collection<FitTest>,
    }
    either base | scenario
    then settle_fit
}

/// One scenario, from one place.
fn settle_fit(_: &mut FitContent, body: &Body<'_>, reader: &mut Reader<'_>) {
    let keys = ["base", "scenario"];
    crate::table::exclude(body, keys, reader);
    if !keys.iter().any(|key| body.get(key).is_some() || reader.excuses(body, key)) {
        let expected = "`base`, the path of a scenario, such as \"drop.toml\"";
        reader.missing(body, "base", "no `base`", expected);
    }
}

/// How a residual counts, in standard deviations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FitLoss {
    /// Its square: least squares.
    Linear,
    /// Its square where it is small, twice its magnitude where it is large, with a smooth transition.
    SoftL1,
    /// Its square up to `loss_scale`, its magnitude beyond.
    Huber,
}

/// The words for it.
pub(crate) struct Losses;

impl Words for Losses {
    type Value = FitLoss;
    const WORDS: &'static [(&'static str, FitLoss, &'static str)] = &[
        ("linear", FitLoss::Linear, "squares of the residuals"),
        (
            "soft_l1",
            FitLoss::SoftL1,
            "squares of small residuals, magnitudes of large ones, with a smooth transition",
        ),
        ("huber", FitLoss::Huber, "squares of residuals up to `loss_scale`, magnitudes beyond"),
    ];
}

/// Where derivatives of the curves with respect to the parameters come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FitJacobian {
    /// Exact ones where the run has them, else differences.
    Auto,
    /// Exact ones, or an error.
    Exact,
    /// Central differences of runs.
    Differences,
}

/// The words for it.
pub(crate) struct Derivatives;

impl Words for Derivatives {
    type Value = FitJacobian;
    const WORDS: &'static [(&'static str, FitJacobian, &'static str)] = &[
        ("auto", FitJacobian::Auto, "exact derivatives where the run has them, else differences"),
        ("exact", FitJacobian::Exact, "exact derivatives; an error where the run has none"),
        (
            "differences",
            FitJacobian::Differences,
            "central differences of runs, computed in parallel",
        ),
    ];
}

table! {
    /// How the fit is made.
    pub struct FitOptions {
        /// How a residual counts.
        loss: FitLoss as Word<Losses> = FitLoss::Linear,
        /// Residual, in standard deviations, at which `soft_l1` and `huber` change from squares to magnitudes.
        loss_scale: f64 as Quantity<Ratio> = 1.0,
        /// Number of starting points: that of the parameters, and further ones of a Latin hypercube within their bounds.
        starts: usize as Count = 1,
        /// Seed of the Latin hypercube.
        seed: u64 as Whole = 0,
        /// Where derivatives come from.
        jacobian: FitJacobian as Word<Derivatives> = FitJacobian::Auto,
        /// Most iterations from a starting point.
        iterations: usize as Count = 100,
    }
}

table! {
    /// A parameter: a number of the scenario to be found, or several that are equal.
    pub struct FitParameter {
        /// Its path in the scenario, such as `projectile.bag.stiffness`.
        path: Option<String> as Maybe<Text> = None,
        /// Instead of `path`: paths of several numbers that the parameter sets to one value.
        paths: Option<Vec<String>> as Maybe<List<Text>> = None,
        /// Starting value; that of the scenario if it is left out.
        start: Option<Given> as Maybe<Anything> = None,
        /// Smallest and largest value.
        bounds: Option<[Given; 2]> as Maybe<Pair<Anything>> = None,
        /// Scale on which the parameter is varied.
        spacing: Spacing as Word<Spaced> = Spacing::Linear,
        /// Whether the parameter keeps its starting value.
        fixed: bool as Flag = false,
        /// Knowledge of its value from elsewhere, a normal distribution.
        prior: Option<FitPrior> as Maybe<Braces<FitPrior>> = None,
        /// Names of the tests that the parameter acts in; all if they are left out.
        tests: Option<Vec<String>> as Maybe<List<Text>> = None,
    }
    either path | paths
    then settle_parameter
}

/// A parameter has one way to say where it stands.
fn settle_parameter(_: &mut FitParameter, body: &Body<'_>, reader: &mut Reader<'_>) {
    let keys = ["path", "paths"];
    crate::table::exclude(body, keys, reader);
    if !keys.iter().any(|key| body.get(key).is_some() || reader.excuses(body, key)) {
        let expected = "`path`, such as \"projectile.bag.stiffness\", or `paths`";
        reader.missing(body, "path", "no `path`", expected);
    }
}

table! {
    /// Knowledge of a parameter from elsewhere, a normal distribution.
    pub struct FitPrior {
        /// Mean.
        mean: Given as Anything,
        /// Standard deviation.
        deviation: Given as Anything,
    }
}

/// How the time of a record becomes that of the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alignment {
    /// By the given offset.
    None,
    /// By the onset of the first channel in record and run.
    Onset,
    /// By an offset that is fitted with the parameters.
    Fit,
}

/// The words for it.
pub(crate) struct Aligned;

impl Words for Aligned {
    type Value = Alignment;
    const WORDS: &'static [(&'static str, Alignment, &'static str)] = &[
        ("none", Alignment::None, "the run starts at the time `offset` of the record"),
        (
            "onset",
            Alignment::Onset,
            "the first channel leaves its initial value at the same time in record and run",
        ),
        ("fit", Alignment::Fit, "the offset is fitted with the parameters"),
    ];
}

table! {
    /// A test: a record of measured curves, and the run that they are compared with.
    pub struct FitTest {
        /// Path of the record, a CSV file whose first row names the columns and their units.
        data: String as Text,
        /// Name of the column of times in the record.
        time: String as Text = "time".into(),
        /// Values of the scenario that differ in this test, such as `projectile.bag.velocity[1]=-3`.
        set: Vec<String> as List<Text> = Vec::new(),
        /// First time of the record that is compared.
        from: Option<f64> as Maybe<Quantity<Time>> = None,
        /// Last time of the record that is compared.
        to: Option<f64> as Maybe<Quantity<Time>> = None,
        /// How times of the record become those of the run.
        align: Alignment as Word<Aligned> = Alignment::None,
        /// Time of the record at which the run starts; the first guess if it is fitted.
        offset: Option<f64> as Maybe<Quantity<Time>> = None,
        /// Smallest and largest offset if it is fitted; a tenth of the record to either side if they are left out.
        offset_bounds: Option<[f64; 2]> as Maybe<Pair<Quantity<Time>>> = None,
        /// Whether the test is kept out of the fit and only compared with its result.
        hold_out: bool as Flag = false,
        /// Channels, by name.
        channel: Vec<Named<FitChannel>> as Collection<FitChannel>,
    }
}

table! {
    /// A channel: a measured curve and the column of the history that it is compared with.
    pub struct FitChannel {
        /// Column of the history, such as `contact.bag.force`, or an acceleration, `point.tip.acceleration_2`.
        column: String as Text,
        /// Name of the column in the record; that of the channel if it is left out.
        data: Option<String> as Maybe<Text> = None,
        /// Factor on the measured values, such as -1 for the other direction.
        factor: f64 as Quantity<Ratio> = 1.0,
        /// Standard deviation of the measured values; if it is left out, in all channels of all tests, it follows from the residuals.
        sigma: Option<Given> as Maybe<Anything> = None,
        /// Channel frequency class, 60, 180, 600 or 1000, in which both curves are filtered.
        cfc: Option<usize> as Maybe<Count> = None,
    }
}
