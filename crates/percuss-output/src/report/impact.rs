//! The figures of one projectile and the point it strikes.

use serde_json::Value;

use super::canvas::Canvas;
use super::draft::{Curve, Draft, Entry, Omit};
use super::figure::{Figure, Section, Series, Shape, Table, largest};
use super::quantity::{Scale, quantity};

/// Impacts and contact intervals drawn at most.
const SHOWN: usize = 10_000;

/// Displacement, force or impulse, and velocity of projectile `name`.
pub(super) fn figures(
    canvas: &Canvas<'_>,
    summary: &Value,
    name: &str,
    several: bool,
) -> Vec<Entry> {
    let Some(flight) = Flight::new(canvas, summary, name) else { return Vec::new() };
    let frame = Frame { canvas, name, several };
    let contact = &summary["contact"][name];
    let force = canvas.history.position(&format!("contact.{name}.force"));
    let impulse = contact["impacts"].is_array();
    let mut all = Vec::new();
    all.extend(displacement(&frame, &flight));
    all.extend(force.map(|force| {
        let figure = frame.figure("force", "Contact force", "contact force");
        let curves = vec![Curve::new("contact force", 2, force)];
        Entry::Draft(Draft {
            figure,
            unit: "N",
            curves,
            omit: Omit::Nothing,
            floor: 0.0,
            apart: false,
        })
    }));
    all.extend(impulse.then(|| {
        let id = if several { format!("impulse-{name}") } else { "impulse".to_owned() };
        Entry::Ready(impulses(canvas, &id, if several { name } else { "" }, contact))
    }));
    all.push(velocity(&frame, &flight, impulse));
    all
}

/// What the figures of one projectile have in common.
struct Frame<'a> {
    canvas: &'a Canvas<'a>,
    name: &'a str,
    several: bool,
}

impl Frame<'_> {
    fn figure(&self, id: &str, title: &str, label: &str) -> Figure {
        let (id, title) = if self.several {
            (format!("{id}-{}", self.name), format!("{title}, {}", self.name))
        } else {
            (id.to_owned(), title.to_owned())
        };
        let axis = self.canvas.time_axis();
        Figure { picture: true, ..Figure::new(Section::Impact, &id, &title, axis, label) }
    }
}

/// A projectile along its line of flight. Displacements and velocities along it are sums of channels.
struct Flight {
    /// Unit vector of the line of flight, shape (2) \[-\].
    direction: [f64; 2],
    /// Channels of position, velocity and gap, shape (2) \[index of a channel\].
    position: [usize; 2],
    /// Channels of the velocity, shape (2) \[index of a channel\].
    velocity: [usize; 2],
    gap: usize,
    /// Where it starts, along the line of flight.
    start: f64,
    /// Gap at the start.
    standoff: f64,
    /// The struck point, if it is among the recorded ones.
    struck: Option<String>,
}

impl Flight {
    fn new(canvas: &Canvas<'_>, summary: &Value, name: &str) -> Option<Self> {
        let (history, sample) = (canvas.history, canvas.sample);
        let channel = |what: &str| history.position(&format!("projectile.{name}.{what}"));
        let position = [channel("position_1")?, channel("position_2")?];
        let velocity = [channel("velocity_1")?, channel("velocity_2")?];
        let gap = history.position(&format!("contact.{name}.gap"))?;
        let own = &summary["projectile"][name];
        let direction = [own["direction"][0].as_f64()?, own["direction"][1].as_f64()?];
        let first = |k: usize, none: f64| sample[k].first().copied().unwrap_or(none);
        let [x, y] = position.map(|k| first(k, f64::NAN));
        let start = direction[0] * x + direction[1] * y;
        let standoff = first(gap, 0.0);
        let recorded = |point: &&str| components(canvas, point, "displacement").is_some();
        let struck = own["strikes"].as_str().filter(recorded).map(str::to_owned);
        Some(Self { direction, position, velocity, gap, start, standoff, struck })
    }

    /// Along the line of flight: the sum of two components.
    fn along(&self, channels: [usize; 2]) -> Vec<(usize, f64)> {
        let terms = channels.into_iter().zip(self.direction);
        terms.filter(|(_, factor)| *factor != 0.0).collect()
    }

    /// What legends call the struck point.
    fn struck_label(&self) -> String {
        self.struck.as_ref().map_or("contact point".to_owned(), |p| format!("contact point {p}"))
    }
}

fn components(canvas: &Canvas<'_>, point: &str, what: &str) -> Option<[usize; 2]> {
    let channel = |i: usize| canvas.history.position(&format!("point.{point}.{what}_{i}"));
    Some([channel(1)?, channel(2)?])
}

