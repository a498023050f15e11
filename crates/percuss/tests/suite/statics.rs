//! Static equilibrium against closed forms; mechanisms.

use crate::common;

use common::*;
use percuss::*;

/// A cantilever of the given slenderness with a dead force and a moment at its tip.
fn cantilever(
    strain: StrainMeasure,
    elements: usize,
    inertia: f64,
    force: [f64; 2],
    moment: f64,
) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material { strain, ..Material::new("m", 1e9, 1e3) });
    let section = b.section(Section::new("s", 1.0, inertia));
    let arm = b.beam(beam("arm", [0.0, 0.0], [1.0, 0.0], elements, material, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let kind = LoadKind::Point { at: at("tip", arm, 1.0), force, moment, follower: false };
    b.load(Load::new("tip", kind));
    b.record_point(at("tip", arm, 1.0));
    b.build().unwrap()
}

#[test]
fn a_cantilever_bends_as_bisshopp_and_drucker_found() {
    // alpha = P L^2 / EI; tip deflections by elliptic integrals (Bisshopp, Drucker 1945), A1 of the verification.
    // I/(A L^2) = 1e-6: slender enough for the inextensible closed form to 1e-5, stout enough for 64 elements.
    let inertia = 1e-6;
    for (alpha, w, u) in [
        (1.0, 0.3017207738, 0.0564332363),
        (2.0, 0.4934574804, 0.1606417208),
        (5.0, 0.7137915236, 0.3876283607),
        (10.0, 0.8106090249, 0.5549955978),
    ] {
        let load = alpha * 1e9 * inertia;
        for strain in [StrainMeasure::Green, StrainMeasure::Engineering] {
            let model = cantilever(strain, 64, inertia, [0.0, load], 0.0);
            let found = equilibrium(&model).unwrap();
            let [x, y] = found.points[0].1;
            assert!((y - w).abs() < 2e-5 && (-x - u).abs() < 2e-5, "{alpha} {strain:?} {x} {y}");
            // The moment at the root is the force times its arm, the shear force there the force itself.
            let root = found.section_forces[0].moment.largest();
            assert!((root.value - load * (1.0 - u)).abs() < 2e-3 * load, "{root:?}");
            assert_eq!(root.s, 0.0);
            // Drawings show the same forces, those of the tip at the end of the last element.
            let (first, last) = (found.element_forces[0][0], found.element_forces[63][1]);
            assert_eq!(first[2], root.value);
            assert!(
                last[2].abs() < 1e-6 * load && (last[0].hypot(last[1]) / load - 1.0).abs() < 1e-3
            );
        }
    }
}

#[test]
fn convergence_in_the_element_size_is_of_fourth_order_at_least() {
    let tip = |elements: usize| {
        let model = cantilever(StrainMeasure::Green, elements, 1e-3, [0.0, 2e6], 0.0);
        equilibrium(&model).unwrap().points[0].1[1]
    };
    let (a, b, c) = (tip(8), tip(16), tip(32));
    let order = ((a - b) / (b - c)).abs().log2();
    assert!(order > 3.9, "{order}"); // the tip of a smooth solution converges faster than its inside
}

#[test]
fn an_end_moment_rolls_a_beam_into_the_circle_of_its_law() {
    // A2: Green: M/EI = k (1 - 2 (I/A) k^2), nu = sqrt(1 - 2 (I/A) k^2), tip = nu/k (sin k, 1 - cos k).
    let (young, inertia) = (1e9, 1e-4);
    let k = std::f64::consts::PI;
    for strain in [StrainMeasure::Green, StrainMeasure::Engineering] {
        let soften = if strain == StrainMeasure::Green { 1.0 - 2.0 * inertia * k * k } else { 1.0 };
        let moment = young * inertia * k * soften;
        let model = cantilever(strain, 32, inertia, [0.0, 0.0], moment);
        let [x, y] = equilibrium(&model).unwrap().points[0].1;
        let nu = soften.sqrt();
        assert!((1.0 + x - nu / k * k.sin()).abs() < 1e-6, "{strain:?} {x}");
        assert!((y - nu / k * (1.0 - k.cos())).abs() < 1e-6, "{strain:?} {y}");
    }
}

#[test]
fn a_frame_held_by_its_joints_carries_its_load() {
    // A portal: two columns clamped at their feet, a girder connected to both; each column carries half the load.
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let left = b.beam(beam("left", [0.0, 0.0], [0.0, 3.0], 6, material, section));
    let girder = b.beam(beam("girder", [0.0, 3.0], [4.0, 3.0], 8, material, section));
    let right = b.beam(beam("right", [4.0, 0.0], [4.0, 3.0], 6, material, section));
    for (name, column) in [("l", left), ("r", right)] {
        b.support(Support::new(name, at(name, column, 0.0), SupportKind::Clamp));
        let corner = if name == "l" { 0.0 } else { 1.0 };
        b.joint(Joint {
            name: name.into(),
            kind: JointKind::Rigid,
            between: [at("top", column, 1.0), at("girder", girder, corner)],
            yielding: None,
            strength: None,
        });
    }
    let kind = LoadKind::Point {
        at: at("mid", girder, 0.5),
        force: [0.0, -2e4],
        moment: 0.0,
        follower: false,
    };
    b.load(Load::new("load", kind));
    b.record_point(at("mid", girder, 0.5));
    let model = b.build().unwrap();
    assert_eq!(mechanisms(&model), []);
    let found = equilibrium(&model).unwrap();
    for ((name, [thrust, up, moment]), sign) in found.reactions.iter().zip([1.0, -1.0]) {
        assert!((up - 1e4).abs() < 1e-4, "{name}: {up}");
        // The horizontal reactions at the columns' feet are directed inwards.
        assert!(thrust * sign > 1e3 && moment * sign < -1e2, "{name}: {thrust} {moment}");
    }
    for (beam, (_, [thrust, up, _])) in [0, 2].into_iter().zip(&found.reactions) {
        // A column is vertical at its foot. Higher up it is inclined: there its axial force contributes to the thrust, too.
        let forces = &found.section_forces[beam];
        assert!((forces.envelope.axial[0][0] + up).abs() < 1e-4, "{}", forces.envelope.axial[0][0]);
        let axial = forces.axial.largest().value;
        assert!(axial < -up && axial > -up.hypot(*thrust) - 1e-4, "{axial} {thrust}");
    }
    assert!(found.points[0].1[1] < 0.0 && found.points[0].1[0].abs() < 1e-9);
}

#[test]
fn mechanisms_are_named() {
    let build = |kinds: &[(f64, SupportKind)]| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let loose = b.beam(beam("loose", [0.0, 0.0], [3.0, 1.0], 5, material, section));
        for (i, (f, kind)) in kinds.iter().enumerate() {
            b.support(Support::new(format!("s{i}"), at("p", loose, *f), kind.clone()));
        }
        b.build().unwrap()
    };
    let roller = SupportKind::Roller { direction: [1.0, 0.0] };
    for kinds in
        [vec![], vec![(0.0, SupportKind::Pin)], vec![(0.0, roller.clone()), (1.0, roller.clone())]]
    {
        let faults = mechanisms(&build(&kinds));
        let fault = faults.first().expect("a mechanism");
        assert!(fault.found.contains("`loose`"), "{fault}");
    }
    for kinds in [
        vec![(0.0, SupportKind::Clamp)],
        vec![(0.0, SupportKind::Pin), (1.0, roller)],
        vec![(0.3, SupportKind::Clamp)],
    ] {
        assert_eq!(mechanisms(&build(&kinds)), []);
    }
}

