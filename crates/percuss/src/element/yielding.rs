//! An element with fibre sections: `EA eps` and `EI kappa` of elastic elements are replaced by sums over fibres.
//!
//! Membrane strains are those of [`MembraneTable`] at the Gauss points of the fibres: a fibre at the height y has the strain `e = eps + y kappa`,
//! an exact function of the configuration. With the mean stress s of each fibre over the step, `N = sum A s` and `M = sum A y s` act along the
//! discrete gradients of both strains.

mod forms;

use super::beam::{ElementSums, ElementTable, ElementValues};
use super::collocation;
use super::energy_momentum::{End, PointStep, Quotients, Step};
use super::fibre::{Fibre, FibreState, StressLaw};
use super::membrane::{MembraneTable, SAMPLES};
use super::strain::{StrainMeasure, strains};
use crate::math::hermite::GAUSS;
use crate::math::vec2::{add, dot};
use crate::scalar::{Mask, Number, Real, Task, array};
use forms::{add_turned, interpolate, interpolated, sampled, spread};

pub use forms::{ElementForm, SectionResponse, add_section};

/// The fibres of an element and their state variables.
#[derive(Clone, Copy, Debug)]
pub struct ElementFibres<'a, S = f64> {
    /// Their laws, shape (laws of the span).
    pub laws: &'a [StressLaw<S>],
    /// Fibres at the Gauss points, shape (Gauss points, fibres at one); of a shear-flexible element at the second one, its middle, alone.
    pub fibres: &'a [Vec<Fibre<S>>; GAUSS],
    /// State variables at the start of the step, Gauss point after Gauss point, shape (fibres of the element).
    pub states: &'a [FibreState<S>],
    /// Of elements side by side, one in each lane that has an element and zero in the others, if there are any: without strain these take no time.
    pub present: Option<S>,
}

/// A step of an element.
#[derive(Clone, Copy, Debug)]
pub struct ElementStep<'a, S = f64> {
    /// The element.
    pub table: &'a ElementTable<S>,
    /// Its strain measure.
    pub measure: StrainMeasure,
    /// Nodal values at the start and their increments.
    pub start: &'a ElementValues<S>,
    pub increment: &'a ElementValues<S>,
    /// Size of the step \[s\].
    pub h: S,
    /// Retardation time over the step size.
    pub lag: S,
}

/// Rotation of the tangents at the Gauss points of an element in a step of the invariant scheme.
#[derive(Clone, Copy, Debug)]
pub struct ElementTurn<'a, S> {
    /// Its Gauss points at the start, shape (Gauss points).
    pub starts: &'a [End<S>; GAUSS],
    /// Angular rates of their tangents at the start, shape (Gauss points) \[rad/s\].
    pub spin: &'a [S; GAUSS],
    /// One over the size of the step \[1/s\].
    pub rate: S,
    /// Mass-proportional damping \[1/s\].
    pub damping: S,
}

/// Stored energies of the fibres of an element.
#[derive(Clone, Copy, Debug)]
pub struct FibreEnergies<S> {
    /// Elastic energy of the axial forces \[J\].
    pub stretching: S,
    /// Elastic energy of all stresses \[J\].
    pub elastic: S,
    /// Stored by hardening \[J\].
    pub hardening: S,
}

/// Membrane \[-\] and bending strain \[1/m\] at the Gauss points.
pub type GaussStrains<S = f64> = [[S; 2]; GAUSS];

/// Membrane table of an element with fibres: they always have one.
#[inline(always)]
fn membrane<S>(table: &ElementTable<S>) -> Option<&MembraneTable<S>> {
    table.membrane.as_ref()
}

/// Strains of a configuration at the Gauss points.
#[inline(always)]
pub fn gauss_strains<S: Real>(
    table: &ElementTable<S>,
    measure: StrainMeasure,
    u: &ElementValues<S>,
) -> GaussStrains<S> {
    let mut out = [[table.length; 2]; GAUSS];
    for j in 0..GAUSS {
        let row = &table.rows[j];
        let here = strains(measure, &row.reference, u.at(&row.first), u.at(&row.second));
        out[j] = [here.membrane, here.bending];
    }
    if let Some(samples) = membrane(table) {
        let sampled = samples.strains(measure, u);
        for j in 0..GAUSS {
            out[j][0] = interpolate(&samples.at_gauss[j], &sampled);
        }
    }
    out
}

