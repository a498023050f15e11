//! Dissipation by material damping of beams over a step.

use crate::element::beam::{ElementTable, ElementValues};
use crate::element::membrane::SAMPLES;
use crate::element::point::Strains;
use crate::element::rotary::Turn;
use crate::ledger::StepWork;
use crate::math::hermite::GAUSS;
use crate::math::vec2::add;
use crate::scalar::{Number, Real};

/// `int EA (Deps)^2 + EI (Dkappa)^2 ds` of an element for the changes of strain at its Gauss points, and at the sampling points of a slender one;
/// `tau/h` times this is the dissipation by stiffness-proportional damping (theory, page 2).
#[inline(always)]
pub fn viscous<S: Real>(
    table: &ElementTable<S>,
    changes: &[Strains<S>; GAUSS],
    sampled: Option<[S; SAMPLES]>,
) -> S {
    let mut loss = table.length.constant(0.0);
    for (row, change) in table.rows.iter().zip(changes) {
        loss += row.weighed.axial * (change.membrane * change.membrane)
            + row.weighed.bending * (change.bending * change.bending);
    }
    if let (Some(samples), Some(changes)) = (&table.membrane, sampled) {
        loss += samples.energy(changes) * 2.0;
    }
    loss
}

/// An element in a step of size `h` that is damped in proportion to mass: forces `-c M v` at the velocities in the middle.
#[derive(Clone, Copy, Debug)]
pub struct MassDamping<'a, S> {
    pub table: &'a ElementTable<S>,
    /// Coefficient c \[1/s\].
    pub coefficient: S,
    pub h: S,
}

impl<S: Number> MassDamping<'_, S> {
    /// Adds the damping of translation: from the velocities of both nodes, their positions and tangents in the middle of the step, and increments.
    #[inline(always)]
    pub fn translation(
        &self,
        velocity: &[[S; 4]; 2],
        middle: [[[S; 2]; 2]; 2],
        increment: [&[S; 4]; 2],
        sum: &mut StepWork<S>,
    ) {
        let mut momentum = [[self.h.constant(0.0); 4]; 2];
        let [on_a, on_b] = &mut momentum;
        self.table.add_inertia(&velocity[0], &velocity[1], on_a, on_b);
        for k in 0..2 {
            let mut force = momentum[k];
            for component in &mut force {
                *component = -self.coefficient * *component;
            }
            sum.add_nodal(&force, middle[k], increment[k], self.h);
        }
    }

    /// Adds the damping of the rotation of sections, from the slopes at the Gauss points at the start.
    #[inline(always)]
    pub fn rotation(
        &self,
        slopes: &[[S; 2]; GAUSS],
        increment: &ElementValues<S>,
        sum: &mut StepWork<S>,
    ) {
        let rate = self.h.recip();
        for (row, slope) in self.table.rows.iter().zip(slopes) {
            let tangent = add(row.reference.tangent, *slope);
            let spin = Turn::new(tangent, increment.at(&row.first)).mean_spin(rate);
            let moment = -self.coefficient * row.weighed.rotary * spin;
            sum.work += moment * spin * self.h;
            sum.angular_impulse += self.h * moment;
        }
    }
}
