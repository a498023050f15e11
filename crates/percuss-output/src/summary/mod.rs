//! `summary.json`: what a run amounts to.

mod advice;
mod contact;
mod derivative;
mod every_event;
mod open;
mod peak;
mod pick;
pub(crate) mod plastic;
mod provenance;

use std::path::Path;

use percuss::{
    FoundationProperties, FoundationSummary, ImpactResolution, MultipleImpacts, Peak, PointSummary,
    ProjectileSummary, PulseOf, PulseSummary, Range, RunSummary, Scheme, SectionForceSummary,
    SectionPeak, SectionRange, Settings, Start, StopTouch, SupportSummary, Termination,
};
use percuss_advice::{Advice, AuditWarning, Comparison};
use percuss_codes::Code;
use serde_json::{Map, Value, json};

use crate::error::Error;
use crate::files;
use peak::peak;

use advice::allowances;
pub use derivative::pick_derivatives;
pub use pick::{Picked, SummaryPath, pick, summary_paths};
pub use provenance::RunSource;

const SUMMARY: &str = "summary.json";

/// What a summary says beside the numbers of the run.
#[derive(Clone, Copy, Debug)]
pub struct RunInfo<'a> {
    /// The scenario's title.
    pub title: &'a str,
    /// How the run was carried out.
    pub settings: &'a Settings,
    /// Time the run took \[s\].
    pub wall_seconds: f64,
    /// What the advisor said before it, shape (findings).
    pub advice: &'a [Advice],
    /// What its audit warns of, shape (warnings).
    pub warnings: &'a [AuditWarning],
    /// Its results beside hand formulas, shape (comparisons).
    pub comparisons: &'a [Comparison],
}

/// The content of `summary.json` of a scenario's run, with what the scenario allows, a code with its reason each, and the origin of the run: the same
/// for the command and for Python.
pub fn scenario_summary(
    run: &RunSummary,
    info: RunInfo<'_>,
    allowed: &[(Code, &str)],
    source: RunSource<'_>,
) -> Value {
    let mut value = summary_value(run, info);
    value["provenance"] = source.value();
    value["allow"] = allowances(allowed, info.advice, info.warnings);
    value
}

/// The content of `summary.json` that follows from the run alone; NaN and infinities become `null`.
pub fn summary_value(run: &RunSummary, info: RunInfo<'_>) -> Value {
    let mut summary = json!({
        "percuss_version": env!("CARGO_PKG_VERSION"),
        "title": info.title,
        "status": status(&run.termination),
        "time": run.time,
        "steps": run.steps,
        "solver_steps": run.solver_steps,
        "step_cuts": run.step_cuts,
        "accumulated_steps": run.accumulated_steps,
        "newton_iterations": run.newton_iterations,
        "factorizations": run.factorizations,
        "rows": run.rows,
        "wall_seconds": info.wall_seconds,
        "settings": settings(info.settings),
        "energy": energy(run),
        "momentum": momentum(run),
        "audit": audit(run),
        "projectile": projectiles(run),
        "contact": named(&run.contacts, |c| &c.name, contact::value),
        "contact_residual_max": run.contact_residual_max,
        "multiple_impacts": multiple_impacts(run),
        "point": named(&run.points, |p| &p.name, point),
        "support": named(&run.supports, |s| &s.name, support),
        "plastic": named(&run.plastic, |b| &b.name, plastic::value),
        "yielding": named(&run.yielding, |c| &c.name, plastic::yielding),
        "joint": named(&run.joints, |j| &j.name, plastic::joint),
        "section_forces": named(&run.section_forces, |b| &b.name, section_forces),
        "advice": info.advice.iter().map(advice::finding).collect::<Vec<_>>(),
        "warnings": info.warnings.iter().map(advice::warning).collect::<Vec<_>>(),
        "hand_formulas": info.comparisons.iter().map(advice::comparison).collect::<Vec<_>>(),
    });
    if !run.foundations.is_empty() {
        summary["foundation"] = named(&run.foundations, |f| &f.name, foundation);
    }
    let springs = springs(run);
    if !springs.is_empty() {
        summary["spring"] = springs.into();
    }
    if run.step_control.is_some() {
        summary["step_control"] = step_control(run);
    }
    if let Termination::Failed(error) = &run.termination {
        summary["error"] = Value::from(error.to_string());
        summary["error_code"] = Value::from(error.code().code());
    }
    summary
}

/// Springs that act on one side or along a table.
fn springs(run: &RunSummary) -> Map<String, Value> {
    let of = |pulse: &PulseSummary| match &pulse.of {
        PulseOf::Spring(name) => Some((name.clone(), json!({ "peak_force": peak(&pulse.force) }))),
        _ => None,
    };
    run.pulses.iter().filter_map(of).collect()
}

