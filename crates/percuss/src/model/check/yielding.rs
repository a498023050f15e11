//! Faults of materials, springs and hinges that yield, and of beams made of fibres.

use super::super::builder::ModelBuilder;
use super::super::definition::*;
use super::super::fibres::{Make, Weighed};
use super::faults::{Faults, quantity};

/// A force that decreases by less, relative, counts as constant.
const LEVEL: f64 = 1e-6;

/// Kind of the yielding part, in words.
struct Words {
    /// Name of the definition, `material.steel` or `joint.knee`.
    path: String,
    /// Key of the elastic modulus or stiffness.
    elastic: &'static str,
    /// Key of the yield limit, and in words, shape (2).
    limit: [&'static str; 2],
    /// Key of the failure limit, and in words, shape (2).
    failure: [&'static str; 2],
    /// Name of the plastic deformation, in the plural.
    flow: &'static str,
    /// Plastic modulus, in words.
    modulus: &'static str,
    /// Units of the limit, the modulus and the plastic deformation, shape (3).
    units: [&'static str; 3],
}

pub(super) fn check_plasticity(m: &Material, law: &Plasticity, out: &mut Faults) {
    let words = Words {
        path: format!("material.{}", m.name),
        elastic: "young",
        limit: ["yield", "a yield stress"],
        failure: ["failure_strain", "a strain"],
        flow: "plastic strains",
        modulus: "a plastic modulus",
        units: ["Pa", "Pa", ""],
    };
    let first = law.curve.first().map_or(f64::NAN, |part| part.stress);
    if m.young > 0.0 && first >= m.young {
        let found = format!("{first} Pa, beyond Young's modulus, {} Pa", m.young);
        out.add(words.at("yield"), found, "a yield stress far below Young's modulus");
    }
    words.check(m.young, law, Some(m.strain), out);
}

/// A tension-only or compression-only material yields only under that sign of stress.
pub(super) fn check_one_sided(m: &Material, law: &Plasticity, out: &mut Faults) {
    let path = |field: &str| format!("material.{}.{field}", m.name);
    if law.kinematic != 0.0 {
        let found = "kinematic hardening of a tension-only or compression-only material";
        out.add(path("hardening.kinematic"), found, "isotropic hardening, or a table");
    }
    if law.overstress.is_some() {
        let found = "a rate law of a tension-only or compression-only material";
        out.add(path("rate"), found, "no `rate`, or a material for both signs of stress");
    }
}

/// Yielding of a spring.
pub(super) fn check_yielding_spring(spring: &Spring, out: &mut Faults) {
    let Some(law) = &spring.yielding else { return };
    let words = Words {
        path: format!("spring.{}", spring.name),
        elastic: "stiffness",
        limit: ["yield_force", "a yield force"],
        failure: ["failure_extension", "an extension"],
        flow: "plastic extensions",
        modulus: "a plastic stiffness",
        units: ["N", "N/m", "m"],
    };
    words.check_connector(spring.law.stiffness(), law, out);
}

/// Yielding of a foundation.
pub(super) fn check_yielding_foundation(foundation: &Foundation, out: &mut Faults) {
    let Some(law) = &foundation.yielding else { return };
    let words = Words {
        path: format!("foundation.{}", foundation.name),
        elastic: "stiffness",
        limit: ["yield_force", "a yield force per length"],
        failure: ["yield_force", "a deflection"],
        flow: "plastic deflections",
        modulus: "a plastic stiffness per length",
        units: ["N/m", "N/m^2", "m"],
    };
    if matches!(foundation.law, FoundationLaw::Table { .. }) {
        let found = "a yield force of a foundation whose law is a table";
        let expected = "`law = \"linear\"` or `\"compression\"`, or a table alone";
        out.add(words.at("yield_force"), found, expected);
        return;
    }
    let one_sided = matches!(foundation.law, FoundationLaw::Compression { .. });
    if one_sided && law.kinematic != 0.0 {
        let found = "kinematic hardening of a foundation of compression alone";
        out.add(words.at("hardening.kinematic"), found, "isotropic hardening, or a table");
    }
    words.check_connector(foundation.law.stiffness(), law, out);
}

/// The history of a spring before a start beyond yield is unknown.
pub(super) fn check_yielding_length(spring: &Spring, distance: f64, out: &mut Faults) {
    let (Some(law), Some(length)) = (&spring.yielding, spring.length) else { return };
    let most = law.curve.first().map_or(f64::NAN, |part| part.stress) / spring.law.stiffness();
    let extension = distance - length;
    if most.is_finite() && extension.abs() > most {
        let found = format!(
            "{length} m for points {distance:.6} m apart: an extension of {extension:.6} m, \
             and it yields at {most:.6} m"
        );
        let expected = "a length without initial yielding";
        out.add(format!("spring.{}.length", spring.name), found, expected);
    }
}

/// Yielding of a joint.
pub(super) fn check_yielding_joint(joint: &Joint, out: &mut Faults) {
    let Some(law) = &joint.yielding else { return };
    let words = Words {
        path: format!("joint.{}", joint.name),
        elastic: "stiffness",
        limit: ["yield_moment", "a yield moment"],
        failure: ["failure_rotation", "a rotation"],
        flow: "plastic rotations",
        modulus: "a plastic stiffness",
        units: ["N*m", "N*m", "rad"],
    };
    let JointKind::ElasticHinge { stiffness, .. } = joint.kind else {
        let found = "a yield moment of a joint without a spring";
        out.add(words.at("yield_moment"), found, "an elastic hinge");
        return;
    };
    words.check_connector(stiffness, law, out);
}

/// Whether the force of a bar in tension decreases along a part of its hardening curve. With Green strains it is the stress times the stretch: a
/// constant force is a decreasing stress.
fn force_falls(
    elastic: f64,
    law: &Plasticity,
    part: usize,
    measure: Option<StrainMeasure>,
) -> bool {
    let (from, Some(to)) = (law.curve[part], law.curve.get(part + 1)) else { return true };
    let force = |plastic: f64, isotropic: f64| {
        let stress = isotropic + law.kinematic * plastic;
        let stretch = match measure {
            Some(StrainMeasure::Green) => (1.0 + 2.0 * (plastic + stress / elastic)).sqrt(),
            _ => 1.0,
        };
        stress * stretch
    };
    let end = from.stress + from.modulus * (to.from - from.from);
    force(to.from, end) < (1.0 - LEVEL) * force(from.from, from.stress)
}

impl Words {
    fn at(&self, field: &str) -> String {
        format!("{}.{field}", self.path)
    }

    /// A connector is elastic before it yields.
    fn check_connector(&self, stiffness: f64, law: &Plasticity, out: &mut Faults) {
        if stiffness == 0.0 {
            let found = format!("no stiffness, but {}", self.limit[1]);
            let expected = "a stiffness above zero: it is elastic until it yields";
            out.add(self.at(self.elastic), found, expected);
            return;
        }
        self.check(stiffness, law, None, out);
    }

    fn check(
        &self,
        elastic: f64,
        law: &Plasticity,
        measure: Option<StrainMeasure>,
        out: &mut Faults,
    ) {
        let [limit_unit, modulus_unit, flow_unit] = self.units;
        let Some(first) = law.curve.first() else {
            out.add(self.at("hardening"), "an empty curve", self.limit[1]);
            return;
        };
        out.positive(self.at(self.limit[0]), first.stress, self.limit[1], limit_unit);
        let path = self.at("hardening.kinematic");
        out.not_negative(path, law.kinematic, self.modulus, modulus_unit);
        for (i, part) in law.curve.iter().enumerate() {
            if !part.modulus.is_finite() {
                let found = quantity(part.modulus, modulus_unit);
                out.add(self.at("hardening"), found, &format!("{}, finite", self.modulus));
            } else if part.modulus < 0.0 && force_falls(elastic, law, i, measure) {
                let found = format!("{}: it softens", quantity(part.modulus, modulus_unit));
                let expected = format!("{} of zero or above: {}", self.modulus, self.softening());
                out.add(self.at("hardening"), found, &expected);
                break;
            }
        }
        let rises = |w: &[Hardening]| w[1].from > w[0].from;
        if !law.curve.windows(2).all(rises) {
            let list: Vec<String> = law.curve.iter().map(|p| p.from.to_string()).collect();
            let found = format!("{} {}", self.flow, list.join(", "));
            let expected = format!("{} that increase, from zero on", self.flow);
            out.add(self.at("hardening.table"), found, &expected);
        }
        self.check_rate(law, out);
        if let Some(limit) = law.failure_strain {
            let yields = first.stress / elastic;
            if elastic > 0.0 && (!limit.is_finite() || limit <= yields) {
                let yields = if flow_unit.is_empty() {
                    format!("{yields:.6}")
                } else {
                    format!("{yields:.6} {flow_unit}")
                };
                let found = format!("{}, and it yields at {yields}", quantity(limit, flow_unit));
                let expected = format!("{} beyond that at which it yields", self.failure[1]);
                out.add(self.at(self.failure[0]), found, &expected);
            }
        }
    }

    fn softening(&self) -> &'static str {
        match self.path.starts_with("material.") {
            true => "softening has no length scale and is mesh-dependent",
            false => "softening is not supported",
        }
    }

    fn check_rate(&self, law: &Plasticity, out: &mut Faults) {
        let Some(rate) = law.overstress else { return };
        let positive = |x: f64| x > 0.0 && x.is_finite();
        if !positive(rate.rate) {
            out.add(self.at("rate.C"), format!("{} 1/s", rate.rate), "a rate above zero");
        }
        if !(rate.exponent >= 1.0 && rate.exponent.is_finite()) {
            out.add(self.at("rate.q"), rate.exponent.to_string(), "an exponent of one or above");
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
        if s.given_fibres().is_some() {
            let make = Make { material: m, section: s, materials: &model.materials };
            check_together(&make, out);
            check_centroid(&make, out);
            continue;
        }
        if m.inelasticity.is_none() {
            continue;
        }
        if s.profiles().any(|(profile, _)| *profile == Profile::Unknown) {
            let found = format!(
                "area and second moment only for `{}` of `{}`, with the nonlinear material `{}`",
                s.name, beam.name, m.name
            );
            let expected = "a `shape`, such as \"rectangle\" or \"i\", for the fibre positions";
            out.add(format!("section.{}.shape", s.name), found, expected);
        } else if !(4..=Section::MOST_FIBRES).contains(&s.fibres) || s.fibres % 2 == 1 {
            let expected = "an even number of fibres from 4 to 200";
            out.add(format!("section.{}.fibres", s.name), s.fibres.to_string(), expected);
        }
    }
}

/// Faults of a section given by fibres; its elastic centroid is checked where its materials are known.
pub(super) fn check_given_fibres(model: &ModelBuilder, s: &Section, out: &mut Faults) {
    let Some(fibres) = s.given_fibres() else { return };
    let path = |field: &str| format!("section.{}.{field}", s.name);
    if !s.stations.is_empty() {
        out.add(path("stations"), "stations of a section of fibres", "none: it does not vary");
    }
    if !(2..=Section::MOST_FIBRES).contains(&fibres.len()) {
        let expected = "from 2 to 200 fibres, not all at one height";
        out.add(path("heights"), fibres.len().to_string(), expected);
        return;
    }
    let heights: Vec<f64> = fibres.iter().map(|f| f.height).collect();
    out.finite(path("heights"), &heights, "m");
    if let Some(bad) = fibres.iter().find(|f| !(f.area > 0.0 && f.area.is_finite())) {
        out.add(path("areas"), quantity(bad.area, "m^2"), "areas above zero");
    }
    if heights.iter().all(|y| *y == heights[0]) {
        let found = format!("all fibres at {} m", heights[0]);
        out.add(path("heights"), found, "fibres at different heights: a second moment of area");
    }
    let half = 0.5 * s.depth.unwrap_or(f64::INFINITY);
    if let Some(bad) = heights.iter().find(|y| y.abs() > half * (1.0 + 1e-9)) {
        let found = format!("a fibre at {bad} m in a depth of {} m", 2.0 * half);
        out.add(path("heights"), found, "fibres within half the depth of the centre line");
    }
    let unknown =
        |f: &SectionFibre| f.material.is_some_and(|m| m.0 as usize >= model.materials.len());
    if fibres.iter().any(unknown) {
        out.add(path("materials"), "an unknown material", "materials of this model");
    }
}

/// Fibres strain and are damped together: by the measure and the damping of the beam's material.
fn check_together(make: &Make, out: &mut Faults) {
    let own = make.material;
    for other in make.section.given_fibres().unwrap_or_default().iter().map(|f| make.of(f)) {
        let same = other.strain == own.strain
            && other.retardation == own.retardation
            && other.mass_damping == own.mass_damping;
        let path = format!("section.{}.materials", make.section.name);
        if !same && !out.0.iter().any(|fault| fault.path == path) {
            let found = format!(
                "`{}`, whose `strain`, `retardation` or `mass_damping` is not that of the beam's material `{}`",
                other.name, own.name
            );
            out.add(path, found, "materials of one strain measure and one damping");
        }
    }
}

/// Tolerance of the distance of the elastic centroid from the centre line, relative to the radius of gyration: the coupling is of the order of its
/// square.
const OFF_CENTRE: f64 = 1e-3;

/// The centre line contains the elastic centroid: there axial force causes stretching and no bending, as vibrations, buckling and the energy terms
/// assume.
fn check_centroid(make: &Make, out: &mut Faults) {
    let Some(Weighed { stiffness: [axial, first, second], .. }) = make.weighed() else { return };
    let centroid = first / axial;
    let gyration = (second / axial - centroid * centroid).sqrt();
    if centroid.abs() <= OFF_CENTRE * gyration || gyration <= 0.0 || gyration.is_nan() {
        return;
    }
    let found = format!("an elastic centroid {centroid:.6e} m above the centre line");
    let expected =
        format!("heights measured from the elastic centroid: {:+.6e} m added to each", -centroid);
    let of = format!("section.{}.", make.section.name);
    if !out.0.iter().any(|fault| fault.path.starts_with(&of)) {
        out.add(format!("{of}heights"), found, &expected);
    }
}
