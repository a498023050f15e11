//! Faults of loads that give strains.

use super::super::builder::ModelBuilder;
use super::super::definition::*;
use super::beams::check_stretch;
use super::faults::Faults;
use super::functions::factors;

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

/// A strain that no configuration has at some time of the load, since nothing is left of the length: a Green strain `(l^2 - 1) / 2` of -1/2 or an
/// engineering strain `l - 1` of -1, of the stretch l. `strain` is that of a material by a factor of one, `path` its key.
pub(super) fn check_length(
    model: &ModelBuilder,
    beam: &Beam,
    load: &Load,
    (path, strain): (String, impl Fn(&Material) -> f64),
    out: &mut Faults,
) {
    for material in materials(model, beam) {
        let measure = match beam.theory {
            Theory::Slender => material.strain,
            Theory::Shear => StrainMeasure::Engineering,
        };
        let (kind, limit) = match measure {
            StrainMeasure::Green => ("Green", -0.5),
            StrainMeasure::Engineering => ("engineering", -1.0),
        };
        let least = factors(&load.function).map(|f| f * strain(material)).into_iter();
        let least = least.fold(f64::INFINITY, f64::min);
        if least.is_finite() && least <= limit {
            let shown = (least * 1e6).round() / 1e6;
            let found = format!("a strain of {shown} without forces, which leaves no length");
            let expected = format!("{kind} strains above {limit} in `{}`", beam.name);
            return out.add(path, found, &expected);
        }
    }
}
