//! Sums residual and tangent of the beams over their elements.

use super::integration::{Integration, MidpointForces, Rule};
use crate::element::beam::{ElementSums, ElementTable, ElementValues, GaussRow, step_point};
use crate::element::point::{PointResponse, SectionLaw, StepPoint, Strains};
use crate::element::{collocation, energy_momentum, rotary, strain_rate};
use crate::linalg::block::{Block, ZERO};
use crate::linalg::chain::Chain;
use crate::math::hermite::GAUSS;
use crate::math::vec2::add;
use crate::model::Model;
use crate::model::frozen::BeamData;
use crate::state::State;

/// Where a Gauss point stands: its element and its number there.
#[derive(Clone, Copy)]
struct Place<'a> {
    beam: &'a BeamData,
    row: &'a GaussRow,
    /// Node `a` of the element.
    node: usize,
    element: usize,
    gauss: usize,
}

/// Residual `M (a - gravity) + f_int` of the beams at `increment`, and their tangent if `TANGENT`.
///
/// Must not allocate.
pub fn beams<const TANGENT: bool>(
    model: &Model,
    state: &State,
    integration: &Integration,
    gravity: [f64; 2],
    increment: &[[f64; 4]],
    residual: &mut [[f64; 4]],
    chain: &mut Chain,
) {
    let h = integration.h;
    let ends = Ends { model, state, integration, gravity, increment };
    match integration.rule {
        Rule::Midpoint(MidpointForces::Invariant) => {
            ends.sum::<TANGENT>(residual, chain, |law, point, place| {
                let mut r = energy_momentum::response::<f64, TANGENT>(law, point);
                add_rotary::<TANGENT>(
                    &mut r,
                    law,
                    point,
                    state.spin[place.element][place.gauss],
                    h,
                );
                r
            })
        }
        Rule::Midpoint(MidpointForces::StrainRate) => {
            ends.sum::<TANGENT>(residual, chain, |law, point, place| {
                let [membrane, bending] = state.strain[place.element][place.gauss];
                let old = Strains { membrane, bending };
                let mut r = strain_rate::response::<f64, TANGENT>(law, point, old);
                add_rotary::<TANGENT>(
                    &mut r,
                    law,
                    point,
                    state.spin[place.element][place.gauss],
                    h,
                );
                r
            })
        }
        Rule::Midpoint(MidpointForces::Collocated) => {
            ends.sum::<TANGENT>(residual, chain, |law, point, place| {
                let mut r = collocation::response::<f64, TANGENT>(law, point, 0.5);
                add_rotary::<TANGENT>(
                    &mut r,
                    law,
                    point,
                    state.spin[place.element][place.gauss],
                    h,
                );
                r
            })
        }
        Rule::Static { .. } => ends.sum::<TANGENT>(residual, chain, |law, point, place| {
            let [membrane, bending] = state.strain[place.element][place.gauss];
            let foreseen = Strains { membrane, bending };
            collocation::foreseeing::<f64, TANGENT>(law, point, foreseen)
        }),
        Rule::Alpha(_) => {
            let theta = integration.theta();
            ends.sum::<TANGENT>(residual, chain, |law, point, place| {
                let mut r = collocation::response::<f64, TANGENT>(law, point, theta);
                ends.add_alpha_rotary::<TANGENT>(&mut r, law, point, place);
                r
            });
        }
    }
}

#[inline(always)]
fn add_rotary<const TANGENT: bool>(
    response: &mut PointResponse<f64>,
    law: &SectionLaw<f64>,
    point: &StepPoint<f64>,
    spin: f64,
    h: f64,
) {
    let g0 = add(point.tangent, point.slope_0);
    rotary::add_step::<f64, TANGENT>(response, law.rotary, g0, point.d_slope, spin, h);
}

/// The start of the step and the increment that leads to its end.
struct Ends<'a> {
    model: &'a Model,
    state: &'a State,
    integration: &'a Integration,
    gravity: [f64; 2],
    increment: &'a [[f64; 4]],
}

