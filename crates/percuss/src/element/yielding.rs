//! An element whose sections are made of fibres: what `EA eps` and `EI kappa` are elsewhere is a sum over them.
//!
//! Membrane strains are those of [`MembraneTable`], interpolated to the Gauss points, where the fibres stand: a fibre at the height
//! y has the strain `e = eps + y kappa`, an exact function of the configuration. With the mean stress s of each fibre over the step,
//! `N = sum A s` and `M = sum A y s` act along the discrete gradients of both strains.

use super::beam::{ElementSums, ElementTable, ElementValues, GaussRow};
use super::collocation;
use super::energy_momentum::{End, PointStep, Quotients, Step};
use super::fibre::{Fibre, FibreState, StressLaw};
use super::membrane::{MembranePoint, MembraneTable, SAMPLES};
use super::point::{Form, PointResponse};
use super::strain::{StrainMeasure, strains};
use crate::math::hermite::GAUSS;
use crate::math::vec2::add;

/// Six coefficients over (chord, slope_a, slope_b) x (1, 2).
type ElementForm = [f64; 6];

/// The fibres of an element and what they remember.
#[derive(Clone, Copy, Debug)]
pub struct ElementFibres<'a> {
    /// Their laws, shape (laws of the span).
    pub laws: &'a [StressLaw],
    /// Fibres at the Gauss points, shape (Gauss points, fibres at one).
    pub fibres: &'a [Vec<Fibre>; GAUSS],
    /// What they remember at the start of the step, Gauss point after Gauss point, shape (fibres of the element).
    pub states: &'a [FibreState],
}

/// A step of an element.
#[derive(Clone, Copy, Debug)]
pub struct ElementStep<'a> {
    /// The element.
    pub table: &'a ElementTable,
    /// Its strain measure.
    pub measure: StrainMeasure,
    /// Nodal values at the start and their increments.
    pub start: &'a ElementValues<f64>,
    pub increment: &'a ElementValues<f64>,
    /// Size of the step \[s\].
    pub h: f64,
    /// Retardation time over the step size.
    pub lag: f64,
}

/// Forces of a section and their derivatives with respect to membrane and bending strain at the end.
#[derive(Clone, Copy, Debug, Default)]
struct SectionResponse {
    axial: f64,
    moment: f64,
    /// Derivatives of axial force and moment, row by row, with respect to membrane and bending strain, shape (2, 2) \[N, N m, N m^2\].
    tangent: [[f64; 2]; 2],
}

/// Membrane \[1\] and bending strain \[1/m\] at the Gauss points.
pub type GaussStrains = [[f64; 2]; GAUSS];

/// Membrane table of an element with fibres: they always have one.
fn membrane(table: &ElementTable) -> Option<&MembraneTable> {
    table.membrane.as_ref()
}

/// Strains of a configuration at the Gauss points.
pub fn gauss_strains(
    table: &ElementTable,
    measure: StrainMeasure,
    u: &ElementValues<f64>,
) -> GaussStrains {
    let samples = membrane(table).map(|m| (m.strains(measure, u), &m.at_gauss));
    std::array::from_fn(|j| {
        let row = &table.rows[j];
        let (slope, bend) = (u.at(&row.first), add(row.bend, u.at(&row.second)));
        let here = strains(measure, row.tangent, row.curvature, slope, bend);
        let sampled = samples.map(|(eps, at)| (0..SAMPLES).map(|i| at[j][i] * eps[i]).sum());
        [sampled.unwrap_or(here.membrane), here.bending]
    })
}

