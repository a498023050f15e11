//! Elements side by side: the same bits whatever registers the processor has.

use percuss::internals::element::fibre::FibreLosses;
use percuss::internals::element::fibre::{Hardening, Inelasticity, Overstress, Plasticity};
use percuss::internals::linalg::chain::Chain;
use percuss::internals::scalar::use_at_most;
use percuss::internals::settings::Scheme;
use percuss::internals::state::State;
use percuss::internals::step::end_forces::EndForces;
use percuss::internals::step::integration::Integration;
use percuss::internals::step::sweep::{AdvanceFibres, SpanStep};
use percuss::{Beam, Material, Model, ModelBuilder, Profile, Section, Station};

/// A beam whose elements differ, a slender one whose elements do not, and one that yields; none fills its registers.
fn model() -> Model {
    let mut b = ModelBuilder::new();
    let material =
        Material { retardation: 1e-5, mass_damping: 0.7, ..Material::new("m", 2e9, 3e3) };
    let overstress = Some(Overstress { rate: 40.0, exponent: 5.0 });
    let part = |from, stress, modulus| Hardening { from, stress, modulus };
    let curve = vec![part(0.0, 2e6, 1e8), part(0.01, 3e6, 5e7)];
    let plasticity = Plasticity { curve, kinematic: 1e8, overstress, failure_strain: None };
    let inelasticity = Some(Inelasticity::Plastic(plasticity));
    let steel = b.material(Material { name: "steel".into(), inelasticity, ..material.clone() });
    let material = b.material(material);
    let at = |at, area| Station {
        at,
        area,
        inertia: 8e-5 * area,
        depth: None,
        profile: Profile::Unknown,
        properties: Default::default(),
    };
    let stations = vec![at(0.0, 0.1), at(1.0, 0.05)];
    let tapered = b.section(Section { stations, ..Section::new("tapered", 0.1, 8e-6) });
    let slender = b.section(Section::new("slender", 0.1, 8e-9));
    let layered = b.section(Section { fibres: 6, ..Section::rectangle("layered", 0.1, 0.1) });
    b.beam(Beam::new("tapered", &[[0.0, 0.0], [3.0, 0.0]], 11, material, tapered));
    b.beam(Beam::new("slender", &[[0.0, 1.0], [3.0, 2.0]], 6, material, slender));
    b.beam(Beam::new("yielding", &[[0.0, 3.0], [3.0, 2.0]], 5, steel, layered));
    b.build().unwrap()
}

/// Numbers from a generator, between -`size` and `size`.
fn noise<const N: usize>(seed: &mut u64, count: usize, size: f64) -> Vec<[f64; N]> {
    let mut next = || {
        *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        size * ((*seed >> 33) as f64 / (1_u64 << 30) as f64 - 1.0)
    };
    (0..count).map(|_| std::array::from_fn(|_| next())).collect()
}

/// Bits of all that a sweep finds in a step.
fn whole(model: &Model, state: &State, increment: &[[f64; 4]]) -> Vec<u64> {
    let mut forces = EndForces::new(model);
    let mut chain = Chain::zeros(model.node_count());
    let mut found = Vec::new();
    forces.sweep.begin(model, state);
    for number in 0..model.spans.len() {
        let (m, hardening) = forces.sweep.measure(model, number);
        found.push(hardening);
        found.extend([m.translation, m.rotation, m.axial, m.bending, m.linear[0], m.linear[1]]);
        found.extend([m.linear_size, m.angular, m.angular_size]);
    }
    let rule = &Integration::new(Scheme::EnergyMomentum, 1e-4);
    let mut end = state.clone();
    let mut losses = FibreLosses::default();
    let mut residual = vec![[0.0; 4]; model.node_count()];
    let gravity = [0.0, -9.81];
    for span in 0..model.spans.len() {
        assert!(forces.sweep.has(span));
        let (residual, chain, forces) = (&mut residual[..], &mut chain, &mut forces);
        SpanStep::<true> { model, span, rule, gravity, increment, residual, chain, forces }
            .evaluate();
    }
    for span in 0..model.spans.len() {
        let (residual, chain, forces) = (&mut residual[..], &mut chain, &mut forces);
        SpanStep::<false> { model, span, rule, gravity, increment, residual, chain, forces }
            .evaluate();
    }
    let (sweep, span, number) = (&forces.sweep, &model.spans[2], 2);
    let (state, losses_of) = (&mut end, &mut losses);
    AdvanceFibres { sweep, span, number, state, rule, losses: losses_of }.advance();
    assert!(losses.plastic > 0.0 && losses.viscous > 0.0);
    found.extend([losses.plastic, losses.viscous]);
    found.extend(end.fibres.iter().flat_map(|f| [f.plastic, f.accumulated, f.dissipated]));
    for blocks in [&chain.diag, &chain.upper, &chain.lower] {
        found.extend(blocks.as_flattened().as_flattened());
    }
    found.extend(residual.as_flattened());
    for (number, span) in model.spans.iter().enumerate() {
        span.nodes.clone().for_each(|n| found.extend(forces.inertia(number, n)));
        let on_nodes = |e: usize| found.extend(forces.on_nodes(number, e).as_flattened());
        span.elements.clone().for_each(on_nodes);
    }
    found.extend((0..model.element_count()).flat_map(|e| forces.sweep.end_spin(e)));
    found.into_iter().map(f64::to_bits).collect()
}

#[test]
fn bits_do_not_depend_on_the_registers() {
    let (model, seed) = (model(), &mut 1);
    let mut state = State::at_rest(&model, Scheme::EnergyMomentum);
    state.displacement = noise(seed, model.node_count(), 0.02);
    state.velocity = noise(seed, model.node_count(), 20.0);
    state.spin = noise(seed, model.element_count(), 20.0);
    let increment = &noise(seed, model.node_count(), 2e-3);
    for (fibre, [plastic]) in state.fibres.iter_mut().zip(noise(seed, 1000, 0.02)) {
        (fibre.plastic, fibre.accumulated) = (plastic, plastic.abs());
    }
    let in_registers_of = |lanes| {
        use_at_most(lanes);
        whole(&model, &state, increment)
    };
    let alone = in_registers_of(1);
    assert!(alone.iter().all(|x| f64::from_bits(*x).is_finite()));
    // Where the processor has no such registers the next narrower ones are used.
    assert_eq!(in_registers_of(4), alone);
    assert_eq!(in_registers_of(usize::MAX), alone);
}
