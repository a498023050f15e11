//! What the figures of a page draw from: the history, its scale of time, and curves over it.

use super::draft::{Curve, Draft, Omit};
use super::figure::{Axis, Figure, Section};
use super::quantity::Scale;
use crate::history::HistorySource;

/// What the figures of a page have in common.
pub(super) struct Canvas<'a> {
    pub history: &'a HistorySource,
    /// Some rows of the motion, the first and the last among them; shape (n_channels, n_sampled or 0) \[unit of the channel\].
    pub sample: &'a [Vec<f64>],
    /// Scale of the time axis.
    pub time_scale: Scale,
    /// Bins to which long histories are reduced.
    pub bins: usize,
}

impl Canvas<'_> {
    /// The time axis.
    pub(super) fn time_axis(&self) -> Axis {
        Axis { label: "time".to_owned(), unit: self.time_scale.unit.clone() }
    }

    /// Curves of those channels that exist, with their styles.
    pub(super) fn curves(&self, wanted: &[(&str, &str, usize)]) -> Vec<Curve> {
        let curve = |&(channel, label, style): &(&str, &str, usize)| {
            Some(Curve::new(label, style, self.history.position(channel)?))
        };
        wanted.iter().filter_map(curve).collect()
    }

    pub(super) fn over_time(
        &self,
        (id, title, label): (&str, &str, &str),
        section: Section,
        unit: &'static str,
        curves: Vec<Curve>,
    ) -> Draft {
        let figure = Figure::new(section, id, title, self.time_axis(), label);
        Draft { figure, unit, curves, omit: Omit::Zeros, floor: 0.0, apart: false }
    }
}

/// Names between `prefix` and `suffix` among the channels, in their order.
pub(super) fn names(history: &HistorySource, prefix: &str, suffix: &str) -> Vec<String> {
    let name = |c: &crate::history::Channel| {
        Some(c.name.strip_prefix(prefix)?.strip_suffix(suffix)?.to_owned())
    };
    history.channels().iter().filter_map(name).collect()
}
