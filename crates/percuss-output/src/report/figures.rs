//! Which figures a run has: those of the paper, then the audit's and the recorded points'.

use serde_json::Value;

use super::canvas::{Canvas, names};
use super::contacts;
use super::data::ReportData;
use super::decimate;
use super::draft::{self, Curve, Draft, Entry, Omit};
use super::envelopes;
use super::figure::{Axis, Figure, Section, Series, Shape, Table, largest};
use super::impact;
use super::quantity::Scale;
use super::structure;
use super::thin::Bins;
use crate::error::Error;
use crate::history::HistorySource;
use crate::round_off::ROUND_OFF;
use crate::shown::FIGURES;

/// Values on a page, all figures together; 4 bytes each before compression.
const VALUES_PER_PAGE: usize = 600_000;
/// Around a contact rows are kept for this share of its length, and for as many steps at least.
const AROUND: f64 = 0.25;
const ROWS_AROUND: f64 = 16.0;
/// Rows looked at before any curve is drawn.
const SAMPLED: usize = 512;

/// All figures of a run, in the order of the page.
pub(super) fn all(data: &ReportData) -> Result<Vec<Figure>, Error> {
    let history = &data.history;
    let Some(time) = history.position("time").filter(|_| history.rows() > 0) else {
        return Ok(Vec::new());
    };
    let sample = sample(history)?;
    let time_scale = Scale::new(largest(&sample[time]), "s");
    let canvas = Canvas { history, sample: &sample, time_scale, bins: bins(history) };
    let bins = rows_to_draw(history, time, &data.summary, canvas.bins)?;
    let projectiles = contacts::guided(history);
    let mut entries = Vec::new();
    for name in &projectiles {
        let several = projectiles.len() > 1;
        entries.extend(impact::figures(&canvas, &data.summary, name, several));
    }
    entries.extend(contacts::discs(&canvas));
    entries.extend(contacts::between(&canvas, &data.summary));
    entries.push(energy(&canvas, data));
    entries.extend(energy_balance(&canvas, &data.summary));
    entries.extend(restitution(&canvas, data).map(Entry::Ready));
    entries.extend(momentum(&canvas));
    entries.extend(structure::reactions(&canvas, &data.summary));
    entries.extend(structure::section_forces(&canvas, &data.summary));
    entries.extend(envelopes::figures(&data.envelopes).into_iter().map(Entry::Ready));
    entries.extend(audit(&canvas, &data.summary));
    for point in names(history, "point.", ".displacement_1").iter().take(FIGURES) {
        entries.push(displacement_of(&canvas, point));
    }
    draft::finish(entries, history, (time, &canvas.time_scale), &bins)
}

/// Some rows of the time, the projectiles and the gaps; the rest stays empty.
fn sample(history: &HistorySource) -> Result<Vec<Vec<f64>>, Error> {
    let motion =
        |name: &str| name == "time" || name.starts_with("projectile.") || name.ends_with(".gap");
    let channels = history.channels();
    let wanted: Vec<usize> = (0..channels.len()).filter(|&k| motion(&channels[k].name)).collect();
    let mut sample = vec![Vec::new(); channels.len()];
    let last = history.rows().saturating_sub(1);
    let stride = (history.rows() / SAMPLED).max(1);
    let mut seen = 0;
    history.scan(&wanted, &mut |piece| {
        let length = piece.first().map_or(0, |c| c.len());
        for row in (0..length).filter(|r| (seen + r).is_multiple_of(stride) || seen + r == last) {
            wanted.iter().zip(piece).for_each(|(&k, column)| sample[k].push(column[row]));
        }
        seen += length;
    })?;
    Ok(sample)
}

/// Bins in which long histories are reduced, with the rows around contacts kept as they are.
fn rows_to_draw(
    history: &HistorySource,
    time: usize,
    summary: &Value,
    bins: usize,
) -> Result<Bins, Error> {
    let mut times = Vec::with_capacity(history.rows());
    history.scan(&[time], &mut |piece| times.extend_from_slice(piece[0]))?;
    let end = times.last().copied().unwrap_or(0.0);
    let empty = serde_json::Map::new();
    let mut windows = Vec::new();
    for contact in summary["contact"].as_object().unwrap_or(&empty).values() {
        let list = |key: &str| contact[key].as_array().map_or(&[][..], Vec::as_slice);
        let of_interval =
            |i: &Value| Some([i["start"].as_f64()?, i["end"].as_f64().unwrap_or(end)]);
        windows.extend(list("intervals").iter().filter_map(of_interval));
        windows.extend(list("impacts").iter().filter_map(|i| i["time"].as_f64()).map(|t| [t, t]));
    }
    let mean_step = end / times.len().max(1) as f64;
    for [from, to] in &mut windows {
        let room = (AROUND * (*to - *from)).max(ROWS_AROUND * mean_step);
        (*from, *to) = (*from - room, *to + room);
    }
    Ok(Bins::finer_within(&times, &windows, bins))
}

