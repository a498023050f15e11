//! Stress along a path of strain.

use crate::scalar::{Mask, Number};

/// Stress along a straight path of strain, gathered from parts of constant tangent modulus.
pub(super) struct StressPath<S> {
    pub start: S,
    pub length: S,
    /// How far it has been gathered, from 0 to 1.
    pub at: S,
    /// `int Et dt`, `int Et (1 - t) dt`, `int Et t dt`, shape (3) \[Pa\].
    pub sums: [S; 3],
    /// Tangent modulus of the part gathered last.
    pub modulus: S,
}

impl<S: Number> StressPath<S> {
    #[inline(always)]
    pub fn new(start: S, length: S) -> Self {
        let none = start.constant(0.0);
        Self { start, length, at: none, sums: [none; 3], modulus: none }
    }

    /// Continues to the share `to` of the path with a tangent modulus.
    #[inline(always)]
    pub fn go_on(&mut self, modulus: S, to: S) {
        let (share, middle) = (to - self.at, (self.at + to) * 0.5);
        let rise = modulus * share;
        self.sums[0] += rise;
        self.sums[1] += rise * (rise.constant(1.0) - middle);
        self.sums[2] += rise * middle;
        (self.at, self.modulus) = (to, modulus);
    }

    /// Continues to the point at which a fibre opens or closes, if any, `rest` of the strain away from the start.
    #[inline(always)]
    pub fn cross(&mut self, gaped: S::Mask, gapes: S::Mask, modulus: S, rest: S) {
        let crosses = gaped & !gapes | gapes & !gaped;
        if crosses.any() {
            self.go_on(modulus, S::choose(crosses, rest / self.length, self.at));
        }
    }

    /// Stress where it has been gathered to.
    #[inline(always)]
    pub fn stress(&self) -> S {
        self.start + self.length * self.sums[0]
    }
}
