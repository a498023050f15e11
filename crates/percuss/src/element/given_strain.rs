//! Strains that an element would have without forces, by heat or shrinkage: what they add to its forces and its energy.
//!
//! The energy per length is `EA (eps - eps_0)^2 / 2 + EI (kappa - kappa_0)^2 / 2`. The terms without the given strains `eps_0`, `kappa_0` are those of
//! any element; the others are here: `-EA eps_0 eps - EI kappa_0 kappa`, with forces of constant resultants, and `EA eps_0^2 / 2 + EI kappa_0^2 / 2`.
//! A curved element that expands evenly keeps its angles: in Green strains, whose bending strain is the change of the stretch times the rotation per
//! reference length, `kappa_0` contains `-eps_0` times the curvature of the reference, to first order in `eps_0`.

use super::beam::{ElementSums, ElementTable, ElementValues, GaussRow, step_point};
use super::collocation::bending_at;
use super::energy_momentum::{End, PointStep, Quotients, Step};
use super::membrane::{MembranePoint, MembraneStep, SAMPLES};
use super::shear::ShearTable;
use super::strain::{StrainMeasure, strains};
use crate::math::hermite::GAUSS;

/// Given strains of an element.
#[derive(Clone, Copy, Debug)]
pub struct GivenStrain<'a> {
    /// The element.
    pub table: &'a ElementTable,
    /// Its own strains and stiffnesses, if it is shear-flexible.
    pub shear: Option<&'a ShearTable>,
    /// Strain measure of its material.
    pub measure: StrainMeasure,
    /// Membrane strain without forces \[-\].
    pub strain: f64,
    /// Bending strain without forces \[1/m\].
    pub bending: f64,
}

/// Where in a step forces are evaluated: by the discrete gradient of the invariant scheme, or at a share of the step.
#[derive(Clone, Copy, Debug)]
pub enum Evaluation {
    /// The discrete gradient.
    Discrete,
    /// The gradient at this share of the step.
    At(f64),
}

impl Evaluation {
    /// Weight of the end of the step in the configuration of evaluation.
    fn theta(self) -> f64 {
        match self {
            Self::Discrete => 0.5,
            Self::At(theta) => theta,
        }
    }

    fn membrane(self, measure: StrainMeasure, step: &MembraneStep<f64>) -> MembranePoint<f64> {
        match self {
            Self::Discrete => step.invariant(measure, None),
            Self::At(theta) => step.collocated(measure, theta, 0.0),
        }
    }
}

