//! The tables of key results.

use serde_json::{Map, Value};

use crate::summary::kind_of_body;

use super::html::{escape, table};
use super::quantity::{number, quantity, without_round_off};
use super::{extremes, figures, foundations, warnings, yields};
use crate::round_off::{Scales, is_round_off};
use crate::shown::{NAMES, ROWS};

/// Rows of all tables up to which they are unfolded.
const UNFOLDED: usize = 60;

/// The tables: energy, contacts, what has yielded, recorded points, failures; folded behind them reactions and section forces.
pub(super) fn render(summary: &Value) -> String {
    let tables = tables(summary);
    let folded = |open: &str, title: &str, tables: &str| match tables.is_empty() {
        true => String::new(),
        false => format!(
            "<details{open}>\n<summary>{title}</summary>\n<div class=\"tables\">\n{tables}</div>\n</details>\n"
        ),
    };
    let open = if tables.matches("<tr").count() <= UNFOLDED { " open" } else { "" };
    folded(open, "<h2>Key results</h2>", &tables)
        + &folded("", "Largest reactions and section forces", &extremes::ranges(summary))
}

fn tables(summary: &Value) -> String {
    let mut out = energy(summary);
    let empty = Map::new();
    let contacts = summary["contact"].as_object().unwrap_or(&empty);
    let projectiles = summary["projectile"].as_object().unwrap_or(&empty);
    let sizes = Sizes::of(summary);
    // A model of many bodies has hundreds of pairs that could have touched.
    let waits = |name: &str, contact: &Value| !projectiles.contains_key(name) && !touched(contact);
    let untouched: Vec<&str> =
        contacts.iter().filter(|(n, c)| waits(n, c)).map(|(name, _)| name.as_str()).collect();
    let crowded = untouched.len() > 1;
    for (name, contact) in contacts.iter().filter(|(n, c)| !crowded || !waits(n, c)) {
        out.push_str(&contact_table(name, contact, projectiles.get(name), &sizes));
        let accepted = warnings::is_accepted(summary, &["W005", "W104"], name);
        out.push_str(&mass_warning(contact, accepted));
    }
    if crowded {
        out.push_str(&not_closed(&untouched));
    }
    for (name, projectile) in projectiles.iter().filter(|(name, _)| !contacts.contains_key(*name)) {
        out.push_str(&table(&titled(name, projectile), &[], &departure(projectile, &sizes)));
    }
    out.push_str(&yields::render(summary));
    out.push_str(&foundations::render(summary));
    out.push_str(&points(summary));
    out.push_str(&extremes::failures_and_impulses(summary));
    out
}

/// The energy at the start and the end, and what it was spent on.
fn energy(summary: &Value) -> String {
    let energy = &summary["energy"];
    if !energy["scale"].is_number() {
        return String::new();
    }
    let scale = Scales::of(summary).energy;
    let value = |key: &str| energy[key].as_f64().filter(|v| !is_round_off(*v, scale));
    let in_contacts = value("loss_contacts").unwrap_or(0.0);
    let damping = value("loss_damping").map(|all| all - in_contacts);
    let damping = damping.filter(|v| !is_round_off(*v, scale));
    let always = |key: &str| Some(value(key).unwrap_or(0.0));
    // Results of earlier versions do not separate the two losses.
    let damping_label = if energy["loss_contacts"].is_number() {
        "dissipated by damping"
    } else {
        figures::damping(summary)
    };
    let terms = [
        ("initial energy", always("initial")),
        ("work of loads", value("work_loads")),
        ("work of supports", value("work_supports")),
        ("lost in impacts and friction", value("loss_impacts")),
        (damping_label, damping),
        ("dissipated in contacts", value("loss_contacts")),
        ("dissipated by plastic flow", value("plastic")),
        ("stored in hardening", value("hardening")),
        ("lost in failed parts", value("failure")),
        ("final energy", always("final")),
    ];
    let row = |(label, value): (&str, Option<f64>)| {
        Some(vec![label.to_owned(), quantity(Some(value?), "J")])
    };
    let mut rows: Vec<Vec<String>> = terms.into_iter().filter_map(row).collect();
    // As the summary text gives it: a residual is round-off where the balance holds.
    rows.push(vec![
        "residual, relative".to_owned(),
        quantity(energy["residual_max"].as_f64(), "1"),
    ]);
    table("Energy", &[], &rows)
}

/// `caption` and so many rows of `list`, the rest counted.
fn listing(
    caption: &str,
    header: &[&str],
    list: &[Value],
    total: usize,
    row: impl Fn(usize, &Value) -> Vec<String>,
) -> String {
    let shown: Vec<Vec<String>> =
        list.iter().take(ROWS).enumerate().map(|(k, entry)| row(k + 1, entry)).collect();
    let mut out = table(caption, header, &shown);
    if total > shown.len() {
        let more = total - shown.len();
        out.push_str(&format!("<p class=\"more\">and {more} more</p>\n"));
    }
    out
}

fn touched(contact: &Value) -> bool {
    let closed = contact["intervals"].as_array().is_some_and(|list| !list.is_empty());
    closed || contact["impact_count"].as_u64().is_some_and(|count| count > 0)
}

