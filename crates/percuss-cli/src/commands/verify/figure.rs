//! Figures and sketches of the verification manual.

use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::plot::legend::LegendPosition;
use kuva::plot::line::LinePlot;
use kuva::plot::scatter::ScatterPlot;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;
use kuva::render::theme::Theme;
use percuss::{Frame, Recorder, simulate};
use percuss_output::fields::FrameStore;
use percuss_pictures::{Film, Look};
use percuss_verification::{Curve, Figure};

/// Colours of what Percuss computed, one after the other, and of what it is compared with.
const COMPUTED: [&str; 3] = ["#2b6cb0", "#c05621", "#2f855a"];
const REFERENCE: &str = "#1b1f24";

/// A figure as SVG: computed curves as lines, references as marks; errors over sizes as both.
pub(super) fn drawn(figure: &Figure) -> String {
    let mut plots = Vec::new();
    for (k, curve) in figure.curves.iter().enumerate() {
        let colour = if curve.reference { REFERENCE } else { COMPUTED[k % COMPUTED.len()] };
        if !curve.reference {
            plots.push(Plot::Line(line(curve, colour)));
        }
        if curve.reference || figure.logarithmic {
            plots.push(Plot::Scatter(marks(curve, colour, figure.logarithmic)));
        }
    }
    let layout = Layout::auto_from_plots(&plots)
        .with_title(figure.title.clone())
        .with_x_label(figure.axes[0])
        .with_y_label(figure.axes[1])
        .with_y_label_offset(-14.0, 0.0)
        .with_tick_format(TickFormat::Custom(Arc::new(tick)))
        .with_theme(Theme::light())
        .with_legend_position(LegendPosition::OutsideBottomColumns)
        .with_legend_box(false)
        .with_width(620.0)
        .with_height(400.0);
    let layout = if figure.logarithmic { layout.with_log_scale() } else { layout };
    SvgBackend::new().render_scene(&render_multiple(plots, layout))
}

/// A number on an axis, without what round-off adds.
fn tick(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (1e-2..1e5).contains(&size) {
        let text = format!("{value:.6}");
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    let text = format!("{value:.3e}");
    let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
    format!("{}e{power}", digits.trim_end_matches('0').trim_end_matches('.'))
}

fn line(curve: &Curve, colour: &str) -> LinePlot {
    let points = curve.points.iter().map(|p| (p[0], p[1]));
    LinePlot::new()
        .with_data(points)
        .with_color(colour)
        .with_stroke_width(1.6)
        .with_legend(&*curve.name)
}

fn marks(curve: &Curve, colour: &str, unnamed: bool) -> ScatterPlot {
    let points = curve.points.iter().map(|p| (p[0], p[1]));
    let marks = ScatterPlot::new().with_data(points).with_color(colour).with_size(3.5);
    if unnamed { marks } else { marks.with_legend(&*curve.name) }
}

/// Keeps frames of a run.
struct Frames(FrameStore);

impl Recorder for Frames {
    fn wants_rows(&self) -> bool {
        false
    }

    fn wants_frame(&mut self, time: f64, force: f64, impulse: f64) -> bool {
        self.0.wants(time, force, impulse)
    }

    fn frame(&mut self, frame: &Frame<'_>) {
        self.0.take(frame);
    }
}

/// The scene of a scenario file at its start, as SVG; none where it cannot be drawn.
pub(super) fn sketch(text: &str, name: &str) -> Option<String> {
    let scenario = percuss_scenario::read(text, name).ok()?;
    let compiled = scenario.compile().ok()?;
    // All of the run, for what it reaches has room in the picture then.
    let settings = &compiled.settings;
    let scene = scenario.scene(&compiled.model);
    let mut frames = Frames(FrameStore::new(scene, settings.end, 1.0));
    simulate(&compiled.model, settings, &mut frames).ok()?;
    let look = Look {
        width: 620,
        title: String::new(),
        colour: "none".into(),
        diagram: "none".into(),
        exaggeration: 1.0,
        dark: false,
    };
    let film = Film::open(&frames.0.finish(), &look).ok()?;
    film.svg(0.0, 0.0).ok()
}
