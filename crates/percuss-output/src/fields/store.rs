//! Frames kept while a run steps, within a budget.

use percuss::Frame;
use percuss::scene::Scene;
use serde::{Deserialize, Serialize};

use super::places::Places;
use super::{Fields, StoredFrame, scene_value};

/// Frames of a kind at least and at most, whatever the budget.
const FEWEST: usize = 40;
const MOST: usize = 1000;

/// Frames of one kind, evenly thinned.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Kind {
    /// Every so manieth frame offered is kept.
    stride: usize,
    offered: usize,
    /// Number among those offered, and the frame, shape (frames) \[index of a frame\].
    kept: Vec<(usize, StoredFrame)>,
    most: usize,
}

impl Kind {
    fn new(most: usize) -> Self {
        Self { stride: 1, offered: 0, kept: Vec::new(), most }
    }

    fn is_due(&self) -> bool {
        self.offered.is_multiple_of(self.stride)
    }

    fn keep(&mut self, frame: StoredFrame) {
        self.kept.push((self.offered, frame));
        if self.kept.len() > self.most {
            self.stride *= 2;
            let stride = self.stride;
            self.kept.retain(|(number, _)| number.is_multiple_of(stride));
        }
    }
}

/// Frames kept so far, but for the last one.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct KeptFrames {
    calm: Kind,
    touching: Kind,
    /// Frames of the largest force and the largest impulse, shape (2) \[N, N s\].
    peaks: [Option<(f64, StoredFrame)>; 2],
}

/// Keeps frames of a run: all while they are few, then every second, every fourth, ...
///
/// Frames in which something touches are thinned apart from the others; the one with the largest contact force, the one with the
/// largest impulse, the first, and that at the end of a run that reaches it are kept in any case.
#[derive(Clone, Debug)]
pub struct FrameStore {
    scene: Scene,
    places: Places,
    kept: KeptFrames,
    last: Option<StoredFrame>,
    /// From this time on frames are the last \[s\].
    end: f64,
    /// Whether anything is to be kept.
    keeps: bool,
    /// What the frame about to come is kept for.
    wanted: Wanted,
}

#[derive(Clone, Copy, Debug, Default)]
struct Wanted {
    touching: bool,
    due: bool,
    /// Force and impulse, each if it is the largest so far, shape (2) \[N, N s\].
    peaks: [Option<f64>; 2],
}

impl FrameStore {
    /// Nothing kept yet, of a run up to `end` \[s\], within about so many megabytes of memory; nothing ever at 0.
    pub fn new(scene: Scene, end: f64, megabytes: f64) -> Self {
        let places = Places::of(&scene);
        let most = ((0.5e6 * megabytes) as usize / places.bytes()).clamp(FEWEST, MOST);
        let kind = || Kind::new(most);
        Self {
            scene,
            places,
            kept: KeptFrames { calm: kind(), touching: kind(), peaks: [None, None] },
            last: None,
            end,
            keeps: megabytes > 0.0,
            wanted: Wanted::default(),
        }
    }

    /// The same with at most so many frames of either kind, whatever the memory; none at 0.
    pub fn at_most(mut self, frames: usize) -> Self {
        self.keeps = frames > 0;
        self.kept.calm.most = frames;
        self.kept.touching.most = frames;
        self
    }

    /// What was kept so far.
    pub fn kept(&self) -> &KeptFrames {
        &self.kept
    }

    /// Goes on from what a store of the same scene and budget had kept; frames of another scene are left out.
    pub fn go_on(&mut self, kept: KeptFrames) {
        let KeptFrames { calm, touching, peaks } = kept;
        let places = &self.places;
        let fitting = |kind: Kind, most: usize| {
            let mut kept = kind.kept;
            kept.retain(|(_, frame)| places.fits(frame));
            Kind { stride: kind.stride.max(1), kept, most, ..kind }
        };
        self.kept = KeptFrames {
            calm: fitting(calm, self.kept.calm.most),
            touching: fitting(touching, self.kept.touching.most),
            peaks: peaks.map(|peak| peak.filter(|(_, frame)| places.fits(frame))),
        };
    }

    /// Whether the frame of a row is to be kept, as [`percuss::Recorder::wants_frame`] asks.
    pub fn wants(&mut self, time: f64, force: f64, impulse: f64) -> bool {
        if !self.keeps {
            return false;
        }
        let touching = force > 0.0 || impulse > 0.0;
        let kind = if touching { &self.kept.touching } else { &self.kept.calm };
        let known = self.kept.peaks.each_ref().map(|p| p.as_ref().map_or(0.0, |(size, _)| *size));
        let peaks = [(force, known[0]), (impulse, known[1])]
            .map(|(size, known)| (size > known).then_some(size));
        let ends = time >= self.end * (1.0 - 1e-9);
        self.wanted = Wanted { touching, due: kind.is_due(), peaks };
        let wanted = self.wanted.due || peaks.iter().any(Option::is_some) || ends;
        if !wanted {
            self.count();
        }
        wanted
    }

