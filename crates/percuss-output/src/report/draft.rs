//! Figures over time: their curves are written down first, then all of them read in one go.

use super::figure::{Figure, Section, Series, Shape, Table, largest};
use super::quantity::Scale;
use super::thin::Thinner;
use crate::error::Error;
use crate::history::HistorySource;

/// A curve before its rows are read: `constant` and a sum of channels times factors.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    pub label: String,
    pub style: usize,
    /// Width of the line in units of the usual one.
    pub weight: f64,
    pub dashed: bool,
    /// Channels by number, with their factors.
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
        Self { label, style, weight: 1.0, dashed: true, terms, constant, where_below: None }
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
    pub curves: Vec<Curve>,
    pub omit: Omit,
    /// Size beside which round-off is told, where it is larger than the curves \[SI\].
    pub floor: f64,
}

/// A figure, or what becomes one.
#[derive(Debug)]
pub(super) enum Entry {
    /// Made of rows.
    Draft(Draft),
    /// Made of something else.
    Ready(Figure),
}

/// Reads the curves of all drafts, each figure reduced to `bins` bins.
pub(super) fn finish(
    entries: Vec<Entry>,
    history: &HistorySource,
    time: (usize, &Scale),
    bins: usize,
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

    let mut thinners: Vec<Thinner> =
        drafts().map(|d| Thinner::new(d.curves.len(), history.rows(), bins)).collect();
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
    let figures = entries.into_iter().filter_map(|entry| match entry {
        Entry::Ready(figure) => Some(figure),
        Entry::Draft(draft) => {
            let (x, columns) = thinners.next()?.finish();
            draft.drawn(x, columns, time.1)
        }
    });
    Ok(figures.collect())
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

impl Draft {
    fn drawn(self, mut x: Vec<f64>, mut columns: Vec<Vec<f64>>, time: &Scale) -> Option<Figure> {
        if self.figure.section == Section::Supports && x.len() > 1 {
            // Means since the row before: the first row has none.
            x.remove(0);
            columns.iter_mut().filter(|y| !y.is_empty()).for_each(|y| {
                y.remove(0);
            });
        }
        let size = largest(columns.iter().flatten());
        let stays = |y: &[f64]| match self.omit {
            Omit::Nothing => true,
            Omit::Zeros => largest(y) > 0.0,
            Omit::RoundOff => largest(y) > 1e-11 * size.max(self.floor),
        };
        let scale = Scale::new(size, self.unit);
        let mut series: Vec<Series> = Vec::new();
        let several = self.curves.len() > 1;
        for (curve, mut y) in self.curves.into_iter().zip(columns) {
            let hidden = curve.where_below.is_some() && !y.iter().any(|v| v.is_finite());
            if stays(&y) && !hidden {
                y.iter_mut().for_each(|y| *y *= scale.factor);
                let Curve { label, style, weight, dashed, .. } = curve;
                series.push(Series { label, style, weight, dashed, shape: Shape::Line, y });
            }
        }
        if series.is_empty() {
            return None;
        }
        let mut figure = self.figure;
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
        figure.y.unit = scale.unit;
        let x = x.into_iter().map(|x| x * time.factor).collect();
        figure.tables = vec![Table { x, series }];
        Some(figure)
    }
}
