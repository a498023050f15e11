//! The figures as SVG and PNG files.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Mutex;
use std::thread;

use kuva::backend::svg::SvgBackend;
use kuva::plot::BandPlot;
use kuva::plot::annotations::ShadedRegion;
use kuva::plot::legend::{LegendEntry, LegendPosition, LegendShape};
use kuva::plot::line::{LinePlot, LineStyle};
use kuva::plot::lollipop::LollipopPlot;
use kuva::render::figure::Figure as Sheet;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::{Primitive, Scene, render_multiple};
use kuva::render::theme::Theme;

use super::figure::{Abscissa, Figure, Section, Series, Shape, Table};
use super::quantity::fine_number;
use super::{dashes, decimate, raster};
use crate::error::Error;
use crate::files;

/// Colour-blind safe (Okabe and Ito 2008, the yellows darkened), index = style of a series.
pub(crate) const COLOURS: [&str; 13] = [
    "#1b1f24", "#0072b2", "#d55e00", "#009e73", "#a9548a", "#b27c00", "#56b4e9", "#7d8590",
    "#7a3b00", "#4c3a9e", "#c2255c", "#5c8001", "#00707c",
];
/// Dash patterns, index = style of a series; a curve alone is solid.
const DASHES: [&str; 13] = [
    "",
    "",
    "9 4",
    "2 3",
    "9 3 2 3",
    "14 5",
    "5 2",
    "1 2",
    "12 3 2 3 2 3",
    "4 4",
    "16 3 4 3",
    "7 2 2 2",
    "10 2 4 2",
];
/// Bins per curve in a picture.
const BINS: usize = 600;
/// Stems per picture, and bands.
const STEMS: usize = 1000;
/// Of the bands of closed contact.
const BAND_OPACITY: f64 = 0.25;
/// Their colour under that opacity on white.
const BAND_IN_LEGEND: &str = "#bfe7dc";
/// Width of a usual line.
const LINE: f64 = 1.5;
/// Panels in the overview.
const PANELS: usize = 12;
/// Columns of a sheet of small panels, and the size of one.
const SMALL_COLUMNS: usize = 3;
const SMALL_PANEL: (f64, f64) = (420.0, 300.0);
/// Of the area between the smallest and the largest value.
const AREA_OPACITY: f64 = 0.18;
/// Of areas that lie on each other.
const STACK_OPACITY: f64 = 0.55;
/// Size of a panel and of a single picture before scaling.
const PANEL: (f64, f64) = (560.0, 380.0);
/// Room at the sides of a picture, so that labels touch neither numbers nor the edge.
const ROOM_LEFT: f64 = 6.0;
const ROOM_RIGHT: f64 = 14.0;
/// Pixels per unit of size.
const SCALE: f32 = 1.25;

/// Writes a picture of every figure that is to have one, and of all of them together.
pub(super) fn write(dir: &Path, figures: &[Figure]) -> Result<(), Error> {
    let pictured: Vec<&Figure> = figures.iter().filter(|f| f.picture && has_data(f)).collect();
    if pictured.is_empty() {
        return Ok(());
    }
    fs::create_dir_all(dir).map_err(|e| Error::io(dir, "create", e))?;
    let over_time: Vec<&Figure> =
        pictured.iter().copied().filter(|f| f.abscissa == Abscissa::Time).collect();
    let span = span(&over_time);
    let mut jobs = Vec::new();
    let mut used = BTreeMap::new();
    let (alone, grouped): (Vec<&Figure>, Vec<&Figure>) =
        pictured.into_iter().partition(|f| f.group.is_empty());
    for group in grouped.chunk_by(|a, b| a.group == b.group) {
        let name = group[0].group.split(',').next().unwrap_or_default().replace(' ', "-");
        let stem = format!("envelope-{}", name.to_lowercase());
        jobs.push((file_stem(&stem, &mut used), sheet(group)));
    }
    for figure in alone {
        jobs.push((file_stem(&figure.id, &mut used), single(figure, span)));
    }
    let main: Vec<&Figure> = over_time
        .into_iter()
        .filter(|f| matches!(f.section, Section::Impact | Section::Balance))
        .collect();
    if !main.is_empty() {
        jobs.push(("overview".to_owned(), overview(&main, span))); // the longest, taken first
    }
    let n_jobs = jobs.len();
    let jobs = Mutex::new(jobs);
    let next = || jobs.lock().ok()?.pop();
    let work = || -> Result<(), Error> {
        while let Some((stem, scene)) = next() {
            draw(dir, &stem, scene)?;
        }
        Ok(())
    };
    let workers = thread::available_parallelism().map_or(1, usize::from).min(n_jobs).min(4);
    thread::scope(|scope| {
        // This thread is one of them, the only one where no others can be started.
        let start = |_| thread::Builder::new().spawn_scoped(scope, work).ok();
        let handles: Vec<_> = (1..workers).map_while(start).collect();
        let fault = || Error::content(dir, "drawing failed");
        work()?;
        handles.into_iter().try_for_each(|h| h.join().unwrap_or_else(|_| Err(fault())))
    })
}

