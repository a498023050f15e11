//! Shear-flexible beams under axial forces of either sign, long and short elements.

use super::*;

/// A rod between a pin and a roller, with a force along it at the roller.
fn pulled(elements: usize, [length, depth]: [f64; 2], material: Material, force: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(material);
    let section = b.section(Section::rectangle("s", depth, depth));
    let rod = b.beam(shear(length, elements, material, section));
    b.support(Support::new("pin", at("pin", rod, 0.0), SupportKind::Pin));
    let roller = SupportKind::Roller { direction: [1.0, 0.0] };
    b.support(Support::new("roller", at("roller", rod, 1.0), roller));
    let (force, moment) = ([force, 0.0], 0.0);
    let kind = LoadKind::Point { at: at("end", rod, 1.0), force, moment, follower: false };
    b.load(Load::new("pull", kind));
    b.record_point(at("middle", rod, 0.5));
    b.build().unwrap()
}

fn steel() -> Material {
    Material { strain: StrainMeasure::Engineering, ..isotropic(2.1e11, 7850.0, 0.3) }
}

/// Sections of an element turn neither by themselves nor with their neighbours: `N l^2` is up to 1000 times `12 EI` here.
#[test]
fn tension_is_stable_in_elements_of_any_slenderness() {
    for depth in [0.2, 0.012, 5e-4] {
        for elements in [1, 3, 8] {
            let force = 235e6 * depth * depth;
            let model = pulled(elements, [4.0, depth], steel(), force);
            let found = equilibrium(&model).unwrap();
            assert!(found.stable, "{depth} {elements}");
            let linear = buckling(&model, 1);
            assert!(linear.modes.is_empty(), "{depth} {elements}: {:?}", linear.modes[0].factor);
        }
    }
}

/// Frequencies of a pinned rod under an axial force, `w = W sin q s`, `theta = T cos q s`, by the theory of Reissner, whose axial force is along the
/// normal of the section: the roots of `det [(S - N) q^2 + N q^2 - rhoA w^2, -(S - N) q; -(S - N) q, EI q^2 + S - N - rhoI w^2]`.
fn frequency(q: f64, [shear, bending, axial]: [f64; 3], [mass, rotary]: [f64; 2]) -> f64 {
    let [a, b, c] = [shear * q * q, (shear - axial) * q, bending * q * q + shear - axial];
    let (first, half) = (mass * rotary, 0.5 * (a * rotary + c * mass));
    let root = (a * c - b * b) / (half + (half * half - first * (a * c - b * b)).sqrt());
    root.sqrt() / std::f64::consts::TAU
}

#[test]
fn frequencies_of_a_tensioned_rod_are_of_fourth_order() {
    let (length, young, nu) = (1.0, 2e11, 0.25);
    for (depth, axial_of_bending) in [(1e-4, 1000.0), (1e-3, 10.0), (0.1, 0.01), (0.1, -0.01)] {
        let area = depth * depth;
        let bending = young * area * area / 12.0;
        let shear = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu) * young / (2.0 * (1.0 + nu)) * area;
        let axial = axial_of_bending * bending / (length * length);
        let inertia = [8e3 * area, 8e3 * area * area / 12.0];
        let found = |elements: usize| {
            let model = pulled(elements, [length, depth], isotropic(young, 8e3, nu), axial);
            let found = equilibrium(&model).unwrap();
            modes_about(&model, &found.state, 2)
        };
        let (coarse, fine) = (found(8), found(16));
        for k in 0..2 {
            let q = (k + 1) as f64 * std::f64::consts::PI / length;
            let exact = frequency(q, [shear, bending, axial], inertia);
            // The stretch, up to 1e-5, is not in the closed form.
            let errors = [&coarse, &fine].map(|m| m[k].frequency() / exact - 1.0);
            let bound = if k == 0 { 5e-5 } else { 8e-4 };
            assert!(errors[0].abs() < bound, "{depth} {k}: {errors:?}");
            assert!(errors[1].abs() < bound / 12.0 + 2e-5, "{depth} {k}: {errors:?}");
        }
    }
}

/// `P = S/2 (sqrt(1 + 4 EI q^2 / S) - 1)`: the load at which a pinned column buckles where the axial force is along the normal of the section (Haringx
/// 1948). Of slender columns, whose load is Euler's, the error is of fourth order, where shear matters of second.
#[test]
fn columns_buckle_at_the_load_of_haringx() {
    let (young, nu, length) = (2e9, 0.25, 1.0);
    for (depth, bound, order) in [(0.3, 2.5e-3, 2), (1e-3, 5e-5, 4)] {
        let area = depth * depth;
        let bending = young * area * area / 12.0;
        let shear = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu) * young / (2.0 * (1.0 + nu)) * area;
        let q = std::f64::consts::PI / length;
        let exact = 0.5 * shear * ((1.0 + 4.0 * bending * q * q / shear).sqrt() - 1.0);
        let error = |elements: usize| {
            let model = pulled(elements, [length, depth], isotropic(young, 1e3, nu), -exact);
            buckling(&model, 1).modes[0].factor - 1.0
        };
        let (coarse, fine) = (error(4), error(8));
        assert!(fine.abs() < bound, "{depth}: {coarse:e} {fine:e}");
        let falls = coarse / fine / f64::powi(2.0, order);
        assert!((0.9..1.1).contains(&falls), "{depth}: {coarse:e} {fine:e}");
    }
}

/// A thin rod that whirls about one end, whose centrifugal force exceeds `12 EI / l^2` many times, in steps of a third of a radian.
#[test]
fn balances_hold_under_tension_over_many_steps() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material { poisson: Some(0.2), ..Material::new("m", 4e3, 1.0) });
    let section = b.section(Section { shear_factor: Some(0.9), ..Section::new("s", 1.0, 1e-6) });
    let arm = b.beam(shear(1.0, 6, material, section));
    b.support(Support::new("hub", at("hub", arm, 0.0), SupportKind::Pin));
    b.initial_motion(InitialMotion { velocity: [0.0; 2], spin: 6.0, about: [0.0; 2] });
    let model = b.build().unwrap();
    let summary = run(&model, &Settings::new(if whole() { 2000.0 } else { 100.0 }, 0.05));
    assert!(worst(&summary) < 1e-10, "{:e}", worst(&summary));
    let axial = summary.section_forces[0].axial.max.value;
    assert!(axial > 10.0 * 12.0 * 4e-3 * 36.0, "{axial}");
}
