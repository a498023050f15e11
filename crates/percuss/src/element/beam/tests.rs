//! Forces and tangents of every scheme at a Gauss point, against derivatives in dual numbers.

use super::*;
use crate::element::energy_momentum::{End, PointStep, Quotients, Step};
use crate::element::point::{PointResponse, Reference, SectionLaw, StepPoint, Strains};
use crate::element::strain::StrainMeasure;
use crate::element::{collocation, rotary, strain, strain_rate};
use crate::math::vec2::{add, cross, dot};
use crate::scalar::Dual;
use proptest::prelude::*;

/// With derivatives by the increments of slope and bend; [`Dual`] is held to difference quotients by its own test.
type DualFour = Dual<4>;

const H: f64 = 1e-3;
/// Share of Kelvin-Voigt stresses.
const LAG: f64 = 0.2;

fn law<S: Real>(like: S, measure: StrainMeasure) -> SectionLaw<S> {
    let [axial, bending, rotary] = [5.0e3, 40.0, 0.3].map(|x| like.constant(x));
    SectionLaw { axial, bending, rotary, measure }
}

/// The invariant scheme.
fn invariant<S: Real, const TANGENT: bool>(
    law: &SectionLaw<S>,
    point: &StepPoint<S>,
    lag: Option<S>,
) -> PointResponse<S> {
    let start = End::new(law.measure, point.reference.tangent, point.slope_0, point.bend_0);
    let StepPoint { reference, d_slope, d_bend, .. } = point;
    let way = PointStep { reference, start: &start, d_slope: *d_slope, d_bend: *d_bend };
    let [quotients] = Quotients::of(law.measure, &[way]);
    Step::new(law.measure, &way, &quotients).response::<TANGENT>(law, &start, lag)
}

/// A scheme as a function of its step point; `spin`, `old` are its histories.
fn evaluate<S: Real, const T: bool>(
    scheme: usize,
    measure: StrainMeasure,
    point: &StepPoint<S>,
) -> PointResponse<S> {
    let like = point.reference.curvature;
    let law = law(like, measure);
    let g0 = add(point.reference.tangent, point.slope_0);
    let old = Strains { membrane: like.constant(0.02), bending: like.constant(-0.3) };
    let (spin, h) = (like.constant(3.0), like.constant(H));
    match scheme {
        0 => {
            let mut r = invariant::<S, T>(&law, point, Some(like.constant(LAG)));
            rotary::Turn::new(g0, point.d_slope).add_inertia::<T>(
                &mut r,
                law.rotary,
                spin,
                h.recip(),
                like.constant(30.0),
            );
            r
        }
        1 => strain_rate::response::<S, T>(&law, point, old, LAG),
        2 => collocation::damped::<S, T>(&law, point, LAG),
        _ => {
            let theta = 0.7;
            let mut r = collocation::response::<S, T>(&law, point, theta);
            let g = [g0[0] + point.d_slope[0] * theta, g0[1] + point.d_slope[1] * theta];
            let (rate, acc) = (600.0, 2.0e5);
            let linear = |c: f64, offset: [f64; 2]| {
                [
                    point.d_slope[0] * c + like.constant(offset[0]),
                    point.d_slope[1] * c + like.constant(offset[1]),
                ]
            };
            let (g_dot, g_ddot) = (linear(rate, [0.4, -2.0]), linear(acc, [30.0, -10.0]));
            rotary::add_collocated::<S, T>(
                &mut r,
                law.rotary,
                g,
                g_dot,
                g_ddot,
                [theta, rate, acc],
            );
            r
        }
    }
}

fn point_from(v: [f64; 8], angle: f64) -> StepPoint<f64> {
    StepPoint {
        reference: Reference {
            tangent: [angle.cos(), angle.sin()],
            bend: [-0.4 * angle.sin(), 0.4 * angle.cos()],
            curvature: 0.4,
        },
        slope_0: [v[0], v[1]],
        bend_0: [v[2], v[3]],
        d_slope: [v[4], v[5]],
        d_bend: [v[6], v[7]],
    }
}

