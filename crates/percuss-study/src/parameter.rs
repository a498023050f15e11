//! What varies, and how a number between 0 and 1 becomes one of its values.

use percuss_scenario::Field;

use crate::distribution::Distribution;

/// A value of the scenario that changes from run to run.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The user's name for it.
    pub name: String,
    /// Where it stands in the scenario.
    pub field: Field,
    /// SI unit, `1` for a pure number and for words.
    pub unit: String,
    /// One of its values as it stands in the study.
    pub(crate) example: String,
    /// How it varies.
    pub variation: Variation,
}

/// How a parameter varies; numbers are in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Variation {
    /// These numbers, shape (values) \[SI unit of the parameter\].
    Numbers(Vec<f64>),
    /// These words or other values, as TOML, shape (values).
    Words(Vec<String>),
    /// From one number to another.
    Range {
        /// First.
        from: f64,
        /// Last.
        to: f64,
        /// How many in a grid.
        count: Option<usize>,
        /// Equal ratios instead of equal differences.
        logarithmic: bool,
    },
    /// A random number.
    Random(Distribution),
}

/// The value of a parameter in a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input<'s> {
    /// A number, in SI units.
    Number(f64),
    /// A word or another value, as TOML.
    Word(&'s str),
}

impl Variation {
    /// Number of values in a grid; `None` for what has none.
    pub fn levels(&self) -> Option<usize> {
        match self {
            Self::Numbers(values) => Some(values.len()),
            Self::Words(values) => Some(values.len()),
            Self::Range { count, .. } => *count,
            Self::Random(_) => None,
        }
    }

    /// A value of a grid, counted from zero.
    pub fn level(&self, k: usize) -> Input<'_> {
        match self {
            Self::Numbers(values) => Input::Number(values[k]),
            Self::Words(values) => Input::Word(&values[k]),
            Self::Range { count, .. } => {
                let last = count.unwrap_or(1).saturating_sub(1).max(1);
                self.at(k as f64 / last as f64)
            }
            Self::Random(distribution) => Input::Number(distribution.quantile(0.5)),
        }
    }

    /// Smallest and largest value, if numbers vary between such.
    pub fn bounds(&self) -> Option<(f64, f64)> {
        let ends = match self {
            Self::Words(_) => return None,
            Self::Numbers(values) => {
                let low = values.iter().copied().fold(f64::INFINITY, f64::min);
                (low, values.iter().copied().fold(f64::NEG_INFINITY, f64::max))
            }
            Self::Range { from, to, .. } => (from.min(*to), from.max(*to)),
            Self::Random(distribution) => (distribution.quantile(0.0), distribution.quantile(1.0)),
        };
        (ends.0.is_finite() && ends.1.is_finite()).then_some(ends)
    }

    /// The value below which the share `u` of all values lies, `u` from 0 to 1.
    pub fn at(&self, u: f64) -> Input<'_> {
        let entry = |n: usize| ((u * n as f64) as usize).min(n.saturating_sub(1));
        match self {
            Self::Numbers(values) => Input::Number(values[entry(values.len())]),
            Self::Words(values) => Input::Word(&values[entry(values.len())]),
            // Both ends are met to the last bit.
            Self::Range { from, .. } if u == 0.0 => Input::Number(*from),
            Self::Range { to, .. } if u == 1.0 => Input::Number(*to),
            Self::Range { from, to, logarithmic: false, .. } => {
                Input::Number(from + (to - from) * u)
            }
            Self::Range { from, to, logarithmic: true, .. } => {
                Input::Number(from * (to / from).powf(u))
            }
            Self::Random(distribution) => Input::Number(distribution.quantile(u)),
        }
    }
}
