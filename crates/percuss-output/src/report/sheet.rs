//! Pages other than that of a run: blocks one below the other, with the figures and the looks of the report.

use kuva::plot::contour::ContourPlot;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;

use super::figure::{Abscissa, Axis, Figure, Section, Series, Shape, Table, largest};
use super::html::{self, Cell, escape, table, table_of_cells};
use super::page::frame;
use super::payload;
use super::pictures::{inline_svg, theme};
use super::quantity::Scale;
use super::template::{fill_holes, page_parts};

const TEMPLATE: &str = include_str!("../../web/sheet.html");
/// Size of a map, in the units of the drawing.
const MAP: (f64, f64) = (640.0, 430.0);
/// Cells of a map along each axis.
const CELLS: usize = 48;
/// Points beside a cell that its value is interpolated from.
const NEIGHBOURS: usize = 8;

/// A page.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// Its title.
    pub title: String,
    /// One line below the title.
    pub status: String,
    /// Whether that line is a warning.
    pub alarming: bool,
    /// What stands on it, shape (blocks).
    pub blocks: Vec<Block>,
}

/// A part of a page.
#[derive(Clone, Debug)]
pub enum Block {
    /// A heading.
    Heading(String),
    /// A line of small print.
    Note(String),
    /// A line that nobody should miss.
    Warning(String),
    /// Other pages beside this one.
    Links {
        /// What they are.
        caption: String,
        /// Text and relative address of each, shape (links).
        links: Vec<(String, String)>,
    },
    /// Rows of texts below a header; the first column heads its row.
    Table {
        /// What it shows.
        caption: String,
        /// One entry a column, shape (columns).
        header: Vec<String>,
        /// The rows, shape (rows, columns).
        rows: Vec<Vec<String>>,
    },
    /// Shares from 0 to 1 drawn as bars, with intervals.
    Bars {
        /// What they show.
        caption: String,
        /// One entry a column of bars, shape (columns).
        header: Vec<String>,
        /// Name of the row, and its shares, shape (rows, columns).
        rows: Vec<(String, Vec<Bar>)>,
    },
    /// Figures beside each other, shape (figures).
    Charts(Vec<Chart>),
    /// Coloured maps beside each other, shape (maps).
    Maps(Vec<Map>),
    /// A text behind a summary that opens it.
    Listing {
        /// The summary.
        summary: String,
        /// The text.
        text: String,
    },
}

/// A share from 0 to 1 with an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bar {
    /// The share.
    pub value: f64,
    /// The interval, shape (2) \[-\].
    pub interval: [f64; 2],
}

/// What an axis shows, its values in SI units.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// Label.
    pub label: String,
    /// Unit as channels spell it, `1` for a pure number.
    pub unit: String,
}

/// How the points of a curve are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Joined.
    Line,
    /// A dot each.
    Dots,
    /// Each value holds up to the next abscissa.
    Steps,
}

/// Points of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its name in the legend.
    pub label: String,
    /// Index of its colour.
    pub style: usize,
    /// How it is drawn.
    pub mark: Mark,
    /// Abscissae, shape (points) \[unit of the axis\].
    pub x: Vec<f64>,
    /// Ordinates, shape (points) \[unit of the axis\].
    pub y: Vec<f64>,
}

/// A figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Unique on the page.
    pub id: String,
    /// Title.
    pub title: String,
    /// A line below the title.
    pub note: String,
    /// The abscissa.
    pub x: Quantity,
    /// The ordinate.
    pub y: Quantity,
    /// Whether the y axis starts at zero.
    pub from_zero: bool,
    /// The curves, shape (curves).
    pub curves: Vec<Curve>,
}

/// Values over two abscissae, as colours; between the points they are interpolated.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Title.
    pub title: String,
    /// The abscissa.
    pub x: Quantity,
    /// The ordinate.
    pub y: Quantity,
    /// What the colour shows.
    pub value: Quantity,
    /// Abscissa, ordinate and value of the points, shape (points, 3) \[units of both axes, unit of the value\].
    pub points: Vec<[f64; 3]>,
}

/// The page as HTML, with everything it needs in it.
pub fn render(sheet: &Sheet) -> String {
    let charts = sheet.blocks.iter().filter_map(|block| match block {
        Block::Charts(charts) => Some(charts),
        _ => None,
    });
    let figures: Vec<Figure> = charts.flatten().map(figure).collect();
    let payload = payload::pack(&figures, &[]);
    let class = if sheet.alarming { "status warning" } else { "status" };
    fill_holes(TEMPLATE, |hole| match hole {
        "title" => escape(&sheet.title),
        "status" => format!("<p class=\"{class}\">{}</p>", escape(&sheet.status)),
        "body" => sheet.blocks.iter().map(block).collect(),
        "version" => env!("CARGO_PKG_VERSION").to_owned(),
        "index" => html::json(&payload.index),
        "data" => payload.data.clone(),
        other => page_parts(other),
    })
}

