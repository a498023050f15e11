//! How much the summaries of many runs tell.

use percuss::{RunSummary, SectionRange};

/// How much the summaries of a batch tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detail {
    /// Everything.
    #[default]
    Full,
    /// All but section forces, static equivalents of impacts and reactions of supports, which are left out. Beams and frames, elastic, damped or
    /// yielding, that guided projectiles strike, at most one of them rigid, and dead loads act on then run side by side in vector
    /// registers, many times as fast ([`runs_alone`](crate::runs_alone) tells what keeps a run from it).
    Motion,
    /// The same with axial force, shear force and moment of every beam, extremes and envelopes; its stresses and strains are left out.
    Resultants,
    /// The same with stresses of its extreme fibres; strains are left out. Beams made of fibres run alone.
    Stresses,
}

impl Detail {
    /// Leaves out of a summary what it does not tell.
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
            if self == Self::Resultants {
                (beam.stress, beam.beyond) = (SectionRange::default(), None);
                beam.envelope.stress.iter_mut().for_each(|range| range.fill(f64::NAN));
            }
        }
    }
}
