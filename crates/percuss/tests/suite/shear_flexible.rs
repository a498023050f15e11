//! Shear-flexible beams: closed forms, balances, and what they share with slender ones.

use crate::common;

use common::*;
use percuss::*;

/// A beam along the first axis.
fn shear(length: f64, elements: usize, material: MaterialId, section: SectionId) -> Beam {
    let slender = beam("arm", [0.0, 0.0], [length, 0.0], elements, material, section);
    Beam { theory: Theory::Shear, ..slender }
}

fn isotropic(young: f64, density: f64, poisson: f64) -> Material {
    Material { poisson: Some(poisson), ..Material::new("m", young, density) }
}

/// A cantilever of a rectangular section, one wide, with a force across its tip.
fn cantilever(
    elements: usize,
    [length, width, depth]: [f64; 3],
    material: Material,
    force: f64,
) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(material);
    let section = b.section(Section::rectangle("s", width, depth));
    let arm = b.beam(shear(length, elements, material, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let kind = LoadKind::Point {
        at: at("tip", arm, 1.0),
        force: [0.0, force],
        moment: 0.0,
        follower: false,
    };
    b.load(Load::new("tip", kind));
    b.record_point(at("tip", arm, 1.0));
    b.build().unwrap()
}

fn worst(summary: &RunSummary) -> f64 {
    let m = &summary.momentum;
    summary.energy.residual_max.max(m.linear_residual_max).max(m.angular_residual_max)
}

fn run(model: &Model, settings: &Settings) -> RunSummary {
    let summary = simulate(model, settings, &mut NoRecorder).unwrap();
    assert!(matches!(summary.termination, Termination::Completed), "{summary:?}");
    summary
}

/// N of a cantilever is the part of its force along the normal of the section, largest at the tip; the shear strain of the axis, which is not small
/// against rotations here, is no part of it.
#[test]
fn the_axial_force_is_along_the_normal_of_the_section() {
    let (young, depth) = (1e9, 0.5);
    let bending = young * f64::powi(depth, 3) / 12.0;
    let force = -1e-5 * bending;
    for elements in [1, 4, 16] {
        let model = cantilever(elements, [1.0, 1.0, depth], isotropic(young, 1e3, 0.25), force);
        let found = equilibrium(&model).unwrap();
        let forces = &found.section_forces[0];
        // Rotations of 5e-6 change the force along the normal by their square.
        let most = force * force / (2.0 * bending);
        assert!((forces.axial.max.value / most - 1.0).abs() < 1e-6, "{elements}: {forces:?}");
        assert!(forces.axial.min.value.abs() < 1e-6 * most, "{elements}: {forces:?}");
        assert!((forces.shear.min.value / -force - 1.0).abs() < 1e-9, "{elements}: {forces:?}");
    }
}

#[test]
fn a_cantilever_has_the_deflections_of_bending_and_shear_for_any_slenderness() {
    let (young, nu) = (1e9, 0.25);
    let kappa = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
    for depth in [0.5, 0.1, 0.01, 1e-3] {
        let bending = young * f64::powi(depth, 3) / 12.0;
        let shear = kappa * young / (2.0 * (1.0 + nu)) * depth;
        let force = 1e-3 * bending;
        let tip = force * (1.0 / (3.0 * bending) + 1.0 / shear);
        for elements in [1, 2, 7] {
            let model = cantilever(elements, [1.0, 1.0, depth], isotropic(young, 1e3, nu), force);
            let found = equilibrium(&model).unwrap();
            let [_, y] = found.points[0].1;
            assert!((y / tip - 1.0).abs() < 1e-6, "{depth} {elements}: {y:e} {tip:e}");
            // Section forces are those of the balance, for any number of elements.
            let root = found.section_forces[0].moment.largest();
            assert!((root.value.abs() / force - 1.0).abs() < 1e-6 && root.s == 0.0, "{root:?}");
            let across = found.section_forces[0].shear.largest().value;
            assert!((across.abs() / force - 1.0).abs() < 1e-6, "{across}");
        }
    }
}

/// `F^2 L / (2 kappa G A)` and `F^2 L^3 / (6 EI)`, for any number of elements.
#[test]
fn strain_energy_is_split_into_bending_and_shear() {
    let (young, nu, depth) = (1e9, 0.25, 0.5);
    let kappa = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
    let bending = young * f64::powi(depth, 3) / 12.0;
    let shear = kappa * young / (2.0 * (1.0 + nu)) * depth;
    let force = 1e-5 * bending;
    let settings = Settings { start: Start::Static, ..Settings::new(1e-3, 1e-4) };
    let energies = |model: &Model| {
        let mut rows = MemoryRecorder::default();
        simulate(model, &settings, &mut rows).unwrap();
        ["shear", "bending", "axial"]
            .map(|part| rows.column(&format!("energy.strain_{part}")).map(|all| all[0]))
    };
    for elements in [1, 3, 8] {
        let model = cantilever(elements, [1.0, 1.0, depth], isotropic(young, 1e3, nu), force);
        let [sheared, bent, stretched] = energies(&model).map(Option::unwrap);
        let known = [force * force / (2.0 * shear), force * force / (6.0 * bending)];
        for (found, known) in [sheared, bent].into_iter().zip(known) {
            assert!((found / known - 1.0).abs() < 1e-6, "{elements}: {found:e} {known:e}");
        }
        assert!(stretched < 1e-6 * bent, "{stretched:e}");
    }
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let arm = b.beam(beam("arm", [0.0, 0.0], [1.0, 0.0], 2, material, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    assert_eq!(energies(&b.build().unwrap())[0], None);
}

#[test]
fn a_deep_cantilever_bends_far_as_nachbagauer_found() {
    // Nachbagauer, Pechstein, Irschik, Gerstmayr 2011: L 2, h 0.5, b 0.1; own computation to ten digits.
    let tip = |elements: usize| {
        let material = isotropic(2.07e11, 7850.0, 0.3);
        let model = cantilever(elements, [2.0, 0.1, 0.5], material, -6.25e7);
        equilibrium(&model).unwrap().points[0].1
    };
    let [coarse, fine] = [tip(16), tip(32)];
    for (i, exact) in [-0.1509711442, -0.7105685979].into_iter().enumerate() {
        let errors = [coarse[i] - exact, fine[i] - exact];
        let ratio = errors[0] / errors[1];
        assert!((3.8..4.2).contains(&ratio), "not of second order: {errors:?}");
        let limit = (4.0 * fine[i] - coarse[i]) / 3.0;
        assert!((limit - exact).abs() < 2e-6, "{limit}");
    }
}

#[test]
fn a_quarter_of_a_circle_deflects_as_its_forces_require() {
    // Castigliano, R = 1, of the height 1/10: a small force across the free end, along the radius at the clamp.
    let (depth, nu, force) = (0.1, 0.25, 1e-5);
    let young = 12.0 / f64::powi(depth, 3);
    let kappa = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
    let (bending, axial) = (1.0, young * depth);
    let shear = kappa * axial / (2.0 * (1.0 + nu));
    let quarter = std::f64::consts::FRAC_PI_4;
    let exact = [
        0.5 * force * (1.0 / bending - 1.0 / axial + 1.0 / shear),
        -force * ((3.0 * quarter - 2.0) / bending + quarter * (1.0 / shear + 1.0 / axial)),
    ];
    for (elements, tolerance) in [(4, 3e-3), (8, 3e-4)] {
        let mut b = ModelBuilder::new();
        let material = b.material(isotropic(young, 1.0, nu));
        let section = b.section(Section::rectangle("s", 1.0, depth));
        let points = [0.0, quarter, 2.0 * quarter].map(|a| [a.sin(), 1.0 - a.cos()]);
        let arc =
            Beam { curve: Curve::Arc, ..Beam::new("arc", &points, elements, material, section) };
        let arc = b.beam(Beam { theory: Theory::Shear, ..arc });
        b.support(Support::new("root", at("root", arc, 0.0), SupportKind::Clamp));
        let tip = at("tip", arc, 1.0);
        let kind =
            LoadKind::Point { at: tip.clone(), force: [0.0, -force], moment: 0.0, follower: false };
        b.load(Load::new("tip", kind));
        b.record_point(tip);
        let found = equilibrium(&b.build().unwrap()).unwrap().points[0].1;
        for (found, exact) in found.into_iter().zip(exact) {
            assert!((found / exact - 1.0).abs() < tolerance, "{elements}: {found:e} {exact:e}");
        }
    }
}

#[test]
fn frequencies_of_a_deep_beam_are_those_of_timoshenko() {
    // NAFEMS FV5, exact for kappa = 10 (1 + nu) / (12 + 11 nu); between the second and the third of bending lies an axial mode.
    let found = |elements: usize| {
        let mut b = ModelBuilder::new();
        let material = b.material(isotropic(2e11, 8000.0, 0.3));
        let section = b.section(Section::rectangle("s", 2.0, 2.0));
        let arm = b.beam(shear(10.0, elements, material, section));
        for (name, f) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, arm, f), SupportKind::Pin));
        }
        natural_frequencies(&b.build().unwrap(), 4)
    };
    let (coarse, fine) = (found(16), found(32));
    for (k, exact) in [(0, 42.64490922), (1, 148.14933502), (3, 283.46838913)] {
        let ratio = (coarse[k] - exact) / (fine[k] - exact);
        assert!((14.5..17.0).contains(&ratio), "{k}: not of fourth order, {ratio}");
        assert!((fine[k] / exact - 1.0).abs() < 1e-6, "{k}: {}", fine[k]);
    }
}

