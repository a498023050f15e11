//! An element at its Gauss points: constants of these, values of its nodes there, and the sums over them.

use super::point::{PointResponse, Reference, SectionLaw, StepPoint};
use crate::scalar::Real;

/// Reference geometry of the beam at a Gauss point, and the derivatives of the interpolation there, acting on (u_b - u_a, u_a', u_b').
///
/// Only the difference of displacements is used: a translation does not change strains in any bit. Derivatives are with respect to the arc length
/// of the interpolated reference; of x'' only the part across x' is formed, since strains depend on no other.
#[derive(Clone, Copy, Debug)]
pub struct GaussRow<S = f64> {
    /// Coefficients of u', shape (3) \[1/m, -, -\].
    pub first: [S; 3],
    /// Coefficients of u'', shape (3) \[1/m^2, 1/m, 1/m\].
    pub second: [S; 3],
    /// Integration weight \[m\].
    pub weight: S,
    /// Reference configuration.
    pub reference: Reference<S>,
    /// Section constants times the weight, of which the kernels make integrated forces; no axial stiffness where membrane
    /// strains are those of [`MembraneTable`](super::membrane::MembraneTable).
    pub weighed: SectionLaw<S>,
    /// Section constants.
    pub section: SectionLaw<S>,
}

/// Section constants at a place of a beam, per length.
#[derive(Clone, Copy, Debug)]
pub struct SectionValues {
    /// Stiffnesses, rotary inertia, strain measure.
    pub law: SectionLaw<f64>,
    /// Mass rhoA \[kg/m\].
    pub mass: f64,
    /// Area \[m^2\].
    pub area: f64,
    /// Second moment of area about the centre line \[m^4\].
    pub inertia: f64,
    /// Young's modulus; of several materials its mean over the area \[Pa\].
    pub young: f64,
    /// Density; of several materials its mean over the area \[kg/m^3\].
    pub density: f64,
    /// Distance of the extreme fibres from the centre line \[m\]; NaN if unknown.
    pub half_depth: f64,
    /// Shear stiffness kappa G A \[N\]; NaN if unknown.
    pub shear: f64,
    /// Places of its shear stresses: the neutral axis and the outer end of the web, shape (2) \[m, m^2\].
    pub sheared: [ShearedPlace; 2],
}

/// A height of an elastic section at which its shear stress is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearedPlace {
    /// Distance from the centre line \[m\].
    pub height: f64,
    /// Shear force over shear stress there, `I b/Q`, with the width b and the first moment Q of the area beyond \[m^2\]; NaN if unknown.
    pub area: f64,
}

impl ShearedPlace {
    /// Of a section whose shape is not known.
    pub const UNKNOWN: Self = Self { height: 0.0, area: f64::NAN };
}

/// Nodal values of one element in the form the interpolation uses.
#[derive(Clone, Copy, Debug)]
pub struct ElementValues<S> {
    /// u_b - u_a, shape (2) \[m\], or another unit if these are rates.
    pub chord: [S; 2],
    /// u_a', shape (2) \[-\], or that per unit of time.
    pub slope_a: [S; 2],
    /// u_b', shape (2) \[-\], or that per unit of time.
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
    pub fn at(&self, c: &[S; 3]) -> [S; 2] {
        let Self { chord, slope_a, slope_b } = self;
        [
            (chord[0] * c[0]).add_product(slope_a[0], c[1]).add_product(slope_b[0], c[2]),
            (chord[1] * c[0]).add_product(slope_a[1], c[1]).add_product(slope_b[1], c[2]),
        ]
    }
}

/// The two ends of a step at a Gauss point.
#[inline(always)]
pub fn step_point<S: Real>(
    row: &GaussRow<S>,
    old: &ElementValues<S>,
    increment: &ElementValues<S>,
) -> StepPoint<S> {
    StepPoint {
        reference: row.reference,
        slope_0: old.at(&row.first),
        bend_0: old.at(&row.second),
        d_slope: increment.at(&row.first),
        d_bend: increment.at(&row.second),
    }
}

/// Forces and tangent of an element on the six values (chord, slope_a, slope_b) x (1, 2).
#[derive(Clone, Copy, Debug)]
pub struct ElementSums<S> {
    /// Forces, shape (6) \[N, N m\].
    pub force: [S; 6],
    /// Derivatives of the forces, shape (6, 6) \[N/m, N, N m\].
    pub tangent: [[S; 6]; 6],
}

impl<S: Real> ElementSums<S> {
    /// Zero sums, with the lanes of a number.
    #[inline(always)]
    pub fn zero(like: S) -> Self {
        let zero = like.constant(0.0);
        Self { force: [zero; 6], tangent: [[zero; 6]; 6] }
    }

    /// Adds the weighed response at a Gauss point, `B^T f` and `B^T H B`.
    #[inline(always)]
    pub fn add<const TANGENT: bool>(&mut self, row: &GaussRow<S>, point: &PointResponse<S>) {
        let (first, second) = (&row.first, &row.second);
        for k in 0..3 {
            for i in 0..2 {
                let force = &mut self.force[2 * k + i];
                *force = force
                    .add_product(point.force_g[i], first[k])
                    .add_product(point.force_p[i], second[k]);
            }
        }
        if !TANGENT {
            return;
        }
        for l in 0..3 {
            for j in 0..2 {
                // H B for column (l, j).
                let mut column = [first[l]; 4];
                for i in 0..4 {
                    column[i] = (point.tangent[i][j] * first[l])
                        .add_product(point.tangent[i][2 + j], second[l]);
                }
                for k in 0..3 {
                    for i in 0..2 {
                        let entry = &mut self.tangent[2 * k + i][2 * l + j];
                        *entry = entry
                            .add_product(column[i], first[k])
                            .add_product(column[2 + i], second[k]);
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

    /// Tangent on the degrees of freedom of the two nodes, with `slope` times the mass matrix: blocks aa, ab, ba, bb.
    #[inline(always)]
    pub fn nodal_tangent(&self, mass: &[[S; 4]; 4], slope: S) -> [[[S; 4]; 4]; 4] {
        let k = &self.tangent;
        let zero = [[slope.constant(0.0); 4]; 4];
        let [mut aa, mut ab, mut ba, mut bb] = [zero; 4];
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
            for (r, c, mr, mc) in [(0, 0, 0, 0), (0, 2, 0, 1), (2, 0, 1, 0), (2, 2, 1, 1)] {
                aa[r + i][c + i] = aa[r + i][c + i].add_product(slope, mass[mr][mc]);
                ab[r + i][c + i] = ab[r + i][c + i].add_product(slope, mass[mr][mc + 2]);
                ba[r + i][c + i] = ba[r + i][c + i].add_product(slope, mass[mr + 2][mc]);
                bb[r + i][c + i] = bb[r + i][c + i].add_product(slope, mass[mr + 2][mc + 2]);
            }
        }
        [aa, ab, ba, bb]
    }
}
