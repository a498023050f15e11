//! Membrane strains of slender elements, sampled at the nodes and the middle.
//!
//! A cubic element that is bent cannot keep its membrane strain at zero throughout. Sampled at three inner Gauss points that
//! locks an element much longer than its radius of gyration; sampled at the ends, which neighbours share, and the middle,
//! and interpolated between, it leaves as many constraints as bending can afford (minimally constrained strains: Meier,
//! Popp, Wall 2014, a locking-free finite element formulation for Kirchhoff beams).

use super::gauss::{ElementSums, ElementValues, GaussRow};
use super::point::StrainMeasure;
use crate::math::hermite::{self, GAUSS};
use crate::math::vec2::{add, dot, norm, scale};
use crate::scalar::{Real, array};

/// Number of sampling points: node a, middle, node b.
pub const SAMPLES: usize = 3;

/// Membrane strains at the sampling points and the stiffness between them.
///
/// Fibre elements that are not slender are sampled at their Gauss points: quadratic functions are then values at one of these, and forces are those
/// of elements without a table.
#[derive(Clone, Copy, Debug)]
pub struct MembraneTable<S = f64> {
    /// Coefficients of u' at the sampling points, acting on (u_b - u_a, u_a', u_b'), shape (sampling points, 3) \[1/m, -, -\].
    pub rows: [[S; 3]; SAMPLES],
    /// Reference tangents there, shape (sampling points, 2) \[-\].
    pub tangent: [[S; 2]; SAMPLES],
    /// `int EA L_i L_k ds` with the quadratics L through the sampling points, shape (sampling points, sampling points) \[N m\].
    pub stiffness: [[S; SAMPLES]; SAMPLES],
    /// Values of the L at the Gauss points, shape (Gauss points, sampling points) \[-\].
    pub at_gauss: [[S; SAMPLES]; GAUSS],
    /// Whether it is sampled at the nodes and the middle, where a node has only its own slope.
    pub is_nodal: bool,
}

/// Terms of the membrane strain at a sampling point in a scheme: `deps = alpha g.dg` at the configuration g.
#[derive(Clone, Copy, Debug)]
pub struct MembranePoint<S> {
    /// Membrane strain that sets the stress \[-\].
    pub strain: S,
    /// Strain of the geometric stiffness; that of the stress as a rule \[-\].
    pub geometric: S,
    /// alpha.
    pub alpha: S,
    /// Configuration of evaluation: tangent x', shape (2) \[-\].
    pub g: [S; 2],
    /// Derivative of `strain` with respect to g at the end of the step, shape (2) \[-\].
    pub d_strain: [S; 2],
    /// Derivative of `alpha` with respect to g at the end of the step, shape (2) \[-\].
    pub d_alpha: [S; 2],
}

impl MembraneTable {
    /// Elements longer than this multiple of the radius of gyration are sampled here. For shorter ones Gauss points are as good: their locking is
    /// proportional to the square of this number times the fourth power of the angle by which an element is bent.
    pub const SLENDER: f64 = 50.0;

    /// Sampled at the nodes and the middle of an element of the given length with its reference and its Gauss points.
    pub fn at_nodes(
        length: f64,
        reference: &ElementValues<f64>,
        gauss: &[GaussRow; GAUSS],
    ) -> Self {
        let middle = hermite::slope(0.5, length);
        let middle = [middle[2], middle[1], middle[3]];
        let stretch = norm(reference.at(&middle));
        let rows = [[0.0, 1.0, 0.0], middle.map(|c| c / stretch), [0.0, 0.0, 1.0]];
        let at_gauss = hermite::gauss_points()
            .map(|x| [(1.0 - x) * (1.0 - 2.0 * x), 4.0 * x * (1.0 - x), x * (2.0 * x - 1.0)]);
        let tangent = rows.map(|row| reference.at(&row));
        Self { rows, tangent, stiffness: stiffness(gauss, &at_gauss), at_gauss, is_nodal: true }
    }

    /// Sampled at the Gauss points.
    pub fn at_gauss_points(gauss: &[GaussRow; GAUSS]) -> Self {
        let unit = |j: usize| std::array::from_fn(|i| if i == j { 1.0 } else { 0.0 });
        let at_gauss = std::array::from_fn(unit);
        Self {
            rows: gauss.each_ref().map(|row| row.first),
            tangent: gauss.each_ref().map(|row| row.reference.tangent),
            stiffness: stiffness(gauss, &at_gauss),
            at_gauss,
            is_nodal: false,
        }
    }
}

/// See [`MembraneTable::stiffness`].
fn stiffness(
    gauss: &[GaussRow; GAUSS],
    at_gauss: &[[f64; SAMPLES]; GAUSS],
) -> [[f64; SAMPLES]; SAMPLES] {
    let mut stiffness = [[0.0; SAMPLES]; SAMPLES];
    for (row, l) in gauss.iter().zip(at_gauss) {
        for i in 0..SAMPLES {
            for k in 0..SAMPLES {
                stiffness[i][k] += row.section.axial * row.weight * l[i] * l[k];
            }
        }
    }
    stiffness
}