/// Impacts that several touching bodies shared; `null` where there was none.
fn multiple_impacts(run: &RunSummary) -> Value {
    let shared = &run.multiple_impacts;
    if shared.count == 0 {
        return Value::Null;
    }
    let name = |k: usize| run.contacts.get(k).map(|c| c.name.as_str());
    json!({
        "count": shared.count,
        "first": shared.first,
        "contacts": shared.contacts.map(name),
    })
}

/// Sizes of steps where an accuracy was asked for; `null` where a step was given.
fn step_control(run: &RunSummary) -> Value {
    let Some(control) = &run.step_control else { return Value::Null };
    json!({
        "accuracy": control.accuracy,
        "estimate": control.estimate,
        "smallest": control.smallest,
        "largest": control.largest,
        "mean": control.mean,
        "refused": control.refused,
    })
}

fn energy(run: &RunSummary) -> Value {
    json!({
        "initial": run.energy.initial,
        "final": run.energy.final_,
        "work_loads": run.energy.work_loads,
        "work_supports": run.energy.work_supports,
        "loss_impacts": run.energy.loss_impacts,
        "loss_damping": run.energy.loss_damping,
        "loss_contacts": run.loss_contacts(),
        "plastic": run.energy.plastic,
        "hardening": run.energy.hardening,
        "failure": run.energy.failure,
        "scale": run.energy.scale,
        "residual_max": run.energy.residual_max,
    })
}

fn momentum(run: &RunSummary) -> Value {
    json!({
        "linear_scale": run.momentum.linear_scale,
        "linear_residual_max": run.momentum.linear_residual_max,
        "angular_scale": run.momentum.angular_scale,
        "angular_residual_max": run.momentum.angular_residual_max,
    })
}

fn audit(run: &RunSummary) -> Value {
    json!({
        "curvature_drift_max": run.audit.curvature_drift_max,
        "membrane_drift_max": run.audit.membrane_drift_max,
        "angular_rate_drift_max": run.audit.angular_rate_drift_max,
    })
}

/// Writes `summary.json` into `dir`.
///
/// # Errors
/// If the file cannot be written.
pub fn write_summary(dir: impl AsRef<Path>, summary: &Value) -> Result<(), Error> {
    files::write(&dir.as_ref().join(SUMMARY), format!("{summary:#}\n").as_bytes())
}

/// Reads `summary.json` in `dir`.
///
/// # Errors
/// If the file is not there or is not a JSON object.
pub fn read_summary(dir: impl AsRef<Path>) -> Result<Value, Error> {
    let path = dir.as_ref().join(SUMMARY);
    let summary: Value = serde_json::from_str(&files::read_text(&path)?)
        .map_err(|e| Error::content(&path, e.to_string()))?;
    if summary.is_object() {
        Ok(summary)
    } else {
        Err(Error::content(&path, "is not a summary (no JSON object)"))
    }
}

pub(crate) fn status(termination: &Termination) -> &'static str {
    match termination {
        Termination::Unsolved => "unsolved",
        Termination::Completed => "completed",
        Termination::Interrupted { .. } => "interrupted",
        Termination::Failed(_) => "failed",
    }
}

fn settings(settings: &Settings) -> Value {
    let (scheme, spectral_radius) = match settings.scheme {
        Scheme::EnergyMomentum => ("energy-momentum", None),
        Scheme::StrainRate => ("strain-rate", None),
        Scheme::Midpoint => ("midpoint", None),
        Scheme::Newmark => ("newmark", None),
        Scheme::GeneralizedAlpha { spectral_radius } => {
            ("generalized-alpha", Some(spectral_radius))
        }
    };
    let (impacts, closed_tolerance) = match settings.impacts {
        ImpactResolution::Event => ("event", None),
        ImpactResolution::TimeStepping { closed_tolerance } => {
            ("time-stepping", Some(closed_tolerance))
        }
    };
    let mut value = json!({
        "end": settings.end,
        "record_every": settings.record_every,
        "start": match settings.start {
            Start::Reference => "reference",
            Start::Static => "static",
        },
        "scheme": scheme,
        "impacts": impacts,
        "multiple_impacts": match settings.multiple_impacts {
            MultipleImpacts::Simultaneous => "simultaneous",
            MultipleImpacts::Sequential => "sequential",
        },
    });
    match settings.accuracy {
        Some(accuracy) => {
            value["accuracy"] = Value::from(accuracy);
            value["first_step"] = Value::from(settings.step);
        }
        None => value["step"] = Value::from(settings.step),
    }
    if let Some(radius) = spectral_radius {
        value["spectral_radius"] = Value::from(radius);
    }
    if let Some(tolerance) = closed_tolerance {
        value["closed_tolerance"] = Value::from(tolerance);
    }
    value
}

fn named<T>(items: &[T], name: fn(&T) -> &String, value: fn(&T) -> Value) -> Value {
    Value::Object(items.iter().map(|item| (name(item).clone(), value(item))).collect::<Map<_, _>>())
}

