//! What a study file contains.

use super::given::{Anything, Given, Whole};
use super::wanted::{WantedResult, WantedResults};
use crate::format::{Count, Flag, List, Maybe, Pair, Text};
use crate::measure::Ratio;
use crate::node::{Body, Reader};
use crate::quantity::Quantity;
use crate::table::{Braces, Collection, Named, Single};
use crate::words::{Word, Words};
use crate::write::Writer;

table! {
    /// A study: many runs of one scenario with varying parameters.
    pub struct StudyContent {
        /// One line about the study.
        title: String as Text = String::new(),
        /// Path of the base scenario, relative to the folder of the study.
        base: Option<String> as Maybe<Text> = None,
        /// Instead of `base`: the text of the base scenario itself.
        scenario: Option<String> as Maybe<Text> = None,
        /// Seed of the random numbers of the study.
        seed: u64 as Whole = 0,
        /// Pairs of parameters that are correlated; written `[[correlation]]` or as a list of tables in braces.
        correlation: Vec<Correlation> as List<Braces<Correlation>> = Vec::new(),
        /// Parameters, by name.
        parameter: Vec<Named<Parameter>> as Collection<Parameter>,
        /// Sampling design.
        design: Design as Single<Design>,
        /// Results, by name: paths into summary.json, such as "contact.mass.peak_force.value", or numbers taken from a column of the history.
        results: Vec<Named<WantedResult>> as WantedResults,
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
    /// A parameter: a value of the scenario that varies.
    pub struct Parameter {
        /// Its path in the scenario, such as `projectile.mass.velocity[1]`; entries of lists are counted from zero.
        path: String as Text,
        /// Its values, in the form of the scenario.
        values: Option<Vec<Given>> as Maybe<List<Anything>> = None,
        /// Range between two values.
        range: Option<Range> as Maybe<Braces<Range>> = None,
        /// Distribution of random values.
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

/// Spacing of the values of a range.
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
    /// Range between two values: `count` values in a grid; continuous in other designs, uniform in its spacing.
    pub struct Range {
        /// First value.
        from: Given as Anything,
        /// Last value.
        to: Given as Anything,
        /// Number of values in a grid, both ends included.
        count: Option<usize> as Maybe<Count> = None,
        /// Spacing of the values.
        spacing: Spacing as Word<Spaced> = Spacing::Linear,
    }
}

kinds! {
    /// Distribution of a random value.
    pub enum Distribution by "kind" {
        /// Uniform distribution between two values.
        Uniform = "uniform" {
            /// Smallest.
            from: Given as Anything,
            /// Largest.
            to: Given as Anything,
        },
        /// Normal distribution.
        Normal = "normal" {
            /// Mean.
            mean: Given as Anything,
            /// Standard deviation.
            deviation: Given as Anything,
            /// Smallest and largest value of the truncated distribution.
            truncated: Option<[Given; 2]> as Maybe<Pair<Anything>> = None,
        },
        /// Lognormal distribution.
        Lognormal = "lognormal" {
            /// Mean of the value itself, not of its logarithm.
            mean: Given as Anything,
            /// Standard deviation of the value itself.
            deviation: Given as Anything,
            /// Smallest and largest value of the truncated distribution.
            truncated: Option<[Given; 2]> as Maybe<Pair<Anything>> = None,
        },
    }
}

table! {
    /// Correlation of two random parameters, by a Gaussian copula.
    pub struct Correlation {
        /// Names of the two parameters.
        between: [String; 2] as Pair<Text>,
        /// Coefficient of correlation of the two Gaussian variables of the copula, from -1 to 1.
        coefficient: f64 as Quantity<Ratio>,
    }
}

table! {
    /// Number of points of a random design.
    pub struct Sampling {
        /// Number of points; with `sobol_indices` each has 2 runs and one more per parameter.
        runs: usize as Count,
        /// Whether runs are arranged for Sobol indices (Saltelli's design).
        sobol_indices: bool as Flag = false,
    }
}

kinds! {
    /// Sampling design.
    pub enum Design by "kind" {
        /// Every combination of lists and ranges.
        Grid = "grid",
        /// Latin hypercube: the range of each parameter in as many equal parts as there are runs, one run in each.
        LatinHypercube = "latin-hypercube" {} with {
            /// Number of points.
            sampling: Sampling
        },
        /// Scrambled Sobol sequence, the most uniform design; best with a power of two.
        Sobol = "sobol" {} with {
            /// Number of points.
            sampling: Sampling
        },
        /// Monte Carlo: independent random values.
        MonteCarlo = "monte-carlo" {} with {
            /// Number of points.
            sampling: Sampling
        },
    }
}