#[test]
fn a_spring_that_pushes_makes_no_mechanism() {
    // The spring is in compression and softens the column; it would buckle, but it is supported.
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let column = b.beam(beam("column", [0.0, 0.0], [0.0, 3.0], 6, material, section));
    b.support(Support::new("root", at("root", column, 0.0), SupportKind::Clamp));
    let between = [Anchor::Point(at("top", column, 1.0)), Anchor::Ground([0.0, 4.0])];
    let name = "strut".into();
    b.spring(Spring {
        name,
        between,
        law: SpringLaw::Linear { stiffness: 1e6 },
        damping: 0.0,
        length: Some(1.5),
        strength: None,
        yielding: None,
    });
    assert_eq!(mechanisms(&b.build().unwrap()), []);
}

#[test]
fn every_loose_beam_is_named_at_once() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    for (k, held) in [false, true, false].into_iter().enumerate() {
        let x = 5.0 * k as f64;
        let name = format!("beam{k}");
        let one = b.beam(beam(&name, [x, 0.0], [x + 3.0, 0.0], 4, material, section));
        if held {
            b.support(Support::new("root", at("root", one, 0.0), SupportKind::Clamp));
        }
    }
    let model = b.build().unwrap();
    let named: Vec<String> = mechanisms(&model).into_iter().map(|f| f.path).collect();
    assert_eq!(named, ["beam.beam0", "beam.beam2"]);
    // Neither has an equilibrium to start from.
    let settings = Settings { start: Start::Static, ..Settings::new(1.0, 1e-3) };
    let faults = simulate(&model, &settings, &mut NoRecorder).unwrap_err();
    assert_eq!(faults.len(), 2);
}

