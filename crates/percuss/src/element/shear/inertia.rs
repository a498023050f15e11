//! The mass matrix of a shear-flexible element, by which frequencies are of fourth order in its length.
//!
//! It is that of the field inside an element ([`super::inside`]), in which D is the chord over the length, m the mean and n the difference of the
//! vectors d, and c the share of bending in `D - m`. All is linear in (x, d), so that the matrix is constant.
//!
//! Its own inertia deforms the element between its nodes further. By the equations of equilibrium, the energy of that is a quadratic form of the
//! velocities times the square of the frequency: the inertia per length `rhoA l^2/12 D.(s (D - m)) + rhoI (s n.n / 12 - c s (D - m).m)`, with the
//! share `s = 1 - c` of shear in `D - m`.

use super::inside::InsideField;
use crate::element::beam::SectionValues;
use crate::math::hermite::{GAUSS, GAUSS_WEIGHTS, gauss_points};

/// A linear form of the values of both nodes, x_a, d_a, x_b and d_b, shape (4) \[-, m, -, m\] or that over a length.
type MotionForm = [f64; 4];

/// Largest share of shear, times the mass over the rotary inertia and the square of the length: the matrix stays positive definite where that of
/// the motions alone is.
const MOST_SHEAR: f64 = 36.0;

/// Mass matrix of one component, order (x_a, d_a, x_b, d_b), from the sections at the Gauss points, shape (4, 4) \[kg, kg m, kg m^2\]: that of the
/// section in the middle, and in the field inside the element what the others have beyond it.
pub(super) fn mass(field: &InsideField, sections: &[SectionValues; GAUSS]) -> [[f64; 4]; 4] {
    let (l, middle) = (field.length, &sections[GAUSS / 2]);
    let mut mass = uniform_mass(l, middle);
    for ((xi, section), weight) in gauss_points().into_iter().zip(sections).zip(GAUSS_WEIGHTS) {
        let more = [section.mass - middle.mass, section.law.rotary - middle.law.rotary];
        for (density, form) in more.into_iter().zip([field.axis(xi), field.section(xi)]) {
            for i in 0..4 {
                for j in 0..4 {
                    mass[i][j] += weight * l * density * form[i] * form[j];
                }
            }
        }
    }
    mass
}

/// That of a uniform element.
fn uniform_mass(l: f64, section: &SectionValues) -> [[f64; 4]; 4] {
    let (along, rotary) = (section.mass * l, section.law.rotary * l);
    let softness = 12.0 * section.law.bending / (section.shear * l * l);
    let c = 1.0 / (1.0 + softness);
    let s = (softness * c).min(MOST_SHEAR * rotary / (along * l * l));
    let middle: MotionForm = [0.5, 0.0, 0.5, 0.0];
    let chord: MotionForm = [-1.0 / l, 0.0, 1.0 / l, 0.0];
    let mean: MotionForm = [0.0, 0.5, 0.0, 0.5];
    let bend: MotionForm = [0.0, -1.0, 0.0, 1.0];
    let turn: MotionForm = std::array::from_fn(|i| chord[i] - mean[i]);
    let square = along * l * l;
    let parts = [
        (along, middle, middle),
        (-along * l / 6.0, middle, bend),
        (square / 12.0, chord, chord),
        (square / 120.0, bend, bend),
        (square * c * c / 210.0, turn, turn),
        (square * (c / 30.0 + s / 12.0), chord, turn),
        (rotary, mean, mean),
        (rotary * (1.0 + s) / 12.0, bend, bend),
        (rotary * 1.2 * c * c, turn, turn),
        (rotary * c * (2.0 - s), turn, mean),
    ];
    let mut mass = [[0.0; 4]; 4];
    for (factor, a, b) in parts {
        for i in 0..4 {
            for j in 0..4 {
                mass[i][j] += 0.5 * factor * (a[i] * b[j] + a[j] * b[i]);
            }
        }
    }
    mass
}

/// Replaces the forces of inertia on the positions of both nodes by those of a linear inertia of translation with the same sum: the rest is due to
/// rotary inertia and to what inertia deforms, and is no load along the element. Accelerations and forces have the shape (2, 4) \[m/s^2, 1/s^2\]
/// and \[N, N m\].
pub fn spread_linearly(mass: &[[f64; 4]; 4], at: [&[f64; 4]; 2], on_nodes: &mut [[f64; 4]; 2]) {
    let whole = mass[0][0] + 2.0 * mass[0][2] + mass[2][2];
    let [on_a, on_b] = on_nodes;
    for i in 0..2 {
        let (sum, apart) = (on_a[i] + on_b[i], whole / 6.0 * (at[1][i] - at[0][i]));
        (on_a[i], on_b[i]) = (0.5 * (sum - apart), 0.5 * (sum + apart));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::shear::examples;

    fn section(shear: f64, bending: f64, mass: f64, rotary: f64) -> SectionValues {
        examples::section([1.0, shear, bending], [mass, rotary])
    }

    /// Pivots of the elimination of a symmetric matrix.
    fn pivots(mut m: [[f64; 4]; 4]) -> [f64; 4] {
        for k in 0..4 {
            for i in k + 1..4 {
                let factor = m[i][k] / m[k][k];
                for j in k..4 {
                    m[i][j] -= factor * m[k][j];
                }
            }
        }
        std::array::from_fn(|k| m[k][k])
    }

    #[test]
    fn every_motion_has_mass() {
        // Radius of gyration over the length, and the ratio of axial to shear stiffness: steel, timber, sandwich panels.
        for gyration in [1e-3, 0.03, 0.1, 0.3, 1.0, 30.0] {
            let square = f64::powi(gyration, 2);
            for ratio in [1e-3, 0.4, 3.06, 20.0, 1e3, 1e6] {
                let m = uniform_mass(1.0, &section(1.0 / ratio, square, 1.0, square));
                let least = pivots(m).into_iter().fold(f64::INFINITY, f64::min);
                assert!(least > 0.0, "{gyration} {ratio}: {m:?}");
            }
        }
    }

    #[test]
    fn a_bar_that_turns_has_a_linear_inertia_along_it() {
        // About its first node, at 3 rad/s^2: 2 kg/m along 0.5 m.
        let m = uniform_mass(0.5, &section(30.0, 1.0, 2.0, 0.1));
        let at = [[0.0, 0.0, 0.0, 3.0], [0.0, 1.5, 0.0, 3.0]];
        let mut on = [[0.0; 4]; 2];
        for (node, on) in on.iter_mut().enumerate() {
            let row = &m[2 * node];
            on[1] = row[0] * at[0][1] + row[1] * at[0][3] + row[2] * at[1][1] + row[3] * at[1][3];
        }
        spread_linearly(&m, [&at[0], &at[1]], &mut on);
        // The integrals of 2 * 3 s over the two linear shares.
        assert!((on[0][1] - 0.25).abs() < 1e-14 && (on[1][1] - 0.5).abs() < 1e-14, "{on:?}");
    }

    #[test]
    fn slender_elements_move_as_cubics() {
        let l = 0.7;
        let found = uniform_mass(l, &section(1e12, 1.0, 2.0, 0.0));
        let exact = crate::math::hermite::mass(l, |_| 2.0);
        for i in 0..4 {
            for j in 0..4 {
                assert!((found[i][j] - exact[i][j]).abs() < 1e-10, "{i} {j}: {found:?} {exact:?}");
            }
        }
    }
}
