//! Formulas that make one spring and one mass of a span.

use super::super::Comparison;
use super::super::case::{Struck, linear_stiffness};
use super::super::formulas::{Span, impact_factor as factor};
use super::super::neglected_shear::NeglectedShear;
use super::super::words::digits;
use super::observed::{Assumptions, Formula, ObservedContact, Quantity, against};
use percuss::Start;

/// Deflections below this share of the radius of gyration (or of the span, where its ends can slide) are small.
const SMALL: f64 = 0.3;
const SMALL_SLIDING: f64 = 0.05;
/// A weight below this share of the largest force is negligible; above the second it governs.
const LIGHT: f64 = 0.02;
const HEAVY: f64 = 0.2;
/// Compliance by shear below this share of that by bending is negligible.
const SHEAR: f64 = 0.02;

/// Adds that deflections must be small for the span's stiffness to be what it is.
fn small(assumptions: Assumptions, struck: &Struck<'_>, deflection: f64) -> Assumptions {
    let section = struck.place.section();
    let (limit, what) = if struck.place.is_held_lengthwise() {
        let gyration = section.gyration();
        (
            SMALL * gyration,
            "deflection so small that axially restrained ends do not stiffen the span",
        )
    } else {
        (SMALL_SLIDING * struck.place.beam.length(), "deflection small relative to the span")
    };
    assumptions.and(format!("{what}: {}", against(deflection, limit, "m")), deflection < limit)
}

fn weightless(
    observed: &ObservedContact<'_>,
    struck: &Struck<'_>,
    assumptions: Assumptions,
    force: f64,
) -> Assumptions {
    let weight = (struck.mass * observed.gravity_along(struck.direction)).abs();
    let share = weight / force;
    if weight == 0.0 {
        return assumptions;
    }
    assumptions
        .and(format!("weight negligible: {} % of the force", digits(100.0 * share)), share < LIGHT)
}

/// Static deflection of the struck point under the span's own weight, along the impact \[m\].
fn sag(observed: &ObservedContact<'_>, struck: &Struck<'_>, span: &Span) -> f64 {
    span.sag(span.mass * observed.gravity_along(struck.direction))
}

/// Adds that the span hangs at rest under its own weight, or that this is nothing beside the deflection by the impact. Displacements
/// count from the reference, so that of a span that hangs the sag comes on top.
fn hangs(
    observed: &ObservedContact<'_>,
    assumptions: Assumptions,
    sag: f64,
    deflection: f64,
) -> Assumptions {
    if sag == 0.0 || observed.settings.start == Start::Static {
        return assumptions;
    }
    let what = format!(
        "equilibrium under its own weight before the impact (start = \"static\"), or small vibration under it: {}",
        against(2.0 * sag.abs(), deflection, "m")
    );
    assumptions.and(what, 2.0 * sag.abs() < LIGHT * deflection)
}

/// What the sag adds to the deflections of the run: it comes on top where the run starts with it \[m\].
fn hung(observed: &ObservedContact<'_>, sag: f64) -> f64 {
    if observed.settings.start == Start::Static { sag } else { 0.0 }
}

/// The deflection beside that of the run.
fn deflection(observed: &ObservedContact<'_>, struck: &Struck<'_>, by_hand: f64) -> Quantity {
    let name = "largest deflection of the struck point";
    let simulated = observed.deflection(struck).map_or(f64::NAN, |[value, _]| value);
    Quantity { name, unit: "m", by_hand, simulated, of_run: true }
}

fn moment(observed: &ObservedContact<'_>, struck: &Struck<'_>, by_hand: f64) -> Quantity {
    let simulated = observed.moment(struck);
    Quantity { name: "largest bending moment", unit: "N m", by_hand, simulated, of_run: true }
}

/// Adds that shear would let the span give way little more.
fn stiff_in_shear(struck: &Struck<'_>, span: &Span, assumptions: Assumptions) -> Assumptions {
    let share = span.shear_share(NeglectedShear::at(&struck.place).stiffness);
    let what = format!(
        "shear deformation (neglected) would increase the static deflection by {} %",
        digits(100.0 * share)
    );
    assumptions.and(what, share < SHEAR)
}

/// Projectile, contact spring, reduced mass and stiffness of the span.
pub fn two_masses(observed: &ObservedContact<'_>, struck: &Struck<'_>) -> Vec<Comparison> {
    let Some((impact, span)) = struck.two_masses(observed.case.law, observed.speed) else {
        return Vec::new();
    };
    let share = impact.duration / span.period();
    let assumptions = observed.undisturbed(struck).and(
        format!("contact longer than the lowest period: {} periods", digits(share)),
        share >= 1.0,
    );
    let assumptions = small(assumptions, struck, impact.deflection);
    let sag = sag(observed, struck, &span);
    let assumptions = hangs(observed, assumptions, sag, impact.deflection);
    let assumptions = stiff_in_shear(struck, &span, assumptions);
    let formula = Formula {
        bound: false,
        name: "two-degree-of-freedom model",
        source: "Shivakumar, Elber and Illg 1985, with the span's reduced mass",
        assumptions: weightless(observed, struck, assumptions, impact.peak_force),
    };
    let mut all =
        observed.rows(&formula, observed.force_and_duration(impact.peak_force, impact.duration));
    // The run tells the largest deflection of all its time.
    let first = formula.assumptions.and(WITHIN, stays(observed, struck));
    let formula = Formula { assumptions: first, ..formula };
    all.extend(observed.rows(
        &formula,
        vec![deflection(observed, struck, impact.deflection + hung(observed, sag))],
    ));
    all
}

