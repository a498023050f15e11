//! Formulas in which waves run away.

use super::super::Comparison;
use super::super::case::{Beams, Struck, force, linear_stiffness, rigid_impact};
use super::super::end_on::points_of_end;
use super::super::formulas::{BarImpact, BarOnWall, UniformBeam, pulse_frequency};
use super::super::neglected_shear::NeglectedShear;
use super::super::structure::gravity;
use super::super::words::digits;
use super::observed::{Assumptions, Formula, ObservedContact, Quantity, against};
use percuss::ContactRecord;

use percuss::math::vec2::{dot, norm};

/// What changes the force by less than this share is negligible.
const NEGLIGIBLE: f64 = 0.01;
/// Slopes and strains below this are small.
const SMALL: f64 = 0.05;

/// The projectile on a beam without end. Its force fits where the largest one comes before waves do; duration and rebound where
/// the whole contact does.
pub fn infinite_beam(observed: &ObservedContact<'_>, struck: &Struck<'_>) -> Vec<Comparison> {
    let Some(impact) = struck.infinite_beam(observed.case.law, observed.speed) else {
        return Vec::new();
    };
    let Some(interval) = observed.interval() else { return Vec::new() };
    let (section, free) = (struck.place.section(), struck.place.free_distance());
    let lasts = impact.duration.unwrap_or(2.0 * impact.peak_time);
    let back = section.return_time(free, lasts);
    if back < impact.peak_time {
        return Vec::new();
    }
    let wave_number = section.wave_number(pulse_frequency(lasts));
    let slope = observed.speed * impact.peak_time * wave_number;
    let undisturbed = back >= lasts && impact.duration.is_some();
    let returns = format!("no reflected wave during the contact: {}", against(back, lasts, "s"));
    let slopes = format!("small slopes: up to {}", digits(slope));
    let mut assumptions = observed
        .undisturbed_but_for_contact(struck)
        .and(returns, back >= lasts)
        .and(slopes, slope < SMALL);
    for (what, off) in corrections(observed, struck) {
        assumptions = assumptions.and(what, off < NEGLIGIBLE);
    }
    let assumptions = observed.carried(struck, assumptions, lasts);
    let formula = Formula {
        bound: false,
        name: "infinite beam",
        source: if linear_stiffness(observed.case.law).is_some() && struck.pull() == 0.0 {
            "closed form for a mass with a linear spring on an infinite Bernoulli beam"
        } else {
            "Timoshenko's integral equation for a contact law on an infinite Bernoulli beam"
        },
        assumptions,
    };
    let mut quantities =
        observed.force_and_duration(impact.peak_force, impact.duration.unwrap_or(f64::NAN));
    if !undisturbed {
        quantities.truncate(1);
    }
    quantities.push(Quantity {
        name: match observed.intervals().len() {
            1 => "time from touch to the largest force",
            _ => "time from the first touch to the largest force of that contact",
        },
        unit: "s",
        by_hand: impact.peak_time,
        simulated: interval.peak_force.time - interval.start,
        of_run: false,
    });
    if let (true, Some(after), Some(by_hand)) =
        (undisturbed, observed.release_velocity(struck), impact.restitution)
    {
        quantities.push(Quantity {
            name: "velocity of the projectile, after over before",
            unit: "1",
            by_hand: -by_hand,
            simulated: after / observed.speed,
            of_run: false,
        });
    }
    observed.rows(&formula, quantities)
}

/// What rotary inertia, which the run has, and shear, which it has not, change of force and rebound on a beam without end, in words,
/// and the larger share of both.
fn corrections(observed: &ObservedContact<'_>, struck: &Struck<'_>) -> Vec<(String, f64)> {
    let Some([rotary, shear]) = struck.corrections(observed.case.law, observed.speed) else {
        return Vec::new();
    };
    let mut all = Vec::new();
    if struck.place.section().rotary > 0.0 {
        let what = format!(
            "rotary inertia negligible: it changes the force by {} %",
            digits(100.0 * rotary.force)
        );
        all.push((what, rotary.force.abs()));
    }
    let rebound = shear.rebound.map_or(String::new(), |share| {
        format!(" and the rebound velocity by {} %", digits(100.0 * share))
    });
    let what = format!(
        "shear deformation (neglected) small: {}it would change the force by {} %{rebound}",
        if NeglectedShear::at(&struck.place).known { "" } else { "for a solid rectangle " },
        digits(100.0 * shear.force)
    );
    let most = shear.rebound.unwrap_or(0.0).abs().max(shear.force.abs());
    all.push((what, most));
    all
}

