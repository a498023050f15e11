//! Faults of loads that give strains.

use super::super::builder::ModelBuilder;
use super::super::definition::*;
use super::beams::{arc, check_stretch};
use super::faults::Faults;
use super::functions::factors;
use crate::model::time_function::TimeFunction;

/// A beam whose strains are given along a stretch, if it is one of the model: elastic, for fibres that yield do not know of given strains.
pub(super) fn check_strained<'m>(
    model: &'m ModelBuilder,
    beam: BeamId,
    stretch: [Along; 2],
    path: &impl Fn(&str) -> String,
    out: &mut Faults,
) -> Option<&'m Beam> {
    let Some(beam) = model.beams.get(beam.0 as usize) else {
        out.add(path("on"), "an unknown beam", "a beam of this model");
        return None;
    };
    check_stretch(beam, stretch, path, out);
    let mut sections =
        std::iter::once(beam.section).chain(beam.changes.iter().filter_map(|c| c.section));
    let fibres = |id: SectionId| {
        let section = model.sections.get(id.0 as usize);
        section.is_some_and(|section| section.given_fibres().is_some())
    };
    let inelastic = materials(model, beam).find(|m| m.inelasticity.is_some());
    if let Some(material) = inelastic {
        let found = format!(
            "`{}` of the material `{}`, which yields or bears stress of one sign",
            beam.name, material.name
        );
        out.add(path("on"), found, "a beam of elastic materials");
    } else if sections.any(fibres) {
        let found = format!("`{}`, whose section is given by fibres", beam.name);
        out.add(path("on"), found, "a beam whose sections have a shape or constants");
    }
    Some(beam)
}

/// Materials of a beam.
fn materials<'m>(model: &'m ModelBuilder, beam: &Beam) -> impl Iterator<Item = &'m Material> {
    let changed: Vec<MaterialId> = beam.changes.iter().filter_map(|c| c.material).collect();
    let all = std::iter::once(beam.material).chain(changed);
    all.filter_map(|id| model.materials.get(id.0 as usize))
}

/// Heat strains what expands.
pub(super) fn check_expansion(
    model: &ModelBuilder,
    beam: &Beam,
    path: &impl Fn(&str) -> String,
    out: &mut Faults,
) {
    if let Some(material) = materials(model, beam).find(|m| m.expansion == 0.0) {
        let found =
            format!("`{}` of the material `{}` without `expansion`", beam.name, material.name);
        out.add(path("on"), found, "materials with an `expansion`, such as 12e-6 1/K of steel");
    }
}

/// Membrane strain that a load gives to a material by a factor of one \[-\]; zero of other loads.
fn strain(load: &Load, material: &Material) -> f64 {
    match load.kind {
        LoadKind::Strain { strain, .. } => strain,
        LoadKind::Temperature { change, .. } => material.expansion * change,
        _ => 0.0,
    }
}

/// A strain that no configuration has at some time of the load, since nothing is left of the length.
pub(super) fn check_length(model: &ModelBuilder, beam: &Beam, load: &Load, out: &mut Faults) {
    for material in materials(model, beam) {
        let all = factors(&load.function).map(|factor| factor * strain(load, material));
        let least = all.into_iter().fold(f64::INFINITY, f64::min);
        if least.is_finite() && leaves_nothing(beam, material, load, (least, ""), out) {
            return;
        }
    }
}

/// The same of the sum of loads that act all the time, each of which leaves a length.
pub(super) fn check_sums_of_strains(model: &ModelBuilder, out: &mut Faults) {
    for (index, beam) in model.beams.iter().enumerate() {
        let arcs = |load: &Load| match load.kind {
            LoadKind::Strain { beam: on, stretch, .. }
            | LoadKind::Temperature { beam: on, stretch, .. } => {
                let always = load.function == TimeFunction::Constant && load.from <= 0.0;
                (always && on.0 as usize == index).then(|| stretch.map(|along| arc(beam, along)))
            }
            _ => None,
        };
        let all: Vec<(&Load, [f64; 2])> =
            model.loads.iter().filter_map(|load| Some((load, arcs(load)?))).collect();
        for (last, [start, _]) in &all {
            let here = |one: &&(&Load, [f64; 2])| one.1[0] <= *start && *start < one.1[1];
            for material in materials(model, beam) {
                let (_, limit) = limit(beam, material);
                let each = all.iter().filter(here).map(|one| strain(one.0, material));
                let sum: f64 = each.clone().sum();
                if each.clone().all(|one| one > limit)
                    && leaves_nothing(beam, material, last, (sum, " of all loads together"), out)
                {
                    return;
                }
            }
        }
    }
}

/// Strain at which nothing is left of a length, and its name: `(l^2 - 1) / 2` of Green or `l - 1` of engineers, with the stretch l of zero.
fn limit(beam: &Beam, material: &Material) -> (&'static str, f64) {
    match (beam.theory, material.strain) {
        (Theory::Slender, StrainMeasure::Green) => ("Green", -0.5),
        _ => ("engineering", -1.0),
    }
}

/// Whether nothing is left of the length by a strain, which is a fault of a load then; `whose` follows the strain in the message.
fn leaves_nothing(
    beam: &Beam,
    material: &Material,
    load: &Load,
    (strain, whose): (f64, &str),
    out: &mut Faults,
) -> bool {
    let (kind, limit) = limit(beam, material);
    let nothing = strain <= limit;
    if nothing {
        let key = if matches!(load.kind, LoadKind::Strain { .. }) { "strain" } else { "change" };
        let shown = (strain * 1e6).round() / 1e6;
        let found = format!("a strain of {shown} without forces{whose}, which leaves no length");
        let expected = format!("{kind} strains above {limit} in `{}`", beam.name);
        out.add(format!("load.{}.{key}", load.name), found, &expected);
    }
    nothing
}
