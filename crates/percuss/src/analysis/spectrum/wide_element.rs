//! An element in 32 digits.

use super::matrix::Stored;
use crate::element::beam::{ElementSums, ElementTable, ElementValues, GaussRow, step_point};
use crate::element::collocation;
use crate::element::membrane::{MembranePoint, MembraneTable};
use crate::element::point::{Reference, SectionLaw, Strains};
use crate::element::shear::from_stored;
use crate::model::frozen::Span;
use crate::scalar::Wide;

/// One over the bending stiffness of an element.
pub(super) fn unit(table: &ElementTable) -> Wide {
    Wide::ONE / Wide::from(table.rows[1].section.bending)
}

/// Tangent of an element at displacements `u`, with the geometric stiffness of the strains `stored`, without any if there are none.
pub(super) fn element(
    span: &Span,
    k: usize,
    a: usize,
    u: &[[f64; 4]],
    stored: Option<&Stored>,
) -> ElementSums<Wide> {
    let table = span.table(k);
    let nodal = |n: &[f64; 4]| n.map(Wide::from);
    let old = ElementValues::new(&nodal(&u[a]), &nodal(&u[a + 1]));
    let zero = [Wide::ZERO; 2];
    let still = ElementValues { chord: zero, slope_a: zero, slope_b: zero };
    if let Some(shear) = span.shear_at(k) {
        let stored = stored.map(from_stored);
        return match span.fibres {
            Some(_) => shear.tangent_with_fibres(&old, stored),
            None => shear.tangent(&old, stored),
        };
    }
    let stored = stored.unwrap_or(&[[0.0; 2]; 3]);
    let mut sums = ElementSums::zero(Wide::ZERO);
    for (row, [membrane, bending]) in table.rows.iter().zip(stored) {
        let row = widened(row);
        let strains = Strains { membrane: Wide::from(*membrane), bending: Wide::from(*bending) };
        let point = step_point(&row, &old, &still);
        sums.add::<true>(
            &row,
            &collocation::foreseeing::<Wide, true>(&row.weighed, &point, strains),
        );
    }
    if let Some(samples) = &table.membrane {
        let samples = widened_samples(samples);
        let steps = samples.step(&old, &still);
        let points = std::array::from_fn(|i| MembranePoint {
            geometric: Wide::from(stored[i][0]),
            ..steps[i].collocated(span.measure, 1.0, 0.0)
        });
        samples.add::<true>(&points, 1.0, &mut sums);
    }
    sums
}

fn widened(row: &GaussRow) -> GaussRow<Wide> {
    let w = Wide::from;
    let law = |l: &SectionLaw<f64>| SectionLaw {
        axial: w(l.axial),
        bending: w(l.bending),
        rotary: w(l.rotary),
        measure: l.measure,
    };
    GaussRow {
        first: row.first.map(w),
        second: row.second.map(w),
        weight: w(row.weight),
        reference: Reference {
            tangent: row.reference.tangent.map(w),
            bend: row.reference.bend.map(w),
            curvature: w(row.reference.curvature),
        },
        weighed: law(&row.weighed),
        section: law(&row.section),
    }
}

fn widened_samples(samples: &MembraneTable) -> MembraneTable<Wide> {
    let w = Wide::from;
    let all = |m: &[[f64; 3]; 3]| m.map(|row| row.map(w));
    MembraneTable {
        rows: all(&samples.rows),
        tangent: samples.tangent.map(|t| t.map(Wide::from)),
        // Symmetric to the last digit, which products in f64 are not.
        stiffness: std::array::from_fn(|i| {
            std::array::from_fn(|k| w(samples.stiffness[i.min(k)][i.max(k)]))
        }),
        at_gauss: all(&samples.at_gauss),
        is_nodal: samples.is_nodal,
    }
}
