//! Balance errors and convergence in words: what is conserved, what is not, and whether the scheme explains it.

use percuss::AuditSummary;
use serde_json::Value;

use super::html::table;
use super::quantity::{number, quantity, without_round_off};

/// A residual below this, relative to the largest amount, counts as closed.
const CLOSED: f64 = 1e-10;

/// The audit table.
pub(super) fn render(summary: &Value, scenario: &str) -> String {
    let scheme = summary["settings"]["scheme"].as_str().unwrap_or_default();
    let midpoint_force = scenario.lines().any(|line| {
        let found = line.split_once('=').map(|(key, value)| (key.trim(), value.trim()));
        found == Some(("force", "\"midpoint\""))
    });
    let residual = |of: &str, key: &str| summary[of][key].as_f64();
    let mut rows = Vec::new();
    for (label, of, key) in [
        ("energy residual, relative", "energy", "residual_max"),
        ("linear momentum residual, relative", "momentum", "linear_residual_max"),
        ("angular momentum residual, relative", "momentum", "angular_residual_max"),
    ] {
        let value = residual(of, key);
        rows.push([
            label.to_owned(),
            quantity(value, "1"),
            verdict(value, of, scheme, midpoint_force),
        ]);
    }
    let drift = residual("audit", "curvature_drift_max");
    rows.push(["curvature drift".to_owned(), quantity(drift, "1/m"), drift_verdict(drift)]);
    let drift = residual("audit", "membrane_drift_max");
    rows.push(["membrane strain drift".to_owned(), quantity(drift, "1"), drift_verdict(drift)]);
    let drift = residual("audit", "angular_rate_drift_max");
    rows.push([
        "angular rate drift, relative".to_owned(),
        quantity(drift.map(|d| without_round_off(d, 1.0)), "1"),
        rate_verdict(drift),
    ]);
    rows.push(newton(summary));
    rows.push(step_cuts(summary));
    rows.extend(accumulated_steps(summary));
    rows.extend(multiple_impacts(summary));
    let rows: Vec<Vec<String>> = rows.into_iter().map(Vec::from).collect();
    table("Maximum over the run", &["quantity", "value", "comment"], &rows)
}

fn verdict(value: Option<f64>, what: &str, scheme: &str, midpoint_force: bool) -> String {
    let Some(value) = value else { return "not known".to_owned() };
    if value.abs() <= CLOSED {
        return "satisfied (below 1e-10)".to_owned();
    }
    let by_design = match (scheme, what) {
        ("generalized-alpha", "energy") => Some("numerical dissipation of the scheme"),
        ("newmark" | "generalized-alpha", _) => Some("not conserved by this scheme"),
        ("midpoint", "energy") => Some("not conserved by the midpoint rule where a beam rotates"),
        (_, "energy") if midpoint_force => {
            Some("not conserved by the midpoint force in steps in which a contact opens or closes")
        }
        _ => None,
    };
    by_design.unwrap_or("exceeds 1e-10").to_owned()
}

fn drift_verdict(drift: Option<f64>) -> String {
    match drift {
        None => "not known",
        Some(0.0) => "none",
        Some(_) => "difference between stored strains and configuration",
    }
    .to_owned()
}

/// Whether section rotation rates and nodal velocities, two accounts of one motion, agree.
fn rate_verdict(drift: Option<f64>) -> String {
    match drift {
        None => "not known",
        Some(drift) if drift > AuditSummary::UNRESOLVED => {
            "difference of the kinetic energies from nodal velocities and section rotation rates; use a smaller step"
        }
        Some(_) => "below the limit: the step resolves the motion",
    }
    .to_owned()
}

fn newton(summary: &Value) -> [String; 3] {
    let iterations = summary["newton_iterations"].as_u64();
    let steps = summary["solver_steps"].as_u64().or(summary["steps"].as_u64());
    let average = iterations.zip(steps).filter(|(_, steps)| *steps > 0);
    let verdict = average.map_or(String::new(), |(iterations, steps)| {
        format!(
            "{} per step on average",
            number((iterations as f64 / steps as f64 * 100.0).round() / 100.0)
        )
    });
    let count = iterations.map_or("\u{2013}".to_owned(), |n| n.to_string());
    ["Newton iterations".to_owned(), count, verdict]
}

