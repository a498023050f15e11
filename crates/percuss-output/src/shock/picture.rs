//! A shock response spectrum as a picture.

use kuva::backend::svg::SvgBackend;
use kuva::plot::legend::LegendPosition;
use kuva::plot::line::LinePlot;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;

use super::{Extremes, ShockSpectrum};
use crate::report::pictures::{COLOURS, with_room};

/// Size of the picture, in units of 1/96 inch.
const SIZE: [f64; 2] = [560.0, 420.0];

impl ShockSpectrum {
    /// The absolute accelerations over the frequency as SVG, both axes logarithmic.
    pub fn svg(&self, title: &str) -> String {
        let curve = |label: &str, style: usize, of: &dyn Fn(&Extremes) -> f64| {
            let points = self.frequency.iter().zip(&self.acceleration);
            let points: Vec<(f64, f64)> =
                points.map(|(f, a)| (*f, of(a))).filter(|(_, a)| *a > 0.0).collect();
            // A curve without points has no place on logarithmic axes.
            if points.is_empty() {
                return None;
            }
            let line = LinePlot::new().with_data(points).with_legend(label);
            Some(Plot::Line(line.with_color(COLOURS[style]).with_stroke_width(1.5)))
        };
        let curves = [
            curve("maximax", 0, &|a| a.maximax()),
            curve("primary", 1, &|a| a.primary),
            curve("residual", 2, &|a| a.residual),
        ];
        let plots: Vec<Plot> = curves.into_iter().flatten().collect();
        let layout = Layout::auto_from_plots(&plots)
            .with_log_scale()
            .with_title(title)
            .with_x_label("natural frequency [Hz]")
            .with_y_label("absolute acceleration [m/s\u{b2}]")
            .with_legend_position(LegendPosition::OutsideBottomColumns)
            .with_legend_box(false)
            .with_width(SIZE[0])
            .with_height(SIZE[1]);
        SvgBackend::new().render_scene(&with_room(render_multiple(plots, layout)))
    }
}
