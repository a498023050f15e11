//! Shear-flexible beams at rest: deflections, section forces and strain energies of closed forms.

use super::*;

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

/// `EI = 1 - 0.9 s/L` of a cantilever so slender that shear has no share: `w = F int x^2 / EI`, x from the tip, and its frequencies, those of the slender
/// theory.
#[test]
fn beams_that_taper_bend_and_swing_as_the_slender_theory_says() {
    let build = |theory: Theory, elements: usize| {
        let mut b = ModelBuilder::new();
        let material = b.material(isotropic(1e9, 1e3, 0.25));
        let at_share = |at: f64, inertia: f64| Station {
            at,
            area: 1e-2 * (1.0 - 0.5 * at),
            inertia,
            depth: None,
            profile: Profile::Unknown,
            properties: StationProperties { shear_factor: Some(0.8), ..Default::default() },
        };
        let stations = vec![at_share(0.0, 1e-9), at_share(1.0, 1e-10)];
        let section = b.section(Section { stations, ..Section::new("s", 1e-2, 1e-9) });
        let slender = beam("arm", [0.0, 0.0], [1.0, 0.0], elements, material, section);
        let arm = b.beam(Beam { theory, ..slender });
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        let (point, force) = (at("tip", arm, 1.0), [0.0, 1e-3]);
        let kind = LoadKind::Point { at: point.clone(), force, moment: 0.0, follower: false };
        b.load(Load::new("tip", kind));
        b.record_point(point);
        b.build().unwrap()
    };
    let n = 20_000;
    let integrand = |k: usize| {
        let s = (k as f64 + 0.5) / n as f64;
        (1.0 - s).powi(2) / (1.0 - 0.9 * s) / n as f64
    };
    let tip: f64 = 1e-3 * (0..n).map(integrand).sum::<f64>();
    let swings = |model: &Model| {
        let about = reference_state(model).unwrap();
        modes_about(model, &about, 3).iter().map(|mode| mode.frequency()).collect::<Vec<_>>()
    };
    let exact = swings(&build(Theory::Slender, 64));
    for (elements, bound) in [(4, 2e-3), (8, 2e-4)] {
        let model = build(Theory::Shear, elements);
        let [_, y] = equilibrium(&model).unwrap().points[0].1;
        assert!((y / tip - 1.0).abs() < bound, "{elements}: {y:e} {tip:e}");
        for (found, exact) in swings(&model).into_iter().zip(&exact) {
            assert!((found / exact - 1.0).abs() < 10.0 * bound, "{elements}: {found} {exact}");
        }
    }
}