impl<S: Real> MembraneTable<S> {
    /// Strain energy of membrane strains at the sampling points \[J\].
    #[inline(always)]
    pub fn energy(&self, strain: [S; SAMPLES]) -> S {
        dot3(strain, array(|i| self.force(strain, i))) * 0.5
    }

    /// Force conjugate to the strain at a sampling point, from the strains at all.
    #[inline(always)]
    fn force(&self, strain: [S; SAMPLES], i: usize) -> S {
        dot3(strain, self.stiffness[i])
    }

    /// Membrane strains of a configuration at the sampling points.
    #[inline(always)]
    pub fn strains(&self, measure: StrainMeasure, u: &ElementValues<S>) -> [S; SAMPLES] {
        [self.strain(0, measure, u), self.strain(1, measure, u), self.strain(2, measure, u)]
    }

    #[inline(always)]
    fn strain(&self, i: usize, measure: StrainMeasure, u: &ElementValues<S>) -> S {
        green_or_engineering(measure, self.tangent[i], u.at(&self.rows[i]))
    }

    /// Adds forces, and their tangent if `TANGENT`; `theta` is the weight of the end of the step in the configurations of
    /// evaluation.
    #[inline(always)]
    pub fn add<const TANGENT: bool>(
        &self,
        points: &[MembranePoint<S>; SAMPLES],
        theta: f64,
        sums: &mut ElementSums<S>,
    ) {
        let strain = [points[0].strain, points[1].strain, points[2].strain];
        let geometric = [points[0].geometric, points[1].geometric, points[2].geometric];
        for i in 0..SAMPLES {
            let p = &points[i];
            let n = self.force(strain, i) * p.alpha;
            for l in 0..3 {
                for c in 0..2 {
                    let force = &mut sums.force[2 * l + c];
                    *force = force.add_product(n * p.g[c], self.rows[i][l]);
                }
            }
            if !TANGENT {
                continue;
            }
            let force = self.force(geometric, i);
            let turned = force * p.alpha * theta;
            for k in 0..SAMPLES {
                let mut block = [[n.constant(0.0); 2]; 2];
                for c in 0..2 {
                    for d in 0..2 {
                        block[c][d] =
                            p.alpha * p.g[c] * points[k].d_strain[d] * self.stiffness[i][k];
                        if i == k {
                            block[c][d] += force * p.d_alpha[d] * p.g[c];
                        }
                    }
                    if i == k {
                        block[c][c] += turned;
                    }
                }
                self.add_block(i, k, &block, sums);
            }
        }
    }

    /// The values at a sampling point: a node has only its own slope.
    #[inline(always)]
    fn known(&self, sample: usize) -> std::ops::Range<usize> {
        if self.is_nodal { [1..2, 0..3, 2..3][sample].clone() } else { 0..3 }
    }

    /// Adds `row_i^T block row_k` to the tangent of an element.
    #[inline(always)]
    fn add_block(&self, i: usize, k: usize, block: &[[S; 2]; 2], sums: &mut ElementSums<S>) {
        for l in self.known(i) {
            for r in self.known(k) {
                let factor = self.rows[i][l] * self.rows[k][r];
                for c in 0..2 {
                    for d in 0..2 {
                        let entry = &mut sums.tangent[2 * l + c][2 * r + d];
                        *entry = entry.add_product(block[c][d], factor);
                    }
                }
            }
        }
    }
}

/// The ends of a step at a sampling point.
#[derive(Clone, Copy, Debug)]
pub struct MembraneStep<S> {
    /// Reference tangent, shape (2) \[-\].
    pub tangent: [S; 2],
    /// Displacement gradient at the start, shape (2) \[-\].
    pub slope_0: [S; 2],
    /// Its increment, shape (2) \[-\].
    pub d_slope: [S; 2],
}

impl<S: Real> MembraneTable<S> {
    /// The ends of a step at the sampling points.
    #[inline(always)]
    pub fn step(
        &self,
        old: &ElementValues<S>,
        increment: &ElementValues<S>,
    ) -> [MembraneStep<S>; SAMPLES] {
        [
            self.step_at(0, old, increment),
            self.step_at(1, old, increment),
            self.step_at(2, old, increment),
        ]
    }

    #[inline(always)]
    fn step_at(
        &self,
        i: usize,
        old: &ElementValues<S>,
        increment: &ElementValues<S>,
    ) -> MembraneStep<S> {
        let row = &self.rows[i];
        let (slope_0, d_slope) = (old.at(row), increment.at(row));
        MembraneStep { tangent: self.tangent[i], slope_0, d_slope }
    }
}

/// `eps` of a displacement gradient, written so that small strains lose no digits.
#[inline(always)]
pub fn green_or_engineering<S: Real>(measure: StrainMeasure, tangent: [S; 2], slope: [S; 2]) -> S {
    let green = dot(tangent, slope) + dot(slope, slope) * 0.5;
    match measure {
        StrainMeasure::Green => green,
        StrainMeasure::Engineering => {
            let g = add(tangent, slope);
            (green + green) / (dot(g, g).sqrt() + green.constant(1.0))
        }
    }
}

