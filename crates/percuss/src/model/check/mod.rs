//! Check of a set of definitions, which finds all faults at once.

mod actions;
mod beams;
mod contacts;
mod faults;
mod foundations;
mod functions;
mod given_strains;
mod shear;
mod supports;
mod yielding;

use std::collections::{HashMap, HashSet};

use super::builder::ModelBuilder;
use super::definition::*;
use super::fault::Fault;
use actions::{check_load, check_projectile};
use beams::{check_beam, check_point, check_stations};
use contacts::{check_contact, check_disc, check_obstacle};
use faults::{Faults, quantity};
use foundations::check_foundation;
use given_strains::check_sums_of_strains;
use shear::{check_shear_factor, check_shear_moduli, check_stretch, check_theory};
use supports::{check_joint, check_spring, check_support};
use yielding::{check_fibres, check_given_fibres, check_one_sided, check_plasticity};

pub(super) use actions::line_of_motion;

/// All faults of the definitions, in the order of the definitions.
pub(super) fn faults(model: &ModelBuilder) -> Vec<Fault> {
    let mut out = Faults::default();
    names(model, &mut out);
    check_materials(model, &mut out);
    check_sections(model, &mut out);
    if model.beams.is_empty() && model.discs.is_empty() {
        out.add("beam".into(), "no beam and no disc", "at least one beam or disc");
    }
    for beam in &model.beams {
        check_beam(model, beam, &mut out);
        check_fibres(model, beam, &mut out);
        check_theory(model, beam, &mut out);
    }
    for support in &model.supports {
        check_support(model, support, &mut out);
        check_stretch(model, support, &mut out);
    }
    for joint in &model.joints {
        check_joint(model, joint, &mut out);
    }
    for projectile in &model.projectiles {
        check_projectile(model, projectile, &mut out);
    }
    for disc in &model.discs {
        check_disc(disc, &mut out);
    }
    for obstacle in &model.obstacles {
        check_obstacle(model, obstacle, &mut out);
    }
    for contact in &model.contacts {
        check_contact(model, contact, &mut out);
    }
    for load in &model.loads {
        check_load(model, load, &mut out);
    }
    check_sums_of_strains(model, &mut out);
    for spring in &model.springs {
        check_spring(model, spring, &mut out);
    }
    for foundation in &model.foundations {
        check_foundation(model, foundation, &mut out);
    }
    for mass in &model.masses {
        let path = |field: &str| format!("mass.{}.{field}", mass.name);
        check_point(model, &mass.at, path("at"), &mut out);
        out.positive(path("mass"), mass.mass, "a mass", "kg");
        let path = path("rotary_inertia");
        out.not_negative(path, mass.rotary_inertia, "a moment of inertia", "kg*m^2");
    }
    for ratio in &model.modal_damping {
        if !(0.0..1.0).contains(ratio) {
            out.add("damping.modal".into(), quantity(*ratio, ""), "ratios from 0 to below 1");
        }
    }
    check_initial_motions(model, &mut out);
    for point in &model.points {
        check_point(model, point, "record.points".into(), &mut out);
    }
    out.0
}

fn check_materials(model: &ModelBuilder, out: &mut Faults) {
    for m in &model.materials {
        let path = |field: &str| format!("material.{}.{field}", m.name);
        out.positive(path("young"), m.young, "a Young's modulus", "Pa");
        out.not_negative(path("density"), m.density, "a density", "kg/m^3");
    }
    for m in &model.materials {
        let path = |field: &str| format!("material.{}.{field}", m.name);
        out.finite(path("expansion"), &[m.expansion], "1/K");
        out.not_negative(path("retardation"), m.retardation, "a time", "s");
        out.not_negative(path("mass_damping"), m.mass_damping, "a rate", "1/s");
        check_shear_moduli(m, out);
        match &m.inelasticity {
            Some(Inelasticity::Plastic(plasticity)) => check_plasticity(m, plasticity, out),
            Some(Inelasticity::OneSidedPlastic(_, plasticity)) => {
                check_plasticity(m, plasticity, out);
                check_one_sided(m, plasticity, out);
            }
            Some(Inelasticity::OneSided(_)) | None => {}
        }
    }
}

