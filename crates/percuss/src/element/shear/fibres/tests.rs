use super::*;
use crate::element::beam::SectionValues;
use crate::element::fibre::{Fibre, FibreState, Hardening, Inelasticity, Plasticity, StressLaw};
use crate::element::shear::examples::{self, *};
use crate::math::hermite::GAUSS;
use crate::math::vec2::sub;

const YOUNG: f64 = 1000.0;
/// Heights and areas, shape (fibres, 2) \[m, m^2\].
const FIBRES: [[f64; 2]; 4] = [[-0.1, 0.3], [-0.03, 0.2], [0.05, 0.25], [0.12, 0.22]];

/// Stiffness of the section against stretching and bending.
fn stiffness() -> [f64; 2] {
    [0, 2].map(|power| FIBRES.iter().map(|[y, area]| YOUNG * area * y.powi(power)).sum())
}

fn of_stiffness() -> SectionValues {
    let [axial, bending] = stiffness();
    section([axial, 150.0, bending], [2.0, 0.01])
}

/// A bent element that is not aligned with the axes.
fn bent() -> ShearTable {
    examples::bent(&of_stiffness())
}

/// A bar along the first axis, or an arc that turns by an angle in the reference.
fn bar(angle: f64) -> ShearTable {
    examples::bar(angle, &of_stiffness())
}

/// Fibres of a law in the middle of an element, with their states.
struct MiddleFibres {
    laws: [StressLaw; 1],
    fibres: [Vec<Fibre>; GAUSS],
    states: Vec<FibreState>,
}

impl MiddleFibres {
    fn new(inelasticity: Option<&Inelasticity>) -> Self {
        let all = FIBRES.map(|[height, area]| Fibre::bearing(height, area, 0)).to_vec();
        Self {
            laws: [StressLaw::new(YOUNG, inelasticity)],
            fibres: [Vec::new(), all, Vec::new()],
            states: vec![FibreState::default(); FIBRES.len()],
        }
    }

    /// Yielding at the given stress, with both kinds of hardening.
    fn yielding(stress: f64) -> Self {
        let curve = vec![Hardening { from: 0.0, stress, modulus: 30.0 }];
        let law = Plasticity { curve, kinematic: 50.0, overstress: None, failure_strain: None };
        Self::new(Some(&Inelasticity::Plastic(law)))
    }

    fn of(&self) -> ElementFibres<'_> {
        ElementFibres {
            laws: &self.laws,
            fibres: &self.fibres,
            states: &self.states,
            present: None,
        }
    }

    /// Moves the fibres to the end of a step; returns what plastic flow and viscosity dissipate per length.
    fn advance(&mut self, ends: [[f64; 2]; 2], times: (f64, f64)) -> f64 {
        let mut lost = 0.0;
        for (fibre, state) in self.fibres[MIDDLE].iter().zip(&mut self.states) {
            let strains = ends.map(|[stretch, bend]| stretch + fibre.height * bend);
            let [plastic, viscous] = self.laws[0].advance(state, strains, times);
            lost += fibre.area * (plastic + viscous);
        }
        lost
    }

    /// Stored energy of an element.
    fn energy(&self, table: &ShearTable, u: &ElementValues<f64>) -> f64 {
        let [stretch, bend] = table.strains_of_fibres(u);
        let own = self.of();
        let of_fibres: f64 = own
            .at(MIDDLE)
            .map(|(fibre, state)| {
                let law = &self.laws[0];
                let strain = stretch + fibre.height * bend;
                fibre.area * (law.elastic_energy(state, strain) + law.hardening_energy(state))
            })
            .sum();
        LENGTH * of_fibres + 0.5 * table.energies(u)[1]
    }
}

#[test]
fn fibres_measure_the_angle_of_turning_to_fourth_order() {
    let straight = bar(0.0);
    for angle in [0.8, 0.4, 0.2] {
        let arc = bar(angle);
        let to = |k: usize| sub(arc.directors[k], straight.directors[k]);
        let ([a1, a2], [b1, b2], [c1, c2]) = (to(0), to(1), sub(arc.chord, straight.chord));
        let [_, bend] = straight.strains_of_fibres(&values([c1, c2, a1, a2, b1, b2]));
        // Series of sin t (4 - cos t) / 3.
        let missed = -bend * LENGTH / angle - 1.0;
        assert!((missed / (-f64::powi(angle, 4) / 30.0) - 1.0).abs() < 0.1, "{missed:e}");
        let [_, back] = arc.strains_of_fibres(&values([-c1, -c2, -a1, -a2, -b1, -b2]));
        assert!((back + bend).abs() < 1e-13, "{back} {bend}");
    }
}

