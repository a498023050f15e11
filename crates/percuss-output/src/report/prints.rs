//! Figures of a run for print, as wide as a column of a paper.

use kuva::backend::svg::SvgBackend;
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::render::render::{Primitive, Scene, TextAnchor, render_multiple};

use super::data::ReportData;
use super::figure::{Abscissa, Axis, Figure, Section, Series, Shape, Table};
use super::figures;
use super::pictures::{has_data, layout, plots, span, with_room};
use super::quantity::Scale;
use crate::error::Error;
use crate::history::HistoryReader;
use crate::shock::{self, Acceleration, Cfc, Frame, ShockError, Signal};

/// Units of a drawing in a millimetre: 96 an inch.
const UNITS: f64 = 96.0 / 25.4;
/// Sizes of letters: 9, 8.25 and 8.25 points, whatever the width.
const TITLE: u32 = 12;
const LABELS: u32 = 11;
/// Width of a letter beside its size, about: that of the font's small letters, and some more.
const LETTER: f64 = 0.6;
/// Height of a line of the legend beside the size of its letters.
const ROW: f64 = 1.4;
/// What a curve's line and the room behind it take in the legend.
const SAMPLE: f64 = 30.0;
/// Room at the sides of texts.
const SIDE: f64 = 4.0;
/// Height of the axes beside their width.
const ASPECT: f64 = 0.62;

/// A figure that can be printed.
#[derive(Debug)]
pub struct Print {
    figure: Figure,
    span: (f64, f64),
}

/// The figures of a run that have something to show, in the order of the page.
///
/// # Errors
/// If the history cannot be read.
pub fn prints(data: &ReportData) -> Result<Vec<Print>, Error> {
    let all: Vec<Figure> = figures::all(data)?.into_iter().filter(has_data).collect();
    let over_time: Vec<&Figure> = all.iter().filter(|f| f.abscissa == Abscissa::Time).collect();
    let span = span(&over_time);
    Ok(all.into_iter().map(|figure| Print { figure, span }).collect())
}

/// Figures of the accelerations of a run, one a recorded point or projectile, filtered in a channel frequency class.
///
/// # Errors
/// If the history cannot be read, or the inner one if its sampling is too coarse for the class.
pub fn accelerations(
    history: &HistoryReader,
    class: Cfc,
) -> Result<Result<Vec<Print>, ShockError>, Error> {
    let mut curves: Vec<(Acceleration, Signal)> = Vec::new();
    for one in shock::accelerations(history.channels()) {
        let columns = history.columns(&["time", &one.velocity])?;
        let signal = Signal::from_velocity(&columns[0], &columns[1]);
        match signal.and_then(|signal| shock::filtered(&signal, class)) {
            Ok(signal) => curves.push((one, signal)),
            Err(error) => return Ok(Err(error)),
        }
    }
    let of_one = |a: &(Acceleration, _), b: &(Acceleration, _)| {
        (&a.0.owner, a.0.frame) == (&b.0.owner, b.0.frame)
    };
    Ok(Ok(curves.chunk_by(of_one).map(|of| acceleration(of, class)).collect()))
}

/// The components of one acceleration over time.
fn acceleration(curves: &[(Acceleration, Signal)], class: Cfc) -> Print {
    let end = curves.iter().filter_map(|c| c.1.times().last()).fold(0.0, f64::max);
    let scale = Scale::new(end, "s");
    let Acceleration { owner, frame, .. } = &curves[0].0;
    let name = owner.split_once('.').map_or(owner.as_str(), |(_, name)| name);
    let (what, behind, mark) = match frame {
        Frame::Rest => ("Acceleration", "", ""),
        Frame::Base => ("Acceleration", " relative to the base", ""),
        Frame::Absolute => ("Absolute acceleration", "", "absolute-"),
    };
    let title = format!("{what} of {name}{behind} (CFC {})", class.number());
    let axis = Axis { label: "time".to_owned(), unit: scale.unit.clone() };
    let id = format!("{mark}acceleration-{name}");
    let mut figure = Figure::new(Section::Points, &id, &title, axis, "acceleration");
    figure.y.unit = "m/s\u{b2}".to_owned();
    let table = |(k, (one, signal)): (usize, &(Acceleration, Signal))| Table {
        x: signal.times().map(|t| t * scale.factor).collect(),
        series: vec![Series {
            label: format!("along {}", if one.axis == "1" { "x" } else { "y" }),
            style: k + 1,
            weight: 1.0,
            dashed: true,
            shape: Shape::Line,
            y: signal.values.clone(),
        }],
    };
    figure.tables = curves.iter().enumerate().map(table).collect();
    let span = span(&[&figure]);
    Print { figure, span }
}

impl Print {
    /// Its id on the page, which is also the name of its files.
    pub fn id(&self) -> &str {
        &self.figure.id
    }

    /// Its title.
    pub fn title(&self) -> &str {
        &self.figure.title
    }

    /// The figure as SVG, so many millimetres wide.
    pub fn svg(&self, width: f64, titled: bool) -> String {
        let width = width * UNITS;
        // What the numbers beside the axis take is known when they are laid out.
        let first = self.axes(width);
        let axes = self.axes(2.0 * width - first.width);
        SvgBackend::new().render_scene(&self.sheet(axes, titled))
    }

    /// The curves in their axes. The label of the ordinate is above them and the legend below: beside a narrow figure, and in columns
    /// of their own, they would leave no room for the curves.
    fn axes(&self, width: f64) -> Scene {
        let mut sized = layout(&self.figure, self.span)
            .with_title_size(TITLE)
            .with_label_size(LABELS)
            .with_tick_size(LABELS)
            .with_body_size(LABELS)
            .with_width(width)
            .with_height(ASPECT * width);
        (sized.title, sized.y_label, sized.legend_entries) = (None, None, None);
        sized.show_legend = false;
        with_room(render_multiple(plots(&self.figure), sized))
    }