/// A few elements have hardly more motions than modes are asked for: what a subspace contains beyond them is round-off, and no mode. A small
/// pressure that follows the beam leaves its frequencies, and it is stable.
#[test]
fn small_structures_under_following_pressure_have_no_modes_of_round_off() {
    let cantilever = |elements: usize, pressure: f64| {
        let mut b = ModelBuilder::new();
        let material = b.material(isotropic(1e10, 2e3, 0.25));
        let section = b.section(Section::rectangle("s", 0.1, 0.2));
        let arm = b.beam(shear(2.0, elements, material, section));
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        if pressure > 0.0 {
            let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
            let force = [[0.0, -pressure]; 2];
            let kind = LoadKind::Distributed { beam: arm, stretch, force, follower: true };
            b.load(Load::new("pressure", kind));
        }
        b.build().unwrap()
    };
    for elements in 3..=12 {
        let model = cantilever(elements, 1.0);
        let found = equilibrium(&model).unwrap();
        assert!(found.stable, "{elements}");
        let modes = modes_about(&model, &found.state, 8);
        let free = natural_frequencies(&cantilever(elements, 0.0), 8);
        assert_eq!(modes.len(), free.len(), "{elements}");
        for (mode, free) in modes.iter().zip(free) {
            assert_eq!(mode.kind(), ModeKind::Vibration, "{elements}: {mode:?}");
            // The pressure is 1e-6 of the bending stiffness.
            assert!((mode.frequency() / free - 1.0).abs() < 1e-5, "{elements}: {free}");
        }
        let stability = buckling(&model, 1).stability;
        let kept = matches!(stability, Some(FollowerStability::Kept { up_to }) if up_to > 1.0);
        assert!(kept, "{elements}: {stability:?}");
    }
}