#[test]
fn a_load_beyond_the_largest_moment_of_the_green_law_has_no_equilibrium() {
    // Trap 1: the largest moment is at k = 1 / sqrt(6 I/A).
    let (young, inertia) = (1e9, 1e-2);
    let k = 1.0 / f64::sqrt(6.0 * inertia);
    let largest = young * inertia * k * (1.0 - 2.0 * inertia * k * k);
    let model = cantilever(StrainMeasure::Green, 16, inertia, [0.0, 0.0], 1.1 * largest);
    let error = equilibrium(&model).unwrap_err();
    assert!(error.is_no_convergence(), "{error}");
    let text = error.to_string();
    assert!(text.contains("beam `arm`") && text.contains("2.721655e7 N m"), "{text}");
}

/// A clamped plank struck amidst: a static force F there bends it by F L / 8 and deflects it by F L^3 / (192 EI).
#[test]
fn equivalent_static_forces_are_those_of_beam_theory() {
    for (kind, bending, deflecting) in
        [(SupportKind::Clamp, 8.0, 192.0), (SupportKind::Pin, 4.0, 48.0)]
    {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 8, material, section));
        for (name, f) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, girder, f), kind.clone()));
        }
        b.projectile(elastic("mass", at("mid", girder, 0.5), [0.0, 0.01]));
        b.record_point(at("mid", girder, 0.5));
        let model = b.build().unwrap();
        let summary = simulate(&model, &Settings::new(2.2, 1e-3), &mut NoRecorder).unwrap();
        let found = summary.contacts[0].equivalent_force.unwrap();
        let moment = summary.section_forces[0].moment.largest().value.abs();
        let deflection = summary.points[0].displacement_max[1].value.abs();
        assert!(moment > 0.0 && deflection > 0.0);
        // Nonlinear: with ends that cannot approach each other the plank is stiffer by the force along it, 3e-6 clamped and 3e-5 on pins here.
        let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-4, "{a} {b}");
        near(found.moment.unwrap(), moment * bending / 3.0);
        near(found.deflection.unwrap(), deflection * deflecting * 0.2e10 * 8.33e-5 / 27.0);
    }
}

#[test]
fn where_more_than_the_impact_acts_no_equivalent_force_is_reported() {
    let reported = |change: &dyn Fn(&mut ModelBuilder, BeamId)| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 4, material, section));
        b.projectile(elastic("mass", at("mid", girder, 0.5), [0.0, 1.0]));
        change(&mut b, girder);
        let model = b.build().unwrap();
        let summary = simulate(&model, &Settings::new(0.03, 1e-3), &mut NoRecorder).unwrap();
        summary.contacts[0].equivalent_force.is_some()
    };
    let held = |b: &mut ModelBuilder, girder| {
        b.support(Support::new("left", at("left", girder, 0.0), SupportKind::Clamp));
    };
    assert!(reported(&held));
    assert!(!reported(&|_, _| ()), "a beam that flies");
    assert!(!reported(&|b, girder| {
        // It oscillates under its weight from the start.
        held(b, girder);
        b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    }));
    let spring = |length| {
        move |b: &mut ModelBuilder, girder| {
            held(b, girder);
            let between = [Anchor::Point(at("end", girder, 1.0)), Anchor::Ground([3.0, 1.0])];
            let (name, stiffness) = ("stay".into(), 1e3);
            b.spring(Spring {
                name,
                between,
                law: SpringLaw::Linear { stiffness },
                damping: 0.0,
                length,
                strength: None,
                yielding: None,
            });
        }
    };
    assert!(reported(&spring(None)), "a spring of the length it has");
    assert!(!reported(&spring(Some(0.9))), "a spring that pulls from the start");
    assert!(!reported(&|b, girder| {
        held(b, girder);
        let kind = LoadKind::Gravity { acceleration: [0.0, -9.81] };
        let function = TimeFunction::Ramp { duration: 0.01 };
        b.load(Load { function, ..Load::new("g", kind) });
    }));
    assert!(!reported(&|b, girder| {
        held(b, girder);
        b.projectile(elastic("other", at("late", girder, 1.0), [0.0, 1.0]));
    }));
}

