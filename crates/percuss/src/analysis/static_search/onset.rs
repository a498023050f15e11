//! The direction in which a path of equilibria leaves one of them under growing loads.

use super::{Reached, StaticSearch, largest};
use crate::step::newton::prescribe;

/// Growth of the loads for the direction, as a share of all: small enough that the tangent is that of the equilibrium.
const LITTLE: f64 = 1e-6;
/// Cosine to the direction against which an equilibrium lies behind another one: more than round-off of a motion across it.
const BEHIND: f64 = 1e-2;

impl StaticSearch<'_> {
    /// Change of the displacements as the loads begin to grow from a known equilibrium under a share of them, shape (nodes, 4) \[m, -\];
    /// `None` without a tangent. The search remains at the equilibrium.
    pub fn onset(&mut self, accepted: &Reached, share: f64) -> Option<Vec<[f64; 4]>> {
        self.set_share(share + LITTLE);
        prescribe(self.model, &self.forcing, &mut self.work.increment);
        self.assemble::<true>();
        let regular = self.factor_assembled().is_ok();
        if regular {
            self.correction();
        }
        let moved = self.work.increment.iter().zip(&accepted.increment).zip(&self.work.correction);
        let onset: Vec<[f64; 4]> =
            moved.map(|((a, b), c)| std::array::from_fn(|i| a[i] - b[i] + c[i])).collect();
        self.set_share(share);
        self.go_back(accepted);
        regular.then_some(onset).filter(|onset| largest(onset).is_finite())
    }

    /// Whether the current equilibrium lies behind a known one, against the direction in which the path leaves that.
    pub fn leaves(&self, accepted: &Reached, onset: &[[f64; 4]]) -> bool {
        let gone = self.work.increment.iter().zip(&accepted.increment);
        let gone: Vec<[f64; 4]> = gone.map(|(a, b)| std::array::from_fn(|i| a[i] - b[i])).collect();
        let lengths = self.alike(&gone, &gone) * self.alike(onset, onset);
        self.alike(&gone, onset) < -BEHIND * lengths.sqrt()
    }

    /// Inner product of motions: displacements divided by the size of the structure, and slopes, averaged.
    pub fn alike(&self, a: &[[f64; 4]], b: &[[f64; 4]]) -> f64 {
        let size = self.size();
        let one = |(a, b): (&[f64; 4], &[f64; 4])| {
            (a[0] * b[0] + a[1] * b[1]) / (size * size) + a[2] * b[2] + a[3] * b[3]
        };
        a.iter().zip(b).map(one).sum::<f64>() / a.len() as f64
    }
}