/// A free beam that turns by half a radian a step, and vibrates.
fn tumbling() -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material { poisson: Some(0.2), ..Material::new("m", 400.0, 1.0) });
    let section = b.section(Section { shear_factor: Some(0.9), ..Section::new("s", 1.0, 0.01) });
    let arm = b.beam(shear(1.0, 6, material, section));
    b.point_mass(PointMass {
        name: "bob".into(),
        at: at("bob", arm, 0.7),
        mass: 0.2,
        rotary_inertia: 0.003,
    });
    b.initial_motion(InitialMotion { velocity: [1.0, 0.5], spin: 10.0, about: [0.3, 0.1] });
    b.build().unwrap()
}

#[test]
fn a_tumbling_beam_keeps_energy_and_momenta_and_its_vectors_their_length() {
    let model = tumbling();
    let settings = Settings::new(30.0, 0.05);
    let summary = run(&model, &settings);
    assert!(worst(&summary) < 1e-11, "{:e}", worst(&summary));
    let mut simulation = Simulation::new(&model, &settings).unwrap();
    let mut strained = 0.0_f64;
    while simulation.state().step < simulation.step_count() {
        simulation.advance(&mut NoRecorder).unwrap();
        for u in &simulation.state().displacement {
            let length = (1.0 + u[2]).hypot(u[3]);
            assert!((length - 1.0).abs() < 1e-12, "{:e}", length - 1.0);
        }
        let u = &simulation.state().displacement;
        let last = u[u.len() - 1];
        strained = strained.max(((1.0 + last[0] - u[0][0]).hypot(last[1] - u[0][1]) - 1.0).abs());
    }
    assert!(strained > 0.01, "the beam is rigid: {strained:e}");
}

