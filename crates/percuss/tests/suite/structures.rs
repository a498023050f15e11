//! Sections, supports, springs, joints, masses and loads at rest, each against a closed form of its own; modes, buckling, faults.

use crate::common;

use common::at;
use common::straight::*;
use percuss::*;

/// Displacement of the tip in equilibrium.
fn tip(model: &Model) -> [f64; 2] {
    equilibrium(model).unwrap().points[0].1
}

/// Small enough for linear theory.
const SMALL: f64 = 1e-3;

#[test]
fn an_elastic_support_gives_way_along_its_axes() {
    // A rigid-body push: both ends on the same springs, the axis turned by 30 degrees.
    let (sine, cosine) = (0.5, 0.75_f64.sqrt());
    let model = beam(4, |b, beam| {
        for (name, f) in [("a", 0.0), ("b", 1.0)] {
            let kind = SupportKind::Elastic {
                direction: [cosine, sine],
                stiffness: [1e3, 4e3],
                damping: [0.0; 2],
                rotational_stiffness: 0.0,
                rotational_damping: 0.0,
            };
            b.support(Support::new(name, at(name, beam, f), kind));
        }
        for f in [0.0, 1.0] {
            force(b, beam, f, [SMALL * cosine, SMALL * sine], 0.0);
        }
    });
    let u = tip(&model);
    close(u[0] * cosine + u[1] * sine, SMALL / 1e3, 1e-6);
    assert!((u[1] * cosine - u[0] * sine).abs() < 1e-9 * SMALL);
}

#[test]
fn a_rotational_spring_turns_by_moment_over_stiffness() {
    // Pinned, with a rotational spring: tip rotation from the spring alone is M/k, and the beam adds its bending.
    let stiffness = 50.0;
    let model = beam(8, |b, beam| {
        let pin = SupportKind::Pin;
        b.support(Support::new("pin", at("pin", beam, 0.0), pin));
        let spring = SupportKind::Elastic {
            direction: [1.0, 0.0],
            stiffness: [0.0; 2],
            damping: [0.0; 2],
            rotational_stiffness: stiffness,
            rotational_damping: 0.0,
        };
        b.support(Support::new("spring", at("pin", beam, 0.0), spring));
        force(b, beam, 1.0, [0.0, 0.0], SMALL);
    });
    close(tip(&model)[1], SMALL * 2.0 / stiffness + SMALL * 4.0 / (2.0 * BENDING), 1e-6);
    let reactions = equilibrium(&model).unwrap().reactions;
    close(reactions[1].1[2], -SMALL, 1e-6);
}

#[test]
fn a_spring_between_beam_and_ground_pulls_along_its_line() {
    // A stay at 45 degrees at the tip of a hinged bar carries F/sin(45) and lengthens by F/(k sin^2(45)) vertically.
    let stiffness = 2e4;
    let model = beam(2, |b, beam| {
        b.support(Support::new("hinge", at("hinge", beam, 0.0), SupportKind::Pin));
        let between = [Anchor::Point(at("tip", beam, 1.0)), Anchor::Ground([0.0, 2.0])];
        let name = "stay".into();
        b.spring(Spring {
            name,
            between,
            law: SpringLaw::Linear { stiffness },
            damping: 0.0,
            length: None,
            strength: None,
            yielding: None,
        });
        force(b, beam, 1.0, [0.0, -SMALL], 0.0);
    });
    // The bar's own axial flexibility adds F L / (E A) once over.
    let expected = SMALL / (stiffness * 0.5) + SMALL * 2.0 / (YOUNG * AREA);
    close(tip(&model)[1], -expected, 1e-6);
}

#[test]
fn an_elastic_hinge_adds_moment_over_stiffness() {
    let stiffness = 80.0;
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", YOUNG, DENSITY));
    let section = b.section(Section::new("s", AREA, INERTIA));
    let one = b.beam(Beam::new("one", &[[0.0, 0.0], [1.0, 0.0]], 4, material, section));
    // Drawn the other way round: the angle of the hinge starts at half a turn.
    let two = b.beam(Beam::new("two", &[[2.0, 0.0], [1.0, 0.0]], 4, material, section));
    clamp(&mut b, one);
    let kind = JointKind::ElasticHinge { stiffness, damping: 0.0 };
    let between = [at("one.end", one, 1.0), at("two.end", two, 1.0)];
    b.joint(Joint::new("hinge", kind, between));
    force(&mut b, two, 0.0, [0.0, SMALL], 0.0);
    b.record_point(at("tip", two, 0.0));
    let found = tip(&b.build().unwrap())[1];
    close(found, SMALL * 8.0 / (3.0 * BENDING) + SMALL * 1.0 / stiffness, 1e-6);
}

