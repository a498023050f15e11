//! The cubic Hermite beam element: interpolation to Gauss points and integration of forces and tangent.
//!
//! Degrees of freedom of a node are (u1, u2, u1', u2'), of an element those of its two nodes.

use super::point::{PointResponse, StepPoint};
use crate::math::hermite::{self, GAUSS, GAUSS_WEIGHTS};
use crate::scalar::Real;

/// Derivatives of the interpolation at a Gauss point, acting on (u_b - u_a, u_a', u_b').
///
/// Only the difference of displacements enters: a translation leaves strains untouched to the last bit.
#[derive(Clone, Copy, Debug)]
pub struct GaussRow {
    /// Coefficients of u'.
    pub first: [f64; 3],
    /// Coefficients of u''.
    pub second: [f64; 3],
    /// Integration weight \[m\].
    pub weight: f64,
}

/// What all elements of a straight, evenly meshed beam share.
#[derive(Clone, Copy, Debug)]
pub struct ElementTable {
    /// Length of an element \[m\].
    pub length: f64,
    /// Reference tangent.
    pub tangent: [f64; 2],
    /// Rows at the Gauss points.
    pub rows: [GaussRow; GAUSS],
    /// Mass matrix of one displacement component, `int rhoA N_a N_b ds`, order (u_a, u_a', u_b, u_b').
    pub mass: [[f64; 4]; 4],
}

impl ElementTable {
    /// Table of elements of the given length along `tangent`.
    pub fn new(length: f64, tangent: [f64; 2], mass_per_length: f64) -> Self {
        let points = hermite::gauss_points();
        let rows = std::array::from_fn(|k| {
            let first = hermite::slope(points[k], length);
            let second = hermite::curvature(points[k], length);
            GaussRow {
                first: [first[2], first[1], first[3]],
                second: [second[2], second[1], second[3]],
                weight: GAUSS_WEIGHTS[k] * length,
            }
        });
        let mass = hermite::mass(length).map(|row| row.map(|m| m * mass_per_length));
        Self { length, tangent, rows, mass }
    }
}

/// Nodal values of one element in the form the interpolation uses.
#[derive(Clone, Copy, Debug)]
pub struct ElementValues<S> {
    /// u_b - u_a.
    pub chord: [S; 2],
    /// u_a'.
    pub slope_a: [S; 2],
    /// u_b'.
    pub slope_b: [S; 2],
}

impl<S: Real> ElementValues<S> {
    /// From the values of the two nodes.
    #[inline(always)]
    pub fn new(a: &[S; 4], b: &[S; 4]) -> Self {
        Self { chord: [b[0] - a[0], b[1] - a[1]], slope_a: [a[2], a[3]], slope_b: [b[2], b[3]] }
    }

    /// Combination with the coefficients of a [`GaussRow`].
    #[inline(always)]
    pub fn at(&self, c: &[f64; 3]) -> [S; 2] {
        [
            self.chord[0] * c[0] + self.slope_a[0] * c[1] + self.slope_b[0] * c[2],
            self.chord[1] * c[0] + self.slope_a[1] * c[1] + self.slope_b[1] * c[2],
        ]
    }
}

/// The two ends of a step at a Gauss point of an element of a straight beam.
#[inline(always)]
pub fn step_point<S: Real>(
    table: &ElementTable,
    row: &GaussRow,
    old: &ElementValues<S>,
    increment: &ElementValues<S>,
) -> StepPoint<S> {
    StepPoint {
        tangent: [S::constant(table.tangent[0]), S::constant(table.tangent[1])],
        curvature: S::constant(0.0),
        slope_0: old.at(&row.first),
        bend_0: old.at(&row.second),
        d_slope: increment.at(&row.first),
        d_bend: increment.at(&row.second),
    }
}

/// Forces and tangent of an element on the six values (chord, slope_a, slope_b) x (1, 2).
#[derive(Clone, Copy, Debug)]
pub struct ElementSums<S> {
    /// Forces.
    pub force: [S; 6],
    /// Derivatives of the forces.
    pub tangent: [[S; 6]; 6],
}

impl<S: Real> ElementSums<S> {
    /// Nothing summed yet.
    #[inline(always)]
    pub fn zero() -> Self {
        let zero = S::constant(0.0);
        Self { force: [zero; 6], tangent: [[zero; 6]; 6] }
    }

    /// Adds the response at a Gauss point, `B^T f w` and `B^T H B w`.
    #[inline(always)]
    pub fn add<const TANGENT: bool>(&mut self, row: &GaussRow, point: &PointResponse<S>) {
        let first = row.first.map(|c| c * row.weight);
        let second = row.second.map(|c| c * row.weight);
        for k in 0..3 {
            for i in 0..2 {
                self.force[2 * k + i] += point.force_g[i] * first[k] + point.force_p[i] * second[k];
            }
        }
        if !TANGENT {
            return;
        }
        for l in 0..3 {
            for j in 0..2 {
                // H B for column (l, j), weighted.
                let column: [S; 4] = std::array::from_fn(|i| {
                    point.tangent[i][j] * first[l] + point.tangent[i][2 + j] * second[l]
                });
                for k in 0..3 {
                    for i in 0..2 {
                        self.tangent[2 * k + i][2 * l + j] +=
                            column[i] * row.first[k] + column[2 + i] * row.second[k];
                    }
                }
            }
        }
    }

