//! The figures of one projectile and the point it strikes.

use super::figure::{Axis, Canvas, Curve, Figure, Section, Series, Shape, Table, largest};
use super::quantity::Scale;
use super::{decimate, figures};
use crate::history::History;

/// More stems than these are shown as extremes of bins.
const STEMS_SHOWN: usize = 50_000;

/// Displacement, force or impulse, and velocity of projectile `name`.
pub(super) fn figures(
    canvas: &Canvas<'_>,
    history: &History,
    name: &str,
    several: bool,
) -> Vec<Figure> {
    let Some(flight) = Flight::new(history, name) else { return Vec::new() };
    let frame = Frame { canvas, name, several };
    let impulse = history.column(&format!("contact.{name}.impulse"));
    let force = history.column(&format!("contact.{name}.force"));
    let mut all = Vec::new();
    all.extend(displacement(&frame, &flight));
    all.extend(force.map(|force| {
        let (unit, table) = canvas.lines("N", &[Curve::new("contact force", 2, force)]);
        frame.figure("force", "Contact force", "contact force", unit, table)
    }));
    all.extend(impulse.map(|impulse| stems(&frame, impulse)));
    all.extend(velocity(&frame, &flight, impulse.is_some()));
    all
}

/// What the figures of one projectile have in common.
struct Frame<'a> {
    canvas: &'a Canvas<'a>,
    name: &'a str,
    several: bool,
}

impl Frame<'_> {
    fn figure(&self, id: &str, title: &str, label: &str, unit: String, table: Table) -> Figure {
        let (id, title) = if self.several {
            (format!("{id}-{}", self.name), format!("{title}, {}", self.name))
        } else {
            (id.to_owned(), title.to_owned())
        };
        Figure {
            id,
            section: Section::Impact,
            picture: true,
            title,
            x: self.canvas.time_axis(),
            y: Axis { label: label.to_owned(), unit },
            note: String::new(),
            tables: vec![table],
        }
    }
}

/// A projectile along its line of flight.
struct Flight<'a> {
    history: &'a History,
    /// Unit vector of the line of flight.
    direction: [f64; 2],
    /// Way gone since the start, shape (n_rows).
    way: Vec<f64>,
    /// Velocity along the line, shape (n_rows).
    velocity: Vec<f64>,
    gap: &'a [f64],
}

impl<'a> Flight<'a> {
    fn new(history: &'a History, name: &str) -> Option<Self> {
        let column = |what: &str| history.column(&format!("projectile.{name}.{what}"));
        let position = [column("position_1")?, column("position_2")?];
        let velocity = [column("velocity_1")?, column("velocity_2")?];
        let direction = direction(velocity)?;
        let start = position.map(|p| p.first().copied().unwrap_or(f64::NAN));
        let along = |v: [&[f64]; 2], origin: [f64; 2]| -> Vec<f64> {
            let pairs = v[0].iter().zip(v[1]);
            pairs.map(|(x, y)| dot(direction, [x - origin[0], y - origin[1]])).collect()
        };
        Some(Self {
            history,
            direction,
            way: along(position, start),
            velocity: along(velocity, [0.0; 2]),
            gap: history.column(&format!("contact.{name}.gap"))?,
        })
    }

    fn standoff(&self) -> f64 {
        self.gap.first().copied().unwrap_or(0.0)
    }

    /// Displacement of the struck point along the line of flight, by gap and way.
    fn struck(&self) -> Vec<f64> {
        let standoff = self.standoff();
        self.gap.iter().zip(&self.way).map(|(gap, way)| gap + way - standoff).collect()
    }

    /// Velocity of the struck point along the line of flight, if it is among the recorded points:
    /// the one whose displacement agrees with gap and way throughout.
    fn struck_velocity(&self) -> Option<(String, Vec<f64>)> {
        let struck = self.struck();
        let size = largest(&[&struck, &self.way]);
        let stride = (struck.len() / 512).max(1);
        let agrees = |point: &String| {
            let [Some(x), Some(y)] = self.point(point, "displacement") else { return false };
            if x.len().min(y.len()) < struck.len() {
                return false;
            }
            let rows = (0..struck.len()).step_by(stride);
            rows.clone().all(|r| {
                let displacement = dot(self.direction, [x[r], y[r]]);
                (displacement - struck[r]).abs() <= 1e-7 * size
            })
        };
        let points = figures::names(self.history, "point.", ".displacement_1");
        let point = points.into_iter().find(agrees)?;
        let [Some(x), Some(y)] = self.point(&point, "velocity") else { return None };
        let along = x.iter().zip(y).map(|(x, y)| dot(self.direction, [*x, *y])).collect();
        Some((point, along))
    }