/// A mass that strikes and stays.
pub fn cox(observed: &ObservedContact<'_>, struck: &Struck<'_>) -> Vec<Comparison> {
    let (Some(span), Some(0.0)) = (struck.span(), observed.restitution()) else {
        return Vec::new();
    };
    let cox = span.cox(struck.mass, observed.speed);
    let force = span.stiffness() * cox.deflection;
    let weight = struck.mass * observed.gravity_along(struck.direction).abs();
    if weight > HEAVY * force {
        return Vec::new(); // a case for the impact factor
    }
    let sag = sag(observed, struck, &span);
    let formula = |assumptions| Formula {
        bound: false,
        name: "Cox",
        source: "Cox 1849: conservation of momentum of the mass and the reduced span, then of their energy",
        assumptions,
    };
    let assumptions = || {
        let stays = observed.undisturbed(struck).and(STAYS, stays(observed, struck));
        let small = small(stays, struck, cox.deflection);
        let hangs = hangs(observed, small, sag, cox.deflection);
        weightless(observed, struck, stiff_in_shear(struck, &span, hangs), force)
    };
    let mut all = observed.rows(
        &formula(assumptions()),
        vec![deflection(observed, struck, cox.deflection + hung(observed, sag))],
    );
    let bent = assumptions().and(STATIC_SHAPE, false);
    all.extend(observed.rows(&formula(bent), vec![moment(observed, struck, cox.moment)]));
    all
}

/// No span is bent so while waves of the impact run through it.
const STATIC_SHAPE: &str =
    "deflected shape of a static force (waves of the impact increase the moment)";
const WITHIN: &str = "peak deflection during the first contact";
const STAYS: &str = "mass in contact until the peak deflection";

/// Whether the contact is closed when the deflection is largest; one under a smooth law, for the first time: a mass that comes back
/// strikes a span that moves.
fn stays(observed: &ObservedContact<'_>, struck: &Struck<'_>) -> bool {
    let Some([_, time]) = observed.deflection(struck) else { return false };
    let first = if observed.interval().is_some() { 1 } else { usize::MAX };
    observed
        .intervals()
        .iter()
        .take(first)
        .any(|i| i.start <= time && (i.end.is_nan() || time <= i.end))
}

/// A weight that falls on a span, with and without the span's mass.
pub fn impact_factor(observed: &ObservedContact<'_>, struck: &Struck<'_>) -> Vec<Comparison> {
    let pull = observed.gravity_along(struck.direction);
    let Some(span) = struck.span() else { return Vec::new() };
    let spring = linear_stiffness(observed.case.law);
    let plastic = observed.restitution() == Some(0.0);
    let [across, along] = struck.gravity_shares();
    if !(pull > 0.0 && across > 0.999 * along) || (spring.is_none() && !plastic) {
        return Vec::new();
    }
    let (weight, own) = (struck.mass * pull, span.stiffness());
    let series = spring.map_or(own, |k| 1.0 / (1.0 / k + 1.0 / own));
    let height = observed.speed * observed.speed / (2.0 * pull);
    let ratio = span.reduced_mass() / struck.mass;
    let sag = span.sag(span.mass * pull);
    let row = |name, source, height: f64, light: bool| {
        let by_hand = weight / own * factor(height, weight / series);
        if sag > HEAVY * by_hand {
            return Vec::new(); // the span's own weight governs
        }
        let assumptions = || {
            let stays = observed.undisturbed(struck).and(STAYS, stays(observed, struck));
            let all = stiff_in_shear(struck, &span, hangs(observed, stays, sag, by_hand));
            let share =
                format!("light span: its reduced mass is {} of the falling mass", digits(ratio));
            small(if light { all.and(share, ratio < LIGHT) } else { all }, struck, by_hand)
        };
        let formula = |assumptions| Formula { bound: false, name, source, assumptions };
        let bent = assumptions().and(STATIC_SHAPE, false);
        let bending = vec![deflection(observed, struck, by_hand + hung(observed, sag))];
        let mut all = observed.rows(&formula(assumptions()), bending);
        let by_hand = span.moment(own * by_hand);
        all.extend(observed.rows(&formula(bent), vec![moment(observed, struck, by_hand)]));
        all
    };
    let plain =
        "1 + sqrt(1 + 2 h/d), d the static deflection: all energy goes into bending of the span";
    let reduced = "the same with the height over 1 + m/M, m the span's reduced mass (Cox 1849)";
    let mut all = row("impact factor", plain, height, true);
    all.extend(row("impact factor, heavy span", reduced, height / (1.0 + ratio), false));
    all
}
