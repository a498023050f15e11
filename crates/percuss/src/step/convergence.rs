//! Whether Newton's iteration contracts, and when it has reached the last digit.

use crate::scalar::Number;

/// The tangent is renewed when unbalanced work shrinks by less than this factor per correction.
const CONTRACTION: f64 = 0.02;
/// Unbalanced work of an accepted step, relative to the energy scale: far below 1e-10 even if every step of a long run
/// errs to the same side.
pub const WORK_TOLERANCE: f64 = 1e-16;
/// Limit of the unbalanced work that may be round-off, relative to the energy scale. It is a sum of magnitudes: on 60 000 elements of 0.05 mm,
/// moved by 0.1 m, round-off is of the order of 1e-4, though its signed sum is not.
const MOST_ROUND_OFF: f64 = 1e-2;
/// Corrections below this share of the step are close to convergence.
const NEAR: f64 = 1e-2;
/// An iteration whose corrections decrease by this factor converges eventually.
const CLOSES_IN: f64 = 0.9;
/// Corrections this small against the step that no longer shrink are round-off.
const STALLED: f64 = 1e-10;
/// A correction of fewer units in the last place of the displacements has no effect.
pub const ROUND_OFF: f64 = 8.0 * f64::EPSILON;

/// Follows an iteration: how fast it contracts, and whether it has reached the last digit.
///
/// The iterations of runs side by side begin together; one that has ended is followed on to no effect.
#[derive(Clone, Copy, Debug)]
pub struct ConvergenceMonitor<S: Number> {
    /// Energy scale \[J\].
    pub energy: S,
    /// Unbalanced work now, and before the last correction \[J\].
    pub unbalanced: S,
    before: S,
    /// Work of the unbalanced forces on a correction, per square of its size: the largest so far.
    stiffness: S,
    /// Size of the last correction, its ratio to the one before, and that one's.
    size: S,
    rate: S,
    rate_before: S,
    /// The worse of that ratio and the one of the unbalanced work, as they were known with the last correction.
    contraction: S,
    /// Whether it was small against the step.
    near: S::Mask,
    /// Whether the effect of further corrections would be round-off.
    settled: S::Mask,
}

impl<S: Number> ConvergenceMonitor<S> {
    /// Initial state; `energy` is the largest so far.
    #[inline(always)]
    pub fn new(energy: S) -> Self {
        let infinity = energy.constant(f64::INFINITY);
        let no = infinity.less(infinity);
        Self {
            energy,
            unbalanced: infinity,
            before: infinity,
            stiffness: energy.constant(0.0),
            size: infinity,
            rate: infinity,
            rate_before: infinity,
            contraction: infinity,
            near: no,
            settled: no,
        }
    }

    /// Enters the unbalanced work of an increment.
    #[inline(always)]
    pub fn unbalanced(&mut self, unbalanced: S) {
        self.before = std::mem::replace(&mut self.unbalanced, unbalanced);
    }

    /// Whether the last factored tangent is still good enough. On very fine meshes the unbalanced work soon is round-off and no longer decreases;
    /// the corrections then still show convergence.
    #[inline(always)]
    pub fn contracts(&self) -> S::Mask {
        let enough = self.energy.constant(CONTRACTION);
        self.unbalanced.at_most(self.before * CONTRACTION) | self.rate.at_most(enough)
    }

    /// Whether the iteration converges slowly: corrections that are small relative to the step decrease by at least a tenth in each of the last
    /// two, on average.
    #[inline(always)]
    pub fn closes_in(&self) -> S::Mask {
        let both = self.rate * self.rate_before;
        self.near & both.less(both.constant(CLOSES_IN * CLOSES_IN))
    }

    /// Whether only round-off is left, and little of it.
    #[inline(always)]
    pub fn settled(&self) -> S::Mask {
        self.settled & self.unbalanced.at_most(self.energy * MOST_ROUND_OFF)
    }

    /// Share of the unbalanced forces that remains after the last correction; one, unless the iteration contracts well.
    #[inline(always)]
    pub fn left_share(&self) -> S {
        let share = self.contraction;
        S::choose(share.at_most(share.constant(CONTRACTION)), share, share.constant(1.0))
    }

    /// Work that the correction just taken in leaves unbalanced, by that share; round-off is not in it \[J\].
    #[inline(always)]
    pub fn work_left(&self) -> S {
        self.unbalanced * self.left_share()
    }

    /// Enters the energy scale, after the first correction.
    #[inline(always)]
    pub fn set_energy_scale(&mut self, energy: S) {
        self.energy = energy;
    }

    /// Enters a correction: its size, the size of the displacements and of the step, and the work of the unbalanced forces on it. With contacts,
    /// gaps are differences of positions of size `places`, otherwise zero.
    #[inline(always)]
    pub fn corrected(&mut self, size: S, reach: S, step: S, work: S, places: S) {
        let zero = size.constant(0.0);
        let stiffness = self.stiffness.max(work / (size * size));
        self.stiffness = S::choose(zero.less(size), stiffness, self.stiffness);
        let (known, rate) = (self.size.finite(), size / self.size);
        self.rate_before = S::choose(known, self.rate, self.rate_before);
        self.rate = S::choose(known, rate, self.rate);
        self.size = size;
        self.near = size.at_most(step * NEAR);
        let round_off = size.at_most(reach.max(step) * ROUND_OFF);
        self.contraction = self.rate.max(self.unbalanced / self.before);
        // Unbalanced work after the next correction, without round-off.
        let ahead = size * self.rate * self.stiffness * step;
        let predicted = self.rate.at_most(zero.constant(CONTRACTION))
            & zero.less(self.stiffness)
            & ahead.at_most(self.energy * WORK_TOLERANCE);
        let floor = (step * STALLED).max(places * ROUND_OFF);
        let slow = zero.constant(0.5).less(self.rate) & self.rate.finite();
        self.settled = round_off | predicted | slow & size.at_most(floor);
    }
}