impl GivenStrain<'_> {
    /// Stretch and bend of a shear-flexible element, whose bend is positive where its sections turn counterclockwise, shape (2) \[-, 1/m\].
    fn stretch_and_bend(&self) -> [f64; 2] {
        [self.strain, -self.bending]
    }

    /// Bending strain without forces at a Gauss point: what is given, and that of an even expansion of a curved element \[1/m\].
    fn bending_at(&self, row: &GaussRow) -> f64 {
        match self.measure {
            StrainMeasure::Green => self.bending - self.strain * row.reference.curvature,
            StrainMeasure::Engineering => self.bending,
        }
    }

    /// Resultants at the sampling points of the membrane, `int EA L_i eps_0 ds` \[N m\].
    fn sampled(&self) -> Option<[f64; SAMPLES]> {
        let samples = self.table.membrane.as_ref()?;
        Some(samples.stiffness.map(|row| self.strain * row.iter().sum::<f64>()))
    }

    /// Forces over a step from the displacements `start`, with their tangent if `TANGENT`.
    pub fn forces<const TANGENT: bool>(
        &self,
        evaluation: Evaluation,
        start: &ElementValues<f64>,
        increment: &ElementValues<f64>,
    ) -> ElementSums<f64> {
        let Self { table, measure, .. } = *self;
        let theta = evaluation.theta();
        if let Some(shear) = self.shear {
            return shear.relieved::<TANGENT>(start, increment, theta, self.stretch_and_bend());
        }
        let mut sums = ElementSums::zero(0.0);
        match (&table.membrane, self.sampled()) {
            (Some(samples), Some(forces)) => {
                for (i, step) in samples.step(start, increment).iter().enumerate() {
                    let point = evaluation.membrane(measure, step);
                    add::<TANGENT>(-forces[i], &point, &samples.rows[i], theta, &mut sums);
                }
            }
            _ => {
                for row in &table.rows {
                    let (slope_0, d_slope) = (start.at(&row.first), increment.at(&row.first));
                    let tangent = row.reference.tangent;
                    let step = MembraneStep { tangent, slope_0, d_slope };
                    let point = evaluation.membrane(measure, &step);
                    let force = -row.weighed.axial * self.strain;
                    add::<TANGENT>(force, &point, &row.first, theta, &mut sums);
                }
            }
        }
        if table.rows.iter().any(|row| self.bending_at(row) != 0.0) {
            self.add_moments::<TANGENT>(evaluation, start, increment, &mut sums);
        }
        sums
    }

    fn add_moments<const TANGENT: bool>(
        &self,
        evaluation: Evaluation,
        start: &ElementValues<f64>,
        increment: &ElementValues<f64>,
        sums: &mut ElementSums<f64>,
    ) {
        let Self { table, measure, .. } = *self;
        let starts: [End<f64>; GAUSS] = End::all(measure, &table.rows, start);
        for (row, start_of) in table.rows.iter().zip(&starts) {
            let moment = -row.weighed.bending * self.bending_at(row);
            let response = match evaluation {
                Evaluation::Discrete => {
                    let way = [PointStep::new(row, start_of, increment)];
                    let [quotients] = Quotients::of(measure, &way);
                    let step = Step::new(measure, &way[0], &quotients);
                    step.bending(&row.weighed, start_of).response(moment)
                }
                Evaluation::At(theta) => {
                    let point = step_point(row, start, increment);
                    bending_at(&row.weighed, &point, theta).response(moment)
                }
            };
            sums.add::<TANGENT>(row, &response);
        }
    }

    /// What the given strains add to the axial and to the bending strain energy of a configuration, shape (2) \[J\].
    pub fn energy(&self, u: &ElementValues<f64>) -> [f64; 2] {
        let Self { table, measure, strain, .. } = *self;
        if let Some(shear) = self.shear {
            return shear.energy_relieved(u, self.stretch_and_bend());
        }
        let (mut axial, mut bent) = (0.0, 0.0);
        for row in &table.rows {
            let s = strains(measure, &row.reference, u.at(&row.first), u.at(&row.second));
            let bending = self.bending_at(row);
            axial += row.weighed.axial * strain * (0.5 * strain - s.membrane);
            bent += row.weighed.bending * bending * (0.5 * bending - s.bending);
        }
        if let (Some(samples), Some(forces)) = (&table.membrane, self.sampled()) {
            for (force, own) in forces.iter().zip(samples.strains(measure, u)) {
                axial += force * (0.5 * strain - own);
            }
        }
        [axial, bent]
    }
}

