//! The field inside the elements of shear-flexible beams: points, loads, given strains, foundations.

use super::*;

const YOUNG: f64 = 2.1e11;
const NU: f64 = 0.3;

/// Width, depth: EI and kappa G A.
fn stiffness([width, depth]: [f64; 2]) -> [f64; 2] {
    let kappa = 10.0 * (1.0 + NU) / (12.0 + 11.0 * NU);
    let shear = kappa * YOUNG / (2.0 * (1.0 + NU)) * width * depth;
    [YOUNG * width * depth.powi(3) / 12.0, shear]
}

fn steel() -> Material {
    Material {
        strain: StrainMeasure::Engineering,
        expansion: 1.2e-5,
        ..isotropic(YOUNG, 7800.0, NU)
    }
}

/// A cantilever of 0.1 m by 0.4 m along a direction, with points at arc lengths.
fn cantilever(
    elements: usize,
    [length, direction]: [f64; 2],
    places: &[f64],
    load: impl Fn(BeamId) -> LoadKind,
) -> Equilibrium {
    let mut b = ModelBuilder::new();
    let material = b.material(steel());
    let section = b.section(Section::rectangle("s", 0.1, 0.4));
    let tip = [length * direction.cos(), length * direction.sin()];
    let slender = beam("arm", [0.0; 2], tip, elements, material, section);
    let arm = b.beam(Beam { theory: Theory::Shear, ..slender });
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    b.load(Load::new("load", load(arm)));
    for s in places {
        b.record_point(at(&format!("at {s}"), arm, s / length));
    }
    equilibrium(&b.build().unwrap()).unwrap()
}

/// Displacement and rotation at any place are exact, on any mesh.
#[test]
fn points_inside_elements_move_as_in_the_theory() {
    let ([bending, shear], length) = (stiffness([0.1, 0.4]), 1.3);
    let (force, places) = (10.0, [0.05, 0.3, 0.97, 1.3]);
    for direction in [0.0, 0.7] {
        let (sine, cosine) = f64::sin_cos(direction);
        for elements in [1, 4, 16] {
            let found = cantilever(elements, [length, direction], &places, |arm| LoadKind::Point {
                at: at("tip", arm, 1.0),
                force: [force * (cosine + sine), force * (sine - cosine)],
                moment: 0.0,
                follower: false,
            });
            for (k, s) in places.into_iter().enumerate() {
                let turn = -force * (length * s - 0.5 * s * s) / bending;
                let across = -force * (s * s * (3.0 * length - s) / (6.0 * bending) + s / shear);
                let [x, y] = found.points[k].1;
                let deflection = y * cosine - x * sine;
                let along = force * s / (YOUNG * 0.1 * 0.4);
                let stretched = x * cosine + y * sine;
                // It is shortened by its inclination.
                assert!((stretched / along - 1.0).abs() < 1e-5, "{elements} {s}: {stretched:e}");
                assert!((found.rotations[k] / turn - 1.0).abs() < 1e-6, "{elements} {s}");
                assert!((deflection / across - 1.0).abs() < 1e-6, "{elements} {s}: {deflection:e}");
            }
        }
    }
}

/// `q0 L^4/30EI + q0 L^2/6S` of a load that falls from q0 at the root to zero, and the section forces beside it.
#[test]
fn nodes_are_exact_for_loads_that_are_linear() {
    let ([bending, shear], length, most) = (stiffness([0.1, 0.4]), 1.3, -7.5e3);
    for elements in [1, 2, 5] {
        let found = cantilever(elements, [length, 0.0], &[length], |beam| {
            let stretch = [0.0, 1.0].map(Along::Fraction);
            let force = [[0.0, most], [0.0, 0.0]];
            LoadKind::Distributed { beam, stretch, force, follower: false }
        });
        let exact = most * (length.powi(4) / (30.0 * bending) + length.powi(2) / (6.0 * shear));
        let [_, y] = found.points[0].1;
        assert!((y / exact - 1.0).abs() < 1e-6, "{elements}: {y:e} {exact:e}");
        // V = -q0 (L - s)^2 / 2L at all ends of elements, N nearly zero.
        let size = 0.5 * most * length;
        for (k, [from, to]) in found.element_forces.iter().enumerate() {
            for (at, forces) in [(k, from), (k + 1, to)] {
                let left = 1.0 - at as f64 / elements as f64;
                let exact = -size * left * left;
                assert!((forces[1] - exact).abs() < 1e-6 * size.abs(), "{elements} {at}");
            }
        }
        let least = found.section_forces[0].shear.min.value;
        assert!(least > -1e-6 * size.abs(), "{elements}: {least}");
    }
}

/// A curvature without force, of a full turn along the beam, closes it to a circle.
#[test]
fn a_given_curvature_coils_a_beam_to_a_circle() {
    for (elements, bound) in [(8, 1e-2), (16, 2e-4), (64, 1e-7)] {
        let mut b = ModelBuilder::new();
        let material = b.material(steel());
        let section = b.section(Section::rectangle("s", 0.05, 0.05));
        let arm = b.beam(shear(2.0, elements, material, section));
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        let whole = [0.0, 1.0].map(Along::Fraction);
        let (strain, curvature) = (0.0, std::f64::consts::PI);
        b.load(Load::new("set", LoadKind::Strain { beam: arm, stretch: whole, strain, curvature }));
        b.record_point(at("end", arm, 1.0));
        let found = equilibrium(&b.build().unwrap()).unwrap();
        let turn = found.rotations[0] / std::f64::consts::TAU - 1.0;
        assert!(turn.abs() < bound, "{elements}: {turn:e}");
        let [x, y] = found.points[0].1;
        assert!((x + 2.0).hypot(y) < 4.0 * bound, "{elements}: {x} {y}");
    }
}

