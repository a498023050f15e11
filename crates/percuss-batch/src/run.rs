//! Grouping of many runs by shape; runs of one shape are computed in lanes.

use super::detail::Detail;
use super::drive::{LaneDriver, rigid_guides};
use super::lane::LaneRun;
use super::numbers::Numbers;
use super::shape::{BatchShape, numbers};
use percuss::internals::scalar::{Lanes, in_lanes};
use percuss::internals::settings::Settings;
use percuss::{Model, RunSummary};

/// Simulates the runs that ensembles support, with the results that they provide; `None` for the others.
///
/// The summary of a run does not depend on the other runs, to the last bit. Runs in which an iteration fails are `None`; the solver of single runs
/// repeats them with step cuts.
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
        in_lanes(LaneTask { runs: &group, detail, keep: &mut keep });
    }
    done
}

/// The numbers of a run for a lane, or the reason why it is computed as a single run.
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
    if numbers.guides.iter().any(|guide| guide.damped) {
        return Err("a contact force that dissipates");
    }
    match rigid_guides(&numbers).count() {
        0 | 1 => Ok(numbers),
        _ => Err("more than one rigid projectile"),
    }
}

/// Reason why [`simulate_batch`](super::simulate_batch) computes a run as a single run, not in a lane; `None` if it uses a lane.
pub fn runs_alone(model: &Model, settings: &Settings, detail: Detail) -> Option<&'static str> {
    lane_numbers(model, settings, detail).err()
}

/// Runs in lanes, compiled for each of the register widths that processors have.
struct LaneTask<'a, 'r> {
    /// The runs, shape (runs).
    runs: &'a [LaneRun<'r>],
    detail: Detail,
    keep: &'a mut dyn FnMut(usize, Option<RunSummary>),
}

impl pulp::WithSimd for LaneTask<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<P: pulp::Simd>(self, family: P) {
        LaneDriver::of(self.runs, self.detail, Lanes::new(family, 0.0)).run(self.keep);
    }
}
