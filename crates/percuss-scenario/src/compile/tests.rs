//! Every key of a file arrives at the definitions of the core.

use super::build;

/// The definitions of the file with every key.
fn everything() -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/everything.toml");
    let scenario = crate::load(path).unwrap_or_else(|e| panic!("{e}"));
    let (builder, faults) = build::definitions(scenario.content(), None);
    assert_eq!(faults, []);
    format!("{builder:?}")
}

#[test]
fn definitions_are_those_of_the_file() {
    let text = everything();
    for part in [
        "young: 210000000000.0, density: 8000.0, strain: Engineering, retardation: 2e-6, \
         mass_damping: 0.5",
        "name: \"plain\", area: 0.001, inertia: 2e-7, depth: Some(0.05), rotary_inertia: Neglected",
        "rotary_inertia: Given(1.0), stations: [Station { at: 0.0, area: 0.001",
        "curve: Polyline, mesh: Mesh { size: Number(10), \
         grading: Some(Grading { towards: Distance(0.75), ratio: 4.0 }), hinges: false }",
        "curve: Arc, mesh: Mesh { size: Length(0.1), \
         grading: Some(Grading { towards: Fraction(0.5), ratio: 2.0 }), hinges: false }",
        "curve: Spline",
        "ends: Flat, theory: Shear",
        "poisson: Some(0.3), shear_modulus: None",
        "poisson: None, shear_modulus: Some(700000000.0)",
        "shear_factor: Some(0.8)",
        "changes: [Change { at: Fraction(0.25), material: None, section: Some(SectionId(5)) }, \
         Change { at: Distance(3.5), material: Some(MaterialId(1)), section: Some(SectionId(0)) }, \
         Change { at: Fraction(1.0), material: Some(MaterialId(0)), section: None }]",
        "kind: Clamp, motion: Some(Motion { displacement: [0.0, 0.1], \
         rotation: 0.5235987755982988, function: Ramp { duration: 0.05 } }), until: 0.2",
        "Elastic { direction: [1.0, 1.0], stiffness: [1000000.0, 2000000.0], \
         damping: [1000.0, 5.0], rotational_stiffness: 5000.0, rotational_damping: 3.0 }",
        "Stop { direction: [1.0, 0.0], gap: 0.002, stiffness: 10000000.0, two_sided: true }",
        "ElasticHinge { stiffness: 2000.0, damping: 4.0 }",
        "yielding: Some(Plasticity { curve: [Hardening { from: 0.0, stress: 80.0, modulus: 10.0 }], \
         kinematic: 5.0, overstress: None, failure_strain: Some(0.5235987755982988) })",
        "yielding: Some(Plasticity { curve: [Hardening { from: 0.0, stress: 5000.0, modulus: 100000.0 }, \
         Hardening { from: 0.01, stress: 6000.0, modulus: 0.0 }], kinematic: 20.0, overstress: None, \
         failure_strain: Some(0.4) })",
        "Ground([-1.0, 0.5])], law: Linear { stiffness: 40000.0 }, damping: 100.0, length: Some(1.0)",
        "mass: 20.0, rotary_inertia: 0.5",
        "Foundation { name: \"bed\", beam: BeamId(2), stretch: [Fraction(0.0), Distance(1.5)], \
         direction: Some([0.0, 1.0]), law: Linear { stiffness: 20000000.0 }, damping: 5000.0, \
         yielding: Some(Plasticity { curve: [Hardening { from: 0.0, stress: 40000.0, modulus: 1000000.0 }, \
         Hardening { from: 0.01, stress: 50000.0, modulus: 0.0 }], kinematic: 1000000.0, overstress: None, \
         failure_strain: None }) }",
        "direction: None, law: Compression { stiffness: 10000000.0, gap: 0.001 }, damping: 0.0, \
         yielding: Some(Plasticity { curve: [Hardening { from: 0.0, stress: 30000.0, modulus: 500000.0 }]",
        "law: Table { deflection: [-0.02, 0.0, 0.02], reaction: [-3000.0, 0.0, 3000.0] }",
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
fn bodies_and_contacts_are_those_of_the_file() {
    let text = everything();
    for part in [
        "Elastic { law: SmoothLaw { potential: Linear { stiffness: 1000000.0 }, dissipation: 0.0, \
         force: Midpoint, unloading: None } }, mass: 1.0",
        "law: Smooth(SmoothLaw { potential: Linear { stiffness: 3000000.0 }, dissipation: 0.1, \
         force: Conserving, unloading: Some(12000000.0) })",
        "rear: Some(RearMass { mass: 3.0, stiffness: 2000000.0, damping: 10.0 }), local_mass: 0.05",
        "Disc { name: \"marble\", mass: 0.03, inertia: Some(2e-6), radius: 0.012, position: [1.4999999",
        "velocity: [0.0, -3.0], spin: 1.5707963267948966 }",
        "Disc { name: \"puck\", mass: 0.2, inertia: None, radius: 0.04, position: [1.0, 0.5], \
         velocity: [1.0, 0.0], spin: 0.0 }",
        "shape: HalfPlane { point: [0.0, -1.0], normal: [0.0, 1.0] }, \
         motion: Some(Motion { displacement: [0.0, 0.005], rotation: 0.0, \
         function: Harmonic { frequency: 20.0, phase: 0.0 } })",
        "shape: Segment { ends: [[6.0, 0.0], [6.0, 2.0]], thickness: 0.1 }, motion: None",
        "shape: Disc { centre: [2.0, -0.5], radius: 0.2 }",
        "Clearance { at: PointRef { label: \"rail@0.25\", beam: BeamId(2), along: Fraction(0.25) }, \
         width: 0.06, gap: 0.0003, sides: Left }",
        "Contact { name: \"marble-rail\", between: [Disc(DiscId(0)), Beam(BeamId(2))], \
         law: Smooth(SmoothLaw { potential: Hertz { stiffness: 500000000.0 }, dissipation: 0.31",
        "force: PlainGradient, unloading: None }), points_per_element: 2 }, Contact { name: \"marble-floor\", \
         between: [Disc(DiscId(0)), Obstacle(ObstacleId(0))]",
        "Contact { name: \"puck-marble\", between: [Disc(DiscId(1)), Disc(DiscId(0))], \
         law: Rigid(RigidLaw { restitution: 0.8, tangential_restitution: 0.1, friction: 0.3, \
         impact: Moreau })",
        "Contact { name: \"arch-fence\", between: [Beam(BeamId(1)), Obstacle(ObstacleId(1))], \
         law: Rigid(RigidLaw { restitution: 0.5, tangential_restitution: 0.0, friction: 0.2, \
         impact: Newton }), points_per_element: 3 }",
        "Table { penetration: [0.0, 0.001], force: [0.0, 2000.0] }, dissipation: 0.0, \
         force: Conserving",
        "Contact { name: \"arch-itself\", between: [Beam(BeamId(1)), Beam(BeamId(1))], \
         law: Smooth(SmoothLaw { potential: Table { penetration: [0.0, 0.001, 0.005], \
         force: [0.0, 2000.0, 2500.0] }",
    ] {
        assert!(text.contains(part), "`{part}` is not in\n{text}");
    }
}

#[test]
fn a_hinge_without_stiffness_is_a_hinge() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/everything.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let own = "stiffness = \"2 kN*m/rad\"\ndamping = \"4 N*m*s/rad\"\nyield_moment = \"80 N*m\"\n\
               hardening = { isotropic = \"10 N*m/rad\", kinematic = \"5 N*m\" }\n\
               failure_rotation = \"30 deg\"\n";
    assert!(text.contains(own));
    let text = text.replace(own, "");
    let scenario = crate::read(&text, path).unwrap_or_else(|e| panic!("{e}"));
    let builder = build::definitions(scenario.content(), None).0;
    assert!(format!("{builder:?}").contains("kind: Hinge"));
}

#[test]
fn a_preset_has_its_thermal_expansion_unless_one_is_given() {
    let of = |material: &str| {
        let text = format!(
            "[material.m]\n{material}\n[section.s]\nshape = \"circle\"\ndiameter = 0.1\n[beam.b]\n\
             points = [[0, 0], [4, 0], [8, 0]]\nmaterial = \"m\"\nelements = 4\nsection = \"s\"\n\
             changes = [{{ at = \"mid\", material = \"C20/25\" }}]\n[time]\nend = 1\nstep = 1\n"
        );
        let scenario = crate::read(&text, "f").unwrap_or_else(|e| panic!("{e}"));
        // Written out, it is the same.
        let again = crate::read(&scenario.to_toml(), "again").unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(again.content(), scenario.content());
        let (builder, faults) = build::definitions(scenario.content(), None);
        assert_eq!(faults, []);
        let text = format!("{builder:?}");
        let number = |part: &str| part.split(',').next().unwrap().parse::<f64>().unwrap();
        text.split("expansion: ").skip(1).map(number).collect::<Vec<f64>>()
    };
    assert_eq!(of("preset = \"S355\""), [12e-6, 10e-6]);
    assert_eq!(of("preset = \"S355\"\nexpansion = 11.5e-6"), [11.5e-6, 10e-6]);
    assert_eq!(of("preset = \"S355\"\nexpansion = 0"), [0.0, 10e-6]);
    assert_eq!(of("preset = \"copper\""), [0.0, 10e-6]);
    assert_eq!(of("young = 1e9\ndensity = 1e3"), [0.0, 10e-6]);
}

#[test]
fn a_projectile_flies_at_a_point_from_the_standoff_of_its_surface() {
    let text = |beam: &str, projectile: &str| {
        format!(
            "[material.m]\npreset = \"steel\"\n[section.s]\nshape = \"rectangle\"\nwidth = 1\n\
             depth = 0.2\n[section.t]\nshape = \"tapered\"\nstations = [0, 1]\n\
             sections = [\"s\", \"u\"]\n[section.u]\nshape = \"circle\"\ndiameter = 0.4\n\
             [section.bare]\narea = 1\ninertia = 1\n[beam.b]\nmaterial = \"m\"\nelements = 4\n{beam}\n\
             [projectile.p]\nkind = \"rigid\"\nrestitution = 1\nmass = 1\ncontact = \"surface\"\n\
             {projectile}\n[time]\nend = 1\nstep = 1\n"
        )
    };
    let straight = "points = [[0, 0], [4, 0]]\nsection =";
    let at = |section: &str, projectile: &str| {
        let text = text(&format!("{straight} {section}"), projectile);
        let scenario = crate::read(&text, "f").unwrap_or_else(|e| panic!("{e}"));
        let (builder, faults) = build::definitions(scenario.content(), None);
        assert_eq!(faults, []);
        let text = format!("{builder:?}");
        let position = text.split("radius: ").nth(1).and_then(|t| t.split("position: [").nth(1));
        let numbers = position.and_then(|t| t.split(']').next()).unwrap().to_string();
        let numbers: Vec<f64> = numbers.split(", ").map(|n| n.parse().unwrap()).collect();
        [numbers[0], numbers[1]]
    };
    let near = |a: [f64; 2], b: [f64; 2]| {
        assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12, "{a:?} {b:?}");
    };
    let down = "velocity = [0, -2]\nradius = 0.05\nstandoff = 0.3\nstrikes =";
    near(at("\"s\"", &format!("{down} \"b.mid\"")), [2.0, 0.45]);
    near(at("\"t\"", &format!("{down} \"b.mid\"")), [2.0, 0.5]);
    near(at("\"bare\"", &format!("{down} \"b@1m\"")), [1.0, 0.35]);
    let changed = "\"s\"\nchanges = [{ at = 0.5, section = \"u\" }]";
    near(at(changed, &format!("{down} \"b@0.4\"")), [1.6, 0.45]);
    near(at(changed, &format!("{down} \"b.mid\"")), [2.0, 0.55]);
    // At 45 degrees the surfaces are `standoff` away from each other along the line of motion.
    let oblique = "velocity = [1, -1]\nradius = 0.1\nstandoff = 1\nstrikes = \"b.mid\"";
    let way = (1.0 + 0.2 * 2f64.sqrt()) / 2f64.sqrt();
    near(at("\"s\"", oblique), [2.0 - way, way]);
    let at_rest = "velocity = [0, 0]\ndirection = [0, 3]\nstrikes = \"b.mid\"";
    near(at("\"s\"", at_rest), [2.0, -0.1]);
    // Beyond its ends a beam is round.
    let head_on = "velocity = [-3, 0]\nradius = 0.05\nstandoff = 0.5\nstrikes = \"b.end\"";
    near(at("\"s\"", head_on), [4.65, 0.0]);
}