    fn point(&self, point: &str, what: &str) -> [Option<&'a [f64]>; 2] {
        [1, 2].map(|i| self.history.column(&format!("point.{point}.{what}_{i}")))
    }
}

/// Direction of the velocity at the start, or else of the largest one.
fn direction(velocity: [&[f64]; 2]) -> Option<[f64; 2]> {
    let size = |r: usize| f64::hypot(velocity[0][r], velocity[1][r]);
    let rows = velocity[0].len().min(velocity[1].len());
    let row = if rows > 0 && size(0) > 0.0 {
        0
    } else {
        (0..rows).max_by(|a, b| size(*a).total_cmp(&size(*b)))?
    };
    let speed = size(row);
    (speed > 0.0 && speed.is_finite()).then(|| velocity.map(|v| v[row] / speed))
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn displacement(frame: &Frame<'_>, flight: &Flight<'_>) -> Option<Figure> {
    let standoff = flight.standoff();
    if !standoff.is_finite() {
        return None;
    }
    let from_touch: Vec<f64> = flight.way.iter().map(|way| way - standoff).collect();
    let struck = flight.struck();
    let curves = [
        Curve::new(format!("projectile {}", frame.name), 1, &from_touch),
        Curve::new("contact point", 2, &struck),
    ];
    let (unit, table) = frame.canvas.lines("m", &curves);
    let figure = frame.figure("displacement", "Displacement", "displacement", unit, table);
    let note =
        "Along the line of flight; the projectile's is measured from where it first touches.";
    Some(Figure { note: note.to_owned(), ..figure })
}

fn velocity(frame: &Frame<'_>, flight: &Flight<'_>, picture: bool) -> Option<Figure> {
    let struck = flight.struck_velocity();
    let mut curves =
        vec![Curve::new(format!("projectile {}", frame.name), 1, flight.velocity.as_slice())];
    if let Some((point, velocity)) = &struck {
        curves.push(Curve::new(format!("contact point {point}"), 2, velocity));
    }
    let (unit, table) = frame.canvas.lines("m/s", &curves);
    let figure = frame.figure("velocity", "Velocity", "velocity", unit, table);
    let note = match struck {
        Some(_) => "Along the line of flight.",
        None => "Along the line of flight; the struck point is not among the recorded points.",
    };
    Some(Figure { picture, note: note.to_owned(), ..figure })
}

/// Impulses where there are any; a run has few, unless a contact stays closed.
fn stems(frame: &Frame<'_>, impulse: &[f64]) -> Figure {
    let canvas = frame.canvas;
    let nonzero: Vec<usize> =
        (0..impulse.len().min(canvas.time.len())).filter(|&r| impulse[r] != 0.0).collect();
    let values: Vec<f64> = nonzero.iter().map(|&r| impulse[r]).collect();
    let few = values.len() <= STEMS_SHOWN;
    let kept = if few {
        (0..values.len()).collect()
    } else {
        decimate::rows(&[&values], values.len(), STEMS_SHOWN / 10)
    };
    let scale = Scale::new(largest(&[&values]), "N*s");
    let series = Series {
        label: "impulse".to_owned(),
        style: 2,
        shape: Shape::Stem,
        y: kept.iter().map(|&k| values[k] * scale.factor).collect(),
    };
    let x = kept.iter().map(|&k| canvas.time[nonzero[k]] * canvas.time_scale.factor).collect();
    let table = Table { x, series: vec![series] };
    let mut figure = frame.figure("impulse", "Impulses", "impulse", scale.unit, table);
    figure.note = match values.len() {
        0 => "No impulse was handed over.".to_owned(),
        _ if few => "Handed over at an instant each; not a force.".to_owned(),
        n => format!("{n} impulses, shown as the extremes of {} bins.", STEMS_SHOWN / 10),
    };
    figure
}