/// `value` of `unit` in words, five significant digits.
pub fn in_words(value: f64, unit: &str) -> String {
    super::quantity::quantity(Some(value), unit)
}

fn block(block: &Block) -> String {
    match block {
        Block::Heading(text) => format!("<h2>{}</h2>\n", escape(text)),
        Block::Note(text) => format!("<p class=\"note\">{}</p>\n", escape(text)),
        Block::Warning(text) => {
            format!("<p class=\"warning\" role=\"note\">{}</p>\n", escape(text))
        }
        Block::Links { caption, links } => {
            let link = |(text, page): &(String, String)| {
                format!("<a href=\"{}\">{}</a>", escape(page), escape(text))
            };
            let links: Vec<String> = links.iter().map(link).collect();
            format!("<p>{}: {}</p>\n", escape(caption), links.join(", "))
        }
        Block::Table { caption, header, rows } => {
            let header: Vec<&str> = header.iter().map(String::as_str).collect();
            format!("<div class=\"tables\">\n{}</div>\n", table(caption, &header, rows))
        }
        Block::Bars { caption, header, rows } => bars(caption, header, rows),
        Block::Charts(charts) => {
            let frames: String = charts.iter().map(|chart| frame(&figure(chart))).collect();
            format!("<div class=\"figures\">\n{frames}</div>\n")
        }
        Block::Maps(maps) => {
            let maps: String = maps.iter().map(map).collect();
            format!("<div class=\"figures\">\n{maps}</div>\n")
        }
        Block::Listing { summary, text } => format!(
            "<details>\n<summary>{}</summary>\n<pre><code>{}</code></pre>\n</details>\n",
            escape(summary),
            escape(text)
        ),
    }
}

fn bars(caption: &str, header: &[String], rows: &[(String, Vec<Bar>)]) -> String {
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let cells = |(name, bars): &(String, Vec<Bar>)| {
        let bars = bars.iter().map(|b| Cell::Markup(bar(b)));
        [Cell::Text(name.clone())].into_iter().chain(bars).collect()
    };
    let rows: Vec<Vec<Cell>> = rows.iter().map(cells).collect();
    format!("<div class=\"tables\">\n{}</div>\n", table_of_cells(caption, &header, &rows))
}

fn bar(bar: &Bar) -> String {
    let percent = |share: f64| 100.0 * share.clamp(0.0, 1.0);
    // What rounds to zero is zero, without a sign.
    let rounded = |share: f64| (1e3 * share).round() / 1e3 + 0.0;
    let [low, high] = bar.interval.map(rounded);
    let (from, to) = (percent(low), percent(high));
    format!(
        "<span class=\"bar\"><i style=\"width:{:.2}%\"></i><b style=\"left:{from:.2}%;width:{:.2}%\"></b></span> \
         {:.3} <span class=\"more\">({low:.3} to {high:.3})</span>",
        percent(bar.value),
        (to - from).max(0.4),
        rounded(bar.value),
    )
}

fn figure(chart: &Chart) -> Figure {
    let scale = |quantity: &Quantity, values: &dyn Fn(&Curve) -> Vec<f64>| {
        let all: Vec<f64> = chart.curves.iter().flat_map(values).collect();
        Scale::new(largest(&all), &quantity.unit)
    };
    let (x, y) = (scale(&chart.x, &|c| c.x.clone()), scale(&chart.y, &|c| c.y.clone()));
    let axis = Axis { label: chart.x.label.clone(), unit: x.unit.clone() };
    let mut figure = Figure::new(Section::Points, &chart.id, &chart.title, axis, &chart.y.label);
    figure.abscissa = Abscissa::Own;
    figure.from_zero = chart.from_zero;
    figure.note.clone_from(&chart.note);
    figure.y.unit.clone_from(&y.unit);
    figure.tables =
        chart.curves.iter().map(|curve| curve_table(curve, x.factor, y.factor)).collect();
    figure
}

/// The points of a curve from left to right.
fn curve_table(curve: &Curve, x_factor: f64, y_factor: f64) -> Table {
    let mut points: Vec<(f64, f64)> =
        curve.x.iter().copied().zip(curve.y.iter().copied()).collect();
    points.retain(|(x, y)| x.is_finite() && y.is_finite());
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let shape = match curve.mark {
        Mark::Line => Shape::Line,
        Mark::Dots => Shape::Dots,
        Mark::Steps => Shape::Steps,
    };
    let series = Series {
        label: curve.label.clone(),
        style: curve.style,
        weight: 1.0,
        dashed: false,
        shape,
        y: points.iter().map(|point| point.1 * y_factor).collect(),
    };
    Table { x: points.iter().map(|point| point.0 * x_factor).collect(), series: vec![series] }
}

