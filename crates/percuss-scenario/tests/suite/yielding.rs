//! Springs, hinges and beams that yield: what they accept and what they say of the rest.

use percuss::{NoRecorder, RunSummary, Termination, simulate};
use percuss_scenario::content::SpringLaw;
use percuss_scenario::{apply_overrides, read};

use crate::structures::{BEAM, HEAD, bad, file, good};

/// A second beam beside `BEAM`, for joints.
const OTHER: &str = "[beam.c]\npoints = [[3, 0], [5, 0]]\nelements = 2\nmaterial = \"m\"\n\
                     section = \"s\"\n";
const SPRING: &str = "[spring.k]\nbetween = [\"b.end\", [3, 2]]\n";
const JOINT: &str = "[joint.j]\nbetween = [\"b.end\", \"c.start\"]\n";

#[test]
fn springs_and_hinges_yield_as_materials_do() {
    let content = good(&file(&[
        HEAD,
        BEAM,
        OTHER,
        SPRING,
        "stiffness = \"2 MN/m\"\nyield_force = \"10 kN\"\nfailure_extension = \"20 mm\"\n\
         hardening = { isotropic = \"50 kN/m\", kinematic = \"20 kN/m\" }\n",
        JOINT,
        "kind = \"hinge\"\nstiffness = \"1 MN*m/rad\"\nyield_moment = \"2 kN*m\"\n\
         hardening = { table = [[0, \"2 kN*m\"], [\"2 deg\", \"2.5 kN*m\"]] }\n",
    ]));
    let SpringLaw::Linear { yield_force, hardening, failure_extension, .. } =
        &content.spring[0].table.law
    else {
        panic!("a linear spring")
    };
    assert_eq!((*yield_force, *failure_extension), (Some(1e4), Some(0.02)));
    let hardening = hardening.as_ref().unwrap();
    assert_eq!((hardening.isotropic, hardening.kinematic), (Some(5e4), 2e4));
}

#[test]
fn springs_have_laws() {
    let law = |text: &str| {
        let content = good(&file(&[HEAD, BEAM, SPRING, text]));
        content.spring[0].table.law.clone()
    };
    let linear = SpringLaw::Linear {
        stiffness: 5.0,
        yield_force: None,
        hardening: None,
        failure_extension: None,
    };
    assert_eq!(law("stiffness = 5\n"), linear);
    assert_eq!(
        law("law = \"tension\"\nstiffness = \"2 kN/m\"\nslack = \"3 mm\"\nstrength = \"9 kN\"\n"),
        SpringLaw::Tension { stiffness: 2e3, slack: 3e-3 }
    );
    assert_eq!(
        law("law = \"compression\"\nstiffness = 1\n"),
        SpringLaw::Compression { stiffness: 1.0, gap: 0.0 }
    );
    assert_eq!(
        law("law = \"table\"\nextensions = [0, \"1 cm\"]\nforces = [0, \"1 kN\"]\n"),
        SpringLaw::Table { extensions: vec![0.0, 0.01], forces: vec![0.0, 1e3] }
    );
    wrong(
        &[HEAD, BEAM, SPRING, "law = \"hook\"\nstiffness = 1\n"],
        "14:7: spring.k.law: found the text \"hook\", expected one of `linear`, `tension`, `compression`, \
         `table` (did you mean `tension`?)",
    );
    wrong(
        &[HEAD, BEAM, SPRING, "law = \"table\"\nextensions = [0, 1]\nforces = [1, 2]\n"],
        "16:10: spring.k.forces: found a force of 1 N without extension, expected no force without extension: \
         `length` sets where that is",
    );
    wrong(
        &[HEAD, BEAM, SPRING, "law = \"tension\"\nstiffness = 9\nyield_force = 1\n"],
        "16:1: spring.k.yield_force: found `yield_force`, which belongs to law = \"linear\", expected one of \
         `between`, `damping`, `length`, `strength`, `stiffness`, `slack`, `law` for law = \"tension\"",
    );
}

/// A file with a spring or a joint of which one thing is wrong, and the fault.
#[track_caller]
fn wrong(parts: &[&str], expected: &str) {
    bad(&file(parts), &[expected]);
}

#[test]
fn a_spring_with_a_wrong_yield_is_one_fault() {
    let spring = |text: &str, expected: &str| wrong(&[HEAD, BEAM, SPRING, text], expected);
    spring(
        "stiffness = 1\nhardening = { isotropic = 1 }\n",
        "12:1: spring.k.yield_force: found `hardening` without a yield force, expected \
         `yield_force` beside it",
    );
    spring(
        "stiffness = 1\nfailure_extension = 1\n",
        "12:1: spring.k.yield_force: found `failure_extension` without a yield force, expected \
         `yield_force` beside it",
    );
    spring(
        "stiffness = 0\ndamping = 1\nyield_force = 1\n",
        "14:13: spring.k.stiffness: found no stiffness, but a yield force, expected a stiffness \
         above zero: it is elastic until it yields",
    );
    spring(
        "stiffness = 10\nyield_force = 1\nfailure_extension = 0.05\n",
        "16:21: spring.k.failure_extension: found 0.05 m, and it yields at 0.100000 m, expected \
         an extension beyond that at which it yields",
    );
    spring(
        "stiffness = 10\nyield_force = 1\nlength = 1.5\n",
        "16:10: spring.k.length: found 1.5 m for points 2.000000 m apart: an extension of \
         0.500000 m, and it yields at 0.100000 m, expected a length without initial \
         yielding",
    );
}

