//! Stress and strain of the extreme fibres.

use crate::element::beam::{ElementValues, SectionValues};
use crate::element::point::SectionLaw;
use crate::element::strain::strains;
use crate::math::hermite::{GAUSS, GAUSS_WEIGHTS};
use crate::math::vec2::{add, dot};
use crate::model::StrainMeasure;
use crate::model::frozen::Span;
use crate::state::State;

use super::line::SectionForces;

/// Distance of the outer Gauss points from the middle, as a share of the element: `sqrt(3/5) / 2`.
const OUTER: f64 = 0.387_298_334_620_741_7;
/// Strains up to here go with forces in proportion, to seven digits and more.
const SMALL: f64 = 1e-8;

/// Least and largest strain and stress of a section.
#[derive(Clone, Copy, Debug)]
pub struct Fibres {
    /// Least and largest strain, shape (2) \[-\].
    pub strain: [f64; 2],
    /// Least and largest stress, shape (2) \[Pa\].
    pub stress: [f64; 2],
}

/// Stretch less one, and turn of the tangent per length beyond that of the reference \[1/m\].
#[derive(Clone, Copy, Debug)]
pub struct Strained {
    pub stretch: f64,
    pub turn: f64,
}

/// Fibres of a section, `strained` if that does not follow from its forces.
pub fn fibres(
    section: &SectionValues,
    curvature: f64,
    forces: &SectionForces,
    strained: Option<Strained>,
) -> Fibres {
    let y = section.half_depth;
    let pair = |mean: f64, bent: f64| [mean - bent.abs(), mean + bent.abs()];
    let bent = forces.moment * y / section.inertia;
    let Strained { stretch, turn } =
        strained.unwrap_or_else(|| strained_by(&section.law, curvature, forces));
    Fibres { strain: pair(stretch, turn * y), stress: pair(forces.axial / section.area, bent) }
}

/// Stresses of an elastic section at the top and at the bottom, `N/A -+ M y/I`, shape (2) \[Pa\]: a positive moment stretches the
/// bottom, to the right of the beam's direction.
pub fn faces(section: &SectionValues, forces: &SectionForces) -> [f64; 2] {
    let mean = forces.axial / section.area;
    let bent = forces.moment * section.half_depth / section.inertia;
    [mean - bent, mean + bent]
}

/// What the section law says of an elastic section under the given forces: stretch and turn from the
/// derivatives of its strain energy.
fn strained_by(law: &SectionLaw<f64>, curvature: f64, forces: &SectionForces) -> Strained {
    let (axial, moment) = (forces.axial / law.axial, forces.moment / law.bending);
    let straight = Strained { stretch: axial, turn: moment };
    let coupled = forces.moment * (moment.abs() + curvature.abs()) / law.axial;
    if law.measure == StrainMeasure::Engineering || axial.abs() + coupled.abs() <= SMALL {
        return straight;
    }
    // Green: `N = EA nu (nu^2 - 1) / 2 + M theta' / nu`, `theta' = (kappa0 + M / (EI nu)) / nu`.
    let couple = forces.moment / law.axial;
    let mut e = axial;
    for _ in 0..20 {
        let nu = 1.0 + e;
        let turn = (curvature + moment / nu) / nu;
        let miss = 0.5 * nu * e * (2.0 + e) + couple * turn / nu - axial;
        let slope = 1.5 * nu * nu - 0.5 - couple * (2.0 * turn + moment / (nu * nu)) / (nu * nu);
        if slope <= 0.0 {
            break; // beyond what Green strains carry
        }
        let step = miss / slope;
        e -= step;
        if step.abs() <= 1e-15 + 1e-13 * e.abs() {
            let nu = 1.0 + e;
            return Strained { stretch: e, turn: (curvature + moment / nu) / nu - curvature };
        }
    }
    straight
}

/// Strains of an element's configuration: stretch, and turn as a straight line, at both ends.
pub fn strained(span: &Span, k: usize, state: &State) -> [Strained; 2] {
    let node = span.nodes.start + k;
    let u = ElementValues::new(&state.displacement[node], &state.displacement[node + 1]);
    let (mut stretch, mut turn) = (0.0, [0.0; GAUSS]);
    for (j, row) in span.table(k).rows.iter().enumerate() {
        let (slope, bend) = (u.at(&row.first), u.at(&row.second));
        let g = add(row.reference.tangent, slope);
        let a = dot(g, g);
        turn[j] = -strains(StrainMeasure::Engineering, &row.reference, slope, bend).bending;
        stretch += GAUSS_WEIGHTS[j] * a.sqrt();
    }
    // The straight line of least squares through the values at the Gauss points.
    let mean: f64 = (0..GAUSS).map(|j| GAUSS_WEIGHTS[j] * turn[j]).sum();
    let half = (turn[2] - turn[0]) / (4.0 * OUTER);
    [-half, half].map(|more| Strained { stretch: stretch - 1.0, turn: mean + more })
}

#[cfg(test)]
mod tests {
    use super::super::line::Rise;
    use super::*;
    use crate::element::point::Reference;

    #[test]
    fn strains_of_an_elastic_section_are_those_whose_energy_has_its_forces_as_derivatives() {
        for measure in [StrainMeasure::Green, StrainMeasure::Engineering] {
            let law = SectionLaw { axial: 500.0, bending: 4.0, rotary: 0.0, measure };
            let curvature = 0.3;
            let energy = |nu: f64, turn: f64| {
                let reference =
                    Reference { tangent: [1.0, 0.0], bend: [0.0, curvature], curvature };
                let s = strains(measure, &reference, [nu - 1.0, 0.0], [0.1, nu * turn - curvature]);
                0.5 * law.axial * s.membrane.powi(2) + 0.5 * law.bending * s.bending.powi(2)
            };
            for (nu, turn) in [(1.0, 0.3), (1.1, 0.7), (0.95, -0.4), (1.0 + 1e-7, 0.31)] {
                let h = 1e-5;
                let axial = (energy(nu + h, turn) - energy(nu - h, turn)) / (2.0 * h);
                let moment = (energy(nu, turn + h) - energy(nu, turn - h)) / (2.0 * h);
                let rise = Rise { axial: 0.0, shear: 0.0, moment: 0.0 };
                let forces = SectionForces { axial, shear: 0.0, moment, rise };
                let found = strained_by(&law, curvature, &forces);
                // Differences of energies know no more.
                assert!((found.stretch - (nu - 1.0)).abs() < 1e-8, "{measure:?} {nu}: {found:?}");
                assert!((found.turn - (turn - curvature)).abs() < 1e-7, "{measure:?}: {found:?}");
            }
        }
    }
}
