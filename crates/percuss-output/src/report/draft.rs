//! Figures over time: their curves are written down first, then all of them read in one go.

use super::figure::{Figure, Scaled, Section, Series, Shape, Table, largest};
use super::quantity::Scale;
use super::thin::{Bins, Thinner};
use crate::error::Error;
use crate::history::HistorySource;
use crate::round_off::is_round_off;

/// A curve before its rows are read: `constant` and a sum of channels times factors.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    pub label: String,
    pub style: usize,
    /// Width of the line in units of the usual one.
    pub weight: f64,
    pub dashed: bool,
    pub shape: Shape,
    /// Channels by number, with their factors, shape (terms) \[index of a channel, -\].
    pub terms: Vec<(usize, f64)>,
    pub constant: f64,
    /// A channel and its largest value at which the curve is drawn.
    pub where_below: Option<(usize, f64)>,
}

impl Curve {
    /// One channel as it is.
    pub(super) fn new(label: impl Into<String>, style: usize, channel: usize) -> Self {
        Self::sum(label, style, vec![(channel, 1.0)], 0.0)
    }

    pub(super) fn sum(
        label: impl Into<String>,
        style: usize,
        terms: Vec<(usize, f64)>,
        constant: f64,
    ) -> Self {
        let label = label.into();
        let shape = Shape::Line;
        Self { label, style, weight: 1.0, dashed: true, shape, terms, constant, where_below: None }
    }
}

/// Curves that are not worth drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Omit {
    /// None.
    Nothing,
    /// Those of zeros.
    Zeros,
    /// Those that are zero or round-off beside the others.
    RoundOff,
}

/// A figure whose curves are still to be read.
#[derive(Debug)]
pub(super) struct Draft {
    /// The figure without unit and tables.
    pub figure: Figure,
    /// Unit as channels spell it.
    pub unit: &'static str,
    /// Its curves, shape (curves).
    pub curves: Vec<Curve>,
    pub omit: Omit,
    /// Size beside which values are round-off, where it is larger than the curves \[SI\].
    pub floor: f64,
    /// Whether curves that a common axis would flatten get figures of their own.
    pub apart: bool,
}

/// A figure, or what becomes one.
#[derive(Debug)]
pub(super) enum Entry {
    /// Made of rows.
    Draft(Draft),
    /// Made of something else.
    Ready(Figure),
}

/// Reads the curves of all drafts, the rows of each figure reduced bin by bin.
pub(super) fn finish(
    entries: Vec<Entry>,
    history: &HistorySource,
    time: (usize, &Scale),
    bins: &Bins,
) -> Result<Vec<Figure>, Error> {
    let drafts = || {
        entries.iter().filter_map(|entry| match entry {
            Entry::Draft(draft) => Some(draft),
            Entry::Ready(_) => None,
        })
    };
    let curves = || drafts().flat_map(|d| &d.curves);
    let mut wanted: Vec<usize> = curves().flat_map(|c| &c.terms).map(|term| term.0).collect();
    wanted.extend(curves().filter_map(|c| c.where_below).map(|(channel, _)| channel));
    wanted.push(time.0);
    wanted.sort_unstable();
    wanted.dedup();
    let place = |channel: usize| wanted.binary_search(&channel).unwrap_or(0);

    let mut thinners: Vec<Thinner> = drafts().map(|d| Thinner::new(d.curves.len(), bins)).collect();
    let mut rows: Vec<Vec<f64>> = Vec::new();
    history.scan(&wanted, &mut |piece| {
        for (draft, thinner) in drafts().zip(&mut thinners) {
            rows.resize_with(1 + draft.curves.len(), Vec::new);
            rows[0].clear();
            rows[0].extend_from_slice(piece[place(time.0)]);
            for (row, curve) in rows[1..].iter_mut().zip(&draft.curves) {
                evaluate(curve, |channel| piece[place(channel)], row);
            }
            thinner.push(&rows);
        }
    })?;

    let mut thinners = thinners.into_iter();
    let mut figures = Vec::new();
    for entry in entries {
        match entry {
            Entry::Ready(figure) => figures.push(figure),
            Entry::Draft(draft) => {
                let Some(thinner) = thinners.next() else { break };
                let (x, columns) = thinner.finish();
                figures.extend(draft.drawn(x, columns, time.1));
            }
        }
    }
    Ok(figures)
}

/// The curve's values over a piece of the history.
fn evaluate<'a>(curve: &Curve, column: impl Fn(usize) -> &'a [f64], out: &mut Vec<f64>) {
    out.clear();
    if let [(channel, 1.0)] = curve.terms[..] {
        out.extend(column(channel).iter().map(|v| v + curve.constant));
    } else {
        for &(channel, factor) in &curve.terms {
            let column = column(channel);
            out.resize(column.len(), curve.constant);
            out.iter_mut().zip(column).for_each(|(sum, value)| *sum += factor * value);
        }
    }
    if let Some((channel, limit)) = curve.where_below {
        let hidden = |(value, other): (&mut f64, &f64)| {
            if *other > limit || other.is_nan() {
                *value = f64::NAN;
            }
        };
        out.iter_mut().zip(column(channel)).for_each(hidden);
    }
}

/// A curve and its values.
type Read = (Curve, Vec<f64>);