/// Draws a scene as `<stem>.svg` and `<stem>.png`.
pub(crate) fn draw(dir: &Path, stem: &str, scene: Scene) -> Result<(), Error> {
    let svg = SvgBackend::new().render_scene(&scene);
    files::write(&dir.join(format!("{stem}.svg")), svg.as_bytes())?;
    let path = dir.join(format!("{stem}.png"));
    let png = raster::png(dashes::cut(scene), SCALE)
        .map_err(|e| Error::content(&path, format!("cannot be drawn: {e}")))?;
    files::write(&path, &png)
}

pub(super) fn has_data(figure: &Figure) -> bool {
    let drawn = |t: &&Table| t.series.iter().any(|s| s.shape != Shape::Band);
    figure.tables.iter().filter(drawn).any(|t| !t.x.is_empty())
}

/// A name any file system takes; a second figure of the same name gets a number.
fn file_stem(id: &str, used: &mut BTreeMap<String, usize>) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '_' };
    let stem: String = id.chars().map(plain).take(80).collect();
    let count = used.entry(stem.to_lowercase()).or_insert(0);
    *count += 1;
    if *count == 1 { stem } else { format!("{stem}-{count}") }
}

/// A figure alone; `span` is that of all figures over time.
pub(crate) fn single(figure: &Figure, span: (f64, f64)) -> Scene {
    let layout = layout(figure, span).with_width(PANEL.0).with_height(PANEL.1);
    with_room(render_multiple(plots(figure), layout))
}

/// Small panels on one sheet.
fn sheet(figures: &[&Figure]) -> Scene {
    let columns = figures.len().min(SMALL_COLUMNS);
    let titled = |f: &Figure| layout(f, (0.0, 0.0)).with_title(f.title.clone());
    let scene = Sheet::new(figures.len().div_ceil(columns), columns)
        .with_title(figures[0].group.clone())
        .with_plots(figures.iter().map(|f| plots(f)).collect())
        .with_layouts(figures.iter().map(|f| titled(f)).collect())
        .with_cell_size(SMALL_PANEL.0, SMALL_PANEL.1)
        .render();
    with_room(scene)
}

/// All panels on one sheet, lettered as in a paper.
fn overview(figures: &[&Figure], span: (f64, f64)) -> Scene {
    let shown = &figures[..figures.len().min(PANELS)];
    let columns = if shown.len() == 1 { 1 } else { 2 };
    let rows = shown.len().div_ceil(columns);
    let scene = Sheet::new(rows, columns)
        .with_plots(shown.iter().map(|f| plots(f)).collect())
        .with_layouts(shown.iter().map(|f| layout(f, span)).collect())
        .with_labels_lowercase()
        .with_cell_size(PANEL.0, PANEL.1)
        .render();
    with_room(scene)
}

/// The scene with room at its sides, the upright labels farther from the numbers beside them.
pub(crate) fn with_room(mut scene: Scene) -> Scene {
    for element in &mut scene.elements {
        if let Primitive::Text { x, rotate: Some(_), .. } = element {
            *x -= ROOM_LEFT;
        }
    }
    let transform = Some(format!("translate({ROOM_LEFT},0)"));
    let group = Primitive::GroupStart { transform, title: None, extra_attrs: None };
    scene.elements.insert(0, group);
    scene.elements.push(Primitive::GroupEnd);
    scene.width += ROOM_LEFT + ROOM_RIGHT;
    scene
}

/// First and last abscissa of all figures, a hair more so that the last tick is there.
pub(super) fn span(figures: &[&Figure]) -> (f64, f64) {
    let all = figures.iter().flat_map(|f| &f.tables).flat_map(|t| t.x.iter().copied());
    let (low, high) =
        all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    (low, high + 1e-6 * (high - low))
}

