//! The cheapest settings with which every result is as accurate as wanted.

use percuss::Section;

use super::converged::{Converged, Sequence};

/// Settings looked at are so many times halved or doubled against the given ones.
const COARSER: i32 = 2;
const FINER: i32 = 10;
/// Fewest fibres through the depth of a section.
const FEWEST_FIBRES: f64 = 4.0;

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
    /// Times the fibres of the given sections; one where they are not refined, NaN where none serves.
    pub fibre_factor: f64,
    /// Steps times elements times fibres over those of the given settings.
    pub cost: f64,
    /// Results for which no such settings are known, each with the reason, shape (results).
    pub out_of_reach: Vec<String>,
}

/// Powers of two by which step, mesh and fibres are refined.
type Powers = [i32; 3];

impl Cheapest {
    /// From what the levels showed, with the steps \[s\], elements and fibres of each: errors fall with the observed orders; where there is
    /// none, only what was run counts.
    pub fn of(
        results: &[Converged],
        accuracy: f64,
        steps: &[f64],
        elements: &[usize],
        fibres: &[usize],
    ) -> Self {
        let all = choices(elements, fibres);
        let mut out_of_reach = Vec::new();
        let mut counted = Vec::new();
        for result in results {
            let off = |powers: &Powers| error(result, powers) / result.limit.abs();
            let best = all.iter().map(off).fold(f64::INFINITY, f64::min);
            if result.limit.is_nan() {
                out_of_reach.push(format!("{}: {}", result.path, result.unknown()));
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
        let fits = |powers: &&Powers| {
            counted.iter().all(|result| error(result, powers) <= accuracy * result.limit.abs())
        };
        let cost = |powers: &Powers| powers.iter().sum::<i32>();
        // Of equal cost the finer mesh: its errors are the less regular ones.
        let best = all.iter().filter(fits).min_by_key(|powers| (cost(powers), -powers[1]));
        let times = |k: usize| match best {
            Some(powers) if !counted.is_empty() => 2_f64.powi(powers[k]),
            _ => f64::NAN,
        };
        Self {
            accuracy,
            step: steps[0] / times(0),
            mesh_factor: times(1),
            elements: times(1) * elements[0] as f64,
            fibre_factor: times(2),
            cost: times(0) * times(1) * times(2),
            out_of_reach,
        }
    }
}

/// What may be chosen: nothing that is not refined is changed, and sections have only so many fibres.
fn choices(elements: &[usize], fibres: &[usize]) -> Vec<Powers> {
    let meshes = if elements.len() > 1 { -COARSER..=FINER } else { 0..=0 };
    let allowed = FEWEST_FIBRES..=Section::MOST_FIBRES as f64;
    let sections = if fibres.len() > 1 { -COARSER..=FINER } else { 0..=0 };
    let sections: Vec<i32> = sections
        .filter(|k| fibres.len() < 2 || allowed.contains(&(2_f64.powi(*k) * fibres[0] as f64)))
        .collect();
    let of_step = |step: i32| {
        let sections = sections.clone();
        meshes
            .clone()
            .flat_map(move |mesh| sections.clone().into_iter().map(move |k| [step, mesh, k]))
    };
    (-COARSER..=FINER).flat_map(of_step).collect()
}

/// Error of a result at settings so many times refined, as far as the runs tell: those in which all was refined as far, or what those of
/// each direction add up to.
fn error(result: &Converged, powers: &Powers) -> f64 {
    let least = powers.iter().copied().min().unwrap_or(0);
    by_directions(result, powers).min(as_run(&result.together, least))
}

/// That of each direction, and what refining all at once changes beyond their sum, which either direction brings down.
fn by_directions(result: &Converged, powers: &Powers) -> f64 {
    let sequences = [&result.step, &result.mesh, &result.fibres];
    let sum: f64 = sequences.iter().zip(powers).map(|(one, k)| error_of(one, *k)).sum();
    let apart: f64 = sequences.iter().map(|one| one.found.limit - one.compared[0]).sum();
    let together = result.limit - result.together.compared[0];
    sum + (together - apart).abs() * 2_f64.powi(-powers.iter().sum::<i32>())
}

/// Error of a result at `2^k` times the fineness given in one direction, as far as the sequence tells.
fn error_of(sequence: &Sequence, k: i32) -> f64 {
    let (found, values) = (&sequence.found, &sequence.compared);
    if found.constant || values.len() < 3 {
        return 0.0;
    }
    if let Some(order) = found.order {
        let first = (values[0] - found.limit).abs() + found.uncertainty;
        return first * 2_f64.powf(-order * f64::from(k));
    }
    as_run(sequence, k)
}

/// Error that the runs at `2^k` times the fineness given and finer had, against the limit; nothing beyond them is known, and nothing coarser.
fn as_run(sequence: &Sequence, k: i32) -> f64 {
    let (found, values) = (&sequence.found, &sequence.compared);
    let last = values.len().saturating_sub(1);
    let from = usize::try_from(k).ok().and_then(|k| values.get(k..last));
    let off = |all: &[f64]| all.iter().map(|v| (v - found.limit).abs()).fold(0.0, f64::max);
    from.filter(|rest| !rest.is_empty()).map_or(f64::INFINITY, |rest| off(rest) + found.uncertainty)
}