impl<S: Number> ElementFibres<'_, S> {
    /// Fibres at a Gauss point with their state variables.
    #[inline(always)]
    pub fn at(&self, j: usize) -> impl Iterator<Item = (&Fibre<S>, &FibreState<S>)> {
        let mut first = 0;
        for before in &self.fibres[..j] {
            first += before.len();
        }
        self.fibres[j].iter().zip(&self.states[first..])
    }

    /// Strains where there is an element.
    #[inline(always)]
    pub fn strained(&self, strains: [S; 2]) -> [S; 2] {
        match self.present {
            Some(present) => [strains[0] * present, strains[1] * present],
            None => strains,
        }
    }

    /// Their stored energies at the current strains.
    #[inline(always)]
    pub fn energies(&self, table: &ElementTable<S>, strains: &GaussStrains<S>) -> FibreEnergies<S> {
        let none = table.length.constant(0.0);
        let mut out = FibreEnergies { stretching: none, elastic: none, hardening: none };
        for j in 0..GAUSS {
            if self.fibres[j].is_empty() {
                continue; // a shear-flexible element has fibres in its middle alone
            }
            let (weight, [membrane, bending]) = (table.rows[j].weight, strains[j]);
            let (mut force, mut stiffness) = (none, none);
            for (fibre, state) in self.at(j) {
                let law = &self.laws[fibre.law];
                let (strain, volume) = (membrane + fibre.height * bending, fibre.area * weight);
                let elastic = law.elastic_energy(state, strain);
                out.elastic = out.elastic.add_product(volume, elastic);
                out.hardening = out.hardening.add_product(volume, law.hardening_energy(state));
                force = force.add_product(fibre.area, law.stress(state, strain));
                stiffness = stiffness.add_product(fibre.area, law.young());
            }
            out.stretching += weight * force * force / stiffness * 0.5;
        }
        out
    }

    /// Mean forces of the section over a step, from membrane and bending strain at its ends and their change from the increment; the last are the
    /// size of the step \[s\] and the retardation time over it.
    #[inline(always)]
    pub fn mean(
        &self,
        j: usize,
        [from, to, change]: [[S; 2]; 3],
        (h, lag): (S, S),
    ) -> SectionResponse<S> {
        let none = h.constant(0.0);
        let viscous = none.less(lag).any();
        let [from, to, change] = [from, to, change].map(|strains| self.strained(strains));
        let mut out = SectionResponse::zero(none);
        for (fibre, state) in self.at(j) {
            if !fibre.carries_force {
                continue;
            }
            let law = &self.laws[fibre.law];
            let e0 = from[0] + fibre.height * from[1];
            let e1 = to[0] + fibre.height * to[1];
            let mut found = law.step(state, e0, e1, h);
            if viscous && !state.failed {
                let strained = [e0, e1, change[0] + fibre.height * change[1]];
                let [own, rise] = law.viscous(state, strained, lag, [found.mean, found.slope]);
                found.mean += own;
                found.slope += rise;
            }
            out.add(fibre, found.mean, found.slope);
        }
        out.close()
    }
}

impl ElementFibres<'_> {
    /// Forces of the section at the end of a rate-independent step.
    pub fn end(&self, j: usize, [membrane, bending]: [f64; 2]) -> SectionResponse<f64> {
        let mut out = SectionResponse::zero(0.0);
        for (fibre, state) in self.at(j).filter(|(fibre, _)| fibre.carries_force) {
            let strain = membrane + fibre.height * bending;
            let law = &self.laws[fibre.law];
            let found = law.at_rest(state, strain);
            // A fibre at its limit has the tangent of further loading, whether it reached the limit in this step or before.
            out.add(fibre, found.stress, law.loading_tangent(&found));
        }
        out.close()
    }
}

