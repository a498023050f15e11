//! The beginning of a run, up to where a contact has opened again.

use super::recording::record::{Flow, Recorder};
use super::simulation::Simulation;
use crate::model::Model;
use crate::settings::Settings;
use crate::summary::ContactRecord;

/// Results of the beginning of a run.
#[derive(Clone, Debug)]
pub struct Preview {
    /// Step \[s\].
    pub step: f64,
    /// Time reached \[s\].
    pub time: f64,
    /// Elements times iterations so far.
    pub effort: usize,
    /// Beginning and end of the first interval of each contact, shape (contacts, 2) \[s\]; the end is not a number while it is closed.
    pub first: Vec<Option<[f64; 2]>>,
}

/// Counts the parts of steps, so that accumulating impacts do not exceed the given effort.
struct Limit {
    left: usize,
}

impl Recorder for Limit {
    fn wants_rows(&self) -> bool {
        false
    }

    fn progress(&mut self, _: f64) -> Flow {
        self.left = self.left.saturating_sub(1);
        if self.left == 0 { Flow::Stop } else { Flow::Continue }
    }
}

/// Follows a run until `contact` has opened after its first interval, or has not closed up to the end of the settings, or until `effort` elements
/// times iterations are spent; the start costs as much as an iteration, and one for each pair of its contacts. `None` if the run cannot begin, or
/// not for that effort.
pub fn preview(
    model: &Model,
    settings: &Settings,
    contact: usize,
    effort: usize,
) -> Option<Preview> {
    let size = model.element_count().max(model.nodes.len()).max(1);
    let begun = size + model.pairs.len();
    let most = effort.checked_sub(begun)? / size;
    // A contact that begins within the run may open after its end.
    let endless = Settings { end: settings.step * (2 * most + 10) as f64, ..*settings };
    let mut run = Simulation::new(model, &endless).ok()?;
    let mut limit = Limit { left: most };
    let spent = |run: &Simulation<'_>| run.effort().iterations;
    while spent(&run) < most && limit.left > 0 {
        if run.advance(&mut limit).is_err() {
            break;
        }
        match first_intervals(&run)[contact] {
            Some([_, end]) if run.state().time > end + settings.step => break,
            None if run.state().time >= settings.end => break,
            _ => (),
        }
    }
    let first = first_intervals(&run);
    Some(Preview {
        step: settings.step,
        time: run.state().time,
        effort: begun + spent(&run) * size,
        first,
    })
}

fn first_intervals(run: &Simulation<'_>) -> Vec<Option<[f64; 2]>> {
    let records = run.monitor.contacts.records.iter();
    let each = records.map(|record| {
        let (ContactRecord::Smooth { intervals, .. } | ContactRecord::Nonsmooth { intervals, .. }) =
            record;
        intervals.first().map(|one| [one.start, one.end])
    });
    each.collect()
}