#[test]
fn distributed_loads_bend_as_they_should() {
    let spread = |q: [f64; 2], follower: bool, stretch: [f64; 2]| {
        beam(7, |b, beam| {
            clamp(b, beam);
            let kind = LoadKind::Distributed {
                beam,
                stretch: stretch.map(Along::Fraction),
                force: [[0.0, q[0]], [0.0, q[1]]],
                follower,
            };
            b.load(Load::new("q", kind));
        })
    };
    let unit = SMALL * 2.0_f64.powi(4) / BENDING;
    for follower in [false, true] {
        close(tip(&spread([SMALL, SMALL], follower, [0.0, 1.0]))[1], unit / 8.0, 1e-6);
        // From zero at the root to q at the tip: 11 q L^4 / (120 EI).
        close(tip(&spread([0.0, SMALL], follower, [0.0, 1.0]))[1], unit * 11.0 / 120.0, 1e-6);
    }
    // On the outer half, which ends within an element: 41 q L^4 / (384 EI).
    close(tip(&spread([SMALL, SMALL], false, [0.5, 1.0]))[1], unit * 41.0 / 384.0, 1e-5);
}

#[test]
fn a_follower_force_keeps_its_angle_to_the_beam() {
    // Pulled along its tangent at the tip and bent by a moment, the beam's root carries the force turned with the tip.
    let moment = 0.4 * BENDING;
    let model = beam(24, |b, beam| {
        clamp(b, beam);
        let at = at("tip", beam, 1.0);
        let kind = LoadKind::Point { at, force: [50.0, 0.0], moment, follower: true };
        b.load(Load::new("jet", kind));
    });
    let found = equilibrium(&model).unwrap();
    let tangent = found.state.displacement.last().map(|u| [1.0 + u[2], u[3]]).unwrap();
    let size = tangent[0].hypot(tangent[1]);
    let root = found.reactions[0].1;
    for i in 0..2 {
        assert!((root[i] + 50.0 * tangent[i] / size).abs() < 1e-6, "{root:?}");
    }
    assert!(tangent[1] > 0.3);
}

#[test]
fn sections_that_change_and_taper_bend_as_integrals_say() {
    // Tip deflection of a cantilever under a tip force: int x^2 / EI dx, x from the tip.
    let integral = |inertia: &dyn Fn(f64) -> f64| {
        let n = 20_000;
        let h = 2.0 / f64::from(n);
        (0..n)
            .map(|k| {
                let s = (f64::from(k) + 0.5) * h;
                (2.0 - s).powi(2) / (YOUNG * inertia(s)) * h
            })
            .sum::<f64>()
    };
    let build = |tapered: bool| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", YOUNG, DENSITY));
        let station = |at: f64, inertia: f64| Station {
            at,
            area: AREA,
            inertia,
            depth: None,
            profile: Profile::Unknown,
            properties: Default::default(),
        };
        let stations = vec![station(0.0, 3e-5), station(1.0, 1e-5)];
        let taper = b.section(Section { stations, ..Section::new("taper", AREA, 3e-5) });
        let thick = b.section(Section::new("thick", AREA, 3e-5));
        let thin = b.section(Section::new("thin", AREA, 1e-5));
        let ends = [[0.0, 0.0], [2.0, 0.0]];
        let beam = if tapered {
            b.beam(Beam::new("beam", &ends, 16, material, taper))
        } else {
            let change = Change { at: Along::Distance(0.7), material: None, section: Some(thin) };
            b.beam(Beam { changes: vec![change], ..Beam::new("beam", &ends, 8, material, thick) })
        };
        clamp(&mut b, beam);
        force(&mut b, beam, 1.0, [0.0, SMALL], 0.0);
        b.record_point(at("tip", beam, 1.0));
        b.build().unwrap()
    };
    let expected = integral(&|s| 3e-5 - 1e-5 * s);
    close(tip(&build(true))[1], SMALL * expected, 1e-5);
    let expected = integral(&|s| if s < 0.7 { 3e-5 } else { 1e-5 });
    close(tip(&build(false))[1], SMALL * expected, 1e-6);
}