fn not_closed(names: &[&str]) -> String {
    let shown = names.iter().take(NAMES).copied().collect::<Vec<_>>().join(", ");
    let more = match names.len().saturating_sub(NAMES) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let text = format!("{} contacts not closed: {shown}{more}", names.len());
    format!("<p class=\"more\">{}</p>\n", escape(&text))
}

fn contact_table(name: &str, contact: &Value, projectile: Option<&Value>, sizes: &Sizes) -> String {
    let mut rows = Vec::new();
    let mut row = |label: &str, value: String| rows.push(vec![label.to_owned(), value]);
    let peak = &contact["peak_force"];
    if peak.is_object() {
        let force = quantity(peak["value"].as_f64(), "N");
        let time = quantity(peak["time"].as_f64(), "s");
        // A contact that did not close has none.
        if peak["value"].is_null() {
            row("peak contact force", "none (not closed)".into());
        } else {
            row("peak contact force", format!("{force} at t\u{a0}=\u{a0}{time}"));
        }
        let intervals = contact["intervals"].as_array().map_or(&[][..], Vec::as_slice);
        let impulse = intervals.iter().filter_map(|i| i["impulse"].as_f64()).sum();
        row("intervals of contact", intervals.len().to_string());
        row("impulse", quantity(Some(impulse), "N*s"));
    }
    if let Some(count) = contact["impact_count"].as_u64() {
        row("impacts", count.to_string());
        let rests = contact["intervals"].as_array().map_or(&[][..], Vec::as_slice);
        let rested = contact["impulse_resting"].as_f64().unwrap_or(0.0);
        let of_impacts = contact["impulse_total"].as_f64().map(|total| (total - rested).max(0.0));
        row("impulse of the impacts", quantity(of_impacts, "N*s"));
        if !rests.is_empty() {
            row("intervals of persistent contact", rests.len().to_string());
            row("impulse of persistent contact", quantity(Some(rested), "N*s"));
        }
    }
    for (label, value) in aftermath(contact, sizes) {
        row(label, value);
    }
    if contact["impact_count"].is_u64() && contact["effective_mass"].is_number() {
        row(
            "effective mass of the contact target",
            quantity(contact["effective_mass"].as_f64(), "kg"),
        );
        row("limit with mesh refinement", quantity(contact["effective_mass_limit"].as_f64(), "kg"));
    }
    let title = match projectile {
        Some(projectile) => {
            rows.extend(departure(projectile, sizes));
            titled(name, projectile)
        }
        None => {
            let partner = |k: usize| contact["between"][k].as_str().unwrap_or("?");
            format!("Contact {name}: {} and {}", partner(0), partner(1))
        }
    };
    table(&title, &[], &rows)
}