impl<S: Real> MembraneStep<S> {
    /// Configuration a share of the way through the step.
    #[inline(always)]
    fn at(&self, theta: f64) -> [S; 2] {
        array(|i| self.tangent[i] + self.slope_0[i] + self.d_slope[i] * theta)
    }

    /// The invariant scheme: the mean of the strains at both ends, and of a damped material the change of strain times `lag`, the
    /// retardation time over the step size.
    ///
    /// The change is taken from the increment, not as a difference of strains: of a beam that moves as a rigid body it rounds at the
    /// size of the increment, however short the step.
    #[inline(always)]
    pub fn invariant(&self, measure: StrainMeasure, lag: Option<S>) -> MembranePoint<S> {
        let [before, mut point] = self.at_ends(measure);
        let half = before.strain.constant(0.5);
        let (mean, weight) = ((before.strain + point.strain) * half, half);
        let (strain, weight) = match lag {
            Some(lag) => {
                let change = point.alpha * dot(point.g, self.d_slope);
                (mean.add_product(lag, change), weight + lag)
            }
            None => (mean, weight),
        };
        point.d_strain = scale(weight, point.d_strain);
        MembranePoint { strain, geometric: strain, ..point }
    }

    /// The same with the strain at the start, and with that at the end.
    #[inline(always)]
    pub fn at_ends(&self, measure: StrainMeasure) -> [MembranePoint<S>; 2] {
        let (g, g1) = (self.at(0.5), self.at(1.0));
        let slope_1 = add(self.slope_0, self.d_slope);
        let strain =
            [self.slope_0, slope_1].map(|slope| green_or_engineering(measure, self.tangent, slope));
        let zero = strain[0].constant(0.0);
        let (alpha, d_strain, d_alpha) = match measure {
            StrainMeasure::Green => (zero.constant(1.0), g1, [zero; 2]),
            StrainMeasure::Engineering => {
                let g0 = self.at(0.0);
                let (r0, r1) = (dot(g0, g0).sqrt(), dot(g1, g1).sqrt());
                let (q, inv) = ((r0 + r1).recip(), r1.recip());
                (q + q, scale(inv, g1), scale(inv * q * q * -2.0, g1))
            }
        };
        strain.map(|strain| MembranePoint {
            strain,
            geometric: strain,
            alpha,
            g,
            d_strain,
            d_alpha,
        })
    }

    /// Strain at one configuration, with the rate of a step of size h weighing `lag`.
    #[inline(always)]
    pub fn collocated(&self, measure: StrainMeasure, theta: f64, lag: f64) -> MembranePoint<S> {
        let g = self.at(theta);
        let slope = [0, 1].map(|i| self.slope_0[i] + self.d_slope[i] * theta);
        let (alpha, alpha_a) = alpha(measure, g);
        let power = dot(g, self.d_slope);
        let strain = green_or_engineering(measure, self.tangent, slope) + alpha * power * lag;
        let g1 = self.at(2.0 * theta); // d(g . Dg) = (g + theta Dg) . dg
        let d_alpha = g.map(|c| c * alpha_a * theta);
        let d_strain = std::array::from_fn(|i| {
            g[i] * alpha * theta + (d_alpha[i] * power + alpha * g1[i]) * lag
        });
        MembranePoint { strain, geometric: strain, alpha, g, d_strain, d_alpha }
    }

    /// The paper's scheme: the stored strain `old` advanced by its midpoint rate.
    #[inline(always)]
    pub fn strain_rate(&self, measure: StrainMeasure, old: S, lag: f64) -> MembranePoint<S> {
        let w1 = 0.5 + lag;
        let (g, g1) = (self.at(0.5), self.at(1.0));
        let (alpha, alpha_a) = alpha(measure, g);
        let power = dot(g, self.d_slope);
        let strain = old + alpha * power * w1;
        let d_alpha = g.map(|c| c * alpha_a * 0.5);
        let d_strain = std::array::from_fn(|i| (d_alpha[i] * power + alpha * g1[i]) * w1);
        MembranePoint { strain, geometric: strain, alpha, g, d_strain, d_alpha }
    }

    /// Change of the membrane strain over the step in the scheme's virtual work, and to first order of the stored strain.
    #[inline(always)]
    pub fn midpoint_change(&self, measure: StrainMeasure) -> S {
        let g = self.at(0.5);
        alpha(measure, g).0 * dot(g, self.d_slope)
    }
}

/// alpha of `deps = alpha g.dg` at one configuration, and its derivative along `g.dg`.
#[inline(always)]
fn alpha<S: Real>(measure: StrainMeasure, g: [S; 2]) -> (S, S) {
    match measure {
        StrainMeasure::Green => (g[0].constant(1.0), g[0].constant(0.0)),
        StrainMeasure::Engineering => {
            let inv = dot(g, g).sqrt().recip();
            (inv, -(inv * inv * inv))
        }
    }
}

#[inline(always)]
fn dot3<S: Real>(a: [S; 3], b: [S; 3]) -> S {
    (a[0] * b[0]).add_product(a[1], b[1]).add_product(a[2], b[2])
}
