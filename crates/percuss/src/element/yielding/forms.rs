//! Forces of a fibre section, and their contribution to an element along the gradients of its strains.

use crate::element::beam::{ElementSums, GaussRow};
use crate::element::fibre::Fibre;
use crate::element::membrane::{MembranePoint, MembraneTable, SAMPLES};
use crate::element::point::Form;
use crate::scalar::{Number, Real, array};

/// Six coefficients over (chord, slope_a, slope_b) x (1, 2).
pub type ElementForm<S> = [S; 6];

/// Forces of a section and their derivatives with respect to membrane and bending strain at the end.
#[derive(Clone, Copy, Debug)]
pub struct SectionResponse<S> {
    /// \[N\]
    pub axial: S,
    /// \[N m\]
    pub moment: S,
    /// Derivatives of axial force and moment, row by row, with respect to membrane and bending strain, shape (2, 2) \[N, N m, N m^2\].
    pub tangent: [[S; 2]; 2],
}

/// Value at a Gauss point from the values at the sampling points.
#[inline(always)]
pub fn interpolate<S: Real>(at: &[S; SAMPLES], values: &[S; SAMPLES]) -> S {
    let mut sum = at[0] * values[0];
    for i in 1..SAMPLES {
        sum = sum.add_product(at[i], values[i]);
    }
    sum
}

impl<S: Number> SectionResponse<S> {
    #[inline(always)]
    pub fn zero(none: S) -> Self {
        Self { axial: none, moment: none, tangent: [[none; 2]; 2] }
    }

    /// Adds a fibre of given stress and tangent modulus.
    #[inline(always)]
    pub fn add(&mut self, fibre: &Fibre<S>, stress: S, modulus: S) {
        let (force, stiffness) = (fibre.area * stress, fibre.area * modulus);
        let arm = stiffness * fibre.height;
        self.axial += force;
        self.moment += force * fibre.height;
        self.tangent[0][0] += stiffness;
        self.tangent[0][1] += arm;
        self.tangent[1][1] += arm * fibre.height;
    }

    /// The sum of the contributions: its tangent is symmetric.
    #[inline(always)]
    pub fn close(mut self) -> Self {
        self.tangent[1][0] = self.tangent[0][1];
        self
    }
}

/// Adds a form at a Gauss point to an element's.
#[inline(always)]
pub fn spread<S: Real>(row: &GaussRow<S>, form: &Form<S>) -> ElementForm<S> {
    array(|i| row.first[i / 2] * form.g[i % 2] + row.second[i / 2] * form.p[i % 2])
}

/// Gradients of the membrane strains at the sampling points: that of the step, and that at its end.
#[inline(always)]
pub fn sampled<S: Real>(
    table: &MembraneTable<S>,
    points: &[MembranePoint<S>; SAMPLES],
) -> [[ElementForm<S>; SAMPLES]; 2] {
    let mut out = [[[points[0].alpha; 6]; SAMPLES]; 2];
    for i in 0..SAMPLES {
        let (p, row) = (&points[i], &table.rows[i]);
        out[0][i] = array(|k| row[k / 2] * (p.g[k % 2] * p.alpha));
        out[1][i] = array(|k| row[k / 2] * p.d_strain[k % 2]);
    }
    out
}

/// Values at a Gauss point from the values at the sampling points.
#[inline(always)]
pub fn interpolated<S: Real>(
    at: &[S; SAMPLES],
    forms: &[ElementForm<S>; SAMPLES],
) -> ElementForm<S> {
    array(|k| interpolate(at, &[forms[0][k], forms[1][k], forms[2][k]]))
}

/// Contribution of a Gauss point to an element: axial force along the gradient of membrane strain, and the tangent of the section along the gradients
/// of both strains. The moment acts with the bending response of the element.
#[inline(always)]
pub fn add_section<S: Real, const TANGENT: bool>(
    sums: &mut ElementSums<S>,
    weight: S,
    response: &SectionResponse<S>,
    gradients: [&ElementForm<S>; 2],
    ends: [&ElementForm<S>; 2],
) {
    let axial = weight * response.axial;
    for k in 0..6 {
        sums.force[k] = sums.force[k].add_product(axial, gradients[0][k]);
    }
    if !TANGENT {
        return;
    }
    let [[nn, nm], [mn, mm]] = response.tangent;
    let [nn, nm, mn, mm] = [weight * nn, weight * nm, weight * mn, weight * mm];
    for l in 0..6 {
        let n = (nn * ends[0][l]).add_product(nm, ends[1][l]);
        let m = (mn * ends[0][l]).add_product(mm, ends[1][l]);
        for k in 0..6 {
            let entry = &mut sums.tangent[k][l];
            *entry = entry.add_product(gradients[0][k], n).add_product(gradients[1][k], m);
        }
    }
}

/// Tangent of the axial forces' lever arms, `force` at the sampling points.
#[inline(always)]
pub fn add_turned<S: Real>(
    sums: &mut ElementSums<S>,
    table: &MembraneTable<S>,
    points: &[MembranePoint<S>; SAMPLES],
    force: [S; SAMPLES],
    theta: f64,
) {
    for i in 0..SAMPLES {
        let (p, row) = (&points[i], &table.rows[i]);
        let turned = force[i] * p.alpha * theta;
        let mut block = [[force[i]; 2]; 2];
        for c in 0..2 {
            for d in 0..2 {
                block[c][d] = force[i] * p.d_alpha[d] * p.g[c];
            }
            block[c][c] += turned;
        }
        for k in 0..6 {
            for l in 0..6 {
                let entry = &mut sums.tangent[k][l];
                *entry = entry.add_product(row[k / 2] * block[k % 2][l % 2], row[l / 2]);
            }
        }
    }
}
