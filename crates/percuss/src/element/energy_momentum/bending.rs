//! The bending strain over a step of the energy-momentum scheme, for sections whose moment does not depend on it alone.

use super::{End, Step, StepStates};
use crate::element::point::{Form, PointResponse, SectionLaw, Stress, form_b};
use crate::element::strain::StrainMeasure;
use crate::scalar::Real;

/// The bending strain over a step, for a moment that does not depend on it alone.
#[derive(Clone, Copy, Debug)]
pub struct BendingStep<S> {
    /// Bending strain at the start and at the end, shape (2) \[1/m\].
    pub strain: [S; 2],
    /// Its change, from the increment \[1/m\].
    pub change: S,
    /// Discrete gradient: on the increment of the step it is the change of the strain, exactly.
    pub gradient: Form<S>,
    /// Gradient of the strain at the end.
    pub end: Form<S>,
    /// A unit moment with the coefficients of the discrete gradient, their derivatives, and where it is evaluated.
    unit: Stress<S>,
    /// Derivatives, for a unit moment, of the coefficients along the discrete gradient's two parts, shape (2).
    turned: [Form<S>; 2],
    /// Where the discrete gradient is evaluated: tangent x' and x'' in the middle of the step, shape (2, 2) \[-, 1/m\].
    middle: [[S; 2]; 2],
}

impl<S: Real> BendingStep<S> {
    /// Force of a moment, with the tangent of its lever arms alone.
    #[inline(always)]
    pub fn response(&self, moment: S) -> PointResponse<S> {
        let (x, y) = (self.turned[0].times(moment), self.turned[1].times(moment));
        let [g, p] = self.middle;
        Stress { moment, ..self.unit }.forces_with_tangent(x, y, 0.5, g, p)
    }
}

impl<S: Real> Step<S> {
    /// The bending strain over the step.
    #[inline(always)]
    pub fn bending(&self, law: &SectionLaw<S>, start: &End<S>) -> BendingStep<S> {
        let one = law.axial.constant(1.0);
        let zero = law.axial.constant(0.0);
        let law = SectionLaw { axial: zero, bending: one, ..*law };
        let ends = StepStates { start, end: &self.end, bent: &self.bent, q: self.q, weight: one };
        let (unit, slopes) = match law.measure {
            StrainMeasure::Green => ends.green(&law),
            StrainMeasure::Engineering => ends.engineering(&law),
        };
        let unit = Stress { moment: one, ..unit };
        let middle = [self.turn.g, self.p_mid];
        let (change_a, change_b) = self.changes();
        let b_form = form_b(self.g, self.p);
        BendingStep {
            strain: [self.bent[0].strain, self.bent[1].strain],
            change: (unit.c1 * change_b).add_product(unit.c2, change_a),
            gradient: Form::along(unit.c2, middle[0], unit.c1, &form_b(middle[0], middle[1])),
            end: Form::along(slopes.moment_a, self.g, slopes.moment_b, &b_form),
            unit,
            turned: [
                Form::along(slopes.c2_a, self.g, slopes.c2_b, &b_form),
                Form::along(slopes.c1_a, self.g, zero, &b_form),
            ],
            middle,
        }
    }
}