/// The point, with derivatives with respect to the increments of the step.
fn lift(p: &StepPoint<f64>) -> StepPoint<DualFour> {
    let number = |value: f64| DualFour { value, slope: [0.0; 4] };
    let c = |v: [f64; 2]| v.map(number);
    let by = |v: [f64; 2], first: usize| {
        let mut lifted = c(v);
        (0..2).for_each(|i| lifted[i].slope[first + i] = 1.0);
        lifted
    };
    StepPoint {
        reference: Reference {
            tangent: c(p.reference.tangent),
            bend: c(p.reference.bend),
            curvature: number(p.reference.curvature),
        },
        slope_0: c(p.slope_0),
        bend_0: c(p.bend_0),
        d_slope: by(p.d_slope, 0),
        d_bend: by(p.d_bend, 2),
    }
}

fn measures() -> [StrainMeasure; 2] {
    [StrainMeasure::Green, StrainMeasure::Engineering]
}

proptest! {
    #[test]
    fn tangents_equal_dual_numbers(v in prop::array::uniform8(-0.3..0.3_f64), angle in 0.0..6.3_f64) {
        let point = point_from(v, angle);
        for measure in measures() {
            for scheme in 0..4 {
                let lifted = evaluate::<DualFour, false>(scheme, measure, &lift(&point));
                let ([f1, f2], [f3, f4]) = (lifted.force_g, lifted.force_p);
                let exact = [f1, f2, f3, f4];
                let size = |values: &mut dyn Iterator<Item = f64>| {
                    values.map(|x| x * x).sum::<f64>().sqrt()
                };
                let force = size(&mut exact.iter().map(|f| f.value));
                let scale = size(&mut exact.iter().flat_map(|f| f.slope));
                let ours = evaluate::<f64, true>(scheme, measure, &point);
                for i in 0..4 {
                    let f = [ours.force_g, ours.force_p][i / 2][i % 2];
                    prop_assert!((f - exact[i].value).abs() <= 1e-12 * (1.0 + force));
                    for j in 0..4 {
                        let (found, exact) = (ours.tangent[i][j], exact[i].slope[j]);
                        prop_assert!(
                            (found - exact).abs() <= 1e-12 * scale,
                            "scheme {scheme} {measure:?} ({i},{j}): {found} {exact}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn work_of_the_invariant_scheme_is_the_change_of_strain_energy(
        v in prop::array::uniform8(-0.3..0.3_f64), angle in 0.0..6.3_f64,
    ) {
        let p = point_from(v, angle);
        for measure in measures() {
            let law = law(0.0, measure);
            let energy = |slope, bend| {
                let s = strain::strains(measure, &p.reference, slope, bend);
                0.5 * law.axial * s.membrane.powi(2) + 0.5 * law.bending * s.bending.powi(2)
            };
            let r = invariant::<f64, false>(&law, &p, None);
            let work = dot(r.force_g, p.d_slope) + dot(r.force_p, p.d_bend);
            let change = energy(add(p.slope_0, p.d_slope), add(p.bend_0, p.d_bend))
                - energy(p.slope_0, p.bend_0);
            prop_assert!((work - change).abs() <= 1e-12 * (1.0 + law.axial));
        }
    }

    #[test]
    fn forces_of_every_energy_momentum_scheme_do_no_work_on_rigid_rotation(
        v in prop::array::uniform8(-0.3..0.3_f64), angle in 0.0..6.3_f64,
    ) {
        let p = point_from(v, angle);
        let [g, b] = p.at(0.5);
        let old = Strains { membrane: 0.02, bending: -0.3 };
        for measure in measures() {
            let law = law(0.0, measure);
            for r in [
                invariant::<f64, false>(&law, &p, Some(LAG)),
                strain_rate::response::<f64, false>(&law, &p, old, LAG),
                collocation::damped::<f64, false>(&law, &p, LAG),
            ] {
                let turn = cross(g, r.force_g) + cross(b, r.force_p);
                prop_assert!(turn.abs() <= 1e-12 * law.axial);
            }
        }
    }
}
