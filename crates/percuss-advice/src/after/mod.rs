//! Results of a run beside hand formulas.

mod bodies;
mod bound;
mod elastic;
mod observed;
mod span;
mod waves;

use super::Comparison;
use super::case::rigid_impact;
use super::case::{self, Meeting};
use super::duration::Modes;
use observed::{ObservedContact, Touch};
use percuss::{ContactInterval, ContactSummary, Model, RunSummary, Settings};

/// Duration of a closed interval by the law of its contact, with the mass that the impulse shows \[s\]: it rebounds with the velocity with which it
/// closed.
pub fn rigid_duration(
    model: &Model,
    index: usize,
    contact: &ContactSummary,
    interval: &ContactInterval,
) -> Option<f64> {
    let speed = interval.approach_velocity;
    let mass = interval.impulse / (2.0 * speed);
    let law = model.contact(index).filter(|view| view.name() == contact.name)?.law();
    let known = speed > 0.0 && mass > 0.0 && mass.is_finite();
    known.then(|| rigid_impact(law, mass, speed, 0.0))?.map(|impact| impact.duration)
}

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
    let observed =
        ObservedContact { model, settings, run, index, contact, case: &case, touch, speed };
    if observed.speed <= 0.0 || observed.speed.is_nan() {
        return Vec::new();
    }
    match &case.meeting {
        Meeting::Struck(struck) => {
            let mut all = Vec::new();
            // These are formulas of slender beams.
            if struck.place.shear_stiffness().is_none() {
                all.extend(waves::infinite_beam(&observed, struck));
                all.extend(span::two_masses(&observed, struck));
                all.extend(span::cox(&observed, struck));
                all.extend(span::impact_factor(&observed, struck));
            }
            all.extend(bodies::free_beam(&observed, struck));
            all.extend(bodies::impulse_of_struck(&observed, struck));
            if all.is_empty() {
                all.extend(bound::of_the_force(&observed, struck, modes));
            }
            all
        }
        Meeting::Bodies(two) => bodies::two_bodies(&observed, two),
        Meeting::Beams(beams) => waves::bar_on_wall(&observed, beams),
    }
}
