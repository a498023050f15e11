//! What findings are about: one catalogue of names, codes and explanations.

/// What a finding is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Topic {
    /// Time of the first touch against the end of the run \[s\].
    Touch,
    /// Expected duration of the contact against the step \[s\].
    ContactDuration,
    /// Length of the shortest bending waves of weight that the contact sends out, against the elements \[m\].
    BendingWave,
    /// Time of a longitudinal wave through an element against the step \[s\].
    WaveTransit,
    /// Effective mass of the struck point on this mesh against its limit \[kg\].
    EffectiveMass,
    /// Contact stiffness, as a linear spring, against that of Hertz' contact \[N/m\].
    Stiffness,
    /// Distance of the nearest support or end against that from which waves return within the contact \[m\].
    Span,
    /// Period of a rear mass on its spring against the step \[s\].
    RearMass,
    /// Shear deformation, which beams here leave out, against what matters \[1\].
    Shear,
    /// Axial force against that under which a straight beam buckles \[N\]; of a start from equilibrium, whether it is stable.
    Stability,
    /// Time in which the force of a bar on a wall rises, against that of a wave through an element or the step \[s\].
    ForceRise,
    /// Time between rows of the history against the contact \[s\].
    Recording,
    /// Largest reactions where rigid impacts make them.
    Reactions,
    /// A section that varies along a beam, against one whose size does.
    Taper,
    /// Compressive strain against what a strain measure can be trusted with.
    Strain,
    /// What was still to come when the run ended.
    Ending,
    /// A value so far from what things are made of that it looks like a slip of a unit, against the nearest usual one.
    Slip,
}

impl Topic {
    /// All of them, in the order of their codes.
    pub const ALL: [Self; 17] = [
        Self::Touch,
        Self::ContactDuration,
        Self::BendingWave,
        Self::WaveTransit,
        Self::EffectiveMass,
        Self::Stiffness,
        Self::Span,
        Self::RearMass,
        Self::Shear,
        Self::Stability,
        Self::ForceRise,
        Self::Recording,
        Self::Reactions,
        Self::Taper,
        Self::Strain,
        Self::Ending,
        Self::Slip,
    ];