#[test]
fn balances_hold_over_many_steps() {
    let steps = if whole() { 100_000 } else { 5_000 };
    let summary = run(&tumbling(), &Settings::new(0.05 * f64::from(steps), 0.05));
    assert!(worst(&summary) < 1e-10, "{:e}", worst(&summary));
}

#[test]
fn what_strikes_or_presses_a_shear_flexible_beam_balances() {
    for restitution in [None, Some(0.0), Some(0.6)] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material { retardation: 1e-5, ..isotropic(2e9, 3e3, 0.3) });
        let section = b.section(Section::rectangle("s", 0.2, 0.5));
        let arm = b.beam(shear(3.0, 12, material, section));
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        b.support(Support::new(
            "end",
            at("end", arm, 1.0),
            SupportKind::Roller { direction: [1.0, 0.0] },
        ));
        let strikes = at("struck", arm, 0.43);
        b.projectile(match restitution {
            None => elastic("mass", strikes, [0.0, -20.0]),
            Some(e) => rigid("mass", strikes, [0.0, -20.0], e),
        });
        let model = b.build().unwrap();
        let summary = run(&model, &Settings::new(0.05, 5e-5));
        assert!(worst(&summary) < 1e-10, "{restitution:?}: {:e}", worst(&summary));
        assert!(summary.projectiles[0].velocity_final[1] > -19.9, "nothing was struck");
        assert!(summary.energy.loss_damping > 0.0);
    }
}

/// Springs without effect take the unit lengths of their nodes out of the band.
#[test]
fn unit_lengths_inside_and_outside_the_band_give_the_same_motion() {
    let struck = |tied: &[u32]| {
        let mut b = ModelBuilder::new();
        let material = b.material(isotropic(2e9, 3e3, 0.3));
        let section = b.section(Section::rectangle("s", 0.2, 0.5));
        let arm = b.beam(shear(3.0, 8, material, section));
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        for k in tied {
            let ends = [at("node", arm, f64::from(*k) / 8.0), at("tip", arm, 1.0)];
            b.spring(Spring {
                name: format!("spring-{k}"),
                between: ends.map(Anchor::Point),
                law: SpringLaw::Linear { stiffness: 1e-9 },
                damping: 0.0,
                length: None,
                strength: None,
                yielding: None,
            });
        }
        b.projectile(elastic("mass", at("struck", arm, 0.43), [0.0, -20.0]));
        let summary = run(&b.build().unwrap(), &Settings::new(0.05, 5e-5));
        assert!(worst(&summary) < 1e-12, "{tied:?}: {:e}", worst(&summary));
        let velocity = summary.projectiles[0].velocity_final[1];
        [velocity, summary.momentum.linear_scale, summary.momentum.angular_scale]
    };
    let inside = struck(&[]);
    assert!(inside[0] > -19.9, "nothing was struck");
    for tied in [&[3][..], &[1, 2, 3, 4, 5, 6, 7]] {
        for (found, expected) in struck(tied).into_iter().zip(inside) {
            assert!((found / expected - 1.0).abs() < 1e-9, "{tied:?}: {found} {expected}");
        }
    }
}

