//! Accelerations of nodes; energies and momenta of an element: its share of T and Psi_int of the paper's eqs. (7) and (8).

use super::beam::{ElementTable, ElementValues};
use super::energy_momentum::End;
use super::rotary::spin_of_slope;
use super::strain::StrainMeasure;
use super::yielding::FibreEnergies;
use crate::math::hermite::GAUSS;
use crate::math::vec2::{cross, dot4};
use crate::scalar::{Number, Real};

/// Energies and momenta of an element, or sums of several.
#[derive(Clone, Copy, Debug)]
pub struct ElementMeasures<S> {
    /// Twice the kinetic energies of translation and of rotation \[J\].
    pub translation: S,
    pub rotation: S,
    /// Twice the kinetic energy of rotation that the slopes' velocities would have, less that of the angular rates \[J\].
    pub rate_drift: S,
    /// Twice the axial and the bending strain energy \[J\].
    pub axial: S,
    pub bending: S,
    /// Linear momentum, shape (2) \[kg m/s\].
    pub linear: [S; 2],
    /// Sum of its components' magnitudes \[kg m/s\].
    pub linear_size: S,
    /// Angular momentum about the origin, and the sum of the magnitudes of its parts \[kg m^2/s\].
    pub angular: S,
    pub angular_size: S,
}

/// Accelerations of a node in the equation of motion by the midpoint rule in a step of size `1 / rate`, `2 (d/h - v0)/h`, with the term of
/// mass-proportional `damping`; `mean` is d/h.
#[inline(always)]
pub fn accelerations<S: Real>(
    mean: [S; 4],
    velocity: &[S; 4],
    rate: S,
    damping: Option<S>,
) -> [S; 4] {
    let twice = rate + rate;
    let mut out = mean;
    for i in 0..4 {
        out[i] = (mean[i] - velocity[i]) * twice;
        if let Some(damping) = damping {
            out[i] = out[i].add_product(damping, mean[i]);
        }
    }
    out
}

impl<S: Number> ElementMeasures<S> {
    /// Zero, with the lanes of a number.
    #[inline(always)]
    pub fn zero(like: S) -> Self {
        let zero = like.constant(0.0);
        Self {
            translation: zero,
            rotation: zero,
            rate_drift: zero,
            axial: zero,
            bending: zero,
            linear: [zero; 2],
            linear_size: zero,
            angular: zero,
            angular_size: zero,
        }
    }

    /// Kinetic quantities: from positions and tangents of both nodes, their velocities, and the angular rates at the Gauss points.
    #[inline(always)]
    pub fn of_motion(
        table: &ElementTable<S>,
        places: &[[S; 4]; 2],
        velocity: &[[S; 4]; 2],
        spin: &[S; GAUSS],
    ) -> Self {
        let mut m = Self::zero(spin[0]);
        let mut momentum = [[m.angular; 4]; 2];
        let [on_a, on_b] = &mut momentum;
        table.add_inertia(&velocity[0], &velocity[1], on_a, on_b);
        for i in 0..2 {
            m.linear[i] = momentum[0][i] + momentum[1][i];
            m.linear_size += m.linear[i].abs();
        }
        for (p, (x, v)) in momentum.iter().zip(places.iter().zip(velocity)) {
            m.translation += dot4(p, v);
            m.angular += cross([x[0], x[1]], [p[0], p[1]]) + cross([x[2], x[3]], [p[2], p[3]]);
            m.angular_size += (x[0].abs() + x[1].abs()) * (p[0].abs() + p[1].abs());
            m.angular_size += (x[2].abs() + x[3].abs()) * (p[2].abs() + p[3].abs());
        }
        let tangents = ElementValues::new(&places[0], &places[1]);
        let rates = ElementValues::new(&velocity[0], &velocity[1]);
        for j in 0..GAUSS {
            let row = &table.rows[j];
            let turning = row.weighed.rotary * spin[j];
            m.rotation += turning * spin[j];
            let of_slope = spin_of_slope(tangents.at(&row.first), rates.at(&row.first));
            m.rate_drift += row.weighed.rotary * (of_slope - spin[j]) * (of_slope + spin[j]);
            m.angular += turning;
            m.angular_size += turning.abs();
        }
        m
    }

    /// Adds the strain energies of an elastic element.
    #[inline(always)]
    pub fn add_strains(
        &mut self,
        table: &ElementTable<S>,
        measure: StrainMeasure,
        ends: &[End<S>; GAUSS],
        displacement: &ElementValues<S>,
    ) {
        for j in 0..GAUSS {
            let (row, end) = (&table.rows[j], &ends[j]);
            let kappa = end.bent(measure, &row.reference).strain;
            self.axial += row.weighed.axial * end.membrane * end.membrane;
            self.bending += row.weighed.bending * kappa * kappa;
        }
        if let Some(samples) = &table.membrane {
            self.axial += samples.energy(samples.strains(measure, displacement)) * 2.0;
        }
    }

    /// Adds the elastic energies of an element of fibres.
    #[inline(always)]
    pub fn add_fibres(&mut self, stored: &FibreEnergies<S>) {
        self.axial += stored.stretching * 2.0;
        self.bending += (stored.elastic - stored.stretching) * 2.0;
    }

    /// Adds those of another element.
    #[inline(always)]
    pub fn add(&mut self, other: &Self) {
        self.translation += other.translation;
        self.rotation += other.rotation;
        self.rate_drift += other.rate_drift;
        self.axial += other.axial;
        self.bending += other.bending;
        self.linear[0] += other.linear[0];
        self.linear[1] += other.linear[1];
        self.linear_size += other.linear_size;
        self.angular += other.angular;
        self.angular_size += other.angular_size;
    }
}