impl Draft {
    /// The figure, or several where curves are apart; none where no curve is worth drawing.
    fn drawn(mut self, mut x: Vec<f64>, mut columns: Vec<Vec<f64>>, time: &Scale) -> Vec<Figure> {
        if self.figure.section == Section::Supports && x.len() > 1 {
            // Means since the row before: the first row has none.
            x.remove(0);
            columns.iter_mut().filter(|y| !y.is_empty()).for_each(|y| {
                y.remove(0);
            });
        }
        x.iter_mut().for_each(|x| *x *= time.factor);
        let size = largest(columns.iter().flatten());
        let stays = |(curve, y): &Read| {
            let worth = match self.omit {
                Omit::Nothing => true,
                Omit::Zeros => largest(y) > 0.0,
                Omit::RoundOff => !is_round_off(largest(y), size.max(self.floor)),
            };
            let hidden = curve.where_below.is_some() && !y.iter().any(|v| v.is_finite());
            worth && !hidden
        };
        let several = self.curves.len() > 1;
        let read: Vec<Read> =
            std::mem::take(&mut self.curves).into_iter().zip(columns).filter(stays).collect();
        let groups = if self.apart { apart(read) } else { vec![read] };
        let split = groups.len() > 1;
        let mut figures = Vec::new();
        for (k, group) in groups.into_iter().filter(|group| !group.is_empty()).enumerate() {
            let mut figure = self.figure.clone();
            if split {
                let names: Vec<&str> = group.iter().map(|(c, _)| c.label.as_str()).collect();
                figure.title = format!("{}, {}", figure.title, names.join(" and "));
            }
            if k > 0 {
                figure.id = format!("{}-{}", figure.id, k + 1);
            }
            let mut figure = self.one(figure, &x, group, several && !split);
            if let Some(scaled) = &mut figure.scaled {
                scaled.factors[0] = time.factor;
            }
            figures.push(figure);
        }
        figures
    }

    /// A figure of these curves.
    fn one(&self, mut figure: Figure, x: &[f64], group: Vec<Read>, several: bool) -> Figure {
        let scale = Scale::new(largest(group.iter().flat_map(|(_, y)| y)), self.unit);
        let scaled = |(curve, mut y): Read| {
            y.iter_mut().for_each(|y| *y *= scale.factor);
            let Curve { label, style, weight, dashed, shape, .. } = curve;
            Series { label, style, weight, dashed, shape, y }
        };
        let series: Vec<Series> = group.into_iter().map(scaled).collect();
        if let [only] = series.as_slice()
            && only.label.starts_with("along ")
        {
            figure.y.label = format!("{} {}", figure.y.label, only.label); // no legend says it
        }
        if let [only] = series.as_slice()
            && several
            && matches!(figure.section, Section::Supports | Section::Forces)
        {
            figure.title = format!("{}, {}", figure.title, only.label);
        }
        figure.y.unit.clone_from(&scale.unit);
        figure.scaled = Some(Scaled { factors: [1.0, scale.factor], unit: self.unit });
        figure.tables = vec![Table { x: x.to_vec(), series }];
        figure
    }
}

/// A curve that would take less than this share of the common axis is drawn apart.
const FLATTENED: f64 = 0.08;

/// Curves in groups on whose common axis none is flattened, in the order of their first curves.
fn apart(read: Vec<Read>) -> Vec<Vec<Read>> {
    let own = |y: &[f64]| {
        let finite = || y.iter().copied().filter(|v| v.is_finite());
        [finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max)]
    };
    let extent = |[low, high]: [f64; 2]| if high >= low { high - low } else { 0.0 };
    let mut groups: Vec<([f64; 2], f64, Vec<Read>)> = Vec::new();
    for one in read {
        let range = own(&one.1);
        // What does not move needs no height, wherever it is.
        let moves = !is_round_off(extent(range), largest(&one.1));
        let height = if moves { extent(range) } else { f64::INFINITY };
        let joined = |other: &([f64; 2], f64, Vec<Read>)| {
            let both = [other.0[0].min(range[0]), other.0[1].max(range[1])];
            (both, other.1.min(height))
        };
        let fits = |other: &([f64; 2], f64, Vec<Read>)| {
            let (both, least) = joined(other);
            least == f64::INFINITY || least >= FLATTENED * extent(both)
        };
        match groups.iter().position(fits) {
            Some(k) => {
                (groups[k].0, groups[k].1) = joined(&groups[k]);
                groups[k].2.push(one);
            }
            None => groups.push((range, height, vec![one])),
        }
    }
    groups.into_iter().map(|(_, _, group)| group).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(label: &str, y: &[f64]) -> Read {
        (Curve::new(label, 1, 0), y.to_vec())
    }

    fn labels(groups: &[Vec<Read>]) -> Vec<Vec<&str>> {
        groups.iter().map(|g| g.iter().map(|(c, _)| c.label.as_str()).collect()).collect()
    }

    #[test]
    fn metres_do_not_flatten_millimetres() {
        let groups = apart(vec![
            curve("projectile", &[-1.0, 0.0, -2.0]),
            curve("point", &[0.0, 1e-3, -1e-3]),
            curve("other point", &[0.0, 2e-3, 0.0]),
        ]);
        assert_eq!(labels(&groups), [vec!["projectile"], vec!["point", "other point"]]);
    }

    #[test]
    fn curves_of_one_size_stay_together_and_so_does_what_stands_still_near() {
        let groups = apart(vec![
            curve("a", &[0.0, 1.0]),
            curve("b", &[0.0, 0.2]),
            curve("zero", &[0.0, 0.0]),
        ]);
        assert_eq!(labels(&groups), [vec!["a", "b", "zero"]]);
        let far = apart(vec![curve("still", &[5.0, 5.0]), curve("moves", &[0.0, 1e-3])]);
        assert_eq!(labels(&far), [vec!["still"], vec!["moves"]]);
    }
}