#[test]
fn a_disc_rolls_on_the_face_of_a_shear_flexible_beam() {
    let mut b = ModelBuilder::new();
    let material = b.material(isotropic(2e9, 3e3, 0.3));
    let section = b.section(Section::rectangle("s", 0.2, 0.4));
    let arm = b.beam(shear(3.0, 10, material, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let ball = b.disc(disc("ball", 50.0, 0.1, [2.0, 0.31], [4.0, -3.0]));
    b.contact(Contact {
        name: "ball".into(),
        between: [ContactPartner::Disc(ball), ContactPartner::Beam(arm)],
        law: TouchLaw::Rigid(RigidLaw { friction: 0.3, ..RigidLaw::frictionless(0.5) }),
        points_per_element: 2,
    });
    let summary = run(&b.build().unwrap(), &Settings::new(0.05, 1e-4));
    assert!(worst(&summary) < 1e-10, "{:e}", worst(&summary));
    assert!(summary.projectiles[0].velocity_final[1] > -2.9, "nothing was touched");
}

#[test]
fn corners_between_shear_flexible_and_slender_beams_are_rigid() {
    let mut b = ModelBuilder::new();
    let material = b.material(isotropic(2e9, 3e3, 0.3));
    let section = b.section(Section::rectangle("s", 0.1, 0.3));
    let column = Beam {
        theory: Theory::Shear,
        ..beam("column", [0.0, 0.0], [0.0, 3.0], 5, material, section)
    };
    let column = b.beam(column);
    let girder = b.beam(beam("girder", [0.0, 3.0], [2.0, 4.0], 4, material, section));
    b.support(Support::new("foot", at("column.start", column, 0.0), SupportKind::Clamp));
    let between = [at("column.end", column, 1.0), at("girder.start", girder, 0.0)];
    b.joint(Joint::new("knee", JointKind::Rigid, between));
    b.projectile(elastic("mass", at("girder@0.6", girder, 0.6), [0.0, -20.0]));
    let model = b.build().unwrap();
    let summary = run(&model, &Settings::new(0.2, 5e-4));
    assert!(worst(&summary) < 1e-10, "{:e}", worst(&summary));
    let mut simulation = Simulation::new(&model, &Settings::new(0.2, 5e-4)).unwrap();
    let reference = 1.0_f64.atan2(2.0) - std::f64::consts::FRAC_PI_2;
    let mut turned = 0.0_f64;
    while simulation.state().step < simulation.step_count() {
        simulation.advance(&mut NoRecorder).unwrap();
        let u = &simulation.state().displacement;
        let size = 5.0_f64.sqrt();
        let (a, b) = ([u[5][2], 1.0 + u[5][3]], [2.0 / size + u[6][2], 1.0 / size + u[6][3]]);
        let angle = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
        assert!((angle - reference).abs() < 1e-12, "{:e}", angle - reference);
        turned = turned.max(a[0].atan2(a[1]).abs());
    }
    assert!(turned > 1e-3, "the corner turned by {turned} only");
}

#[test]
fn the_force_after_a_rigid_impact_has_a_limit() {
    // The section of the paper's second example, with shear: velocity of the mass by Laplace inversion.
    let exact = [(5.0, 34.8562072), (10.0, 30.570388), (20.0, 24.5604188)];
    let errors = |elements: usize, step: f64| {
        let mut b = ModelBuilder::new();
        let material = b.material(isotropic(2e11, 3e3, 0.3));
        let section = Section { shear_factor: Some(5.0 / 6.0), ..Section::new("s", 0.1, 8.33e-5) };
        let section = b.section(section);
        let arm = b.beam(shear(3.0, elements, material, section));
        for (name, f) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, arm, f), SupportKind::Clamp));
        }
        // It touches after one step and a half.
        let mass = rigid("mass", at("struck", arm, 0.5), [0.0, -40.0], 0.0);
        b.projectile(Projectile { standoff: 60.0 * step, ..mass });
        let model = b.build().unwrap();
        let mut simulation = Simulation::new(&model, &Settings::new(22e-6, step)).unwrap();
        let mut places = vec![0.0];
        while simulation.state().step < simulation.step_count() {
            simulation.advance(&mut NoRecorder).unwrap();
            let place = simulation.state().projectile(&model, 0).unwrap().position[1];
            if simulation.state().offset == 0.0 {
                places.push(place);
            }
        }
        exact.map(|(microseconds, velocity)| {
            let k = (microseconds * 1e-6 / step).round() as usize + 1;
            (places[k] - places[k + 1]) / step / velocity - 1.0
        })
    };
    let (coarse, fine) = (errors(300, 2e-7), errors(600, 1e-7));
    for k in 0..3 {
        assert!(coarse[k].abs() < 2e-3 && fine[k].abs() < 8e-4, "{coarse:?} {fine:?}");
    }
}

