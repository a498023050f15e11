//! The balance of a fibre in any step, slopes as derivatives, steady flow.

use super::*;

fn law(isotropic: f64, kinematic: f64, overstress: Option<Overstress>) -> StressLaw {
    StressLaw::Plastic(PlasticLaw {
        young: 200e9,
        slack: None,
        plasticity: Plasticity {
            curve: vec![Hardening { from: 0.0, stress: 250e6, modulus: isotropic }],
            kinematic,
            overstress,
            failure_strain: None,
        },
    })
}

/// Pseudo-random numbers from -1 to 1.
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// The largest error of the balance, relative to the current energies, and the least relative dissipation.
fn walk(law: &StressLaw, steps: usize, size: f64) -> (f64, f64) {
    let (mut state, mut strain, mut seed) = (FibreState::default(), 0.0, 7);
    let energy = |s: &FibreState, e: f64| law.elastic_energy(s, e) + law.hardening_energy(s);
    let (mut worst, mut least): (f64, f64) = (0.0, 0.0);
    for _ in 0..steps {
        let next = 0.02 * random(&mut seed) * if seed % 3 == 0 { size } else { 0.1 * size };
        let step = law.step(&state, strain, next, 1e-4);
        let change = energy(&step.state, next) - energy(&state, strain);
        let work = step.mean * (next - strain);
        // Relative to the energy at first yield and the stored energy, of which changes are differences.
        let scale = 250e6_f64.powi(2) / (2.0 * 200e9) + work.abs() + law.hardening_energy(&state);
        worst = worst.max((work - change - step.dissipated).abs() / scale);
        least = least.min(step.dissipated / scale);
        (state, strain) = (step.state, next);
    }
    (worst, least)
}

#[test]
fn work_is_what_is_stored_and_what_is_dissipated_for_any_step() {
    let rate = Some(Overstress { rate: 40.4, exponent: 5.0 });
    for law in [law(0.0, 0.0, None), law(2e9, 0.0, None), law(1e9, 3e9, None), table()] {
        let (worst, least) = walk(&law, 300_000, 1.0);
        assert!(worst < 1e-13 && least >= 0.0, "{law:?}: {worst:e}, {least:e}");
    }
    // Tables with rate: the flow is cut at their corners, however stiff it is.
    for rate in [
        Overstress { rate: 40.4, exponent: 5.0 },
        Overstress { rate: 1e6, exponent: 1.0 },
        Overstress { rate: 1e4, exponent: 2.5 },
    ] {
        for kinematic in [0.0, 3e9] {
            let law = viscous(steep(), kinematic, rate);
            let (worst, least) = walk(&law, 100_000, 1.0);
            assert!(worst < 1e-12 && least >= 0.0, "{law:?}: {worst:e}, {least:e}");
        }
    }
    // Also laws whose stress and relative stress differ in sign, or whose yield stress has grown to many times its initial value.
    for law in
        [law(0.0, 0.0, rate), law(0.0, 3e9, rate), law(0.0, 1e11, rate), law(5e10, 1e10, rate)]
    {
        let (worst, least) = walk(&law, 100_000, 1.0);
        assert!(worst < 1e-12 && least >= -1e-13, "{law:?}: {worst:e}, {least:e}");
    }
    for slack in [Slack::Tension, Slack::Compression] {
        let law = StressLaw::OneSided { young: 200e9, slack };
        let (worst, _) = walk(&law, 10_000, 1.0);
        assert!(worst < 1e-13, "{worst:e}");
        for law in [
            one_sided_of(slack, law_of(table())),
            one_sided_of(slack, law_of(self::law(0.0, 0.0, None))),
        ] {
            let (worst, least) = walk(&law, 100_000, 1.0);
            assert!(worst < 1e-13 && least >= 0.0, "{law:?}: {worst:e}, {least:e}");
        }
    }
}

