//! Elements, displacements and checks that the tests of shear-flexible elements share.

use super::ShearTable;
use crate::element::beam::{ElementSums, ElementValues, NodeFrame, SectionValues, ShearedPlace};
use crate::element::point::SectionLaw;
use crate::element::strain::StrainMeasure;
use crate::math::hermite::GAUSS;
use crate::math::vec2::cross;

pub const LENGTH: f64 = 0.3;

pub const START: [f64; 6] = [0.02, -0.05, 0.1, -0.3, -0.2, 0.15];
pub const STEP: [f64; 6] = [-0.07, 0.04, 0.3, 0.2, -0.1, 0.25];

/// A section of the given stiffnesses against stretching, shear and bending, and of the given mass and rotary inertia.
pub fn section([axial, shear, bending]: [f64; 3], [mass, rotary]: [f64; 2]) -> SectionValues {
    let law = SectionLaw { axial, bending, rotary, measure: StrainMeasure::Engineering };
    let none = f64::NAN;
    SectionValues {
        law,
        shear,
        mass,
        area: none,
        inertia: none,
        young: none,
        density: none,
        half_depth: none,
        sheared: [ShearedPlace::UNKNOWN; 2],
    }
}

fn frame(position: [f64; 2], angle: f64) -> NodeFrame {
    NodeFrame { position, tangent: [angle.cos(), angle.sin()] }
}

/// A bent element that is not aligned with the axes.
pub fn bent(section: &SectionValues) -> ShearTable {
    ShearTable::new(
        LENGTH,
        [frame([0.1, -0.2], 0.4), frame([0.37, -0.08], 0.7)],
        &[*section; GAUSS],
    )
}

/// The same with a section that varies along it.
pub fn tapered(stiffness: [f64; 3], inertia: [f64; 2]) -> ShearTable {
    let at = |share: f64| section(stiffness.map(|k| share * k), inertia);
    let ends = [frame([0.1, -0.2], 0.4), frame([0.37, -0.08], 0.7)];
    ShearTable::new(LENGTH, ends, &[1.4, 1.0, 0.5].map(at))
}

/// A bar along the first axis, or an arc that turns by an angle in the reference.
pub fn bar(angle: f64, section: &SectionValues) -> ShearTable {
    let half = 0.5 * angle;
    let chord = if angle == 0.0 { LENGTH } else { LENGTH * half.sin() / half };
    ShearTable::new(
        LENGTH,
        [frame([0.0, 0.0], -half), frame([chord, 0.0], half)],
        &[*section; GAUSS],
    )
}

pub fn values([c1, c2, a1, a2, b1, b2]: [f64; 6]) -> ElementValues<f64> {
    ElementValues { chord: [c1, c2], slope_a: [a1, a2], slope_b: [b1, b2] }
}

/// Asserts that the forces of the step [`STEP`] from [`START`] have no resultant moment in its middle.
pub fn assert_no_resultant_moment(table: &ShearTable, forces: [f64; 6]) {
    let [c, a, b] = [table.chord, table.directors[0], table.directors[1]];
    let at = |x: [f64; 2], k: usize| {
        let middle = [0, 1].map(|i| x[i] + START[k + i] + 0.5 * STEP[k + i]);
        cross(middle, [forces[k], forces[k + 1]])
    };
    let parts = [at(c, 0), at(a, 2), at(b, 4)];
    let gross: f64 = parts.iter().map(|m| m.abs()).sum();
    assert!(parts.iter().sum::<f64>().abs() < 1e-14 * gross, "{parts:?}");
}

/// Asserts that the tangent of the sums of an increment, at [`STEP`], is the derivative of their forces.
pub fn assert_tangent_of_forces(sums: impl Fn([f64; 6]) -> ElementSums<f64>) {
    let tangent = sums(STEP).tangent;
    let most = tangent.as_flattened().iter().fold(0.0_f64, |m, k| m.max(k.abs()));
    for j in 0..6 {
        // Of central differences the error is of the order of the square of e, and that of round-off over e.
        let e = 1e-6;
        let beside = |by: f64| {
            let mut step = STEP;
            step[j] += by;
            sums(step).force
        };
        let (up, down) = (beside(e), beside(-e));
        for i in 0..6 {
            let found = (up[i] - down[i]) / (2.0 * e);
            assert!((tangent[i][j] - found).abs() < 1e-8 * most, "{i} {j}: {found}");
        }
    }
}
