//! Whether Newton's iteration contracts, and when it has reached the last digit.

/// The tangent is renewed when unbalanced work shrinks by less than this factor per correction.
const CONTRACTION: f64 = 0.02;
/// Unbalanced work of an accepted step, relative to the energy in play: far below 1e-10 even if every step of a long run
/// errs to the same side.
pub const WORK_TOLERANCE: f64 = 1e-16;
/// Unbalanced work that may pass for round-off, relative to the energy in play. It is a sum of magnitudes: on 60 000 elements
/// of 0.05 mm, moved by 0.1 m, round-off alone is of the order of 1e-4, though its signed sum is not.
const MOST_ROUND_OFF: f64 = 1e-2;
/// Corrections below this share of the step are near its end.
const NEAR: f64 = 1e-2;
/// An iteration whose corrections shrink by this factor gets there in the end.
const CLOSES_IN: f64 = 0.9;
/// Corrections this small against the step that no longer shrink are round-off.
const STALLED: f64 = 1e-10;
/// A correction below so many units in the last place of the displacements moves nothing any more.
pub const ROUND_OFF: f64 = 8.0 * f64::EPSILON;

/// Watches an iteration: how fast it contracts, and whether it has reached the last digit.
#[derive(Clone, Copy, Debug)]
pub struct Watch {
    /// Largest energy in play \[J\].
    pub energy: f64,
    /// Unbalanced work now, and before the last correction \[J\].
    pub unbalanced: f64,
    before: f64,
    /// Work of the unbalanced forces on a correction, per square of its size: the largest seen.
    stiffness: f64,
    /// Size of the last correction, its ratio to the one before, and that one's.
    size: f64,
    rate: f64,
    rate_before: f64,
    /// The worse of that ratio and the one of the unbalanced work, as they were known with the last correction.
    contraction: f64,
    /// Whether it was small against the step.
    near: bool,
    /// Whether further corrections would move nothing but round-off.
    settled: bool,
}

impl Watch {
    /// Nothing seen yet; `energy` is the largest in play so far.
    pub fn new(energy: f64) -> Self {
        let infinity = f64::INFINITY;
        Self {
            energy,
            unbalanced: infinity,
            before: infinity,
            stiffness: 0.0,
            size: infinity,
            rate: infinity,
            rate_before: infinity,
            contraction: infinity,
            near: false,
            settled: false,
        }
    }

    /// Takes in the unbalanced work of an increment.
    pub fn unbalanced(&mut self, unbalanced: f64) {
        self.before = std::mem::replace(&mut self.unbalanced, unbalanced);
    }

    /// Whether the last factored tangent is still good enough. On very fine meshes the unbalanced work soon is round-off
    /// and no longer falls; the corrections then still tell.
    pub fn contracts(&self) -> bool {
        self.unbalanced <= CONTRACTION * self.before || self.rate <= CONTRACTION
    }

    /// Whether the iteration comes nearer, if slowly: corrections small against the step shrink by at least a tenth in each of
    /// the last two, on average.
    pub fn closes_in(&self) -> bool {
        self.near && self.rate * self.rate_before < CLOSES_IN * CLOSES_IN
    }

    /// Whether only round-off is left, and little of it.
    pub fn settled(&self) -> bool {
        self.settled && self.unbalanced <= MOST_ROUND_OFF * self.energy
    }

    /// The share that the last correction leaves of what was unbalanced before it; one, unless the iteration contracts well.
    pub fn left_share(&self) -> f64 {
        if self.contraction <= CONTRACTION { self.contraction } else { 1.0 }
    }

    /// Work that the last correction leaves unbalanced, by that share; round-off is not in it \[J\].
    pub fn work_left(&self) -> f64 {
        self.before * self.left_share()
    }

    /// Takes in the energy in play, once the first correction has shown it.
    pub fn play(&mut self, energy: f64) {
        self.energy = energy;
    }

    /// Takes in a correction: its size, the size of the displacements and of the step, and the work of the unbalanced forces
    /// on it. Where things touch, gaps are differences of positions as large as `places`, zero elsewhere.
    pub fn corrected(&mut self, size: f64, reach: f64, step: f64, work: f64, places: f64) {
        if size > 0.0 {
            self.stiffness = self.stiffness.max(work / (size * size));
        }
        if self.size.is_finite() {
            self.rate_before = std::mem::replace(&mut self.rate, size / self.size);
        }
        self.size = size;
        self.near = size <= NEAR * step;
        let round_off = size <= ROUND_OFF * reach.max(step);
        self.contraction = self.rate.max(self.unbalanced / self.before);
        // What the next correction would find unbalanced, were there no round-off.
        let ahead = size * self.rate * self.stiffness * step;
        let predicted = self.rate <= CONTRACTION
            && self.stiffness > 0.0
            && ahead <= WORK_TOLERANCE * self.energy;
        let floor = (STALLED * step).max(ROUND_OFF * places);
        let stalled = self.rate > 0.5 && self.rate.is_finite() && size <= floor;
        self.settled = round_off || predicted || stalled;
    }
}
