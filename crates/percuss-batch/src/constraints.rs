//! Joints of beams, and supports between nodes, in an ensemble: their multipliers follow from the Schur complement of the band.
//!
//! The same constraints as those of single runs ([`step::constraint`](percuss::internals::step::constraint)): forces along the gradient in the middle
//! of a step, which do no work, and a value that vanishes at its end. Lanes cannot search for pivots; the complement is that of a
//! tangent that masses dominate, and needs none.

use percuss::internals::model::frozen::{Constraint, ConstraintKind};
use percuss::internals::scalar::Number;
use percuss::internals::step::constraint::NodalForm;
use percuss::internals::step::convergence::ROUND_OFF;
use percuss::internals::step::forcing::Forcing;

/// Corrections by which derivatives follow the values where angles are kept: the tangent lacks what the forces of such a joint change
/// by when they turn, of the order of the strain of an element, so that each of them leaves a small share of what it finds.
pub const FOLLOWING: usize = 12;

/// What about a constraint an ensemble does not know, if anything.
pub fn unknown(c: &Constraint) -> Option<&'static str> {
    match &c.kind {
        _ if c.until < f64::INFINITY => Some("supports for a time"),
        _ if c.joint.is_some() => Some("joints of a given strength"),
        _ if !c.drive.is_empty() => Some("supports that move"),
        ConstraintKind::Turned { .. } => Some("supports that turn"),
        _ => None,
    }
}

/// The constraints of the runs in mid-flight.
#[derive(Clone, Debug)]
pub struct Constraints<S: Number> {
    /// One by one, shape (constraints).
    pub each: Vec<ConstraintState<S>>,
    /// No motion: supports that move are unknown.
    pub still: Forcing,
    /// Inverse of the Schur complement, row by row, shape (constraints * constraints) \[N/m, N, N m\].
    pub inverse: Vec<S>,
    /// Lanes in whose part impulses act: multipliers of such a part are no guess for what follows, and no round-off is taken back in it.
    pub impulsive: S::Mask,
}

/// A constraint on its way, and in the step at hand.
#[derive(Clone, Debug)]
pub struct ConstraintState<S> {
    /// Multiplier of the step accepted last, which the next one starts from \[N, N m\].
    pub accepted: S,
    /// Multiplier in the step at hand, and its correction \[N, N m\].
    pub multiplier: S,
    pub correction: S,
    /// Round-off of the steps before that this one takes back \[m, -\].
    pub taken_back: S,
    /// By how much the increment as it stands misses the constraint \[m, -\].
    pub miss: S,
    /// Gradient in the middle of the step, as it was evaluated last, shape (4, 4) \[-, m, 1/m\].
    pub gradient: NodalForm<S>,
    /// Gradient at the end of the step, in the free directions, of the factors in use, shape (4, 4) \[-, m, 1/m\].
    pub row: NodalForm<S>,
    /// What the factors in use answer to its gradient, shape (beam nodes, 4) \[m/N, 1/N\].
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

    /// Takes the corrections in the lanes of `which`.
    #[inline(always)]
    pub fn correct(&mut self, which: S::Mask) {
        for c in &mut self.each {
            c.multiplier += S::choose(which, c.correction, c.correction.constant(0.0));
        }
    }

    /// Accepts the multipliers of the step at hand.
    #[inline(always)]
    pub fn commit(&mut self) {
        for c in &mut self.each {
            c.accepted = S::choose(self.impulsive, c.accepted, c.multiplier);
        }
    }

    /// Lanes whose increments, as large as `step`, meet all constraints but for round-off of displacements as large as `reach`.
    #[inline(always)]
    pub fn met(&self, step: S, reach: S, taken_back: S) -> S::Mask {
        let one = step.constant(1.0);
        let tolerance = (step + taken_back * (one + reach)) * ROUND_OFF;
        let all = !step.less(step);
        self.each.iter().fold(all, |met, c| met & c.miss.abs().at_most(tolerance))
    }
}
