use pulp::{Simd, WithSimd};

use super::SpanStep;
use super::start::{Begin, Measure};
use crate::linalg::chain::Chain;
use crate::model::{Beam, Material, Model, ModelBuilder, Section, Station};
use crate::settings::Scheme;
use crate::state::State;
use crate::step::assemble::EndForces;
use crate::step::integration::Integration;

/// A beam whose elements differ, and a slender one whose elements do not; neither fills its registers.
fn model() -> Model {
    let mut b = ModelBuilder::new();
    let material =
        Material { retardation: 1e-5, mass_damping: 0.7, ..Material::new("m", 2e9, 3e3) };
    let material = b.material(material);
    let at = |at, area| Station { at, area, inertia: 8e-5 * area, depth: None };
    let stations = vec![at(0.0, 0.1), at(1.0, 0.05)];
    let tapered = b.section(Section { stations, ..Section::new("tapered", 0.1, 8e-6) });
    let slender = b.section(Section::new("slender", 0.1, 8e-9));
    b.beam(Beam::new("tapered", &[[0.0, 0.0], [3.0, 0.0]], 11, material, tapered));
    b.beam(Beam::new("slender", &[[0.0, 1.0], [3.0, 2.0]], 6, material, slender));
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

/// All that a sweep finds in a step.
struct Whole<'a> {
    model: &'a Model,
    state: &'a State,
    increment: &'a [[f64; 4]],
}

impl WithSimd for Whole<'_> {
    type Output = Vec<u64>;
    fn with_simd<P: Simd>(self, family: P) -> Vec<u64> {
        let Self { model, state, increment } = self;
        let mut forces = EndForces::new(model);
        let mut chain = Chain::zeros(model.node_count());
        let mut found = Vec::new();
        Begin { sweep: &mut forces.sweep, model, state }.with_simd(family);
        for (number, span) in model.spans.iter().enumerate() {
            let sweep = &mut forces.sweep;
            let m = Measure { sweep, span, number }.with_simd(family);
            found.extend([m.translation, m.rotation, m.axial, m.bending, m.linear[0], m.linear[1]]);
            found.extend([m.linear_size, m.angular, m.angular_size]);
        }
        let rule = &Integration::new(Scheme::EnergyMomentum, 1e-4);
        let mut residual = vec![[0.0; 4]; model.node_count()];
        for span in 0..model.spans.len() {
            assert!(forces.sweep.has(span));
            let (residual, chain, forces) = (&mut residual[..], &mut chain, &mut forces);
            let gravity = [0.0, -9.81];
            SpanStep::<true> { model, span, rule, gravity, increment, residual, chain, forces }
                .with_simd(family);
        }
        for span in 0..model.spans.len() {
            let (residual, chain, forces) = (&mut residual[..], &mut chain, &mut forces);
            let gravity = [0.0, -9.81];
            SpanStep::<false> { model, span, rule, gravity, increment, residual, chain, forces }
                .with_simd(family);
        }
        for blocks in [&chain.diag, &chain.upper, &chain.lower] {
            found.extend(blocks.as_flattened().as_flattened());
        }
        found.extend(residual.as_flattened());
        found.extend(forces.inertia.as_flattened());
        found.extend(forces.on_nodes.as_flattened().as_flattened());
        found.extend((0..model.element_count()).flat_map(|e| forces.sweep.end_spin(e)));
        found.into_iter().map(f64::to_bits).collect()
    }
}

#[test]
fn bits_do_not_depend_on_the_registers() {
    let (model, seed) = (model(), &mut 1);
    let mut state = State::at_rest(&model, Scheme::EnergyMomentum);
    state.displacement = noise(seed, model.node_count(), 0.02);
    state.velocity = noise(seed, model.node_count(), 20.0);
    state.spin = noise(seed, model.element_count(), 20.0);
    let increment = &noise(seed, model.node_count(), 2e-3);
    let whole = || Whole { model: &model, state: &state, increment };
    let alone = whole().with_simd(pulp::Scalar::new());
    assert!(alone.iter().all(|x| f64::from_bits(*x).is_finite()));
    #[cfg(target_arch = "x86_64")]
    {
        use pulp::x86::{V3, V4};
        if let Some(family) = V3::try_new() {
            assert_eq!(Simd::vectorize(family, whole()), alone);
        }
        if let Some(family) = V4::try_new() {
            assert_eq!(Simd::vectorize(family, whole()), alone);
        }
    }
}
