//! Which of many runs go side by side: those of one shape.

use super::detail::Detail;
use super::drive::{LaneDriver, rigid_guides};
use super::lane::LaneRun;
use super::numbers::Numbers;
use super::shape::{BatchShape, numbers};
use percuss::internals::scalar::{Lanes, in_lanes};
use percuss::internals::settings::Settings;
use percuss::{Model, RunSummary};

/// Simulates those of the runs that ensembles know, and of which no more is asked than they tell; `None` for the others.
///
/// A run's summary is the same to the last bit whatever runs stand beside it. Runs in which an iteration fails are left to the
/// solver that cuts steps: `None`.
pub fn simulate_ensemble(runs: &[(&Model, &Settings)], detail: Detail) -> Vec<Option<RunSummary>> {
    let mut done: Vec<Option<RunSummary>> = runs.iter().map(|_| None).collect();
    let known = |(i, (model, settings)): (usize, &(&Model, &Settings))| {
        let faultless = settings.validate(model).is_empty();
        let numbers = lane_numbers(model, settings, detail).ok().filter(|_| faultless)?;
        Some((i, BatchShape::of(&numbers), numbers))
    };
    let mut left: Vec<_> = runs.iter().enumerate().filter_map(known).collect();
    while let Some((_, shape, _)) = left.first() {
        let shape = shape.clone();
        let (group, others): (Vec<_>, Vec<_>) = left.into_iter().partition(|r| r.1 == shape);
        left = others;
        let group: Vec<LaneRun> = group
            .into_iter()
            .map(|(index, _, numbers)| LaneRun {
                index,
                model: runs[index].0,
                settings: runs[index].1,
                numbers,
            })
            .collect();
        let mut keep = |index: usize, summary| done[index] = summary;
        in_lanes(SideBySide { runs: &group, detail, keep: &mut keep });
    }
    done
}

/// The numbers of a run that goes in a lane, or why it runs alone.
fn lane_numbers(
    model: &Model,
    settings: &Settings,
    detail: Detail,
) -> Result<Numbers<f64>, &'static str> {
    match detail {
        Detail::Full => return Err("strains, reactions or solver counts are requested"),
        Detail::Stresses if model.spans.iter().any(|span| span.fibres.is_some()) => {
            return Err("stresses of beams made of fibres");
        }
        Detail::Stresses | Detail::Resultants | Detail::Motion => {}
    }
    let numbers = numbers(model, settings)?;
    match rigid_guides(&numbers).count() {
        0 | 1 => Ok(numbers),
        _ => Err("more than one rigid projectile"),
    }
}

/// What of a run keeps [`simulate_batch`](super::simulate_batch) from stepping it beside others, in words; none if nothing does.
pub fn runs_alone(model: &Model, settings: &Settings, detail: Detail) -> Option<&'static str> {
    lane_numbers(model, settings, detail).err()
}

/// Runs in lanes, compiled for each of the register widths that processors have.
struct SideBySide<'a, 'r> {
    /// The runs, shape (runs).
    runs: &'a [LaneRun<'r>],
    detail: Detail,
    keep: &'a mut dyn FnMut(usize, Option<RunSummary>),
}

impl pulp::WithSimd for SideBySide<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<P: pulp::Simd>(self, family: P) {
        LaneDriver::of(self.runs, self.detail, Lanes::new(family, 0.0)).run(self.keep);
    }
}