fn map(map: &Map) -> String {
    let column = |k: usize| map.points.iter().map(move |point| point[k]);
    let scale = |k: usize, quantity: &Quantity| {
        let values: Vec<f64> = column(k).collect();
        Scale::new(largest(&values), &quantity.unit)
    };
    let scales = [scale(0, &map.x), scale(1, &map.y), scale(2, &map.value)];
    let caption = |k: usize, quantity: &Quantity| {
        Axis { label: quantity.label.clone(), unit: scales[k].unit.clone() }.caption()
    };
    let scaled =
        |point: &[f64; 3]| -> [f64; 3] { std::array::from_fn(|k| point[k] * scales[k].factor) };
    let points: Vec<[f64; 3]> = map.points.iter().map(scaled).collect();
    let Grid { x, y, z } = on_grid(&points).unwrap_or_else(|| interpolated(&points));
    let plot = ContourPlot::new().with_grid(z, x, y).with_filled().with_n_levels(12);
    let plots = vec![Plot::Contour(plot.with_legend(caption(2, &map.value)))];
    let layout = Layout::auto_from_plots(&plots)
        .with_width(MAP.0)
        .with_height(MAP.1)
        .with_x_label(caption(0, &map.x))
        .with_y_label(caption(1, &map.y))
        .with_theme(theme());
    let scene = render_multiple(plots, layout);
    let svg = inline_svg(&scene);
    let (title, caption) = (escape(&map.title), escape(&caption(2, &map.value)));
    format!(
        "<figure><figcaption><h3>{title}</h3><p>Colour: {caption}.</p></figcaption>\
         <div class=\"sheet\">{svg}</div></figure>\n"
    )
}

/// Values over two abscissae.
struct Grid {
    /// Abscissae of the columns, shape (n_x) \[unit of the axis\].
    x: Vec<f64>,
    /// Ordinates of the rows, shape (n_y) \[unit of the axis\].
    y: Vec<f64>,
    /// Row by row, shape (n_y, n_x) \[unit of the value\].
    z: Vec<Vec<f64>>,
}

/// The points as they are, where they make a full grid.
fn on_grid(points: &[[f64; 3]]) -> Option<Grid> {
    let places = |k: usize| {
        let mut all: Vec<f64> = points.iter().map(|point| point[k]).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    };
    let (x, y) = (places(0), places(1));
    if x.len() * y.len() != points.len() {
        return None;
    }
    let at = |places: &[f64], value: f64| places.binary_search_by(|p| p.total_cmp(&value)).ok();
    let mut z = vec![vec![f64::NAN; x.len()]; y.len()];
    for point in points {
        z[at(&y, point[1])?][at(&x, point[0])?] = point[2];
    }
    z.iter().flatten().all(|value| value.is_finite()).then_some(Grid { x, y, z })
}

/// Places of the cells along an axis.
fn cells(points: &[[f64; 3]], k: usize) -> Vec<f64> {
    let low = points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
    let high = points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
    let at = |i: usize| low + (high - low) * i as f64 / (CELLS - 1) as f64;
    (0..CELLS).map(at).collect()
}

/// Values at the cells by the nearest points, each weighted by the inverse square of its distance (Shepard 1968).
fn interpolated(points: &[[f64; 3]]) -> Grid {
    let (x, y) = (cells(points, 0), cells(points, 1));
    let width = (x[CELLS - 1] - x[0]).max(f64::MIN_POSITIVE);
    let height = (y[CELLS - 1] - y[0]).max(f64::MIN_POSITIVE);
    let value = |x: f64, y: f64| {
        let mut near: Vec<(f64, f64)> = points
            .iter()
            .map(|p| (((p[0] - x) / width).powi(2) + ((p[1] - y) / height).powi(2), p[2]))
            .collect();
        if near.len() > NEIGHBOURS {
            near.select_nth_unstable_by(NEIGHBOURS, |a, b| a.0.total_cmp(&b.0));
            near.truncate(NEIGHBOURS);
        }
        let weight = |square: f64| 1.0 / (square + 1e-9);
        let sum: f64 = near.iter().map(|(square, value)| weight(*square) * value).sum();
        sum / near.iter().map(|(square, _)| weight(*square)).sum::<f64>()
    };
    let z = y.iter().map(|&y| x.iter().map(|&x| value(x, y)).collect()).collect();
    Grid { x, y, z }
}
