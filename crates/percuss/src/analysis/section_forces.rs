//! Section forces of a state, and their extremes over the length of each beam and over time.

use crate::element::beam::ElementValues;
use crate::element::point::Strains;
use crate::element::strain::{resultants, strains};
use crate::math::hermite::{GAUSS, GAUSS_WEIGHTS};
use crate::math::vec2::{add, cross, dot};
use crate::model::Model;
use crate::model::frozen::{BeamData, MaterialPoint, Span};
use crate::state::State;
use crate::summary::{Envelope, SectionForceSummary, SectionRange};

/// Distance of the outer Gauss points from the middle, as a share of the element: `sqrt(3/5) / 2`.
const OUTER: f64 = 0.387_298_334_620_741_7;

/// Angular rates of the Gauss points at the start of a step of the given size \[rad/s, s\].
pub type Before<'a> = Option<(&'a [[f64; GAUSS]], f64)>;

/// Section forces along an element: straight lines from end to end, or a mean.
#[derive(Clone, Copy, Debug)]
pub struct ElementForces {
    /// Axial force, the mean \[N\].
    pub axial: f64,
    /// Shear force, the mean \[N\].
    pub shear: f64,
    /// Bending moment at both ends \[N m\].
    pub moment: [f64; 2],
    /// Least and largest strain of the extreme fibres at both ends \[1\]; NaN without a depth.
    pub strain: [[f64; 2]; 2],
    /// Least and largest stress of the extreme fibres at both ends \[Pa\].
    pub stress: [[f64; 2]; 2],
}

/// Nothing seen yet, one entry a beam.
pub fn unset(model: &Model) -> Vec<SectionForceSummary> {
    let entry = |beam: &BeamData| {
        let n = 2 * beam.elements.len();
        let s = model.spans[beam.spans.clone()]
            .iter()
            .flat_map(|span| span.stations.windows(2).flat_map(|w| [w[0], w[1]]))
            .collect();
        let open = || [vec![f64::NAN; n], vec![f64::NAN; n]];
        let none = SectionRange::default();
        SectionForceSummary {
            name: beam.name.clone(),
            axial: none,
            shear: none,
            moment: none,
            strain: none,
            stress: none,
            envelope: Envelope { s, axial: open(), shear: open(), moment: open(), stress: open() },
        }
    };
    model.beams.iter().map(entry).collect()
}

/// Takes the section forces of a state into the extremes so far.
pub fn update(model: &Model, state: &State, before: Before, out: &mut [SectionForceSummary]) {
    for (beam, out) in model.beams.iter().zip(out) {
        for span in &model.spans[beam.spans.clone()] {
            for k in 0..span.elements.len() {
                let forces = element(span, k, state, before);
                let index = 2 * (span.elements.start + k - beam.elements.start);
                take(out, &forces, [span.stations[k], span.stations[k + 1]], index, state.time);
            }
        }
    }
}

fn take(out: &mut SectionForceSummary, f: &ElementForces, s: [f64; 2], index: usize, time: f64) {
    let middle = 0.5 * (s[0] + s[1]);
    out.axial.take(f.axial, middle, time);
    out.shear.take(f.shear, middle, time);
    let e = &mut out.envelope;
    for end in 0..2 {
        let i = index + end;
        out.moment.take(f.moment[end], s[end], time);
        widen(&mut e.axial, i, f.axial, f.axial);
        widen(&mut e.shear, i, f.shear, f.shear);
        widen(&mut e.moment, i, f.moment[end], f.moment[end]);
        let [least, most] = f.stress[end];
        if most.is_nan() {
            continue;
        }
        widen(&mut e.stress, i, least, most);
        for value in [least, most] {
            out.stress.take(value, s[end], time);
        }
        for value in f.strain[end] {
            out.strain.take(value, s[end], time);
        }
    }
}

fn widen([min, max]: &mut [Vec<f64>; 2], i: usize, least: f64, most: f64) {
    // The first value replaces NaN.
    if least < min[i] || min[i].is_nan() {
        min[i] = least;
    }
    if most > max[i] || max[i].is_nan() {
        max[i] = most;
    }
}