    /// Force on the two nodes.
    #[inline(always)]
    pub fn nodal_force(&self) -> [[S; 4]; 2] {
        let f = &self.force;
        [[-f[0], -f[1], f[2], f[3]], [f[0], f[1], f[4], f[5]]]
    }
}

#[cfg(test)]
mod tests {
    use super::super::point::{SectionLaw, Strains};
    use super::super::{collocation, energy_momentum, rotary, strain, strain_rate};
    use super::*;
    use crate::math::vec2::{add, cross, dot};
    use crate::model::StrainMeasure;
    use nalgebra::SVector;
    use num_dual::{DualNum, DualSVec64, jacobian};
    use proptest::prelude::*;

    type Dual = DualSVec64<4>;

    impl Real for Dual {
        fn constant(value: f64) -> Self {
            Dual::from_re(value)
        }
        fn sqrt(self) -> Self {
            DualNum::sqrt(&self)
        }
    }

    const H: f64 = 1e-3;

    fn law<S: Real>(measure: StrainMeasure) -> SectionLaw<S> {
        let [axial, bending, rotary] = [5.0e3, 40.0, 0.3].map(S::constant);
        SectionLaw { axial, bending, rotary, measure }
    }

    /// A scheme as a function of its step point; `spin`, `old` are its histories.
    fn evaluate<S: Real, const T: bool>(
        scheme: usize,
        measure: StrainMeasure,
        point: &StepPoint<S>,
    ) -> PointResponse<S> {
        let law = law::<S>(measure);
        let g0 = add(point.tangent, point.slope_0);
        let old = Strains { membrane: S::constant(0.02), bending: S::constant(-0.3) };
        let spin = S::constant(3.0);
        match scheme {
            0 => {
                let mut r = energy_momentum::response::<S, T>(&law, point);
                rotary::add_step::<S, T>(&mut r, law.rotary, g0, point.d_slope, spin, H);
                r
            }
            1 => strain_rate::response::<S, T>(&law, point, old),
            2 => collocation::response::<S, T>(&law, point, 0.5),
            _ => {
                let theta = 0.7;
                let mut r = collocation::response::<S, T>(&law, point, theta);
                let g = [g0[0] + point.d_slope[0] * theta, g0[1] + point.d_slope[1] * theta];
                let (rate, acc) = (600.0, 2.0e5);
                let linear = |c: f64, offset: [f64; 2]| {
                    [
                        point.d_slope[0] * c + S::constant(offset[0]),
                        point.d_slope[1] * c + S::constant(offset[1]),
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
            tangent: [angle.cos(), angle.sin()],
            curvature: 0.4,
            slope_0: [v[0], v[1]],
            bend_0: [v[2], v[3]],
            d_slope: [v[4], v[5]],
            d_bend: [v[6], v[7]],
        }
    }

    fn lift(p: &StepPoint<f64>, end: &SVector<Dual, 4>) -> StepPoint<Dual> {
        let c = |v: [f64; 2]| [Dual::from_re(v[0]), Dual::from_re(v[1])];
        StepPoint {
            tangent: c(p.tangent),
            curvature: Dual::from_re(p.curvature),
            slope_0: c(p.slope_0),
            bend_0: c(p.bend_0),
            d_slope: [end[0], end[1]],
            d_bend: [end[2], end[3]],
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
                    let (force, exact) = jacobian(
                        |end: SVector<Dual, 4>| {
                            let r = evaluate::<Dual, false>(scheme, measure, &lift(&point, &end));
                            SVector::from([
                                r.force_g[0], r.force_g[1],
                                r.force_p[0], r.force_p[1],
                            ])
                        },
                        &SVector::from([v[4], v[5], v[6], v[7]]),
                    );
                    let ours = evaluate::<f64, true>(scheme, measure, &point);
                    let scale = exact.norm();
                    for i in 0..4 {
                        let f = [ours.force_g, ours.force_p][i / 2][i % 2];
                        prop_assert!((f - force[i]).abs() <= 1e-12 * (1.0 + force.norm()));
                        for j in 0..4 {
                            prop_assert!(
                                (ours.tangent[i][j] - exact[(i, j)]).abs() <= 1e-12 * scale,
                                "scheme {scheme} {measure:?} ({i},{j}): {} {}", ours.tangent[i][j], exact[(i, j)]
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
                let law = law::<f64>(measure);
                let energy = |slope, bend| {
                    let s = strain::strains(measure, p.tangent, p.curvature, slope, bend);
                    0.5 * law.axial * s.membrane.powi(2) + 0.5 * law.bending * s.bending.powi(2)
                };
                let r = energy_momentum::response::<f64, false>(&law, &p);
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
            let g0 = add(p.tangent, p.slope_0);
            let g = add(g0, [0.5 * p.d_slope[0], 0.5 * p.d_slope[1]]);
            let b = add(p.bend_0, [0.5 * p.d_bend[0], 0.5 * p.d_bend[1]]);
            let old = Strains { membrane: 0.02, bending: -0.3 };
            for measure in measures() {
                let law = law::<f64>(measure);
                for r in [
                    energy_momentum::response::<f64, false>(&law, &p),
                    strain_rate::response::<f64, false>(&law, &p, old),
                    collocation::response::<f64, false>(&law, &p, 0.5),
                ] {
                    let turn = cross(g, r.force_g) + cross(b, r.force_p);
                    prop_assert!(turn.abs() <= 1e-12 * law.axial);
                }
            }
        }
    }
}