/// In any steps, however they yield, forces do the work of the stored energy and of what is lost.
#[test]
fn forces_of_steps_do_the_work_of_stored_and_dissipated_energy() {
    let table = bent();
    for stress in [None, Some(20.0), Some(80.0)] {
        for lag in [0.0, 0.3] {
            // From rest: no stress lies beyond yield at the start of a step.
            let mut held = stress.map_or_else(|| MiddleFibres::new(None), MiddleFibres::yielding);
            let mut u = [0.0; 6];
            let mut lost = 0.0;
            for k in 0..12 {
                let sign = if k % 3 == 2 { -1.3 } else { 0.7 };
                let d: [f64; 6] = std::array::from_fn(|i| sign * STEP[(i + k) % 6]);
                let (start, step) = (values(u), values(d));
                u = std::array::from_fn(|i| u[i] + d[i]);
                let end = values(u);
                let before = held.energy(&table, &start);
                let times = (1e-3, lag);
                let force = table.mean_with_fibres::<false>(&held.of(), &start, &step, times).force;
                let work: f64 = force.iter().zip(d).map(|(f, d)| f * d).sum();
                let ends = [&start, &end].map(|u| table.strains_of_fibres(u));
                let taken = LENGTH * held.advance(ends, times)
                    + lag * table.viscous_loss_across(&start, &end);
                let after = held.energy(&table, &end);
                let size = work.abs() + before + after;
                assert!((work - (after - before) - taken).abs() < 1e-12 * size, "{k}: {work:e}");
                lost += taken;
            }
            let loses = lag > 0.0 || matches!(held.laws[0], StressLaw::Plastic(_));
            assert_eq!(lost > 0.0, loses, "{lost}");
        }
    }
}

#[test]
fn forces_of_a_step_have_no_resultant_moment() {
    let (table, held) = (bent(), MiddleFibres::yielding(20.0));
    let (start, step, times) = (values(START), values(STEP), (1e-3, 0.0));
    let sums = table.mean_with_fibres::<false>(&held.of(), &start, &step, times);
    assert_no_resultant_moment(&table, sums.force);
}

#[test]
fn tangents_are_the_derivatives_of_the_forces() {
    let (table, start) = (bent(), values(START));
    for held in
        [MiddleFibres::new(None), MiddleFibres::yielding(20.0), MiddleFibres::yielding(80.0)]
    {
        let own = held.of();
        let times = (1e-3, 0.3);
        assert_tangent_of_forces(|d| {
            table.mean_with_fibres::<true>(&own, &start, &values(d), times)
        });
        assert_tangent_of_forces(|d| table.end_with_fibres::<true>(&own, &start, &values(d), None));
    }
}

/// Of fibres without flow the elastic tangent is that of the forces; its strains are those of their forces.
#[test]
fn the_elastic_tangent_has_the_geometric_stiffness_of_the_forces() {
    // Heights whose first moment vanishes: the elastic tangent has no coupling.
    let pair = [[-0.1, 0.3], [0.1, 0.3]].map(|[y, area]| Fibre::bearing(y, area, 0));
    let mut held = MiddleFibres::new(None);
    (held.fibres[MIDDLE], held.states) = (pair.to_vec(), vec![FibreState::default(); 2]);
    let [axial, bending] = [600.0, 6.0];
    let mut table = bent();
    (table.stiffness[0], table.stiffness[2]) = (axial * LENGTH, bending * LENGTH);
    let end = values(std::array::from_fn(|i| START[i] + STEP[i]));
    let strains = table.elastic_strains(&held.of(), &end);
    let [stretch, bend] = table.strains_of_fibres(&end);
    assert!((strains[0] - stretch).abs() < 1e-14 && (strains[2] + bend).abs() < 1e-13);
    let plain = table.end_with_fibres::<true>(&held.of(), &values(START), &values(STEP), None);
    let own = table.tangent_with_fibres(&end, Some(strains)).tangent;
    for (a, b) in plain.tangent.as_flattened().iter().zip(own.as_flattened()) {
        assert!((a - b).abs() < 1e-10, "{a} {b}");
    }
    // The strains of the configuration foresee nothing new.
    let linear = table.strains(&end).linear;
    let same =
        table.end_with_fibres::<true>(&held.of(), &values(START), &values(STEP), Some(linear));
    assert_eq!(plain.tangent, same.tangent);
}
