//! Straight structures under loads beyond buckling: without an imperfection they stay straight in a run.

use super::words::{digits, quantity};
use super::{Advice, Topic, Verdict};
use percuss::{Model, Settings, Start, buckling, equilibrium};

/// Elements beyond which the loads are not examined.
const ELEMENTS: usize = 3000;
/// Instants at which the loads are compared, and of which those of their largest values are examined.
const SAMPLES: usize = 64;
const MOST_INSTANTS: usize = 4;
/// Share of the run that is an instant.
const INSTANT: f64 = 1e-9;
/// Share of the buckling load under which the structure is straight or not, and the bending moment that is round-off there, relative to the axial
/// force times the size of the structure.
const BELOW: f64 = 0.5;
const STRAIGHT: f64 = 1e-6;

/// A structure that loads or heat press beyond its linear buckling factor in a run, and do not bend before: nothing that is modelled decides when and
/// to which side it buckles.
///
/// A structure that is struck or moves is bent by that; an unstable static start is another finding.
pub fn under_loads(model: &Model, settings: &Settings) -> Option<Advice> {
    let disturbed = model.contacts().len() > 0 || !model.is_still();
    if disturbed || model.loads().len() == 0 || model.element_count() > ELEMENTS {
        return None;
    }
    instants(model, settings).into_iter().find_map(|time| {
        let factors: Vec<f64> =
            model.loads().map(|load| load.factor(time, INSTANT * settings.end)).collect();
        if time == 0.0 && settings.start == Start::Static {
            return None;
        }
        let steady = |share: f64| {
            let factors: Vec<f64> = factors.iter().map(|factor| share * factor).collect();
            model.under_steady_loads(&factors)
        };
        let found = buckling(&steady(1.0), 1);
        let factor = found.modes.first()?.factor;
        let bends = factor >= 1.0 || !is_straight(&steady(BELOW * factor));
        (!bends).then(|| advice(factor, time))
    })
}

/// Times at which loads are largest \[s\].
fn instants(model: &Model, settings: &Settings) -> Vec<f64> {
    let times = (0..=SAMPLES).map(|k| settings.end * k as f64 / SAMPLES as f64);
    let mut found: Vec<f64> = Vec::new();
    for load in model.loads() {
        let size = |time: &f64| load.factor(*time, INSTANT * settings.end).abs();
        let largest = times.clone().max_by(|a, b| size(a).total_cmp(&size(b)).then(b.total_cmp(a)));
        found.extend(largest.filter(|time| !found.contains(time)));
        if found.len() == MOST_INSTANTS {
            break;
        }
    }
    found
}

/// Whether the loads do not bend the structure but press it.
fn is_straight(model: &Model) -> bool {
    let Ok(found) = equilibrium(model) else { return false };
    let largest = |of: fn(&percuss::SectionForceSummary) -> f64| {
        found.section_forces.iter().map(of).fold(0.0, f64::max)
    };
    let axial = largest(|beam| beam.axial.largest().value.abs());
    let moment = largest(|beam| beam.moment.largest().value.abs());
    moment <= STRAIGHT * axial * model.extent()
}

fn advice(factor: f64, time: f64) -> Advice {
    let text = format!(
        "the loads at t = {} are {} times those of linear buckling, and do not bend the structure before: without an imperfection it stays straight \
         (a slight curvature, an eccentricity or a small lateral load makes it buckle)",
        quantity(time, "s"),
        digits(1.0 / factor)
    );
    Advice::new("loads", Topic::Stability, [1.0 / factor, 1.0], "1", Verdict::Warning, text)
}
