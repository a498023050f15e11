//! Figures of a run for print, as wide as a column of a paper.

use kuva::backend::svg::SvgBackend;
use kuva::render::layout::Layout;
use kuva::render::render::{Scene, render_multiple};

use super::ReportData;
use super::figure::{Abscissa, Figure};
use super::figures;
use super::pictures::{has_data, layout, plots, span, with_room};
use crate::error::Error;

/// Units of a drawing in a millimetre: 96 an inch.
const UNITS: f64 = 96.0 / 25.4;
/// Sizes of letters: 9, 8.25 and 8.25 points, whatever the width.
const TITLE: u32 = 12;
const LABELS: u32 = 11;
/// Height of a figure beside its width.
const ASPECT: f64 = 0.68;

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
        // What the labels beside the axes take is known when they are laid out.
        let first = self.scene(width, titled);
        let scene = self.scene(2.0 * width - first.width, titled);
        SvgBackend::new().render_scene(&scene)
    }

    fn scene(&self, width: f64, titled: bool) -> Scene {
        let sized: Layout = layout(&self.figure, self.span)
            .with_title_size(TITLE)
            .with_label_size(LABELS)
            .with_tick_size(LABELS)
            .with_body_size(LABELS)
            .with_width(width)
            .with_height(ASPECT * width);
        let sized = if titled { sized } else { sized.with_title("") };
        with_room(render_multiple(plots(&self.figure), sized))
    }
}
