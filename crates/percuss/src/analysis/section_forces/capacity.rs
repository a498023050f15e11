//! What a section that can yield bears with the strain that it has, and section forces beyond that.
//!
//! The curvature of an element is linear between its nodes and the slope continuous, so that a plastic hinge cannot be shorter than an element: section
//! forces, which follow from balance, exceed there what the fibres bear. The excess is an error of the mesh.
//!
//! A fibre bears no more than its yield stress at the strain that it has, hardening, viscous overstress and damping included. Of all stresses within
//! these limits and with the axial force N the largest moment is, by the duality of linear programming (the lower bound theorem of plasticity),
//!
//! `M(N) = min_c (c N + sum A max(T (y - c), -C (y - c)))`
//!
//! with the limits T in tension and C in compression, reached at a height c of one of the fibres: the plastic neutral axis.

use super::element::{ElementForces, PLACES};
use super::fibres_now::{StrainsAndRates, strains_and_rates};
use super::line::SectionForces;
use crate::element::fibre::{FibreState, StressLaw};
use crate::element::shear::MIDDLE;
use crate::math::hermite::{GAUSS, gauss_points};
use crate::model::frozen::{Span, SpanFibres};
use crate::state::State;
use crate::summary::{SectionExcess, SectionForceSummary};

/// Excesses up to here are round-off.
const NO_EXCESS: f64 = 1e-6;

/// The limits of one fibre.
#[derive(Clone, Copy)]
struct Limits {
    /// Height above the centre line \[m\].
    height: f64,
    /// Force that it bears in compression, as a magnitude, and in tension, shape (2) \[N\].
    force: [f64; 2],
}

/// Enters the largest excess of an element into the record of its beam: at its ends, in its middle, on both sides of forces between, and where
/// the moment between these is largest.
pub(super) fn take(
    piece: &ElementForces<'_>,
    fibres: &SpanFibres,
    state: &State,
    out: &mut SectionForceSummary,
) {
    let Some(least) = first_yield_strain(fibres) else { return };
    let mut look = |xi: f64, forces: &SectionForces| {
        if elastic_strain(piece, xi, forces, fibres) > least {
            take_at(piece, fibres, state, (xi, forces), out);
        }
    };
    let mut from = 0.0;
    let mut ahead = piece.line.at(from, piece.inner, true);
    look(from, &ahead);
    while from < 1.0 {
        let to = piece.next_stop(from, &PLACES);
        let behind = piece.line.at(to, piece.inner, false);
        let rises = [(from, ahead.rise.moment), (to, behind.rise.moment)];
        if rises[0].1 * rises[1].1 < 0.0 {
            let xi = piece.line.stationary(rises, piece.inner, |rise| rise.moment);
            look(xi, &piece.line.at(xi, piece.inner, false));
        }
        look(to, &behind);
        from = to;
        if from < 1.0 {
            ahead = piece.line.at(from, piece.inner, true);
            look(from, &ahead);
        }
    }
}

/// Enters the excess of section forces at a share of the way along an element, if it is the largest so far.
fn take_at(
    piece: &ElementForces<'_>,
    fibres: &SpanFibres,
    state: &State,
    (xi, forces): (f64, &SectionForces),
    out: &mut SectionForceSummary,
) {
    let known = out.excess.map_or(1.0 + NO_EXCESS, |known| known.ratio);
    let SectionForces { axial, moment, .. } = *forces;
    let of = |(k, xi): (usize, f64)| {
        let limits = limits((piece.span, k), fibres, state, xi)?;
        ratio_above(&limits, [axial, moment], known)
    };
    // Curvature jumps at a node: the section bears what either side says.
    let beside = match xi {
        0.0 => piece.k.checked_sub(1).map(|k| (k, 1.0)),
        1.0 => Some((piece.k + 1, 0.0)).filter(|(k, _)| *k < piece.span.elements.len()),
        _ => None,
    };
    let ratio = of((piece.k, xi));
    if let Some(ratio) = ratio.and_then(|own| beside.map_or(Some(own), of).map(|b| b.min(own))) {
        let (s, time) = (piece.s(xi), state.time);
        let element = piece.span.stations[piece.k + 1] - piece.span.stations[piece.k];
        out.excess = Some(SectionExcess { ratio, axial, moment, s, time, element });
    }
}