/// Adds a force on a membrane strain, with the tangent of its lever arm if `TANGENT`.
fn add<const TANGENT: bool>(
    force: f64,
    point: &MembranePoint<f64>,
    row: &[f64; 3],
    theta: f64,
    sums: &mut ElementSums<f64>,
) {
    let MembranePoint { alpha, g, d_alpha, .. } = *point;
    for l in 0..3 {
        for c in 0..2 {
            sums.force[2 * l + c] += force * alpha * g[c] * row[l];
        }
    }
    if !TANGENT {
        return;
    }
    for c in 0..2 {
        for d in 0..2 {
            let same = if c == d { alpha * theta } else { 0.0 };
            let block = force * (g[c] * d_alpha[d] + same);
            for l in 0..3 {
                for r in 0..3 {
                    sums.tangent[2 * l + c][2 * r + d] += block * row[l] * row[r];
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::beam::{NodeFrame, SectionValues, ShearedPlace};
    use super::super::point::SectionLaw;
    use super::*;

    const MEASURES: [StrainMeasure; 2] = [StrainMeasure::Green, StrainMeasure::Engineering];

    /// A slightly curved element, short or long against its radius of gyration, slender and flexible in shear.
    fn tables(measure: StrainMeasure, axial: f64) -> (ElementTable, ShearTable) {
        let law = SectionLaw { axial, bending: 3.0, rotary: 0.1, measure };
        let [area, inertia, young, density, half_depth] = [1.0, 1.0, 1.0, 1.0, 0.1];
        let (mass, shear) = (2.0, 30.0);
        let sheared = [ShearedPlace::UNKNOWN; 2];
        let values =
            SectionValues { law, mass, area, inertia, young, density, half_depth, shear, sheared };
        let end = |x: f64, angle: f64| NodeFrame {
            position: [x, 0.1 * x],
            tangent: [angle.cos(), angle.sin()],
        };
        let ends = [end(0.0, 0.05), end(1.04, 0.2)];
        let slender = ElementTable::new(1.05, ends, false, |_| values);
        (slender, ShearTable::new(1.05, ends, &[values; 3]))
    }

    fn values(v: [f64; 6]) -> ElementValues<f64> {
        ElementValues { chord: [v[0], v[1]], slope_a: [v[2], v[3]], slope_b: [v[4], v[5]] }
    }

    const START: [f64; 6] = [0.02, -0.03, 0.05, 0.1, -0.04, 0.07];
    const STEP: [f64; 6] = [-0.05, 0.3, -0.2, 0.4, 0.1, 0.35];

    fn each(mut see: impl FnMut(GivenStrain<'_>)) {
        for measure in MEASURES {
            // Of the second the membrane is sampled at the nodes.
            for axial in [40.0, 2e5] {
                let (table, shear) = tables(measure, axial);
                assert_eq!(table.membrane.is_some(), axial > 1e3);
                for shear in [None, Some(&shear)] {
                    let (strain, bending) = (0.03, -0.2);
                    see(GivenStrain { table: &table, shear, measure, strain, bending });
                }
            }
        }
    }

    /// Over any step the forces do the work by which their energy decreases.
    #[test]
    fn discrete_forces_do_the_work_of_the_energy() {
        each(|given| {
            let (start, step) = (values(START), values(STEP));
            let end = values(std::array::from_fn(|i| START[i] + STEP[i]));
            let force = given.forces::<false>(Evaluation::Discrete, &start, &step).force;
            let work: f64 = force.iter().zip(STEP).map(|(f, d)| f * d).sum();
            let sum = |u| given.energy(u).iter().sum::<f64>();
            let change = sum(&end) - sum(&start);
            let size = given.table.rows[1].section.axial * 0.03;
            assert!((work - change).abs() < 1e-12 * size, "{given:?}: {work} {change}");
        });
    }

    /// A curved element that has expanded as it would without forces has none, to the square of the strain.
    #[test]
    fn even_expansion_of_a_curved_element_needs_no_force() {
        for measure in MEASURES {
            for axial in [40.0, 2e5] {
                let (table, _) = tables(measure, axial);
                assert!(table.rows[1].reference.curvature.abs() > 0.1);
                let strain = 1e-5;
                let nodes = [0.0, 1.0].map(|end: f64| (0.05 + 0.15 * end).sin_cos());
                let [slope_a, slope_b] = nodes.map(|(sin, cos)| [strain * cos, strain * sin]);
                let expanded =
                    ElementValues { chord: [1.04 * strain, 0.104 * strain], slope_a, slope_b };
                let given =
                    GivenStrain { table: &table, shear: None, measure, strain, bending: 0.0 };
                let own = |row: &GaussRow| {
                    strains(
                        measure,
                        &row.reference,
                        expanded.at(&row.first),
                        expanded.at(&row.second),
                    )
                };
                for row in &table.rows {
                    let left = own(row).bending - given.bending_at(row);
                    assert!(left.abs() < 1e-4 * strain * row.reference.curvature.abs(), "{left}");
                }
            }
        }
    }

    #[test]
    fn forces_at_a_configuration_are_the_gradient_of_the_energy() {
        each(|given| {
            let (start, step) = (values(START), values(STEP));
            let force = given.forces::<false>(Evaluation::At(1.0), &start, &step).force;
            for i in 0..6 {
                let at = |e: f64| {
                    let mut u: [f64; 6] = std::array::from_fn(|k| START[k] + STEP[k]);
                    u[i] += e;
                    given.energy(&values(u)).iter().sum::<f64>()
                };
                let slope = (at(1e-6) - at(-1e-6)) / 2e-6;
                let size = given.table.rows[1].section.axial * 0.03;
                assert!((force[i] - slope).abs() < 1e-7 * size, "{i}: {} {slope}", force[i]);
            }
        });
    }

    #[test]
    fn tangents_are_derivatives_of_the_forces() {
        each(|given| {
            for evaluation in [Evaluation::Discrete, Evaluation::At(0.5), Evaluation::At(1.0)] {
                let start = values(START);
                let of = |step| given.forces::<true>(evaluation, &start, &values(step));
                let found = of(STEP);
                for j in 0..6 {
                    let at = |e: f64| {
                        let mut step = STEP;
                        step[j] += e;
                        of(step).force
                    };
                    let (above, below) = (at(1e-6), at(-1e-6));
                    let size = given.table.rows[1].section.axial * 0.03;
                    for i in 0..6 {
                        let slope = (above[i] - below[i]) / 2e-6;
                        let own = found.tangent[i][j];
                        assert!((own - slope).abs() < 1e-6 * size, "{i}{j}: {own} {slope}");
                    }
                }
            }
        });
    }
}