/// A free bar that flies lengthwise against a wall.
pub fn bar_on_wall(observed: &ObservedContact<'_>, beams: &Beams<'_>) -> Vec<Comparison> {
    let (tangent, place) = (beams.place.tangent(), &beams.place);
    let lengthwise = |v: [f64; 2]| dot(v, tangent).abs() > 0.999 * norm(v) && norm(v) > 0.0;
    let fits = beams.wall.is_some_and(lengthwise)
        && lengthwise(beams.velocity)
        && place.is_uniform()
        && place.free_mass().is_some();
    let (Some(last), true) = (observed.intervals().last(), fits) else { return Vec::new() };
    let section = place.section();
    let length = place.beam.length();
    // A bar that turns meets the wall with one corner.
    let turns = observed.model.initial_motion_of(place.index).spin != 0.0;
    let one = observed.intervals().len() == 1 && !turns;
    let Some((impact, source)) = bar_impact(observed, &section, length) else { return Vec::new() };
    let strain = impact.force / section.axial;
    let pull = dot(gravity(observed.model).0, tangent).abs();
    let mut assumptions = Assumptions::default()
        .and(format!("small strains: {}", digits(strain)), strain < SMALL)
        .and("wall at rest, hit by the whole section at once, in a single contact", one)
        .and(
            "no other contact before it ends, no load, no damping",
            observed.is_alone() && observed.is_bare(),
        );
    if pull > 0.0 {
        let share = pull * impact.duration / observed.speed;
        let what =
            format!("weight negligible: {} % of the speed in the contact", digits(100.0 * share));
        assumptions = assumptions.and(what, share < NEGLIGIBLE);
    }
    let formula =
        Formula { bound: false, name: "elastic bar on a rigid wall", source, assumptions };
    let impulse: f64 = observed.intervals().iter().map(|i| i.impulse).sum::<f64>()
        + match &observed.contact.record {
            ContactRecord::Nonsmooth { impacts, .. } => impacts.iter().map(|i| i.impulse).sum(),
            ContactRecord::Smooth { .. } => 0.0,
        };
    let quantities = vec![
        Quantity {
            name: "largest contact force",
            unit: "N",
            by_hand: impact.force,
            // Under a set-valued law forces are means over steps.
            simulated: observed.largest_force().map_or(f64::NAN, |peak| peak.value),
            of_run: false,
        },
        Quantity {
            name: "time from the first touch to the release",
            unit: "s",
            by_hand: impact.duration,
            simulated: last.end - observed.touch.time(),
            of_run: false,
        },
        Quantity {
            name: "impulse",
            unit: "N s",
            by_hand: impact.impulse,
            simulated: impulse,
            of_run: false,
        },
    ];
    observed.rows(&formula, quantities)
}

/// The impact of the bar under the law of the contact, and where it comes from.
fn bar_impact(
    observed: &ObservedContact<'_>,
    section: &UniformBeam,
    length: f64,
) -> Option<(BarImpact, &'static str)> {
    let Some(law) = observed.case.law.smooth() else {
        let source = "Saint-Venant: one wave travels along the bar and back";
        return Some((section.bar_impact(length, observed.speed), source));
    };
    if law.unloading.is_some() {
        return None; // what crushes opens otherwise than it closes
    }
    let points = points_of_end(observed.model, observed.index);
    match section.bar_on_wall(length, observed.speed, |p, rate| points * force(law, p, rate))? {
        BarOnWall::Waves(impact) => {
            Some((impact, "waves in a bar whose end presses on the wall under the contact law"))
        }
        BarOnWall::OnePiece => {
            let mass = section.mass * length;
            // So many springs side by side: each has its share of the mass.
            let rigid = rigid_impact(observed.case.law, mass / points, observed.speed, 0.0)?;
            let impact = BarImpact {
                force: points * rigid.peak_force,
                duration: rigid.duration,
                impulse: 2.0 * mass * observed.speed,
            };
            let source =
                "rigid bar: the contact lasts many times the wave transit along the bar and back";
            (law.dissipation == 0.0).then_some((impact, source))
        }
    }
}
