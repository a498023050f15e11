//! Joints of beams, and supports between nodes, in an ensemble: their multipliers follow from the Schur complement of the band.
//!
//! The same constraints as those of single runs ([`step::constraint`](percuss::internals::step::constraint)): forces along the gradient in the
//! middle of a step, which do no work, and a value that vanishes at its end. Lanes cannot choose pivots independently; masses dominate the tangent,
//! so that its complement needs no pivoting.

use percuss::internals::model::frozen::{Constraint, ConstraintKind};
use percuss::internals::scalar::Number;
use percuss::internals::step::constraint::NodalForm;
use percuss::internals::step::convergence::ROUND_OFF;
use percuss::internals::step::forcing::Forcing;

/// Corrections of the derivatives with rigid joints: the tangent omits the change of a joint force by rotation, which is of the order of the strain
/// of an element, so that each correction leaves a small share of the residual.
pub const FOLLOWING: usize = 12;

/// Property of a constraint that ensembles do not support, if any.
pub fn unknown(c: &Constraint) -> Option<&'static str> {
    match &c.kind {
        _ if c.until < f64::INFINITY => Some("supports for a time"),
        _ if c.joint.is_some() => Some("joints of a given strength"),
        _ if !c.drive.is_empty() => Some("supports that move"),
        ConstraintKind::Turned { .. } => Some("supports that turn"),
        ConstraintKind::Length { .. } => Some("shear-flexible beams"),
        _ => None,
    }
}

/// The constraints of all runs in the current step.
#[derive(Clone, Debug)]
pub struct Constraints<S: Number> {
    /// One by one, shape (constraints).
    pub each: Vec<ConstraintState<S>>,
    /// No motion: prescribed motions are not supported in ensembles.
    pub still: Forcing,
    /// Inverse of the Schur complement, row by row, shape (constraints * constraints) \[N/m, N, N m\].
    pub inverse: Vec<S>,
    /// Lanes in whose part impulses act: multipliers of such a part are not used as predictions, and round-off is not compensated in it.
    pub impulsive: S::Mask,
}

/// State of a constraint, and its values in the current step.
#[derive(Clone, Debug)]
pub struct ConstraintState<S> {
    /// Multiplier of the step accepted last, which the next one starts from \[N, N m\].
    pub accepted: S,
    /// Multiplier in the current step, and its correction \[N, N m\].
    pub multiplier: S,
    pub correction: S,
    /// Round-off of the previous steps that this one compensates \[m, -\].
    pub taken_back: S,
    /// Violation of the constraint by the current increment \[m, -\].
    pub miss: S,
    /// Gradient in the middle of the step at the last evaluation, shape (4, 4) \[-, m, 1/m\].
    pub gradient: NodalForm<S>,
    /// Gradient at the end of the step, in the free directions, of the factors in use, shape (4, 4) \[-, m, 1/m\].
    pub row: NodalForm<S>,
    /// Solution of the factors in use for its gradient, shape (beam nodes, 4) \[m/N, 1/N\].
    pub column: Vec<[S; 4]>,
}

impl<S: Number> Constraints<S> {
    /// Of runs at rest in the reference configuration.
    pub fn new(numbers: &[Constraint<S>], nodes: usize, zero: S) -> Self {
        let none = [[zero; 4]; 4];
        let state = ConstraintState {
            accepted: zero,
            multiplier: zero,
            correction: zero,
            taken_back: zero,
            miss: zero,
            gradient: none,
            row: none,
            column: vec![[zero; 4]; nodes],
        };
        let n = numbers.len();
        let (each, inverse) = (vec![state; n], vec![zero; n * n]);
        Self { each, still: Forcing::default(), inverse, impulsive: zero.less(zero) }
    }

    /// Multipliers that the next steps start from, shape (constraints) \[N, N m\].
    pub fn accepted(&mut self) -> impl Iterator<Item = &mut S> {
        self.each.iter_mut().map(|c| &mut c.accepted)
    }

    /// Corrections of the multipliers, shape (constraints) \[N, N m\].
    pub fn corrections(&mut self) -> impl Iterator<Item = &mut S> {
        self.each.iter_mut().map(|c| &mut c.correction)
    }

    /// Applies the corrections in the lanes of `which`.
    #[inline(always)]
    pub fn correct(&mut self, which: S::Mask) {
        for c in &mut self.each {
            c.multiplier += S::choose(which, c.correction, c.correction.constant(0.0));
        }
    }

    /// Accepts the multipliers of the current step.
    #[inline(always)]
    pub fn commit(&mut self) {
        for c in &mut self.each {
            c.accepted = S::choose(self.impulsive, c.accepted, c.multiplier);
        }
    }

    /// Lanes whose increments, of size `step`, satisfy all constraints within the round-off of displacements of size `reach`.
    #[inline(always)]
    pub fn met(&self, step: S, reach: S, taken_back: S) -> S::Mask {
        let one = step.constant(1.0);
        let tolerance = (step + taken_back * (one + reach)) * ROUND_OFF;
        let all = !step.less(step);
        self.each.iter().fold(all, |met, c| met & c.miss.abs().at_most(tolerance))
    }
}
