//! Faults of shear-flexible beams.

use super::super::builder::ModelBuilder;
use super::super::definition::*;
use super::super::fibres::Make;
use super::faults::{Faults, quantity};

/// Share by which a shear modulus may differ from that of an isotropic material with the Poisson's ratio given beside it: tables round both.
const ROUNDED: f64 = 0.02;

/// Poisson's ratio and shear modulus of a material.
pub(super) fn check_shear_moduli(m: &Material, out: &mut Faults) {
    let path = |field: &str| format!("material.{}.{field}", m.name);
    if let Some(poisson) = m.poisson
        && !(poisson > -1.0 && poisson <= 0.5)
    {
        out.add(path("poisson"), quantity(poisson, ""), "a ratio above -1, up to 0.5");
    }
    if let Some(shear) = m.shear_modulus {
        out.positive(path("shear_modulus"), shear, "a shear modulus", "Pa");
    }
    let (Some(poisson), Some(shear)) = (m.poisson, m.shear_modulus) else { return };
    let isotropic = m.young / (2.0 * (1.0 + poisson));
    // NaN and values at fault say nothing of each other.
    if isotropic > 0.0 && shear > 0.0 && (shear / isotropic - 1.0).abs() > ROUNDED {
        let found = format!("{shear:.4e} Pa beside a Poisson's ratio of {poisson}");
        let expected = format!(
            "one of both, or the shear modulus of an isotropic material, {isotropic:.4e} Pa"
        );
        out.add(path("shear_modulus"), found, &expected);
    }
}

/// Shear factor of a section.
pub(super) fn check_shear_factor(s: &Section, out: &mut Faults) {
    if let Some(factor) = s.shear_factor {
        let path = format!("section.{}.shear_factor", s.name);
        out.positive(path, factor, "a shear factor", "");
    }
    for (k, station) in s.stations.iter().enumerate() {
        if let Some(factor) = station.properties.shear_factor {
            let path = format!("section.{}.stations[{k}].shear_factor", s.name);
            out.positive(path, factor, "a shear factor", "");
        }
    }
}

/// A shear-flexible beam needs a shear stiffness, and its sections need rotary inertia; it yields by engineering strains.
pub(super) fn check_theory(model: &ModelBuilder, beam: &Beam, out: &mut Faults) {
    if beam.theory == Theory::Slender {
        return;
    }
    let pairs =
        std::iter::once((None, None)).chain(beam.changes.iter().map(|c| (c.material, c.section)));
    let (mut material, mut section) = (beam.material, beam.section);
    for (m, s) in pairs {
        (material, section) = (m.unwrap_or(material), s.unwrap_or(section));
        let (Some(m), Some(s)) =
            (model.materials.get(material.0 as usize), model.sections.get(section.0 as usize))
        else {
            continue; // a fault of its own
        };
        check_pair(beam, &Make { material: m, section: s, materials: &model.materials }, out);
    }
}

fn check_pair(beam: &Beam, make: &Make, out: &mut Faults) {
    let (m, s) = (make.material, make.section);
    match s.given_fibres() {
        Some(fibres) => {
            let mut known: Vec<&str> = Vec::new();
            for material in fibres.iter().map(|fibre| make.of(fibre)) {
                if !known.contains(&material.name.as_str()) {
                    known.push(&material.name);
                    check_material(beam, material, out);
                }
            }
        }
        None => check_material(beam, m, out),
    }
    if !s.parts().all(|part| !part.shear_factor(m.poisson_in_shear()).is_nan()) {
        let found = format!("no shear factor for shear-flexible `{}`", beam.name);
        let expected = "`shear_factor`, such as 0.85, or a `shape` that has one";
        out.add(format!("section.{}.shear_factor", s.name), found, expected);
    }
    let none = |inertia| matches!(inertia, RotaryInertia::Neglected | RotaryInertia::Given(0.0));
    if s.parts().any(|part| none(part.rotary_inertia)) {
        let found = format!("no rotary inertia for shear-flexible `{}`", beam.name);
        let expected = "true, or a value above zero: its sections turn by themselves";
        out.add(format!("section.{}.rotary_inertia", s.name), found, expected);
    }
}

/// The shear stiffness of a material, and the measure of its stress and strain if it yields.
fn check_material(beam: &Beam, m: &Material, out: &mut Faults) {
    if m.shear_stiffness().is_none() {
        let found =
            format!("neither Poisson's ratio nor shear modulus for shear-flexible `{}`", beam.name);
        let expected = "`poisson`, such as 0.3, or `shear_modulus`";
        out.add(format!("material.{}.poisson", m.name), found, expected);
    }
    let yields = matches!(
        m.inelasticity,
        Some(Inelasticity::Plastic(_) | Inelasticity::OneSidedPlastic(..))
    );
    if yields && m.strain == StrainMeasure::Green {
        let found =
            format!("Green strains of a material that yields in shear-flexible `{}`", beam.name);
        let expected = "\"engineering\": its fibres have engineering strains";
        out.add(format!("material.{}.strain", m.name), found, expected);
    }
}

/// The vector of a node has no stretch that could be held.
pub(super) fn check_stretch(model: &ModelBuilder, support: &Support, out: &mut Faults) {
    let SupportKind::Fix { components } = &support.kind else { return };
    let shear =
        model.beams.get(support.at.beam.0 as usize).is_some_and(|b| b.theory == Theory::Shear);
    if shear && components.contains(&Component::Stretch) {
        let expected = "components among u1, u2 and rotation: its sections have no stretch";
        let path = format!("support.{}.components", support.name);
        out.add(path, "the stretch of a shear-flexible beam", expected);
    }
}
