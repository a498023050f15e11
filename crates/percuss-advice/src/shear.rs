//! The effect of shear deformation, which slender beams neglect.

use super::case::Struck;
use super::duration::{From, Lasting, Modes};
use super::neglected_shear::NeglectedShear;
use super::planned::{PlannedContact, graded};
use super::structure::BeamPlace;
use super::words::{digits, quantity};
use super::{Advice, Topic, Verdict};
use percuss::math::vec2::{dot, rot90};
use percuss::{Mode, ModeKind, Model};

/// Shares that are fine, and that are worth a warning.
const SHARES: [f64; 2] = [0.02, 0.1];
/// A compliance by shear of this share of that by bending is no correction any more.
const GOVERNS: f64 = 0.5;
/// Share of the energy of a vibration that makes it one of a beam.
const OWN: f64 = 0.25;
/// Vibrations up to so many times the lowest frequency are looked at: the others hardly take part in deflections.
const LOW: f64 = 10.0;
/// Compliance by shear over that by bending, in `EI/(kappa G A L^2)`, of the span that has most, a clamped one.
const MOST: f64 = 48.0;

/// The estimate for a struck beam, with the shear stiffness of its material and section where that is known, else of a full rectangle with Poisson's
/// ratio 0.3: of an impact that no wave comes back to, the change of its force and rebound; else that of its force by the modes; under a rigid law
/// the compliance of the span.
pub fn finding(
    planned: &PlannedContact<'_>,
    struck: &Struck<'_>,
    lasting: Option<&Lasting>,
) -> Option<Advice> {
    if struck.across() < 0.5 || struck.place.shear_stiffness().is_some() {
        return None;
    }
    let section = struck.place.section();
    let neglected = NeglectedShear::at(&struck.place);
    let shear = neglected.stiffness;
    // Of other structures the modes know the compliance to first order, which separates large shares from small ones.
    let by_modes = || lasting?.yields(&section, shear).filter(|share| *share >= SHARES[1]);
    let yields = struck.place.span().map(|span| span.shear_share(shear)).or_else(by_modes);
    // With shear it may be another contact, as of a mass that nearly lets go: then deflections alone say something.
    let of_contact = lasting.filter(|lasting| {
        lasting.from == From::WithoutEnd || lasting.shear(&section, shear).is_some()
    });
    let (share, reported, what) = match of_contact {
        Some(lasting) if lasting.from == From::WithoutEnd => {
            let [_, change] = struck.corrections(planned.case.law, struck.speed)?;
            let rebound = change.rebound.map_or(String::new(), |share| {
                format!(" and the rebound velocity by {} %", digits(100.0 * share))
            });
            let share = change.rebound.unwrap_or(0.0).abs().max(change.force.abs());
            let what = format!("change the force by {} %{rebound}", digits(100.0 * change.force));
            (share, share, what)
        }
        Some(lasting) => {
            // First order in modes misses even the sign of what reflected waves do to the force: it tells that shear matters, not how much.
            let share = lasting.shear(&section, shear)?.abs();
            let what = "change the force by a share that is not estimated (waves return during the contact; compare with theory = \"shear\")";
            (share, yields.unwrap_or(f64::NAN), what.to_owned())
        }
        None => {
            let share = yields?;
            let what = format!("increase the static deflection by {} %", digits(100.0 * share));
            (share, share, what)
        }
    };
    let (share, reported) = (share.abs(), reported.abs());
    if !share.is_finite() {
        return None;
    }
    // Deflections follow the compliance, whatever the force does.
    let yields = yields.unwrap_or(0.0);
    let and = match of_contact {
        Some(_) if yields >= SHARES[0] => {
            format!(" and increase the static deflection by {} %", digits(100.0 * yields))
        }
        _ => String::new(),
    };
    let text = format!("shear deformation (neglected) would {what}{and} {}", neglected.basis());
    let of_force = graded(-share, SHARES.map(|x| -x));
    let of_way = match yields {
        x if x < SHARES[0] => Verdict::Fine,
        x if x < GOVERNS => Verdict::Note,
        _ => Verdict::Warning,
    };
    let verdict = of_force.max(of_way);
    Some(planned.finding(Topic::Shear, [reported, SHARES[0]], "1", verdict, text))
}

/// Slender beams without a finding of a contact whose lowest vibration would have larger deflections by shear; `estimated` are those with one, shape
/// (such beams) \[index of a beam\].
pub fn of_other_beams(model: &Model, modes: &Modes<'_>, estimated: &[usize]) -> Vec<Advice> {
    let others = (0..model.beam_count()).filter(|index| !estimated.contains(index));
    others.filter_map(|index| of_beam(model, modes, index)).collect()
}

fn of_beam(model: &Model, modes: &Modes<'_>, index: usize) -> Option<Advice> {
    let place = BeamPlace::in_the_middle(model, index);
    if place.shear_stiffness().is_some() {
        return None;
    }
    let neglected = NeglectedShear::at(&place);
    let most = MOST * place.section().bending / neglected.stiffness;
    // Modes are computed for beams that may have a finding alone.
    if most < SHARES[1] * place.longest_stretch().powi(2) {
        return None;
    }
    let mut vibrations = modes.lowest().iter().filter(|mode| mode.kind() == ModeKind::Vibration);
    let highest = vibrations.clone().next()?.eigenvalue * LOW * LOW;
    let (mode, share) = vibrations.find_map(|mode| {
        let [bending, shear] = energies(&place, mode);
        let own = bending >= OWN * mode.eigenvalue && mode.eigenvalue <= highest;
        own.then(|| (mode, shear / bending))
    })?;
    if share < SHARES[1] {
        return None;
    }
    let text = format!(
        "shear deformation (neglected) would increase the deflections of its vibration of {} by {} % {}",
        quantity(mode.frequency(), "Hz"),
        digits(100.0 * share),
        neglected.basis()
    );
    let verdict = if share < GOVERNS { Verdict::Note } else { Verdict::Warning };
    let subject = format!("beam {}", place.beam.name());
    Some(Advice::new(subject, Topic::Shear, [share, SHARES[0]], "1", verdict, text))
}

/// Twice the energies of bending, and of shear by the shear forces of that, of a beam in a mode of unit modal mass: the integrals of `EI k^2` and of
/// `(EI k')^2/(kappa G A)` with the curvature k, shape (2) \[1/s^2\].
fn energies(place: &BeamPlace<'_>, mode: &Mode) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for span in place.beam.spans() {
        for k in 0..span.element_count() {
            let (a, length) = (span.nodes().start + k, span.element_length(k));
            let middle = span.gauss_points(k)[1];
            let across = rot90(middle.tangent);
            let [[wa, ta], [wb, tb]] = [a, a + 1].map(|node| {
                let [u1, u2, s1, s2] = mode.shape[node];
                [dot(across, [u1, u2]), dot(across, [s1, s2])]
            });
            let chord = 6.0 * (wb - wa) / (length * length);
            let from = chord - (4.0 * ta + 2.0 * tb) / length;
            let to = (2.0 * ta + 4.0 * tb) / length - chord;
            let s = 0.5 * (span.stations()[k] + span.stations()[k + 1]);
            let shear = NeglectedShear::at(&BeamPlace { s, ..*place }).stiffness;
            let bending = middle.section.bending;
            sums[0] += bending * length / 3.0 * (from * from + from * to + to * to);
            sums[1] += bending * bending / shear * (to - from).powi(2) / length;
        }
    }
    sums
}
