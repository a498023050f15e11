//! Contents of the summaries of a batch.

use percuss::{RunSummary, SectionPeak, SectionRange};

/// Contents of the summaries of a batch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detail {
    /// All results.
    #[default]
    Full,
    /// All results except section forces, equivalent static forces and reactions of supports. Beams and frames, elastic, damped or yielding, with
    /// guided projectiles (at most one of them rigid) and dead loads are then computed in SIMD lanes, many times as fast
    /// ([`runs_alone`](crate::runs_alone) gives the reason why a run is not).
    Motion,
    /// The same with axial force, shear force and moment of every beam, extremes and envelopes; stresses and strains are omitted.
    Resultants,
    /// The same with stresses of the extreme fibres; strains, shear stresses and von Mises stresses are omitted. Beams with fibre sections are computed in single runs.
    Stresses,
}

impl Detail {
    /// Removes from a summary the results that it does not contain.
    pub(crate) fn leave_out(self, summary: &mut RunSummary) {
        if self == Self::Full {
            return;
        }
        summary.supports.clear();
        for contact in &mut summary.contacts {
            contact.equivalent_force = None;
            contact.no_equivalent_force = None;
        }
        if self == Self::Motion {
            summary.section_forces.clear();
        }
        for beam in &mut summary.section_forces {
            beam.strain = SectionRange::default();
            beam.shear_stress = SectionRange::default();
            beam.von_mises_inside = SectionPeak::default();
            beam.beyond_inside = None;
            beam.excess = None;
            if self == Self::Resultants {
                (beam.stress, beam.beyond) = (SectionRange::default(), None);
                beam.envelope.stress.iter_mut().for_each(|range| range.fill(f64::NAN));
            }
        }
    }
}
