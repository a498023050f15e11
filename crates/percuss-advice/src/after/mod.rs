//! Results of a run beside hand formulas.

mod bodies;
mod bound;
mod desk;
mod elastic;
mod span;
mod waves;

use super::Comparison;
use super::case::{self, Meeting};
use super::duration::Modes;
use desk::{Desk, Touch};
use percuss::{Model, RunSummary, Settings};

/// What hand formulas say about the first touch of a contact.
pub fn comparisons(
    model: &Model,
    settings: &Settings,
    run: &RunSummary,
    modes: &Modes<'_>,
    index: usize,
) -> Vec<Comparison> {
    let contact = &run.contacts[index];
    let Some(touch) = Touch::first(&contact.record) else { return Vec::new() };
    let Some(case) = case::read(model, index, Some(touch.place())) else { return Vec::new() };
    let speed = touch.approach();
    let desk = Desk { model, settings, run, index, contact, case: &case, touch, speed };
    if desk.speed <= 0.0 || desk.speed.is_nan() {
        return Vec::new();
    }
    match &case.meeting {
        Meeting::Struck(struck) => {
            let mut all = Vec::new();
            // These are formulas of slender beams.
            if struck.place.shear_stiffness().is_none() {
                all.extend(waves::infinite_beam(&desk, struck));
                all.extend(span::two_masses(&desk, struck));
                all.extend(span::cox(&desk, struck));
                all.extend(span::impact_factor(&desk, struck));
            }
            all.extend(bodies::free_beam(&desk, struck));
            all.extend(bodies::impulse_of_struck(&desk, struck));
            if all.is_empty() {
                all.extend(bound::of_the_force(&desk, struck, modes));
            }
            all
        }
        Meeting::Bodies(two) => bodies::two_bodies(&desk, two),
        Meeting::Beams(beams) => waves::bar_on_wall(&desk, beams),
    }
}