/// The least strain at which a fibre of the virgin material yields; none where fibres bear without limit.
fn first_yield_strain(fibres: &SpanFibres) -> Option<f64> {
    let strain = |law: &StressLaw| match law {
        StressLaw::Plastic(law) => Some(law.plasticity.first_yield() / law.young),
        StressLaw::Elastic { .. } | StressLaw::OneSided { .. } => None,
    };
    // The first law is the material of the beam, which given fibres need not have.
    let bears = |(number, law): (usize, &StressLaw)| {
        let of = |f: &crate::element::fibre::Fibre| f.carries_force && f.law == number;
        fibres.at[0].iter().flatten().any(of).then(|| strain(law))
    };
    let all: Option<Vec<f64>> = fibres.laws.iter().enumerate().filter_map(bears).collect();
    all.filter(|all| !all.is_empty()).map(|all| all.into_iter().fold(f64::INFINITY, f64::min))
}

/// Largest strain of an elastic section under the forces.
fn elastic_strain(
    piece: &ElementForces<'_>,
    xi: f64,
    forces: &SectionForces,
    fibres: &SpanFibres,
) -> f64 {
    let law = piece.span.section_at(piece.k, xi).law;
    let heights = fibres.of(piece.k)[near(piece.span, xi)].iter().map(|fibre| fibre.height.abs());
    let height = heights.fold(0.0, f64::max);
    forces.axial.abs() / law.axial + forces.moment.abs() * height / law.bending
}

/// The Gauss point whose fibres stand for a place.
fn near(span: &Span, xi: f64) -> usize {
    match span.shear {
        Some(_) => MIDDLE,
        None => ((xi * GAUSS as f64) as usize).min(GAUSS - 1),
    }
}

/// Limits of all fibres at a share of the way along an element; none if one has no limit.
fn limits(
    (span, k): (&Span, usize),
    fibres: &SpanFibres,
    state: &State,
    xi: f64,
) -> Option<Vec<Limits>> {
    let j = near(span, xi);
    let strains = strains_and_rates(span, k, state);
    let (here, there) = (strains[j], at(&strains, xi));
    let of = state.fibres_of(fibres, k);
    let bearing = of.at(j).filter(|(fibre, _)| fibre.carries_force);
    let limits = bearing.map(|(fibre, memory)| {
        let strain = |[of, rate]: &StrainsAndRates| {
            [of, rate].map(|[membrane, bending]| membrane + fibre.height * bending)
        };
        let law = &fibres.laws[fibre.law];
        let own = limits_of(law, memory, [strain(&here), strain(&there)], span.retardation)?;
        Some(Limits { height: fibre.height, force: own.map(|stress| fibre.area * stress) })
    });
    limits.collect()
}

/// Strains at a share of the way: the straight line through those of the outer Gauss points.
fn at(strains: &[StrainsAndRates; GAUSS], xi: f64) -> StrainsAndRates {
    let points = gauss_points();
    let (first, last) = (points[0], points[GAUSS - 1]);
    let share = (xi - first) / (last - first);
    let mix = |a: f64, b: f64| a + share * (b - a);
    [0, 1].map(|n| [0, 1].map(|i| mix(strains[0][n][i], strains[GAUSS - 1][n][i])))
}

/// Magnitudes of the stresses that a fibre bears, in compression and in tension, shape (2) \[Pa\]; none if it has no limit. Strain and rate of strain
/// are those at the Gauss point of its `memory` and at the place.
fn limits_of(
    law: &StressLaw,
    memory: &FibreState,
    [here, there]: [[f64; 2]; 2],
    retardation: f64,
) -> Option<[f64; 2]> {
    let StressLaw::Plastic(own) = law else { return None };
    // What is left of a section that tears is strained beyond any mesh.
    if memory.failed {
        return None;
    }
    let plasticity = &own.plasticity;
    let strained = memory.accumulated.max(there[0].abs());
    let rate = there[1].abs().max(here[1].abs());
    let now = law.stress(memory, here[0]) - plasticity.kinematic * memory.plastic;
    let flowing = now.abs() / plasticity.yield_stress(memory.accumulated);
    let faster = plasticity
        .overstress
        .map_or(1.0, |law| (1.0 + (rate / law.rate).powf(law.exponent.recip())).max(flowing));
    let back = plasticity.kinematic * memory.plastic.abs().max(there[0].abs());
    let most = plasticity.yield_stress(strained) * faster + back + own.young * retardation * rate;
    Some(match own.slack {
        None => [most; 2],
        Some(crate::model::Slack::Tension) => [most, 0.0],
        Some(crate::model::Slack::Compression) => [0.0, most],
    })
}