fn check_sections(model: &ModelBuilder, out: &mut Faults) {
    for s in &model.sections {
        let path = |field: &str| format!("section.{}.{field}", s.name);
        if s.given_fibres().is_some() {
            check_given_fibres(model, s, out);
        } else {
            out.positive(path("area"), s.area, "an area", "m^2");
            out.positive(path("inertia"), s.inertia, "a second moment of area", "m^4");
        }
        if let Some(depth) = s.depth {
            out.positive(path("depth"), depth, "a depth", "m");
        }
        check_stations(s, out);
        check_shear_factor(s, out);
        if let RotaryInertia::Given(value) = s.rotary_inertia
            && !(value >= 0.0 && value.is_finite())
        {
            out.add(path("rotary_inertia"), quantity(value, "kg*m"), "a value of zero or above");
        }
    }
}

fn check_initial_motions(model: &ModelBuilder, out: &mut Faults) {
    let all = [(String::new(), model.initial_motion)];
    let mut parts: HashMap<&str, usize> = HashMap::new();
    let beams = model.beams.iter().map(|beam| beam.name.as_str());
    for name in beams.chain(model.masses.iter().map(|mass| mass.name.as_str())) {
        *parts.entry(name).or_default() += 1;
    }
    for (name, motion) in all.iter().chain(&model.own_motions) {
        let path = if name.is_empty() { "initial".to_owned() } else { format!("initial.{name}") };
        out.finite(format!("{path}.velocity"), &motion.velocity, "m/s");
        out.finite(format!("{path}.spin"), &[motion.spin], "rad/s");
        out.finite(format!("{path}.about"), &motion.about, "m");
        let named = parts.get(name.as_str()).copied().unwrap_or_default();
        if !name.is_empty() && named != 1 {
            let found = if named == 0 { "no such part" } else { "a beam and a point mass" };
            out.add(path, found, "the name of one beam, or of one point mass");
        }
    }
}

fn names(model: &ModelBuilder, out: &mut Faults) {
    fn each<'a>(kind: &str, names: impl Iterator<Item = &'a String>, out: &mut Faults) {
        let mut seen = HashSet::new();
        for name in names {
            if name.is_empty() {
                out.add(kind.into(), "an empty name", "a name");
            } else if !seen.insert(name) {
                out.add(format!("{kind}.{name}"), "a name used twice", "each name once");
            }
        }
    }
    each("material", model.materials.iter().map(|x| &x.name), out);
    each("section", model.sections.iter().map(|x| &x.name), out);
    each("beam", model.beams.iter().map(|x| &x.name), out);
    each("support", model.supports.iter().map(|x| &x.name), out);
    each("joint", model.joints.iter().map(|x| &x.name), out);
    // Discs are projectiles too, and results of contacts and obstacles are listed with those of projectiles and supports.
    fn apart<'a>(
        kind: &str,
        names: impl Iterator<Item = &'a String>,
        other: &str,
        taken: impl Iterator<Item = &'a String>,
        out: &mut Faults,
    ) {
        let taken: HashSet<&String> = taken.collect();
        for name in names.filter(|name| taken.contains(name)) {
            let found = format!("the name of a {other}");
            out.add(format!("{kind}.{name}"), found, "a name of its own");
        }
    }
    each("projectile", model.projectiles.iter().map(|x| &x.name), out);
    each("disc", model.discs.iter().map(|x| &x.name), out);
    each("obstacle", model.obstacles.iter().map(|x| &x.name), out);
    each("contact", model.contacts.iter().map(|x| &x.name), out);
    let guided = || model.projectiles.iter().map(|x| &x.name);
    apart("disc", model.discs.iter().map(|x| &x.name), "projectile", guided(), out);
    apart("contact", model.contacts.iter().map(|x| &x.name), "guided projectile", guided(), out);
    let supports = model.supports.iter().map(|x| &x.name);
    apart("obstacle", model.obstacles.iter().map(|x| &x.name), "support", supports, out);
    each("load", model.loads.iter().map(|x| &x.name), out);
    each("foundation", model.foundations.iter().map(|x| &x.name), out);
    each("spring", model.springs.iter().map(|x| &x.name), out);
    each("mass", model.masses.iter().map(|x| &x.name), out);
}
