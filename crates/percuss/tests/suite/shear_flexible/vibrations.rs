//! Natural frequencies of shear-flexible beams.

use super::*;

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
