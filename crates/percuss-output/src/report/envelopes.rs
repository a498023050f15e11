//! Extremes of section forces along beams: one small figure a beam and quantity, all of a quantity at one scale.

use percuss::Envelope;

use super::decimate;
use super::figure::{Abscissa, Axis, Figure, Section, Series, Shape, Table, largest};
use super::quantity::Scale;
use crate::envelopes::BeamEnvelope;
use crate::round_off::ROUND_OFF;
use crate::shown::LARGE_FIGURES;

/// So many beams get figures of the usual size.
const FULL_SIZE: usize = 2;
/// Bins along a beam.
const BINS: usize = 150;

/// A quantity: smallest and largest values along a beam.
struct Quantity {
    id: &'static str,
    title: &'static str,
    unit: &'static str,
    of: fn(&Envelope) -> &[Vec<f64>; 2],
}

const QUANTITIES: [Quantity; 4] = [
    Quantity { id: "axial", title: "Axial force", unit: "N", of: |e| &e.axial },
    Quantity { id: "shear", title: "Shear force", unit: "N", of: |e| &e.shear },
    Quantity { id: "moment", title: "Bending moment", unit: "N*m", of: |e| &e.moment },
    Quantity { id: "stress", title: "Fibre stress", unit: "Pa", of: |e| &e.stress },
];

/// All of them, quantity after quantity.
pub(super) fn figures(beams: &[BeamEnvelope]) -> Vec<Figure> {
    let size = |of: fn(&Envelope) -> &[Vec<f64>; 2]| {
        largest(beams.iter().flat_map(|b| of(&b.envelope)).flatten())
    };
    // Axial and shear forces are measured by each other: alone they might be round-off.
    let force = size(|e| &e.axial).max(size(|e| &e.shear));
    let worth = |q: &&Quantity| {
        let floor = if q.unit == "N" { ROUND_OFF * force } else { 0.0 };
        size(q.of) > floor
    };
    QUANTITIES.iter().filter(worth).flat_map(|q| of_quantity(q, beams)).collect()
}

fn of_quantity(quantity: &Quantity, beams: &[BeamEnvelope]) -> Vec<Figure> {
    let size = |b: &BeamEnvelope| largest((quantity.of)(&b.envelope).iter().flatten());
    let shown = most_loaded(beams, size);
    let scale = Scale::new(shown.iter().map(|b| size(b)).fold(0.0, f64::max), quantity.unit);
    let length = shown.iter().map(|b| largest(&b.envelope.s)).fold(0.0, f64::max);
    let along = Scale::new(length, "m");
    let values = shown.iter().flat_map(|b| (quantity.of)(&b.envelope)).flatten();
    let (low, high) = values
        .filter(|v| v.is_finite())
        .fold((0.0_f64, 0.0_f64), |(low, high), v| (low.min(*v), high.max(*v)));
    let room = 0.06 * (high - low);
    let range = ((low - room) * scale.factor, (high + room) * scale.factor);
    let small = shown.len() > FULL_SIZE;
    let note = match beams.len() > shown.len() {
        true => format!("the {LARGE_FIGURES} of {} beams with the largest values", beams.len()),
        false => String::new(),
    };
    let figure = |beam: &&BeamEnvelope| {
        let title = format!("{} of {}", quantity.title, beam.name);
        let id = format!("envelope-{}-{}", quantity.id, beam.name);
        let x = Axis { label: "arc length".to_owned(), unit: along.unit.clone() };
        let label = quantity.title.to_lowercase();
        let mut figure = Figure::new(Section::Envelopes, &id, &title, x, &label);
        figure.picture = true;
        figure.abscissa = Abscissa::Own;
        figure.y.unit = scale.unit.clone();
        figure.y_range = Some(range);
        figure.filled = true;
        figure.note.clone_from(&note);
        if small {
            figure.title.clone_from(&beam.name);
            figure.group = format!("{}, envelope over time", quantity.title);
        }
        figure.tables = vec![table(beam, quantity, along.factor, scale.factor)];
        figure
    };
    shown.iter().map(figure).collect()
}

/// The beams of the largest values, in the model's order.
fn most_loaded(beams: &[BeamEnvelope], size: impl Fn(&BeamEnvelope) -> f64) -> Vec<&BeamEnvelope> {
    let mut order: Vec<usize> = (0..beams.len()).filter(|&k| size(&beams[k]) > 0.0).collect();
    order.sort_by(|&a, &b| size(&beams[b]).total_cmp(&size(&beams[a])));
    order.truncate(LARGE_FIGURES);
    order.sort_unstable();
    order.into_iter().map(|k| &beams[k]).collect()
}

fn table(beam: &BeamEnvelope, quantity: &Quantity, along: f64, by: f64) -> Table {
    let [low, high] = (quantity.of)(&beam.envelope);
    let s = &beam.envelope.s;
    let rows = decimate::rows(&[low, high], s.len(), BINS);
    let pick = |column: &[f64], by: f64| rows.iter().map(|&r| column[r] * by).collect();
    let series = |label: &str, style: usize, column: &[f64]| Series {
        label: label.to_owned(),
        style,
        weight: 1.0,
        dashed: true,
        shape: Shape::Line,
        y: pick(column, by),
    };
    Table {
        x: pick(s, along),
        series: vec![series("largest", 1, high), series("smallest", 2, low)],
    }
}