/// As many bins as keep the page small whatever the number of figures.
fn bins(history: &HistorySource) -> usize {
    let projectiles = contacts::guided(history).len();
    let points = names(history, "point.", ".displacement_1").len().min(FIGURES);
    let together = structure::values_per_bin(history) + contacts::values_per_bin(history);
    let values_per_bin = 250 + 70 * projectiles + 20 * points + together;
    (VALUES_PER_PAGE / values_per_bin).clamp(150, 4000)
}

fn energy(canvas: &Canvas<'_>, data: &ReportData) -> Entry {
    let curves = canvas.curves(&[
        ("energy.kinetic", "kinetic", 1),
        ("energy.strain", "strain", 2),
        ("energy.contact", "contact", 3),
        ("energy.total", "total", 0),
    ]);
    let texts = ("energy", "Energy", "energy");
    let mut draft = canvas.over_time(texts, Section::Balance, "J", curves);
    draft.figure.picture = true;
    if lacks_comparison(data) {
        draft.figure.note =
            "No comparison of restitution coefficients: more than 200\u{202f}000 steps \
             times elements. Set restitution = [1, 0.5, 0] under [report] to force it."
                .to_owned();
    }
    Entry::Draft(draft)
}

/// Whether a run to its end has a rigid projectile but no comparison of coefficients, unasked.
fn lacks_comparison(data: &ReportData) -> bool {
    let contacts = data.summary["contact"].as_object();
    let guided = |c: &Value| c.get("effective_mass").is_some() && c["impact_count"].is_u64();
    let rigid = contacts.is_some_and(|all| all.values().any(guided));
    let asked = data.scenario.lines().any(|line| line.trim() == "[report]");
    rigid && data.comparison.is_empty() && data.summary["status"] == "completed" && !asked
}

/// Whether a contact crushes: its loss is part of that by damping.
pub(super) fn crushes(summary: &Value) -> bool {
    summary["contact"].as_object().is_some_and(|all| {
        all.values().any(|contact| contact.get("permanent_penetration").is_some())
    })
}

/// Name of the loss by damping, which includes that in contacts.
pub(super) fn damping(summary: &Value) -> &'static str {
    let energy = &summary["energy"];
    let all = energy["loss_damping"].as_f64().unwrap_or(0.0);
    let floor = ROUND_OFF * energy["scale"].as_f64().unwrap_or(0.0);
    match energy["loss_contacts"].as_f64() {
        Some(contacts) if contacts.abs() <= floor => "dissipated by damping",
        Some(contacts) if (all - contacts).abs() <= floor => "dissipated in contacts",
        Some(_) => "dissipated by damping and in contacts",
        // Results of earlier versions do not separate the two.
        None if crushes(summary) => "dissipated by damping and crushing",
        None => "dissipated by damping",
    }
}

/// Where the energy is, stacked, below all that came in.
fn energy_balance(canvas: &Canvas<'_>, summary: &Value) -> Option<Entry> {
    let damping = damping(summary);
    let has_foundations = summary["foundation"].as_object().is_some_and(|all| !all.is_empty());
    let springs = if has_foundations { "in springs and foundations" } else { "in springs" };
    let mut curves = canvas.curves(&[
        ("energy.kinetic_projectiles", "kinetic, projectiles", 1),
        ("energy.kinetic_beams", "kinetic, beams", 6),
        ("energy.strain_bending", "strain, bending", 2),
        ("energy.strain_axial", "strain, axial", 5),
        ("energy.strain_shear", "strain, shear", 12),
        ("energy.springs", springs, 7),
        ("energy.contact", "in contacts", 3),
        ("energy.hardening", "stored in hardening", 9),
        ("energy.plastic", "dissipated by plastic flow", 10),
        ("energy.failure", "lost in failed parts", 11),
        ("energy.loss_damping", damping, 8),
        ("energy.loss_impacts", "lost in impacts and friction", 4),
    ]);
    curves.iter_mut().for_each(|curve| curve.shape = Shape::Area);
    let works = ["energy.work_loads", "energy.work_supports"];
    let terms = works.iter().filter_map(|w| Some((canvas.history.position(w)?, 1.0))).collect();
    let initial = summary["energy"]["initial"].as_f64()?;
    curves.push(Curve::sum("initial energy + external work", 0, terms, initial));
    let texts = ("energy-balance", "Energy balance", "energy");
    let mut draft = canvas.over_time(texts, Section::Balance, "J", curves);
    draft.figure.picture = true;
    draft.figure.note = "Stacked energies. Black line: initial energy plus external work. A gap is the balance error."
        .to_owned();
    Some(Entry::Draft(Draft { omit: Omit::RoundOff, ..draft }))
}