/// Section forces at a point: axial, shear, moment, and the stress of larger magnitude.
pub fn at_point(model: &Model, state: &State, before: Before, point: &MaterialPoint) -> [f64; 4] {
    let (span, k) = model.element_of(point.node);
    let f = element(span, k, state, before);
    let (a, b) = (span.stations[k], span.stations[k + 1]);
    let share = ((point.s - a) / (b - a)).clamp(0.0, 1.0);
    let mix = |v: [f64; 2]| (1.0 - share) * v[0] + share * v[1];
    let stress = [0, 1].map(|side| mix([f.stress[0][side], f.stress[1][side]]));
    let largest = if stress[0].abs() > stress[1].abs() { stress[0] } else { stress[1] };
    [f.axial, f.shear, mix(f.moment), largest]
}

/// Section forces along an element.
pub fn element(span: &Span, k: usize, state: &State, before: Before) -> ElementForces {
    let (node, index) = (span.nodes.start + k, span.elements.start + k);
    let table = span.table(k);
    let u = ElementValues::new(&state.displacement[node], &state.displacement[node + 1]);
    let samples = table.membrane.as_ref().map(|samples| {
        let stored = state.strain.get(index);
        let own = || samples.strains(span.measure, &u);
        samples.interpolate(stored.map_or_else(own, |stored| stored.map(|s| s[0])))
    });
    let (mut axial, mut moment, mut turn, mut inertia) =
        ([0.0; GAUSS], [0.0; GAUSS], [0.0; GAUSS], 0.0);
    let (mut stretch, mut length) = (0.0, 0.0);
    for (j, row) in table.rows.iter().enumerate() {
        let (slope, bend) = (u.at(&row.first), add(row.bend, u.at(&row.second)));
        let mut strain = match state.strain.get(index) {
            Some(stored) => Strains { membrane: stored[j][0], bending: stored[j][1] },
            None => strains(span.measure, row.tangent, row.curvature, slope, bend),
        };
        if let Some(membrane) = &samples {
            strain.membrane = membrane[j];
        }
        let g = add(row.tangent, slope);
        let r = resultants(&row.section, &strain, g, bend);
        (axial[j], moment[j]) = (r.axial, r.moment);
        let a = dot(g, g);
        turn[j] = cross(g, bend) / a - row.curvature;
        stretch += GAUSS_WEIGHTS[j] * a.sqrt();
        length += row.weight;
        if let Some((spin, h)) = before {
            inertia +=
                GAUSS_WEIGHTS[j] * row.section.rotary * (state.spin[index][j] - spin[index][j]) / h;
        }
    }
    let ends = |v: [f64; GAUSS]| {
        let (mean, rise) = line(v);
        [mean - 0.5 * rise, mean + 0.5 * rise]
    };
    let (axial, moment, turn) = (line(axial).0, ends(moment), ends(turn));
    let shear = (inertia - (moment[1] - moment[0]) / length) / stretch;
    let fibres = |end: usize| {
        let row = &table.rows[2 * end];
        let (y, e) = (row.half_depth, row.section.axial / row.area);
        let direct = axial / row.area;
        let bending = moment[end] * y * e / row.section.bending;
        let (mean, bent) = (stretch - 1.0, turn[end] * y);
        let pair = |m: f64, b: f64| [m - b.abs(), m + b.abs()];
        (pair(mean, bent), pair(direct, bending))
    };
    let (first, last) = (fibres(0), fibres(1));
    ElementForces { axial, shear, moment, strain: [first.0, last.0], stress: [first.1, last.1] }
}

/// Mean and rise from end to end of the straight line of least squares through the values at the Gauss points.
fn line(v: [f64; GAUSS]) -> (f64, f64) {
    let mean = (0..GAUSS).map(|j| GAUSS_WEIGHTS[j] * v[j]).sum();
    (mean, (v[2] - v[0]) / (2.0 * OUTER))
}