pub(super) fn layout(figure: &Figure, span: (f64, f64)) -> Layout {
    let mut layout = Layout::auto_from_plots(&plots(figure))
        .with_title(figure.title.clone())
        .with_x_label(figure.x.caption())
        .with_y_label(figure.y.caption())
        .with_tick_format(TickFormat::Custom(std::sync::Arc::new(fine_number)))
        .with_theme(theme())
        .with_title_size(15)
        .with_label_size(13)
        .with_tick_size(12)
        .with_body_size(12);
    let span = if figure.abscissa == Abscissa::Own { self::span(&[figure]) } else { span };
    if span.1 > span.0 {
        layout = layout.with_x_axis_min(span.0).with_x_axis_max(span.1);
    }
    if let Some((low, high)) = figure.y_range.or_else(|| padded(figure)) {
        layout = layout.with_y_axis_min(low).with_y_axis_max(high);
    }
    if figure.from_zero {
        layout = layout.with_y_axis_min(0.0);
    }
    for (from, to) in bands(figure) {
        let region = ShadedRegion::vertical(from, to).with_color(COLOURS[3]);
        layout = layout.with_shaded_region(region.with_opacity(BAND_OPACITY));
    }
    let entries = legend(figure);
    if entries.len() < 2 {
        return layout; // the axis says it already
    }
    layout
        .with_legend_entries(entries)
        .with_legend_position(LegendPosition::OutsideBottomColumns)
        .with_legend_box(false)
}

/// Spans of the abscissa that are shaded.
fn bands(figure: &Figure) -> Vec<(f64, f64)> {
    let is_band = |t: &&Table| t.series.iter().any(|s| s.shape == Shape::Band);
    let pairs = figure.tables.iter().filter(is_band).flat_map(|t| t.x.chunks_exact(2));
    pairs.map(|pair| (pair[0], pair[1])).filter(|b| b.0 < b.1).take(STEMS).collect()
}

