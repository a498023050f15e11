//! The cheapest settings with which every result is as accurate as wanted.

use super::{Converged, Sequence};

/// Settings looked at are so many times halved or doubled against the given ones.
const COARSER: i32 = 2;
const FINER: i32 = 10;

/// The cheapest settings for an accuracy.
#[derive(Clone, Debug, PartialEq)]
pub struct Cheapest {
    /// Relative accuracy wanted.
    pub accuracy: f64,
    /// Step \[s\]; NaN where none serves.
    pub step: f64,
    /// Times the elements of the given mesh; a fraction for a coarser one. NaN where none serves.
    pub mesh_factor: f64,
    /// Number of elements in all, about.
    pub elements: f64,
    /// Steps times elements over those of the given settings.
    pub cost: f64,
    /// Results for which no such settings can be told, each with the reason.
    pub out_of_reach: Vec<String>,
}

impl Cheapest {
    /// From what the ladder showed: errors fall with the observed orders; where there is none, only what was run counts.
    pub fn of(results: &[Converged], accuracy: f64, steps: &[f64], elements: &[usize]) -> Self {
        let mut out_of_reach = Vec::new();
        let mut counted = Vec::new();
        for result in results {
            let off = |sequence: &Sequence, k: i32| error(sequence, k) / result.limit.abs();
            let best = (-COARSER..=FINER)
                .map(|k| off(&result.step, k))
                .fold(f64::INFINITY, f64::min)
                + (-COARSER..=FINER).map(|k| off(&result.mesh, k)).fold(f64::INFINITY, f64::min);
            if result.limit.is_nan() {
                let of_step = result.step.no_limit || result.step.found.limit.is_nan();
                let words = if of_step { &result.step.words } else { &result.mesh.words };
                out_of_reach.push(format!("{}: {words}", result.path));
            } else if best <= accuracy {
                counted.push(result);
            } else {
                out_of_reach.push(format!(
                    "{}: no settings within reach are known to do, best {:.2} %",
                    result.path,
                    100.0 * best
                ));
            }
        }
        let fits = |step: i32, mesh: i32| {
            counted
                .iter()
                .all(|r| error(&r.step, step) + error(&r.mesh, mesh) <= accuracy * r.limit.abs())
        };
        let all = (-COARSER..=FINER).flat_map(|s| (-COARSER..=FINER).map(move |m| (s, m)));
        // Of equal cost the finer mesh: its errors are the less regular ones.
        let best = all.filter(|(s, m)| fits(*s, *m)).min_by_key(|(s, m)| (s + m, -m));
        let (step, mesh) = match best {
            Some((step, mesh)) if !counted.is_empty() => (2_f64.powi(step), 2_f64.powi(mesh)),
            _ => (f64::NAN, f64::NAN),
        };
        Self {
            accuracy,
            step: steps[0] / step,
            mesh_factor: mesh,
            elements: mesh * elements[0] as f64,
            cost: step * mesh,
            out_of_reach,
        }
    }
}

/// Error of a result at `2^k` times the fineness given, as far as the sequence tells.
fn error(sequence: &Sequence, k: i32) -> f64 {
    let (found, values) = (&sequence.found, &sequence.values);
    if found.constant || values.len() < 3 {
        return 0.0;
    }
    if let Some(order) = found.order {
        let first = (values[0] - found.limit).abs() + found.uncertainty;
        return first * 2_f64.powf(-order * f64::from(k));
    }
    // What was run, against the finest value; nothing beyond it is known, and nothing coarser.
    let from = usize::try_from(k).ok().and_then(|k| values.get(k..values.len() - 1));
    let off = |all: &[f64]| all.iter().map(|v| (v - found.limit).abs()).fold(0.0, f64::max);
    from.filter(|rest| !rest.is_empty()).map_or(f64::INFINITY, off)
}
