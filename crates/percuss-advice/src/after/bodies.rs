//! Formulas of bodies that move as one piece while they touch.

use super::super::Comparison;
use super::super::case::{Bodies, Struck, rigid_impact};
use super::super::formulas::{Span, SpanKind, reduced_mass};
use super::super::structure::gravity_varies;
use super::super::words::{digits, quantity};
use super::observed::{Assumptions, Formula, ObservedContact, Quantity, Touch};

/// Contacts shorter than this share of a free beam's lowest period are no impact of a rigid piece.
const SHORTEST: f64 = 0.5;

/// Adds that a smooth law has no losses.
pub(super) fn lossless(observed: &ObservedContact<'_>, assumptions: Assumptions) -> Assumptions {
    match observed.case.law.smooth() {
        Some(law) => assumptions.and("no losses in the contact", law.dissipation == 0.0),
        None => assumptions,
    }
}

/// A projectile and a free beam, both rigid.
pub fn free_beam(observed: &ObservedContact<'_>, struck: &Struck<'_>) -> Vec<Comparison> {
    let Some(beam) = struck.place.free_mass().filter(|_| struck.across() > 0.999) else {
        return Vec::new();
    };
    let mass = reduced_mass([struck.mass, beam]);
    let Some(impact) = rigid_impact(observed.case.law, mass, observed.speed, 0.0) else {
        return Vec::new();
    };
    let section = struck.place.section();
    // A free beam has the frequencies of a clamped one.
    let like = Span {
        kind: SpanKind::Clamped,
        length: struck.place.beam.length(),
        bending: section.bending,
        mass: section.mass,
    };
    let share = impact.duration / like.period();
    if share < SHORTEST || struck.rear.is_some() {
        return Vec::new();
    }
    let longer = format!("contact longer than the lowest period: {} periods", digits(share));
    let formula = Formula {
        bound: false,
        name: "two free rigid bodies",
        source: "conservation of momentum and energy, with the reduced mass",
        assumptions: lossless(observed, observed.undisturbed(struck).and(longer, share >= 1.0)),
    };
    let mut quantities = observed.force_and_duration(impact.peak_force, impact.duration);
    if let Some(simulated) = observed.release_velocity(struck) {
        quantities.push(Quantity {
            name: "velocity of the projectile, after over before",
            unit: "1",
            by_hand: 1.0 - 2.0 * mass / struck.mass,
            simulated: simulated / struck.speed,
            of_run: false,
        });
    }
    observed.rows(&formula, quantities)
}

/// The impulse of a rigid projectile on a point of known effective mass.
pub fn impulse_of_struck(observed: &ObservedContact<'_>, struck: &Struck<'_>) -> Vec<Comparison> {
    let (Some(mass), Some(restitution), Touch::Impact(_)) =
        (observed.contact.effective_mass, observed.restitution(), observed.touch)
    else {
        return Vec::new();
    };
    let on_limit = reduced_mass([struck.mass, mass.limit]);
    let limit = (1.0 + restitution) * on_limit * observed.speed;
    let mesh = format!(
        "effective mass independent of the mesh (impulse in the limit: {})",
        quantity(limit, "N s")
    );
    let formula = Formula {
        bound: false,
        name: "effective mass of the struck point",
        source: "Newton's impact law with 1/(1/M + n M^-1 n)",
        assumptions: observed
            .undisturbed(struck)
            .and("no friction", !observed.rubs())
            .and(mesh, !mass.depends_on_mesh()),
    };
    newton(observed, &formula, reduced_mass([struck.mass, mass.on_mesh]), restitution)
}

/// Impulse and loss of a first impact under Newton's law. Friction takes energy of its own, and turns what it rubs: with it only the
/// impulse is compared.
fn newton(
    observed: &ObservedContact<'_>,
    formula: &Formula,
    mass: f64,
    restitution: f64,
) -> Vec<Comparison> {
    let Touch::Impact(impact) = observed.touch else { return Vec::new() };
    let loss = 0.5 * (1.0 - restitution * restitution) * mass * observed.speed * observed.speed;
    let impulse = Quantity {
        name: "impulse of the first impact",
        unit: "N s",
        by_hand: (1.0 + restitution) * mass * observed.speed,
        simulated: impact.impulse,
        of_run: false,
    };
    let lost = Quantity {
        name: "energy lost in the first impact",
        unit: "J",
        by_hand: loss,
        simulated: impact.energy.lost,
        of_run: false,
    };
    let mut quantities = vec![impulse];
    if !observed.rubs() {
        quantities.push(lost);
    }
    observed.rows(formula, quantities)
}

/// Two discs, or a disc and an obstacle at rest.
pub fn two_bodies(observed: &ObservedContact<'_>, two: &Bodies) -> Vec<Comparison> {
    if !two.simple {
        return Vec::new();
    }
    let alone =
        Assumptions::default().and("no previous contact of either body", observed.is_alone());
    if let Some(restitution) = observed.restitution() {
        let formula = Formula {
            bound: false,
            name: "two rigid bodies",
            source: "Newton's impact law with the reduced mass",
            assumptions: alone,
        };
        return newton(observed, &formula, two.mass, restitution);
    }
    let alone = lossless(observed, alone);
    let pressed = two.pressed.filter(|_| !gravity_varies(observed.model));
    let weight = pressed.unwrap_or(0.0);
    let alone = match pressed {
        Some(0.0) => alone,
        Some(weight) => {
            alone.and(format!("a weight of {} during the contact", quantity(weight, "N")), true)
        }
        None => alone.and("no weight during the contact", false),
    };
    let Some(impact) = rigid_impact(observed.case.law, two.mass, observed.speed, weight) else {
        return Vec::new();
    };
    let formula = Formula {
        bound: false,
        name: "two rigid bodies",
        source: if weight == 0.0 {
            "half a period of mass and spring, or Hertz (Johnson 1985, eq. 11.24)"
        } else {
            "energy balance of a mass on a rigid target, with its weight"
        },
        assumptions: alone,
    };
    observed.rows(&formula, observed.force_and_duration(impact.peak_force, impact.duration))
}
