//! Scales of the momentum of a run in a lane and alone.

use percuss::RunSummary;

/// Impulses in them are summed without sign, in lanes by nodes and else by loads: where loads cancel at a node the scales differ by a few per cent.
const NEAR: f64 = 0.05;

/// Asserts that the scales of two runs are nearly the same.
pub fn agree(alone: &RunSummary, found: &RunSummary) {
    let scales = |s: &RunSummary| [s.momentum.linear_scale, s.momentum.angular_scale];
    for (a, b) in scales(alone).into_iter().zip(scales(found)) {
        assert!(a > 0.0 && (a - b).abs() < NEAR * a, "{a:e} {b:e}");
    }
}