impl<S: Number> ElementStep<'_, S> {
    /// Strains at both ends of the step.
    #[inline(always)]
    pub fn strains(&self) -> [GaussStrains<S>; 2] {
        let (a, d) = (self.start, self.increment);
        let end = ElementValues {
            chord: add(a.chord, d.chord),
            slope_a: add(a.slope_a, d.slope_a),
            slope_b: add(a.slope_b, d.slope_b),
        };
        let start = gauss_strains(self.table, self.measure, self.start);
        [start, gauss_strains(self.table, self.measure, &end)]
    }

    /// Forces of the invariant scheme but for the inertia of translation, their tangent if `TANGENT`, and the angular rates at the end
    /// of the step.
    #[inline(always)]
    pub fn sums<const TANGENT: bool>(
        &self,
        fibres: &ElementFibres<S>,
        turn: &ElementTurn<S>,
    ) -> (ElementSums<S>, [S; GAUSS]) {
        self.h.apart(Invariant::<S, TANGENT> { step: self, fibres, turn })
    }

    #[inline(always)]
    fn sums_here<const TANGENT: bool>(
        &self,
        fibres: &ElementFibres<S>,
        turn: &ElementTurn<S>,
    ) -> (ElementSums<S>, [S; GAUSS]) {
        let (mut sums, mut spin) = (ElementSums::zero(self.h), *turn.spin);
        let Some(samples) = membrane(self.table) else { return (sums, spin) };
        let (measure, rows, starts) = (self.measure, &self.table.rows, turn.starts);
        let steps = samples.step(self.start, self.increment);
        let [[b0, p0], [b1, p1], [b2, p2]] =
            [steps[0].at_ends(measure), steps[1].at_ends(measure), steps[2].at_ends(measure)];
        let points = [p0, p1, p2];
        let (before, after) =
            ([b0.strain, b1.strain, b2.strain], [p0.strain, p1.strain, p2.strain]);
        let changes = array(|i| points[i].alpha * dot(points[i].g, steps[i].d_slope));
        let [gradient, end] = sampled(samples, &points);
        let ways = [
            PointStep::new(&rows[0], &starts[0], self.increment),
            PointStep::new(&rows[1], &starts[1], self.increment),
            PointStep::new(&rows[2], &starts[2], self.increment),
        ];
        let quotients = Quotients::of(measure, &ways);
        let mut force = [self.h.constant(0.0); SAMPLES];
        for j in 0..GAUSS {
            let (row, at) = (&rows[j], &samples.at_gauss[j]);
            let (eps0, eps1) = (interpolate(at, &before), interpolate(at, &after));
            let new = Step::new(measure, &ways[j], &quotients[j]);
            let step = new.bending(&row.section, &starts[j]);
            let [k0, k1] = step.strain;
            let change = [interpolate(at, &changes), step.change];
            let found = fibres.mean(j, [[eps0, k0], [eps1, k1], change], (self.h, self.lag));
            let mut response = step.response(row.weight * found.moment);
            let (rotary, rate) = (row.weighed.rotary, turn.rate);
            new.turn.add_inertia::<TANGENT>(&mut response, rotary, spin[j], rate, turn.damping);
            spin[j] = new.turn.end_spin(rate, spin[j]);
            sums.add::<TANGENT>(row, &response);
            let gradients = [&interpolated(at, &gradient), &spread(row, &step.gradient)];
            let ends = [&interpolated(at, &end), &spread(row, &step.end)];
            add_section::<S, TANGENT>(&mut sums, row.weight, &found, gradients, ends);
            for i in 0..SAMPLES {
                force[i] = force[i].add_product(row.weight * at[i], found.axial);
            }
        }
        if TANGENT {
            add_turned(&mut sums, samples, &points, force, 0.5);
        }
        (sums, spin)
    }
}

/// See [`ElementStep::sums`].
struct Invariant<'a, S, const TANGENT: bool> {
    step: &'a ElementStep<'a, S>,
    fibres: &'a ElementFibres<'a, S>,
    turn: &'a ElementTurn<'a, S>,
}

impl<S: Number, const TANGENT: bool> Task for Invariant<'_, S, TANGENT> {
    type Output = (ElementSums<S>, [S; GAUSS]);
    #[inline(always)]
    fn run(self) -> Self::Output {
        self.step.sums_here::<TANGENT>(self.fibres, self.turn)
    }
}

impl ElementStep<'_> {
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
            add_section::<f64, TANGENT>(
                sums,
                row.weight,
                &found,
                gradients.each_ref(),
                ends.each_ref(),
            );
            (0..SAMPLES).for_each(|i| force[i] += row.weight * at[i] * ahead.axial);
        }
        if TANGENT {
            add_turned(sums, samples, &points, force, 1.0);
        }
    }
}