/// What is given of the sections at the stations holds there; what is given of the tapered section itself holds everywhere.
#[test]
fn stations_have_the_properties_of_their_sections() {
    let built = |own: &str, of_station: &str| {
        let i = "shape = \"i\"\nwidth = 0.1\ndepth = 0.2\nflange = 0.01\nweb = 0.01\n";
        let text = format!(
            "[material.m]\npreset = \"steel\"\npoisson = 0.3\n[section.s]\nshape = \"tapered\"\n\
             stations = [0, 1]\nsections = [\"a\", \"b\"]\n{own}[section.a]\n{i}{of_station}\
             [section.b]\n{i}{of_station}[beam.b]\npoints = [[0, 0], [4, 0]]\nmaterial = \"m\"\n\
             elements = 4\nsection = \"s\"\ntheory = \"shear\"\n[time]\nend = 1\nstep = 1\n"
        );
        let scenario = crate::read(&text, "f").unwrap_or_else(|e| panic!("{e}"));
        let (builder, faults) = build::definitions(scenario.content(), None);
        assert_eq!(faults, []);
        let model = builder.build().unwrap_or_else(|faults| panic!("{faults:?}"));
        let span = model.beam(0).spans().next().unwrap();
        let section = span.section_at(1.2);
        let factor = section.shear / (span.shear_modulus().unwrap() * section.area);
        let text = format!("{builder:?}");
        let number = |part: &str| part.split(',').next().unwrap().parse::<usize>().unwrap();
        // That of the tapered section is first of the sections.
        let fibres = text.split(" fibres: ").nth(1).map(number).unwrap();
        (factor, section.rotary, fibres)
    };
    let (factor, rotary, fibres) = built("", "");
    // By Cowper, that of the I, whose web is nearly half of it.
    assert!((0.4..0.55).contains(&factor) && rotary > 0.0, "{factor} {rotary}");
    assert_eq!(fibres, percuss::Section::FIBRES);
    let given = "shear_factor = 0.05\nrotary_inertia = 7\nfibres = 40\n";
    let (factor, rotary, fibres) = built("", given);
    assert!((factor - 0.05).abs() < 1e-12, "{factor}");
    assert_eq!((rotary, fibres), (7.0, 40));
    let (factor, rotary, fibres) =
        built("shear_factor = 0.5\nrotary_inertia = 3\nfibres = 60\n", given);
    assert!((factor - 0.5).abs() < 1e-12, "{factor}");
    assert_eq!((rotary, fibres), (3.0, 60));
}