/// Projectiles by name; of one that still touches something at the end the names of those contacts, since its velocity is not that after
/// them.
fn projectiles(run: &RunSummary) -> Value {
    let mut all = named(&run.projectiles, |p| &p.name, projectile);
    for one in &run.projectiles {
        let touches: Vec<&str> = run.still_touches(&one.name).collect();
        if !touches.is_empty() {
            all[&one.name]["still_touches"] = touches.into();
        }
    }
    all
}

/// What a projectile of a summary is called: a free one, without a line of motion, is a disc.
pub(crate) fn kind_of_body(projectile: &Value) -> &'static str {
    if projectile.is_object() && projectile["direction"].is_null() { "disc" } else { "projectile" }
}

fn projectile(projectile: &ProjectileSummary) -> Value {
    json!({
        "direction": projectile.direction,
        "strikes": projectile.strikes,
        "velocity_final": projectile.velocity_final,
        "spin_final": projectile.spin_final,
        "momentum_transferred": projectile.momentum_transferred,
        "energy_given": projectile.energy_given,
        "energy_received_by_others": projectile.energy_received_by_others,
    })
}

fn point(point: &PointSummary) -> Value {
    let mut value = json!({
        "displacement_max": {
            "component_1": crest(&point.displacement_max[0], point.resolved[0]),
            "component_2": crest(&point.displacement_max[1], point.resolved[1]),
        }
    });
    if point.relative_to_base {
        value["relative_to_base"] = true.into();
    }
    value
}

fn crest(largest: &Peak, resolved: bool) -> Value {
    let mut value = peak(largest);
    value["resolved"] = Value::from(resolved);
    value
}

fn support(support: &SupportSummary) -> Value {
    let range = |r: &Range| json!({ "min": peak(&r.min), "max": peak(&r.max) });
    let mut value = json!({
        "force_1": range(&support.force[0]),
        "force_2": range(&support.force[1]),
        "moment": range(&support.moment),
        "impulse_1": support.impulse[0],
        "impulse_2": support.impulse[1],
        "impulse_moment": support.impulse[2],
    });
    if let Some(touches) = &support.touches {
        value["intervals"] = touches.iter().map(touch).collect();
    }
    value
}

fn foundation(found: &FoundationSummary) -> Value {
    let range = |r: &Range| json!({ "min": peak(&r.min), "max": peak(&r.max) });
    let at = |p: &SectionPeak| (p.value != 0.0).then(|| place(p));
    let FoundationProperties { beam, stretch, kind, stiffness } = &found.properties;
    json!({
        "beam": beam,
        "stretch": stretch,
        "law": kind.name(),
        "stiffness": stiffness,
        "force_1": range(&found.force[0]),
        "force_2": range(&found.force[1]),
        "pressure_max": place(&found.pressure.largest()),
        "pressure": { "min": place(&found.pressure.min), "max": place(&found.pressure.max) },
        "lifted_max": peak(&found.lifted),
        "energy_max": peak(&found.energy_max),
        "energy": found.energy,
        "plastic_deflection": at(&found.plastic),
        "first_yield": found.first_yield.map(|time| json!({ "time": time })),
        "dissipated": found.dissipated,
        "dissipated_by_preload": found.dissipated_by_preload,
        "hardening": found.hardening,
    })
}

/// A time in which a stop pressed.
fn touch(touch: &StopTouch) -> Value {
    json!({
        "start": touch.start,
        "end": touch.end,
        "impulse": touch.impulse,
        "peak_force": peak(&touch.peak_force),
    })
}

fn section_forces(beam: &SectionForceSummary) -> Value {
    let range = |r: &SectionRange| json!({ "min": place(&r.min), "max": place(&r.max) });
    let mut value = json!({
        "moment_max": place(&beam.moment.largest()),
        "axial_max": place(&beam.axial.largest()),
        "shear_max": place(&beam.shear.largest()),
        "moment": range(&beam.moment),
        "axial": range(&beam.axial),
        "shear": range(&beam.shear),
        "stress": range(&beam.stress),
        "strain": range(&beam.strain),
        "shear_stress": range(&beam.shear_stress),
        "von_mises_max": place(&beam.von_mises()),
    });
    if let Some(length) = beam.envelope.s.last() {
        value["length"] = json!(length);
    }
    if let Some(plateau) = beam.plateau {
        value["yield_stress"] = json!(plateau);
    }
    if let Some(beyond) = &beam.beyond {
        value["first_beyond_strength"] = place(beyond);
    }
    if let Some(beyond) = &beam.beyond_inside {
        value["von_mises_beyond_strength"] = place(beyond);
    }
    value
}

fn place(peak: &SectionPeak) -> Value {
    json!({ "value": peak.value, "s": peak.s, "time": peak.time })
}
