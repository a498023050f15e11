//! Results of points, section forces and supports in the summary.

use serde::{Deserialize, Serialize};

use super::peak::Peak;

/// Extremes of a recorded point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointSummary {
    /// The user's words for it.
    pub name: String,
    /// Displacements of largest magnitude, signed, per component, shape (2).
    pub displacement_max: [Peak; 2],
    /// Whether steps resolve each of them, shape (2); if not, it is the largest at the end of a step, and between there may be more.
    pub resolved: [bool; 2],
    /// Whether the base is accelerated: displacements are relative to it.
    pub relative_to_base: bool,
}

/// A largest section force, where and when it occurred.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SectionPeak {
    /// The value of largest magnitude, signed.
    pub value: f64,
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Its time \[s\].
    pub time: f64,
}

impl Default for SectionPeak {
    fn default() -> Self {
        Self { value: f64::NAN, s: f64::NAN, time: f64::NAN }
    }
}

/// Axial force and moment beyond what a section that can yield bears with the strain that it has: an error of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SectionExcess {
    /// The forces over those in the same proportion that the section bears \[-\], above one.
    pub ratio: f64,
    /// Axial force, positive in tension \[N\].
    pub axial: f64,
    /// Bending moment \[N m\].
    pub moment: f64,
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Its time \[s\].
    pub time: f64,
    /// Length of the element \[m\].
    pub element: f64,
}

/// Smallest and largest value over the length of a beam and over time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SectionRange {
    /// Smallest, signed.
    pub min: SectionPeak,
    /// Largest, signed.
    pub max: SectionPeak,
}

/// Magnitudes that differ by less than this share are as large: which of two places or signs is reported is not for round-off to decide.
pub(crate) const SAME_SIZE: f64 = 1e-9;

impl SectionRange {
    /// The one of larger magnitude; of two as large the positive one.
    pub fn largest(&self) -> SectionPeak {
        let (min, max) = (self.min.value.abs(), self.max.value.abs());
        if min > max * (1.0 + SAME_SIZE) { self.min } else { self.max }
    }

    /// Enters a value. Of places along the beam with the same value at an instant, the first is kept.
    #[doc(hidden)]
    pub fn take(&mut self, value: f64, s: f64, time: f64) {
        if value > self.max.value || self.max.value.is_nan() {
            self.max.replace(value, s, time);
        }
        if value < self.min.value || self.min.value.is_nan() {
            self.min.replace(value, s, time);
        }
    }
}

/// Whether a larger value is that of the start but for round-off: a structure that stays at rest has its extremes at time zero.
pub(crate) fn is_of_start(known: f64, time: f64, value: f64) -> bool {
    time == 0.0 && (value - known).abs() <= SAME_SIZE * value.abs()
}

impl SectionPeak {
    fn replace(&mut self, value: f64, s: f64, time: f64) {
        let at_once = time == self.time && (value - self.value).abs() <= SAME_SIZE * value.abs();
        let same = at_once || is_of_start(self.value, self.time, value);
        *self = if same { Self { value, ..*self } } else { Self { value, s, time } };
    }
}

/// Smallest and largest values along a beam, over time: at start, middle and end of each element, and on both sides of every point inside one at
/// which a load, a mass or a guided projectile acts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Envelope {
    /// Arc length from the start of the beam, shape (places) \[m\].
    pub s: Vec<f64>,
    /// Axial force, smallest and largest, shape (2, places) \[N\].
    pub axial: [Vec<f64>; 2],
    /// Shear force, the derivative of the bending moment along the beam, shape (2, places) \[N\].
    pub shear: [Vec<f64>; 2],
    /// Bending moment, shape (2, places) \[N m\].
    pub moment: [Vec<f64>; 2],
    /// Stress of the extreme fibres, shape (2, places) \[Pa\]; NaN where the section has no depth, empty where none of the beam has one.
    pub stress: [Vec<f64>; 2],
}

/// Section forces of a beam: extremes over its length and over time.
///
/// True resultants, along and across the deformed tangent, from the balance of each element with the forces on its ends, its loads and its inertia:
/// they agree with reactions, and jump only at points of action. Those of a step are its mean; steps with impacts are omitted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SectionForceSummary {
    /// The beam's name.
    pub name: String,
    /// Axial force, positive in tension \[N\].
    pub axial: SectionRange,
    /// Shear force, the derivative of the bending moment along the beam \[N\].
    pub shear: SectionRange,
    /// Bending moment, positive where it turns the tangent counter-clockwise along the beam \[N m\].
    pub moment: SectionRange,
    /// Strain of the extreme fibres, `nu - 1 -+ (theta' - theta0') depth / 2` \[-\]; NaN where no section has a depth.
    pub strain: SectionRange,
    /// Stress of the extreme fibres, `N/A -+ M depth / (2 I)` \[Pa\].
    pub stress: SectionRange,
    /// Shear stress at the neutral axis, `V Q/(I b)` with the width b and the first moment Q of the area beyond (S. Timoshenko, Strength of
    /// Materials I) \[Pa\]: `3V/(2A)` of a rectangle, `4V/(3A)` of a circle, `2V/A` of a thin tube. NaN of sections that are not elastic ones of a
    /// known shape.
    pub shear_stress: SectionRange,
    /// Largest von Mises stress inside such sections \[Pa\]; see [`Self::von_mises`].
    pub von_mises_inside: SectionPeak,
    /// The first stress beyond the strength of an elastic material, of beams for which that is known.
    pub beyond: Option<SectionPeak>,
    /// The first von Mises stress inside a section beyond the strength, of an elastic material that bears as much in tension as in compression.
    pub beyond_inside: Option<SectionPeak>,
    /// The largest section forces beyond what a section that can yield bears, if any; of runs side by side it is not known.
    pub excess: Option<SectionExcess>,
    /// The yield stress of a beam without hardening, if it is one everywhere \[Pa\]: a fibre stress of this magnitude has no place of its own.
    pub plateau: Option<f64>,
    /// Extremes along the beam.
    pub envelope: Envelope,
}