/// Paths of the faults of a beam with the given parts.
fn faults(
    material: Material,
    section: Section,
    change: impl Fn(&mut ModelBuilder, BeamId),
) -> Vec<String> {
    let mut b = ModelBuilder::new();
    let (material, section) = (b.material(material), b.section(section));
    let arm = b.beam(shear(1.0, 2, material, section));
    change(&mut b, arm);
    match b.build() {
        Ok(_) => Vec::new(),
        Err(faults) => faults.into_iter().map(|fault| fault.path).collect(),
    }
}

#[test]
fn shear_flexible_beams_need_shear_stiffness_and_rotary_inertia() {
    let bar = || Section::rectangle("s", 0.1, 0.2);
    let steel = || isotropic(2e11, 7850.0, 0.3);
    let none = |_: &mut ModelBuilder, _: BeamId| {};
    assert!(faults(steel(), bar(), none).is_empty());
    assert_eq!(faults(Material::new("m", 2e11, 7850.0), bar(), none), ["material.m.poisson"]);
    assert_eq!(faults(isotropic(2e11, 7850.0, 0.6), bar(), none), ["material.m.poisson"]);
    let bare = Section::new("s", 0.01, 1e-5);
    assert_eq!(faults(steel(), bare.clone(), none), ["section.s.shear_factor"]);
    assert!(faults(steel(), Section { shear_factor: Some(0.8), ..bare }, none).is_empty());
    let still = Section { rotary_inertia: RotaryInertia::Neglected, ..bar() };
    assert_eq!(faults(steel(), still, none), ["section.s.rotary_inertia"]);
    let slack =
        Material { inelasticity: Some(Inelasticity::OneSided(Slack::Compression)), ..steel() };
    assert!(faults(slack, bar(), none).is_empty());
    let stretch = |b: &mut ModelBuilder, arm: BeamId| {
        let kind = SupportKind::Fix { components: vec![Component::Stretch] };
        b.support(Support::new("end", at("end", arm, 1.0), kind));
    };
    assert_eq!(faults(steel(), bar(), stretch), ["support.end.components"]);
}

#[test]
fn other_schemes_refuse_shear_flexible_beams() {
    let model = tumbling();
    for scheme in [Scheme::StrainRate, Scheme::Midpoint, Scheme::Newmark] {
        let settings = Settings { scheme, ..Settings::new(1.0, 0.05) };
        let faults = Simulation::new(&model, &settings).err().unwrap();
        assert!(faults.iter().any(|f| f.path == "integrator.scheme"), "{faults:?}");
    }
}

#[test]
fn slender_shear_flexible_beams_move_as_slender_ones() {
    // L/h = 100: rotary inertia and shear change the first frequency by some 1e-4.
    let first = |theory: Theory, elements: usize| {
        let mut b = ModelBuilder::new();
        let material = b.material(isotropic(2e11, 7850.0, 0.3));
        let section = b.section(Section::rectangle("s", 0.01, 0.01));
        let arm = b.beam(Beam { theory, ..shear(1.0, elements, material, section) });
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        natural_frequencies(&b.build().unwrap(), 1)[0]
    };
    let (slender, shear) = (first(Theory::Slender, 16), first(Theory::Shear, 64));
    assert!((shear / slender - 1.0).abs() < 5e-4, "{slender} {shear}");
}
