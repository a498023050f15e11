//! Formulas in which waves run away.

use super::super::Comparison;
use super::super::case::{Beams, Struck, linear_stiffness};
use super::super::formulas::pulse_frequency;
use super::super::words::digits;
use super::{Assumptions, Desk, Formula, Quantity, against};
use crate::math::vec2::{dot, norm};
use crate::summary::ContactRecord;

/// Rotary inertia below this share of the inertia across is neglected.
const ROTARY: f64 = 0.02;
/// Slopes and strains below this are small.
const SMALL: f64 = 0.05;

/// The projectile on a beam without end. Its force fits where the largest one comes before waves do; duration and rebound where
/// the whole contact does.
pub fn infinite_beam(desk: &Desk<'_>, struck: &Struck<'_>) -> Vec<Comparison> {
    let Some(blow) = struck.infinite_beam(desk.case.law, desk.speed) else { return Vec::new() };
    let Some(interval) = desk.interval() else { return Vec::new() };
    let (section, free) = (struck.place.section(), struck.place.free_distance());
    let lasts = blow.duration.unwrap_or(2.0 * blow.peak_time);
    let back = section.return_time(free, lasts);
    if back < blow.peak_time {
        return Vec::new();
    }
    let wave_number = section.wave_number(pulse_frequency(lasts));
    let rotary = section.rotary * wave_number * wave_number / section.mass;
    let slope = desk.speed * blow.peak_time * wave_number;
    let undisturbed = back >= lasts && blow.duration.is_some();
    let assumptions = desk
        .undisturbed_but_for_contact()
        .and(
            format!("no wave comes back from ends or supports: {}", against(back, lasts, "s")),
            back >= lasts,
        )
        .and(
            format!(
                "rotary inertia negligible: {} % of the shortest waves'",
                digits(100.0 * rotary)
            ),
            rotary < ROTARY,
        )
        .and(format!("small slopes: up to {}", digits(slope)), slope < SMALL);
    let formula = Formula {
        name: "infinite beam",
        source: if linear_stiffness(desk.case.law).is_some() {
            "closed form for a mass behind a linear spring on a Bernoulli beam without end"
        } else {
            "Timoshenko's integral equation for a contact law on a Bernoulli beam without end"
        },
        assumptions,
    };
    let mut quantities =
        desk.force_and_duration(blow.peak_force, blow.duration.unwrap_or(f64::NAN));
    if !undisturbed {
        quantities.truncate(1);
    }
    quantities.push(Quantity {
        name: "time from touch to the largest force",
        unit: "s",
        by_hand: blow.peak_time,
        simulated: interval.peak_force.time - interval.start,
    });
    if let (true, Some(after), Some(by_hand)) =
        (undisturbed, desk.release_velocity(struck), blow.restitution)
    {
        quantities.push(Quantity {
            name: "velocity of the projectile, after over before",
            unit: "1",
            by_hand: -by_hand,
            simulated: after / desk.speed,
        });
    }
    desk.rows(&formula, quantities)
}

/// A free bar that flies lengthwise against a wall.
pub fn bar_on_wall(desk: &Desk<'_>, beams: &Beams<'_>) -> Vec<Comparison> {
    let (tangent, place) = (beams.place.tangent(), &beams.place);
    let lengthwise = |v: [f64; 2]| dot(v, tangent).abs() > 0.999 * norm(v) && norm(v) > 0.0;
    let fits = beams.wall.is_some_and(lengthwise)
        && lengthwise(beams.velocity)
        && place.is_uniform()
        && place.free_mass().is_some();
    let (Some(last), true) = (desk.intervals().last(), fits) else { return Vec::new() };
    let section = place.section();
    let blow = section.bar_blow(place.beam.length, desk.speed);
    let strain = desk.speed / section.bar_speed();
    let one = desk.intervals().len() == 1;
    let formula = Formula {
        name: "elastic bar on a rigid wall",
        source: "Saint-Venant: one wave runs up and down the bar",
        assumptions: Assumptions::default()
            .and(format!("small strains: {}", digits(strain)), strain < SMALL)
            .and("a rigid wall, met by the whole section at once, in one contact", one),
    };
    let impulse: f64 = desk.intervals().iter().map(|i| i.impulse).sum::<f64>()
        + match &desk.contact.record {
            ContactRecord::Nonsmooth { impacts, .. } => impacts.iter().map(|i| i.impulse).sum(),
            ContactRecord::Smooth { .. } => 0.0,
        };
    let quantities = vec![
        Quantity {
            name: "time from the first touch to the release",
            unit: "s",
            by_hand: blow.duration,
            simulated: last.end - desk.touch.time(),
        },
        Quantity { name: "impulse", unit: "N s", by_hand: blow.impulse, simulated: impulse },
    ];
    desk.rows(&formula, quantities)
}