/// Friction, impacts under another law, permanent indentation; equivalent static forces, or why there are none.
fn aftermath(contact: &Value, sizes: &Sizes) -> Vec<(&'static str, String)> {
    let force = &contact["equivalent_force"];
    let elastic = match force["as_if_elastic"].as_bool() {
        Some(true) => ", of the elastic structure",
        _ => "",
    };
    let beside = match force["beside_loads"].as_bool() {
        Some(true) => ", beside the permanent loads",
        _ => "",
    };
    let shown = |label, key: &str| {
        let Some(value) = force[key].as_f64() else {
            let why = force[format!("{key}_note")].as_str()?;
            return Some((label, format!("none: {why}")));
        };
        let rebound = match force["on_rebound"].as_bool() {
            Some(true) if key == "deflection" => ", against the impact (on rebound)",
            _ => "",
        };
        Some((label, format!("{}{rebound}{beside}{elastic}", quantity(Some(value), "N"))))
    };
    let note = contact["equivalent_force_note"].as_str();
    let depth = contact["permanent_penetration"].as_f64().filter(|depth| *depth > 0.0);
    let work = contact["friction_work"].as_f64();
    let work = work.filter(|work| without_round_off(*work, sizes.energy) > 0.0);
    let distance = contact["sliding_distance"].as_f64();
    let distance = distance.filter(|distance| !is_round_off(*distance, sizes.length));
    let sliding = work.and(distance).map(|distance| quantity(Some(distance), "m"));
    let work = work.filter(|_| sliding.is_some());
    let moreau = "impacts with Moreau's law (Newton's law would increase the energy)";
    let fallbacks = contact["fallback_count"].as_u64().filter(|count| *count > 0);
    [
        sliding.map(|distance| ("sliding distance", distance)),
        work.map(|work| ("friction work", quantity(Some(work), "J"))),
        fallbacks.map(|count| (moreau, count.to_string())),
        depth.map(|depth| ("permanent indentation", quantity(Some(depth), "m"))),
        shown("equivalent static force, same peak moment", "moment"),
        shown("equivalent static force, same peak deflection", "deflection"),
        note.map(|why| ("equivalent static force", format!("none: {why}"))),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Sizes of the run beside which what projectiles end with is round-off.
struct Sizes {
    velocity: f64,
    momentum: f64,
    energy: f64,
    length: f64,
}

impl Sizes {
    fn of(summary: &Value) -> Self {
        let empty = Map::new();
        let all = |kind: &str| summary[kind].as_object().unwrap_or(&empty).values();
        let size = |values: &[&Value]| {
            values.iter().filter_map(|v| v.as_f64()).map(f64::abs).fold(0.0, f64::max)
        };
        let nothing = &Value::Null;
        let first = |list: &'static str| {
            all("contact").map(move |c| c.pointer(list).unwrap_or(nothing)).collect::<Vec<_>>()
        };
        let ends = |k: usize| all("projectile").map(move |p| &p["velocity_final"][k]);
        let approach = [
            first("/impacts/0/approach_velocity"),
            first("/intervals/0/approach_velocity"),
            ends(0).chain(ends(1)).collect(),
        ];
        let momentum: Vec<&Value> = all("projectile").map(|p| &p["momentum_transferred"]).collect();
        let given: Vec<&Value> = all("projectile").map(|p| &p["energy_given"]).collect();
        Self {
            velocity: size(&approach.concat()),
            momentum: size(&momentum),
            energy: size(&given).max(size(&[&summary["energy"]["scale"]])),
            length: Scales::of(summary).length,
        }
    }
}

/// Kind and name of a projectile.
fn titled(name: &str, projectile: &Value) -> String {
    match kind_of_body(projectile) {
        "disc" => format!("Disc {name}"),
        _ => format!("Projectile {name}"),
    }
}

fn departure(projectile: &Value, sizes: &Sizes) -> Vec<Vec<String>> {
    let velocity = &projectile["velocity_final"];
    let component = |k: usize| {
        let shown = velocity[k].as_f64().map(|v| number(without_round_off(v, sizes.velocity)));
        shown.unwrap_or("\u{2013}".to_owned())
    };
    let given = |key: &str, size: f64| projectile[key].as_f64().map(|v| without_round_off(v, size));
    let row = |label: &str, value: String| vec![label.to_owned(), value];
    let spin = projectile["spin_final"].as_f64().filter(|spin| *spin != 0.0);
    let spin = spin.map(|spin| row("final angular velocity", quantity(Some(spin), "rad/s")));
    let note = match projectile["still_touches"].is_array() {
        true => ", still in contact: not a rebound velocity",
        false => "",
    };
    let mut rows = vec![
        row("final velocity", format!("({}, {}) m/s{note}", component(0), component(1))),
        row(
            "momentum transferred (negative: received)",
            quantity(given("momentum_transferred", sizes.momentum), "kg*m/s"),
        ),
        row("energy transferred", quantity(given("energy_given", sizes.energy), "J")),
        row(
            "energy received by the structure",
            quantity(given("energy_received_by_others", sizes.energy), "J"),
        ),
    ];
    rows.extend(spin);
    rows
}

/// The warning that a rigid impact's impulse belongs to the mesh, where it does.
fn mass_warning(contact: &Value, accepted: bool) -> String {
    let rigid = contact["impact_count"].is_u64();
    let mass = contact["effective_mass"].as_f64();
    let limit = contact["effective_mass_limit"].as_f64();
    let (true, Some(mass), Some(limit)) = (rigid, mass, limit) else { return String::new() };
    if (mass - limit).abs() <= 0.5 * limit {
        return String::new();
    }
    let text = format!(
        "Effective mass of the contact target: {} kg on this mesh, {} kg with mesh refinement. The \
         impulse of a rigid impact depends on the mesh (see the documentation on restitution and \
         meshes).",
        number(mass),
        number(limit)
    );
    // No box of a warning where the scenario accepts it.
    let class = if accepted { "more" } else { "warning" };
    format!(
        "<p class=\"{class}\" role=\"note\"><strong>Mesh-dependent result.</strong> {}</p>\n",
        escape(&text)
    )
}

fn points(summary: &Value) -> String {
    let Some(points) = summary["point"].as_object().filter(|p| !p.is_empty()) else {
        return String::new();
    };
    let list: Vec<Value> = points.iter().map(|(name, p)| serde_json::json!([name, p])).collect();
    let moved = Scales::of(summary).length;
    let header =
        ["point", "largest displacement x", "at time", "largest displacement y", "at time"];
    let relative = points.values().any(|point| point["relative_to_base"] == true);
    let caption = match relative {
        true => "Recorded points (displacements relative to the base)",
        false => "Recorded points",
    };
    listing(caption, &header, &list, list.len(), |_, entry| {
        let mut row = vec![entry[0].as_str().unwrap_or_default().to_owned()];
        for component in ["component_1", "component_2"] {
            let peak = &entry[1]["displacement_max"][component];
            let value = peak["value"].as_f64().map(|v| without_round_off(v, moved));
            row.push(quantity(value, "m"));
            // What is nothing has no instant.
            let nothing = value == Some(0.0);
            let time = quantity(peak["time"].as_f64().filter(|_| !nothing), "s");
            let doubtful = peak["resolved"].as_bool() == Some(false) && !nothing;
            row.push(if doubtful {
                format!("{time} (largest at the ends of steps)")
            } else {
                time
            });
        }
        row
    })
}