    /// Its name in one or two words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Touch => "first touch",
            Self::ContactDuration => "contact duration",
            Self::BendingWave => "bending wave",
            Self::WaveTransit => "wave transit",
            Self::EffectiveMass => "effective mass",
            Self::Stiffness => "contact stiffness",
            Self::Span => "minimum span",
            Self::RearMass => "rear mass",
            Self::Shear => "shear deformation",
            Self::Stability => "stability",
            Self::ForceRise => "rise of the force",
            Self::Recording => "recording",
            Self::Reactions => "reactions",
            Self::Taper => "taper",
            Self::Strain => "strain",
            Self::Ending => "end of the run",
            Self::Slip => "a slip of a unit?",
        }
    }

    /// Its code, which stays the same from version to version.
    pub fn code(self) -> &'static str {
        match self {
            Self::Touch => "W001",
            Self::ContactDuration => "W002",
            Self::BendingWave => "W003",
            Self::WaveTransit => "W004",
            Self::EffectiveMass => "W005",
            Self::Stiffness => "W006",
            Self::Span => "W007",
            Self::RearMass => "W008",
            Self::Shear => "W009",
            Self::Stability => "W010",
            Self::ForceRise => "W011",
            Self::Recording => "W012",
            Self::Reactions => "W013",
            Self::Taper => "W014",
            Self::Strain => "W015",
            Self::Ending => "W016",
            Self::Slip => "W017",
        }
    }

    /// The topic of a code.
    pub fn of_code(code: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|topic| topic.code().eq_ignore_ascii_case(code))
    }

    /// What it means, why it matters, and what to do.
    pub fn explanation(self) -> &'static str {
        match self {
            Self::Touch => {
                "The run ends before anything touches, or shortly after: there is no impact in it, or none that is seen to its end. \
                 Give a later `time.end`, a higher speed or a smaller distance."
            }
            Self::ContactDuration => {
                "The step is long for the time the contact is expected to last. Peak forces and impulses of a contact need some \
                 twenty steps; with fewer the largest force is missed. Give a `time.step` of a twentieth of the duration that is told; \
                 `percuss converge FILE` shows how far results still depend on it."
            }
            Self::BendingWave => {
                "An impact sends out bending waves; those that carry weight are shorter than an element or two, so that the mesh cannot carry \
                 them away from the contact. Forces come out too large or ring. Give more `elements` to the struck beam."
            }
            Self::WaveTransit => {
                "The step is longer than a longitudinal wave takes through an element. The scheme stays stable, but axial waves are smeared \
                 over several elements. It matters where axial forces after an impact are read; give a shorter `time.step` then."
            }
            Self::EffectiveMass => {
                "Under a rigid law an impulse depends on the mass that the struck point opposes to it, and on this mesh that is far from \
                 its limit on ever finer ones: the impulse is a property of the mesh. Use an elastic contact law, or read impulses with care \
                 and `percuss converge FILE`."
            }
            Self::Stiffness => {
                "The contact is much softer or stiffer than Hertz' contact between bodies of these materials and radii would be. That may be \
                 meant (a rubber pad, a penalty); if not, look at the units of the stiffness, or give `law = \"hertz\"`."
            }
            Self::Span => {
                "Waves return from the nearest support or end while the contact lasts, so that formulas for an infinite beam do not hold. \
                 Nothing is wrong with the run; results belong to this structure and not to a long one."
            }
            Self::RearMass => {
                "The mass behind the spring of a projectile swings faster than the step resolves. Give a shorter `time.step`."
            }
            Self::Shear => {
                "Beams here keep their sections normal to the axis. For short or thick beams, and for short waves, shear deformation is no \
                 longer small: frequencies come out too high and deflections too small, by about the share that is told."
            }
            Self::Stability => {
                "A straight beam under this axial force would buckle, or the equilibrium that the run starts from is unstable. A perfectly \
                 straight beam may stay straight all the same: give an imperfection or a small lateral load, and see `percuss static`."
            }
            Self::ForceRise => {
                "The force of a bar on a wall rises within less than a step or the passage of a wave through an element: it overshoots by up \
                 to a factor of two. Give a shorter step and more elements, or read the impulse instead of the peak."
            }
            Self::Recording => {
                "Rows of the history are further apart than the contact lasts: curves and figures may miss it, though peaks and impulses of the \
                 summary do not. Give a smaller `record.every`."
            }
            Self::Reactions => {
                "Rigid impacts on a beam send out waves as short as its elements: largest reactions and section forces are those \
                 of this mesh and step, and finer ones have larger ones. Read impulses and displacements, or give the contact a \
                 compliance."
            }
            Self::Taper => {
                "Between two stations of a beam the second moment of area is a straight line. Where it is the size of the section \
                 that varies evenly, the second moment goes with its third or fourth power, and the line is too large between. \
                 Give stations in between."
            }
            Self::Strain => {
                "The axis is compressed so much that Green's strain and the engineering strain differ, and forces with them. \
                 Compare with `strain = \"engineering\"`; if that matters, so does the law of the material. Look at the section, \
                 the speed and the units."
            }
            Self::Ending => {
                "The run ended while a contact was still closed, or before any had closed: durations and impulses are not whole, \
                 and the largest force may still come. Give a later `time.end`; a run that had `--checkpoint` goes on with \
                 `percuss extend`."
            }
            Self::Slip => {
                "A value lies so far from what things are made of that a unit is likely wrong by a power of ten (mm for m, MPa for Pa, g for kg). If it \
                 is meant, nothing is wrong."
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_their_own_and_lead_back() {
        for (k, topic) in Topic::ALL.into_iter().enumerate() {
            assert_eq!(topic.code(), format!("W{:03}", k + 1));
            assert_eq!(Topic::of_code(&topic.code().to_lowercase()), Some(topic));
            assert!(topic.explanation().len() > 80);
        }
        assert_eq!(Topic::of_code("W000"), None);
    }
}
