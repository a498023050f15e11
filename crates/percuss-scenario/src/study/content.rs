//! What a study file contains.

use super::given::{Anything, Given, NamedTexts, Whole};
use crate::format::{Count, Flag, List, Maybe, Pair, Text};
use crate::measure::Ratio;
use crate::node::{Body, Reader};
use crate::quantity::Quantity;
use crate::table::{Braces, Collection, Named, Single};
use crate::words::{Word, Words};
use crate::write::Writer;

table! {
    /// Many runs of one scenario, some of whose values change from run to run.
    pub struct StudyContent {
        /// One line about the study.
        title: String as Text = String::new(),
        /// Path of the base scenario, from where the study lies.
        base: Option<String> as Maybe<Text> = None,
        /// Instead of `base`: the text of the base scenario itself.
        scenario: Option<String> as Maybe<Text> = None,
        /// Number that all random numbers of the study follow from.
        seed: u64 as Whole = 0,
        /// Pairs of parameters that are correlated; written `[[correlation]]` or as a list of tables in braces.
        correlation: Vec<Correlation> as List<Braces<Correlation>> = Vec::new(),
        /// What varies, by name.
        parameter: Vec<Named<Parameter>> as Collection<Parameter>,
        /// Which combinations are run.
        design: Design as Single<Design>,
        /// The results wanted, by name: paths into summary.json, such as "contact.mass.peak_force.value".
        results: Vec<Named<String>> as NamedTexts,
    }
    either base | scenario
    then settle_study
}

/// One base, from one place.
fn settle_study(_: &mut StudyContent, body: &Body<'_>, reader: &mut Reader<'_>) {
    let keys = ["base", "scenario"];
    crate::table::exclude(body, keys, reader);
    if !keys.iter().any(|key| body.get(key).is_some() || reader.excuses(body, key)) {
        let expected = "`base`, the path of a scenario, such as \"elastic.toml\"";
        reader.missing(body, "base", "no `base`", expected);
    }
}

table! {
    /// A value of the scenario that changes from run to run.
    pub struct Parameter {
        /// Where it stands in the scenario: `projectile.mass.velocity[1]`, entries of lists counted from zero.
        path: String as Text,
        /// The values it takes, as they would stand in the scenario.
        values: Option<Vec<Given>> as Maybe<List<Anything>> = None,
        /// From one value to another.
        range: Option<Range> as Maybe<Braces<Range>> = None,
        /// Random values.
        distribution: Option<Distribution> as Maybe<Braces<Distribution>> = None,
    }
    either values | range | distribution
    then settle_parameter
}

/// Exactly one way to vary.
fn settle_parameter(_: &mut Parameter, body: &Body<'_>, reader: &mut Reader<'_>) {
    let keys = ["values", "range", "distribution"];
    for pair in [[keys[0], keys[1]], [keys[0], keys[2]], [keys[1], keys[2]]] {
        crate::table::exclude(body, pair, reader);
    }
    if !keys.iter().any(|key| body.get(key).is_some() || reader.excuses(body, key)) {
        let expected = "`values`, such as [\"10 m/s\", \"20 m/s\"], `range` or `distribution`";
        reader.missing(body, "values", "no variation", expected);
    }
}

/// How the values of a range lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spacing {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Logarithmic,
}

/// The words for it.
pub(crate) struct Spaced;

impl Words for Spaced {
    type Value = Spacing;
    const WORDS: &'static [(&'static str, Spacing, &'static str)] = &[
        ("linear", Spacing::Linear, "equal differences"),
        ("log", Spacing::Logarithmic, "equal ratios"),
    ];
}

table! {
    /// From one value to another; in a grid at `count` places, in other designs anywhere between, evenly spread.
    pub struct Range {
        /// First value.
        from: Given as Anything,
        /// Last value.
        to: Given as Anything,
        /// Number of values in a grid, both ends included.
        count: Option<usize> as Maybe<Count> = None,
        /// How they lie.
        spacing: Spacing as Word<Spaced> = Spacing::Linear,
    }
}

kinds! {
    /// Distribution of a random value.
    pub enum Distribution by "kind" {
        /// Equally likely between two values.
        Uniform = "uniform" {
            /// Smallest.
            from: Given as Anything,
            /// Largest.
            to: Given as Anything,
        },
        /// Gaussian.
        Normal = "normal" {
            /// Mean.
            mean: Given as Anything,
            /// Standard deviation.
            deviation: Given as Anything,
            /// Smallest and largest value; what lies outside is drawn again, as it were.
            truncated: Option<[Given; 2]> as Maybe<Pair<Anything>> = None,
        },
        /// The logarithm is Gaussian.
        Lognormal = "lognormal" {
            /// Mean of the value itself, not of its logarithm.
            mean: Given as Anything,
            /// Standard deviation of the value itself.
            deviation: Given as Anything,
            /// Smallest and largest value; what lies outside is drawn again, as it were.
            truncated: Option<[Given; 2]> as Maybe<Pair<Anything>> = None,
        },
    }
}

table! {
    /// Two parameters whose random values go together, by a Gaussian copula.
    pub struct Correlation {
        /// Names of the two parameters.
        between: [String; 2] as Pair<Text>,
        /// Coefficient of correlation of the two Gaussian variables behind them, from -1 to 1.
        coefficient: f64 as Quantity<Ratio>,
    }
}

table! {
    /// How many combinations are drawn.
    pub struct Sampling {
        /// Number of points; with `sobol_indices` each stands for 2 runs and one more a parameter.
        runs: usize as Count,
        /// Whether runs are arranged for Sobol indices (Saltelli's design).
        sobol_indices: bool as Flag = false,
    }
}

kinds! {
    /// Which combinations are run.
    pub enum Design by "kind" {
        /// Every combination of lists and ranges.
        Grid = "grid",
        /// Each parameter in as many equal parts as there are runs, one run in each.
        LatinHypercube = "latin-hypercube" {} with {
            /// How many.
            sampling: Sampling
        },
        /// A scrambled Sobol sequence: the most even spread; best with a power of two.
        Sobol = "sobol" {} with {
            /// How many.
            sampling: Sampling
        },
        /// Independent random values.
        MonteCarlo = "monte-carlo" {} with {
            /// How many.
            sampling: Sampling
        },
    }
}
