//! Every key of a file arrives at the definitions of the core.

use super::build;

#[test]
fn definitions_are_those_of_the_file() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/everything.toml");
    let scenario = crate::load(path).unwrap_or_else(|e| panic!("{e}"));
    let (builder, faults) = build::definitions(scenario.content());
    assert_eq!(faults, []);
    let text = format!("{builder:?}");
    for part in [
        "young: 210000000000.0, density: 8000.0, strain: Engineering, retardation: 2e-6, \
         mass_damping: 0.5",
        "name: \"plain\", area: 0.001, inertia: 2e-7, depth: Some(0.05), rotary_inertia: Neglected",
        "rotary_inertia: Given(1.0), stations: [Station { at: 0.0, area: 0.001",
        "curve: Polyline, mesh: Mesh { size: Number(10), \
         grading: Some(Grading { towards: Distance(0.75), ratio: 4.0 }) }",
        "curve: Arc, mesh: Mesh { size: Length(0.1), \
         grading: Some(Grading { towards: Fraction(0.5), ratio: 2.0 }) }",
        "curve: Spline",
        "changes: [Change { at: Fraction(0.25), material: None, section: Some(SectionId(5)) }, \
         Change { at: Distance(3.5), material: Some(MaterialId(1)), section: Some(SectionId(0)) }, \
         Change { at: Fraction(1.0), material: Some(MaterialId(0)), section: None }]",
        "kind: Clamp, motion: Some(Motion { displacement: [0.0, 0.1], \
         rotation: 0.5235987755982988, function: Ramp { duration: 0.05 } }), until: 0.2",
        "Elastic { direction: [1.0, 1.0], stiffness: [1000000.0, 2000000.0], \
         damping: [1000.0, 5.0], rotational_stiffness: 5000.0, rotational_damping: 3.0 }",
        "Stop { direction: [1.0, 0.0], gap: 0.002, stiffness: 10000000.0, two_sided: true }",
        "ElasticHinge { stiffness: 2000.0, damping: 4.0 }",
        "Ground([-1.0, 0.5])], stiffness: 40000.0, damping: 100.0, length: Some(1.0)",
        "mass: 20.0, rotary_inertia: 0.5",
        "moment: 5.0, follower: true }, function: Table { times: [0.0, 0.002, 0.005, 0.01], \
         values: [0.0, 1.0, 0.4, 0.0], smooth: true }, from: 0.001, until: 0.1",
        "Distributed { beam: BeamId(2), stretch: [Fraction(0.0), Distance(1.5)], \
         force: [[0.0, -2000.0], [0.0, 0.0]], follower: true }, \
         function: HalfSine { duration: 0.008 }",
        "force: [[0.0, -1.0], [0.0, -1.0]], follower: false }, \
         function: Harmonic { frequency: 50.0, phase: 1.5707963267948966 }",
        "Step { at: 0.002 }",
        "Triangle { duration: 0.002 }",
        "Table { times: [0.0, 0.002, 0.004], values: [0.0, 1.0, 0.5], smooth: false }",
        "InitialMotion { velocity: [10.0, 0.0], spin: 6.283185307179585, about: [1.0, 0.2] }",
        "modal_damping: [0.02, 0.02, 0.02, 0.02, 0.02, 0.02]",
    ] {
        assert!(text.contains(part), "`{part}` is not in\n{text}");
    }
}

#[test]
fn a_hinge_without_stiffness_is_a_hinge() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/everything.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let text = text.replace("stiffness = \"2 kN*m/rad\"\ndamping = \"4 N*m*s/rad\"\n", "");
    let scenario = crate::read(&text, path).unwrap_or_else(|e| panic!("{e}"));
    let builder = build::definitions(scenario.content()).0;
    assert!(format!("{builder:?}").contains("kind: Hinge"));
}
