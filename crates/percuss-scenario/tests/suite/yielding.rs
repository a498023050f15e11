//! Springs and hinges that yield: what they accept and what they say of the rest.

use percuss_scenario::{Content, Diagnostics, FileAccess, read, read_with};

const HEAD: &str = "[material.m]\nyoung = 1e9\ndensity = 1e3\n\
                    [section.s]\narea = 1\ninertia = 1\n";
const BEAM: &str = "[beam.b]\npoints = [[0, 0], [3, 0]]\nelements = 6\nmaterial = \"m\"\n\
                    section = \"s\"\n";
const TIME: &str = "[time]\nend = 1\nstep = 0.1\n";

fn file(parts: &[&str]) -> String {
    parts.concat() + TIME
}

#[track_caller]
fn good(text: &str) -> Content {
    let scenario = read(text, "f.toml").unwrap_or_else(|e| panic!("{text}\n{e}"));
    let again = read(&scenario.to_toml(), "again").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(again.content(), scenario.content());
    scenario.content().clone()
}

/// Reads, and compiles what reads.
fn faults(text: &str) -> Diagnostics {
    let read = read_with(text, "f.toml", FileAccess::Anywhere).and_then(|s| s.compile());
    read.map(|_| panic!("no fault in\n{text}")).unwrap_err()
}

/// All faults of a file.
#[track_caller]
fn bad(text: &str, expected: &[&str]) {
    let all = faults(text).to_string();
    let lines: Vec<&str> = all.lines().map(|l| l.trim_start_matches("f.toml:")).collect();
    assert_eq!(lines, expected);
}

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
    let spring = &content.spring[0].table;
    assert_eq!((spring.yield_force, spring.failure_extension), (Some(1e4), Some(0.02)));
    let hardening = spring.hardening.as_ref().unwrap();
    assert_eq!((hardening.isotropic, hardening.kinematic), (Some(5e4), 2e4));
}

#[test]
fn what_yields_in_no_way_is_told() {
    let spring = |text: &str| file(&[HEAD, BEAM, SPRING, text]);
    bad(&spring("stiffness = 1\nhardening = { isotropic = 1 }\n"), &[""]);
    bad(&spring("stiffness = 1\nfailure_extension = 1\n"), &[""]);
    bad(&spring("stiffness = 0\ndamping = 1\nyield_force = 1\n"), &[""]);
    bad(&spring("stiffness = 10\nyield_force = 1\nfailure_extension = 0.05\n"), &[""]);
    bad(&spring("stiffness = 10\nyield_force = 1\nhardening = { kinematic = -1 }\n"), &[""]);
    bad(&spring("stiffness = 10\nyield_force = 1\nhardening = { isotropic = -1 }\n"), &[""]);
    bad(
        &spring(
            "stiffness = 10\nyield_force = 1\nhardening = { isotropic = 1, table = [[0, 1]] }\n",
        ),
        &[""],
    );
    bad(&spring("stiffness = 10\nyield_force = 1\nhardening = { table = [[0, 2]] }\n"), &[""]);
    let joint = |text: &str| file(&[HEAD, BEAM, OTHER, JOINT, text]);
    bad(&joint("kind = \"hinge\"\nyield_moment = 1\n"), &[""]);
    bad(&joint("kind = \"hinge\"\nstiffness = 1\nhardening = { isotropic = 1 }\n"), &[""]);
    bad(&joint("kind = \"rigid\"\nyield_moment = 1\n"), &[""]);
    let failure =
        "kind = \"hinge\"\nstiffness = 10\nyield_moment = 1\nfailure_rotation = \"1 deg\"\n";
    bad(&joint(failure), &[""]);
    let scheme = "[integrator]\nscheme = \"strain-rate\"\n";
    bad(&spring(&format!("stiffness = 10\nyield_force = 1\n{scheme}")), &[""]);
}
