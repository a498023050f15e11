//! Shear stress of a section, and its von Mises stress inside.

use super::element::ElementForces;
use super::line::SectionForces;
use crate::element::beam::SectionValues;
use crate::summary::{SectionForceSummary, SectionPeak, is_of_start};

/// The square of the largest von Mises stress at the places of a section at which its shear stress is known.
fn inside(section: &SectionValues, forces: &SectionForces) -> f64 {
    let mean = forces.axial.abs() / section.area;
    let bent = forces.moment.abs() / section.inertia;
    let [axis, web] = section.sheared.map(|place| {
        let (along, across) = (mean + bent * place.height, forces.shear / place.area);
        along * along + 3.0 * across * across
    });
    axis.max(web)
}

impl ElementForces<'_> {
    /// Takes the shear stress at the neutral axis and the von Mises stress inside the section, where its shape is known.
    pub(super) fn take_sheared(
        &self,
        out: &mut SectionForceSummary,
        xi: f64,
        (section, forces): (&SectionValues, &SectionForces),
        time: f64,
    ) {
        let shear = forces.shear / section.sheared[0].area;
        if shear.is_nan() {
            return;
        }
        let s = self.s(xi);
        out.shear_stress.take(shear, s, time);
        let square = inside(section, forces);
        let most = out.von_mises_inside;
        if square > most.value * most.value || most.value.is_nan() {
            let value = square.sqrt();
            let of_start = is_of_start(most.value, most.time, value) && time > 0.0;
            out.von_mises_inside = match of_start {
                true => SectionPeak { value, ..most },
                false => SectionPeak { value, s, time },
            };
        }
        let Some(strength) = self.span.strength else { return };
        // At the first instant, where it is largest.
        let first = out.beyond_inside.is_none_or(|b| b.time == time && square > b.value * b.value);
        let even = strength.tension == strength.compression;
        if first && even && strength.is_passed(square.sqrt()) {
            out.beyond_inside = Some(SectionPeak { value: square.sqrt(), s, time });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::line::Rise;
    use super::*;
    use crate::element::beam::ShearedPlace;
    use crate::element::point::SectionLaw;
    use crate::model::StrainMeasure;

    #[test]
    fn von_mises_stresses_are_those_of_the_axis_or_of_the_end_of_the_web() {
        let law =
            SectionLaw { axial: 1.0, bending: 1.0, rotary: 0.0, measure: StrainMeasure::Green };
        let none = f64::NAN;
        let sheared =
            [ShearedPlace { height: 0.0, area: 0.5 }, ShearedPlace { height: 0.25, area: 1.0 }];
        let section = SectionValues {
            law,
            mass: none,
            area: 2.0,
            inertia: 0.125,
            young: none,
            density: none,
            half_depth: 0.5,
            shear: none,
            sheared,
        };
        let of = |axial: f64, shear: f64, moment: f64| {
            let rise = Rise { axial: 0.0, shear: 0.0, moment: 0.0 };
            inside(&section, &SectionForces { axial, shear, moment, rise }).sqrt()
        };
        let close =
            |found: f64, known: f64| assert!((found / known - 1.0).abs() < 1e-14, "{found}");
        close(of(0.0, -1.0, 0.0), 12.0_f64.sqrt());
        // 3/2 along the beam by the axial force, 2 by the moment at the end of the web.
        close(of(-3.0, 1.0, 0.0), (2.25 + 12.0_f64).sqrt());
        close(of(-3.0, 1.0, -1.0), f64::max(12.25 + 3.0, 2.25 + 12.0).sqrt());
    }
}