    /// Keeps the frame of which [`FrameStore::wants`] has just said so.
    pub fn take(&mut self, frame: &Frame<'_>) {
        let stored = self.places.stored(frame);
        let wanted = self.wanted;
        if frame.time >= self.end * (1.0 - 1e-9) {
            self.last = Some(stored.clone());
        }
        for (kept, size) in self.kept.peaks.iter_mut().zip(wanted.peaks) {
            if let Some(size) = size {
                *kept = Some((size, stored.clone()));
            }
        }
        if wanted.due {
            let kept = &mut self.kept;
            let kind = if wanted.touching { &mut kept.touching } else { &mut kept.calm };
            kind.keep(stored);
        }
        self.count();
    }

    fn count(&mut self) {
        let kept = &mut self.kept;
        let kind = if self.wanted.touching { &mut kept.touching } else { &mut kept.calm };
        kind.offered += 1;
    }

    /// All that was kept, in the order of time.
    pub fn finish(self) -> Fields {
        let Self { scene, kept: KeptFrames { calm, touching, peaks }, last, .. } = self;
        let kept = calm.kept.into_iter().chain(touching.kept).map(|(_, frame)| frame);
        let peaks = peaks.into_iter().flatten().map(|(_, frame)| frame);
        let mut frames: Vec<StoredFrame> = kept.chain(peaks).chain(last).collect();
        frames.sort_by(|a, b| a.time.total_cmp(&b.time));
        frames.dedup_by(|a, b| a == b);
        Fields { scene: scene_value(&scene), frames }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(store: &mut FrameStore, steps: usize, force: impl Fn(usize) -> f64) {
        for k in 0..=steps {
            let time = k as f64;
            if store.wants(time, force(k), 0.0) {
                store.take(&Frame {
                    time,
                    displacement: &[],
                    velocity: &[],
                    spin: &[],
                    section_forces: &[],
                    section_points: &[],
                    contact_forces: &[],
                    load_factors: &[force(k)],
                });
            }
        }
    }

    #[test]
    fn a_long_run_keeps_few_frames_evenly_spaced_and_its_peak() {
        let mut store = FrameStore::new(Scene::default(), 99_999.0, 1e-6);
        // Something touches for a hundredth of the run, with its largest force at 50 317.
        let force = |k: usize| {
            if (50_000..51_000).contains(&k) { 1e3 - (k as f64 - 50_317.0).abs() } else { 0.0 }
        };
        run(&mut store, 99_999, force);
        let times: Vec<f64> = store.finish().frames.iter().map(|f| f.time).collect();
        assert!(times.len() <= 2 * FEWEST + 3, "{}", times.len());
        assert_eq!((times[0], times[times.len() - 1]), (0.0, 99_999.0));
        assert!(times.contains(&50_317.0));
        let touching = times.iter().filter(|t| (50_000.0..51_000.0).contains(*t)).count();
        assert!(touching >= FEWEST / 2, "{touching}");
        assert!(times.windows(2).all(|w| w[1] - w[0] <= 5000.0 && w[1] > w[0]));
    }

    #[test]
    fn frames_of_the_largest_force_and_of_the_largest_impulse_are_kept() {
        let mut store = FrameStore::new(Scene::default(), 99_999.0, 1e-6);
        // A small force all the time, larger at 777; impulses at 33 333 and, the larger one, at 66 667, in frames with the same force.
        let force = |k: usize| if k == 777 { 2.0 } else { 1.0 };
        let impulse = |k: usize| match k {
            33_333 => 3e-3,
            66_667 => 4e-3,
            _ => 0.0,
        };
        for k in 0..=99_999 {
            if store.wants(k as f64, force(k), impulse(k)) {
                store.take(&Frame {
                    time: k as f64,
                    displacement: &[],
                    velocity: &[],
                    spin: &[],
                    section_forces: &[],
                    section_points: &[],
                    contact_forces: &[],
                    load_factors: &[],
                });
            }
        }
        let times: Vec<f64> = store.finish().frames.iter().map(|f| f.time).collect();
        assert!(times.len() <= FEWEST + 3, "{}", times.len());
        assert!([777.0, 66_667.0].iter().all(|t| times.contains(t)), "{times:?}");
    }

    #[test]
    fn a_short_run_keeps_every_frame_once() {
        let mut store = FrameStore::new(Scene::default(), 30.0, 1.0);
        run(&mut store, 30, |k| (k == 7) as u8 as f64);
        assert_eq!(store.finish().frames.len(), 31);
    }
}