#[test]
fn a_tip_mass_lowers_the_frequency_to_that_of_a_spring_and_a_mass() {
    let mass = 1e5;
    let model = beam(8, |b, beam| {
        clamp(b, beam);
        let at = at("tip", beam, 1.0);
        b.point_mass(PointMass { name: "m".into(), at, mass, rotary_inertia: 0.0 });
    });
    // Rayleigh: 33/140 of the beam's mass moves with it.
    let moving = mass + 33.0 / 140.0 * DENSITY * AREA * 2.0;
    let expected = (3.0 * BENDING / 8.0 / moving).sqrt() / std::f64::consts::TAU;
    close(natural_frequencies(&model, 1)[0], expected, 1e-6);
}

#[test]
fn a_beam_buckles_at_eulers_load() {
    let model = beam(16, |b, beam| {
        b.support(Support::new("a", at("a", beam, 0.0), SupportKind::Pin));
        let roller = SupportKind::Roller { direction: [1.0, 0.0] };
        b.support(Support::new("b", at("b", beam, 1.0), roller));
        force(b, beam, 1.0, [-1.0, 0.0], 0.0);
    });
    let euler = std::f64::consts::PI.powi(2) * BENDING / 4.0;
    // The prestrain of Euler's load is 2.5e-3.
    let found = buckling(&model, 2).modes;
    close(found[0].factor, euler, 1e-4);
    close(found[1].factor, 4.0 * euler, 1e-3);
    // Without load there is no buckling.
    assert_eq!(buckling(&beam(4, clamp), 1).outcome, BucklingOutcome::Unloaded);
}

#[test]
fn a_limit_point_under_load_control_names_arc_length() {
    // A shallow pinned arch under a load at its crown snaps through.
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 2.1e11, 7850.0));
    let section = b.section(Section::rectangle("s", 0.02, 0.004));
    let points = [[0.0, 0.0], [0.5, 0.03], [1.0, 0.0]];
    let arch = Beam { curve: Curve::Arc, ..Beam::new("arch", &points, 16, material, section) };
    let arch = b.beam(arch);
    for (name, f) in [("a", 0.0), ("b", 1.0)] {
        b.support(Support::new(name, at(name, arch, f), SupportKind::Pin));
    }
    force(&mut b, arch, 0.5, [0.0, -2000.0], 0.0);
    b.record_point(at("crown", arch, 0.5));
    let model = b.build().unwrap();
    let end = PathEnd::Displacement { point: "crown".into(), component: 2, value: -0.06 };
    let path = equilibrium_path(&model, &PathSettings { end, ..PathSettings::default() }).unwrap();
    assert!(path.reached && path.limit_points.len() >= 2, "{:?}", path.limit_points);
    let limit = path.limit_points[0].factor;
    assert!(limit > 0.0 && limit < 1.0, "{limit}");
    // Load control either stops before the limit point, naming the path by arc length, or reports that it has jumped past it.
    match equilibrium(&model) {
        Err(error) => assert!(error.to_string().contains("static --path"), "{error}"),
        Ok(found) => panic!("jumped to {:?}", found.points),
    }
}

