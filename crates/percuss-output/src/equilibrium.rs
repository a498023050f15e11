//! A static equilibrium on disk: numbers and a page.

use std::path::Path;

use percuss::{
    Equilibrium, FailureKind, FollowerStability, FoundationProperties, LargestDisplacement,
    LinearBuckling, Model, PlasticSummary, PointForces, SectionForceSummary, SectionPeak,
    SectionRange, StaticBalance, StaticContact, StaticFailure, StaticFoundation, StaticYielding,
    yielded_at_rest,
};
use serde_json::{Map, Value, json};

use crate::error::Error;
use crate::files;
use crate::report::still;
pub use crate::report::still::EquilibriumInfo;
use crate::summary::plastic;

/// Writes `static.json` and `static.html` into `dir`.
///
/// # Errors
/// If a file cannot be written.
pub fn write_equilibrium(dir: impl AsRef<Path>, info: &EquilibriumInfo<'_>) -> Result<(), Error> {
    let dir = dir.as_ref();
    files::write(&dir.join("static.html"), still::equilibrium_page(info).as_bytes())?;
    let value = equilibrium_value(info.model, info.found, info.linear);
    files::write(&dir.join("static.json"), format!("{value:#}\n").as_bytes())
}

/// Everything about an equilibrium; what has no value is `null`.
pub fn equilibrium_value(model: &Model, found: &Equilibrium, linear: &LinearBuckling) -> Value {
    let points = found.points.iter().zip(&found.rotations).map(|((name, u), rotation)| {
        (name.clone(), json!({ "displacement": u, "rotation": rotation }))
    });
    let sections = found.points.iter().zip(&found.point_forces);
    let sections = sections.map(|((name, _), forces)| (name.clone(), section(forces)));
    let supports = found.reactions.iter().map(|(name, [f1, f2, moment])| {
        (name.clone(), json!({ "force_1": f1, "force_2": f2, "moment": moment }))
    });
    let contacts = found.contacts.iter().map(|c| (c.name.clone(), contact(c)));
    let yielding = found.yielding.iter().map(|y| (y.name.clone(), yielding(y)));
    let foundations = found.foundations.iter().map(|f| (f.name.clone(), foundation(f)));
    let foundations = foundations.collect::<Map<_, _>>();
    let yields = yielded_at_rest(model, found);
    let yields = yields.iter().map(|beam| (beam.name.clone(), plastic(model, found, beam)));
    let forces = found.section_forces.iter().map(|b| (b.name.clone(), section_forces(b)));
    let mut value = json!({
        "stable": found.stable,
        "sliding": found.sliding,
        "load_steps": found.load_steps,
        "newton_iterations": found.newton_iterations,
        "largest_displacement": found.largest_displacement.as_ref().map(moved),
        "point": points.collect::<Map<_, _>>(),
        "section": sections.collect::<Map<_, _>>(),
        "support": supports.collect::<Map<_, _>>(),
        "contact": contacts.collect::<Map<_, _>>(),
        "yielding": yielding.collect::<Map<_, _>>(),
        "plastic": yields.collect::<Map<_, _>>(),
        "softening": found.softening,
        "section_forces": forces.collect::<Map<_, _>>(),
        "failures": found.failures.iter().map(failure).collect::<Vec<_>>(),
        "balance": balance(&found.balance),
        "linear_buckling": linear.modes.iter().map(|mode| mode.factor).collect::<Vec<_>>(),
        "linear_buckling_assumptions": linear.assumptions(),
        "linear_buckling_note": linear.outcome.reason(),
        "linear_buckling_code": linear.outcome.code().map(percuss::Caution::code),
        "follower_stability": linear.stability.map(stability),
    });
    if !foundations.is_empty() {
        value["foundation"] = foundations.into();
    }
    value
}

fn moved(found: &LargestDisplacement) -> Value {
    let LargestDisplacement { beam, s, displacement } = found;
    json!({ "value": found.size(), "displacement": displacement, "beam": beam, "s": s })
}

pub(crate) fn failure(found: &StaticFailure) -> Value {
    let kind = match found.kind {
        FailureKind::Fibres => "fibres",
        FailureKind::Parted => "parted",
        FailureKind::Extension => "extension",
        FailureKind::Torn => "torn",
        _ => "failed",
    };
    json!({ "factor": found.factor, "name": found.name, "kind": kind, "s": found.s })
}