/// Range for values that differ by next to nothing, which is not worth enlarging.
fn padded(figure: &Figure) -> Option<(f64, f64)> {
    let values = figure.tables.iter().flat_map(|t| &t.series).filter(|s| s.shape != Shape::Band);
    let values = values.flat_map(|s| s.y.iter().copied());
    let (low, high) = values
        .filter(|y| y.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    let size = low.abs().max(high.abs());
    if high - low > 1e-5 * size {
        return None;
    }
    if size > 0.0 && size.is_finite() {
        return Some((low - 0.1 * size, high + 0.1 * size));
    }
    Some((-1.0, 1.0)) // nothing but zeros, or nothing at all
}

fn legend(figure: &Figure) -> Vec<LegendEntry> {
    let entry = |s: &Series| LegendEntry {
        label: s.label.clone(),
        color: match s.shape {
            Shape::Band => BAND_IN_LEGEND.to_owned(),
            Shape::Area => lightened(COLOURS[s.style % COLOURS.len()], STACK_OPACITY),
            _ => COLOURS[s.style % COLOURS.len()].to_owned(),
        },
        shape: match s.shape {
            Shape::Band | Shape::Area => LegendShape::Rect,
            _ => LegendShape::Line,
        },
        dasharray: dashes_of(figure, s).map(str::to_owned),
    };
    figure.tables.iter().flat_map(|t| &t.series).map(entry).collect()
}

/// A colour `#rrggbb` at an opacity on white.
fn lightened(colour: &str, opacity: f64) -> String {
    let part =
        |k: usize| u8::from_str_radix(colour.get(k..k + 2).unwrap_or("80"), 16).unwrap_or(128);
    let on_white = |v: u8| (255.0 - opacity * (255.0 - f64::from(v))).round() as u8;
    let [r, g, b] = [1, 3, 5].map(|k| on_white(part(k)));
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The element of a drawing for a page of ours, in the colours of the page: dark where that is.
pub(crate) fn inline_svg(scene: &Scene) -> String {
    let svg = SvgBackend::new().render_scene(scene);
    // Without a view box a browser cuts the drawing instead of scaling it.
    let view = format!("<svg viewBox=\"0 0 {} {}\" ", scene.width, scene.height);
    let svg = if svg.contains("viewBox") { svg } else { svg.replacen("<svg ", &view, 1) };
    let svg = svg.find("<svg").map_or(svg.as_str(), |start| &svg[start..]);
    let pairs = [
        ("\"white\"", "\"var(--page)\""),
        ("\"#ffffff\"", "\"var(--page)\""),
        ("\"#1b1f24\"", "\"var(--text)\""),
        ("\"#e6e9ed\"", "\"var(--grid)\""),
        ("\"#aab2bb\"", "\"var(--c7)\""),
    ];
    pairs.iter().fold(svg.to_owned(), |text, (from, to)| text.replace(from, to))
}

pub(crate) fn theme() -> Theme {
    Theme {
        axis_color: "#1b1f24".to_owned(),
        grid_color: "#e6e9ed".to_owned(),
        tick_color: "#1b1f24".to_owned(),
        text_color: "#1b1f24".to_owned(),
        legend_border: "none".to_owned(),
        ..Theme::light()
    }
}

/// The dash pattern of a series, if it has one in this figure.
fn dashes_of(figure: &Figure, series: &Series) -> Option<&'static str> {
    let pattern = DASHES[series.style % DASHES.len()];
    (figure.is_dashed(series) && !pattern.is_empty()).then_some(pattern)
}

pub(super) fn plots(figure: &Figure) -> Vec<Plot> {
    let drawn = |t: &&Table| !t.x.is_empty();
    let of_table = |table: &Table| -> Vec<Plot> {
        let area = figure.filled.then(|| area(table)).flatten();
        if table.series.iter().any(|s| s.shape == Shape::Area) {
            return stacked(table);
        }
        let curves = table.series.iter().flat_map(|s| plot(&table.x, s, dashes_of(figure, s)));
        area.into_iter().chain(curves).collect()
    };
    figure.tables.iter().filter(drawn).flat_map(of_table).collect()
}

/// The area between the first two curves.
fn area(table: &Table) -> Option<Plot> {
    let [high, low, ..] = table.series.as_slice() else { return None };
    let rows: Vec<usize> = decimate::rows(&[&low.y, &high.y], table.x.len(), BINS)
        .into_iter()
        .filter(|&r| table.x[r].is_finite() && low.y[r].is_finite() && high.y[r].is_finite())
        .collect();
    let pick = |column: &[f64]| -> Vec<f64> { rows.iter().map(|&r| column[r]).collect() };
    let band = BandPlot::new(pick(&table.x), pick(&low.y), pick(&high.y));
    (!rows.is_empty()).then(|| Plot::Band(band.with_color(COLOURS[1]).with_opacity(AREA_OPACITY)))
}

/// Areas lying on each other, and lines over them.
fn stacked(table: &Table) -> Vec<Plot> {
    let columns: Vec<&[f64]> = table.series.iter().map(|s| s.y.as_slice()).collect();
    let rows = decimate::rows(&columns, table.x.len(), BINS / 2);
    let x: Vec<f64> = rows.iter().map(|&r| table.x[r]).collect();
    let mut below = vec![0.0; rows.len()];
    let mut plots = Vec::new();
    for series in table.series.iter().filter(|s| s.shape == Shape::Area) {
        let above: Vec<f64> = rows.iter().zip(&below).map(|(&r, b)| b + series.y[r]).collect();
        let band = BandPlot::new(x.clone(), std::mem::replace(&mut below, above.clone()), above);
        let colour = COLOURS[series.style % COLOURS.len()];
        plots.push(Plot::Band(band.with_color(colour).with_opacity(STACK_OPACITY)));
    }
    let lines = table.series.iter().filter(|s| s.shape != Shape::Area);
    plots.extend(lines.flat_map(|s| plot(&table.x, s, None)));
    plots
}

/// A curve: a line for each run of finite values, or all its stems.
fn plot(x: &[f64], series: &Series, dashes: Option<&str>) -> Vec<Plot> {
    let colour = COLOURS[series.style % COLOURS.len()];
    let bins = match series.shape {
        Shape::Band => return Vec::new(), // part of the layout
        Shape::Stem => STEMS / 4,
        Shape::Line | Shape::Area | Shape::Dots | Shape::Steps => BINS,
    };
    let rows = decimate::rows(&[&series.y], x.len(), bins).into_iter();
    let points: Vec<(f64, f64)> = rows.map(|row| (x[row], series.y[row])).collect();
    let finite = |p: &(f64, f64)| p.0.is_finite() && p.1.is_finite();
    if series.shape == Shape::Stem {
        let points: Vec<(f64, f64)> = points.into_iter().filter(finite).collect();
        let stems = LollipopPlot::new().with_points(points).with_color(colour);
        return vec![Plot::Lollipop(stems.with_stem_width(LINE).with_dot_radius(3.0))];
    }
    let style = || dashes.map_or(LineStyle::Solid, |dash| LineStyle::Custom(dash.to_owned()));
    let line = |run: &[(f64, f64)]| {
        let line = LinePlot::new().with_data(run.to_vec()).with_color(colour);
        Plot::Line(line.with_stroke_width(LINE * series.weight).with_line_style(style()))
    };
    let runs = points.split(|p| !finite(p)).filter(|run| !run.is_empty());
    let lines: Vec<Plot> = runs.map(line).collect();
    if lines.is_empty() { vec![line(&[])] } else { lines }
}
