//! First step of a run with a requested accuracy in place of a step.

use crate::math::vec2::norm;
use crate::model::frozen::BeamData;
use crate::model::{Model, SmoothLaw};

/// First steps in the time in which a membrane wave runs along the shortest beam.
const STEPS_IN_TRANSIT: f64 = 50.0;
/// First steps in the period of the lowest bending vibration of a beam clamped at both ends.
const STEPS_IN_PERIOD: f64 = 200.0;
/// That period, times `sqrt(EI / m) / L^2`: `2 pi / 4.7300^2` (Blevins 1979, table 8-1).
const CLAMPED_PERIOD: f64 = 0.280_85;
/// First steps in the time in which a body moves or falls by its radius.
const STEPS_IN_RADIUS: f64 = 50.0;
/// Number of first steps in a run without any other time scale, and their least number.
const STEPS_IN_RUN: f64 = 1000.0;
const LEAST_STEPS: f64 = 20.0;

/// First step of a run of `model` up to `end` with a requested accuracy \[s\]: a small share of the travel time of waves along its beams, of the
/// periods of these and of the times in which its bodies move by their radii.
pub fn first_step(model: &Model, end: f64) -> f64 {
    let beams = model.beams.iter().map(|beam| of_beam(model, beam));
    let gravity = model.gravity();
    let bodies = model.bodies.iter().filter_map(|body| {
        let radius = body.kind.radius()?;
        let speed = body.velocity[0].hypot(body.velocity[1]);
        Some((radius / speed).min((radius / gravity).sqrt()) / STEPS_IN_RADIUS)
    });
    let least = beams.chain(bodies).filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min);
    if least.is_finite() { least.min(end / LEAST_STEPS) } else { end / STEPS_IN_RUN }
}

/// Largest steps during contact of a guided projectile, shape (contacts) \[s\]: `share / omega`, with omega the frequency of its mass and the
/// effective mass of the struck point on the spring of their contact, whose stiffness is that at the maximum compression of their relative motion;
/// infinite for all other contacts. A mean force underestimates the peak of a harmonic one by `(h omega)^2 / 12`.
pub fn contact_steps(model: &Model, share: f64) -> Vec<f64> {
    let mut steps = vec![f64::INFINITY; model.contacts.len()];
    let masses = model.effective_masses();
    for ((projectile, struck), (contact, step)) in
        model.projectiles.iter().zip(masses).zip(model.contacts.iter().zip(&mut steps))
    {
        let Some(law) = contact.law.smooth() else { continue };
        let body = &model.bodies[projectile.body];
        let held = struck.on_mesh.max(struck.limit);
        let mass = if held.is_finite() { 1.0 / (1.0 / body.mass + 1.0 / held) } else { body.mass };
        let energy = 0.5 * mass * norm(body.velocity).powi(2);
        let stiffness = stiffness_after(law, energy);
        if stiffness > 0.0 && mass > 0.0 {
            *step = share * (mass / stiffness).sqrt();
        }
    }
    steps
}

/// Stiffness of a law where it has taken up an energy \[N/m\].
fn stiffness_after(law: &SmoothLaw, energy: f64) -> f64 {
    if !(energy > 0.0 && energy.is_finite()) {
        return 0.0;
    }
    let takes = |p: f64| law.potential.energy(p);
    let mut deep = 1e-9;
    while takes(deep) < energy && deep < 1e6 {
        deep *= 2.0;
    }
    let mut low = 0.0;
    for _ in 0..40 {
        let middle = 0.5 * (low + deep);
        if takes(middle) < energy { low = middle } else { deep = middle }
    }
    // Over the whole range: a table may be constant at its end.
    2.0 * takes(deep) / (deep * deep)
}

fn of_beam(model: &Model, beam: &BeamData) -> f64 {
    let sections = model.spans[beam.spans.clone()].iter().flat_map(|span| {
        let count = if span.section.is_uniform() { 1 } else { span.elements.len() };
        (0..count).flat_map(move |k| [0.0, 0.5, 1.0].map(|xi| span.section_at(k, xi)))
    });
    let each = sections.map(|section| {
        let (axial, bending) =
            (section.mass / section.law.axial, section.mass / section.law.bending);
        let transit = beam.length * axial.sqrt() / STEPS_IN_TRANSIT;
        let period = CLAMPED_PERIOD * beam.length.powi(2) * bending.sqrt() / STEPS_IN_PERIOD;
        if period > 0.0 { transit.min(period) } else { transit }
    });
    each.filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min)
}