fn momentum(canvas: &Canvas<'_>) -> [Entry; 2] {
    let components =
        canvas.curves(&[("momentum.linear_1", "along x", 1), ("momentum.linear_2", "along y", 2)]);
    let texts = ("momentum", "Linear momentum", "linear momentum");
    let mut linear = canvas.over_time(texts, Section::Balance, "kg*m/s", components);
    linear.omit = Omit::RoundOff;
    linear.figure.picture = true;
    linear.figure.note =
        "Total momentum of beams and projectiles, global axes; changed by supports and loads."
            .to_owned();
    let about = canvas.curves(&[("momentum.angular", "about the origin", 4)]);
    let texts = ("momentum-angular", "Angular momentum", "angular momentum");
    let angular = canvas.over_time(texts, Section::Balance, "kg*m^2/s", about);
    [linear, angular].map(Entry::Draft)
}

/// Total energy for several restitution coefficients, each on its own times.
fn restitution(canvas: &Canvas<'_>, data: &ReportData) -> Option<Figure> {
    if data.comparison.is_empty() {
        return None;
    }
    let scale = Scale::new(largest(data.comparison.iter().flat_map(|s| &s.energy)), "J");
    let table = |(k, run): (usize, &crate::ComparisonSeries)| {
        let rows = decimate::rows(&[&run.energy], run.time.len(), canvas.bins / 2);
        let pick = |column: &[f64], by: f64| rows.iter().map(|&r| column[r] * by).collect();
        let series = Series {
            label: run.label.clone(),
            style: 1 + k % 6,
            weight: 1.0,
            dashed: false,
            shape: Shape::Line,
            y: pick(&run.energy, scale.factor),
        };
        Table { x: pick(&run.time, canvas.time_scale.factor), series: vec![series] }
    };
    let (title, label) = ("Total energy and restitution", "total energy");
    let figure = Figure::new(Section::Balance, "restitution", title, canvas.time_axis(), label);
    Some(Figure {
        picture: true,
        y: Axis { unit: scale.unit.clone(), ..figure.y.clone() },
        from_zero: true,
        note: "The same scenario for several restitution coefficients.".to_owned(),
        tables: data.comparison.iter().enumerate().map(table).collect(),
        ..figure
    })
}

fn audit(canvas: &Canvas<'_>, summary: &Value) -> Vec<Entry> {
    let scale = |of: &str, key: &str| summary[of][key].as_f64().filter(|s| *s > 0.0);
    let relative = |(channel, label, style): (&str, &str, usize), scale: f64| {
        let term = (canvas.history.position(channel)?, 1.0 / scale);
        Some(Curve::sum(label, style, vec![term], 0.0))
    };
    let energy_scale = scale("energy", "scale");
    let (label, unit) = match energy_scale {
        Some(_) => ("residual / largest energy", "1"),
        None => ("residual", "J"),
    };
    let residual = relative(("energy.residual", "residual", 2), energy_scale.unwrap_or(1.0));
    let texts = ("energy-residual", "Energy residual", label);
    let mut drafts =
        vec![canvas.over_time(texts, Section::Audit, unit, residual.into_iter().collect())];

    let residuals = [
        (("momentum.residual_1", "linear, along x", 1), "linear_scale"),
        (("momentum.residual_2", "linear, along y", 2), "linear_scale"),
        (("momentum.residual_angular", "angular", 4), "angular_scale"),
    ];
    let residuals = residuals
        .into_iter()
        .filter_map(|(curve, key)| relative(curve, scale("momentum", key)?))
        .collect();
    let texts = ("momentum-residual", "Momentum residual", "residual / largest momentum");
    drafts.push(canvas.over_time(texts, Section::Audit, "1", residuals));

    let drifts = [
        ("audit.curvature_drift", "curvature-drift", "Curvature drift", "curvature drift", "1/m"),
        ("audit.membrane_drift", "membrane-drift", "Membrane strain drift", "strain drift", "1"),
    ];
    for (channel, id, title, label, unit) in drifts {
        let curves =
            canvas.curves(&[(channel, "stored strain minus strain of the configuration", 3)]);
        drafts.push(canvas.over_time((id, title, label), Section::Audit, unit, curves));
    }
    let label = "kinetic energy: nodal velocities minus section rotation rates";
    let rates = ("audit.angular_rate_drift", label, 3);
    let rates = relative(rates, energy_scale.unwrap_or(1.0));
    let texts = ("angular-rate-drift", "Angular rate drift", "kinetic energy / largest energy");
    drafts.push(canvas.over_time(texts, Section::Audit, unit, rates.into_iter().collect()));
    drafts.into_iter().map(Entry::Draft).collect()
}

fn displacement_of(canvas: &Canvas<'_>, point: &str) -> Entry {
    let names = [1, 2].map(|i| format!("point.{point}.displacement_{i}"));
    let wanted = [(names[0].as_str(), "along x", 1), (names[1].as_str(), "along y", 2)];
    let (id, title) = (format!("point-{point}"), format!("Displacement of {point}"));
    let texts = (id.as_str(), title.as_str(), "displacement");
    let draft = canvas.over_time(texts, Section::Points, "m", canvas.curves(&wanted));
    Entry::Draft(Draft { omit: Omit::RoundOff, ..draft })
}
