//! Records of lanes whose part of a step is not accepted, which do not change.

use super::guide::GuideLog;
use crate::yield_log::YieldLog;
use percuss::internals::run::crest::Crest;
use percuss::internals::scalar::Number;

/// Saved records of the lanes whose step is not accepted.
#[derive(Clone, Debug)]
pub(super) struct SavedRecords<S: Number> {
    /// Extremes of the recorded points, shape (recorded points, 2).
    points: Vec<[Crest<S>; 2]>,
    /// Numbers recorded for the projectiles, shape (such numbers) \[unit of each\].
    guides: Vec<S>,
    /// Lanes whose last interval has just ended, shape (guided projectiles).
    released: Vec<S::Mask>,
    /// Records of yielding, shape (spans with fibres).
    yields: Vec<YieldLog<S>>,
}

impl<S: Number> Default for SavedRecords<S> {
    fn default() -> Self {
        let (points, guides) = (Vec::new(), Vec::new());
        Self { points, guides, released: Vec::new(), yields: Vec::new() }
    }
}

/// Records of points, projectiles and spans that have yielded.
pub(super) type Records<'a, S> =
    (&'a mut [[Crest<S>; 2]], &'a mut [GuideLog<S>], &'a mut [YieldLog<S>]);

impl<S: Number> SavedRecords<S> {
    /// Saves the current records.
    #[inline(always)]
    pub fn save(&mut self, (points, guides, yields): Records<'_, S>) {
        self.points.clear();
        self.points.extend_from_slice(points);
        self.yields.clear();
        self.yields.extend_from_slice(yields);
        self.guides.clear();
        self.released.clear();
        for log in guides {
            self.released.push(log.released);
            self.guides.extend(log.numbers().map(|x| *x));
        }
    }

    /// Restores the saved records of all lanes except those of the mask `go`.
    #[inline(always)]
    pub fn restore(&self, (points, guides, yields): Records<'_, S>, go: S::Mask) {
        for (now, saved) in points.as_flattened_mut().iter_mut().zip(self.points.as_flattened()) {
            now.restore(saved, go);
        }
        for (now, saved) in yields.iter_mut().zip(&self.yields) {
            now.restore(saved, go);
        }
        let mut saved = self.guides.iter();
        for (log, released) in guides.iter_mut().zip(&self.released) {
            log.released = log.released & go | *released & !go;
            for (now, saved) in log.numbers().zip(&mut saved) {
                *now = S::choose(go, *now, *saved);
            }
        }
    }
}