impl SectionForceSummary {
    /// The largest von Mises stress, `sqrt(sigma^2 + 3 tau^2)` of the stress sigma along the beam and the shear stress tau (R. von Mises 1913) \[Pa\],
    /// of these places of a section: the extreme fibres, which have no shear stress, the neutral axis, and the outer ends of the web of an I or a
    /// box. Without axial force it is nowhere larger in a rectangle, a circle, a thin tube, and an I or a box without fillets. Along the beam it is
    /// evaluated at the ends and in the middle of elements, at forces between them, and where axial force, shear force or moment is largest. NaN
    /// where the shear stress is not known.
    pub fn von_mises(&self) -> SectionPeak {
        let (inside, fibre) = (self.von_mises_inside, self.stress.largest());
        match fibre.value.abs() > inside.value {
            true => SectionPeak { value: fibre.value.abs(), ..fibre },
            false => inside,
        }
    }

    /// Whether the von Mises stress is larger inside the section than in its extreme fibres.
    pub fn shear_governs(&self) -> bool {
        self.von_mises_inside.value > self.stress.largest().value.abs()
    }
}

/// Smallest and largest value over time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Range {
    /// Smallest, signed.
    pub min: Peak,
    /// Largest, signed.
    pub max: Peak,
}

impl Range {
    /// Enters a value.
    #[doc(hidden)]
    pub fn take(&mut self, value: f64, time: f64) {
        let instant = |known: &Peak| match is_of_start(known.value, known.time, value) {
            true => known.time,
            false => time,
        };
        if value > self.max.value || self.max.value.is_nan() {
            self.max = Peak { value, time: instant(&self.max) };
        }
        if value < self.min.value || self.min.value.is_nan() {
            self.min = Peak { value, time: instant(&self.min) };
        }
    }
}

/// Reactions of a support on the structure, each the mean over a step. Steps as short as an impact are omitted; and, for a support that fixes
/// displacements or is an obstacle with a rigid contact, steps of time-stepping with an impact: its reactions in them are impulses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SupportSummary {
    /// The user's name for it.
    pub name: String,
    /// Components of the force, shape (2) \[N\].
    pub force: [Range; 2],
    /// Moment about the support's point \[N m\].
    pub moment: Range,
    /// Sums of its impulses, beyond those of forces, in impacts and where prescribed velocities jump: components, and moment about its
    /// point, shape (3) \[N s, N m s\]. In a step of time-stepping with an impact the force is that of the step before.
    pub impulse: [f64; 3],
    /// Intervals of contact, in the order of time, shape (touches); of a stop only.
    pub touches: Option<Vec<StopTouch>>,
}

/// A time in which a stop pressed, resolved to the steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StopTouch {
    /// Start of the first step with a force \[s\].
    pub start: f64,
    /// End of the last such step \[s\]; none while it presses.
    pub end: Option<f64>,
    /// Magnitude of its force, summed over time \[N s\].
    pub impulse: f64,
    /// Largest magnitude of its force, the mean over a step \[N\].
    pub peak_force: Peak,
}

impl StopTouch {
    /// Stored contact intervals of a stop.
    pub const KEPT: usize = 10_000;
}

/// Section forces at a point.
#[derive(Clone, Copy, Debug)]
pub struct PointForces {
    /// Axial force \[N\].
    pub axial: f64,
    /// Shear force \[N\].
    pub shear: f64,
    /// Bending moment \[N m\].
    pub moment: f64,
    /// Stresses of the section.
    pub stress: PointStress,
}

/// Stresses of the section at a point; not a number without a depth.
#[derive(Clone, Copy, Debug)]
pub struct PointStress {
    /// That of largest magnitude \[Pa\].
    pub largest: f64,
    /// At the top fibre, on the side of the normal to the left of the beam's direction \[Pa\].
    pub top: f64,
    /// At the bottom fibre, on the other side \[Pa\].
    pub bottom: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What stays as it was at the start has no later extreme, and what grows has one.
    #[test]
    fn round_off_beside_the_start_does_not_change_the_instant_of_an_extreme() {
        let (mut forces, mut reaction) = (SectionRange::default(), Range::default());
        let mut take = |value: f64, time: f64| {
            forces.take(value, 1e3 * time, time);
            reaction.take(value, time);
            [forces.max.s, forces.max.time, reaction.max.time, reaction.min.time]
        };
        assert_eq!(take(2.0, 0.0), [0.0; 4]);
        assert_eq!(take(2.0 + 1e-12, 0.25), [0.0; 4]);
        assert_eq!(take(2.0 - 1e-12, 0.5), [0.0; 4]);
        assert_eq!(take(2.1, 0.75), [750.0, 0.75, 0.75, 0.0]);
        // After the start every larger value counts.
        assert_eq!(take(2.1 + 1e-12, 1.0), [1000.0, 1.0, 1.0, 0.0]);
        assert_eq!((reaction.max.value, reaction.min.value), (2.1 + 1e-12, 2.0 - 1e-12));
    }

    /// A force that begins at zero has its extreme where it acts.
    #[test]
    fn the_smallest_value_is_larger_than_none() {
        let mut reaction = Range::default();
        reaction.take(0.0, 0.0);
        reaction.take(1e-300, 0.5);
        assert_eq!(reaction.max, Peak { value: 1e-300, time: 0.5 });
    }
}