fn displacement(frame: &Frame<'_>, flight: &Flight) -> Option<Entry> {
    let from_touch = -flight.start - flight.standoff;
    if !flight.standoff.is_finite() {
        return None;
    }
    let way = flight.along(flight.position);
    let mut struck = way.clone();
    struck.push((flight.gap, 1.0));
    let curves = vec![
        Curve::sum(format!("projectile {}", frame.name), 1, way, from_touch),
        Curve::sum(flight.struck_label(), 2, struck, from_touch),
    ];
    let label = "displacement in the initial direction of motion";
    let mut figure = frame.figure("displacement", "Displacement", label);
    figure.note = "Projectile displacement measured from first contact.".to_owned();
    Some(Entry::Draft(Draft {
        figure,
        unit: "m",
        curves,
        omit: Omit::Nothing,
        floor: 0.0,
        apart: true,
    }))
}

fn velocity(frame: &Frame<'_>, flight: &Flight, picture: bool) -> Entry {
    let struck = flight.struck.as_ref();
    let struck = struck.and_then(|point| components(frame.canvas, point, "velocity"));
    let mut figure =
        frame.figure("velocity", "Velocity", "velocity in the initial direction of motion");
    figure.picture = picture;
    if struck.is_none() {
        figure.note = "The contact point is not a recorded point.".to_owned();
    }
    let point = struck.map(|channels| Curve {
        weight: 0.6,
        dashed: false,
        ..Curve::sum(flight.struck_label(), 2, flight.along(channels), 0.0)
    });
    let projectile = Curve {
        weight: 1.6,
        ..Curve::sum(format!("projectile {}", frame.name), 1, flight.along(flight.velocity), 0.0)
    };
    let curves = point.into_iter().chain([projectile]).collect(); // the later one lies on top
    Entry::Draft(Draft {
        figure,
        unit: "m/s",
        curves,
        omit: Omit::Nothing,
        floor: 0.0,
        apart: true,
    })
}

/// Impulses of impacts as stems, intervals of closed contact as bands; `name` stands in the title unless it is empty.
pub(super) fn impulses(canvas: &Canvas<'_>, id: &str, name: &str, contact: &Value) -> Figure {
    let empty = Vec::new();
    let list = |key: &str| contact[key].as_array().unwrap_or(&empty);
    let (impacts, intervals) = (list("impacts"), list("intervals"));
    let number = |entry: &Value, key: &str| entry[key].as_f64().unwrap_or(f64::NAN);
    let column = |entries: &[Value], key: &str| -> Vec<f64> {
        entries.iter().take(SHOWN).map(|entry| number(entry, key)).collect()
    };
    let scaled = |values: Vec<f64>, by: f64| values.into_iter().map(|v| v * by).collect();

    let stems = column(impacts, "impulse");
    let bands = column(intervals, "impulse");
    let scale = Scale::new(largest(stems.iter().chain(&bands)), "N*s");
    let series = |label: String, style: usize, shape: Shape, y: Vec<f64>| Series {
        label,
        style,
        weight: 1.0,
        dashed: false,
        shape,
        y: scaled(y, scale.factor),
    };
    let times = column(impacts, "time");
    let friction = column(impacts, "tangential_impulse");
    let mut drawn = vec![series("impulse of an impact".to_owned(), 2, Shape::Stem, stems)];
    if largest(&friction) > 0.0 {
        drawn.push(series("of friction".to_owned(), 1, Shape::Stem, friction));
    }
    let mut tables = vec![Table { x: scaled(times, canvas.time_scale.factor), series: drawn }];
    if !intervals.is_empty() {
        let last = canvas.history.position("time").and_then(|k| canvas.sample[k].last().copied());
        let ends = |interval: &Value| {
            let end = interval["end"].as_f64().or(last).unwrap_or(f64::NAN); // or still closed
            [number(interval, "start"), end]
        };
        let x = intervals.iter().take(SHOWN).flat_map(ends).collect();
        let total = intervals.iter().filter_map(|i| i["impulse"].as_f64()).sum();
        let label = format!("closed contact, total {}", quantity(Some(total), "N*s"));
        let y = bands.iter().flat_map(|v| [*v, *v]).collect();
        let series = vec![series(label, 3, Shape::Band, y)];
        tables.insert(0, Table { x: scaled(x, canvas.time_scale.factor), series });
    }
    let title = if name.is_empty() { "Impulses".to_owned() } else { format!("Impulses, {name}") };
    let mut figure = Figure::new(Section::Impact, id, &title, canvas.time_axis(), "impulse");
    figure.picture = true;
    figure.y.unit = scale.unit.clone();
    figure.tables = tables;
    let count = contact["impact_count"].as_u64().map_or(impacts.len(), |n| n as usize);
    figure.note = impulse_note(count, impacts.len().min(SHOWN), intervals.len());
    figure
}

fn impulse_note(count: usize, shown: usize, intervals: usize) -> String {
    let mut parts = Vec::new();
    if count == 0 && intervals == 0 {
        parts.push("No impact occurred.".to_owned());
    }
    if count > 0 {
        parts.push("Stems: impulses of impacts (N s), not forces.".to_owned());
    }
    if count > shown {
        parts.push(format!("First {shown} of {count} impacts shown."));
    }
    if intervals > 0 {
        parts.push("Bands: persistent contact; impulse of the contact force.".to_owned());
    }
    if intervals > SHOWN {
        parts.push(format!("First {SHOWN} of {intervals} bands shown."));
    }
    parts.join(" ")
}