/// A table that rises steeply, and then no more.
fn steep() -> Vec<Hardening> {
    let part = |from, stress, modulus| Hardening { from, stress, modulus };
    vec![part(0.0, 100e6, 1.4e12), part(0.5e-3, 800e6, 2e9), part(0.02, 839e6, 0.0)]
}

fn viscous(curve: Vec<Hardening>, kinematic: f64, rate: Overstress) -> StressLaw {
    let plastic = law_of(law(0.0, kinematic, Some(rate)));
    StressLaw::Plastic(PlasticLaw {
        plasticity: Plasticity { curve, ..plastic.plasticity },
        ..plastic
    })
}

/// A fibre strained by 0.02 in four steps, each across more than one corner, creates no energy and ends on the curve.
#[test]
fn viscous_flow_across_corners_of_a_table_dissipates() {
    let law = viscous(steep(), 0.0, Overstress { rate: 1e6, exponent: 1.0 });
    let (mut state, mut strain, mut taken) = (FibreState::default(), 0.0, 0.0);
    for _ in 0..4 {
        let step = law.step(&state, strain, strain + 0.005, 5e-3);
        assert!(step.dissipated > 0.0, "{step:?}");
        taken += step.dissipated;
        (state, strain) = (step.state, strain + 0.005);
    }
    // The first yield stress times the plastic strain is dissipated, whatever hardening stores; of the viscosity 1e-6 remains.
    let expected = 100e6 * state.accumulated;
    assert!((taken / expected - 1.0).abs() < 1e-4, "{taken:e} {expected:e}");
    let on_curve = 800e6 + 2e9 * (state.accumulated - 0.5e-3);
    assert!((law.stress(&state, strain) / on_curve - 1.0).abs() < 1e-4);
}

fn law_of(law: StressLaw) -> PlasticLaw {
    let StressLaw::Plastic(plastic) = law else { unreachable!() };
    plastic
}

fn one_sided_of(slack: Slack, law: PlasticLaw) -> StressLaw {
    StressLaw::Plastic(PlasticLaw { slack: Some(slack), ..law })
}

/// It yields in compression, opens at its plastic strain, and carries force again when the gap closes.
#[test]
fn a_gaping_fibre_closes_at_its_plastic_strain() {
    let law = one_sided_of(Slack::Tension, law_of(law(0.0, 0.0, None)));
    let mut state = FibreState::default();
    let mut strain = 0.0;
    // Yield at 1.25e-3: crushed to 1e-3 of plastic strain, gaping, closed again.
    for (to, stress, mean) in [
        (-2.25e-3, -250e6, -250e6 * (1.0 - 0.625 / 2.25)),
        (1e-3, 0.0, -250e6 * 0.625 / 3.25),
        (2e-3, 0.0, 0.0),
        (-1.5e-3, -100e6, -50e6 * 0.5 / 3.5),
        (-3e-3, -250e6, -(100e6 * 0.75 + 75e6 * 0.75 + 250e6 * 0.75) / 1.5),
    ] {
        let step = law.step(&state, strain, to, 1.0);
        assert!((step.stress - stress).abs() < 1.0, "{to}: {step:?}");
        assert!((law.stress(&step.state, to) - stress).abs() < 1.0, "{to}: {step:?}");
        assert!((step.mean - mean).abs() < 1.0, "{to}: {mean} {step:?}");
        (state, strain) = (step.state, to);
    }
    assert!((state.plastic + 1.75e-3).abs() < 1e-12, "{state:?}");
    assert!(!StressLaw::fails(&law, 1.0));
}

fn table() -> StressLaw {
    let part = |from, stress, modulus| Hardening { from, stress, modulus };
    let curve = vec![part(0.0, 250e6, 5e9), part(0.01, 300e6, 1e9), part(0.05, 340e6, 0.0)];
    let StressLaw::Plastic(plastic) = law(0.0, 0.0, None) else { unreachable!() };
    StressLaw::Plastic(PlasticLaw {
        plasticity: Plasticity { curve, ..plastic.plasticity },
        ..plastic
    })
}

