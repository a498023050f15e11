//! Which figures a run has: those of the paper, then the audit's and the recorded points'.

use serde_json::Value;

use super::ReportData;
use super::decimate;
use super::figure::{Axis, Canvas, Curve, Figure, Section, Series, Shape, Table, largest};
use super::impact;
use super::quantity::Scale;
use crate::history::History;

/// Recorded points that get a figure.
const POINTS_SHOWN: usize = 24;
/// Values on a page, all figures together; 4 bytes each before compression.
const VALUES_PER_PAGE: usize = 600_000;

/// All figures of a run, in the order of the page.
pub(crate) fn all(data: &ReportData) -> Vec<Figure> {
    let history = &data.history;
    let Some(time) = history.column("time").filter(|t| !t.is_empty()) else {
        return Vec::new();
    };
    let canvas =
        Canvas { time, time_scale: Scale::new(largest(&[time]), "s"), bins: bins(history) };
    let projectiles = names(history, "projectile.", ".position_1");
    let mut figures = Vec::new();
    for name in &projectiles {
        figures.extend(impact::figures(&canvas, history, name, projectiles.len() > 1));
    }
    figures.extend(energy(&canvas, history));
    figures.extend(momentum(&canvas, history));
    figures.extend(restitution(&canvas, data));
    figures.extend(energy_shares(&canvas, history));
    figures.extend(audit(&canvas, data));
    for point in names(history, "point.", ".displacement_1").iter().take(POINTS_SHOWN) {
        figures.extend(displacement_of(&canvas, history, point));
    }
    figures
}

/// Names between `prefix` and `suffix` among the channels, in their order.
pub(crate) fn names(history: &History, prefix: &str, suffix: &str) -> Vec<String> {
    let name = |c: &crate::history::Channel| {
        Some(c.name.strip_prefix(prefix)?.strip_suffix(suffix)?.to_owned())
    };
    history.channels.iter().filter_map(name).collect()
}

/// As many bins as keep the page small whatever the number of figures.
fn bins(history: &History) -> usize {
    let projectiles = names(history, "projectile.", ".position_1").len();
    let points = names(history, "point.", ".displacement_1").len().min(POINTS_SHOWN);
    let values_per_bin = 150 + 70 * projectiles + 20 * points;
    (VALUES_PER_PAGE / values_per_bin).clamp(200, 4000)
}

/// Leaves out curves that are round-off beside the others.
fn without_round_off(mut curves: Vec<Curve<'_>>) -> Vec<Curve<'_>> {
    let columns: Vec<&[f64]> = curves.iter().map(|c| c.y).collect();
    let size = largest(&columns);
    curves.retain(|c| largest(&[c.y]) > 1e-11 * size);
    curves
}

/// Whether a column holds anything but zeros.
fn is_alive(column: &[f64]) -> bool {
    column.iter().any(|v| *v != 0.0 && v.is_finite())
}

/// Curves of those channels that exist and are alive, with their styles.
fn curves<'a>(history: &'a History, wanted: &[(&str, &str, usize)]) -> Vec<Curve<'a>> {
    let curve = |&(channel, label, style): &(&str, &str, usize)| {
        let column = history.column(channel)?;
        is_alive(column).then(|| Curve::new(label, style, column))
    };
    wanted.iter().filter_map(curve).collect()
}