/// A beam under its weight q, struck at midspan: an additional static force F bends a pinned one by q L^2/8 + F L/4 there and deflects it by 5 q
/// L^4/(384 EI) + F L^3/(48 EI).
#[test]
fn an_equivalent_static_force_acts_beside_the_weight() {
    let (length, bending, mass) = (3.0, 0.2e10 * 8.33e-5, 0.1 * 3e3);
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [length, 0.0], 8, material, section));
    b.support(Support::new("a", at("a", girder, 0.0), SupportKind::Pin));
    let roller = SupportKind::Roller { direction: [1.0, 0.0] };
    b.support(Support::new("z", at("z", girder, 1.0), roller));
    let pull = 1e-3;
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -pull] }));
    b.projectile(elastic("mass", at("mid", girder, 0.5), [0.0, -0.01]));
    b.record_point(at("mid", girder, 0.5));
    let model = b.build().unwrap();
    let settings = Settings { start: Start::Static, ..Settings::new(2.2, 1e-3) };
    let summary = simulate(&model, &settings, &mut NoRecorder).unwrap();
    let found = summary.contacts[0].equivalent_force.unwrap();
    let weight = mass * pull;
    let moment = summary.section_forces[0].moment.largest();
    // Where it is largest the beam is bent as by a force amidst.
    assert!((moment.s - 0.5 * length).abs() < 1e-9, "{moment:?}");
    let by_moment = (moment.value.abs() - weight * length * length / 8.0) * 4.0 / length;
    assert!((found.moment.unwrap() / by_moment - 1.0).abs() < 1e-6, "{found:?} {by_moment}");
    let sag = 5.0 * weight * length.powi(4) / (384.0 * bending);
    let deflection = summary.points[0].displacement_max[1].value.abs();
    let by_deflection = (deflection - sag) * 48.0 * bending / length.powi(3);
    assert!(sag > 1e-3 * deflection, "the weight counts: {sag} of {deflection}");
    let off = found.deflection.unwrap() / by_deflection - 1.0;
    assert!(off.abs() < 1e-5, "{found:?} {by_deflection}");
}

/// Without one the reason is given.
#[test]
fn a_beam_that_flies_has_no_equivalent_force() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 4, material, section));
    b.projectile(elastic("mass", at("mid", girder, 0.5), [0.0, 1.0]));
    let model = b.build().unwrap();
    let summary = simulate(&model, &Settings::new(0.05, 1e-3), &mut NoRecorder).unwrap();
    let reported = summary.contacts[0].no_equivalent_force.as_deref();
    assert_eq!(reported, Some("the structure is not supported in this direction"));
}

/// A column with springs between its tip and the ground, each so long without force.
fn tied(springs: &[([f64; 2], Option<f64>)]) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 210e9, 7850.0));
    let section = b.section(Section::rectangle("square", 0.06, 0.06));
    let column = b.beam(beam("column", [0.0, 0.0], [0.0, 3.0], 8, material, section));
    b.support(Support::new("foot", at("foot", column, 0.0), SupportKind::Clamp));
    for (i, (ground, length)) in springs.iter().enumerate() {
        b.spring(Spring {
            name: format!("tie{i}"),
            between: [Anchor::Point(at("tip", column, 1.0)), Anchor::Ground(*ground)],
            law: SpringLaw::Linear { stiffness: 1e7 },
            damping: 0.0,
            length: *length,
            strength: None,
            yielding: None,
        });
    }
    b.build().unwrap()
}

/// A stretched spring in the reference configuration, which is then no equilibrium, has no force in modes about it: the corresponding force of the
/// beam is missing too. If the forces of springs balance, they are included.
#[test]
fn modes_about_the_reference_take_no_part_of_a_pretension_that_nothing_balances() {
    let lowest = |model: &Model| natural_frequencies(model, 1)[0];
    let foot = [0.0, 0.0];
    let [stretched, plain] = [Some(2.995), None].map(|length| tied(&[(foot, length)]));
    assert!((lowest(&stretched) / lowest(&plain) - 1.0).abs() < 1e-12);
    let about = |model: &Model| {
        let found = equilibrium(model).unwrap();
        modes_about_equilibrium(model, &found, 1)[0].frequency()
    };
    assert!((about(&plain) / lowest(&plain) - 1.0).abs() < 1e-9);
    assert!(about(&stretched) < 0.96 * lowest(&stretched), "the column bears the force");
    // One spring on either side.
    let sides = [[-2.0, 3.0], [2.0, 3.0]];
    let balanced = tied(&sides.map(|ground| (ground, Some(1.9))));
    assert!((lowest(&balanced) / about(&balanced) - 1.0).abs() < 1e-9);
}

#[test]
fn a_load_that_begins_at_zero_does_not_act_at_time_zero() {
    let functions = [
        TimeFunction::Ramp { duration: 1e-3 },
        TimeFunction::HalfSine { duration: 1e-3 },
        TimeFunction::Table { times: vec![0.0, 1e-3], values: vec![0.0, 1.0], smooth: false },
    ];
    for function in functions {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let arm = b.beam(beam("arm", [0.0, 0.0], [1.0, 0.0], 4, material, section));
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        let force = LoadKind::Point {
            at: at("tip", arm, 1.0),
            force: [0.0, -1e3],
            moment: 0.0,
            follower: false,
        };
        b.load(Load { function: function.clone(), ..Load::new("push", force) });
        let found = equilibrium(&b.build().unwrap()).unwrap();
        assert_eq!(found.reactions[0].1, [0.0; 3], "{function:?}");
    }
}