/// A foundation; of its reactions the largest and all along it.
fn foundation(found: &StaticFoundation) -> Value {
    let largest = found.largest();
    let FoundationProperties { beam, stretch, kind, stiffness } = &found.properties;
    json!({
        "beam": beam,
        "stretch": stretch,
        "law": kind.name(),
        "stiffness": stiffness,
        "force_1": found.force[0],
        "force_2": found.force[1],
        "pressure_max": largest.map(|(value, s)| json!({ "value": value, "s": s })),
        "s": found.s,
        "pressure": found.pressure,
        "lifted": found.lifted,
        "energy": found.energy,
        "plastic_deflection": found.plastic,
    })
}

fn balance(found: &StaticBalance) -> Value {
    json!({
        "loads": found.loads,
        "reactions": found.reactions,
        "springs": found.springs,
        "unbalanced": found.unbalanced,
    })
}

fn stability(found: FollowerStability) -> Value {
    match found {
        FollowerStability::Flutter { factor, frequency } => {
            json!({ "kind": "flutter", "factor": factor, "frequency": frequency })
        }
        FollowerStability::Divergence { factor } => {
            json!({ "kind": "divergence", "factor": factor })
        }
        FollowerStability::Kept { up_to } => json!({ "kind": "none found", "up_to": up_to }),
        _ => Value::Null,
    }
}

fn contact(found: &StaticContact) -> Value {
    json!({
        "between": found.between,
        "force": found.force,
        "resultant": found.resultant,
        "gap": found.gap,
        "s": found.s,
        "centre": found.centre,
        "friction": "none in statics",
    })
}

fn yielding(found: &StaticYielding) -> Value {
    let [what, force] = if found.turns { ["rotation", "moment"] } else { ["extension", "force"] };
    let entries = [
        (what.to_owned(), found.extension.into()),
        (format!("plastic_{what}"), found.plastic.into()),
        (force.to_owned(), found.force.into()),
        ("yielded".to_owned(), found.yielded.into()),
        ("failed".to_owned(), found.failed.into()),
    ];
    let set = plastic::set_beside(&found.permanent_set);
    Value::Object(entries.into_iter().chain(set).collect())
}

/// What a beam that can yield has come to: as after a run, with shares of the loads in the place of times.
fn plastic(model: &Model, found: &Equilibrium, beam: &PlasticSummary) -> Value {
    let index = (0..model.beam_count()).find(|k| model.beam(*k).name() == beam.name);
    let first = index.and_then(|k| found.first_yields.get(k).copied().flatten());
    let mut value = plastic::value(beam);
    if let Value::Object(entries) = &mut value {
        entries.remove("dissipated_by_preload");
        let at = |s: f64| if s.is_nan() { Value::Null } else { json!({ "s": s }) };
        entries.insert("strain_max_at".to_owned(), at(beam.strain_max.s));
        let share = first.map(|first| first.share);
        let yielded = beam.first_yield.map(|one| json!({ "s": one.s, "load_factor": share }));
        entries.insert("first_yield".to_owned(), yielded.into());
    }
    value
}

/// Section forces and stresses at a recorded point, as in the columns of a history.
fn section(at: &PointForces) -> Value {
    json!({
        "axial": at.axial,
        "shear": at.shear,
        "moment": at.moment,
        "stress": at.stress.largest,
        "stress_top": at.stress.top,
        "stress_bottom": at.stress.bottom,
    })
}

fn section_forces(beam: &SectionForceSummary) -> Value {
    let peak = |p: SectionPeak| json!({ "value": p.value, "s": p.s });
    let range = |r: &SectionRange| json!({ "min": peak(r.min), "max": peak(r.max) });
    let mut value = json!({
        "moment_max": peak(beam.moment.largest()),
        "axial_max": peak(beam.axial.largest()),
        "shear_max": peak(beam.shear.largest()),
        "moment": range(&beam.moment),
        "axial": range(&beam.axial),
        "shear": range(&beam.shear),
        "stress": range(&beam.stress),
        "strain": range(&beam.strain),
        "shear_stress": range(&beam.shear_stress),
        "von_mises_max": peak(beam.von_mises()),
    });
    if let Some(plateau) = beam.plateau {
        value["yield_stress"] = plateau.into();
    }
    if let Some(beyond) = beam.beyond {
        value["beyond_strength"] = peak(beyond);
    }
    if let Some(beyond) = beam.beyond_inside {
        value["von_mises_beyond_strength"] = peak(beyond);
    }
    value
}