impl ElementFibres<'_> {
    /// Fibres at a Gauss point with what they remember.
    #[inline]
    pub fn at(&self, j: usize) -> impl Iterator<Item = (&Fibre, &FibreState)> {
        let first: usize = self.fibres[..j].iter().map(Vec::len).sum();
        self.fibres[j].iter().zip(&self.states[first..])
    }

    /// Sums over the fibres at Gauss point `j`, `value` telling stress and tangent modulus of each.
    #[inline]
    fn sum(
        &self,
        j: usize,
        value: impl Fn(&StressLaw, &Fibre, &FibreState) -> [f64; 2],
    ) -> SectionResponse {
        let mut out = SectionResponse::default();
        for (fibre, state) in self.at(j).filter(|(fibre, _)| fibre.area > 0.0) {
            let [stress, slope] = value(&self.laws[fibre.law], fibre, state);
            let (force, stiffness) = (fibre.area * stress, fibre.area * slope);
            let arm = stiffness * fibre.height;
            out.axial += force;
            out.moment += force * fibre.height;
            out.tangent[0][0] += stiffness;
            out.tangent[0][1] += arm;
            out.tangent[1][1] += arm * fibre.height;
        }
        out.tangent[1][0] = out.tangent[0][1];
        out
    }

    /// Mean forces of the section over the step.
    #[inline]
    fn mean(&self, j: usize, from: [f64; 2], to: [f64; 2], step: &ElementStep) -> SectionResponse {
        self.sum(j, |law, fibre, state| {
            let [e0, e1] = [from, to].map(|s| s[0] + fibre.height * s[1]);
            let found = law.step(state, e0, e1, step.h);
            if step.lag == 0.0 || state.failed {
                return [found.mean, found.slope];
            }
            let viscous = law.young() * step.lag;
            [found.mean + viscous * (e1 - e0), found.slope + viscous]
        })
    }

    /// Forces of the section at the end of a step that knows no time.
    #[inline]
    fn end(&self, j: usize, [membrane, bending]: [f64; 2]) -> SectionResponse {
        self.sum(j, |law, fibre, state| {
            let found = law.at_rest(state, membrane + fibre.height * bending);
            [found.stress, found.tangent]
        })
    }
}

/// Adds a form at a Gauss point to an element's.
#[inline]
fn spread(row: &GaussRow, form: &Form<f64>) -> ElementForm {
    std::array::from_fn(|i| row.first[i / 2] * form.g[i % 2] + row.second[i / 2] * form.p[i % 2])
}

/// Gradients of the membrane strains at the sampling points: that of the step, and that at its end.
fn sampled(
    table: &MembraneTable,
    points: &[MembranePoint<f64>; SAMPLES],
) -> [[ElementForm; SAMPLES]; 2] {
    let form = |i: usize, v: [f64; 2]| -> ElementForm {
        std::array::from_fn(|k| table.rows[i][k / 2] * v[k % 2])
    };
    let of = |f: &dyn Fn(usize) -> ElementForm| std::array::from_fn(f);
    [
        of(&|i| form(i, points[i].g.map(|c| c * points[i].alpha))),
        of(&|i| form(i, points[i].d_strain)),
    ]
}

/// Values at a Gauss point of what is known at the sampling points.
fn interpolated(at: &[f64; SAMPLES], forms: &[ElementForm; SAMPLES]) -> ElementForm {
    std::array::from_fn(|k| (0..SAMPLES).map(|i| at[i] * forms[i][k]).sum())
}

/// What a Gauss point adds to an element: forces along the gradients of its strains, and their tangent.
fn add_section<const TANGENT: bool>(
    sums: &mut ElementSums<f64>,
    weight: f64,
    response: &SectionResponse,
    gradients: [&ElementForm; 2],
    ends: [&ElementForm; 2],
) {
    let axial = weight * response.axial;
    for k in 0..6 {
        sums.force[k] += axial * gradients[0][k];
    }
    if !TANGENT {
        return;
    }
    for l in 0..6 {
        let [n, m] =
            response.tangent.map(|row| weight * (row[0] * ends[0][l] + row[1] * ends[1][l]));
        for k in 0..6 {
            sums.tangent[k][l] += gradients[0][k] * n + gradients[1][k] * m;
        }
    }
}

/// Tangent of the axial forces' lever arms, `force` at the sampling points.
fn add_turned(
    sums: &mut ElementSums<f64>,
    table: &MembraneTable,
    points: &[MembranePoint<f64>; SAMPLES],
    force: [f64; SAMPLES],
    theta: f64,
) {
    for (i, p) in points.iter().enumerate() {
        let row = &table.rows[i];
        for (k, l) in (0..6).flat_map(|k| (0..6).map(move |l| (k, l))) {
            let (c, d) = (k % 2, l % 2);
            let mut block = force[i] * p.d_alpha[d] * p.g[c];
            if c == d {
                block += force[i] * p.alpha * theta;
            }
            sums.tangent[k][l] += row[k / 2] * block * row[l / 2];
        }
    }
}

