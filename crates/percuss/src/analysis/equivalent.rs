//! The equivalent static force of an impact: the force with the same peak effect on the structure, as used in design.
//!
//! It acts at the struck point along the line of motion, in addition to the permanent loads, in nonlinear statics with large displacements: the
//! largest bending moment in the struck beam, or the deflection of the struck point, is that of the run. For a structure that yielded it is the
//! force on the same structure, assumed elastic.

use super::path::{Effect, PushPlace, Pushed};
use super::spectrum::{Layout, free_motions};
use super::static_search::StaticSearch;
use crate::element::fibre::{PlasticLaw, StressLaw};
use crate::model::Model;
use crate::model::frozen::ProjectileData;
use crate::settings::{Scheme, Start};
use crate::state::State;
use crate::summary::{EquivalentForce, NoEquivalentForce, RunSummary};

/// Structures of more elements have no equivalent force: the search would cost more than such a run.
const MOST_ELEMENTS: usize = 20_000;
/// Changes of moments and deflections below this share are round-off.
const ROUND_OFF: f64 = 1e-11;

/// The equivalent static force of a run in which one guided projectile strikes a structure at rest.
///
/// # Errors
/// The reason why there is none: other actions than the impact and permanent loads, or no such equilibrium.
pub fn equivalent_force(
    model: &Model,
    start: Start,
    run: &RunSummary,
) -> Result<EquivalentForce, String> {
    let projectile = striker(model)?;
    if !run.contacts.first().is_some_and(|contact| contact.record.has_closed()) {
        return Err("the contact did not close".into());
    }
    refuse_others(model, start)?;
    refuse_failures(run)?;
    let yielded = run.plastic.iter().any(|beam| beam.first_yield.is_some())
        || run.yielding.iter().any(|one| one.first_yield.is_some());
    let mut structure = model.structure();
    if yielded {
        make_elastic(&mut structure);
    }
    let borne = start == Start::Static;
    if !borne && is_loose(&structure) {
        return Err("the structure is not supported in this direction".into());
    }
    let sides = |side: f64| PushPlace {
        point: &projectile.point,
        direction: projectile.direction.map(|e| side * e),
    };
    let mut pushed = Pushed::new(&structure, sides(1.0), borne)?;
    let [moment_before, sag] = pushed.before();
    let moment = run.section_forces[projectile.point.beam].moment.largest().value.abs();
    if moment.is_nan() || moment <= moment_before * (1.0 + ROUND_OFF) {
        return Err("the impact does not increase the bending moment".into());
    }
    let by_moment = pushed.force_of(Effect::Moment(moment));
    let deflection = deflection(model, projectile, run);
    let rebounds = deflection.is_ok_and(|w| w < sag);
    let by_deflection = match deflection {
        Err(why) => Err(why),
        Ok(w) if !rebounds => pushed.force_of(Effect::Deflection(w)),
        // A force the other way.
        Ok(w) => Pushed::new(&structure, sides(-1.0), borne)?.force_of(Effect::Deflection(-w)),
    };
    if let (Err(why), Err(_)) = (by_moment, by_deflection) {
        return Err(why.to_string());
    }
    Ok(EquivalentForce {
        moment: by_moment,
        deflection: by_deflection,
        on_rebound: rebounds && by_deflection.is_ok(),
        beside_loads: borne && !model.loads.is_empty(),
        as_if_elastic: yielded,
    })
}

/// The only projectile.
fn striker(model: &Model) -> Result<&ProjectileData, &'static str> {
    match (model.projectiles.as_slice(), model.contacts.len()) {
        ([projectile], 1) => Ok(projectile),
        ([], _) => Err("no guided projectile"),
        _ => Err("other contacts are possible"),
    }
}

/// Rejects motions and loads other than the impact and permanent loads in equilibrium.
fn refuse_others(model: &Model, start: Start) -> Result<(), &'static str> {
    if !model.loads.iter().all(|load| load.is_steady()) {
        return Err("loads other than permanent ones act");
    }
    if !model.loads.is_empty() && start != Start::Static {
        return Err("the structure vibrates under its loads: use time.start = \"static\"");
    }
    let settled = start == Start::Static && model.motions.iter().all(|m| m.is_constant());
    if !model.motions.is_empty() && !settled {
        return Err("supports have prescribed motions");
    }
    if model.releases().next().is_some() {
        return Err("a support is released");
    }
    if !model.is_still() {
        return Err("the structure moves from the start");
    }
    if model.connectors.iter().any(|c| c.tied_nodes().next().is_some()) {
        return Err("a spring ends at a projectile");
    }
    if model.element_count() > MOST_ELEMENTS {
        return Err("not determined for more than 20000 elements");
    }
    Ok(())
}

/// Rejects runs in which a part failed: no static force has their effect on the structure as it was.
fn refuse_failures(run: &RunSummary) -> Result<(), &'static str> {
    let failed = run.joints.iter().any(|joint| joint.parted.is_some())
        || run.plastic.iter().any(|beam| !beam.parted.is_empty() || beam.failed > 0)
        || run.yielding.iter().any(|one| one.failed.is_some());
    if failed { Err("part of the structure failed") } else { Ok(()) }
}

/// Whether beams can move without strain in the reference configuration.
fn is_loose(structure: &Model) -> bool {
    let rest = State::at_rest(structure, Scheme::EnergyMomentum);
    let layout = Layout::new(structure);
    !free_motions(&layout, &StaticSearch::at(structure, &rest)).motions.is_empty()
}

/// Replaces laws that yield by their elastic parts; what bears tension or compression alone still does.
fn make_elastic(structure: &mut Model) {
    let elastic = |law: &mut StressLaw| {
        if let StressLaw::Plastic(PlasticLaw { young, slack, .. }) = *law {
            *law = match slack {
                Some(slack) => StressLaw::OneSided { young, slack },
                None => StressLaw::Elastic { young },
            };
        }
    };
    let fibres = structure.spans.iter_mut().filter_map(|span| span.fibres.as_mut());
    fibres.flat_map(|of| &mut of.laws).for_each(elastic);
    let yielding = structure.connectors.iter_mut().filter_map(|c| c.yielding.as_mut());
    yielding.for_each(|own| own.law = None);
}

/// The displacement of the struck point of largest magnitude in the run, along the line of motion \[m\].
///
/// # Errors
/// The point, or its displacement in this direction, is not recorded.
fn deflection(
    model: &Model,
    projectile: &ProjectileData,
    run: &RunSummary,
) -> Result<f64, NoEquivalentForce> {
    let recorded = run.points.iter().find(|p| p.name == model.contacts[0].between[0]);
    let recorded = recorded.ok_or(NoEquivalentForce::NotRecorded)?;
    let along = (0..2).find(|k| projectile.direction[*k].abs() > 1.0 - 1e-12);
    let along = along.ok_or(NoEquivalentForce::Oblique)?;
    Ok(recorded.displacement_max[along].value * projectile.direction[along])
}