impl Ends<'_> {
    /// Sums over all elements what `response` gives at their Gauss points, and the inertia of their mass.
    #[inline(always)]
    fn sum<const TANGENT: bool>(
        &self,
        residual: &mut [[f64; 4]],
        chain: &mut Chain,
        response: impl Fn(&SectionLaw<f64>, &StepPoint<f64>, Place) -> PointResponse<f64>,
    ) {
        let slope = self.integration.inertia_slope();
        for beam in &self.model.beams {
            let first = beam.nodes.start;
            residual[first] = [0.0; 4];
            if TANGENT {
                chain.diag[first] = ZERO;
            }
            let mut start = self.inertia(first);
            for (k, element) in beam.elements.clone().enumerate() {
                let a = first + k;
                let end = self.inertia(a + 1);
                let u = &self.state.displacement;
                let old = ElementValues::new(&u[a], &u[a + 1]);
                let step = ElementValues::new(&self.increment[a], &self.increment[a + 1]);
                let mut sums = ElementSums::zero();
                for gauss in 0..GAUSS {
                    let row = &beam.table.rows[gauss];
                    let point = step_point(&beam.table, row, &old, &step);
                    let place = Place { beam, row, node: a, element, gauss };
                    sums.add::<TANGENT>(row, &response(&beam.law, &point, place));
                }
                let [mut on_a, mut on_b] = sums.nodal_force();
                add_inertia(&beam.table, &start, &end, &mut on_a, &mut on_b);
                for i in 0..4 {
                    residual[a][i] += on_a[i];
                }
                residual[a + 1] = on_b;
                if TANGENT {
                    spread(&sums.tangent, &beam.table.mass, slope, a, chain);
                }
                start = end;
            }
        }
    }

    /// Acceleration of a node in the equation of motion, less gravity.
    #[inline(always)]
    fn inertia(&self, node: usize) -> [f64; 4] {
        let (d, v) = (&self.increment[node], &self.state.velocity[node]);
        let a = self.state.acceleration.get(node).unwrap_or(&[0.0; 4]);
        let mut out: [f64; 4] = std::array::from_fn(|i| self.integration.inertia(d[i], v[i], a[i]));
        out[0] -= self.gravity[0];
        out[1] -= self.gravity[1];
        out
    }

    /// Rotary inertia of the schemes that advance accelerations.
    #[inline(always)]
    fn add_alpha_rotary<const TANGENT: bool>(
        &self,
        response: &mut PointResponse<f64>,
        law: &SectionLaw<f64>,
        point: &StepPoint<f64>,
        place: Place,
    ) {
        let Rule::Alpha(w) = self.integration.rule else { return };
        debug_assert!(place.beam.law.rotary == law.rotary);
        let theta = 1.0 - w.alpha_f;
        let g0 = add(point.tangent, point.slope_0);
        let g = [g0[0] + theta * point.d_slope[0], g0[1] + theta * point.d_slope[1]];
        let at = |nodal: &[[f64; 4]]| {
            ElementValues::new(&nodal[place.node], &nodal[place.node + 1]).at(&place.row.first)
        };
        let (v0, a0) = (at(&self.state.velocity), at(&self.state.acceleration));
        let rule = self.integration;
        let g_dot = std::array::from_fn(|i| {
            (1.0 - theta) * v0[i] + theta * rule.velocity(point.d_slope[i], v0[i], a0[i])
        });
        let g_ddot = std::array::from_fn(|i| rule.inertia(point.d_slope[i], v0[i], a0[i]));
        let slopes = [theta, theta * w.gamma / (w.beta * rule.h), rule.inertia_slope()];
        rotary::add_collocated::<f64, TANGENT>(response, law.rotary, g, g_dot, g_ddot, slopes);
    }
}

/// Adds the mass matrix times nodal accelerations.
#[inline(always)]
fn add_inertia(
    table: &ElementTable,
    acc_a: &[f64; 4],
    acc_b: &[f64; 4],
    on_a: &mut [f64; 4],
    on_b: &mut [f64; 4],
) {
    let m = &table.mass;
    for i in 0..2 {
        let acc = [acc_a[i], acc_a[2 + i], acc_b[i], acc_b[2 + i]];
        let row =
            |k: usize| m[k][0] * acc[0] + m[k][1] * acc[1] + m[k][2] * acc[2] + m[k][3] * acc[3];
        on_a[i] += row(0);
        on_a[2 + i] += row(1);
        on_b[i] += row(2);
        on_b[2 + i] += row(3);
    }
}

/// Spreads an element's tangent on (chord, slope_a, slope_b), and its mass times `slope`, over the band.
#[inline(always)]
pub fn spread(k: &[[f64; 6]; 6], mass: &[[f64; 4]; 4], slope: f64, a: usize, chain: &mut Chain) {
    let (mut aa, mut ab, mut ba, mut bb) = (ZERO, ZERO, ZERO, ZERO);
    for i in 0..2 {
        for j in 0..2 {
            let chord = k[i][j];
            aa[i][j] = chord;
            ab[i][j] = -chord;
            ba[i][j] = -chord;
            bb[i][j] = chord;
            aa[i][2 + j] = -k[i][2 + j];
            aa[2 + i][j] = -k[2 + i][j];
            aa[2 + i][2 + j] = k[2 + i][2 + j];
            ab[i][2 + j] = -k[i][4 + j];
            ab[2 + i][j] = k[2 + i][j];
            ab[2 + i][2 + j] = k[2 + i][4 + j];
            ba[i][2 + j] = k[i][2 + j];
            ba[2 + i][j] = -k[4 + i][j];
            ba[2 + i][2 + j] = k[4 + i][2 + j];
            bb[i][2 + j] = k[i][4 + j];
            bb[2 + i][j] = k[4 + i][j];
            bb[2 + i][2 + j] = k[4 + i][4 + j];
        }
    }
    for i in 0..2 {
        for (r, c, m) in [(0, 0, 0), (0, 2, 1), (2, 0, 4), (2, 2, 5)] {
            let (mr, mc) = (m / 4, m % 4);
            aa[r + i][c + i] += slope * mass[mr][mc];
            ab[r + i][c + i] += slope * mass[mr][mc + 2];
            ba[r + i][c + i] += slope * mass[mr + 2][mc];
            bb[r + i][c + i] += slope * mass[mr + 2][mc + 2];
        }
    }
    add_block(&mut chain.diag[a], &aa);
    chain.upper[a] = ab;
    chain.lower[a] = ba;
    chain.diag[a + 1] = bb;
}

#[inline(always)]
fn add_block(target: &mut Block, block: &Block) {
    for i in 0..4 {
        for j in 0..4 {
            target[i][j] += block[i][j];
        }
    }
}