/// Whether the section bears an axial force and a moment. A positive moment stretches the side of negative heights.
fn bears(limits: &[Limits], [axial, moment]: [f64; 2]) -> bool {
    let most = |side: usize| limits.iter().map(|one| one.force[side]).sum::<f64>();
    if axial > most(1) || axial < -most(0) {
        return false;
    }
    // Of the mirrored section with the moment of the other sign.
    let sign = if moment > 0.0 { -1.0 } else { 1.0 };
    let about = |c: f64| {
        let turned = limits.iter().map(|one| {
            let arm = sign * (one.height - c);
            (one.force[1] * arm).max(-one.force[0] * arm)
        });
        sign * c * axial + turned.sum::<f64>()
    };
    let largest = limits.iter().map(|one| about(one.height)).fold(f64::INFINITY, f64::min);
    moment.abs() <= largest
}

/// The section forces over those in the same proportion that the section bears, if that is more than `known`.
fn ratio_above(limits: &[Limits], own: [f64; 2], known: f64) -> Option<f64> {
    let within = |ratio: f64| bears(limits, own.map(|force| force / ratio));
    if within(known) {
        return None;
    }
    let (mut low, mut high) = (known, 2.0 * known);
    while !within(high) {
        if high > 1e12 {
            return Some(f64::INFINITY); // all fibres have failed
        }
        (low, high) = (high, 2.0 * high);
    }
    while high - low > 1e-9 * high {
        let middle = 0.5 * (low + high);
        if within(middle) { high = middle } else { low = middle }
    }
    Some(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rectangle of unit width, depth and yield stress.
    fn rectangle(n: usize) -> Vec<Limits> {
        let area = 1.0 / n as f64;
        let at = |i: usize| Limits { height: (i as f64 + 0.5) * area - 0.5, force: [area; 2] };
        (0..n).map(at).collect()
    }

    /// `M/Mp + (N/Np)^2 = 1` with `Mp = 1/4`, `Np = 1` (S. Timoshenko, Strength of Materials II).
    #[test]
    fn a_rectangle_bears_what_the_interaction_of_axial_force_and_moment_leaves() {
        let section = rectangle(400);
        for n in [-0.8_f64, -0.3, 0.0, 0.5] {
            for sign in [-1.0, 1.0] {
                let most = sign * 0.25 * (1.0 - n * n);
                assert!(bears(&section, [n, 0.999 * most]) && !bears(&section, [n, 1.001 * most]));
            }
        }
        let pure = ratio_above(&section, [0.0, 0.29], 1.0).unwrap();
        assert!((pure - 1.16).abs() < 1e-4, "{pure}");
        assert!((ratio_above(&section, [-1.5, 0.0], 1.0).unwrap() - 1.5).abs() < 1e-6);
        assert_eq!(ratio_above(&section, [0.2, 0.2], 1.0), None);
    }

    /// With tension on one side alone the sign of the moment matters: `N` acts at the middle of what is compressed.
    #[test]
    fn a_section_without_tension_bears_a_moment_by_its_axial_force() {
        let mut section = rectangle(400);
        section.iter_mut().for_each(|one| one.force[1] = 0.0);
        for sign in [-1.0, 1.0] {
            let most = sign * 0.25 * (0.5 - 0.125);
            assert!(bears(&section, [-0.25, 0.999 * most]));
            assert!(!bears(&section, [-0.25, 1.001 * most]));
        }
        assert!(!bears(&section, [0.1, 0.0]));
    }
}
