//! An upper bound of the force of an impact on a structure that no other formula knows.

use super::super::Comparison;
use super::super::case::{Struck, rigid_impact};
use super::super::duration::Modes;
use super::super::structure::gravity;
use super::super::surroundings::Surroundings;
use super::super::words::digits;
use super::bodies::lossless;
use super::observed::{Formula, ObservedContact, Quantity, Touch};
use percuss::Start;
use percuss::math::vec2::{dot, norm};

/// Compliances are taken so much larger than that of the modes, of which there are finitely many.
const MORE: f64 = 1.2;

/// The force of a lossless contact on anything passive: a bound, and why.
///
/// Let a mass M, with another one M' behind it on a spring, meet at relative speed v a structure that has no energy to give: at rest
/// and free of stress. Energies of motion and of strain are never negative and their sum only falls (damping), so that the potential
/// of the contact never exceeds what there was: `V(p) <= (M + M') v^2/2`, and with a force `V'` that grows with p,
/// `F <= V'(p_max)`, on a spring `v sqrt(k (M + M'))`. The velocity of a disc along the beam counts, since a beam that turns may turn
/// it into one across. There is no such bound of the duration: a light beam throws a mass back in less than half a period of mass and
/// spring, and one that yields keeps it longer.
///
/// A weight `W = (M + M') g` adds its work `W (p + w)`, w the way of the struck point. A linear structure of stiffness K there stores
/// at least `K w^2/2`, and `W w - K w^2/2 <= W^2/(2K)`; the spring K' behind stores its own, `M' g e - K' e^2/2 <= (M' g)^2/(2K')`:
/// `V(p) - W p <= (M + M') v^2/2 + W^2/(2K) + (M' g)^2/(2K')`.
pub fn of_the_force(
    observed: &ObservedContact<'_>,
    struck: &Struck<'_>,
    modes: &Modes<'_>,
) -> Vec<Comparison> {
    let (Touch::Interval(interval), Some(peak)) = (observed.touch, observed.largest_force()) else {
        return Vec::new();
    };
    let (pull, behind) = (struck.pull(), struck.rear.map_or(0.0, |rear| rear.mass));
    let mass = struck.mass + behind;
    let fallen = norm(gravity(observed.model).0) * interval.start;
    let sideways = if observed.case.guided.is_some() { 0.0 } else { struck.sideways + fallen };
    let weight = mass * pull;
    let yields = match weight {
        0.0 => 0.0,
        _ => weight * weight * MORE * modes.target(struck).compliance(),
    };
    let swings = struck.rear.map_or(0.0, |rear| (rear.mass * pull).powi(2) / rear.stiffness);
    // What there is, as the speed of the mass that would have it.
    let speed = (observed.speed.powi(2) + sideways.powi(2) + (yields + swings) / mass).sqrt();
    let Some(impact) = rigid_impact(observed.case.law, mass, speed, weight) else {
        return Vec::new();
    };
    let bare = (observed.speed.powi(2) + sideways.powi(2)).sqrt();
    let without =
        rigid_impact(observed.case.law, mass, bare, 0.0).map_or(f64::NAN, |b| b.peak_force);
    let around = Surroundings::of(observed.model, struck.place.index);
    let relaxed = around.is_relaxed(observed.model);
    let weighs = dot(gravity(observed.model).0, struck.direction) != 0.0 && around.held;
    let mut assumptions = lossless(observed, observed.at_rest(struck))
        .and("no strain before the contact except due to weights", relaxed)
        .and(
            "one point of contact",
            observed.model.contact(observed.index).is_some_and(|c| c.pairs().len() == 1),
        );
    if norm(gravity(observed.model).0) > 0.0 && around.held {
        let carries = observed.settings.start == Start::Static;
        assumptions =
            assumptions.and("equilibrium under the own weight before the contact", carries);
    }
    let yielded = observed.inelastic().iter().any(Option::is_some);
    if weighs {
        let what = format!(
            "linear structure under the weight, which contributes {} % of the force",
            digits(100.0 * (1.0 - without / impact.peak_force))
        );
        assumptions = match yielded {
            true => assumptions.and(what, false),
            false => assumptions.and_unchecked(what),
        };
    }
    // Energies that are dissipated leave less for the contact: what yields does not touch the bound itself. All of the run is compared
    // with it: whenever the contact closes again, there is no more energy than at first.
    if observed.model.contacts().len() > 1 {
        let what = "no other contact before the peak force";
        assumptions = assumptions.and(what, observed.is_alone_until(peak.time));
    }
    let formula = Formula {
        name: if assumptions.hold() {
            "upper bound of the force"
        } else {
            "all energy stored in the contact"
        },
        bound: true,
        source: "the contact stores at most the kinetic energy and the work of the weight: V(p) <= M v^2/2 + work; with a spring v sqrt(k M)",
        assumptions,
    };
    let force = Quantity {
        name: "largest contact force",
        unit: "N",
        by_hand: impact.peak_force,
        simulated: peak.value,
        of_run: false,
    };
    observed.rows_of_anything(&formula, vec![force])
}