impl ElementStep<'_> {
    /// Strains at both ends of the step.
    pub fn strains(&self) -> [GaussStrains; 2] {
        let (a, d) = (self.start, self.increment);
        let end = ElementValues {
            chord: add(a.chord, d.chord),
            slope_a: add(a.slope_a, d.slope_a),
            slope_b: add(a.slope_b, d.slope_b),
        };
        [self.start, &end].map(|u| gauss_strains(self.table, self.measure, u))
    }

    /// Adds the forces of the invariant scheme and their tangent; `more` changes the response of a Gauss point.
    pub fn add_invariant<const TANGENT: bool>(
        &self,
        fibres: &ElementFibres,
        sums: &mut ElementSums<f64>,
        more: impl Fn(&mut PointResponse<f64>, usize),
    ) {
        let Some(samples) = membrane(self.table) else { return };
        let steps = samples.step(self.start, self.increment);
        // All weight on the end: the strain there and its gradient.
        let points = std::array::from_fn(|i| steps[i].invariant(self.measure, 0.5));
        let before = samples.strains(self.measure, self.start);
        let [gradient, end] = sampled(samples, &points);
        let mut force = [0.0; SAMPLES];
        for (j, row) in self.table.rows.iter().enumerate() {
            let at = &samples.at_gauss[j];
            let eps0: f64 = (0..SAMPLES).map(|i| at[i] * before[i]).sum();
            let eps1: f64 = (0..SAMPLES).map(|i| at[i] * points[i].strain).sum();
            let slope = self.start.at(&row.first);
            let bend = add(row.bend, self.start.at(&row.second));
            let start = End::new(self.measure, row.tangent, slope, bend);
            let way = PointStep::new(row, &start, self.increment);
            let [quotients] = Quotients::of(self.measure, &[way]);
            let step = Step::new(self.measure, &way, &quotients).bending(&row.section, &start);
            let [k0, k1] = step.strain;
            let found = fibres.mean(j, [eps0, k0], [eps1, k1], self);
            let mut response = step.response(row.weight * found.moment);
            more(&mut response, j);
            sums.add::<TANGENT>(row, &response);
            let gradients = [interpolated(at, &gradient), spread(row, &step.gradient)];
            let ends = [interpolated(at, &end), spread(row, &step.end)];
            add_section::<TANGENT>(sums, row.weight, &found, gradients.each_ref(), ends.each_ref());
            (0..SAMPLES).for_each(|i| force[i] += row.weight * at[i] * found.axial);
        }
        if TANGENT {
            add_turned(sums, samples, &points, force, 0.5);
        }
    }

    /// Adds the forces at the end of the step and their tangent, that of their lever arms with the stresses of the strains
    /// `foreseen`: at the Gauss points in bending, at the sampling points of the membrane.
    pub fn add_static<const TANGENT: bool>(
        &self,
        fibres: &ElementFibres,
        foreseen: &GaussStrains,
        sums: &mut ElementSums<f64>,
    ) {
        let Some(samples) = membrane(self.table) else { return };
        let steps = samples.step(self.start, self.increment);
        let points = std::array::from_fn(|i| steps[i].collocated(self.measure, 1.0, 0.0));
        let [gradient, end] = sampled(samples, &points);
        let [_, after] = self.strains();
        let mut force = [0.0; SAMPLES];
        for (j, row) in self.table.rows.iter().enumerate() {
            let at = &samples.at_gauss[j];
            let found = fibres.end(j, after[j]);
            let ahead = if TANGENT {
                let eps: f64 = (0..SAMPLES).map(|i| at[i] * foreseen[i][0]).sum();
                fibres.end(j, [eps, foreseen[j][1]])
            } else {
                found
            };
            let point = super::beam::step_point(row, self.start, self.increment);
            let bending = collocation::bending_at_end(&row.section, &point);
            let mut response = bending.response(row.weight * ahead.moment);
            let forces = bending.response(row.weight * found.moment);
            (response.force_g, response.force_p) = (forces.force_g, forces.force_p);
            sums.add::<TANGENT>(row, &response);
            let bent = spread(row, &bending.gradient);
            let gradients = [interpolated(at, &gradient), bent];
            let ends = [interpolated(at, &end), bent];
            add_section::<TANGENT>(sums, row.weight, &found, gradients.each_ref(), ends.each_ref());
            (0..SAMPLES).for_each(|i| force[i] += row.weight * at[i] * ahead.axial);
        }
        if TANGENT {
            add_turned(sums, samples, &points, force, 1.0);
        }
    }
}