fn step_cuts(summary: &Value) -> [String; 3] {
    let cuts = summary["step_cuts"].as_u64();
    let verdict = match cuts {
        None => "not known",
        Some(0) => "none",
        Some(_) => "steps halved after failed Newton iterations; consider a smaller step",
    };
    let count = cuts.map_or("\u{2013}".to_owned(), |n| n.to_string());
    ["step cuts".to_owned(), count, verdict.to_owned()]
}

/// Steps with more impacts than are followed, where there are any.
fn accumulated_steps(summary: &Value) -> Option<[String; 3]> {
    let steps = summary["accumulated_steps"].as_u64().filter(|steps| *steps > 0)?;
    let verdict = "more impacts in a step than are followed one by one: the last ones are without rebound; a smaller step follows more";
    Some(["steps with accumulated impacts".to_owned(), steps.to_string(), verdict.to_owned()])
}

/// Impacts on several touching bodies at once, where there are any.
fn multiple_impacts(summary: &Value) -> Option<[String; 3]> {
    // Summaries of earlier versions have the old key.
    let shared = summary.get("multiple_impacts").unwrap_or(&summary["shared_blows"]);
    let count = shared["count"].as_u64().filter(|count| *count > 0)?;
    let name = |k: usize| shared["contacts"][k].as_str().unwrap_or("?").to_owned();
    let verdict = format!(
        "multiple impact, first at {} in contacts '{}' and '{}': the result depends on the impact law; \
         time.multiple_impacts = \"sequential\" resolves one impact after another",
        quantity(shared["first"].as_f64(), "s"),
        name(0),
        name(1)
    );
    Some(["multiple impacts".to_owned(), count.to_string(), verdict])
}

/// The step given, or those chosen for an accuracy.
fn step(summary: &Value) -> String {
    let control = &summary["step_control"];
    let Some(accuracy) = control["accuracy"].as_f64() else {
        return quantity(summary["settings"]["step"].as_f64(), "s");
    };
    let [smallest, largest, mean] =
        ["smallest", "largest", "mean"].map(|key| quantity(control[key].as_f64(), "s"));
    let percent = |share: f64| format!("{}\u{a0}%", number(100.0 * share));
    let mut text =
        format!("for an accuracy of {}: {smallest} to {largest}, mean {mean}", percent(accuracy));
    if let Some(refused) = control["refused"].as_u64() {
        text += &format!(", {refused} repeated");
    }
    if let Some(estimate) = control["estimate"].as_f64() {
        text += &format!("; estimated error {}", percent(estimate));
    }
    text
}

/// The settings of the run and its cost.
pub(super) fn settings(summary: &Value) -> String {
    let settings = &summary["settings"];
    let text = |value: &Value| value.as_str().map_or("\u{2013}".to_owned(), str::to_owned);
    let count = |value: &Value| value.as_u64().map_or("\u{2013}".to_owned(), |n| n.to_string());
    let mut scheme = text(&settings["scheme"]);
    if let Some(radius) = settings["spectral_radius"].as_f64() {
        scheme = format!("{scheme}, spectral radius {}", number(radius));
    }
    let mut impacts = text(&settings["impacts"]);
    if let Some(tolerance) = settings["closed_tolerance"].as_f64() {
        impacts = format!("{impacts}, closed below {}", quantity(Some(tolerance), "m"));
    }
    if settings["multiple_impacts"] == "sequential" {
        impacts += ", multiple impacts resolved one after another";
    }
    let start = match settings["start"].as_str() {
        Some("static") => "static equilibrium under the loads at time zero",
        Some("reference") => "reference configuration, free of stress",
        _ => "\u{2013}",
    };
    let rows = [
        ("scheme", scheme),
        ("impacts of rigid projectiles", impacts),
        ("start", start.to_owned()),
        ("step", step(summary)),
        ("end time requested", quantity(settings["end"].as_f64(), "s")),
        ("time reached", quantity(summary["time"].as_f64(), "s")),
        ("steps", count(&summary["steps"])),
        ("solver steps, including trials", count(&summary["solver_steps"])),
        ("factorisations", count(&summary["factorizations"])),
        ("rows recorded", count(&summary["rows"])),
        ("wall time", quantity(summary["wall_seconds"].as_f64(), "s")),
    ];
    let rows: Vec<Vec<String>> = rows.into_iter().map(|(k, v)| vec![k.to_owned(), v]).collect();
    table("Settings and cost", &[], &rows)
}