#[test]
fn slopes_are_derivatives() {
    let rate = Some(Overstress { rate: 40.4, exponent: 5.0 });
    let gaping = one_sided_of(Slack::Tension, law_of(table()));
    let stiff = viscous(steep(), 1e9, Overstress { rate: 1e6, exponent: 1.0 });
    let slow = viscous(steep(), 0.0, Overstress { rate: 40.4, exponent: 5.0 });
    let laws = [law(2e9, 1e9, None), law(2e9, 1e9, rate), table(), gaping, stiff, slow];
    for (law, strained) in laws.iter().flat_map(|l| [0.0, 2e-3, -4e-3, 0.03].map(|e| (l, e))) {
        let start = law.step(&FibreState::default(), 0.0, strained, 1e-4).state;
        for to in [strained + 1e-4, strained + 7e-3, strained - 9e-3, 0.06] {
            let at = |e: f64| law.step(&start, strained, e, 1e-4);
            let d = 1e-8;
            let (a, b, here) = (at(to - d), at(to + d), at(to));
            let (mean, end) = ((b.mean - a.mean) / (2.0 * d), (b.stress - a.stress) / (2.0 * d));
            let near = |x: f64, y: f64| (x - y).abs() < 2e-5 * 200e9;
            assert!(near(mean, here.slope), "{law:?} {strained} {to}: {mean:e} {here:?}");
            assert!(near(end, here.tangent), "{law:?} {strained} {to}: {end:e} {here:?}");
        }
    }
}

#[test]
fn steady_flow_has_the_overstress_of_cowper_and_symonds() {
    let law = law(0.0, 0.0, Some(Overstress { rate: 40.4, exponent: 5.0 }));
    let (mut state, mut strain, h, rate) = (FibreState::default(), 0.0, 1e-5, 100.0);
    let mut stress = 0.0;
    for _ in 0..2000 {
        let step = law.step(&state, strain, strain + h * rate, h);
        (state, strain, stress) = (step.state, strain + h * rate, step.stress);
    }
    let expected = 250e6 * (1.0 + (rate / 40.4_f64).powf(0.2));
    assert!((stress / expected - 1.0).abs() < 1e-9, "{stress:e} {expected:e}");
}

/// Stress and viscous stress of a material of one sign keep it over any step, the viscosity never gives energy, and their slope is the derivative.
#[test]
fn viscosity_of_one_sign_of_stress_keeps_it() {
    let curve = vec![Hardening { from: 0.0, stress: 250e6, modulus: 1e9 }];
    let plasticity = Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain: None };
    for (slack, sign) in [(Slack::Tension, -1.0), (Slack::Compression, 1.0)] {
        let elastic = Inelasticity::OneSided(slack);
        let plastic = Inelasticity::OneSidedPlastic(slack, plasticity.clone());
        for law in [elastic, plastic].map(|own| StressLaw::new(200e9, Some(&own))) {
            let (mut state, mut strain, mut seed) = (FibreState::default(), 0.0, 11);
            for _ in 0..20_000 {
                let next = 4e-3 * random(&mut seed);
                let lag = 2.0 * random(&mut seed).abs();
                let sum = |next: f64| {
                    let found = law.step(&state, strain, next, 1e-4);
                    let own = [found.mean, found.slope];
                    let viscous = law.viscous(&state, [strain, next, next - strain], lag, own);
                    [own[0] + viscous[0], own[1] + viscous[1], viscous[0] * (next - strain)]
                };
                let [stress, slope, loss] = sum(next);
                assert!(stress * sign >= 0.0 && loss >= 0.0, "{law:?}: {strain} {next} {stress}");
                let e = 1e-9;
                let given = (sum(next + e)[0] - sum(next - e)[0]) / (2.0 * e);
                assert!((slope - given).abs() < 1e-3 * 200e9, "{law:?}: {strain} {next}");
                let before = state;
                let [_, viscous] = law.advance(&mut state, [strain, next], (1e-4, lag));
                assert_eq!(viscous, loss, "{law:?}: {before:?}");
                strain = next;
            }
        }
    }
}