/// A semicircle between pins: the thrust of a uniform heat, `alpha T 2 R / int (m^2/EI + n^2/EA + v^2/S)`, m, n and v by a unit thrust; without pins its
/// free end moves as one that is larger by the expansion.
#[test]
fn curved_beams_expand_evenly() {
    let (radius, [width, depth], change) = (1.0, [0.05, 0.02], 20.0);
    let expansion = 1.2e-5 * change;
    let heated = |elements: usize, supports: &[(f64, SupportKind)]| {
        let mut b = ModelBuilder::new();
        let material = b.material(steel());
        let section = b.section(Section::rectangle("s", width, depth));
        let points = [[-radius, 0.0], [0.0, radius], [radius, 0.0]];
        let arch = Beam {
            curve: Curve::Arc,
            theory: Theory::Shear,
            ..Beam::new("arch", &points, elements, material, section)
        };
        let arch = b.beam(arch);
        for (place, kind) in supports {
            let name = format!("at {place}");
            b.support(Support::new(&name, at(&name, arch, *place), kind.clone()));
        }
        let whole = [0.0, 1.0].map(Along::Fraction);
        let kind = LoadKind::Temperature { beam: arch, stretch: whole, change, gradient: 0.0 };
        b.load(Load::new("heat", kind));
        b.record_point(at("end", arch, 1.0));
        equilibrium(&b.build().unwrap()).unwrap()
    };
    let [bending, shear] = stiffness([width, depth]);
    let half_turn = 0.5 * std::f64::consts::PI * radius;
    let softness =
        half_turn * (radius * radius / bending + 1.0 / (YOUNG * width * depth) + 1.0 / shear);
    let thrust = expansion * 2.0 * radius / softness;
    for elements in [8, 16, 32] {
        let pins = [(0.0, SupportKind::Pin), (1.0, SupportKind::Pin)];
        let found = heated(elements, &pins).reactions[0].1[0];
        // Thickness of the arch in its deflections, of the order of the expansion: the linear theory is exact to 1e-3.
        assert!((found / thrust - 1.0).abs() < 2e-3, "{elements}: {found} {thrust}");
        let free = heated(elements, &[(0.0, SupportKind::Clamp)]);
        let [x, y] = free.points[0].1;
        assert!((x / (2.0 * radius * expansion) - 1.0).abs() < 1e-8, "{elements}: {x:e}");
        assert!(y.abs() < 1e-8 * x, "{elements}: {y:e}");
    }
}

/// Timoshenko's beam of finite length on Winkler's foundation under a force in its middle.
#[test]
fn deflections_on_a_foundation_are_of_fourth_order() {
    let (young, depth, stiffness, force, length) = (3e10, 1.0, 2e8, -1e5, 10.0);
    let deflection = |elements: usize, law: FoundationLaw| {
        let mut b = ModelBuilder::new();
        let material = b.material(isotropic(young, 2500.0, 0.2));
        let section = b.section(Section::rectangle("s", 1.0, depth));
        let strip = b.beam(shear(length, elements, material, section));
        b.foundation(Foundation {
            name: "ground".into(),
            beam: strip,
            stretch: [0.0, 1.0].map(Along::Fraction),
            direction: None,
            law,
            damping: 0.0,
            yielding: None,
        });
        let held = SupportKind::Fix { components: vec![Component::Displacement1] };
        b.support(Support::new("held", at("mid", strip, 0.5), held));
        let (place, moment) = (at("mid", strip, 0.5), 0.0);
        let kind = LoadKind::Point { at: place, force: [0.0, force], moment, follower: false };
        b.load(Load::new("force", kind));
        b.record_point(at("mid", strip, 0.5));
        equilibrium(&b.build().unwrap()).unwrap().points[0].1[1]
    };
    // EI w'''' - (EI k / S) w'' + k w = 0, shear force P/2 beside the force; free ends.
    let exact = -1.062_416_670_55e-4;
    let linear = FoundationLaw::Linear { stiffness };
    let errors = [8, 16, 32].map(|n| deflection(n, linear.clone()) / exact - 1.0);
    assert!(errors[0].abs() < 2e-4 && errors[1].abs() < 1.5e-5, "{errors:?}");
    assert!(errors[2].abs() < 1.2e-6, "{errors:?}");
    // The same law by a table of it, which is in series with the shear inside elements, too.
    let (w, p) = (1e-2, 1e-2 * stiffness);
    let table = FoundationLaw::Table { deflection: vec![-w, 0.0, w], reaction: vec![-p, 0.0, p] };
    let (a, b) = (deflection(16, table), deflection(16, linear));
    assert!((a / b - 1.0).abs() < 1e-7, "{a:e} {b:e}");
}