#[test]
fn faults_are_reported_all_at_once() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material { retardation: -1.0, ..Material::new("m", YOUNG, DENSITY) });
    let station = |at: f64| Station {
        at,
        area: 1.0,
        inertia: 1.0,
        depth: None,
        profile: Profile::Unknown,
        properties: Default::default(),
    };
    let stations = vec![station(0.0), station(0.7), station(0.5)];
    let section = b.section(Section { stations, ..Section::new("s", AREA, INERTIA) });
    let points = [[0.0, 0.0], [1.0, 0.0], [0.2, 0.0]];
    let back = b.beam(Beam::new("back", &points, 4, material, section));
    let still = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]];
    b.beam(Beam::new("still", &still, 4, material, section));
    let line = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
    b.beam(Beam { curve: Curve::Arc, ..Beam::new("flat", &line, 4, material, section) });
    b.beam(Beam::new("few", &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], 1, material, section));
    let beyond = PointRef { label: "back@9m".into(), beam: back, along: Along::Distance(9.0) };
    let kind = LoadKind::Point { at: beyond, force: [1.0, 0.0], moment: 0.0, follower: false };
    let (times, values) = (vec![0.0, 2.0, 1.0], vec![1.0, 2.0, 3.0]);
    let function = TimeFunction::Table { times, values, smooth: false };
    b.load(Load { function, ..Load::new("lost", kind) });
    let mut roller = Support::new("roller", at("a", back, 0.0), SupportKind::Pin);
    roller.motion =
        Some(Motion { displacement: [0.0; 2], rotation: 1.0, function: TimeFunction::Constant });
    b.support(roller);
    let faults: Vec<String> = b.build().unwrap_err().iter().map(ToString::to_string).collect();
    let all = faults.join("\n");
    for expected in [
        "material.m.retardation",
        "section.s.stations: found stations [0, 0.7, 0.5]",
        "beam.back.points: found a corner of 180 degrees at point 2",
        "beam.still.points: found a part of zero length between points 2 and 3",
        "beam.flat.points: found 3 points on a straight line",
        "beam.few.elements: found 1 element for 2 straight parts",
        "load.lost.at: found back@9m",
        "load.lost.function: found 1 s after 2 s",
        "support.roller.motion: found a prescribed rotation",
    ] {
        assert!(all.contains(expected), "{expected} missing in\n{all}");
    }
}

#[test]
fn a_load_across_a_beam_buckles_nothing() {
    // The cantilever has no compression: its displacements must not count as a prestress.
    let across = beam(8, |b, beam| {
        clamp(b, beam);
        force(b, beam, 1.0, [0.0, 100.0], 0.0);
    });
    // The rest is the coupling of moments and stretches in Green strains, at strains of the order of one.
    assert!(buckling(&across, 1).modes.iter().all(|m| m.factor > 1e3));
    // A column under its weight of load and a push across buckles at Euler's load all the same.
    let column = beam(16, |b, beam| {
        clamp(b, beam);
        force(b, beam, 1.0, [-1.0, 0.7], 0.0);
    });
    let euler = std::f64::consts::PI.powi(2) * BENDING / 16.0;
    close(buckling(&column, 1).modes[0].factor, euler, 1e-3);
}

#[test]
fn an_overloaded_column_is_unstable_however_far() {
    let euler = std::f64::consts::PI.powi(2) * BENDING / 16.0;
    for share in [0.9, 1.1, 1.4, 2.0, 8.0] {
        let column = beam(16, |b, beam| {
            clamp(b, beam);
            force(b, beam, 1.0, [-share * euler, 0.0], 0.0);
        });
        let found = equilibrium(&column).unwrap();
        assert_eq!(found.stable, share < 1.0, "{share}");
        let lowest = modes_about(&column, &found.state, 1)[0].eigenvalue;
        assert_eq!(lowest > 0.0, share < 1.0, "{share}: {lowest}");
    }
}

#[test]
fn a_path_begins_where_stressed_springs_have_drawn_the_beam() {
    let model = beam(4, |b, beam| {
        clamp(b, beam);
        let between = [Anchor::Point(at("tip", beam, 1.0)), Anchor::Ground([2.0, 1.0])];
        let name = "stay".into();
        b.spring(Spring {
            name,
            between,
            law: SpringLaw::Linear { stiffness: 1e4 },
            damping: 0.0,
            length: Some(0.9),
            strength: None,
            yielding: None,
        });
        force(b, beam, 1.0, [0.0, -500.0], 0.0);
    });
    let found = equilibrium(&model).unwrap().points[0].1;
    let path = equilibrium_path(&model, &PathSettings::default()).unwrap();
    assert!(path.points[0].displacements[0][1] > 0.01, "drawn up before the load acts");
    let end = path.points.last().unwrap().displacements[0];
    for i in 0..2 {
        assert!((found[i] - end[i]).abs() < 1e-8, "{found:?} {end:?}");
    }
}

#[test]
fn free_bodies_have_three_motions_without_frequency_however_slender() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 2.1e11, 7850.0));
    let section = b.section(Section::new("wire", 1e-6, 1e-14));
    let bent = [[1.3, 0.2], [2.7, 1.9], [2.9, 4.0]];
    b.beam(Beam::new("wire", &bent, 12, material, section));
    let model = b.build().unwrap();
    let found = natural_frequencies(&model, 5);
    assert_eq!(found[..3], [0.0; 3]);
    assert!(found[3] > 1e-4, "{found:?}");
}
