//! Largest section forces of a run, over the length of each beam and over time.

use crate::element::beam::ElementValues;
use crate::element::point::Strains;
use crate::element::strain::{resultants, strains};
use crate::math::hermite::{GAUSS, GAUSS_WEIGHTS};
use crate::math::vec2::{add, dot};
use crate::model::Model;
use crate::model::frozen::BeamData;
use crate::state::State;
use crate::summary::{SectionForceSummary, SectionPeak};

/// Distance of the outer Gauss points from the middle, as a share of the element: `sqrt(3/5) / 2`.
const OUTER: f64 = 0.387_298_334_620_741_7;

/// Largest section forces so far, one entry a beam.
pub fn unset(model: &Model) -> Vec<SectionForceSummary> {
    let entry = |beam: &BeamData| SectionForceSummary {
        name: beam.name.clone(),
        axial_max: SectionPeak::default(),
        shear_max: SectionPeak::default(),
        moment_max: SectionPeak::default(),
    };
    model.beams.iter().map(entry).collect()
}

/// Takes the section forces of a state into the largest so far.
pub fn update(model: &Model, state: &State, largest: &mut [SectionForceSummary]) {
    for (beam, out) in model.beams.iter().zip(largest) {
        for k in 0..beam.elements.len() {
            update_element(beam, state, k, out);
        }
    }
}

fn update_element(beam: &BeamData, state: &State, k: usize, out: &mut SectionForceSummary) {
    let (node, element) = (beam.nodes.start + k, beam.elements.start + k);
    let table = &beam.table;
    let u = ElementValues::new(&state.displacement[node], &state.displacement[node + 1]);
    let (mut axial, mut moment, mut stretch) = ([0.0; GAUSS], [0.0; GAUSS], 0.0);
    for j in 0..GAUSS {
        let (slope, bend) = (u.at(&table.rows[j].first), u.at(&table.rows[j].second));
        let strain = match state.strain.get(element) {
            Some(stored) => Strains { membrane: stored[j][0], bending: stored[j][1] },
            None => strains(beam.law.measure, table.tangent, 0.0, slope, bend),
        };
        let g = add(table.tangent, slope);
        let r = resultants(&beam.law, &strain, g, bend);
        (axial[j], moment[j]) = (r.axial, r.moment);
        stretch += dot(g, g).sqrt() / GAUSS as f64;
    }
    // Straight line of least squares through the three points; the axial force, which a bent cubic element scatters about
    // its mean, by that mean.
    let mean = |v: [f64; GAUSS]| (0..GAUSS).map(|j| GAUSS_WEIGHTS[j] * v[j]).sum::<f64>();
    let (m, dm) = (mean(moment), (moment[2] - moment[0]) / (2.0 * OUTER));
    let start = k as f64 * table.length;
    let take = |peak: &mut SectionPeak, value: f64, share: f64| {
        if value.abs() > peak.value.abs() || peak.value.is_nan() {
            *peak = SectionPeak { value, s: start + share * table.length, time: state.time };
        }
    };
    take(&mut out.moment_max, m - 0.5 * dm, 0.0);
    take(&mut out.moment_max, m + 0.5 * dm, 1.0);
    take(&mut out.axial_max, mean(axial), 0.5);
    take(&mut out.shear_max, -dm / (table.length * stretch), 0.5);
}
