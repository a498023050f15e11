//! Logs of lanes whose part of a step is not accepted stay as they are.

use super::guide::{Closed, GuideLog, Top};
use crate::yield_log::YieldLog;
use percuss::internals::contact::free_gap::FreeGap;
use percuss::internals::run::crest::Crest;
use percuss::internals::scalar::{Mask, Number};

/// What lanes keep whose step is not taken in.
#[derive(Clone, Debug)]
pub(super) struct Kept<S: Number> {
    /// Extremes of the recorded points, shape (recorded points, 2).
    points: Vec<[Crest<S>; 2]>,
    /// What is noted of the projectiles, shape (guided projectiles).
    guides: Vec<KeptGuide<S>>,
    /// Where spans have yielded, shape (spans with fibres).
    yields: Vec<YieldLog<S>>,
}

/// The same of a guided projectile, as in [`GuideLog`].
#[derive(Clone, Copy, Debug)]
struct KeptGuide<S: Number> {
    open: Closed<S>,
    deepest: Top<S>,
    /// Impulse and energy that it gave, and work on what it struck, shape (3) \[N s, J, J\].
    given: [S; 3],
    free: S,
    released: S::Mask,
    parted: FreeGap<S>,
    /// Start and size of the step in which it parted, shape (2) \[s\].
    parted_at: [S; 2],
}

impl<S: Number> Default for Kept<S> {
    fn default() -> Self {
        Self { points: Vec::new(), guides: Vec::new(), yields: Vec::new() }
    }
}

/// Records of points, projectiles and spans that have yielded.
pub(super) type Records<'a, S> =
    (&'a mut [[Crest<S>; 2]], &'a mut [GuideLog<S>], &'a mut [YieldLog<S>]);

impl<S: Number> Kept<S> {
    /// Keeps records as they stand.
    #[inline(always)]
    pub fn keep(
        &mut self,
        points: &[[Crest<S>; 2]],
        guides: &[GuideLog<S>],
        yields: &[YieldLog<S>],
    ) {
        self.points.clear();
        self.points.extend_from_slice(points);
        self.yields.clear();
        self.yields.extend_from_slice(yields);
        self.guides.clear();
        self.guides.extend(guides.iter().map(GuideLog::kept));
    }

    /// Puts all lanes but those that `go` back to what was kept.
    #[inline(always)]
    pub fn put_back(&self, (points, guides, yields): Records<'_, S>, go: S::Mask) {
        for (now, kept) in points.as_flattened_mut().iter_mut().zip(self.points.as_flattened()) {
            now.put_back(kept, go);
        }
        for (now, kept) in yields.iter_mut().zip(&self.yields) {
            now.put_back(kept, go);
        }
        for (now, kept) in guides.iter_mut().zip(&self.guides) {
            now.put_back(kept, go);
        }
    }
}

impl<S: Number> GuideLog<S> {
    #[inline(always)]
    fn kept(&self) -> KeptGuide<S> {
        let Self { open, deepest, given, free, released, parted, parted_at, .. } = *self;
        KeptGuide { open, deepest, given, free, released, parted, parted_at }
    }

    /// Puts all lanes but those that `go` back to what they were.
    #[inline(always)]
    fn put_back(&mut self, kept: &KeptGuide<S>, go: S::Mask) {
        let choose = |now: &mut S, kept: S| *now = S::choose(go, *now, kept);
        for lane in (0..S::LANES).filter(|lane| !go.lane(*lane)) {
            self.open.set_lane(lane, &kept.open, lane);
        }
        choose(&mut self.deepest.value, kept.deepest.value);
        choose(&mut self.deepest.time, kept.deepest.time);
        choose(&mut self.free, kept.free);
        choose(&mut self.parted.gap, kept.parted.gap);
        choose(&mut self.parted.rate, kept.parted.rate);
        choose(&mut self.parted.acceleration, kept.parted.acceleration);
        (0..3).for_each(|i| choose(&mut self.given[i], kept.given[i]));
        for i in 0..2 {
            choose(&mut self.parted_at[i], kept.parted_at[i]);
        }
        self.released = self.released & go | kept.released & !go;
    }
}