fn over_time(
    canvas: &Canvas<'_>,
    (id, title, label): (&str, &str, &str),
    section: Section,
    unit: &str,
    curves: &[Curve<'_>],
) -> Option<Figure> {
    if curves.is_empty() {
        return None;
    }
    let (unit, table) = canvas.lines(unit, curves);
    Some(Figure {
        id: id.to_owned(),
        section,
        picture: false,
        title: title.to_owned(),
        x: canvas.time_axis(),
        y: Axis { label: label.to_owned(), unit },
        note: String::new(),
        tables: vec![table],
    })
}

fn energy(canvas: &Canvas<'_>, history: &History) -> Option<Figure> {
    let wanted = [
        ("energy.kinetic", "kinetic", 1),
        ("energy.strain", "strain", 2),
        ("energy.contact", "contact", 3),
        ("energy.total", "total", 0),
    ];
    let curves = curves(history, &wanted);
    let texts = ("energy", "Energy", "energy");
    let figure = over_time(canvas, texts, Section::Books, "J", &curves)?;
    Some(Figure { picture: true, ..figure })
}

fn energy_shares(canvas: &Canvas<'_>, history: &History) -> Option<Figure> {
    let wanted = [
        ("energy.kinetic_projectiles", "kinetic, projectiles", 1),
        ("energy.kinetic_beams", "kinetic, beams", 6),
        ("energy.strain_bending", "strain, bending", 2),
        ("energy.strain_axial", "strain, axial", 5),
        ("energy.work_loads", "work of loads", 3),
        ("energy.work_supports", "work of supports", 4),
        ("energy.loss_impacts", "lost in impacts", 0),
    ];
    let curves = without_round_off(curves(history, &wanted));
    let texts = ("energy-shares", "Energy, where it is", "energy");
    over_time(canvas, texts, Section::Books, "J", &curves)
}

fn momentum(canvas: &Canvas<'_>, history: &History) -> Vec<Figure> {
    let wanted = [("momentum.linear_1", "component 1", 1), ("momentum.linear_2", "component 2", 2)];
    let components = without_round_off(curves(history, &wanted));
    let note = "Momentum of beams and projectiles together. Supports and loads change it; \
                the audit takes their impulses into the books.";
    let texts = ("momentum", "Linear momentum", "linear momentum");
    let linear = over_time(canvas, texts, Section::Books, "kg*m/s", &components);
    let angular = curves(history, &[("momentum.angular", "about the origin", 4)]);
    let texts = ("momentum-angular", "Angular momentum", "angular momentum");
    let angular = over_time(canvas, texts, Section::Books, "kg*m^2/s", &angular);
    let linear = linear.map(|f| Figure { picture: true, note: note.to_owned(), ..f });
    linear.into_iter().chain(angular).collect()
}

/// Total energy for several restitution coefficients, each on its own times.
fn restitution(canvas: &Canvas<'_>, data: &ReportData) -> Option<Figure> {
    if data.comparison.is_empty() {
        return None;
    }
    let columns: Vec<&[f64]> = data.comparison.iter().map(|s| s.energy.as_slice()).collect();
    let scale = Scale::new(largest(&columns), "J");
    let table = |(k, run): (usize, &crate::ComparisonSeries)| {
        let rows = decimate::rows(&[&run.energy], run.time.len(), canvas.bins / 2);
        let pick = |column: &[f64], by: f64| rows.iter().map(|&r| column[r] * by).collect();
        let y = pick(&run.energy, scale.factor);
        let series = Series { label: run.label.clone(), style: 1 + k % 6, shape: Shape::Line, y };
        Table { x: pick(&run.time, canvas.time_scale.factor), series: vec![series] }
    };
    Some(Figure {
        id: "restitution".to_owned(),
        section: Section::Books,
        picture: true,
        title: "Total energy and restitution".to_owned(),
        x: canvas.time_axis(),
        y: Axis { label: "total energy".to_owned(), unit: scale.unit.clone() },
        note: "The same scenario with other restitution coefficients.".to_owned(),
        tables: data.comparison.iter().enumerate().map(table).collect(),
    })
}

fn audit(canvas: &Canvas<'_>, data: &ReportData) -> Vec<Figure> {
    let (history, summary) = (&data.history, &data.summary);
    let scale = |value: &Value| value.as_f64().filter(|s| *s > 0.0);
    let relative = |channel: &str, scale: Option<f64>| -> Option<Vec<f64>> {
        let column = history.column(channel).filter(|c| is_alive(c))?;
        Some(column.iter().map(|v| v / scale.unwrap_or(1.0)).collect())
    };
    let mut figures = Vec::new();

    let energy_scale = scale(&summary["energy"]["scale"]);
    if let Some(residual) = relative("energy.residual", energy_scale) {
        let (label, unit) = match energy_scale {
            Some(_) => ("residual / largest energy", "1"),
            None => ("residual", "J"),
        };
        let texts = ("energy-residual", "Energy residual", label);
        let curve = [Curve::new("residual", 2, &residual)];
        figures.extend(over_time(canvas, texts, Section::Audit, unit, &curve));
    }

    let linear = scale(&summary["momentum"]["linear_scale"]);
    let angular = scale(&summary["momentum"]["angular_scale"]);
    let residuals: Vec<(&str, usize, Vec<f64>)> = [
        ("momentum.residual_1", "linear, component 1", 1, linear),
        ("momentum.residual_2", "linear, component 2", 2, linear),
        ("momentum.residual_angular", "angular", 4, angular),
    ]
    .into_iter()
    .filter_map(|(channel, label, style, scale)| {
        scale?;
        Some((label, style, relative(channel, scale)?))
    })
    .collect();
    let curve = |(label, style, y)| Curve::new(label, style, y);
    let residuals: Vec<Curve<'_>> =
        residuals.iter().map(|(label, style, y)| curve((*label, *style, y.as_slice()))).collect();
    let texts = ("momentum-residual", "Momentum residual", "residual / largest momentum");
    figures.extend(over_time(canvas, texts, Section::Audit, "1", &residuals));

    let drifts = [
        ("audit.curvature_drift", "curvature-drift", "Curvature drift", "curvature drift", "1/m"),
        ("audit.membrane_drift", "membrane-drift", "Membrane strain drift", "strain drift", "1"),
    ];
    for (channel, id, title, label, unit) in drifts {
        let curves = curves(history, &[(channel, "stored strain against configuration", 3)]);
        figures.extend(over_time(canvas, (id, title, label), Section::Audit, unit, &curves));
    }
    figures
}

fn displacement_of(canvas: &Canvas<'_>, history: &History, point: &str) -> Option<Figure> {
    let names = [1, 2].map(|i| format!("point.{point}.displacement_{i}"));
    let wanted = [(names[0].as_str(), "component 1", 1), (names[1].as_str(), "component 2", 2)];
    let curves = without_round_off(curves(history, &wanted));
    let (id, title) = (format!("point-{point}"), format!("Displacement of {point}"));
    over_time(canvas, (&id, &title, "displacement"), Section::Points, "m", &curves)
}
