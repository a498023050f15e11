//! Faults of materials that yield, and of beams made of fibres.

use super::super::builder::ModelBuilder;
use super::super::definition::*;
use super::Faults;

/// Most fibres through the depth of a section.
const MOST_FIBRES: usize = 200;

pub(super) fn check_plasticity(m: &Material, law: &Plasticity, out: &mut Faults) {
    let path = |field: &str| format!("material.{}.{field}", m.name);
    let Some(first) = law.curve.first() else {
        out.add(path("hardening"), "an empty curve", "a yield stress");
        return;
    };
    if !(first.stress > 0.0 && first.stress.is_finite()) {
        out.add(path("yield"), format!("{} Pa", first.stress), "a yield stress above zero");
    } else if m.young > 0.0 && first.stress >= m.young {
        let found = format!("{} Pa, beyond Young's modulus, {} Pa", first.stress, m.young);
        out.add(path("yield"), found, "a yield stress far below Young's modulus");
    }
    out.not_negative(path("hardening.kinematic"), law.kinematic, "a plastic modulus", "Pa");
    for part in &law.curve {
        if !part.modulus.is_finite() {
            out.add(path("hardening"), format!("{} Pa", part.modulus), "finite plastic moduli");
        } else if part.modulus < 0.0 {
            let found = format!("{} Pa: it softens", part.modulus);
            let expected = "a plastic modulus of zero or above: what softens does so over a length \
                            that no mesh knows";
            out.add(path("hardening"), found, expected);
            break;
        }
    }
    if law
        .curve
        .windows(2)
        .any(|w| w[1].from.partial_cmp(&w[0].from) != Some(std::cmp::Ordering::Greater))
    {
        let list: Vec<String> = law.curve.iter().map(|p| p.from.to_string()).collect();
        let found = format!("plastic strains {}", list.join(", "));
        out.add(path("hardening.table"), found, "plastic strains that increase, from zero on");
    }
    if let Some(rate) = law.overstress {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        if !positive(rate.rate) {
            out.add(path("rate.C"), format!("{} 1/s", rate.rate), "a rate above zero");
        }
        if !(rate.exponent >= 1.0 && rate.exponent.is_finite()) {
            out.add(path("rate.q"), rate.exponent.to_string(), "an exponent of one or above");
        }
    }
    if let Some(limit) = law.failure_strain {
        let yields = first.stress / m.young;
        if !limit.is_finite() || limit <= yields {
            let found = format!("{limit}, and it yields at {yields:.6}");
            out.add(path("failure_strain"), found, "a strain beyond that at which it yields");
        }
    }
}

/// Beams whose material yields are made of fibres, which follow from the shape of their section.
pub(super) fn check_fibres(model: &ModelBuilder, beam: &Beam, out: &mut Faults) {
    let pairs =
        std::iter::once((None, None)).chain(beam.changes.iter().map(|c| (c.material, c.section)));
    let (mut material, mut section) = (beam.material, beam.section);
    for (m, s) in pairs {
        (material, section) = (m.unwrap_or(material), s.unwrap_or(section));
        let (Some(m), Some(s)) =
            (model.materials.get(material.0 as usize), model.sections.get(section.0 as usize))
        else {
            continue;
        };
        if m.inelasticity.is_none() {
            continue;
        }
        if s.profile == Profile::Unknown {
            let found = format!(
                "area and second moment alone for `{}` of `{}`, whose material `{}` does more than Hooke's law",
                s.name, beam.name, m.name
            );
            let expected =
                "a `shape`, such as \"rectangle\" or \"i\", which tells where its fibres lie";
            out.add(format!("section.{}.shape", s.name), found, expected);
        } else if !(4..=MOST_FIBRES).contains(&s.fibres) || s.fibres % 2 == 1 {
            let expected = "an even number of fibres from 4 to 200";
            out.add(format!("section.{}.fibres", s.name), s.fibres.to_string(), expected);
        }
    }
}