    /// Title and ordinate, axes, legend, one below the other.
    fn sheet(&self, axes: Scene, titled: bool) -> Scene {
        let width = axes.width;
        let mut sheet = Scene::new(width, axes.height);
        sheet.background_color.clone_from(&axes.background_color);
        sheet.text_color.clone_from(&axes.text_color);
        sheet.font_family.clone_from(&axes.font_family);
        let mut y = SIDE;
        let title = if titled { self.figure.title.as_str() } else { "" };
        for (text, size) in [(title, TITLE), (self.figure.y.caption().as_str(), LABELS)] {
            for line in wrapped(text, width - 2.0 * SIDE, size) {
                y += f64::from(size);
                sheet.add(text_at([SIDE, y], &line, size));
                y += 0.3 * f64::from(size);
            }
        }
        let transform = Some(format!("translate(0,{y})"));
        sheet.add(Primitive::GroupStart { transform, title: None, extra_attrs: None });
        y += axes.height;
        axes.elements.into_iter().for_each(|element| sheet.add(element));
        sheet.add(Primitive::GroupEnd);
        sheet.height = self.legend(&mut sheet, y);
        sheet
    }

    /// Draws the legend below a height; where it ends.
    fn legend(&self, sheet: &mut Scene, mut y: f64) -> f64 {
        let entries = layout(&self.figure, self.span).legend_entries.unwrap_or_default();
        let size = f64::from(LABELS);
        let (mut x, right) = (SIDE, sheet.width - SIDE);
        y += 0.5 * size;
        let mut below = 0.0; // lines that the entries of a row go down
        for entry in &entries {
            let lines = wrapped(&entry.label, right - SIDE - SAMPLE, LABELS);
            let longest = lines.iter().map(|line| length(line, LABELS)).fold(0.0, f64::max);
            if x > SIDE && (x + SAMPLE + longest > right || lines.len() > 1) {
                (x, y, below) = (SIDE, y + ROW * size * (1.0 + below), 0.0);
            }
            below = f64::max(below, lines.len().saturating_sub(1) as f64);
            sheet.add(sample(entry, [x, y]));
            for (k, line) in lines.iter().enumerate() {
                let at = [x + SAMPLE, y + 0.35 * size + k as f64 * ROW * size];
                sheet.add(text_at(at, line, LABELS));
            }
            x += SAMPLE + longest + 1.5 * size;
        }
        y + if entries.is_empty() { 0.0 } else { ROW * size * (1.0 + below) }
    }
}

/// Line or patch of an entry, at the height of its text's middle.
fn sample(entry: &LegendEntry, [x, y]: [f64; 2]) -> Primitive {
    match entry.shape {
        LegendShape::Rect => Primitive::Rect {
            x,
            y: y - 4.0,
            width: SAMPLE - 8.0,
            height: 8.0,
            fill: entry.color.as_str().into(),
            stroke: None,
            stroke_width: None,
            opacity: None,
        },
        _ => Primitive::Line {
            x1: x,
            y1: y,
            x2: x + SAMPLE - 8.0,
            y2: y,
            stroke: entry.color.as_str().into(),
            stroke_width: 1.5,
            stroke_dasharray: entry.dasharray.clone(),
        },
    }
}

fn text_at([x, y]: [f64; 2], text: &str, size: u32) -> Primitive {
    Primitive::Text {
        x,
        y,
        content: text.to_owned(),
        size,
        anchor: TextAnchor::Start,
        rotate: None,
        bold: false,
        color: None,
    }
}

/// About how long a text is.
fn length(text: &str, size: u32) -> f64 {
    LETTER * f64::from(size) * text.chars().count() as f64
}

/// A text in lines that fit a width, broken between words.
fn wrapped(text: &str, width: f64, size: u32) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line)
                if length(line, size) + length(word, size) + LETTER * f64::from(size) <= width =>
            {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn print(labels: &[&str]) -> Print {
        let axis = Axis { label: "time".into(), unit: "ms".into() };
        let mut figure = Figure::new(
            Section::Impact,
            "id",
            "A title <of> some & length",
            axis,
            "displacement in the initial direction of motion",
        );
        let series = |label: &&str| Series {
            label: (*label).to_owned(),
            style: 1,
            weight: 1.0,
            dashed: false,
            shape: Shape::Line,
            y: vec![0.0, 1.0],
        };
        figure.tables =
            vec![Table { x: vec![0.0, 1.0], series: labels.iter().map(series).collect() }];
        Print { figure, span: (0.0, 1.0) }
    }

    fn number(svg: &str, attribute: &str) -> f64 {
        let rest = svg.split_once(&format!(" {attribute}=\"")).unwrap().1;
        rest.split_once('"').unwrap().0.parse().unwrap()
    }

    #[test]
    fn a_figure_is_as_wide_as_asked_for_whatever_its_labels() {
        for width in [60.0, 85.0, 174.0] {
            for labels in [&["a"][..], &["a long label of a curve that goes on and on", "b", "c"]] {
                let svg = print(labels).svg(width, true);
                let wide = number(&svg, "width");
                assert!((wide - width * UNITS).abs() < 0.5, "{wide} for {width} mm");
                assert!(svg.contains("A title &lt;of&gt;"), "{svg}");
                assert!(number(&svg, "height") > 0.6 * wide);
            }
        }
        assert!(!print(&["a"]).svg(85.0, false).contains("A title"));
    }

    #[test]
    fn texts_break_between_words() {
        assert_eq!(wrapped("one two three", length("one two", 10), 10), ["one two", "three"]);
        assert!(wrapped("", 100.0, 10).is_empty());
    }
}
