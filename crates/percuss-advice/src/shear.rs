//! The effect of shear deformation, which slender beams neglect.

use super::case::Struck;
use super::duration::{From, Lasting};
use super::formulas::shear_stiffness;
use super::planned::{PlannedContact, graded};
use super::words::digits;
use super::{Advice, Topic, Verdict};

/// Shares that are fine, and that are worth a warning.
const SHARES: [f64; 2] = [0.02, 0.1];
/// A compliance by shear of this share of that by bending is no correction any more.
const GOVERNS: f64 = 0.5;

/// The estimate for a struck beam, of a full rectangle with Poisson's ratio 0.3: of an impact that no wave comes back to, the change of its
/// force and rebound; else that of its force by the modes; under a rigid law the compliance of the span.
pub fn finding(
    planned: &PlannedContact<'_>,
    struck: &Struck<'_>,
    lasting: Option<&Lasting>,
) -> Option<Advice> {
    if struck.across() < 0.5 || struck.place.shear_stiffness().is_some() {
        return None;
    }
    let section = struck.place.section();
    let shear = shear_stiffness(section.axial);
    // With shear it may be another contact, as of a mass that nearly lets go: then deflections alone say something.
    let of_contact = lasting.filter(|lasting| {
        lasting.from == From::WithoutEnd || lasting.shear(&section, shear).is_some()
    });
    let (share, what) = match of_contact {
        Some(lasting) if lasting.from == From::WithoutEnd => {
            let [_, change] = struck.corrections(planned.case.law, struck.speed)?;
            let rebound = change.rebound.map_or(String::new(), |share| {
                format!(" and the rebound velocity by {} %", digits(100.0 * share))
            });
            let share = change.rebound.unwrap_or(0.0).abs().max(change.force.abs());
            (share, format!("change the force by {} %{rebound}", digits(100.0 * change.force)))
        }
        Some(lasting) => {
            let share = lasting.shear(&section, shear)?;
            (share, format!("change the force by {} %", digits(100.0 * share)))
        }
        None => {
            let share = struck.place.span()?.shear_share(shear);
            (share, format!("increase the static deflection by {} %", digits(100.0 * share)))
        }
    };
    let share = share.abs();
    if !share.is_finite() {
        return None;
    }
    // Deflections follow the compliance, whatever the force does.
    let yields = struck.place.span().map_or(0.0, |span| span.shear_share(shear));
    let and = match of_contact {
        Some(_) if yields >= SHARES[0] => {
            format!(" and increase the static deflection by {} %", digits(100.0 * yields))
        }
        _ => String::new(),
    };
    let text = format!(
        "shear deformation (neglected) would {what}{and} (for a solid rectangle; about twice as much for a tube, two to three times for \
         an I-section)"
    );
    let of_force = graded(-share, SHARES.map(|x| -x));
    let of_way = match yields {
        x if x < SHARES[0] => Verdict::Fine,
        x if x < GOVERNS => Verdict::Note,
        _ => Verdict::Warning,
    };
    let verdict = of_force.max(of_way);
    Some(planned.finding(Topic::Shear, [share, SHARES[0]], "1", verdict, text))
}