#[test]
fn a_spring_with_a_wrong_hardening_is_one_fault() {
    let spring = |hardening: &str, expected: &str| {
        let text = format!("stiffness = 10\nyield_force = 1\nhardening = {{ {hardening} }}\n");
        wrong(&[HEAD, BEAM, SPRING, &text], expected);
    };
    spring(
        "kinematic = -1",
        "16:27: spring.k.hardening.kinematic: found -1 N/m, expected a plastic stiffness of zero \
         or above",
    );
    spring(
        "isotropic = -1",
        "16:13: spring.k.hardening: found -1 N/m: it softens, expected a plastic stiffness of \
         zero or above: softening is not supported",
    );
    spring(
        "isotropic = 1, table = [[0, 1]]",
        "16:38: spring.k.hardening.table: found `table` besides `isotropic`, expected one of the \
         two",
    );
    spring(
        "table = [[0, 2]]",
        "16:23: spring.k.hardening.table: found a table that begins with [0, 2 N], expected \
         [0, 1] first: no plastic extension at the yield force",
    );
}

#[test]
fn a_hinge_with_a_wrong_yield_is_one_fault() {
    let joint = |text: &str, expected: &str| wrong(&[HEAD, BEAM, OTHER, JOINT, text], expected);
    joint(
        "kind = \"hinge\"\nyield_moment = 1\n",
        "17:1: joint.j.stiffness: found no stiffness, but a yield moment, expected a stiffness \
         above zero: it is elastic until it yields",
    );
    joint(
        "kind = \"hinge\"\nstiffness = 1\nhardening = { isotropic = 1 }\n",
        "17:1: joint.j.yield_moment: found `hardening` without a yield moment, expected \
         `yield_moment` beside it",
    );
    joint(
        "kind = \"rigid\"\nyield_moment = 1\n",
        "20:1: joint.j.yield_moment: found `yield_moment`, which belongs to kind = \"hinge\", \
         expected one of `between`, `strength`, `kind` for kind = \"rigid\"",
    );
    joint(
        "kind = \"hinge\"\nstiffness = 10\nyield_moment = 1\nfailure_rotation = \"1 deg\"\n",
        "22:20: joint.j.failure_rotation: found 0.017453292519943295 rad, and it yields at \
         0.100000 rad, expected a rotation beyond that at which it yields",
    );
}

#[test]
fn a_scheme_that_cannot_account_for_what_yields_is_one_fault() {
    let scheme = "[integrator]\nscheme = \"strain-rate\"\n";
    let text = format!("stiffness = 10\nyield_force = 1\n{scheme}");
    wrong(
        &[HEAD, BEAM, SPRING, &text],
        "17:10: integrator.scheme: found a scheme other than energy-momentum, with yielding, \
         tension-only, compression-only or fibre sections, expected energy-momentum: the work of \
         plastic flow is exact only in it",
    );
}

/// The scenario of a weight on a beam that yields, with changes.
fn struck(changes: &[&str]) -> Result<RunSummary, String> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/yielding-beam.toml");
    let changes: Vec<String> = changes.iter().map(|c| (*c).to_owned()).collect();
    let text = std::fs::read_to_string(path).unwrap();
    let text = apply_overrides(&text, "beam.toml", &changes).unwrap();
    let scenario = read(&text, "beam.toml").and_then(|content| content.compile());
    let compiled = scenario.map_err(|faults| faults.to_string())?;
    Ok(simulate(&compiled.model, &compiled.settings, &mut NoRecorder).unwrap())
}

/// It is 25 times as long as deep: shear changes little.
#[test]
fn a_shear_flexible_beam_yields_as_a_slender_one_if_it_is_slender() {
    let fine = "beam.girder.elements=32";
    let (theory, poisson) = ("beam.girder.theory=\"shear\"", "material.steel.poisson=0.3");
    let slender = struck(&[fine]).unwrap();
    let found = struck(&[fine, theory, poisson]).unwrap();
    assert!(matches!(found.termination, Termination::Completed), "{:?}", found.termination);
    let (energy, momentum) = (&found.energy, &found.momentum);
    let residuals =
        [energy.residual_max, momentum.linear_residual_max, momentum.angular_residual_max];
    assert!(residuals.iter().all(|r| *r < 1e-10), "{residuals:?}");
    let off = energy.plastic / slender.energy.plastic - 1.0;
    assert!(off.abs() < 0.05, "{off}");
    let set = |run: &RunSummary| run.plastic[0].permanent_set.unwrap().size();
    let off = set(&found) / set(&slender) - 1.0;
    assert!(off.abs() < 0.1, "{off}");
    // Its fibres have engineering strains.
    let green = struck(&[theory, poisson, "material.steel.strain=\"green\""]).unwrap_err();
    assert!(green.contains("material.steel.strain: found Green strains"), "{green}");
}
